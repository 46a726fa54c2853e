// The smallest clearance of a path. Truth: for a hinge with a ball past a wall a closed form; for random robots among
// obstacles the nearest pair at dense samples, by ovoid_robot_find_nearest, which knows nothing of paths: none may be
// nearer than `lower`, and at `at` one must be as near as `upper`.
#include "check.h"
#include "robots.h"

#include "ovoid/robot_path.h"

enum { SHAPES = 4, OBSTACLES = 4, SAMPLES = 400, TRIALS = 150 };
static ovoid_shape *shapes[SHAPES];
static ovoid_error error;
static long narrow, overlaps;

static ovoid_robot_near find_nearest(ovoid_robot_checker *x, const double *q, const ovoid_robot_query_options *o) {
    ovoid_robot_near near = {.lower = INFINITY, .upper = INFINITY};
    ovoid_robot_nears nears = {.items = &near, .capacity = 1};
    ovoid_robot_query_options all = *o;
    all.margin = INFINITY;
    CHECK_EQ(ovoid_robot_find_nearest(x, &(ovoid_robot_query){q, &all}, &nears, &error), OVOID_OK);
    return near;
}

static void get_state(size_t n, const double *states, size_t count, double at, double *q) {
    size_t k = (size_t)at;
    if (k + 1 >= count) k = count > 1 ? count - 2 : 0;
    const double *q0 = states + k * n, *q1 = count > 1 ? q0 + n : q0;
    for (size_t i = 0; i < n; i++) q[i] = q0[i] + (at - (double)k) * (q1[i] - q0[i]);
}

static void compare(ovoid_robot_checker *x, size_t n, const ovoid_robot_path *path, const ovoid_robot_path_options *o,
                    const ovoid_robot_clearance *is) {
    double q[7 * ROBOT_LINKS], end = path->count > 1 ? (double)(path->count - 1) : 0, least = INFINITY;
    for (int i = 0; i <= SAMPLES; i++) {
        get_state(n, path->states, path->count, end * i / SAMPLES, q);
        ovoid_robot_near near = find_nearest(x, q, &o->query);
        least = fmin(least, near.upper);
    }
    CHECK(is->lower <= least && is->lower <= is->upper);
    if (!(is->upper < INFINITY)) {
        CHECK(is->lower == INFINITY && least == INFINITY);
        return;
    }
    // The state at `at` again, rounded otherwise: a few roundings of what the robot is large.
    get_state(n, path->states, path->count, is->at, q);
    ovoid_robot_near there = find_nearest(x, q, &o->query);
    CHECK(is->at >= 0 && is->at <= (path->count > 1 ? end : 1));
    CHECK(there.lower <= is->upper + 1e-11);
    CHECK(is->upper <= there.upper + 1e-9 || is->a.link != there.a.link || there.upper >= is->lower);
    narrow += is->upper - is->lower <= 1.001 * o->tolerance + 1e-9;
    overlaps += is->upper < 0;
}

