// Spheres of links: audits and covers. Truth: closed forms of cubes, balls and capsules; random points of random
// bodies, whose values and shares may contradict no bracket; and for covers the audit, which is so tested.
#include "check.h"
#include "countdown.h"
#include "ovoid/robot_spheres.h"
#include "robot/spheres/spheres.h"

static ovoid_error error;
static const double pi = 3.14159265358979323846;

// A robot of one link with these elements; their shapes become its.
static ovoid_robot *make_robot(const ovoid_robot_element *elements, size_t count) {
    ovoid_robot_link link = {"link"};
    ovoid_robot_description d = {.links = &link, .link_count = 1, .elements = elements, .element_count = count};
    ovoid_robot *r = ovoid_robot_create(&d, &(ovoid_robot_options){.takes_shapes = 1}, &error);
    CHECK(r != NULL);
    return r;
}

static ovoid_robot *make_posed(ovoid_shape *shape, ovoid_pose pose) {
    CHECK(shape != NULL);
    ovoid_robot_element e = {0, NULL, shape, pose, NULL};
    return make_robot(&e, 1);
}

static ovoid_robot *make_single(ovoid_shape *shape) { return make_posed(shape, ovoid_pose_make_identity()); }

static ovoid_robot *make_cube(void) { return make_single(ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, &error)); }

static int is_ordered(ovoid_robot_bracket b) { return b.lower <= b.upper; }

// Of searches for the depth alone, and of volumes to some per cent.
static const ovoid_robot_audit_options depth_alone = {.without_volumes = 1}, coarse = {.volume_cells = 8192},
                                       medium = {.volume_cells = 1 << 14};

static ovoid_robot_sphere_audit audit(const ovoid_robot *r, const ovoid_robot_sphere *s, size_t count,
                                      const ovoid_robot_audit_options *options) {
    ovoid_robot_sphere_audit a;
    CHECK_EQ(ovoid_robot_compute_sphere_audit(&(ovoid_robot_sphere_model){r, 0, s, count}, options, &a, &error),
             OVOID_OK);
    CHECK(is_ordered(a.depth) && is_ordered(a.uncovered) && is_ordered(a.excess) && is_ordered(a.link));
    CHECK(is_ordered(a.spheres));
    return a;
}

// The bracket holds the value, which is known to 1e-12 of it, and is no wider than said.
static void check_bracket(ovoid_robot_bracket b, double value, double width) {
    double known = 1e-12 * fabs(value) + 1e-300;
    CHECK_LE(b.lower, value + known);
    CHECK_LE(value - known, b.upper);
    CHECK_LE(b.upper - b.lower, width);
}

static double get_ball_volume(double r) { return 4.0 / 3 * pi * r * r * r; }

// The volume of the cap of that height.
static double get_cap_volume(double r, double h) { return pi * h * h * (3 * r - h) / 3; }

// A cube of half sizes 1 and one ball at its centre: the corners are the deepest. A ball of radius 1.2 stands out of
// each face by a cap; those do not meet.
static void test_cube(void) {
    ovoid_robot *r = make_cube();
    ovoid_robot_sphere ball = {{0, 0, 0}, sqrt(3) * (1 + 1e-12)};
    ovoid_robot_sphere_audit a = audit(r, &ball, 1, &coarse);
    CHECK_LE(a.depth.upper, 0.0);
    check_bracket(a.uncovered, 0, 0.01);
    check_bracket(a.excess, get_ball_volume(sqrt(3)) - 8, 0.6);
    check_bracket(a.link, 8, 0.1);
    ball.radius = sqrt(3) * (1 - 1e-12);
    a = audit(r, &ball, 1, &depth_alone);
    CHECK(a.depth.lower > 0);
    ball.radius = 1.2;
    a = audit(r, &ball, 1, &medium);
    check_bracket(a.depth, sqrt(3) - 1.2, 1e-11);
    check_bracket(a.excess, 6 * get_cap_volume(1.2, 0.2), 0.25);
    check_bracket(a.uncovered, 8 - get_ball_volume(1.2) + 6 * get_cap_volume(1.2, 0.2), 0.25);
    check_bracket(a.spheres, get_ball_volume(1.2), 0.25);
    CHECK_EQ(a.element, 0u);
    CHECK_NEAR(fabs(a.point.x) + fabs(a.point.y) + fabs(a.point.z), 3, 1e-12);
    ovoid_robot_destroy(r);
}

