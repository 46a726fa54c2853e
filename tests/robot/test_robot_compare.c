// A robot beside its model of spheres. Truth: a cart on a rail before a post and a wall, which meet where the cart's
// place says so, in closed form; and the arithmetic of counts.
#include "check.h"
#include "countdown.h"

#include "ovoid/robot_compare.h"
#include "ovoid/robot_spheres.h"

static ovoid_error error;

/// The cart, its model and their cells.
typedef struct stage {
    ovoid_shape *box;
    ovoid_robot *robots[2];
    ovoid_robot_cell *cells[2];
    ovoid_robot_checker *checkers[2];
} stage;

static const ovoid_robot_link links[2] = {{"rail"}, {"cart"}};

// The rail has a post, a box of half size 0.1 at 0; the cart is such a box at its place, from -10 to 10; the wall is
// one at 5. In the model the cart is a ball of the radius given.
static void open_stage(stage *s, double radius) {
    ovoid_pose home = ovoid_pose_make_identity();
    ovoid_robot_joint slide = {.name = "slide",
                               .type = OVOID_JOINT_PRISMATIC,
                               .child = 1,
                               .origin = home,
                               .axis = {1, 0, 0},
                               .lower = -10,
                               .upper = 10,
                               .mimic = OVOID_ROBOT_NONE,
                               .multiplier = 1};
    *s = (stage){.box = ovoid_shape_create_box((ovoid_vec3){0.1, 0.1, 0.1}, NULL, &error)};
    ovoid_robot_element elements[2] = {{0, NULL, s->box, home, NULL}, {1, NULL, s->box, home, NULL}};
    ovoid_robot_description d = {NULL, links, 2, &slide, 1, elements, 2, NULL, 0, NULL};
    s->robots[0] = ovoid_robot_create(&d, NULL, &error);
    ovoid_robot_link_sphere balls[2] = {{0, {{0, 0, 0}, 0.1}}, {1, {{0, 0, 0}, radius}}};
    s->robots[1] = ovoid_robot_create_from_spheres(s->robots[0], &(ovoid_robot_link_spheres){balls, 2}, NULL, &error);
    CHECK(s->robots[0] && s->robots[1]);
    ovoid_body wall = {.shape = s->box, .pose = home};
    wall.pose.position.x = 5;
    for (int i = 0; i < 2; i++) {
        s->cells[i] = ovoid_robot_cell_create(s->robots[i], NULL, &error);
        CHECK(ovoid_robot_cell_add(s->cells[i], &wall, &error) != 0);
        s->checkers[i] = ovoid_robot_checker_create(s->cells[i], NULL, &error);
        CHECK(s->checkers[i] != NULL);
    }
}

static void close_stage(stage *s) {
    for (int i = 0; i < 2; i++) {
        ovoid_robot_checker_destroy(s->checkers[i]);
        ovoid_robot_cell_destroy(s->cells[i]);
        ovoid_robot_destroy(s->robots[i]);
    }
    ovoid_shape_destroy(s->box);
}

enum { STATES = 1000 };

// Places from -4.995 to 4.995 in steps of 0.01: the post is hit below 0.2, the wall beyond 4.8; by the model of radius
// r below 0.1 + r and beyond 4.9 - r.
static void make_states(double *q) {
    for (int i = 0; i < STATES; i++) q[i] = 0.01 * i - 4.995;
}

static ovoid_robot_comparison compare(const stage *s, const double *q, const ovoid_robot_query_options *o,
                                      ovoid_robot_agreement *agreements) {
    ovoid_robot_comparison c = {.states = 0};
    ovoid_robot_comparison_batch batch = {s->checkers[0], s->checkers[1], q, STATES, o, agreements};
    CHECK_EQ(ovoid_robot_compare_states(&batch, &c, &error), OVOID_OK);
    CHECK_EQ(c.states, (size_t)STATES);
    return c;
}

static void check_counts(const ovoid_robot_comparison *c, size_t hit, size_t missed, size_t invented) {
    CHECK_EQ(c->counts[OVOID_ROBOT_COMPARED_OPEN], (size_t)0);
    CHECK_EQ(c->counts[OVOID_ROBOT_COMPARED_BOTH_HIT], hit);
    CHECK_EQ(c->counts[OVOID_ROBOT_COMPARED_MISSED], missed);
    CHECK_EQ(c->counts[OVOID_ROBOT_COMPARED_INVENTED], invented);
    CHECK_EQ(c->counts[OVOID_ROBOT_COMPARED_BOTH_FREE], STATES - hit - missed - invented);
}

