// Gaps and overlaps far below the rounding of doubles. Truth: pairs built so that the signed distance is known exactly.
// B lies in x >= 0 with one feature in the plane x = 0, A in x <= -gap with one in x = -gap, and the features' shadows
// in the plane cross inside both (or meet as the name says); so the distance is gap where that is positive, and the
// bodies overlap, by at most -gap, where it is negative. Both are then turned by quaternions of integers and moved,
// exactly. Every answer goes before the exact judge and the library's own check.
#include "check.h"
#include "judge.h"
#include "ovoid/ovoid.h"
#include "pair/fine.h"
#include "proofs/covers.h"

static judge *court;

static ovoid_shape *make_points(const double *xyz, size_t count, double radius) {
    ovoid_shape_options o = {.radius = radius};
    ovoid_shape *s = ovoid_shape_create_from_points(xyz, count, &o, NULL);
    CHECK(s != NULL);
    return s;
}

static int holds(const ovoid_pair *p, const ovoid_answer *x, const ovoid_cover *cover) {
    ovoid_error error = {OVOID_OK, 0, ""};
    int judged = judge_verify_answer(court, p, x, cover, &error) == OVOID_OK;
    if (!judged) printf("judge: %s\n", error.message);
    int checked = ovoid_answer_verify(p, x, &(ovoid_answer_basis){.cover = cover}, &error) == OVOID_OK;
    if (!checked) printf("check: %s\n", error.message);
    return judged && checked;
}

// The bracket and the status of one answer about a distance (or minus a depth's bound) known exactly.
static void check_answer(const ovoid_pair *p, const ovoid_answer *x, const ovoid_cover *cover, double gap,
                         double least) {
    CHECK(holds(p, x, cover));
    CHECK_LE(x->lower, gap > 0 ? gap : 0);
    CHECK_LE(gap > 0 ? gap : -INFINITY, x->upper);
    ovoid_status expected = gap > 0 ? OVOID_SEPARATED : gap < 0 ? OVOID_OVERLAPPING : OVOID_TOUCHING;
    // An overlap needs a surface around the origin, which has some thickness: ten times as much.
    if (gap >= least || gap == 0 || -gap >= 10 * least) CHECK_EQ(x->status, expected);
    if (x->status == OVOID_TOUCHING) CHECK_LE(fmax(x->upper, -x->lower), gap < 0 ? 10 * least : least);
}

// All questions, cold and with the others' proofs. least: the smallest gap that must be told from none.
static void check_pair(const ovoid_pair *p, double gap, double least) {
    STATIC_COVER(cover);
    ovoid_answer x[4] = {ovoid_collide(p, NULL, NULL), ovoid_depth(p, NULL, NULL, &cover),
                         ovoid_distance(p, NULL, NULL), ovoid_within(p, 0, NULL, NULL)};
    for (int i = 0; i < 4; i++) check_answer(p, &x[i], i == 1 ? &cover : NULL, gap, least);
    for (int i = 0; i < 4; i++) {
        ovoid_answer warm = ovoid_depth(p, NULL, &x[i].proof, &cover);
        check_answer(p, &warm, &cover, gap, least);
        warm = ovoid_collide(p, NULL, &x[i].proof);
        check_answer(p, &warm, NULL, gap, least);
    }
    // The other way round.
    ovoid_pair q = {p->shape_b, p->shape_a, p->pose_b, p->pose_a};
    ovoid_answer y = ovoid_collide(&q, NULL, NULL);
    check_answer(&q, &y, NULL, gap, least);
}

// --- features in a plane x = const, and the body behind them

typedef enum feature { VERTEX, EDGE, FACE, CORNER, SIDE } feature;