// A tolerance that cannot be met: cells end when they are too small to be halved, and count all the same. Truth: the
// distance of the cube's farthest corner from the ball's centre, in long double, without slack.
static void test_settled(void) {
    uint64_t random = 5;
    ovoid_robot *r = make_cube();
    const ovoid_robot_audit_options endless = {.tolerance = 1e-300, .without_volumes = 1};
    for (int i = 0; i < 10; i++) {
        check_seed = (uint64_t)i;
        ovoid_robot_sphere ball = {{random_uniform(&random, -0.9, 0.9), random_uniform(&random, -0.9, 0.9),
                                    random_uniform(&random, -0.9, 0.9)},
                                   random_uniform(&random, 0, 2)};
        ovoid_robot_sphere_audit a = audit(r, &ball, 1, &endless);
        long double x = 1 + fabsl((long double)ball.center.x), y = 1 + fabsl((long double)ball.center.y),
                    z = 1 + fabsl((long double)ball.center.z);
        long double deepest = sqrtl(x * x + y * y + z * z) - (long double)ball.radius;
        CHECK(a.depth.lower <= deepest && deepest <= a.depth.upper);
        CHECK_LE(a.depth.upper - a.depth.lower, 1e-11);
    }
    check_seed = 0;
    ovoid_robot_destroy(r);
}

// Where two balls meet inside a cube: the deepest points are on an edge of the cube, not at a vertex. Eight balls at
// the corners' octants with a hole at the centre: the deepest point is inside.
static void test_inner_points(void) {
    ovoid_robot *r = make_cube();
    ovoid_robot_sphere two[2] = {{{0.8, 0, 0}, 1.45}, {{-0.8, 0, 0}, 1.45}};
    ovoid_robot_sphere_audit a = audit(r, two, 2, &depth_alone);
    check_bracket(a.depth, sqrt(2.64) - 1.45, 1e-4);
    CHECK_NEAR(a.point.x, 0, 1e-3);
    ovoid_robot_sphere eight[8];
    for (int i = 0; i < 8; i++)
        eight[i] = (ovoid_robot_sphere){{i & 1 ? 0.7 : -0.7, i & 2 ? 0.7 : -0.7, i & 4 ? 0.7 : -0.7}, 1.1};
    a = audit(r, eight, 8, &depth_alone);
    check_bracket(a.depth, sqrt(3 * 0.49) - 1.1, 1e-4);
    CHECK_NEAR(a.point.x, 0, 1e-3);
    ovoid_robot_destroy(r);
}

// Two balls, as a link and its sphere: the lens that both share, in closed form.
static void test_round(void) {
    ovoid_robot *ball = make_single(ovoid_shape_create_sphere(1, NULL, &error));
    ovoid_robot_sphere s = {{0.5, 0, 0}, 1.25};
    ovoid_robot_sphere_audit a = audit(ball, &s, 1, &medium);
    check_bracket(a.depth, 0.25, 1e-4);
    double x = (1 - 1.5625 + 0.25) / (2 * 0.5),
           lens = get_cap_volume(1, 1 - x) + get_cap_volume(1.25, 1.25 - (0.5 - x));
    check_bracket(a.uncovered, get_ball_volume(1) - lens, 0.15);
    check_bracket(a.excess, get_ball_volume(1.25) - lens, 0.25);
    s.radius = 1.5 + 1e-9;
    a = audit(ball, &s, 1, &depth_alone);
    CHECK_LE(a.depth.upper, 0.0);
    ovoid_robot_destroy(ball);
    ovoid_robot *pill = make_single(ovoid_shape_create_capsule(0.5, 1, NULL, &error));
    ovoid_robot_sphere two[2] = {{{0, 0, 0.6}, 0.8}, {{0, 0, -0.6}, 0.8}};
    a = audit(pill, two, 2, &medium);
    check_bracket(a.depth, 0.1, 1e-4);
    check_bracket(a.link, get_ball_volume(0.5) + pi * 0.25 * 2, 0.08);
    ovoid_robot_destroy(pill);
}

