// The gradient of the exact distance. Truth: the signed distance of small polyhedra in long double by brute force, over
// vertices and triangles and pairs of edges (apart), over all normals of faces and pairs of edges (overlapping), and
// its differences of fourth order: e / h = 1e-19 / 1e-4 of rounding and h^4 of the rest leave 1e-11 where no feature
// changes within h. Where nothing is shown there must be a reason: symmetric positions by hand.
#include "check.h"
#include "ovoid/ovoid.h"

#include "bits.h"
#include "linear/mat3.h"
#include "pairs.h"
#include "proofs/covers.h"

typedef long double real;
typedef struct rvec {
    real x, y, z;
} rvec;
static rvec r_add(rvec a, rvec b, real s) { return (rvec){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z}; }
static real r_dot(rvec a, rvec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static rvec r_cross(rvec a, rvec b) {
    return (rvec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static rvec r_scale(rvec a, real s) { return (rvec){a.x * s, a.y * s, a.z * s}; }

// A posed polyhedron of at most 16 vertices: points, triangles, edges once.
typedef struct body {
    rvec x[16];
    uint32_t count, triangles, edges;
    const uint32_t *t;
    uint32_t e[64][2];
} body;

static body make_solid(const ovoid_shape *shape, const ovoid_pose *pose, const real *by) {
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    body s = {.count = p.vertex_count, .triangles = p.triangle_count, .t = p.triangles};
    rvec w = {by[3], by[4], by[5]}, q = {pose->rotation.x, pose->rotation.y, pose->rotation.z};
    real qw = pose->rotation.w, norm = qw * qw + r_dot(q, q), angle = sqrtl(r_dot(w, w));
    for (uint32_t i = 0; i < p.vertex_count; i++) {
        rvec v = {p.vertices[3 * i], p.vertices[3 * i + 1], p.vertices[3 * i + 2]};
        v = r_add(v, (rvec){p.origin.x, p.origin.y, p.origin.z}, 1);
        rvec c = r_cross(q, v);
        v = r_add(v, r_add(r_scale(c, qw), r_cross(q, c), 1), 2 / norm);
        if (angle > 0) {
            rvec axis = r_scale(w, 1 / angle), turned = r_scale(v, cosl(angle));
            turned = r_add(turned, r_cross(axis, v), sinl(angle));
            v = r_add(turned, axis, r_dot(axis, v) * (1 - cosl(angle)));
        }
        v = r_add(v, (rvec){pose->position.x, pose->position.y, pose->position.z}, 1);
        s.x[i] = r_add(v, (rvec){by[0], by[1], by[2]}, 1);
        for (uint32_t k = p.neighbor_starts[i]; k < p.neighbor_starts[i + 1]; k++)
            if (p.neighbors[k] > i) s.e[s.edges][0] = i, s.e[s.edges++][1] = p.neighbors[k];
    }
    return s;
}

static real between_point_and_triangle(rvec p, rvec a, rvec b, rvec c) {
    rvec n = r_cross(r_add(b, a, -1), r_add(c, a, -1)), corner[3] = {a, b, c};
    real area = r_dot(n, n);
    int inside = 1;
    for (int k = 0; k < 3; k++)
        inside &= r_dot(r_cross(r_add(corner[(k + 1) % 3], corner[k], -1), r_add(p, corner[k], -1)), n) >= 0;
    return inside ? fabsl(r_dot(n, r_add(p, a, -1))) / sqrtl(area) : INFINITY;
}
static real between_edges(rvec a, rvec b, rvec c, rvec d) {
    // Clamped as in C. Ericson, Real-time collision detection, 2004.
    rvec u = r_add(b, a, -1), v = r_add(d, c, -1), w = r_add(a, c, -1);
    real uu = r_dot(u, u), uv = r_dot(u, v), vv = r_dot(v, v), uw = r_dot(u, w), vw = r_dot(v, w);
    real det = uu * vv - uv * uv, s = det > 0 ? (uv * vw - uw * vv) / det : 0;
    s = fminl(fmaxl(s, 0), 1);
    real t = (uv * s + vw) / vv;
    if (t < 0 || t > 1) {
        t = fminl(fmaxl(t, 0), 1);
        s = fminl(fmaxl((uv * t - uw) / uu, 0), 1);
    }
    rvec x = r_add(r_add(w, u, s), v, -t);
    return sqrtl(r_dot(x, x));
}
// The gap of the supports along a direction of any length.
static real gap_along(const body *a, const body *b, rvec n) {
    real most = -INFINITY, least = INFINITY, length = sqrtl(r_dot(n, n));
    if (!(length > 1e-12L)) return -INFINITY;
    for (uint32_t i = 0; i < a->count; i++) most = fmaxl(most, r_dot(n, a->x[i]));
    for (uint32_t i = 0; i < b->count; i++) least = fminl(least, r_dot(n, b->x[i]));
    return (least - most) / length;
}
static rvec normal_of(const body *s, uint32_t t) {
    rvec a = s->x[s->t[3 * t]], b = s->x[s->t[3 * t + 1]], c = s->x[s->t[3 * t + 2]];
    return r_cross(r_add(b, a, -1), r_add(c, a, -1));
}

static real signed_distance(const ovoid_pair *pair, const real *by) {
    body a = make_solid(pair->shape_a, &pair->pose_a, by), b = make_solid(pair->shape_b, &pair->pose_b, by + 6);
    real deep = -INFINITY, near = INFINITY;
    for (uint32_t t = 0; t < a.triangles; t++) deep = fmaxl(deep, gap_along(&a, &b, normal_of(&a, t)));
    for (uint32_t t = 0; t < b.triangles; t++) deep = fmaxl(deep, gap_along(&a, &b, r_scale(normal_of(&b, t), -1)));
    for (uint32_t i = 0; i < a.edges; i++)
        for (uint32_t j = 0; j < b.edges; j++) {
            const rvec *p = a.x, *q = b.x;
            const uint32_t *e = a.e[i], *f = b.e[j];
            rvec n = r_cross(r_add(p[e[1]], p[e[0]], -1), r_add(q[f[1]], q[f[0]], -1));
            deep = fmaxl(deep, fmaxl(gap_along(&a, &b, n), gap_along(&a, &b, r_scale(n, -1))));
            near = fminl(near, between_edges(p[e[0]], p[e[1]], q[f[0]], q[f[1]]));
        }
    if (deep <= 0) return deep;
    for (int k = 0; k < 2; k++) {
        const body *s = k ? &b : &a, *o = k ? &a : &b;
        for (uint32_t i = 0; i < s->count; i++)
            for (uint32_t t = 0; t < o->triangles; t++)
                near = fminl(near, between_point_and_triangle(s->x[i], o->x[o->t[3 * t]], o->x[o->t[3 * t + 1]],
                                                              o->x[o->t[3 * t + 2]]));
    }
    return near;
}

static real differ(const ovoid_pair *pair, int i, real h) {
    static const real weight[5] = {1, -8, 0, 8, -1};
    real sum = 0;
    for (int k = -2; k <= 2; k++) {
        real by[12] = {0};
        by[i] = k * h;
        if (k) sum += weight[k + 2] * signed_distance(pair, by);
    }
    return sum / (12 * h);
}

static ovoid_shape *small_hull(uint64_t *s, double radius) {
    double xyz[3 * 8];
    for (int i = 0; i < 24; i++) xyz[i] = random_normal(s);
    return ovoid_shape_create_from_points(xyz, 4 + random_next(s) % 5, &(ovoid_shape_options){.radius = radius}, NULL);
}

static void test_random(void) {
    long shown[2] = {0}, count[2] = {0};
    long exact = 0, all = 0;
    double worst = 0;
    STATIC_COVER(cover);
    for (uint64_t seed = 1; seed <= 250; seed++) {
        uint64_t s = check_seed = seed;
        ovoid_shape *a = small_hull(&s, seed % 3 ? 0 : 0.2), *b = small_hull(&s, 0);
        for (int i = 0; i < 4; i++) {
            ovoid_pair pair = {a, b, {{0, 0, 0}, {1, 0.1, 0.2, 0.3}}, {{0, 0, 0}, {0, 0, 0, 1}}};
            pair.pose_b.position = vec3_scale(random_unit(&s), i % 2 ? 4 : 0.7);
            pair.pose_b.rotation = (ovoid_quat){random_normal(&s), random_normal(&s), random_normal(&s), 1};
            ovoid_answer x = ovoid_depth(&pair, NULL, NULL, &cover);
            ovoid_gradient g = ovoid_answer_compute_gradient(&pair, &x, &cover);
            int is_deep = x.upper < 0 && !(g.margin == INFINITY);
            count[is_deep]++;
            shown[is_deep] += g.has_rotation;
            CHECK(!g.has_rotation || g.has_translation);
            CHECK(g.has_translation || x.lower <= 0);
            CHECK(g.slope >= 0 && g.slope <= 1);
            // Features must not change within the differences.
            if (!g.has_rotation || g.slope < 0.02 || g.margin < 0.01 || fabs(x.upper) < 0.05) continue;
            real h = 1e-4L, zero[12] = {0};
            double d = (double)signed_distance(&pair, zero) - ovoid_shape_get_radius(a);
            CHECK(x.lower <= d + 1e-15 && d - 1e-15 <= x.upper);
            for (int k = 0; k < 12; k++) {
                double want = (double)differ(&pair, k, h);
                // What is promised (levers are below 4), and what comes out where the search ends on a feature.
                CHECK_NEAR(g.gradient[k], want, 1e-11 + 4 * g.turn + g.slide);
                exact += fabs(g.gradient[k] - want) < 1e-11;
                all++;
                worst = fmax(worst, fabs(g.gradient[k] - want));
            }
        }
        ovoid_shape_destroy(a);
        ovoid_shape_destroy(b);
    }
    printf("apart: %ld of %ld have a rotation's derivative; deep: %ld of %ld; off by %.1e at most\n", shown[0],
           count[0], shown[1], count[1], worst);
    CHECK_LE(worst, 1e-7);
    CHECK(exact > all * 99 / 100);
    CHECK(shown[0] > count[0] * 9 / 10);
    CHECK(shown[1] > count[1] / 2);
}

static ovoid_gradient ask(const ovoid_shape *a, const ovoid_shape *b, vec3 at, ovoid_quat turned) {
    STATIC_COVER(cover);
    ovoid_pair pair = {a, b, {{0, 0, 0}, {1, 0, 0, 0}}, {at, turned}};
    ovoid_answer x = ovoid_depth(&pair, NULL, NULL, &cover);
    return ovoid_answer_compute_gradient(&pair, &x, &cover);
}

// Positions where something does not exist.
static void test_kinks(void) {
    ovoid_quat none = {1, 0, 0, 0}, tilted = {1, 0.1, 0.2, 0.3}, about_x = {1, 0.2, 0, 0};
    ovoid_shape *cube = ovoid_shape_create_box((vec3){1, 1, 1}, NULL, NULL);
    ovoid_shape *capsule = ovoid_shape_create_capsule(0.25, 1, NULL, NULL);
    ovoid_shape *ball = ovoid_shape_create_sphere(0.5, NULL, NULL);

    // Faces face to face: n is unique, points are not.
    ovoid_gradient g = ask(cube, cube, (vec3){0.1, 0.2, 3}, none);
    CHECK(g.has_translation && !g.has_rotation && g.slope == 0 && g.slide == INFINITY);
    CHECK_NEAR(g.gradient[8], 1, 1e-12);
    // An edge over a face, and parallel edges.
    g = ask(cube, cube, (vec3){0.1, 0.2, 3}, about_x);
    CHECK(g.has_translation && !g.has_rotation);
    g = ask(cube, cube, (vec3){0.1, 3, 3}, none);
    CHECK(g.has_translation && !g.has_rotation);
    // A corner over a face: the slope is that of the lowest edge.
    g = ask(cube, cube, (vec3){0.1, 0.2, 4}, tilted);
    CHECK(g.has_translation && g.has_rotation && g.slope > 0.1 && g.turn < 1e-5);
    // Corner to corner, on the line of a diagonal.
    g = ask(cube, cube, (vec3){3, 3, 3}, none);
    CHECK(g.has_translation && g.has_rotation);
    // Capsules: crossing, parallel, and end to end.
    g = ask(capsule, capsule, (vec3){0, 2, 0}, (ovoid_quat){1, 0, 1, 0});
    CHECK(g.has_translation && g.has_rotation);
    CHECK_NEAR(g.slope, 1, 1e-12);
    g = ask(capsule, capsule, (vec3){0, 2, 0}, none);
    CHECK(g.has_translation && !g.has_rotation);
    g = ask(capsule, capsule, (vec3){0, 0, 4}, none);
    CHECK(g.has_translation && g.has_rotation);
    // Rounded bodies that overlap by their radii only have a gradient as if apart.
    g = ask(capsule, ball, (vec3){0.6, 0, 0.3}, none);
    CHECK(g.has_translation && g.has_rotation && g.margin == INFINITY);
    CHECK_NEAR(g.gradient[6], 1, 1e-12);
    CHECK_NEAR(g.gradient[4], -0.3, 1e-9);
    // A cube in a cube: from the middle there are six ways out; off the middle one, but the faces are parallel.
    g = ask(cube, cube, (vec3){0, 0, 0}, none);
    CHECK(!g.has_translation && !g.has_rotation);
    CHECK_EQ(g.margin, 0);
    g = ask(cube, cube, (vec3){0.1, 0.2, 0.5}, none);
    CHECK(g.has_translation && !g.has_rotation);
    CHECK_NEAR(g.gradient[8], 1, 1e-12);
    CHECK_LE(g.margin, 0.3 + 1e-12);
    CHECK_LE(0.29, g.margin);
    // Touching: nothing is shown.
    g = ask(cube, cube, (vec3){2, 0.1, 0.3}, none);
    CHECK(!g.has_translation && !g.has_rotation);

    // Refused, or from another question: nothing is shown, nothing is read out of bounds.
    ovoid_pair pair = {cube, cube, {{0, 0, 0}, {1, 0, 0, 0}}, {{0.1, 0, 0}, {0, 0, 0, 0}}};
    ovoid_answer x = ovoid_depth(&pair, NULL, NULL, NULL);
    g = ovoid_answer_compute_gradient(&pair, &x, NULL);
    CHECK(!g.has_translation && g.gradient[0] == 0);
    pair.pose_b.rotation.w = 1;
    x = ovoid_depth(&pair, NULL, NULL, NULL);
    g = ovoid_answer_compute_gradient(&pair, &x, NULL);
    CHECK(!g.has_translation && g.gradient[6] != 0);
    x.proof.a[0] = 1000;
    static own_cover wrong;
    own_cover_set(&wrong, 4, 4);
    wrong.triangles[2][1] = 9999;
    g = ovoid_answer_compute_gradient(&pair, &x, &wrong.cover);
    CHECK(!g.has_translation);
    ovoid_shape_destroy(cube);
    ovoid_shape_destroy(capsule);
    ovoid_shape_destroy(ball);
}

// Bodies known to within an allowance: the normal of the true ones is within `turn`, and no more is shown. Truth: balls
// that are smaller than the shapes and beside them, as far as the allowances let them be.
static void test_allowances(void) {
    uint64_t s = 5;
    for (int i = 0; i < 400; i++) {
        check_seed = (uint64_t)i;
        ovoid_shape *shapes[2];
        vec3 at[2], center[2];
        double room[2];
        for (int k = 0; k < 2; k++) {
            double size = random_uniform(&s, 0.1, 1), shrunk;
            room[k] = random_uniform(&s, 0, 0.2) * size;
            shrunk = random_uniform(&s, 0, room[k]);
            const ovoid_shape_options o = {.allowance = {.outside = room[k], .inside = room[k]}};
            shapes[k] = ovoid_shape_create_sphere(size, &o, NULL);
            at[k] = vec3_scale(vec3_unit(bits_vec3(&s, 1)), k ? 2.5 : 0);
            center[k] = vec3_add_scaled(at[k], vec3_unit(bits_vec3(&s, 1)), room[k] - shrunk);
        }
        ovoid_pair pair = {shapes[0], shapes[1], {at[0], {1, 0, 0, 0}}, {at[1], {1, 0, 0, 0}}};
        ovoid_answer x = ovoid_distance(&pair, NULL, NULL);
        ovoid_gradient g = ovoid_answer_compute_gradient(&pair, &x, NULL);
        vec3 n = vec3_unit(vec3_sub(center[1], center[0]));
        CHECK(g.has_translation == (x.lower > 0) && !g.has_rotation && isinf(g.slide));
        if (g.has_translation) CHECK_LE(acos(fmin(vec3_dot(n, x.normal), 1)), g.turn);
        ovoid_shape_destroy(shapes[0]);
        ovoid_shape_destroy(shapes[1]);
    }
    check_seed = 0;
}

int main(void) {
    test_random();
    test_kinks();
    test_allowances();
    return check_end();
}