// A feature that has (0, 0) of the plane inside (VERTEX, EDGE, FACE), at its end (CORNER: of a face, SIDE: the middle
// of a face's side), along y or z.
static size_t set_feature(double *yz, feature what, int along_z) {
    static const double vertex[] = {0, 0}, edge[] = {-1, 0, 0.75, 0};
    static const double face[] = {-1, -1, 1, -0.75, 0.5, 1, -0.75, 0.875};
    static const double corner[] = {0, 0, 1, 0, 1, 1, 0, 1}, side[] = {-1, 0, 1, 0, 1, 1, -1, 1};
    const double *all[] = {vertex, edge, face, corner, side};
    static const size_t counts[] = {1, 2, 4, 4, 4};
    for (size_t i = 0; i < counts[what]; i++) {
        yz[2 * i] = all[what][2 * i + (along_z ? 1 : 0)];
        yz[2 * i + 1] = all[what][2 * i + (along_z ? 0 : 1)];
    }
    return counts[what];
}

// The feature at x = at, and `more` random points on the side of it, at least 1/8 away; none: flat. Of A side is -1.
static ovoid_shape *make_body(uint64_t *r, feature what, int along_z, double at, int side, size_t more, double radius) {
    double xyz[3 * 40], yz[8];
    size_t n = set_feature(yz, what, along_z);
    for (size_t i = 0; i < n; i++) xyz[3 * i] = at, xyz[3 * i + 1] = yz[2 * i], xyz[3 * i + 2] = yz[2 * i + 1];
    for (size_t i = n; i < n + more; i++) {
        xyz[3 * i] = at + side * random_uniform(r, 0.125, 2);
        xyz[3 * i + 1] = random_uniform(r, -1.5, 1.5);
        xyz[3 * i + 2] = random_uniform(r, -1.5, 1.5);
    }
    return make_points(xyz, n + more, radius);
}

// One after another: a list's order is the compiler's.
static ovoid_vec3 random_vector(uint64_t *r, double scale) {
    double x = random_uniform(r, -scale, scale), y = random_uniform(r, -scale, scale);
    return (ovoid_vec3){x, y, random_uniform(r, -scale, scale)};
}

// 2^-44 to 2^-88.
static double random_gap(uint64_t *r) {
    double mantissa = random_uniform(r, 1, 2);
    return ldexp(mantissa, -(int)(random_next(r) % 44) - 44);
}

// Small integers, so that products of two are exact; by any norm that is a power of two.
static ovoid_quat random_turn(uint64_t *r) {
    double q[4], k = random_next(r) % 2 ? 1 : 0x1p-30;
    do
        for (int i = 0; i < 4; i++) q[i] = (double)(random_next(r) % 31) - 15;
    while (q[0] == 0 && q[1] == 0 && q[2] == 0 && q[3] == 0);
    return (ovoid_quat){q[0] * k, q[1] * k, q[2] * k, q[3] * k};
}