// Allowances: a true cylinder stands out of its prism, a true body may be less than its shape.
static void test_allowance(void) {
    const ovoid_robot_audit_options quick = {.depth_cells = 2048, .volume_cells = 4096};
    ovoid_robot *cylinder = make_single(ovoid_shape_create_cylinder(1, 1, NULL, &error));
    ovoid_robot_sphere s = {{0, 0, 0}, 1.3};
    ovoid_robot_sphere_audit a = audit(cylinder, &s, 1, &quick);
    check_bracket(a.depth, sqrt(2) - 1.3, 0.01);
    check_bracket(a.link, 2 * pi, 0.5);
    s.radius = sqrt(2) * (1 + 1e-9); // holds the prism, but is not proven to hold all that it may stand for
    a = audit(cylinder, &s, 1, &(ovoid_robot_audit_options){.depth_cells = 2048, .without_volumes = 1});
    CHECK(a.depth.upper > 0);
    ovoid_robot_destroy(cylinder);
    ovoid_shape_options less = {.allowance = {.inside = 0.1}};
    ovoid_robot *less_box = make_single(ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, &less, &error));
    s.radius = 1.3;
    a = audit(less_box, &s, 1, &coarse);
    CHECK_NEAR(a.depth.lower, sqrt(3) - 1.3 - 0.1, 1e-9);
    CHECK_NEAR(a.depth.upper, sqrt(3) - 1.3, 1e-9);
    CHECK_NEAR(a.link.lower, 5.832, 0.05); // a box of half sizes 0.9
    CHECK_LE(a.link.lower, 5.832);
    CHECK_LE(8.0, a.link.upper);
    ovoid_robot_destroy(less_box);
}

/// A body to draw points of: hulls of at most 12 points with a radius.
typedef struct cloud {
    double xyz[2][36], radius[2];
    size_t points[2], parts;
} cloud;

// Solids, rounded ones, flat ones, needles, and two parts that overlap, in turn.
static cloud make_cloud(uint64_t *random, int kind) {
    cloud c = {.parts = kind % 5 == 4 ? 2 : 1};
    for (size_t part = 0; part < c.parts; part++) {
        c.points[part] = 4 + random_next(random) % 9;
        c.radius[part] = kind % 5 == 1 ? random_uniform(random, 0, 0.5) : 0;
        for (size_t i = 0; i < 3 * c.points[part]; i++) {
            double thin = kind % 5 == 2 && i % 3 == 2 ? 0 : kind % 5 == 3 && i % 3 ? 1e-5 : 1;
            c.xyz[part][i] = thin * random_normal(random);
        }
    }
    return c;
}

static ovoid_robot *make_from_cloud(const cloud *c, ovoid_pose pose) {
    ovoid_robot_element e[2];
    for (size_t part = 0; part < c->parts; part++) {
        ovoid_shape_options o = {.radius = c->radius[part]};
        e[part] = (ovoid_robot_element){
            0, NULL, ovoid_shape_create_from_points(c->xyz[part], c->points[part], &o, &error), pose, NULL};
    }
    return make_robot(e, c->parts);
}