static void test_small(void) {
    static double q[STATES];
    static ovoid_robot_agreement agreements[STATES];
    stage s;
    make_states(q);
    open_stage(&s, 0.05);
    ovoid_robot_query_options self = {.without_obstacles = 1}, around = {.without_self = 1};
    ovoid_robot_comparison c = compare(&s, q, &self, agreements);
    check_counts(&c, 30, 10, 0); // 0.155 to 0.195 on both sides
    CHECK_EQ(agreements[499 - 15], OVOID_ROBOT_COMPARED_MISSED);
    CHECK_EQ(agreements[499 - 14], OVOID_ROBOT_COMPARED_BOTH_HIT);
    CHECK_EQ(agreements[499 - 20], OVOID_ROBOT_COMPARED_BOTH_FREE);
    // At 0.155 the boxes overlap by 0.045; of the two such states that is 484 or 515.
    CHECK(c.deepest_state == 484 || c.deepest_state == 515);
    CHECK_NEAR(c.deepest.upper, -0.045, 1e-9);
    CHECK(c.deepest.a.link == 0 && c.deepest.b.link == 1);
    c = compare(&s, q, &around, agreements);
    check_counts(&c, 15, 5, 0);
    CHECK_EQ(c.deepest_state, (size_t)984);
    CHECK(c.deepest.a.link == 1 && c.deepest.b.link == OVOID_ROBOT_NONE);
    CHECK_NEAR(c.deepest.lower, -0.045, 1e-9);
    // Both at once, and without a list.
    c = compare(&s, q, NULL, NULL);
    check_counts(&c, 45, 15, 0);
    close_stage(&s);
}

static void test_large(void) {
    static double q[STATES];
    stage s;
    make_states(q);
    open_stage(&s, 0.2);
    ovoid_robot_comparison c = compare(&s, q, NULL, NULL);
    check_counts(&c, 60, 0, 30);
    CHECK_EQ(c.deepest_state, (size_t)0);
    close_stage(&s);
}

// Two batches count as one; states outside the limits are open.
static void test_sums(void) {
    static double q[STATES];
    stage s;
    make_states(q);
    open_stage(&s, 0.05);
    ovoid_robot_comparison c = {.states = 0};
    ovoid_robot_comparison_batch batch = {s.checkers[0], s.checkers[1], q, 600, NULL, NULL};
    CHECK_EQ(ovoid_robot_compare_states(&batch, &c, &error), OVOID_OK);
    batch.q += 600, batch.count = 400;
    CHECK_EQ(ovoid_robot_compare_states(&batch, &c, &error), OVOID_OK);
    check_counts(&c, 45, 15, 0);
    CHECK(c.deepest_state == 484 || c.deepest_state == 515 || c.deepest_state == 984);
    // Of the last batch alone: places from 4.005 on are numbered behind the 400 that miss nothing.
    ovoid_robot_comparison late = {.states = 0};
    batch.q = q, batch.count = 400;
    CHECK_EQ(ovoid_robot_compare_states(&batch, &late, &error), OVOID_OK);
    batch.q = q + 900, batch.count = 100;
    CHECK_EQ(ovoid_robot_compare_states(&batch, &late, &error), OVOID_OK);
    CHECK_EQ(late.deepest_state, (size_t)484);
    double outside[2] = {11, NAN};
    batch.q = outside, batch.count = 2;
    CHECK_EQ(ovoid_robot_compare_states(&batch, &c, &error), OVOID_OK);
    CHECK_EQ(c.counts[OVOID_ROBOT_COMPARED_OPEN], (size_t)2);
    CHECK_EQ(c.states, (size_t)1002);
    close_stage(&s);
}

// A state that the model alone refuses is open, and so is one that the robot alone refuses.
static void test_limits(void) {
    stage s;
    open_stage(&s, 0.05);
    ovoid_robot_joint slide = ovoid_robot_get_description(s.robots[0]).joints[0];
    slide.upper = 1;
    ovoid_robot_description d = {NULL, links, 2, &slide, 1, NULL, 0, NULL, 0, NULL};
    ovoid_robot *narrow = ovoid_robot_create(&d, NULL, &error);
    ovoid_robot_cell *cell = ovoid_robot_cell_create(narrow, NULL, &error);
    ovoid_robot_checker *checker = ovoid_robot_checker_create(cell, NULL, &error);
    const double q[2] = {4.9, 2};
    for (int i = 0; i < 2; i++) {
        ovoid_robot_comparison c = {.states = 0};
        ovoid_robot_comparison_batch batch = {
            i ? checker : s.checkers[0], i ? s.checkers[0] : checker, q, 2, NULL, NULL};
        CHECK_EQ(ovoid_robot_compare_states(&batch, &c, &error), OVOID_OK);
        CHECK_EQ(c.counts[OVOID_ROBOT_COMPARED_OPEN], (size_t)2);
    }
    ovoid_robot_checker_destroy(checker);
    ovoid_robot_cell_destroy(cell);
    ovoid_robot_destroy(narrow);
    close_stage(&s);
}