static ovoid_quat product(ovoid_quat a, ovoid_quat b) {
    return (ovoid_quat){a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
                        a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

// Features that touch inside both, so that a negative gap is an overlap with an interior.
static const feature meetings[][2] = {{VERTEX, FACE}, {FACE, VERTEX}, {EDGE, EDGE},   {FACE, FACE},  {EDGE, FACE},
                                      {FACE, EDGE},   {SIDE, FACE},   {CORNER, FACE}, {FACE, CORNER}};
enum { MEETINGS = sizeof meetings / sizeof *meetings };

// 1e-28 of the size is promised; features of 1 in a pair of size 6 to 10.
static const double least = 1e-27;

static void test_meetings(uint64_t seed) {
    uint64_t r = check_seed = seed;
    const feature *m = meetings[random_next(&r) % MEETINGS];
    double gap = random_gap(&r);
    switch (random_next(&r) % 5) {
    case 0: gap = 0; break;
    case 1:
    case 2: gap = -gap; break;
    }
    size_t more_a = 1 + (size_t)(random_next(&r) % 30), more_b = 1 + (size_t)(random_next(&r) % 30);
    ovoid_shape *a = make_body(&r, m[0], 0, -gap, -1, more_a, 0), *b = make_body(&r, m[1], 1, 0, 1, more_b, 0);
    ovoid_quat q = random_turn(&r);
    ovoid_vec3 at = random_vector(&r, 1);
    at.x *= 1e7, at.z *= 1e12;
    ovoid_pair p = {a, b, {at, q}, {at, q}};
    // Of A a turn about x more, by 3-4-5 or a quarter, where that leaves the features across one another.
    const ovoid_quat more[] = {{1, 0, 0, 0}, {3, 1, 0, 0}, {1, 1, 0, 0}};
    int turn = m[0] == VERTEX || m[1] == VERTEX ? (int)(random_next(&r) % 3) : 0;
    p.pose_a.rotation = product(q, more[turn]);
    check_pair(&p, gap, least);
    ovoid_shape_destroy(a);
    ovoid_shape_destroy(b);
    judge_forget(court);
}

// Boxes moved by powers of two along an axis: faces, edges and corners that fit exactly, nothing unique.
static void test_boxes(void) {
    ovoid_shape *a = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, NULL);
    ovoid_shape *b = ovoid_shape_create_box((ovoid_vec3){1, 0.5, 2}, NULL, NULL);
    const ovoid_vec3 places[] = {{2, 0, 0}, {2, 0.25, -0.5}, {2, 1.5, 0}, {2, 0, 3}, {2, 1.5, 3}, {2, -0.5, 1}};
    const ovoid_quat turns[] = {{1, 0, 0, 0}, {1, 1, 1, 1}, {1, 0, 0, 1}};
    for (int e = 52; e <= 88; e += 4)
        for (size_t i = 0; i < 3 * sizeof places / sizeof *places; i++)
            for (int sign = -1; sign <= 1; sign++) {
                ovoid_vec3 c = places[i / 3];
                double step = sign * ldexp(1, -e);
                // Where edges or corners meet, all that decides moves.
                ovoid_vec3 d = {-step, c.y == 1.5 ? -step : 0, c.z == 3 ? -step : 0};
                // Turned alike about the world's origin: coordinates change places.
                ovoid_quat q = turns[i % 3];
                ovoid_vec3 at[3] = {c, {c.z, c.x, c.y}, {-c.y, c.x, c.z}},
                           by[3] = {d, {d.z, d.x, d.y}, {-d.y, d.x, d.z}};
                ovoid_pair p = {a, b, {by[i % 3], q}, {at[i % 3], q}};
                double gap = sqrt(d.x * d.x + d.y * d.y + d.z * d.z) * sign;
                check_pair(&p, sign < 0 ? gap : gap * (1 + 0x1p-50), least);
            }
    // Identical flat bodies, and one moved in the plane and out of it.
    const double square[] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
    ovoid_shape *flat = make_points(square, 4, 0);
    for (int k = 0; k < 4; k++) {
        double out = k % 2 ? 0x1p-80 : 0;
        ovoid_pair p = {flat, flat, {{0, 0, 0}, {1, 0, 0, 0}}, {{k / 2 ? 0.5 : 0, 0, out}, {1, 0, 0, 0}}};
        check_pair(&p, out, least);
        p.pose_b = (ovoid_pose){{2, 0, out}, {1, 0, 0, 0}};
        check_pair(&p, out, least);
    }
    ovoid_shape_destroy(a), ovoid_shape_destroy(b), ovoid_shape_destroy(flat);
    judge_forget(court);
}

// Points, segments and polygons: they touch or are apart, and never overlap; the distance is the gap.
static void test_flat(uint64_t seed) {
    static const feature both[][2] = {{VERTEX, VERTEX}, {VERTEX, EDGE}, {EDGE, EDGE}, {VERTEX, FACE},  {EDGE, FACE},
                                      {FACE, FACE},     {CORNER, EDGE}, {SIDE, SIDE}, {CORNER, CORNER}};
    uint64_t r = check_seed = seed;
    const feature *m = both[random_next(&r) % 9];
    double gap = random_next(&r) % 3 ? random_gap(&r) : 0;
    ovoid_shape *a = make_body(&r, m[0], 0, -gap, -1, 0, 0), *b = make_body(&r, m[1], 1, 0, 1, 0, 0);
    ovoid_quat q = random_turn(&r);
    ovoid_pair p = {a, b, {{3e6, 0, 0}, q}, {{3e6, 0, 0}, q}};
    check_pair(&p, gap, least);
    ovoid_shape_destroy(a);
    ovoid_shape_destroy(b);
    judge_forget(court);
}

// Rounded shapes: the gap between the cores is the sum of the radii and a little; all are sums of few bits.
static void test_rounded(uint64_t seed) {
    uint64_t r = check_seed = seed;
    const feature *m = meetings[random_next(&r) % MEETINGS];
    double ra = 0.25, rb = 0.125, step = ldexp(1, -44 - (int)(random_next(&r) % 44));
    double gap = random_next(&r) % 3 == 0 ? 0 : random_next(&r) % 2 ? step : -step;
    // x = -1/4 - gap is no double: B's core is at 1/8, A's at -1/4, and A's or B's pose is moved by the gap before
    // turning.
    ovoid_shape *a = make_body(&r, m[0], 0, -ra, -1, 4, ra), *b = make_body(&r, m[1], 1, rb, 1, 4, rb);
    const ovoid_quat turns[] = {{1, 0, 0, 0}, {1, 1, 1, 1}, {2, 0, 0, 1}};
    int turn = (int)(random_next(&r) % 3);
    // 3-4-5 takes x to (3, 4, 0) / 5: five times the gap.
    ovoid_vec3 by[] = {{-gap, 0, 0}, {0, -gap, 0}, {-3 * gap, -4 * gap, 0}};
    ovoid_pair p = {a, b, {by[turn], turns[turn]}, {{0, 0, 0}, turns[turn]}};
    // The features' random neighbours are 1/8 behind: for |gap| that small the cores' distance is along x.
    check_pair(&p, turn == 2 ? 5 * gap : gap, least);
    ovoid_shape_destroy(a);
    ovoid_shape_destroy(b);
    judge_forget(court);
}

// Vertices 1e7 from their own origin: what rotating it hides is 2^-95 of it, some 1e-21.
static void test_far_vertices(void) {
    double near[24], far[24];
    for (int i = 0; i < 8; i++)
        for (int k = 0; k < 3; k++) {
            near[3 * i + k] = (i >> k & 1) * 2.0 - (k == 0 ? 2 : 1);
            far[3 * i + k] = (i >> k & 1) * 2.0 - (k == 0 ? 0 : 1) + 0x1p23;
        }
    ovoid_shape *a = make_points(near, 8, 0), *b = make_points(far, 8, 0);
    for (int e = 45; e <= 60; e += 5)
        for (int sign = -1; sign <= 1; sign++) {
            double gap = sign * ldexp(1, -e);
            ovoid_pair p = {a, b, {{-gap, 0, 0}, {1, 0, 0, 0}}, {{-0x1p23, -0x1p23, -0x1p23}, {1, 0, 0, 0}}};
            check_pair(&p, gap, 1e-18);
        }
    ovoid_shape_destroy(a), ovoid_shape_destroy(b);
    judge_forget(court);
}

// Bodies far from their origins, turned by anything, so that their rotation is rounded: closed in by A's position, a
// double near 0, on a gap near what is hidden. Truth: the judge, and the sign by brute force.
static void test_far_turned(uint64_t seed) {
    uint64_t r = check_seed = seed;
    ovoid_shape *s[2];
    for (int k = 0; k < 2; k++) {
        double xyz[15];
        for (int i = 0; i < 15; i++) xyz[i] = random_uniform(&r, -1, 1) + 0x1p23;
        s[k] = make_points(xyz, 5, 0);
    }
    ovoid_pair p = {.shape_a = s[0], .shape_b = s[1]};
    p.pose_a.rotation = random_turn(&r), p.pose_b.rotation = random_turn(&r);
    ovoid_vec3 far = {0x1p23, 0x1p23, 0x1p23}, a = ovoid_pose_compute_point(&p.pose_a, far);
    ovoid_vec3 b = ovoid_pose_compute_point(&p.pose_b, far);
    p.pose_b.position = (ovoid_vec3){a.x - b.x + 1, a.y - b.y, a.z - b.z};
    double target = ldexp(random_uniform(&r, -1, 1), -66);
    judge_truth truth;
    for (int k = 0; k < 6; k++) {
        CHECK_EQ(judge_compute_truth(court, &p, &truth, NULL), OVOID_OK);
        ovoid_answer x = ovoid_depth(&p, NULL, NULL, NULL);
        double step = 0.5 * (truth.low + truth.high) - target;
        ovoid_vec3 *at = &p.pose_a.position;
        at->x += step * x.normal.x, at->y += step * x.normal.y, at->z += step * x.normal.z;
    }
    CHECK_EQ(judge_compute_truth(court, &p, &truth, NULL), OVOID_OK);
    ovoid_answer x = ovoid_distance(&p, NULL, NULL);
    CHECK(holds(&p, &x, NULL));
    CHECK(x.lower <= truth.high && truth.low <= x.upper);
    if (truth.low > 4e-21) CHECK_EQ(x.status, OVOID_SEPARATED);
    if (truth.high < -4e-20) CHECK_EQ(x.status, OVOID_OVERLAPPING);
    ovoid_shape_destroy(s[0]), ovoid_shape_destroy(s[1]);
    judge_forget(court);
}

// Thousands of vertices in the two planes that meet, all of them candidates.
static void test_many(void) {
    enum { N = 2000 };
    static double xyz[3 * (N + 1)];
    ovoid_shape *s[2];
    for (int side = 0; side < 2; side++) {
        for (int i = 0; i < N; i++) {
            xyz[3 * i] = 0;
            xyz[3 * i + 1] = cos(6.283185307179586 * i / N);
            xyz[3 * i + 2] = sin(6.283185307179586 * i / N);
        }
        xyz[3 * N] = side ? 1 : -1, xyz[3 * N + 1] = xyz[3 * N + 2] = 0;
        s[side] = make_points(xyz, N + 1, 0);
    }
    CHECK(ovoid_shape_get_polytope(s[0]).vertex_count > 1000);
    for (int sign = -1; sign <= 1; sign++) {
        double gap = sign * 0x1p-70;
        ovoid_quat q = {3, -1, 2, 5};
        // The gap's direction, x turned, is (-1/3, 2/3, ...) of no double: moved in the body's own frame instead.
        ovoid_pair p = {s[0], s[1], {{-gap, 0, 0}, {1, 0, 0, 0}}, {{0, 0, 0}, {1, 0, 0, 0}}};
        ovoid_answer x = ovoid_collide(&p, NULL, NULL);
        check_answer(&p, &x, NULL, gap, least);
        p.pose_a = p.pose_b = (ovoid_pose){{1, 2, 3}, q};
        x = ovoid_depth(&p, NULL, NULL, NULL);
        CHECK_EQ(x.status, OVOID_TOUCHING);
        CHECK_LE(x.upper - x.lower, least);
        CHECK(holds(&p, &x, NULL));
    }
    ovoid_shape_destroy(s[0]), ovoid_shape_destroy(s[1]);
    judge_forget(court);
}

// A tolerance that doubles cannot reach, where the distance is small enough to be told to it.
static void test_tolerance(void) {
    ovoid_shape *a = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, NULL);
    ovoid_options o = {.relative_tolerance = 1e-16};
    for (int e = 4; e <= 60; e += 8) {
        double gap = ldexp(1, -e);
        // Turned by 3-4-5, apart by five times the gap.
        ovoid_pair p = {a, a, {{-3 * gap, -4 * gap, 0}, {2, 0, 0, 1}}, {{1.5, 2, 0}, {2, 0, 0, 1}}};
        // |(1.5, 2)| = 2.5: half a unit more than the boxes' halves.
        ovoid_answer x = ovoid_distance(&p, &o, NULL);
        CHECK(holds(&p, &x, NULL));
        CHECK(x.lower <= 0.5 + 5 * gap && 0.5 + 5 * gap <= x.upper);
        CHECK_LE(x.upper - x.lower, 0x1p-52);
        CHECK(x.limit == OVOID_LIMIT_NONE || x.limit == OVOID_LIMIT_PRECISION);
        CHECK_EQ(x.limit == OVOID_LIMIT_NONE, x.upper - x.lower <= 1e-16 * 5.9);
    }
    // Out of reach: the bracket is as narrow as doubles are, and the limit says why.
    o.relative_tolerance = 1e-25;
    ovoid_pair p = {a, a, {{0, 0, 0}, {3, 1, 2, 1}}, {{3.7, 0.1, 0.2}, {1, 2, 0, 5}}};
    ovoid_answer x = ovoid_distance(&p, &o, NULL);
    CHECK(holds(&p, &x, NULL));
    CHECK_EQ(x.limit, OVOID_LIMIT_PRECISION);
    CHECK_LE(x.upper - x.lower, 0x1p-50);
    ovoid_shape_destroy(a);
    judge_forget(court);
}

