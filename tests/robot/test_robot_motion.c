// Motions that are proven. Truth: for a wiper past a post the angle of the first contact in closed form; for random
// robots among obstacles states along the motion, thousands of them, by ovoid_robot_collide: none of those said to be
// free is a hit.
#include "check.h"
#include "robots.h"

#include "ovoid/robot_path.h"

static ovoid_error error;
static ovoid_shape *rod, *post, *plate, *ball;

// A segment: free before `from`, HIT at `until`.
typedef struct found_motion {
    ovoid_robot_status status;
    ovoid_code code;
    uint32_t variable, steps;
    double from, until;
    ovoid_robot_side a, b;
} found_motion;

static ovoid_code check_motion(ovoid_robot_checker *x, const double *q0, const double *q1, size_t n,
                               const ovoid_robot_path_options *options, found_motion *found) {
    double states[2 * 7 * ROBOT_LINKS];
    memcpy(states, q0, n * sizeof *q0);
    memcpy(states + n, q1, n * sizeof *q1);
    ovoid_robot_path path = {states, 2};
    ovoid_robot_path_answer is;
    ovoid_code code = ovoid_robot_path_find_hit(x, &(ovoid_robot_path_query){&path, options}, &is, &error);
    *found = (found_motion){is.status,     is.hit.code, is.hit.variable, is.states,
                            is.free_until, is.hit_at,   is.hit.a,        is.hit.b};
    return code;
}

static ovoid_robot_joint make_hinge(uint32_t parent, uint32_t child, double x, const char *name) {
    return (ovoid_robot_joint){.name = name,
                               .type = OVOID_JOINT_CONTINUOUS,
                               .parent = parent,
                               .child = child,
                               .origin = {{x, 0, 0}, {1, 0, 0, 0}},
                               .axis = {0, 0, 1},
                               .mimic = OVOID_ROBOT_NONE};
}

// A capsule of length 2 and radius 0.05 on a hinge at its end turns toward a sphere of radius 0.1 at 1 from the hinge:
// they touch where sin(angle) = 0.15.
static void test_wiper(void) {
    ovoid_robot_link links[2] = {{"base"}, {"wiper"}};
    ovoid_robot_joint hinge = make_hinge(0, 1, 0, "hinge");
    const double turn = sqrt(0.5);
    ovoid_robot_element element = {1, NULL, rod, {{1, 0, 0}, {turn, 0, turn, 0}}, NULL};
    ovoid_robot_description d = {
        .links = links, .link_count = 2, .joints = &hinge, .joint_count = 1, .elements = &element, .element_count = 1};
    ovoid_robot *r = ovoid_robot_create(&d, NULL, &error);
    ovoid_robot_cell *cell = ovoid_robot_cell_create(r, NULL, &error);
    ovoid_body at = {.shape = ball, .pose = {{1, 0, 0}, {1, 0, 0, 0}}};
    ovoid_id id = ovoid_robot_cell_add(cell, &at, &error);
    ovoid_robot_checker *x = ovoid_robot_checker_create(cell, NULL, &error);
    if (!x) exit(1);
    for (double margin = 0; margin < 0.4; margin += 0.1) {
        ovoid_robot_path_options options = {.query.margin = margin};
        found_motion is;
        double q0 = -1.5, q1 = 1.5, contact = (-asin(0.15 + margin) + 1.5) / 3;
        CHECK_EQ(check_motion(x, &q0, &q1, 1, &options, &is), OVOID_OK);
        CHECK_EQ(is.status, OVOID_ROBOT_HIT);
        CHECK_LE(is.from, contact);
        CHECK_LE(contact, is.until);
        CHECK_LE(is.until - is.from, 0x1p-20);
        CHECK(is.b.body == id && is.a.link == 1);
        // Up to a hair before the contact it is free, and the other way round it meets the post at the same angle.
        double before = -asin(0.15 + margin) - 1e-3;
        CHECK_EQ(check_motion(x, &q0, &before, 1, &options, &is), OVOID_OK);
        CHECK(is.status == OVOID_ROBOT_FREE && is.from == 1 && is.until == INFINITY);
        CHECK_EQ(check_motion(x, &q1, &q0, 1, &options, &is), OVOID_OK);
        CHECK_LE(is.from, contact);
        CHECK_LE(contact, is.until);
        // A full turn to where it began: only the way between tells.
        double round = before - 2 * 3.14159265358979312;
        CHECK_EQ(check_motion(x, &before, &round, 1, &options, &is), OVOID_OK);
        CHECK_EQ(is.status, OVOID_ROBOT_HIT);
        // It begins within the margin; it stands still.
        double inside = 0;
        CHECK_EQ(check_motion(x, &inside, &q1, 1, &options, &is), OVOID_OK);
        CHECK(is.status == OVOID_ROBOT_HIT && is.from == 0);
        CHECK_EQ(check_motion(x, &q0, &q0, 1, &options, &is), OVOID_OK);
        CHECK(is.status == OVOID_ROBOT_FREE && is.steps == 1);
    }
    found_motion is;
    ovoid_robot_path_options options = {.states = 1};
    double q0 = -1.5, q1 = 1.5, bad = NAN;
    CHECK_EQ(check_motion(x, &q0, &q1, 1, &options, &is), OVOID_OK);
    CHECK(is.status != OVOID_ROBOT_FREE && is.steps == 1 && is.from == 0);
    CHECK_EQ(check_motion(x, &q0, &bad, 1, NULL, &is), OVOID_OK);
    CHECK(is.status == OVOID_ROBOT_REFUSED && is.code == OVOID_ERROR_NOT_FINITE && is.variable == 0);
    options.tolerance = -2;
    CHECK_EQ(check_motion(x, &q0, &q1, 1, &options, &is), OVOID_ERROR_ARGUMENT);
    ovoid_robot_checker_destroy(x);
    ovoid_robot_cell_destroy(cell);
    ovoid_robot_destroy(r);
}