static void test_refused(void) {
    stage s;
    open_stage(&s, 0.05);
    double q = 0;
    ovoid_robot_comparison c = {.states = 7};
    ovoid_robot_query_options wrong = {.margin = -1};
    ovoid_robot_comparison_batch batch = {s.checkers[0], s.checkers[1], &q, 1, &wrong, NULL};
    CHECK_EQ(ovoid_robot_compare_states(&batch, &c, &error), OVOID_ERROR_ARGUMENT);
    batch.options = NULL, batch.model = NULL;
    CHECK_EQ(ovoid_robot_compare_states(&batch, &c, &error), OVOID_ERROR_ARGUMENT);
    ovoid_robot_link one = {"alone"};
    ovoid_robot *still = ovoid_robot_create(&(ovoid_robot_description){.links = &one, .link_count = 1}, NULL, &error);
    ovoid_robot_cell *cell = ovoid_robot_cell_create(still, NULL, &error);
    batch.model = ovoid_robot_checker_create(cell, NULL, &error);
    CHECK_EQ(ovoid_robot_compare_states(&batch, &c, &error), OVOID_ERROR_ARGUMENT);
    CHECK(strstr(error.message, "the robot has 1 variables and its model 0") != NULL);
    CHECK_EQ(c.states, (size_t)7);
    ovoid_robot_checker_destroy(batch.model);
    ovoid_robot_cell_destroy(cell);
    ovoid_robot_destroy(still);
    CHECK(strcmp(ovoid_robot_agreement_get_name(OVOID_ROBOT_COMPARED_MISSED), "missed") == 0);
    CHECK(strcmp(ovoid_robot_agreement_get_name((ovoid_robot_agreement)99), "open") == 0);

    ovoid_robot_link_sphere balls[2] = {{1, {{0, 0, 0}, 1}}, {0, {{0, 0, 0}, 1}}};
    balls[1].link = 2;
    CHECK(!ovoid_robot_create_from_spheres(s.robots[0], &(ovoid_robot_link_spheres){balls, 2}, NULL, &error));
    CHECK(error.code == OVOID_ERROR_INDEX && error.place == 1);
    balls[1] = (ovoid_robot_link_sphere){0, {{0, 0, 0}, -1}};
    CHECK(!ovoid_robot_create_from_spheres(s.robots[0], &(ovoid_robot_link_spheres){balls, 2}, NULL, &error));
    CHECK(error.code == OVOID_ERROR_RADIUS && error.place == 1);
    CHECK(!ovoid_robot_create_from_spheres(NULL, &(ovoid_robot_link_spheres){balls, 2}, NULL, &error));
    CHECK_EQ(error.code, OVOID_ERROR_ARGUMENT);
    close_stage(&s);
}

// The robot of spheres has what the other one has, owns what it has, and leaves nothing where memory ends.
static void test_robot_of_spheres(void) {
    stage s;
    open_stage(&s, 0.05);
    ovoid_robot_link_sphere balls[3] = {{1, {{0.5, 0, 0}, 0.25}}, {1, {{0, 0.5, 0}, 0}}, {0, {{0, 0, 0}, 1}}};
    for (long k = 0, done = 0; !done && k < 100; k++) {
        countdown c = {k, 0};
        ovoid_allocator allocator = countdown_make_allocator(&c);
        ovoid_robot *r = ovoid_robot_create_from_spheres(s.robots[0], &(ovoid_robot_link_spheres){balls, 3},
                                                         &(ovoid_robot_options){.allocator = &allocator}, &error);
        done = r != NULL;
        if (!done) {
            CHECK_EQ(error.code, OVOID_ERROR_MEMORY);
            CHECK_EQ(c.held, 0L);
            continue;
        }
        CHECK(k > 3);
        ovoid_robot_description d = ovoid_robot_get_description(r);
        CHECK(d.link_count == 2 && d.joint_count == 1 && d.element_count == 3);
        CHECK(d.elements[0].link == 1 && d.elements[0].pose.position.x == 0.5);
        CHECK_EQ(ovoid_shape_get_radius(d.elements[0].shape), 0.25);
        CHECK_EQ(d.elements[2].link, 0u);
        ovoid_robot_destroy(r);
        CHECK_EQ(c.held, 0L);
    }
    ovoid_robot *empty =
        ovoid_robot_create_from_spheres(s.robots[0], &(ovoid_robot_link_spheres){NULL, 0}, NULL, &error);
    CHECK(empty && ovoid_robot_get_description(empty).element_count == 0);
    ovoid_robot_destroy(empty);
    close_stage(&s);
}

int main(void) {
    test_small();
    test_large();
    test_sums();
    test_limits();
    test_refused();
    test_robot_of_spheres();
    return check_end();
}
