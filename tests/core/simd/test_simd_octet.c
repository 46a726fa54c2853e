// The kernels for eight pairs against their scalar twin, bit for bit: no tolerance. Lanes that a kernel reports as odd
// are not compared: they are left to the single query (tests/core/query/test_query_batch.c compares those, and the twin
// with it).
#include "simd/pair8.h"

#include "check.h"
#include "ovoid/ovoid.h"
#include "pair/inner.h"
#include "pair/reject.h"

enum { SHAPES = 24, ROUNDS = 400 };

/// How many columns, from the first one on, `spheres` writes.
enum { SPHERE_COLUMNS = offsetof(pair8, line) / sizeof(lane_column) };

static ovoid_shape *shapes[SHAPES];

// What the kernels read and write; two sets of columns, one for each contestant.
static ovoid_posed_shape bodies[PAIR8_GROUPS][2][PAIR8];
static pair8_places places[PAIR8_GROUPS];
static pair8 truth[PAIR8_GROUPS], other[PAIR8_GROUPS];
static pair8_group expected[PAIR8_GROUPS], found[PAIR8_GROUPS];

static uint64_t common_count;

static int make_shapes(uint64_t *s) {
    for (int i = 0; i < SHAPES; i++) {
        double xyz[3 * 20];
        size_t count = i < 4 ? (size_t)i + 1 : 4 + random_next(s) % 16;
        for (size_t k = 0; k < 3 * count; k++)
            xyz[k] = random_uniform(s, -1, 1) * (i % 5 == 4 && k % 3 == 0 ? 1e-3 : 1);
        ovoid_shape_options o = {.radius = i % 6 == 5 ? 0.25 : 0};
        shapes[i] = ovoid_shape_create_from_points(xyz, count, &o, NULL);
        if (!CHECK(shapes[i] != NULL)) return 0;
    }
    return 1;
}

// Now and then a number that no lane is made for.
static double spoil(uint64_t *s, double x) {
    static const double bad[] = {0, 1e-40, 1e40, NAN, INFINITY, 1e60};
    return random_next(s) % 200 == 0 ? bad[random_next(s) % 6] : x;
}

static ovoid_posed_shape make_body(uint64_t *s, double away) {
    ovoid_posed_shape b = {shapes[random_next(s) % SHAPES], {{0, 0, 0}, {0, 0, 0, 0}}};
    double *p = &b.pose.position.x, *q = &b.pose.rotation.w;
    for (int i = 0; i < 3; i++) p[i] = spoil(s, away * random_uniform(s, -1, 1));
    for (int i = 0; i < 4; i++) q[i] = spoil(s, random_uniform(s, -1, 1));
    if (random_next(s) % 40 == 0) b.pose.position = (ovoid_vec3){0, 0, 0};
    return b;
}

static void fill(uint64_t *s) {
    for (int i = 0; i < PAIR8_GROUPS; i++) {
        double away = random_uniform(s, 0.2, 4);
        truth[i].count = other[i].count = random_next(s) % 2 ? PAIR8 : 1 + (unsigned)(random_next(s) % PAIR8);
        for (int k = 0; k < PAIR8; k++) {
            ovoid_posed_shape *a = &bodies[i][0][k], *b = &bodies[i][1][k];
            *a = make_body(s, away);
            *b = make_body(s, away);
            places[i].pose_a[k] = &a->pose.position.x;
            places[i].pose_b[k] = &b->pose.position.x;
            places[i].shape_a[k] = &a->shape->radius;
            places[i].shape_b[k] = &b->shape->radius;
            expected[i].from.outer_a[k] = &a->shape->outer.center.x;
            expected[i].from.outer_b[k] = &b->shape->outer.center.x;
            expected[i].from.inner_a[k] = a->shape->inside.w;
            expected[i].from.inner_b[k] = b->shape->inside.w;
        }
        expected[i].lanes = &truth[i];
        found[i].from = expected[i].from;
        found[i].lanes = &other[i];
    }
}

// The lanes in use of a group.
static unsigned get_lanes(const pair8 *o) { return (1u << o->count) - 1; }

// The columns from one member on, so many, of the lanes meant.
static void compare(const lane_column *a, const lane_column *b, int count, unsigned lanes) {
    for (int i = 0; i < count; i++)
        for (unsigned rest = lanes; rest; rest &= rest - 1) {
            unsigned k = (unsigned)__builtin_ctz(rest);
            if (memcmp(&a[i].lane[k], &b[i].lane[k], sizeof(double)) != 0) CHECK_EQ(b[i].lane[k], a[i].lane[k]);
        }
}

static int same_found(const pair8_found *a, const pair8_found *b, unsigned lanes) {
    unsigned meant = ~a->odd & lanes;
    return ((a->odd ^ b->odd) & lanes) == 0 && ((a->inner ^ b->inner) & meant) == 0 &&
           ((a->apart ^ b->apart) & meant) == 0 && ((a->origin ^ b->origin) & meant) == 0 &&
           ((a->narrow ^ b->narrow) & meant) == 0;
}

static void check_place(const pair8_kernels *scalar, const pair8_kernels *kernels, pair8_query *ask) {
    for (int i = 0; i < PAIR8_GROUPS; i++) {
        pair8_found a = scalar->spheres(&places[i], ask, &truth[i]), b = kernels->spheres(&places[i], ask, &other[i]);
        unsigned lanes = get_lanes(&truth[i]), meant = ~a.odd & lanes;
        CHECK(same_found(&a, &b, lanes));
        compare(&truth[i].lower, &other[i].lower, 2, meant);
        if (ask->keeps_all) compare((lane_column *)&truth[i], (lane_column *)&other[i], SPHERE_COLUMNS, meant);
    }
}