// Two wipers on one base meet in the middle: 2 long and 0.05 thick, 2 apart, turning against each other; a plate a
// ten-thousandth thick is not passed through.
static void test_thin(void) {
    ovoid_robot_link links[3] = {{"base"}, {"left"}, {"right"}};
    ovoid_robot_joint hinges[2] = {make_hinge(0, 1, -1, "left"), make_hinge(0, 2, 1, "right")};
    const double turn = sqrt(0.5);
    ovoid_robot_element elements[2] = {{1, NULL, rod, {{1, 0, 0}, {turn, 0, turn, 0}}, NULL},
                                       {2, NULL, rod, {{1, 0, 0}, {turn, 0, turn, 0}}, NULL}};
    ovoid_robot_description d = {
        .links = links, .link_count = 3, .joints = hinges, .joint_count = 2, .elements = elements, .element_count = 2};
    ovoid_robot *r = ovoid_robot_create(&d, NULL, &error);
    ovoid_robot_cell *cell = ovoid_robot_cell_create(r, NULL, &error);
    ovoid_robot_checker *x = ovoid_robot_checker_create(cell, NULL, &error);
    if (!x) exit(1);
    found_motion is;
    // The left one from straight up to the right, the right one from straight up to the left, at once: symmetric, they
    // meet where the tips are 0.05 from the middle: 1 - 2 cos(angle) = 0.05 ... by the left's angle from up.
    const double up[2] = {1.5707963267948966, 1.5707963267948966}, down[2] = {0.5, 2.641592653589793};
    CHECK_EQ(check_motion(x, up, down, 2, NULL, &is), OVOID_OK);
    double contact = (1.5707963267948966 - acos(0.95 / 2)) / (1.5707963267948966 - 0.5);
    CHECK(is.status == OVOID_ROBOT_HIT && is.from <= contact && contact <= is.until);
    // Both turn the same way: their distance does not change much, and a common joint would not count at all.
    const double tilted[2] = {0.9, 0.9};
    CHECK_EQ(check_motion(x, up, tilted, 2, NULL, &is), OVOID_OK);
    CHECK_EQ(is.status, OVOID_ROBOT_FREE);
    // Many turns through a thin plate.
    ovoid_body wall = {.shape = plate, .pose = {{-1, 1, 0}, {1, 0, 0, 0}}};
    (void)ovoid_robot_cell_add(cell, &wall, &error);
    const double here[2] = {3, -1}, there[2] = {3 - 40 * 3.141592653589793, -1};
    CHECK_EQ(check_motion(x, here, there, 2, NULL, &is), OVOID_OK);
    CHECK_EQ(is.status, OVOID_ROBOT_HIT);
    CHECK_NEAR(3 - is.until * 40 * 3.141592653589793, 1.5707963267948966 + asin(0.1), 1e-3);
    ovoid_robot_checker_destroy(x);
    ovoid_robot_cell_destroy(cell);
    ovoid_robot_destroy(r);
}

// ---- random motions

static long statuses[4], looked;

static void fill_elements(uint64_t *s, random_robot *a) {
    const ovoid_shape *const shapes[3] = {rod, post, ball};
    size_t count = 0;
    for (uint32_t i = 0; i < a->d.link_count; i++)
        if (random_below(s, 2))
            a->elements[count++] =
                (ovoid_robot_element){i, NULL, shapes[random_below(s, 3)], random_pose(s, 0.1), NULL};
    a->d.element_count = count;
}

