// The gradient of the distance of true cylinders and cones against polyhedra, balls, capsules and one another. Truth:
// the distance in long double, as the least over all of the one body of the distance to the other in closed form (which
// is convex: nested halving over vertices, edges, triangles, axes), and its differences of fourth order. A halved
// distance is off by the square of what its argument is off by, 1e-18; with steps of 1e-4 that and h^4 leave 1e-9 of
// the size where no feature changes within a step; those places are few and counted.
#include "bits.h"

#include <float.h>

#include "linear/mat3.h"
#include "pairs.h"

typedef long double real;
typedef struct rvec {
    real x, y, z;
} rvec;
static rvec add(rvec a, rvec b, real s) { return (rvec){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z}; }
static real dot(rvec a, rvec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static rvec cross(rvec a, rvec b) {
    return (rvec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// A body: hull of at most 8 points, or round, or a segment; with a radius.
typedef struct model {
    int is_cone, is_round;
    double radius, half, rounding;
    rvec points[8];
    int count;
} model;

typedef struct placed {
    rvec at, q;
    real w;
} placed;

static rvec turn(const placed *p, rvec v) {
    rvec c = cross(p->q, v);
    return add(add(v, c, 2 * p->w), cross(p->q, c), 2);
}

static placed put(const ovoid_pose *pose, const real *by) {
    placed p = {{pose->position.x + by[0], pose->position.y + by[1], pose->position.z + by[2]},
                {pose->rotation.x, pose->rotation.y, pose->rotation.z},
                pose->rotation.w};
    real norm = sqrtl(p.w * p.w + dot(p.q, p.q));
    p.w /= norm;
    p.q = add((rvec){0, 0, 0}, p.q, 1 / norm);
    rvec v = {by[3], by[4], by[5]};
    real angle = sqrtl(dot(v, v));
    if (!(angle > 0)) return p;
    rvec s = add((rvec){0, 0, 0}, v, sinl(angle / 2) / angle);
    real c = cosl(angle / 2), w = c * p.w - dot(s, p.q);
    p.q = add(add(add((rvec){0, 0, 0}, p.q, c), s, p.w), cross(s, p.q), 1);
    p.w = w;
    return p;
}

// From a point of the world to a round body.
static real to_round(const model *m, const placed *p, rvec x) {
    placed back = {{0, 0, 0}, {-p->q.x, -p->q.y, -p->q.z}, p->w};
    rvec v = turn(&back, add(x, p->at, -1));
    real off = sqrtl(v.x * v.x + v.y * v.y), r = m->radius, h = m->half;
    real base = hypotl(fmaxl(off - r, 0), m->is_cone ? fabsl(v.z + h) : fmaxl(fabsl(v.z) - h, 0));
    if (!m->is_cone) return base;
    real t = fminl(fmaxl(((r - off) * r + (v.z + h) * 2 * h) / (r * r + 4 * h * h), 0), 1);
    real side = hypotl(off - r * (1 - t), v.z - h * (2 * t - 1));
    int inside = fabsl(v.z) <= h && off <= r * (h - v.z) / (2 * h);
    return inside ? 0 : fminl(side, base);
}

// The least over a segment.
static real over_edge(const model *m, const placed *p, rvec a, rvec b) {
    real low = 0, high = 1;
    for (int i = 0; i < 64; i++) {
        real s = low + (high - low) * 0.382L, t = low + (high - low) * 0.618L;
        real at_s = to_round(m, p, add(a, add(b, a, -1), s)), at_t = to_round(m, p, add(a, add(b, a, -1), t));
        if (at_s < at_t)
            high = t;
        else
            low = s;
    }
    return to_round(m, p, add(a, add(b, a, -1), 0.5L * (low + high)));
}

// Over a triangle whose plane may hold the nearest point: at the round body's support along the plane's normal.
static real over_face(const model *m, const placed *p, const rvec c[3]) {
    rvec n = cross(add(c[1], c[0], -1), add(c[2], c[0], -1)), z = turn(p, (rvec){0, 0, 1});
    real length = sqrtl(dot(n, n));
    n = add((rvec){0, 0, 0}, n, 1 / length);
    if (dot(n, add(p->at, c[0], -1)) > 0) n = add((rvec){0, 0, 0}, n, -1);
    real along = dot(n, z), best = INFINITY;
    rvec across = add(n, z, -along);
    real off = sqrtl(dot(across, across));
    rvec rim = add(add(p->at, z, m->is_cone || along < 0 ? -m->half : m->half), across, off > 0 ? m->radius / off : 0);
    rvec ends[2] = {rim, add(p->at, z, m->half)};
    for (int k = 0; k < 1 + m->is_cone; k++) {
        rvec x = ends[k];
        real h = dot(n, add(c[0], x, -1));
        int sign = 0;
        for (int i = 0; i < 3; i++) {
            real side = dot(cross(add(c[(i + 1) % 3], c[i], -1), add(x, c[i], -1)), n);
            sign += side > 0 ? 1 : -1;
        }
        if ((sign == 3 || sign == -3) && h >= 0) best = fminl(best, k ? fminl(h, best) : h);
    }
    // The lower support is the nearer one.
    real h_rim = dot(n, add(c[0], rim, -1)), h_apex = m->is_cone ? dot(n, add(c[0], ends[1], -1)) : INFINITY;
    return best <= fminl(h_rim, h_apex) + 1e-15L ? best : INFINITY;
}

// All faces of the hull of few points are among its triples whose plane has all points on one side.
static real measure(const model *hull, const placed *ph, const model *round, const placed *pr) {
    rvec x[8];
    for (int i = 0; i < hull->count; i++) x[i] = add(ph->at, turn(ph, hull->points[i]), 1);
    real best = INFINITY;
    for (int i = 0; i < hull->count; i++) {
        best = fminl(best, to_round(round, pr, x[i]));
        for (int j = 0; j < i; j++) {
            best = fminl(best, over_edge(round, pr, x[i], x[j]));
            for (int k = 0; k < j; k++) best = fminl(best, over_face(round, pr, (rvec[3]){x[i], x[j], x[k]}));
        }
    }
    return best - hull->rounding - round->rounding;
}

typedef struct bodies {
    model m[2];
    ovoid_shape *shapes[2];
    ovoid_pair pair;
    int round; ///< which of the two
} bodies;

static real measure_at(const bodies *b, const real by[12]) {
    placed p[2] = {put(&b->pair.pose_a, by), put(&b->pair.pose_b, by + 6)};
    return measure(&b->m[!b->round], &p[!b->round], &b->m[b->round], &p[b->round]);
}

static real differ(const bodies *b, int i, real h) {
    static const real weight[5] = {1, -8, 0, 8, -1};
    real sum = 0;
    for (int k = -2; k <= 2; k++) {
        real by[12] = {0};
        by[i] = k * h;
        if (k) sum += weight[k + 2] * measure_at(b, by);
    }
    return sum / (12 * h);
}

static void make_hull(model *m, ovoid_shape **shape, uint64_t *s) {
    double xyz[24];
    m->count = (int)(random_next(s) % 8) + 1;
    m->rounding = m->count < 3 || random_next(s) % 3 == 0 ? 0.1 : 0;
    for (int i = 0; i < m->count; i++) {
        ovoid_vec3 v = bits_vec3(s, 1);
        m->points[i] = (rvec){v.x, v.y, v.z};
        xyz[3 * i] = v.x, xyz[3 * i + 1] = v.y, xyz[3 * i + 2] = v.z;
    }
    const ovoid_shape_options o = {.radius = m->rounding};
    *shape = ovoid_shape_create_from_points(xyz, (size_t)m->count, &o, NULL);
}

static void make_round(model *m, ovoid_shape **shape, uint64_t *s) {
    m->is_round = 1;
    m->is_cone = random_next(s) % 3 == 0;
    m->radius = random_uniform(s, 0.1, 1);
    m->half = random_uniform(s, 0.1, 1);
    m->rounding = random_next(s) % 4 == 0 ? 0.05 : 0;
    const ovoid_shape_options o = {.radius = m->rounding};
    *shape = m->is_cone ? ovoid_shape_create_cone(m->radius, m->half, &o, NULL)
                        : ovoid_shape_create_cylinder(m->radius, m->half, &o, NULL);
}

static long compared, uneven, shown, asked;
static double worst;

static void compare(const bodies *b, const ovoid_gradient *g, int i) {
    real fine = differ(b, i, 1e-4L), coarse = differ(b, i, 2e-4L);
    compared++;
    if (fabsl(fine - coarse) > 1e-9L) {
        uneven++;
        return;
    }
    double off = fabs((double)(g->gradient[i] - fine));
    worst = fmax(worst, off);
    CHECK_LE(off, 2e-9 + (i % 6 < 3 ? g->turn : 4 * g->turn + g->slide));
    CHECK_LE(off, 1e-7);
    // The rounding of the gap, four times 148 u of the size, is in it.
    CHECK_LE(3.5e-7, g->turn);
}

static void test_random(void) {
    uint64_t s = 11;
    for (int round = 0; round < 250; round++) {
        check_seed = (uint64_t)round;
        bodies b = {.round = (int)(random_next(&s) % 2)};
        make_round(&b.m[b.round], &b.shapes[b.round], &s);
        make_hull(&b.m[!b.round], &b.shapes[!b.round], &s);
        ovoid_vec3 far = bits_vec3(&s, 3), zero = {0, 0, 0};
        b.pair = (ovoid_pair){b.shapes[0], b.shapes[1], {zero, bits_quat(&s)}, {far, bits_quat(&s)}};
        b.pair.pose_a.position = bits_vec3(&s, 1);
        ovoid_answer x = ovoid_distance(&b.pair, NULL, NULL);
        if (x.lower > 0.05) {
            ovoid_gradient g = ovoid_answer_compute_gradient(&b.pair, &x, NULL);
            asked++;
            shown += g.has_rotation;
            CHECK(g.has_translation);
            real none[12] = {0}, truth = measure_at(&b, none);
            CHECK(x.lower - 1e-12 <= (double)truth && (double)truth <= x.upper + 1e-12);
            for (int i = 0; i < 12 && g.has_rotation; i++) compare(&b, &g, i);
        }
        ovoid_shape_destroy(b.shapes[0]);
        ovoid_shape_destroy(b.shapes[1]);
    }
    check_seed = 0;
    printf("%ld of %ld shown; %ld derivatives, off by %.2g at most, %ld where the distance bends\n", shown, asked,
           compared, worst, uneven);
    CHECK_LE(0.9 * (double)asked, shown);
    CHECK_LE(30 * uneven, compared);
}

// By turning a body about its own axis.
static double by_axis(const ovoid_pose *pose, const double *by) {
    ovoid_pose turned = {{0, 0, 0}, pose->rotation};
    ovoid_vec3 axis = ovoid_pose_compute_point(&turned, (ovoid_vec3){0, 0, 1});
    return axis.x * by[0] + axis.y * by[1] + axis.z * by[2];
}

// Turned about its own axis a round body's distance from anything does not change, to rounding; nor does any where both
// bodies turn about one point together, to the slide of the points.
static void test_axis(void) {
    uint64_t s = 4;
    long pairs = 0, of_two = 0;
    for (int round = 0; round < 400; round++) {
        check_seed = (uint64_t)round;
        bodies b = {.round = 0};
        make_round(&b.m[0], &b.shapes[0], &s);
        if (round % 2)
            make_round(&b.m[1], &b.shapes[1], &s);
        else
            make_hull(&b.m[1], &b.shapes[1], &s);
        ovoid_pose at_a = {bits_vec3(&s, 1), bits_quat(&s)}, at_b = {bits_vec3(&s, 3), bits_quat(&s)};
        b.pair = (ovoid_pair){b.shapes[0], b.shapes[1], at_a, at_b};
        ovoid_answer x = ovoid_distance(&b.pair, NULL, NULL);
        ovoid_gradient g = ovoid_answer_compute_gradient(&b.pair, &x, NULL);
        if (g.has_rotation) {
            CHECK_LE(fabs(by_axis(&at_a, g.gradient + 3)), 1e-14);
            if (b.m[1].is_round) CHECK_LE(fabs(by_axis(&at_b, g.gradient + 9)), 1e-14);
            vec3 arm = vec3_sub(at_b.position, at_a.position), force = {g.gradient[6], g.gradient[7], g.gradient[8]};
            vec3 turns = {g.gradient[3] + g.gradient[9], g.gradient[4] + g.gradient[10],
                          g.gradient[5] + g.gradient[11]};
            CHECK_LE(vec3_norm(vec3_add(turns, vec3_cross(arm, force))), 1e-12);
            pairs++;
            of_two += b.m[1].is_round;
        }
        ovoid_shape_destroy(b.shapes[0]);
        ovoid_shape_destroy(b.shapes[1]);
    }
    check_seed = 0;
    CHECK_LE(150, of_two);
    printf("%ld pairs turned about an axis, %ld of two round bodies\n", pairs, of_two);
}

// Places whose points are not unique, and shapes whose true form is not known: no derivative by rotations.
static void test_kinks(void) {
    const ovoid_quat none = {1, 0, 0, 0};
    ovoid_shape *cylinder = ovoid_shape_create_cylinder(0.5, 1, NULL, NULL);
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, NULL);
    // The box's face across the normal of the cone's side, (2 H, 0, R).
    ovoid_shape *cone = ovoid_shape_create_cone(0.5, 1, NULL, NULL);
    const double half = 0.5 * atan2(0.5, 2);
    const ovoid_vec3 aside = {3 * cos(2 * half), 0, 3 * sin(2 * half)};
    const ovoid_quat along = {cos(half), 0, -sin(half), 0};
    ovoid_shape *known =
        ovoid_shape_create_cylinder(0.5, 1, &(ovoid_shape_options){.allowance = {.outside = 1e-3, .inside = 0}}, NULL);
    const struct {
        const ovoid_shape *a, *b;
        ovoid_vec3 at;
        ovoid_quat rotation;
        int is_shown;
    } cases[7] = {
        {cone, box, aside, along, 0},                               // side along a face
        {cylinder, box, {0, 0, 3}, none, 0},                        // base on face
        {cylinder, box, {3, 0, 0}, none, 0},                        // side along a face
        {cylinder, cylinder, {2, 0, 0}, none, 0},                   // side along side
        {cylinder, box, {3, 0.1, 0.2}, {0.9, 0.1, 0.3, 0.2}, 1},    // a corner
        {known, box, {3, 0.1, 0.2}, {0.9, 0.1, 0.3, 0.2}, 0},       // another body within the allowance
        {cylinder, cylinder, {2, 0.1, 0.1}, {0.9, 0.3, 0.1, 0}, 1}, // rim and side
    };
    for (int i = 0; i < 7; i++) {
        check_seed = (uint64_t)i;
        ovoid_pair pair = {cases[i].a, cases[i].b, {{0, 0, 0}, none}, {cases[i].at, cases[i].rotation}};
        ovoid_answer x = ovoid_distance(&pair, NULL, NULL);
        ovoid_gradient g = ovoid_answer_compute_gradient(&pair, &x, NULL);
        CHECK_EQ(g.has_rotation, cases[i].is_shown);
        CHECK(g.has_translation);
    }
    check_seed = 0;
    ovoid_shape_destroy(cone);
    ovoid_shape_destroy(cylinder);
    ovoid_shape_destroy(box);
    ovoid_shape_destroy(known);
}

int main(void) {
    test_kinks();
    test_axis();
    if (LDBL_MANT_DIG < 64)
        check_skip("long double is no longer than double here");
    else
        test_random();
    return check_end();
}