// The low half of the direction is part of the proof.
static void test_altered(void) {
    ovoid_shape *a = ovoid_shape_create_box((ovoid_vec3){5, 5, 5}, NULL, NULL);
    ovoid_pair p = {a, a, {{-3 * 0x1p-65, -4 * 0x1p-65, 0}, {2, 0, 0, 1}}, {{6, 8, 0}, {2, 0, 0, 1}}};
    ovoid_answer x = ovoid_distance(&p, NULL, NULL), y;
    CHECK_EQ(x.status, OVOID_SEPARATED);
    CHECK_EQ(x.stage, OVOID_STAGE_REFINE);
    CHECK(x.proof.normal_low.x != 0);
    CHECK(holds(&p, &x, NULL));
    y = x, y.proof.normal_low = (ovoid_vec3){0, 0, 0};
    CHECK(ovoid_answer_verify(&p, &y, NULL, NULL) == OVOID_ERROR_PROOF);
    CHECK(judge_verify_answer(court, &p, &y, NULL, NULL) == OVOID_ERROR_PROOF);
    y = x, y.proof.normal_low.x += 1e-18;
    CHECK(ovoid_answer_verify(&p, &y, NULL, NULL) == OVOID_ERROR_PROOF);
    CHECK(judge_verify_answer(court, &p, &y, NULL, NULL) == OVOID_ERROR_PROOF);
    y = x, y.proof.normal_low.x = NAN;
    CHECK(ovoid_answer_verify(&p, &y, NULL, NULL) == OVOID_ERROR_PROOF);
    CHECK(judge_verify_answer(court, &p, &y, NULL, NULL) == OVOID_ERROR_NOT_FINITE);
    y = x, y.lower *= 1.001, y.upper = fmax(y.upper, y.lower);
    CHECK(ovoid_answer_verify(&p, &y, NULL, NULL) == OVOID_ERROR_PROOF);
    // Handed back: the same sign at once, without a search of doubles that cannot tell.
    ovoid_answer warm = ovoid_collide(&p, NULL, &x.proof);
    CHECK_EQ(warm.status, OVOID_SEPARATED);
    CHECK(holds(&p, &warm, NULL));
    // Garbage in the low half is refused or used, never believed.
    ovoid_proof bad = x.proof;
    const double garbage[] = {3, -1e300, 1e308, NAN, INFINITY, -x.proof.normal.x};
    for (int i = 0; i < 6; i++) {
        bad.normal_low = (ovoid_vec3){garbage[i], garbage[i], -x.proof.normal.z};
        warm = ovoid_collide(&p, NULL, &bad);
        CHECK_EQ(warm.status, OVOID_SEPARATED);
        CHECK(holds(&p, &warm, NULL));
    }
    ovoid_shape_destroy(a);
    judge_forget(court);
}