// A point of a part: few vertices weigh much in one of two, so that edges and faces are seen too.
static ovoid_vec3 draw_point(const cloud *c, uint64_t *random) {
    size_t part = random_next(random) % c->parts;
    double sum = 0, few = random_uniform(random, 0, 1) < 0.5 ? 8 : 1;
    ovoid_vec3 p = {0, 0, 0};
    for (size_t i = 0; i < c->points[part]; i++) {
        double w = pow(random_uniform(random, 0, 1), few * few);
        const double *v = c->xyz[part] + 3 * i;
        sum += w, p.x += w * v[0], p.y += w * v[1], p.z += w * v[2];
    }
    ovoid_vec3 n = {random_normal(random), random_normal(random), random_normal(random)};
    double step = c->radius[part] / sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
    return (ovoid_vec3){p.x / sum + n.x * step, p.y / sum + n.y * step, p.z / sum + n.z * step};
}

static double compute_value(const ovoid_robot_sphere *s, size_t count, ovoid_vec3 x) {
    double least = INFINITY;
    for (size_t i = 0; i < count; i++) {
        double dx = x.x - s[i].center.x, dy = x.y - s[i].center.y, dz = x.z - s[i].center.z;
        least = fmin(least, sqrt(dx * dx + dy * dy + dz * dz) - s[i].radius);
    }
    return least;
}

// No point of a body lies deeper than the upper bound, and the point that shows the lower one has its value. 10^5
// points.
static void test_points(void) {
    for (uint64_t seed = 1; seed <= 50; seed++) {
        uint64_t random = check_seed = seed;
        cloud c = make_cloud(&random, (int)seed);
        ovoid_vec3 place = {random_normal(&random), 0, 2}, turn = {random_normal(&random), random_normal(&random), 1};
        ovoid_pose pose = ovoid_pose_make_rpy(place, turn);
        ovoid_robot *r = make_from_cloud(&c, pose);
        ovoid_robot_sphere s[40];
        size_t count = 1 + random_next(&random) % 40;
        for (size_t i = 0; i < count; i++)
            s[i] = (ovoid_robot_sphere){ovoid_pose_compute_point(&pose, draw_point(&c, &random)),
                                        random_uniform(&random, 0, 1)};
        ovoid_robot_audit_options o = {.depth_cells = seed % 3 ? 4096 : 64, .without_volumes = 1};
        ovoid_robot_sphere_audit a = audit(r, s, count, &o);
        double worst = -INFINITY;
        for (int i = 0; i < 2000; i++)
            worst = fmax(worst, compute_value(s, count, ovoid_pose_compute_point(&pose, draw_point(&c, &random))));
        CHECK_LE(worst, a.depth.upper + 1e-14);
        CHECK_LE(a.depth.lower, compute_value(s, count, a.point) + 1e-14);
        CHECK_NEAR(compute_value(s + a.sphere, 1, a.point), compute_value(s, count, a.point), 1e-12);
        if (seed % 3) CHECK_LE(a.depth.upper - a.depth.lower, 0.02);
        ovoid_robot_destroy(r);
    }
    check_seed = 0;
}

// Shares of uniform points of a box, against the volumes of two cubes that overlap: 10^5 points, five deviations.
static void test_shares(void) {
    uint64_t random = check_seed = 7;
    ovoid_robot_element e[2] = {
        {0, NULL, ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, &error), ovoid_pose_make_identity(), NULL},
        {0, NULL, ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, &error), ovoid_pose_make_identity(), NULL}};
    e[1].pose.position = (ovoid_vec3){1.2, 0.5, 0.25};
    ovoid_robot *r = make_robot(e, 2);
    ovoid_robot_sphere s[6];
    for (int i = 0; i < 6; i++) {
        ovoid_vec3 c = {random_uniform(&random, -1, 2), random_uniform(&random, -1, 1.5),
                        random_uniform(&random, -1, 1)};
        s[i] = (ovoid_robot_sphere){c, random_uniform(&random, 0.3, 1)};
    }
    ovoid_robot_sphere_audit a = audit(r, s, 6, &medium);
    long uncovered = 0, excess = 0, count = 100000;
    for (long i = 0; i < count; i++) {
        ovoid_vec3 x = {random_uniform(&random, -2.5, 3.5), random_uniform(&random, -2.5, 3.5),
                        random_uniform(&random, -2.5, 3.5)};
        int in = (fabs(x.x) <= 1 && fabs(x.y) <= 1 && fabs(x.z) <= 1) ||
                 (fabs(x.x - 1.2) <= 1 && fabs(x.y - 0.5) <= 1 && fabs(x.z - 0.25) <= 1);
        int held = compute_value(s, 6, x) <= 0;
        uncovered += in && !held, excess += held && !in;
    }
    double unit = 216.0 / (double)count;
    CHECK_LE(a.uncovered.lower, unit * ((double)uncovered + 5 * sqrt((double)uncovered)));
    CHECK_LE(unit * ((double)uncovered - 5 * sqrt((double)uncovered)), a.uncovered.upper);
    CHECK_LE(a.excess.lower, unit * ((double)excess + 5 * sqrt((double)excess)));
    CHECK_LE(unit * ((double)excess - 5 * sqrt((double)excess)), a.excess.upper);
    check_bracket(a.link, 16 - 0.8 * 1.5 * 1.75, 0.5);
    CHECK_LE(a.uncovered.upper - a.uncovered.lower, 0.6);
    ovoid_robot_destroy(r);
    check_seed = 0;
}

