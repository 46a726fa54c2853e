// What is known to lie inside bodies. Truth: the distance of points on a ball, and of a ball and the body, by the exact
// query, whose brackets are 1e-12 wide here; the kernels of all instruction sets beside one another, bit for bit.
#include "check.h"
#include "robot/model/inner_balls.h"
#include "robots.h"

enum { SHAPES = 9 };
static ovoid_error error;

static void make_shapes(ovoid_shape *shapes[SHAPES], uint64_t *s) {
    const ovoid_shape_options smaller = {.allowance = {.outside = 0, .inside = 0.02}};
    double xyz[96], turned[24];
    for (int i = 0; i < 96; i++) xyz[i] = random_uniform(s, -0.3, 0.2);
    ovoid_pose pose = random_pose(s, 0.5);
    for (int i = 0; i < 8; i++) {
        ovoid_vec3 corner = {i & 1 ? 0.1 : -0.1, i & 2 ? 0.3 : -0.3, i & 4 ? 0.02 : -0.02};
        ovoid_vec3 p = ovoid_pose_compute_point(&pose, corner);
        turned[3 * i] = p.x, turned[3 * i + 1] = p.y, turned[3 * i + 2] = p.z;
    }
    shapes[0] = ovoid_shape_create_box((ovoid_vec3){0.1, 0.05, 0.2}, NULL, &error);
    shapes[1] = ovoid_shape_create_from_points(turned, 8, NULL, &error);
    shapes[2] = ovoid_shape_create_from_points(xyz, 32, NULL, &error);
    shapes[3] = ovoid_shape_create_from_points(xyz, 9, &(ovoid_shape_options){.radius = 0.03}, &error);
    shapes[4] = ovoid_shape_create_cylinder(0.03, 0.2, NULL, &error);
    shapes[5] = ovoid_shape_create_capsule(0.05, 0.2, NULL, &error);
    shapes[6] = ovoid_shape_create_sphere(0.1, NULL, &error);
    shapes[7] = ovoid_shape_create_from_points(xyz, 32, &smaller, &error);
    shapes[8] = ovoid_shape_create_from_points((double[]){0, 0, 0, 1, 0, 0, 0, 1, 0}, 3, NULL, &error);
    for (int i = 0; i < SHAPES; i++)
        if (!shapes[i]) exit(1);
}

static ovoid_answer measure(const ovoid_shape *ball, ovoid_vec3 at, const ovoid_shape *shape) {
    ovoid_pair pair = {ball, shape, ovoid_pose_make_identity(), ovoid_pose_make_identity()};
    pair.pose_a.position = at;
    return ovoid_depth(&pair, NULL, NULL, NULL);
}

// Points of the balls' surfaces are not outside.
static void test_balls(ovoid_shape *const shapes[SHAPES], const ovoid_shape *point, uint64_t *s) {
    for (int i = 0; i < SHAPES; i++) {
        shape_inside in;
        int count = 0;
        shape_inside_find(shapes[i], NULL, point, &in);
        for (int k = 0; k < BALLS; k++) {
            double r = in.balls.column[BALLS_RADIUS][k];
            count += r > 0;
            CHECK(!(r > in.most) && !(r < in.least));
            for (int n = 0; r > 0 && n < 60; n++) {
                vec3 out = vec3_scale(vec3_unit(random_vec3(s, 1)), r);
                vec3 x = {in.balls.column[0][k] + out.x, in.balls.column[1][k] + out.y, in.balls.column[2][k] + out.z};
                check_seed = (uint64_t)(100 * i + k);
                CHECK_LE(measure(point, x, shapes[i]).lower, 1e-12);
            }
        }
        check_seed = 0;
        // The flat one holds none.
        CHECK_EQ(count, i == 8 ? 0 : BALLS);
    }
}

// A ball that the kernel says meets the region touches the hull.
static void test_regions(ovoid_shape *const shapes[SHAPES], uint64_t *s) {
    const robot8_kernels *kernels = robot8_get_kernels_of(SIMD_SCALAR);
    long met = 0, not_met = 0;
    for (int i = 0; i < SHAPES; i++) {
        inner_region region = inner_region_find(shapes[i]);
        ovoid_vec3 middle = ovoid_shape_get_measures(shapes[i]).sphere_center, o = shapes[i]->origin;
        for (int n = 0; n < 400; n++) {
            inner_balls b;
            double r = random_uniform(s, 0.001, 0.2), radius = ovoid_shape_get_radius(shapes[i]);
            vec3 c = vec3_add(vec3_add(middle, o), random_vec3(s, 0.2));
            for (int k = 0; k < BALLS; k++)
                b.column[0][k] = c.x, b.column[1][k] = c.y, b.column[2][k] = c.z, b.column[BALLS_RADIUS][k] = r;
            double deep = kernels->balls_in_region(&b, &region, 0);
            *(deep > 0 ? &met : &not_met) += 1;
            if (!(deep > 0)) continue;
            ovoid_shape *ball = ovoid_shape_create_sphere(r, NULL, &error);
            // The region is of the hull, without radius and allowance.
            check_seed = (uint64_t)(1000 * i + n);
            CHECK_LE(measure(ball, c, shapes[i]).lower, 1e-12 - radius);
            ovoid_shape_destroy(ball);
        }
    }
    check_seed = 0;
    CHECK_LE(500, met);
    CHECK_LE(500, not_met);
}