// Small hulls at random, closed in on a gap, and moved by what is missing: B by doubles near 1, A by doubles near 0.
// Truth: brute force over all features in exact arithmetic.
static void test_brute_force(uint64_t seed) {
    uint64_t r = check_seed = seed;
    double xyz[2][3 * 8];
    ovoid_shape *s[2];
    size_t counts[2];
    for (int k = 0; k < 2; k++) {
        counts[k] = 1 + (size_t)(random_next(&r) % 6);
        for (size_t i = 0; i < 3 * counts[k]; i++) xyz[k][i] = random_uniform(&r, -2, 2);
        double radius = random_next(&r) % 4 ? 0 : random_uniform(&r, 0, 1);
        s[k] = make_points(xyz[k], counts[k], radius);
    }
    double target = random_gap(&r) / 16;
    if (random_next(&r) % 2) target = -target;
    ovoid_pair p = {s[0], s[1], {{0, 0, 0}, {1, 0, 0, 0}}, {{2, 1, 1}, {1, 0, 0, 0}}};
    for (int k = 0; k < 2; k++) {
        ovoid_quat *q = k ? &p.pose_b.rotation : &p.pose_a.rotation;
        ovoid_vec3 v = random_vector(&r, 1);
        *q = (ovoid_quat){random_uniform(&r, -1, 1), v.x, v.y, v.z};
    }
    judge_truth truth;
    for (int k = 0; k < 8; k++) {
        CHECK_EQ(judge_compute_truth(court, &p, &truth, NULL), OVOID_OK);
        ovoid_answer x = ovoid_depth(&p, NULL, NULL, NULL);
        double step = k < 5 ? 0.5 * (truth.low + truth.high) : 0.5 * (truth.low + truth.high) - target;
        ovoid_vec3 *at = k < 5 ? &p.pose_b.position : &p.pose_a.position;
        double sign = k < 5 ? -1 : 1;
        at->x += sign * step * x.normal.x, at->y += sign * step * x.normal.y, at->z += sign * step * x.normal.z;
    }
    CHECK_EQ(judge_compute_truth(court, &p, &truth, NULL), OVOID_OK);
    STATIC_COVER(cover);
    ovoid_answer x[3] = {ovoid_collide(&p, NULL, NULL), ovoid_depth(&p, NULL, NULL, &cover),
                         ovoid_distance(&p, NULL, NULL)};
    double size = 12;
    for (int i = 0; i < 3; i++) {
        CHECK(holds(&p, &x[i], i == 1 ? &cover : NULL));
        CHECK(x[i].lower <= truth.high && truth.low <= x[i].upper);
        ovoid_status expected = truth.sign > 0 ? OVOID_SEPARATED : truth.sign < 0 ? OVOID_OVERLAPPING : OVOID_TOUCHING;
        if (truth.low > 1e-28 * size || truth.high < -1e-26 * size) CHECK_EQ(x[i].status, expected);
    }
    ovoid_shape_destroy(s[0]);
    ovoid_shape_destroy(s[1]);
    judge_forget(court);
}