static void test_random(void) {
    uint64_t s = 5;
    double states[4 * 7 * ROBOT_LINKS] = {0};
    for (int i = 0; i < TRIALS; i++) {
        check_seed = (uint64_t)i;
        random_robot a;
        make_random_robot(&s, &a);
        size_t count = 0;
        for (uint32_t k = 0; k < a.d.link_count; k++)
            if (random_below(&s, 3) == 0)
                a.elements[count++] =
                    (ovoid_robot_element){k, NULL, shapes[random_below(&s, SHAPES - 1)], random_pose(&s, 0.1), NULL};
        a.d.element_count = count;
        ovoid_robot *r = ovoid_robot_create(&a.d, NULL, &error);
        ovoid_robot_cell *cell = ovoid_robot_cell_create(r, NULL, &error);
        if (!cell) exit(1);
        for (int k = 0; k < OBSTACLES && i % 5; k++) {
            ovoid_body b = {.shape = shapes[random_below(&s, SHAPES - 1)], .pose = random_pose(&s, 0.7)};
            CHECK(ovoid_robot_cell_add(cell, &b, &error) != 0);
        }
        CHECK_EQ(ovoid_robot_cell_set_padding(cell, random_below(&s, (uint32_t)a.d.link_count), 0.02, &error),
                 OVOID_OK);
        ovoid_robot_checker *x = ovoid_robot_checker_create(cell, NULL, &error);
        size_t n = ovoid_robot_get_variable_count(r), length = 1 + random_below(&s, 3);
        make_random_state(&s, r, states);
        for (size_t k = 1; k < length; k++)
            for (size_t v = 0; v < n; v++) {
                ovoid_robot_variable is = ovoid_robot_get_variable(r, v);
                int floats = a.joints[is.joint].type == OVOID_JOINT_FLOATING;
                double next = states[(k - 1) * n + v] + (floats ? 0 : random_uniform(&s, -0.4, 0.4));
                states[k * n + v] = fmin(fmax(next, is.lower), is.upper);
            }
        ovoid_robot_path path = {states, length};
        ovoid_robot_path_options o = {
            .query = {.limit_slack = 1e-9, .without_obstacles = i % 7 == 0, .without_self = i % 2}, .tolerance = 0.01};
        ovoid_robot_clearance is;
        ovoid_code code = ovoid_robot_path_compute_clearance(x, &(ovoid_robot_path_query){&path, &o}, &is, &error);
        if (CHECK_EQ(code, OVOID_OK)) compare(x, n, &path, &o, &is);
        ovoid_robot_checker_destroy(x);
        ovoid_robot_cell_destroy(cell);
        ovoid_robot_destroy(r);
    }
    check_seed = 0;
}

