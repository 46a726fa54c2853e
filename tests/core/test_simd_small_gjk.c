// GJK of two small bodies: the vector kernel against its scalar twin, bit for bit, no tolerance. What the answers made
// from it are worth is for the judge (test_query_trials) to say.
#include "small_searches.h"

enum { ROUNDS = 40000 };

int main(void) {
    uint64_t s = 11;
    small_gjk_function *twin = simd_get_small_gjk(SIMD_SCALAR), *vector = simd_get_small_gjk(SIMD_AVX2);
    if (!vector) {
        check_skip("this machine or build has no AVX2");
        return check_end();
    }
    if (!make_bodies()) return 1;
    long ends[4] = {0, 0, 0, 0};
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
        ends[x.end]++;
    }
    for (int i = 0; i < 4; i++) CHECK_LE(ROUNDS / 100, ends[i]);
    destroy_bodies();
    return check_end();
}