// A capsule of the shape of a ball and a ball touch: their cores' direction has an angle of 3e-9 with the proven
// normal, so points along the normal, at the end of large radii, would be far off d normal.
static void test_touching_radii(void) {
    ovoid_shape_options o = {.radius = 728521410.16900837};
    const double core[3] = {-857697041.874403, 619775702.54419553, -175632938.04513964};
    ovoid_shape *a = ovoid_shape_create_capsule(813781412.3955431, 7.5960798663403395, NULL, NULL);
    ovoid_shape *b = ovoid_shape_create_from_points(core, 1, &o, NULL);
    ovoid_pair p = {a,
                    b,
                    {{106660751.01793988, 1103479743.0946143, -1735473399.0623937},
                     {-1.5505704719560272, -0.22643236195557742, -1.1688036542807254, 1.2244599776370872}},
                    {{1258868460.5980988, 1874911000.1777894, -2958741061.555315},
                     {-0.31905400405328721, -1.625074541209149, 0.87797390138714648, 0.075507325110861084}}};
    if (CHECK(a && b)) {
        ovoid_answer x = ovoid_depth(&p, NULL, NULL, NULL);
        CHECK(holds(&p, &x, NULL));
        CHECK(judge_verify_points(court, &p, &x, NULL) == OVOID_OK);
        CHECK_LE(vec3_norm(vec3_sub(x.point_b, x.point_a)), 1e-3);
    }
    ovoid_shape_destroy(a), ovoid_shape_destroy(b);
}