static void test_lanes(ovoid_shape *const shapes[SHAPES], const ovoid_shape *point, uint64_t *s) {
    const robot8_kernels *scalar = robot8_get_kernels_of(SIMD_SCALAR);
    static shape_inside in[SHAPES];
    for (int i = 0; i < SHAPES; i++) shape_inside_find(shapes[i], NULL, point, &in[i]);
    long deep = 0;
    for (int n = 0; n < 2000; n++) {
        int i = (int)random_below(s, SHAPES), k = (int)random_below(s, SHAPES);
        inner_balls a, b, other;
        mat3 turn = quat_to_mat3(random_pose(s, 1).rotation);
        vec3 p = random_vec3(s, 0.15);
        const double at[3] = {p.x, p.y, p.z}, zero[3] = {0, 0, 0};
        scalar->place_balls(&turn, at, &in[i].balls, &a);
        scalar->place_balls(&turn, zero, &in[k].balls, &b);
        inner_region g = inner_region_place(&in[k].region, &turn, (vec3){0, 0, 0});
        inner_region around = {turn, {0, 0, 0}, {1, 1, 1}, 1, 0, 1};
        double met[2] = {scalar->balls_in_region(&a, &g, 0.01), scalar->balls_in_balls(&a, &around, &b)};
        // The first ball that meets one of the other body's is the one that counts.
        double truth = 0;
        for (int x = 0; x < BALLS && !(truth > 0); x++)
            for (int y = 0; y < BALLS; y++) {
                vec3 d = {a.column[0][x] - b.column[0][y], a.column[1][x] - b.column[1][y],
                          a.column[2][x] - b.column[2][y]};
                double radii = a.column[3][x] + b.column[3][y];
                if (radii > 0) truth = max2(truth, radii * radii - vec3_norm_squared(d));
            }
        CHECK_LE(fabs(truth - met[1]), 1e-15);
        deep += met[0] > 0 || met[1] > 0;
        for (int isa = SIMD_SCALAR + 1; isa < SIMD_ISA_COUNT; isa++) {
            const robot8_kernels *lanes = robot8_get_kernels_of((simd_isa)isa);
            if (!lanes) continue;
            lanes->place_balls(&turn, at, &in[i].balls, &other);
            CHECK_EQ(memcmp(&a, &other, sizeof a), 0);
            CHECK(lanes->balls_in_region(&a, &g, 0.01) == met[0]);
            CHECK(lanes->balls_in_balls(&a, &around, &b) == met[1]);
        }
    }
    CHECK_LE(200, deep);
}

// An L, whose notch is the square of x and y from 1 to 2: no ball of it reaches the notch or leaves the box around it,
// and its region is one of them; turned inside out it holds as much, and without a side nothing.
static void test_solid(const ovoid_shape *point) {
    static const double xyz[36] = {0, 0, 0, 2, 0, 0, 2, 1, 0, 1, 1, 0, 1, 2, 0, 0, 2, 0,
                                   0, 0, 1, 2, 0, 1, 2, 1, 1, 1, 1, 1, 1, 2, 1, 0, 2, 1};
    static const uint32_t faces[60] = {3, 5, 4, 3, 0,  5, 3,  1, 0, 3, 2,  1, 9,  10, 11, 9, 11, 6, 9, 6,
                                       7, 9, 7, 8, 0,  1, 7,  0, 7, 6, 1,  2, 8,  1,  8,  7, 2,  3, 9, 2,
                                       9, 8, 3, 4, 10, 3, 10, 9, 4, 5, 11, 4, 11, 10, 5,  0, 6,  5, 6, 11};
    ovoid_shape *hull = ovoid_shape_create_from_points(xyz, 12, NULL, &error);
    for (int kind = 0; kind < 3; kind++) {
        uint32_t t[60];
        for (int i = 0; i < 60; i++) t[i] = kind == 1 ? faces[i / 3 * 3 + 2 - i % 3] : faces[i];
        ovoid_solid *solid =
            ovoid_solid_create_from_triangles(&(ovoid_triangles){xyz, 12, t, kind == 2 ? 18 : 20}, NULL, &error);
        if (!CHECK(hull && solid)) return;
        shape_inside in;
        int count = 0;
        shape_inside_find(hull, solid, point, &in);
        check_seed = (uint64_t)kind;
        for (int k = 0; k < BALLS; k++) {
            double x = in.balls.column[0][k], y = in.balls.column[1][k], z = in.balls.column[2][k],
                   r = in.balls.column[BALLS_RADIUS][k];
            if (!(r > 0)) continue;
            count++;
            CHECK_LE(r, fmin(fmin(x, fmin(2 - x, y)), fmin(2 - y, fmin(z, 1 - z))) + 1e-12);
            CHECK_LE(r, hypot(fmax(1 - x, 0), fmax(1 - y, 0)) + 1e-12);
        }
        CHECK_EQ(count > 0, kind < 2);
        CHECK_EQ(in.region.offset > 0, kind < 2);
        if (kind < 2) CHECK(in.region.offset == in.most && in.most > 0.4);
        ovoid_solid_destroy(solid);
    }
    check_seed = 0;
    ovoid_shape_destroy(hull);
}

int main(void) {
    uint64_t s = 71;
    ovoid_shape *shapes[SHAPES], *point = shape_create_point(NULL);
    if (!point) exit(1);
    make_shapes(shapes, &s);
    test_balls(shapes, point, &s);
    test_solid(point);
    test_regions(shapes, &s);
    test_lanes(shapes, point, &s);
    for (int i = 0; i < SHAPES; i++) ovoid_shape_destroy(shapes[i]);
    ovoid_shape_destroy(point);
    return check_end();
}