// The lanes that take the line of centres.
static unsigned find_line(const pair8 *o) {
    unsigned line = 0;
    for (unsigned k = 0; k < PAIR8; k++) line |= (unsigned)(o->line.lane[k] > 0) << k;
    return line;
}

static void check_part(const pair8_kernels *scalar, const pair8_kernels *kernels, const pair8_query *ask,
                       unsigned count) {
    for (unsigned i = 0; i < count; i++)
        for (unsigned k = 0; k < PAIR8; k++) truth[i].line.lane[k] = other[i].line.lane[k] = (k + count) % (1 + i) == 1;
    scalar->ellipsoids(expected, count, ask);
    kernels->ellipsoids(found, count, ask);
    for (unsigned i = 0; i < count; i++) {
        const pair8 *a = &truth[i], *b = &other[i];
        unsigned lanes = get_lanes(a), meant = ~expected[i].found.odd & lanes, inner = meant & expected[i].found.inner;
        CHECK(same_found(&expected[i].found, &found[i].found, lanes));
        // A lane that takes the line of centres has no lower bound yet.
        unsigned bounded = meant & (inner | ~find_line(a));
        compare(&a->lower, &b->lower, 1, bounded);
        compare(&a->upper, &b->upper, 1, meant);
        compare(a->rotation, b->rotation, 9 + 3 + 1, meant);
        compare(a->inner, b->inner, 3, inner);
        compare(a->n, b->n, 3 + 3, meant & ~inner);
    }
}

// Common points in the world, beside those of the single query.
static void check_common(const pair8_kernels *kernels, const pair8_query *ask, unsigned odd) {
    pair8_common common;
    unsigned proven = kernels->inner(&expected[0].from, ask, &truth[0], &common);
    for (unsigned rest = get_lanes(&truth[0]) & ~odd; rest; rest &= rest - 1) {
        unsigned k = (unsigned)__builtin_ctz(rest);
        const ovoid_posed_shape *a = &bodies[0][0][k], *b = &bodies[0][1][k];
        ovoid_pair pair = {a->shape, b->shape, a->pose, b->pose};
        pair_frame f;
        vec3 x;
        if (frame_place(&pair, &f) != OVOID_LIMIT_NONE) continue;
        double upper = vec3_norm_squared(f.between) > 1e-150 ? inner_compute_upper_in_world(&f, &x) : 0;
        CHECK((proven >> k & 1) == (upper < 0));
        if (!(upper < 0)) continue;
        common_count++;
        CHECK_EQ(common.upper.lane[k], upper);
        CHECK(common.x[0].lane[k] == x.x && common.x[1].lane[k] == x.y && common.x[2].lane[k] == x.z);
    }
}

static void check_meet(const pair8_kernels *scalar, const pair8_kernels *kernels, uint64_t *s) {
    lane_column *x = &truth[0].high_value;
    for (int i = 0; i < 8; i++)
        for (int k = 0; k < PAIR8; k++) x[i].lane[k] = random_uniform(s, -1, 1);
    other[0] = truth[0];
    scalar->supports(&truth[0]);
    kernels->supports(&other[0]);
    unsigned meant = ~(expected[0].found.odd | expected[0].found.inner) & get_lanes(&truth[0]);
    compare(&truth[0].lower, &other[0].lower, 2, meant);
}

int main(void) {
    uint64_t s = 11;
    if (!make_shapes(&s)) return check_end();
    const pair8_kernels *scalar = pair8_get_kernels_of(SIMD_SCALAR);
    uint64_t apart = 0, inner = 0, odd = 0;
    for (int round = 0; round < ROUNDS; round++) {
        check_seed = (uint64_t)round;
        fill(&s);
        pair8_query ask = {round % 3 * 0.25,
                           round % 3 * 0.25,
                           0,
                           1e-9,
                           FRAME_REJECT,
                           FRAME_CLAIM,
                           OVOID_LENGTH_MIN,
                           OVOID_LENGTH_MAX,
                           1000,
                           1 + round % 2,
                           0};
        for (simd_isa isa = SIMD_SCALAR; isa <= SIMD_ISA_COUNT; isa++) {
            const pair8_kernels *kernels =
                isa == SIMD_ISA_COUNT ? pair8_get_kernels(truth[0].count) : pair8_get_kernels_of(isa);
            if (!kernels) continue;
            ask.keeps_all = 0;
            check_place(scalar, kernels, &ask);
            ask.keeps_all = 1;
            check_place(scalar, kernels, &ask);
            check_common(kernels, &ask, scalar->spheres(&places[0], &ask, &truth[0]).odd);
            check_part(scalar, kernels, &ask, 1 + (unsigned)round % PAIR8_GROUPS);
            check_meet(scalar, kernels, &s);
        }
        unsigned lanes = get_lanes(&truth[0]);
        apart += (uint64_t)__builtin_popcount(expected[0].found.apart & lanes);
        inner += (uint64_t)__builtin_popcount(expected[0].found.inner & lanes);
        odd += (uint64_t)__builtin_popcount(expected[0].found.odd & lanes);
    }
    // Every way was gone.
    CHECK(apart > 100 && inner > 100 && odd > 10 && common_count > 100);
    CHECK(strcmp(simd_isa_get_name(SIMD_AVX512), "avx512") == 0);
    for (int i = 0; i < SHAPES; i++) ovoid_shape_destroy(shapes[i]);
    return check_end();
}
