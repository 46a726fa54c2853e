// The depth of two parallelepipeds by all planes of their difference (exact/boxes.c). Truth: every plane through three
// of the 64 differences of corners that has all others behind it, in long double, shares nothing with the planes of
// pairs of edges; tolerance 1e-12 of a size of about 5, some thousand roundings. Covers are put before
// ovoid_answer_verify. What is not for this way is answered by EPA, which takes iterations.
#include "linear/pose.h"
#include "linear/rotation.h"
#include "ovoid/ovoid.h"
#include "shape/parallelepiped.h"

#include "check.h"
#include "places.h"
#include "proofs/covers.h"

typedef long double real;
typedef struct point {
    real x, y, z;
} point;

static point sub(point a, point b) { return (point){a.x - b.x, a.y - b.y, a.z - b.z}; }
static real dot(point a, point b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static point cross(point a, point b) {
    return (point){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static void get_corners(const ovoid_shape *s, const ovoid_pose *pose, point w[8]) {
    ovoid_polytope p = ovoid_shape_get_polytope(s);
    ovoid_quat q = pose->rotation;
    real norm = (real)q.w * q.w + (real)q.x * q.x + (real)q.y * q.y + (real)q.z * q.z;
    point axis = {q.x, q.y, q.z};
    for (int i = 0; i < 8; i++) {
        const double *v = p.vertices + 3 * i;
        point x = {(real)v[0] + p.origin.x, (real)v[1] + p.origin.y, (real)v[2] + p.origin.z}, t = cross(axis, x);
        point t2 = cross(axis, t);
        real k = 2 / norm, c = (real)q.w * k;
        w[i] = (point){x.x + c * t.x + k * t2.x + pose->position.x, x.y + c * t.y + k * t2.y + pose->position.y,
                       x.z + c * t.z + k * t2.z + pose->position.z};
    }
}

/// The distance of the origin to the plane if all points are behind it, else infinity.
static real measure_plane(const point d[64], int i, int j, int k) {
    point n = cross(sub(d[j], d[i]), sub(d[k], d[i]));
    real norm = sqrtl(dot(n, n));
    if (!(norm > 1e-9L)) return INFINITY;
    n = (point){n.x / norm, n.y / norm, n.z / norm};
    real low = 0, high = 0;
    for (int m = 0; m < 64; m++) {
        real above = dot(n, sub(d[m], d[i]));
        low = fminl(low, above);
        high = fmaxl(high, above);
        if (low < -1e-15L && high > 1e-15L) return INFINITY;
    }
    return high > 1e-15L ? -dot(n, d[i]) : dot(n, d[i]);
}

static real find_depth(const ovoid_pair *p) {
    point a[8], b[8], d[64];
    get_corners(p->shape_a, &p->pose_a, a);
    get_corners(p->shape_b, &p->pose_b, b);
    for (int i = 0; i < 64; i++) d[i] = sub(b[i / 8], a[i % 8]);
    real least = INFINITY;
    for (int i = 0; i < 64; i++)
        for (int j = i + 1; j < 64; j++)
            for (int k = j + 1; k < 64; k++) least = fminl(least, measure_plane(d, i, j, k));
    return least;
}

static ovoid_shape *make_slanted(const ovoid_vec3 axis[3], ovoid_vec3 c, double off) {
    double xyz[24];
    for (int i = 0; i < 8; i++) {
        double t[3] = {i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1};
        xyz[3 * i] = c.x + t[0] * axis[0].x + t[1] * axis[1].x + t[2] * axis[2].x;
        xyz[3 * i + 1] = c.y + t[0] * axis[0].y + t[1] * axis[1].y + t[2] * axis[2].y;
        xyz[3 * i + 2] = c.z + t[0] * axis[0].z + t[1] * axis[1].z + t[2] * axis[2].z;
    }
    xyz[0] += off;
    return ovoid_shape_create_from_points(xyz, 8, NULL, NULL);
}

static ovoid_shape *make_random(uint64_t *s, double off) {
    ovoid_vec3 axis[3], zero = {0, 0, 0};
    for (int i = 0; i < 3; i++) axis[i] = (ovoid_vec3){random_normal(s), random_normal(s), random_normal(s)};
    if (off == 0 && random_next(s) % 2)
        return ovoid_shape_create_box((ovoid_vec3){random_uniform(s, 0.2, 1), random_uniform(s, 0.2, 1), 1}, NULL,
                                      NULL);
    return make_slanted(axis, zero, off);
}

/// 1 if it was answered without a search.
static int check_depth(const ovoid_pair *p) {
    STATIC_COVER(cover);
    ovoid_answer x = ovoid_depth(p, NULL, NULL, &cover), same = ovoid_depth(p, NULL, NULL, NULL);
    ovoid_error error;
    CHECK(ovoid_answer_verify(p, &x, &(ovoid_answer_basis){.cover = &cover}, &error) == OVOID_OK);
    const double first[] = {x.lower, x.upper, x.normal.x, x.point_a.x, x.point_b.x, x.proof.weight_a[0]};
    const double again[] = {same.lower,     same.upper,     same.normal.x,
                            same.point_a.x, same.point_b.x, same.proof.weight_a[0]};
    CHECK(memcmp(first, again, sizeof first) == 0);
    CHECK(x.iterations == same.iterations);
    int is_here = x.proof.kind == OVOID_PROOF_COVER && x.iterations == 0;
    if (is_here) {
        CHECK(cover.point_count == 32);
        CHECK(cover.triangle_count == 60);
        CHECK(x.limit == OVOID_LIMIT_NONE);
    }
    return is_here;
}

static void test_random(void) {
    uint64_t s = 5;
    int here = 0, over = 0;
    for (int i = 0; i < 400; i++) {
        ovoid_shape *a = make_random(&s, 0), *b = make_random(&s, 0);
        ovoid_pose at_a = {{random_normal(&s), 0, 0}, random_quat(&s)};
        ovoid_pose at_b = {{at_a.position.x, 0.5 * random_normal(&s), 0.5 * random_normal(&s)}, random_quat(&s)};
        ovoid_pair p = {a, b, at_a, at_b};
        int is_here = check_depth(&p);
        ovoid_answer x = ovoid_depth(&p, NULL, NULL, NULL);
        here += is_here;
        over += x.status == OVOID_OVERLAPPING;
        if (i < 12 && x.status == OVOID_OVERLAPPING) {
            real d = -find_depth(&p);
            CHECK(x.lower <= (double)d + 1e-12);
            CHECK(x.upper >= (double)d - 1e-12);
        }
        ovoid_shape_destroy(a);
        ovoid_shape_destroy(b);
    }
    CHECK(over > 200);
    CHECK(here > over * 9 / 10);
}

/// Common axes: faces of the difference are no parallelograms of two edges; the depth is the least overlap.
static void test_aligned(void) {
    ovoid_shape *a = ovoid_shape_create_box((ovoid_vec3){1, 2, 3}, NULL, NULL);
    ovoid_pair p = {a, a, {{0, 0, 0}, {1, 0, 0, 0}}, {{1.25, 1, 1}, {1, 0, 0, 0}}};
    CHECK(!check_depth(&p));
    ovoid_answer x = ovoid_depth(&p, NULL, NULL, NULL);
    CHECK(x.lower <= -0.75);
    CHECK(x.upper >= -0.75);
    CHECK(x.upper - x.lower <= 1e-8);
    ovoid_shape_destroy(a);
}

/// What is a parallelepiped to rounding, and what is none.
static void test_shapes(void) {
    uint64_t s = 9;
    int found = 0;
    for (int i = 0; i < 200; i++) {
        ovoid_shape *b = make_random(&s, 0), *c = make_random(&s, 1e-12);
        ovoid_polytope p = ovoid_shape_get_polytope(b), q = ovoid_shape_get_polytope(c);
        double extent = ovoid_shape_get_measures(b).sphere_radius;
        parallelepiped x = parallelepiped_find(p.vertices, p.vertex_count, extent);
        found += (int)x.is_present;
        for (unsigned k = 0; k < 8 && x.is_present; k++) {
            double t[3] = {k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1};
            double at = x.center.x + t[0] * x.axis[0].x + t[1] * x.axis[1].x + t[2] * x.axis[2].x;
            CHECK(fabs(at - p.vertices[3 * x.corner[k]]) <= 1e-14);
        }
        CHECK(!parallelepiped_find(q.vertices, q.vertex_count, 3).is_present);
        CHECK(!parallelepiped_find(p.vertices, 7, extent).is_present);
        ovoid_shape_destroy(b);
        ovoid_shape_destroy(c);
    }
    CHECK(found > 190);
}

/// What is asked of boxes that are nearly apart, and how many of them took no iteration.
typedef struct counts {
    int separated, others, without_search;
} counts;

/// A yes or no, or a margin: the sign of the distance, a bracket around it, a proof that holds.
static void check_sign(const ovoid_pair *p, double margin, counts *all) {
    ovoid_answer truth = ovoid_distance(p, NULL, NULL),
                 x = margin > 0 ? ovoid_within(p, margin, NULL, NULL) : ovoid_collide(p, NULL, NULL);
    ovoid_error error = {0};
    if (!CHECK(ovoid_answer_verify(p, &x, NULL, &error) == OVOID_OK)) puts(error.message);
    CHECK_EQ(x.status, truth.status);
    CHECK(x.lower <= truth.upper);
    CHECK(x.upper >= truth.lower);
    // A bracket around the margin may be as wide as the tolerance.
    if (margin > 0 && fabs(truth.lower - margin) > 1e-8) CHECK_EQ(x.lower > margin, truth.lower > margin);
    all->separated += truth.lower > margin;
    all->others += !(truth.lower > margin);
    all->without_search += truth.lower > margin && x.iterations == 0 && x.stage == OVOID_STAGE_SUPPORT;
}

/// Boxes of any place in their frames, with radii too, at gaps of 10 % to 1e-9 of the size, and as deep.
static void test_signs(void) {
    uint64_t s = 21;
    counts signs = {0, 0, 0}, margins = {0, 0, 0};
    for (int i = 0; i < 4000; i++) {
        ovoid_vec3 half = {random_uniform(&s, 0.2, 1), random_uniform(&s, 0.2, 1), random_uniform(&s, 0.2, 1)};
        const ovoid_shape_options round = {.radius = i % 3 ? 0 : 0.1};
        ovoid_shape *a = ovoid_shape_create_box(half, &round, NULL), *b = a;
        if (i % 2) {
            // Right angles in any frame, away from its origin.
            mat3 m = quat_to_mat3(random_quat(&s));
            ovoid_vec3 axis[3] = {mat3_mul_vec3(m, (vec3){half.x, 0, 0}), mat3_mul_vec3(m, (vec3){0, half.z, 0}),
                                  mat3_mul_vec3(m, (vec3){0, 0, 0.7})};
            b = make_slanted(axis, (ovoid_vec3){random_normal(&s), 0.3, -0.2}, 0);
        }
        ovoid_pair p = {a, b, {{random_normal(&s), 0, 0}, random_quat(&s)}, {{0, 0, 0}, random_quat(&s)}};
        p.pose_b.position = (ovoid_vec3){3 * random_normal(&s), 3 * random_normal(&s), 3 * random_normal(&s)};
        ovoid_answer x = ovoid_depth(&p, NULL, NULL, NULL);
        double gap = pow(10, random_uniform(&s, -9, -1)) * (random_next(&s) % 3 ? 1 : -1);
        double by = 0.5 * (x.lower + x.upper) - gap, margin = gap > 0 ? gap * random_uniform(&s, 0.5, 1.5) : 0.1;
        p.pose_b.position = vec3_add_scaled(p.pose_b.position, x.normal, -by);
        check_sign(&p, 0, &signs);
        check_sign(&p, margin, &margins);
        if (b != a) ovoid_shape_destroy(b);
        ovoid_shape_destroy(a);
    }
    CHECK(signs.separated > 2000);
    CHECK(signs.others > 1000);
    CHECK(signs.without_search > signs.separated * 3 / 10);
    CHECK(margins.without_search > margins.separated * 3 / 10);
    printf("%d of %d apart, %d of %d beyond a margin without a search\n", signs.without_search, signs.separated,
           margins.without_search, margins.separated);
}

int main(void) {
    test_random();
    test_signs();
    test_aligned();
    test_shapes();
    return check_end();
}
