// GJK of two small bodies: the vector kernel against its scalar twin, bit for bit, no tolerance; then
// again from the corners where that ended, the bodies a little moved, or from any. What the answers made
// from it are worth is for the judge (test_query_trials) to say.
#include "exact/small.h"
#include "small_searches.h"

enum { ROUNDS = 40000 };

// The first corners where a search ended, at most three; for some any points.
static small_gjk_kept find_corners(uint64_t *s, const small_gjk_query *q, const small_gjk_result *x) {
    small_gjk_kept kept = {.count = 0};
    for (uint32_t i = 0; i < 4 && x->end != SMALL_GJK_OPEN; i++)
        if (x->valid >> i & 1 && kept.count < 3) kept.a[kept.count] = x->a[i], kept.b[kept.count++] = x->b[i];
    if (kept.count && random_next(s) % 4) return kept;
    kept.count = 1 + (uint32_t)(random_next(s) % 3);
    for (uint32_t i = 0; i < kept.count; i++) {
        kept.a[i] = (uint32_t)(random_next(s) % q->a.padded_count);
        kept.b[i] = (uint32_t)(random_next(s) % q->b.padded_count);
    }
    return kept;
}

static small_gjk_kept find_kept(uint64_t *s, const small_gjk_query *q, const small_gjk_result *x) {
    small_gjk_kept kept = find_corners(s, q, x);
    for (uint32_t i = kept.count; i < 4; i++) kept.a[i] = kept.a[0], kept.b[i] = kept.b[0];
    return kept;
}

// The kernel of AVX-512 too, where the machine has it.
static void compare_widest(const small_gjk_query *q, const small_gjk_result *x) {
    small_gjk_function *widest = simd_get_small_gjk(SIMD_AVX512);
    small_gjk_result y;
    if (!widest) return;
    widest(q, &y);
    CHECK(same_search(x, &y));
}

static void compare_widest_kept(const small_gjk_query *q, const small_gjk_kept *kept, const small_gjk_result *x) {
    small_gjk_kept_function *widest = simd_get_small_gjk_kept(SIMD_AVX512);
    small_gjk_result y;
    if (!widest) return;
    widest(q, kept, &y);
    CHECK(same_search(x, &y));
}

static void run_again(uint64_t *s, small_gjk_query *q, const small_gjk_result *before, long ends[5]) {
    small_gjk_result x, y, z;
    small_gjk_kept kept = find_kept(s, q, before);
    for (int i = 0; i < 3; i++) q->offset[i] += random_next(s) % 2 ? random_uniform(s, -0.1, 0.1) : 0;
    simd_get_small_gjk_kept(SIMD_SCALAR)(q, &kept, &x);
    simd_get_small_gjk_kept(SIMD_AVX2)(q, &kept, &y);
    simd_run_small_gjk_kept(q, &kept, &z);
    CHECK(same_search(&x, &y));
    CHECK(same_search(&x, &z));
    compare_widest_kept(q, &kept, &x);
    ends[x.end]++;
    simd_get_find_kept(SIMD_SCALAR)(q, &kept, &x);
    simd_get_find_kept(SIMD_AVX2)(q, &kept, &y);
    simd_find_kept(q, &kept, &z);
    CHECK(same_search(&x, &y));
    CHECK(same_search(&x, &z));
}

// The same search of bodies that are not posed.
static void check_unposed(const small_gjk_query *q, long ends[5]) {
    small_gjk_result x, y, z;
    simd_get_small_gjk_unposed(SIMD_SCALAR)(q, &x);
    simd_get_small_gjk_unposed(SIMD_AVX2)(q, &y);
    simd_run_small_gjk_unposed(q, &z);
    CHECK(same_search(&x, &y));
    CHECK(same_search(&x, &z));
    ends[x.end]++;
}

// Claims that are a visible part of the bodies, and radii that allowances make differ: a search that ends near with an
// answer has one by the bounds that are then made of its corners, which round otherwise.
static void check_confirmed(uint64_t *s, small_gjk_function *twin) {
    long ended = 0, open = 0;
    for (int i = 0; i < ROUNDS; i++) {
        double rows[2][9];
        small_gjk_query q;
        small_gjk_result r;
        small_end end;
        fill_search(s, &q, rows);
        pair_frame f = {.size = 0.02 / (256 * 0x1p-53), .hidden = OVOID_LENGTH_MIN};
        q.claim = reject_get_claim(&f);
        q.tolerance = 2.5 * q.claim;
        f.lower_radii = q.lower_radii;
        f.upper_radii = q.upper_radii = 0.9 * q.lower_radii;
        query_goal goal = {.far = q.far, .near = q.near, .tolerance = q.tolerance, .wants_bracket = q.wants_bracket};
        twin(&q, &r);
        if (r.end != SMALL_GJK_NEAR) continue;
        ended++;
        open += !small_finish(&f, &goal, &r, &end);
    }
    printf("%ld of %ld ends near are not confirmed\n", open, ended);
    CHECK(ended > 1000 && 200 * open <= ended);
}

int main(void) {
    uint64_t s = 11;
    small_gjk_function *twin = simd_get_small_gjk(SIMD_SCALAR), *vector = simd_get_small_gjk(SIMD_AVX2);
    if (!vector || !simd_get_small_gjk_kept(SIMD_AVX2)) {
        check_skip("this machine or build has no AVX2");
        return check_end();
    }
    if (!make_bodies(SMALL_GJK_POINTS)) return 1;
    check_confirmed(&s, twin);
    long ends[5] = {0}, again[5] = {0}, unposed[5] = {0};
    for (int i = 0; i < ROUNDS; i++) {
        double rows[2][9];
        small_gjk_query q;
        small_gjk_result x, y, z;
        fill_search(&s, &q, rows);
        twin(&q, &x);
        vector(&q, &y);
        simd_run_small_gjk(&q, &z);
        CHECK(same_search(&x, &y));
        CHECK(same_search(&x, &z));
        compare_widest(&q, &x);
        ends[x.end]++;
        check_unposed(&q, unposed);
        run_again(&s, &q, &x, again);
    }
    for (int i = 0; i < 5; i++) {
        if (i != SMALL_GJK_KEPT) CHECK_LE(ROUNDS / 100, ends[i]);
        if (i != SMALL_GJK_KEPT) CHECK_LE(ROUNDS / 100, unposed[i]);
        CHECK_LE(ROUNDS / 100, again[i]);
    }
    destroy_bodies();
    return check_end();
}
