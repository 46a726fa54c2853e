// The search in single precision to supports that its caller finds (float_given of simd/float_gjk.h), one step of it,
// and the search of a body's columns for a support. Every instruction set has the bits of the scalar twin, and so has a
// couple alone; lanes that are idle change nothing. Truth, in doubles: the directions in B's axes; the gap along a
// direction that is not the simplex's heading; the second and the third direction, by their angles from the first; that
// a lane whose tilted support shows nothing new goes on along its heading; the vertex of the greatest value, and of
// equal ones the first. Floats round a few parts in 10^7, so 10^-5 is allowed.
#include "bits.h"
#include "linear/rotation.h"
#include "simd/float_gjk.h"

enum { ROUNDS = 4000, SEARCHES = 3000 };

static float_gjk before, truth, other;
static long tilted, straight, kept, ended;

static vec3 get(const float_column *c, unsigned k) { return (vec3){c[0].lane[k], c[1].lane[k], c[2].lane[k]}; }
static void put(float_column *c, unsigned k, vec3 v) {
    c[0].lane[k] = (float)v.x;
    c[1].lane[k] = (float)v.y;
    c[2].lane[k] = (float)v.z;
}

// A search at its first support, which comes from no simplex, or at a later one. Those along a tilted direction have
// one corner or two, none of them along it.
static void fill_lane(uint64_t *s, float_gjk *g, unsigned k) {
    int waits = (int)(random_next(s) % 3), is_first = waits == 0 && random_next(s) % 2;
    mat3 m = quat_to_mat3(bits_quat(s));
    put(g->query.rotation, k, m.r0);
    put(g->query.rotation + 3, k, m.r1);
    put(g->query.rotation + 6, k, m.r2);
    put(g->query.translation, k, bits_vec3(s, 0.2));
    g->query.claim.lane[k] = 1e-6f;
    g->query.size.lane[k] = 1.5f;
    g->query.far.lane[k] = random_next(s) % 4 ? 8 : 0;
    g->query.near.lane[k] = random_next(s) % 4 ? -1 : 0.5f;
    put(g->given.a, k, bits_vec3(s, 0.3));
    put(g->given.b, k, bits_vec3(s, 0.3));
    put(g->n, k, bits_vec3(s, 1));
    put(g->given.other, k, bits_vec3(s, 1));
    put(g->given.heading, k, bits_vec3(s, 1));
    g->given.tilt.lane[k] = (float)random_uniform(s, 0.05, 0.5);
    g->given.waits.lane[k] = (float)waits;
    unsigned valid = is_first ? 0 : waits == 2 ? 1 : waits == 1 ? 3 : 7;
    for (int i = 0; i < 3; i++) {
        put(&g->old[3 * i], k, bits_vec3(s, 1));
        g->is_valid[i].lane[k] = valid >> i & 1 ? -0.0f : 0.0f;
    }
    double square = vec3_norm_squared(get(g->given.heading, k));
    g->square.lane[k] = (float)square;
    g->height.lane[k] = is_first ? INFINITY : (float)(random_uniform(s, 0, 1) * sqrt(square));
    g->steps.lane[k] = (float)(is_first ? -1 : 2 - waits);
}

static void fill(uint64_t *s, float_gjk *g) {
    g->blocks = 0;
    g->most = random_next(s) % 4 ? 24 : (float)(1 + random_next(s) % 3);
    g->live = (unsigned)random_next(s) & FLOATS_ALL;
    for (unsigned k = 0; k < FLOATS; k++) fill_lane(s, g, k);
}

static void check_near_to(vec3 a, vec3 b) { CHECK_NEAR(vec3_norm(vec3_sub(a, b)), 0, 1e-5); }

// w: the difference of the supports.
static vec3 get_difference(const float_gjk *g, unsigned k) {
    vec3 b = get(g->given.b, k), in_a;
    const float_column *m = g->query.rotation;
    in_a.x = vec3_dot(get(m, k), b);
    in_a.y = vec3_dot(get(m + 3, k), b);
    in_a.z = vec3_dot(get(m + 6, k), b);
    return vec3_sub(vec3_add(in_a, get(g->query.translation, k)), get(g->given.a, k));
}

