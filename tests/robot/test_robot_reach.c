// Obstacles that a link may reach. Truth: the places of groups' spheres by the checker at states within the limits,
// most of them at limits, where links are farthest; an obstacle that is said to be out of reach must be apart from the
// sphere. Verdicts with and without limits are the same. What moves, is padded, or has a margin must come into reach
// again.
#include "check.h"
#include "robots.h"

#include "robot/cell/checker.h"

enum { ROBOTS = 300, STATES = 200, OBSTACLES = 11 };
static ovoid_shape *shapes[2];
static ovoid_error error;
static long pairs, beyond, nearly;

typedef struct scene {
    random_robot a;
    ovoid_robot *r;
    ovoid_robot_cell *cell;
    ovoid_robot_checker *checker;
} scene;

static void make_scene(uint64_t *s, scene *c) {
    make_random_robot(s, &c->a);
    size_t count = 0;
    for (uint32_t i = 0; i < c->a.d.link_count; i++) {
        ovoid_robot_joint *j = &c->a.joints[i];
        if (j->type > OVOID_JOINT_PRISMATIC && j->mimic == OVOID_ROBOT_NONE && random_below(s, 8))
            j->type = OVOID_JOINT_REVOLUTE;
        if (random_below(s, 2))
            c->a.elements[count++] =
                (ovoid_robot_element){i, NULL, shapes[random_below(s, 2)], random_pose(s, 0.2), NULL};
    }
    c->a.d.element_count = count;
    c->r = ovoid_robot_create(&c->a.d, NULL, &error);
    c->cell = c->r ? ovoid_robot_cell_create(c->r, NULL, &error) : NULL;
    if (!c->cell) printf("%s\n", error.message), exit(1);
    for (int i = 0; i < OBSTACLES; i++) {
        const ovoid_body body = {.shape = shapes[random_below(s, 2)], .pose = random_pose(s, 1.5)};
        CHECK(ovoid_robot_cell_add(c->cell, &body, &error) != 0);
    }
    c->checker = ovoid_robot_checker_create(c->cell, NULL, &error);
    if (!c->checker) printf("%s\n", error.message), exit(1);
}

static void destroy_scene(scene *c) {
    ovoid_robot_checker_destroy(c->checker);
    ovoid_robot_cell_destroy(c->cell);
    ovoid_robot_destroy(c->r);
}

// Within the limits, two variables of three at one of them.
static void make_state(uint64_t *s, const ovoid_robot *r, double *q) {
    make_random_state(s, r, q);
    for (size_t i = 0; i < ovoid_robot_get_variable_count(r); i++) {
        ovoid_robot_variable v = ovoid_robot_get_variable(r, i);
        if (isfinite(v.lower) && random_below(s, 3)) q[i] = random_below(s, 2) ? v.lower : v.upper;
    }
}

static double measure(const scene *c, size_t group, size_t part) {
    const sphere_place *at = &c->checker->places[group];
    const double(*box)[ROBOT8] = cell_boxes(c->cell)[part / ROBOT8].column;
    size_t k = part % ROBOT8;
    double x = box[BOX8_CENTER][k] - at->center[0], y = box[BOX8_CENTER + 1][k] - at->center[1],
           z = box[BOX8_CENTER + 2][k] - at->center[2];
    return sqrt(x * x + y * y + z * z) - at->reach - box[BOX8_BALL][k];
}

static void check_state(scene *c, const double *q, double margin) {
    size_t blocks = c->cell->boxes.count;
    if (checker_place(c->checker, q, 0, &error) != OVOID_OK) return; // a follower is beyond its limits
    checker_renew_masks(c->checker, margin);
    for (size_t i = 0; i < c->cell->groups.count; i++)
        for (size_t k = 0; k < blocks * ROBOT8; k++) {
            int is_near = checker_get_mask(c->checker, (uint32_t)i, (uint32_t)(k / ROBOT8)) >> k % ROBOT8 & 1;
            if (k >= c->cell->parts.count) {
                CHECK(!is_near);
                continue;
            }
            double padding = c->cell->padding[cell_groups(c->cell)[i].link],
                   apart = measure(c, i, k) - padding - margin;
            pairs++;
            beyond += !is_near;
            nearly += !is_near && apart < 0.1;
            if (!is_near) CHECK(apart > 0);
        }
}

// The same pairs are left where limits are ignored.
static void check_verdict(scene *c, const double *q) {
    const ovoid_robot_query_options options = {.limit_slack = INFINITY};
    ovoid_robot_answer is, other;
    if (ovoid_robot_validate_limits(c->r, q, 0, NULL) != OVOID_OK) return;
    ovoid_robot_checker_reset(c->checker);
    CHECK_EQ(ovoid_robot_collide(c->checker, &(ovoid_robot_query){q, NULL}, &is, &error), OVOID_OK);
    ovoid_robot_checker_reset(c->checker);
    CHECK_EQ(ovoid_robot_collide(c->checker, &(ovoid_robot_query){q, &options}, &other, &error), OVOID_OK);
    CHECK(is.status == other.status && is.lower == other.lower && is.upper == other.upper);
    CHECK(is.a.element == other.a.element && is.b.body == other.b.body);
}

