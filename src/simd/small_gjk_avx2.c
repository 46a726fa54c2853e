// small_gjk.h for AVX2.
#if defined(__x86_64__) && defined(__GNUC__)

#include "simd/small_gjk_avx2.h"
#include "simd/small_gjk_kept.h"

__attribute__((target("avx2"))) void small_gjk_run_avx2(const small_gjk_query *query, small_gjk_result *result) {
    run_class(query, result);
}

__attribute__((target("avx2"))) void small_gjk_run_kept_avx2(const small_gjk_query *query, const small_gjk_kept *kept,
                                                             small_gjk_result *result) {
    run_kept_class(query, kept, result);
}

__attribute__((target("avx2"))) void small_gjk_find_kept_avx2(const small_gjk_query *query, const small_gjk_kept *kept,
                                                              small_gjk_result *result) {
    find_kept(query, kept, result);
}

#else
#include "simd/small_gjk.h"
#endif