// A uniform point of a tetrahedron, by weights.
static void draw_weights(uint64_t *random, double w[4]) {
    double sum = 0;
    for (int i = 0; i < 4; i++) sum += w[i] = -log(1 - random_uniform(random, 0, 1));
    for (int i = 0; i < 4; i++) w[i] /= sum;
}

// What a plane cuts off a cell, against the share of 20 000 points, five deviations.
static void test_share_of_plane(void) {
    uint64_t random = check_seed = 11;
    for (int trial = 0; trial < 30; trial++) {
        double value[4], w[4], n = 20000, held = 0;
        for (int i = 0; i < 4; i++) value[i] = random_uniform(&random, -1, 1);
        for (int i = 0; i < (int)n; i++) {
            draw_weights(&random, w);
            held += value[0] * w[0] + value[1] * w[1] + value[2] * w[2] + value[3] * w[3] <= 0;
        }
        CHECK_NEAR(spheres_compute_share(value), held / n, 5 * sqrt(0.25 / n));
    }
    check_seed = 0;
}

// Two balls that are flat beside a small cell and hold different corners of it: 1 - 0.8^3 each, and together what
// points say.
static void test_share_of_balls(void) {
    uint64_t random = check_seed = 12;
    const double h = 1e-3, n = 20000;
    spheres_link link = {.unit = 1, .memory = allocator_make(NULL)};
    ovoid_robot_sphere balls[2] = {{{-1 + 0.2 * h, 0, 0}, 1}, {{0, -1 + 0.2 * h, 0}, 1}};
    spheres_tree tree;
    CHECK_EQ(spheres_tree_open(&tree, balls, 2, &link, &error), OVOID_OK);
    spheres_cell cell = {.corner = {{0, 0, 0}, {h, 0, 0}, {0, h, 0}, {0, 0, h}}};
    sphere_of_cell around = spheres_cell_find_around(&cell);
    ovoid_robot_bracket share = spheres_tree_find_share(&tree, &cell, &around);
    double held = 0;
    for (int i = 0; i < (int)n; i++) {
        double w[4];
        draw_weights(&random, w);
        held += w[1] <= 0.2 || w[2] <= 0.2;
    }
    CHECK_LE(held / n - 5 * sqrt(0.25 / n), share.upper);
    CHECK_LE(share.lower, held / n + 5 * sqrt(0.25 / n));
    CHECK_NEAR(share.lower, 1 - 0.8 * 0.8 * 0.8, 2e-3);
    spheres_tree_close(&tree);
    check_seed = 0;
}