static void test_reach(void) {
    double q[7 * ROBOT_LINKS];
    for (uint64_t seed = 1; seed <= ROBOTS; seed++) {
        uint64_t s = check_seed = seed;
        scene c;
        make_scene(&s, &c);
        for (int i = 0; i < STATES; i++) {
            make_state(&s, c.r, q);
            if (i % 50 == 49)
                CHECK_EQ(ovoid_robot_cell_set_padding(c.cell, random_below(&s, (uint32_t)c.a.d.link_count),
                                                      random_uniform(&s, 0, 2), &error),
                         OVOID_OK);
            check_state(&c, q, random_below(&s, 2) ? 0 : random_uniform(&s, 0, 1));
            check_verdict(&c, q);
        }
        destroy_scene(&c);
    }
    check_seed = 0;
    printf("%ld pairs, %ld out of reach, %ld nearly in it\n", pairs, beyond, nearly);
    CHECK(beyond > pairs / 20 && nearly > 100);
}

// ---- changes

// A ball on a base that does not move, and one that is 3 away.
static void test_changes(void) {
    static const ovoid_robot_link link = {"base"};
    const ovoid_robot_element element = {0, NULL, shapes[1], {{0, 0, 0}, {1, 0, 0, 0}}, NULL};
    const ovoid_robot_description d = {.links = &link, .link_count = 1, .elements = &element, .element_count = 1};
    ovoid_robot *r = ovoid_robot_create(&d, NULL, &error);
    ovoid_robot_cell *cell = ovoid_robot_cell_create(r, NULL, &error);
    ovoid_pose pose = {{3, 0, 0}, {1, 0, 0, 0}};
    const ovoid_body body = {.shape = shapes[1], .pose = pose};
    ovoid_id id = ovoid_robot_cell_add(cell, &body, &error);
    ovoid_robot_checker *checker = ovoid_robot_checker_create(cell, NULL, &error);
    ovoid_robot_query_options options = {.margin = 0};
    ovoid_robot_answer is;
    const double none = 0;
    for (int i = 0; i < 8; i++) {
        // In turn: as it is; moved near; moved back; padded; not; with a margin; without; limits ignored.
        pose.position.x = i == 1 ? 0.1 : 3;
        options = (ovoid_robot_query_options){.margin = i == 5 ? 2.7 : 0, .limit_slack = i == 7 ? INFINITY : 0};
        CHECK_EQ(ovoid_robot_cell_move(cell, id, &pose, &error), OVOID_OK);
        if (i == 3 || i == 4) CHECK_EQ(ovoid_robot_cell_set_padding(cell, 0, i == 3 ? 2.7 : 0, &error), OVOID_OK);
        CHECK_EQ(ovoid_robot_collide(checker, &(ovoid_robot_query){&none, &options}, &is, &error), OVOID_OK);
        CHECK_EQ(is.status, i == 1 || i == 3 || i == 5 ? OVOID_ROBOT_HIT : OVOID_ROBOT_FREE);
    }
    ovoid_robot_checker_destroy(checker);
    ovoid_robot_cell_destroy(cell);
    ovoid_robot_destroy(r);
}

// A slide that reaches the obstacle only beyond its limit.
static void test_limits(void) {
    static const ovoid_robot_link links[2] = {{"base"}, {"tip"}};
    const ovoid_robot_joint joint = {.name = "slide",
                                     .type = OVOID_JOINT_PRISMATIC,
                                     .parent = 0,
                                     .child = 1,
                                     .origin = ovoid_pose_make_identity(),
                                     .axis = {1, 0, 0},
                                     .upper = 1,
                                     .mimic = OVOID_ROBOT_NONE};
    const ovoid_robot_element element = {1, NULL, shapes[1], {{0, 0, 0}, {1, 0, 0, 0}}, NULL};
    const ovoid_robot_description d = {
        .links = links, .link_count = 2, .joints = &joint, .joint_count = 1, .elements = &element, .element_count = 1};
    ovoid_robot *r = ovoid_robot_create(&d, NULL, &error);
    ovoid_robot_cell *cell = ovoid_robot_cell_create(r, NULL, &error);
    const ovoid_body body = {.shape = shapes[1], .pose = {{3, 0, 0}, {1, 0, 0, 0}}};
    CHECK(ovoid_robot_cell_add(cell, &body, &error) != 0);
    ovoid_robot_checker *checker = ovoid_robot_checker_create(cell, NULL, &error);
    static const struct {
        double q, slack;
        ovoid_robot_status status;
    } all[4] = {
        {1, 0, OVOID_ROBOT_FREE}, {3, 0, OVOID_ROBOT_REFUSED}, {3, 5, OVOID_ROBOT_HIT}, {3, INFINITY, OVOID_ROBOT_HIT}};
    for (int i = 0; i < 4; i++) {
        const ovoid_robot_query_options options = {.limit_slack = all[i].slack};
        const double many[8] = {all[i].q, all[i].q, all[i].q, all[i].q, all[i].q, all[i].q, all[i].q, all[i].q};
        ovoid_robot_answer is, answers[8];
        CHECK_EQ(ovoid_robot_collide(checker, &(ovoid_robot_query){many, &options}, &is, &error), OVOID_OK);
        CHECK_EQ(is.status, all[i].status);
        CHECK_EQ(ovoid_robot_collide_batch(&checker, 1, &(ovoid_robot_batch){many, 8, &options, answers}, &error),
                 OVOID_OK);
        for (int k = 0; k < 8; k++) CHECK_EQ(answers[k].status, all[i].status);
    }
    ovoid_robot_checker_destroy(checker);
    ovoid_robot_cell_destroy(cell);
    ovoid_robot_destroy(r);
}

int main(void) {
    shapes[0] = ovoid_shape_create_box((ovoid_vec3){0.1, 0.05, 0.2}, NULL, &error);
    shapes[1] = ovoid_shape_create_sphere(0.2, NULL, &error);
    test_reach();
    test_changes();
    test_limits();
    for (int i = 0; i < 2; i++) ovoid_shape_destroy(shapes[i]);
    return check_end();
}
