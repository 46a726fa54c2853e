// The scalar twin of small_gjk.h, and the choice among its kernels.
#include "simd/small_gjk_scalar.h"

#include "simd/small_gjk_kernel.h"

#include <stddef.h>

static void run_scalar(const small_gjk_query *query, small_gjk_result *result) { run_class(query, result); }

small_gjk_function *simd_get_small_gjk(simd_isa isa) {
    switch (isa) {
    case SIMD_SCALAR: return run_scalar;
#if defined(__x86_64__) && defined(__GNUC__)
    case SIMD_AVX2: return __builtin_cpu_supports("avx2") ? small_gjk_run_avx2 : NULL;
#endif
    default: return NULL;
    }
}

void simd_run_small_gjk(const small_gjk_query *query, small_gjk_result *result) {
#if defined(__x86_64__) && defined(__GNUC__)
    if (__builtin_cpu_supports("avx2")) {
        small_gjk_run_avx2(query, result);
        return;
    }
#endif
    run_scalar(query, result);
}