// A thousand spheres on a grid over a cube: the deepest points are the centres of the grid's cells.
static void test_thousand(void) {
    ovoid_robot *r = make_cube();
    static ovoid_robot_sphere s[1000];
    for (int i = 0; i < 1000; i++) {
        ovoid_vec3 c = {-0.9 + 0.2 * (i % 10), -0.9 + 0.2 * (i / 10 % 10), -0.9 + 0.2 * (i / 100)};
        s[i] = (ovoid_robot_sphere){c, 0.15};
    }
    ovoid_robot_sphere_audit a =
        audit(r, s, 1000, &(ovoid_robot_audit_options){.depth_cells = 1 << 14, .without_volumes = 1});
    CHECK_LE(a.depth.lower, 0.1 * sqrt(3) - 0.15 + 1e-12);
    CHECK_LE(0.1 * sqrt(3) - 0.15 - 1e-12, a.depth.upper);
    CHECK_LE(a.depth.upper - a.depth.lower, 0.08);
    ovoid_robot_destroy(r);
}

// A body a power of two larger has brackets as much larger, bit for bit, and no scale is hard.
static void test_scales(void) {
    static const double points[12] = {0, 0, 0, 1, 0, 0.5, 0, 1, 0, 0.25, 0, 1};
    static const int exponents[5] = {0, -30, 30, -300, 120};
    ovoid_robot_sphere_audit first = {.cells = 0};
    for (int i = 0; i < 5; i++) {
        double unit = ldexp(1, exponents[i]), xyz[12];
        for (int k = 0; k < 12; k++) xyz[k] = points[k] * unit;
        ovoid_shape_options o = {.radius = 0.125 * unit};
        ovoid_robot *r = make_single(ovoid_shape_create_from_points(xyz, 4, &o, &error));
        ovoid_robot_sphere s[2] = {{{0.5 * unit, 0, 0.5 * unit}, 0.75 * unit}, {{0, unit, 0}, 0.25 * unit}};
        ovoid_robot_sphere_audit a =
            audit(r, s, 2, &(ovoid_robot_audit_options){.depth_cells = 4096, .volume_cells = 4096});
        if (i == 0) first = a;
        CHECK_NEAR(a.depth.lower / unit, first.depth.lower, 1e-4);
        CHECK_NEAR(a.depth.upper / unit, first.depth.upper, 1e-4);
        CHECK(exponents[i] < -100 || fabs(a.excess.upper / unit / unit / unit - first.excess.upper) < 1e-3);
        ovoid_robot_destroy(r);
    }
    const ovoid_robot_audit_options few = {.depth_cells = 2048, .without_volumes = 1};
    // Lengths of 1e-9 and 1e9 in one link: a needle.
    ovoid_robot *needle = make_single(ovoid_shape_create_box((ovoid_vec3){1e9, 1e-9, 1e-9}, NULL, &error));
    ovoid_robot_sphere s = {{0, 0, 0}, 1e9};
    ovoid_robot_sphere_audit a = audit(needle, &s, 1, &few);
    CHECK_NEAR(a.depth.upper, 0, 1e-3);
    // A sphere as far away as a length can be.
    s = (ovoid_robot_sphere){{1e50, 0, 0}, 1};
    a = audit(needle, &s, 1, &few);
    CHECK_NEAR(a.depth.lower / 1e50, 1, 1e-12);
    ovoid_robot_destroy(needle);
}

#define REFUSED(change, code_, place_, words)                                                                          \
    do {                                                                                                               \
        ovoid_robot_sphere s[2] = {{{0, 0, 0}, 1}, {{1, 0, 0}, 1}};                                                    \
        size_t count = 2;                                                                                              \
        uint32_t link = 0;                                                                                             \
        ovoid_robot_audit_options o = {.tolerance = 0};                                                                \
        ovoid_robot_sphere_audit a;                                                                                    \
        change;                                                                                                        \
        CHECK_EQ(ovoid_robot_compute_sphere_audit(&(ovoid_robot_sphere_model){r, link, s, count}, &o, &a, &error),     \
                 code_);                                                                                               \
        CHECK_EQ(error.place, (int64_t)(place_));                                                                      \
        CHECK(strstr(error.message, words) != NULL);                                                                   \
    } while (0)