static void check_turn(const float_gjk_kernels *kernels) {
    other = before;
    kernels->turn(&other);
    for (unsigned k = 0; k < FLOATS; k++) {
        if (!(before.live >> k & 1)) continue;
        vec3 n = get(before.n, k), turned = {0, 0, 0};
        const double along[3] = {n.x, n.y, n.z};
        for (int i = 0; i < 3; i++) turned = vec3_add_scaled(turned, get(before.query.rotation + 3 * i, k), along[i]);
        check_near_to(get(other.given.b, k), turned);
    }
}

// After the first support.
static void check_sides(unsigned k, vec3 w) {
    vec3 n = vec3_unit(get(before.n, k)), off = vec3_add_scaled(w, n, -vec3_dot(n, w));
    double height = vec3_dot(n, w), length = vec3_norm(off), tilt = before.given.tilt.lane[k];
    double aside = length - tilt * fmax(height, 0), close = before.query.size.lane[k] - 8 * height;
    check_near_to(get(truth.given.heading, k), w);
    if (fabs(aside) < 1e-5 || fabs(close) < 1e-5) return;
    if (before.most <= 2 || aside < 0 || close < 0) {
        straight++;
        CHECK(truth.given.waits.lane[k] == 0);
        check_near_to(get(truth.n, k), w);
        return;
    }
    vec3 u = vec3_add_scaled(n, off, tilt / length), v = vec3_scale(vec3_cross(n, off), tilt / length);
    tilted++;
    CHECK(truth.given.waits.lane[k] == 2);
    check_near_to(get(truth.n, k), vec3_add(u, v));
    check_near_to(get(truth.given.other, k), vec3_sub(u, v));
}

// After a support along a tilted direction, whether it showed anything or not.
static void check_waiting(unsigned k, float waits) {
    const float_column *next = waits > 1 ? before.given.other : truth.given.heading;
    CHECK(truth.given.waits.lane[k] == waits - 1);
    CHECK(vec3_norm(vec3_sub(get(truth.n, k), get(next, k))) == 0);
    kept += vec3_norm(vec3_sub(get(truth.given.heading, k), get(before.given.heading, k))) == 0;
}

static void check_lane(const float_ends *ends, unsigned k) {
    vec3 w = get_difference(&before, k), n = get(before.n, k);
    float waits = before.given.waits.lane[k];
    unsigned by_bounds = (ends->apart | ends->near | ends->inside) >> k & 1, lives = truth.live >> k & 1;
    CHECK_NEAR((double)truth.lower.lane[k], vec3_dot(n, w) / vec3_norm(n), 1e-5);
    CHECK((truth.lower.lane[k] > before.query.far.lane[k]) == (ends->apart >> k & 1));
    ended += by_bounds;
    if (by_bounds) return;
    if (waits > 0) CHECK(lives);
    if (waits > 0)
        check_waiting(k, waits);
    else if (lives && before.steps.lane[k] < 0)
        check_sides(k, w);
    else if (lives)
        CHECK(vec3_norm(vec3_sub(get(truth.n, k), get(truth.given.heading, k))) == 0);
}

// Of truth values only the sign bits are read.
static int is_truth(const float_column *c) { return c >= truth.is_valid && c < truth.is_valid + 3; }

// Lane k of the truth and lane `at` of another search.
static void check_same(const float_column *a, const float_column *b, const float_column *end, unsigned k, unsigned at) {
    for (; a < end; a++, b++) {
        if (is_truth(a))
            CHECK(!signbit(a->lane[k]) == !signbit(b->lane[at]));
        else
            CHECK(memcmp(&a->lane[k], &b->lane[at], sizeof *a->lane) == 0);
    }
}

// The upper bound is of searches that ended by it.
static void check_search(const float_ends *ends, unsigned k, unsigned at) {
    check_same(truth.old, other.old, &truth.upper, k, at);
    if ((ends->apart | ends->near | ends->inside) >> k & 1)
        check_same(&truth.upper, &other.upper, &truth.upper + 1, k, at);
    check_same(truth.given.heading, other.given.heading, &truth.given.tilt, k, at);
}

