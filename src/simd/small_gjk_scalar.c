// The scalar twin of small_gjk.h, and the choice among its kernels.
#include "simd/small_gjk_scalar.h"

#include "simd/small_gjk_kept.h"

#include <stddef.h>

static void run_scalar(const small_gjk_query *query, small_gjk_result *result) { run_class(query, result); }

static void run_kept_scalar(const small_gjk_query *query, const small_gjk_kept *kept, small_gjk_result *result) {
    run_kept_class(query, kept, result);
}

static void find_kept_scalar(const small_gjk_query *query, const small_gjk_kept *kept, small_gjk_result *result) {
    find_kept(query, kept, result);
}

#if defined(__x86_64__) && defined(__GNUC__)

static int has_avx2(void) { return __builtin_cpu_supports("avx2") != 0; }

small_gjk_function *simd_get_small_gjk(simd_isa isa) {
    if (isa == SIMD_SCALAR) return run_scalar;
    return isa == SIMD_AVX2 && has_avx2() ? small_gjk_run_avx2 : NULL;
}

small_gjk_kept_function *simd_get_small_gjk_kept(simd_isa isa) {
    if (isa == SIMD_SCALAR) return run_kept_scalar;
    return isa == SIMD_AVX2 && has_avx2() ? small_gjk_run_kept_avx2 : NULL;
}

small_gjk_kept_function *simd_get_find_kept(simd_isa isa) {
    if (isa == SIMD_SCALAR) return find_kept_scalar;
    return isa == SIMD_AVX2 && has_avx2() ? small_gjk_find_kept_avx2 : NULL;
}

void simd_run_small_gjk(const small_gjk_query *query, small_gjk_result *result) {
    if (has_avx2())
        small_gjk_run_avx2(query, result);
    else
        run_scalar(query, result);
}

void simd_run_small_gjk_kept(const small_gjk_query *query, const small_gjk_kept *kept, small_gjk_result *result) {
    if (has_avx2())
        small_gjk_run_kept_avx2(query, kept, result);
    else
        run_kept_scalar(query, kept, result);
}

void simd_find_kept(const small_gjk_query *query, const small_gjk_kept *kept, small_gjk_result *result) {
    if (has_avx2())
        small_gjk_find_kept_avx2(query, kept, result);
    else
        find_kept_scalar(query, kept, result);
}

#else

small_gjk_function *simd_get_small_gjk(simd_isa isa) { return isa == SIMD_SCALAR ? run_scalar : NULL; }
small_gjk_kept_function *simd_get_small_gjk_kept(simd_isa isa) { return isa == SIMD_SCALAR ? run_kept_scalar : NULL; }
small_gjk_kept_function *simd_get_find_kept(simd_isa isa) { return isa == SIMD_SCALAR ? find_kept_scalar : NULL; }

void simd_run_small_gjk(const small_gjk_query *query, small_gjk_result *result) { run_scalar(query, result); }

void simd_run_small_gjk_kept(const small_gjk_query *query, const small_gjk_kept *kept, small_gjk_result *result) {
    run_kept_scalar(query, kept, result);
}

void simd_find_kept(const small_gjk_query *query, const small_gjk_kept *kept, small_gjk_result *result) {
    find_kept_scalar(query, kept, result);
}

#endif