static void test_refused(void) {
    ovoid_robot_link links[2] = {{"trunk"}, {"frame"}};
    ovoid_robot_joint joint = {"j", OVOID_JOINT_FIXED, 0, 1, ovoid_pose_make_identity(), {0, 0, 1}, 0, 0,
                               0,   OVOID_ROBOT_NONE,  1, 0};
    ovoid_robot_element e = {0, NULL, ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, &error),
                             ovoid_pose_make_identity(), NULL};
    ovoid_robot_description d = {NULL, links, 2, &joint, 1, &e, 1, NULL, 0, NULL};
    ovoid_robot *r = ovoid_robot_create(&d, &(ovoid_robot_options){.takes_shapes = 1}, &error);
    CHECK(r != NULL);
    REFUSED(s[1].center.y = NAN, OVOID_ERROR_NOT_FINITE, 1, "sphere 1");
    REFUSED(s[1].radius = INFINITY, OVOID_ERROR_NOT_FINITE, 1, "sphere 1");
    REFUSED(s[1].radius = -0.5, OVOID_ERROR_RADIUS, 1, "the radius -0.5; it must not be negative");
    REFUSED(s[0].radius = 2e50, OVOID_ERROR_RANGE, 0, "above 1e+50");
    REFUSED(count = 0, OVOID_ERROR_EMPTY, -1, "no spheres");
    REFUSED(link = 2, OVOID_ERROR_INDEX, 2, "there is no link 2");
    REFUSED(link = 1, OVOID_ERROR_EMPTY, 1, "\"frame\" has no collision geometry");
    REFUSED(o.tolerance = -1, OVOID_ERROR_ARGUMENT, -1, "tolerance");
    REFUSED(o.tolerance = NAN, OVOID_ERROR_ARGUMENT, -1, "tolerance");
    REFUSED(o.depth_cells = 3, OVOID_ERROR_ARGUMENT, -1, "fewer than 64 cells");
    REFUSED(o.volume_cells = (size_t)1 << 40, OVOID_ERROR_ARGUMENT, -1, "more than 2^24");
    ovoid_robot_sphere s[1];
    ovoid_robot_sphere_cover cover = {.spheres = s};
    CHECK_EQ(ovoid_robot_compute_sphere_cover(r, NULL, &cover, &error), OVOID_ERROR_ARGUMENT);
    CHECK(strstr(error.message, "give 1 to 4096") != NULL);
    cover.capacity = 1;
    ovoid_robot_cover_options o = {.excess = NAN};
    CHECK_EQ(ovoid_robot_compute_sphere_cover(r, &o, &cover, &error), OVOID_ERROR_ARGUMENT);
    o.excess = 0.5;
    CHECK_EQ(ovoid_robot_compute_sphere_cover(r, &o, &cover, &error), OVOID_ERROR_LIMIT);
    CHECK(strstr(error.message, "give more spheres") != NULL);
    ovoid_robot_destroy(r);
}

static void test_memory(void) {
    ovoid_robot *r = make_cube();
    // What is opened once, then some of the trees of the audits, then all.
    static const long later[] = {40, 120, 400, 1 << 30};
    for (long i = 0, done = 0; !done; i++) {
        long k = i < 30 ? i : later[i - 30];
        countdown c = {k, 0};
        ovoid_allocator allocator = countdown_make_allocator(&c);
        ovoid_robot_audit_options o = {.depth_cells = 64, .volume_cells = 64, .allocator = &allocator};
        ovoid_robot_cover_options p = {.rounds = 8, .allocator = &allocator};
        ovoid_robot_sphere s[3] = {{{0, 0, 0}, 1}};
        ovoid_robot_sphere_audit a;
        ovoid_robot_sphere_cover cover = {.spheres = s, .capacity = 3};
        ovoid_code code = ovoid_robot_compute_sphere_audit(&(ovoid_robot_sphere_model){r, 0, s, 1}, &o, &a, &error);
        CHECK(code == OVOID_OK || code == OVOID_ERROR_MEMORY);
        CHECK_EQ(c.held, 0L);
        c.left = k;
        code = ovoid_robot_compute_sphere_cover(r, &p, &cover, &error);
        CHECK(code == OVOID_OK || code == OVOID_ERROR_MEMORY);
        CHECK_EQ(c.held, 0L);
        done = code == OVOID_OK;
        CHECK(done || i < 33);
        if (i == 33) break;
    }
    ovoid_robot_destroy(r);
}