// The measurements' bits, whatever the search does with them: what gcc gave at -O3; clang and -O0 must give it too.
static void test_bits(void) {
    uint64_t r = 5, hash = 14695981039346656037u;
    for (int i = 0; i < 300; i++) {
        ovoid_shape *a = make_body(&r, FACE, 0, -0x1p-70, -1, 12, 0.25);
        ovoid_shape *b = make_body(&r, EDGE, 1, 0, 1, 12, 0);
        ovoid_pair p = {.shape_a = a, .shape_b = b};
        p.pose_a.position = random_vector(&r, 4), p.pose_a.rotation = random_turn(&r);
        p.pose_b.position = random_vector(&r, 4), p.pose_b.rotation = random_turn(&r);
        fine_frame f;
        CHECK(fine_make(&p, &f));
        ovoid_vec3 n = random_vector(&r, 1), low = random_vector(&r, 1e-20);
        fine_support found = fine_find_support(&f, dd3_unit(dd3_make(n, low)));
        ovoid_proof proof = {.count = 3, .a = {0, 1, 2}, .b = {2, 1, 0}};
        for (int k = 0; k < 3; k++) proof.weight_a[k] = proof.weight_b[k] = random_uniform(&r, 0, 1);
        dd distance = fine_measure_points(&f, &proof);
        dd3 w[6];
        for (uint32_t k = 0; k < 6; k++) w[k] = fine_difference(&f, k, k);
        double all[] = {found.gap.high,
                        found.gap.low,
                        found.a,
                        found.b,
                        distance.high,
                        distance.low,
                        w[5].x.low,
                        w[3].y.low,
                        fine_measure_hull(&f, w, 4, f.check),
                        fine_compute_lower(&f, found.gap, f.claim),
                        fine_compute_upper(&f, distance, f.claim)};
        for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
            unsigned char bytes[sizeof *all];
            memcpy(bytes, &all[k], sizeof bytes);
            for (size_t j = 0; j < sizeof bytes; j++) hash = (hash ^ bytes[j]) * 1099511628211u;
        }
        ovoid_shape_destroy(a), ovoid_shape_destroy(b);
    }
    if (!CHECK(hash == 0xfae4b94c46524affu)) printf("the hash is 0x%llxu\n", (unsigned long long)hash);
}

int main(void) {
    court = judge_create();
    if (!court) return 1;
    test_boxes();
    for (uint64_t seed = 1; seed <= 1500; seed++) test_meetings(seed);
    for (uint64_t seed = 1; seed <= 400; seed++) test_flat(seed);
    for (uint64_t seed = 1; seed <= 400; seed++) test_rounded(seed);
    for (uint64_t seed = 1; seed <= 100; seed++) test_brute_force(seed);
    check_seed = 0;
    test_far_vertices();
    for (uint64_t seed = 1; seed <= 40; seed++) test_far_turned(seed);
    check_seed = 0;
    test_tolerance();
    test_altered();
    test_many();
    test_touching_radii();
    test_bits();
    judge_destroy(court);
    return check_end();
}