static void sweep(ovoid_robot_checker *x, const double *q0, const double *q1, size_t n, const found_motion *is,
                  double margin) {
    enum { STATES = 400 };
    ovoid_robot_query_options options = {.margin = margin};
    for (int i = 0; i <= STATES; i++) {
        double t = (double)i / STATES * is->from, q[7 * ROBOT_LINKS];
        if (t >= is->from && is->from < 1) break;
        for (size_t k = 0; k < n; k++) q[k] = q0[k] + t * (q1[k] - q0[k]);
        ovoid_robot_answer at;
        CHECK_EQ(ovoid_robot_collide(x, &(ovoid_robot_query){q, &options}, &at, &error), OVOID_OK);
        CHECK(at.status == OVOID_ROBOT_FREE);
        looked++;
    }
    if (is->status != OVOID_ROBOT_HIT) return;
    double q[7 * ROBOT_LINKS];
    for (size_t k = 0; k < n; k++) q[k] = q0[k] + is->until * (q1[k] - q0[k]);
    ovoid_robot_answer at;
    CHECK_EQ(ovoid_robot_collide(x, &(ovoid_robot_query){q, &options}, &at, &error), OVOID_OK);
    CHECK(at.status != OVOID_ROBOT_FREE);
}

static void test_random(void) {
    uint64_t s = 31;
    for (int round = 0; round < 60; round++) {
        random_robot a;
        check_seed = (uint64_t)round;
        make_random_robot(&s, &a);
        fill_elements(&s, &a);
        // Neighbours overlap everywhere; a few pairs that are far apart in the list stay.
        ovoid_robot *r = ovoid_robot_create(&a.d, NULL, &error);
        ovoid_robot_cell *cell = ovoid_robot_cell_create(r, NULL, &error);
        if (!cell) exit(1);
        for (uint32_t i = 0; i < a.d.link_count; i++)
            for (uint32_t k = i + 1; k < a.d.link_count; k++)
                if (k < i + 4 || random_below(&s, 3)) (void)ovoid_robot_cell_add_allowed(cell, i, k, &error);
        for (int i = 0; i < 3; i++) {
            ovoid_body body = {.shape = i ? ball : post, .pose = random_pose(&s, 2)};
            (void)ovoid_robot_cell_add(cell, &body, &error);
        }
        ovoid_robot_checker *x = ovoid_robot_checker_create(cell, NULL, &error);
        size_t n = ovoid_robot_get_variable_count(r);
        for (int k = 0; k < 12; k++) {
            double q0[7 * ROBOT_LINKS], q1[7 * ROBOT_LINKS];
            make_random_state(&s, r, q0);
            make_random_state(&s, r, q1);
            for (size_t v = 0; v < n; v++) {
                ovoid_robot_variable of = ovoid_robot_get_variable(r, v);
                if (a.joints[of.joint].type == OVOID_JOINT_FLOATING && of.component >= 3) q1[v] = q0[v];
                q1[v] = q0[v] + (k % 3 + 1) * 0.05 * (q1[v] - q0[v]);
            }
            ovoid_robot_path_options options = {.query.margin = k % 2 ? 0.02 : 0, .states = 2000};
            found_motion is;
            CHECK_EQ(check_motion(x, q0, q1, n, &options, &is), OVOID_OK);
            statuses[is.status]++;
            sweep(x, q0, q1, n, &is, options.query.margin);
        }
        ovoid_robot_checker_destroy(x);
        ovoid_robot_cell_destroy(cell);
        ovoid_robot_destroy(r);
    }
    check_seed = 0;
    printf("motions: %ld free, %ld hit, %ld undecided; %ld states within what is free\n", statuses[OVOID_ROBOT_FREE],
           statuses[OVOID_ROBOT_HIT], statuses[OVOID_ROBOT_UNDECIDED], looked);
    CHECK_LE(100, statuses[OVOID_ROBOT_FREE]);
    CHECK_LE(60, statuses[OVOID_ROBOT_HIT]);
}

int main(void) {
    rod = ovoid_shape_create_capsule(0.05, 1, NULL, &error);
    post = ovoid_shape_create_box((ovoid_vec3){0.1, 0.2, 0.3}, NULL, &error);
    plate = ovoid_shape_create_box((ovoid_vec3){0.00005, 0.5, 0.5}, NULL, &error);
    ball = ovoid_shape_create_sphere(0.1, NULL, &error);
    if (!rod || !post || !plate || !ball) return 1;
    test_wiper();
    test_thin();
    test_random();
    ovoid_shape *const all[] = {rod, post, plate, ball};
    for (int i = 0; i < 4; i++) ovoid_shape_destroy(all[i]);
    return check_end();
}