// Covers are proven, tight where the best one is known, the same for the same seed, and all that is asked of them.
static void test_cover(void) {
    ovoid_robot *r = make_cube();
    static const double most[9] = {0, 14.1, 0, 0, 13.1, 0, 0, 0, 10.5};
    for (size_t n = 1; n <= 8; n *= 2) {
        if (n == 2) continue;
        ovoid_robot_sphere s[8], again[8];
        ovoid_robot_sphere_cover cover = {.spheres = s, .capacity = n};
        ovoid_robot_cover_options o = {.rounds = 100, .seed = 3};
        CHECK_EQ(ovoid_robot_compute_sphere_cover(r, &o, &cover, &error), OVOID_OK);
        CHECK_EQ(cover.count, n);
        CHECK_LE(cover.depth.upper, 0.0);
        ovoid_robot_sphere_audit a = audit(r, s, n, &coarse);
        CHECK_LE(a.depth.upper, 0.0);
        CHECK_LE(-0.01, a.depth.lower); // no radius is much larger than it must be
        CHECK_LE(a.excess.upper, most[n]);
        if (n == 1) CHECK_NEAR(s[0].radius, sqrt(3), 1e-9);
        if (n != 4) continue;
        cover.spheres = again;
        CHECK_EQ(ovoid_robot_compute_sphere_cover(r, &o, &cover, &error), OVOID_OK);
        CHECK(memcmp(s, again, n * sizeof *s) == 0);
    }
    ovoid_robot_destroy(r);
}

static void test_cover_bodies(void) {
    for (uint64_t seed = 1; seed <= 5; seed++) {
        uint64_t random = check_seed = seed;
        cloud c = make_cloud(&random, (int)seed);
        ovoid_robot *r = make_from_cloud(&c, ovoid_pose_make_identity());
        ovoid_robot_sphere s[6];
        ovoid_robot_sphere_cover cover = {.spheres = s, .capacity = 1 + seed % 6};
        ovoid_robot_cover_options o = {.rounds = 20, .seed = seed};
        CHECK_EQ(ovoid_robot_compute_sphere_cover(r, &o, &cover, &error), OVOID_OK);
        double worst = -INFINITY;
        for (int i = 0; i < 10000; i++) worst = fmax(worst, compute_value(s, cover.count, draw_point(&c, &random)));
        CHECK_LE(worst, 1e-14);
        ovoid_robot_destroy(r);
    }
    check_seed = 0;
}

// None stands out by more than asked: a ball's farthest point from a cube is its radius beyond where its centre is.
static void test_fewest(void) {
    ovoid_robot *r = make_cube();
    ovoid_robot_sphere s[64];
    ovoid_robot_sphere_cover cover = {.spheres = s, .capacity = 64};
    ovoid_robot_cover_options o = {.rounds = 20, .excess = 0.7};
    CHECK_EQ(ovoid_robot_compute_sphere_cover(r, &o, &cover, &error), OVOID_OK);
    CHECK(cover.count > 1 && cover.count < 64);
    for (size_t i = 0; i < cover.count; i++) {
        double out = fmax(fabs(s[i].center.x), fmax(fabs(s[i].center.y), fabs(s[i].center.z))) - 1;
        CHECK_LE(s[i].radius + out, 0.7);
    }
    ovoid_robot_destroy(r);
}

int main(void) {
    test_cube();
    test_settled();
    test_inner_points();
    test_round();
    test_allowance();
    test_points();
    test_shares();
    test_share_of_plane();
    test_share_of_balls();
    test_thousand();
    test_scales();
    test_refused();
    test_memory();
    test_cover();
    test_cover_bodies();
    test_fewest();
    return check_end();
}
