// States that hit: the brackets of answers that ellipsoids prove, and hits among many near pairs. Truth: ovoid_depth of
// the two bodies at their poses, whose bracket is 1e-11 wide; the second test's obstacles are outside by their corners.
#include "check.h"
#include "robots.h"

enum { SHAPES = 5 };
static ovoid_error error;

// A body that flies, and its cell.
typedef struct flyer {
    ovoid_robot *robot;
    ovoid_robot_cell *cell;
    ovoid_robot_checker *checker;
} flyer;

static flyer make_flyer(const ovoid_shape *shape, const ovoid_body *obstacles, size_t count) {
    ovoid_robot_link links[2] = {{"world"}, {"body"}};
    ovoid_robot_joint joint = {.name = "fly",
                               .type = OVOID_JOINT_FLOATING,
                               .parent = 0,
                               .child = 1,
                               .origin = ovoid_pose_make_identity(),
                               .mimic = OVOID_ROBOT_NONE};
    ovoid_robot_element element = {1, NULL, shape, {{0.1, -0.2, 0.05}, {1, 0.2, -0.3, 0.4}}, NULL};
    ovoid_robot_description d = {
        .links = links, .link_count = 2, .joints = &joint, .joint_count = 1, .elements = &element, .element_count = 1};
    flyer f = {.robot = ovoid_robot_create(&d, NULL, &error)};
    f.cell = f.robot ? ovoid_robot_cell_create(f.robot, NULL, &error) : NULL;
    for (size_t i = 0; f.cell && i < count; i++) CHECK(ovoid_robot_cell_add(f.cell, &obstacles[i], &error) != 0);
    f.checker = f.cell ? ovoid_robot_checker_create(f.cell, NULL, &error) : NULL;
    if (!f.checker) exit(1);
    return f;
}

static void destroy_flyer(flyer *f) {
    ovoid_robot_checker_destroy(f->checker);
    ovoid_robot_cell_destroy(f->cell);
    ovoid_robot_destroy(f->robot);
}

static long hits, wide; // wide: those of ellipsoids, and others that were not measured

static void compare(const flyer *f, const ovoid_shape *a, const ovoid_body *b, const double q[7]) {
    ovoid_robot_answer is;
    ovoid_pose links[2];
    ovoid_robot_checker_reset(f->checker);
    CHECK_EQ(ovoid_robot_collide(f->checker,
                                 &(ovoid_robot_query){q, &(ovoid_robot_query_options){.limit_slack = INFINITY}}, &is,
                                 &error),
             OVOID_OK);
    CHECK_EQ(ovoid_robot_compute_poses(f->robot, q, links, &error), OVOID_OK);
    ovoid_pose in_link = {{0.1, -0.2, 0.05}, {1, 0.2, -0.3, 0.4}};
    ovoid_pair pair = {a, b->shape, ovoid_pose_compute_product(&links[1], &in_link), b->pose};
    ovoid_answer truth = ovoid_depth(&pair, NULL, NULL, NULL);
    // An allowance may hide a hit that only the depth would show.
    int is_exact = truth.upper - truth.lower < 1e-6;
    if (truth.upper < -1e-9 && is_exact) CHECK_EQ(is.status, OVOID_ROBOT_HIT);
    if (truth.upper < -1e-9) CHECK(is.status != OVOID_ROBOT_FREE);
    if (truth.lower > 1e-9) CHECK_EQ(is.status, OVOID_ROBOT_FREE);
    if (is.status != OVOID_ROBOT_HIT) return;
    // Of a body that may be smaller than its shape the smallest counts.
    CHECK_LE(truth.upper, 1e-9);
    CHECK_LE(truth.lower, is.upper + 1e-11);
    CHECK_LE(is.lower, truth.upper + 1e-11);
    hits++;
    wide += is.upper - is.lower > 1e-6;
}