// Each couple in lane 0, alone.
static void check_alone(const float_ends *ends) {
    const float_gjk_kernels *alone = float_gjk_get_kernels(1);
    for (unsigned k = 0; k < FLOATS; k++) {
        if (!(before.live >> k & 1)) continue;
        other = before;
        float_column *to = (float_column *)&other.query;
        const float_column *from = (const float_column *)&before.query;
        for (; to < other.found.corner; to++, from++) to->lane[0] = from->lane[k];
        to = other.given.a, from = before.given.a;
        for (; to <= &other.given.tilt; to++, from++) to->lane[0] = from->lane[k];
        other.live = 1;
        float_ends found = alone->advance(&other);
        CHECK(found.apart == (ends->apart >> k & 1) && found.near == (ends->near >> k & 1));
        CHECK(found.inside == (ends->inside >> k & 1) && found.open == (ends->open >> k & 1));
        CHECK(other.live == (truth.live >> k & 1));
        check_search(ends, k, 0);
    }
}

static void check_steps(uint64_t *s) {
    for (int round = 0; round < ROUNDS; round++) {
        check_seed = (uint64_t)round;
        fill(s, &before);
        truth = before;
        float_ends ends = float_gjk_get_kernels_of(SIMD_SCALAR)->advance(&truth);
        CHECK((ends.apart | ends.near | ends.inside | ends.open | truth.live) == before.live);
        for (unsigned k = 0; k < FLOATS; k++)
            if (before.live >> k & 1) check_lane(&ends, k);
        for (simd_isa isa = SIMD_SCALAR; isa < SIMD_ISA_COUNT; isa++) {
            const float_gjk_kernels *kernels = float_gjk_get_kernels_of(isa);
            if (!kernels) continue;
            check_turn(kernels);
            other = before;
            float_ends found = kernels->advance(&other);
            CHECK(memcmp(&found, &ends, sizeof ends) == 0 && other.live == truth.live);
            for (unsigned k = 0; k < FLOATS; k++)
                if (before.live >> k & 1) check_search(&ends, k, k);
        }
        if (round % 8 == 0) check_alone(&ends);
    }
    printf("tilted %ld, straight %ld, nothing new %ld, ended %ld\n", tilted, straight, kept, ended);
    CHECK(tilted > ROUNDS / 4 && straight > ROUNDS / 4 && kept > ROUNDS / 4 && ended > ROUNDS / 4);
}

// ---- supports

static double measure(const float *columns, uint32_t count, uint32_t i, const float n[3]) {
    return (double)columns[i] * (double)n[0] + (double)columns[count + i] * (double)n[1] +
           (double)columns[2 * count + i] * (double)n[2];
}

static int is_same(const float *columns, uint32_t count, uint32_t i, uint32_t j) {
    return columns[i] == columns[j] && columns[count + i] == columns[count + j] &&
           columns[2 * count + i] == columns[2 * count + j];
}

static void check_find(uint64_t *s) {
    static _Alignas(64) float columns[3 * FLOAT_COLUMN_POINTS];
    for (int round = 0; round < SEARCHES; round++) {
        uint32_t count = 8 * (1 + (uint32_t)random_next(s) % (FLOAT_COLUMN_POINTS / 8));
        float n[3];
        check_seed = (uint64_t)round;
        for (int d = 0; d < 3; d++) n[d] = (float)random_uniform(s, -1, 1);
        for (uint32_t i = 0; i < count; i++) {
            uint32_t twin = i && random_next(s) % 2 ? (uint32_t)random_next(s) % i : i;
            for (uint32_t d = 0; d < 3; d++)
                columns[d * count + i] = twin < i ? columns[d * count + twin] : (float)random_uniform(s, -1, 1);
        }
        uint32_t best = float_gjk_get_kernels_of(SIMD_SCALAR)->find(columns, count, n);
        for (uint32_t i = 0; i < count; i++) {
            CHECK(measure(columns, count, i, n) <= measure(columns, count, best, n) + 1e-5);
            if (i < best) CHECK(!is_same(columns, count, i, best));
        }
        for (simd_isa isa = SIMD_SCALAR; isa < SIMD_ISA_COUNT; isa++)
            if (float_gjk_get_kernels_of(isa)) CHECK(float_gjk_get_kernels_of(isa)->find(columns, count, n) == best);
        CHECK(float_gjk_get_kernels(1)->find(columns, count, n) == best);
    }
}

int main(void) {
    uint64_t s = 23;
    check_steps(&s);
    check_find(&s);
    return check_end();
}