// A ball of radius 0.1 turns about the origin at a distance of 1; a wall, a box of half sizes 0.1, stands at x = 2 with
// its face at 1.9: nearest at the angle 0, where the clearance is 1.9 - 1.1. Three states: the nearest is inside a
// segment.
static void test_hinge(void) {
    const ovoid_robot_link links[2] = {{"base"}, {"arm"}};
    const ovoid_robot_joint joint = {"hinge", OVOID_JOINT_REVOLUTE, 0, 1, {{0, 0, 0}, {1, 0, 0, 0}}, {0, 0, 1}, -3, 3,
                                     0,       OVOID_ROBOT_NONE,     1, 0};
    const ovoid_robot_element element = {1, NULL, shapes[1], {{1, 0, 0}, {1, 0, 0, 0}}, NULL};
    const ovoid_robot_description d = {
        .links = links, .link_count = 2, .joints = &joint, .joint_count = 1, .elements = &element, .element_count = 1};
    ovoid_robot *r = ovoid_robot_create(&d, NULL, &error);
    ovoid_robot_cell *cell = ovoid_robot_cell_create(r, NULL, &error);
    ovoid_body wall = {.shape = shapes[3], .pose = {{2, 0, 0}, {1, 0, 0, 0}}};
    ovoid_id id = ovoid_robot_cell_add(cell, &wall, &error);
    ovoid_robot_checker *x = ovoid_robot_checker_create(cell, NULL, &error);
    const double q[3] = {-2, -1.1, 1.3};
    ovoid_robot_path path = {q, 3};
    double before = 0;
    for (double tolerance = 0.1; tolerance > 1e-7; tolerance /= 10) {
        ovoid_robot_path_options o = {.query = {.margin = 0.5}, .tolerance = tolerance};
        ovoid_robot_clearance is;
        CHECK_EQ(ovoid_robot_path_compute_clearance(x, &(ovoid_robot_path_query){&path, &o}, &is, &error), OVOID_OK);
        CHECK(is.lower <= 0.8 && is.upper >= 0.8 && is.upper - is.lower <= tolerance * (1 + 1e-6));
        CHECK_EQ(is.status, OVOID_ROBOT_FREE);
        CHECK(is.a.link == 1 && is.b.body == id);
        if (tolerance < 1e-3) CHECK(fabs(is.at - (1 + 1.1 / 2.4)) < 0.05);
        CHECK(before == 0 || is.states < 8 * before); // a search that is exhaustive would take ten times as many
        before = is.states;
    }
    ovoid_robot_clearance is;
    // Nearer, the ball's middle comes to 0.05 from the wall's face.
    CHECK_EQ(ovoid_robot_cell_move(cell, id, &(ovoid_pose){{1.15, 0, 0}, {1, 0, 0, 0}}, &error), OVOID_OK);
    CHECK_EQ(ovoid_robot_path_compute_clearance(
                 x, &(ovoid_robot_path_query){&path, &(ovoid_robot_path_options){.tolerance = 1e-5}}, &is, &error),
             OVOID_OK);
    CHECK(is.lower <= -0.05 && is.upper >= -0.05 && is.upper - is.lower <= 1.001e-5 && is.status == OVOID_ROBOT_HIT);
    CHECK_EQ(ovoid_robot_cell_move(cell, id, &wall.pose, &error), OVOID_OK);
    ovoid_robot_path_options o = {.query = {.margin = 0.9}};
    CHECK_EQ(ovoid_robot_path_compute_clearance(x, &(ovoid_robot_path_query){&path, &o}, &is, &error), OVOID_OK);
    CHECK_EQ(is.status, OVOID_ROBOT_HIT);
    // The padding is a part of the link; so deep inside that the ball is met.
    CHECK_EQ(ovoid_robot_cell_set_padding(cell, 1, 0.3, &error), OVOID_OK);
    CHECK_EQ(ovoid_robot_path_compute_clearance(x, &(ovoid_robot_path_query){&path, NULL}, &is, &error), OVOID_OK);
    CHECK(is.lower <= 0.5 && is.upper >= 0.5);
    // Few states: the bracket is wide, and right.
    o = (ovoid_robot_path_options){.states = 7, .tolerance = 1e-9};
    CHECK_EQ(ovoid_robot_path_compute_clearance(x, &(ovoid_robot_path_query){&path, &o}, &is, &error), OVOID_OK);
    CHECK(is.lower < 0.5 && is.upper >= 0.5 && is.states == 7);
    // Refused: a limit; no tolerance.
    const double far[2] = {0, 4};
    path = (ovoid_robot_path){far, 2};
    CHECK_EQ(ovoid_robot_path_compute_clearance(x, &(ovoid_robot_path_query){&path, NULL}, &is, &error), OVOID_OK);
    CHECK(is.status == OVOID_ROBOT_REFUSED && is.code == OVOID_ERROR_RANGE && is.upper == INFINITY);
    o.tolerance = NAN;
    CHECK_EQ(ovoid_robot_path_compute_clearance(x, &(ovoid_robot_path_query){&path, &o}, &is, &error),
             OVOID_ERROR_ARGUMENT);
    path.count = 0;
    CHECK_EQ(ovoid_robot_path_compute_clearance(x, &(ovoid_robot_path_query){&path, NULL}, &is, &error),
             OVOID_ERROR_ARGUMENT);
    // No pair.
    CHECK_EQ(ovoid_robot_cell_remove(cell, id, &error), OVOID_OK);
    path = (ovoid_robot_path){q, 1};
    CHECK_EQ(ovoid_robot_path_compute_clearance(x, &(ovoid_robot_path_query){&path, NULL}, &is, &error), OVOID_OK);
    CHECK(is.lower == INFINITY && is.upper == INFINITY && is.status == OVOID_ROBOT_UNDECIDED);
    CHECK_EQ(is.code, OVOID_ERROR_EMPTY);
    ovoid_robot_checker_destroy(x);
    ovoid_robot_cell_destroy(cell);
    ovoid_robot_destroy(r);
}

int main(void) {
    shapes[0] = ovoid_shape_create_box((ovoid_vec3){0.1, 0.05, 0.2}, NULL, &error);
    shapes[1] = ovoid_shape_create_sphere(0.1, NULL, &error);
    shapes[2] = ovoid_shape_create_capsule(0.03, 0.2, NULL, &error);
    shapes[3] = ovoid_shape_create_box((ovoid_vec3){0.1, 0.1, 0.1}, NULL, &error);
    test_hinge();
    test_random();
    printf("%ld of %d brackets as narrow as was asked, %ld of overlaps\n", narrow, TRIALS, overlaps);
    CHECK(narrow > TRIALS / 2 && overlaps > 4);
    for (int i = 0; i < SHAPES; i++) ovoid_shape_destroy(shapes[i]);
    return check_end();
}