static void test_brackets(ovoid_shape *const shapes[SHAPES], uint64_t *s) {
    for (int i = 0; i < SHAPES * SHAPES; i++) {
        const ovoid_shape *a = shapes[i / SHAPES];
        ovoid_body b = {.shape = shapes[i % SHAPES], .pose = random_pose(s, 0.5)};
        flyer f = make_flyer(a, &b, 1);
        for (int k = 0; k < 150; k++) {
            // Deep: the element's origin near the obstacle's, its rotation at times the same.
            ovoid_pose pose = random_pose(s, k % 3 == 0 ? 1e-4 : 0.15),
                       in_link = {{0.1, -0.2, 0.05}, {1, 0.2, -0.3, 0.4}};
            ovoid_vec3 p = pose.position, at = b.pose.position;
            pose.position = (ovoid_vec3){p.x + at.x, p.y + at.y, p.z + at.z};
            if (k % 2) pose.rotation = b.pose.rotation;
            ovoid_pose back = ovoid_pose_compute_inverse(&in_link);
            ovoid_pose link = ovoid_pose_compute_product(&pose, &back);
            const double q[7] = {link.position.x, link.position.y, link.position.z, link.rotation.w,
                                 link.rotation.x, link.rotation.y, link.rotation.z};
            check_seed = (uint64_t)(1000 * i + k);
            compare(&f, a, &b, q);
        }
        destroy_flyer(&f);
    }
    check_seed = 0;
    CHECK_LE(1000, hits);
    CHECK_LE(500, wide);
}

// Beads in the corner of a tetrahedron's box, which the tetrahedron does not reach into; one more is within it.
static void test_many(void) {
    enum { BEADS = 24 };
    const double xyz[12] = {-1, -1, -1, 1, -1, -1, -1, 1, -1, -1, -1, 1};
    ovoid_shape *tetrahedron = ovoid_shape_create_from_points(xyz, 4, NULL, &error);
    ovoid_shape *bead = ovoid_shape_create_sphere(0.01, NULL, &error);
    ovoid_body beads[BEADS + 1];
    ovoid_pose place = {{0.1, -0.2, 0.05}, {1, 0.2, -0.3, 0.4}};
    for (int i = 0; i <= BEADS; i++) {
        ovoid_vec3 p = {0.3 + 0.02 * (i % 5), 0.3 + 0.02 * (i / 5), 0.3};
        if (i == BEADS) p = (ovoid_vec3){-0.6, -0.6, -0.6};
        beads[i] = (ovoid_body){.shape = bead, .pose = {ovoid_pose_compute_point(&place, p), {1, 0, 0, 0}}};
    }
    const double q[7] = {0, 0, 0, 1, 0, 0, 0};
    for (size_t count = BEADS; count <= BEADS + 1; count++) {
        flyer f = make_flyer(tetrahedron, beads, count);
        ovoid_robot_query_options options = {.limit_slack = INFINITY};
        ovoid_robot_answer is;
        CHECK_EQ(ovoid_robot_collide(f.checker, &(ovoid_robot_query){q, &options}, &is, &error), OVOID_OK);
        CHECK_EQ(is.status, count > BEADS ? OVOID_ROBOT_HIT : OVOID_ROBOT_FREE);
        destroy_flyer(&f);
    }
    ovoid_shape_destroy(tetrahedron);
    ovoid_shape_destroy(bead);
}

int main(void) {
    uint64_t s = 31;
    const ovoid_shape_options smaller = {.allowance = {.outside = 0.001, .inside = 0.05}};
    double xyz[60];
    for (int i = 0; i < 60; i++) xyz[i] = random_uniform(&s, -0.2, 0.2);
    ovoid_shape *shapes[SHAPES] = {
        ovoid_shape_create_box((ovoid_vec3){0.1, 0.05, 0.2}, NULL, &error),
        ovoid_shape_create_from_points(xyz, 20, NULL, &error),
        ovoid_shape_create_from_points(xyz, 12, &(ovoid_shape_options){.radius = 0.03}, &error),
        ovoid_shape_create_cylinder(0.1, 0.2, NULL, &error),
        ovoid_shape_create_box((ovoid_vec3){0.1, 0.15, 0.1}, &smaller, &error)};
    for (int i = 0; i < SHAPES; i++)
        if (!shapes[i]) exit(1);
    test_brackets(shapes, &s);
    test_many();
    printf("%ld hits, %ld with wide brackets\n", hits, wide);
    for (int i = 0; i < SHAPES; i++) ovoid_shape_destroy(shapes[i]);
    return check_end();
}
