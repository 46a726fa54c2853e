// The scalar twin of the kernel of epa8.h, and the choice among them.
#include "simd/narrowest.h"

#include "simd/epa8_kernel.h"

#include <stddef.h>

static epa8_end grow_scalar(epa8 *s, const epa8_query *query) { return run_grow(s, query); }

#if defined(__x86_64__) && defined(__GNUC__)

epa8_function *epa8_get(simd_isa isa) {
    switch (isa) {
    case SIMD_SCALAR: return grow_scalar;
    case SIMD_AVX2: return __builtin_cpu_supports("avx2") ? epa8_grow_avx2 : NULL;
    case SIMD_AVX512: return __builtin_cpu_supports("avx512f") ? epa8_grow_avx512 : NULL;
    default: return NULL;
    }
}

epa8_end epa8_grow(epa8 *s, const epa8_query *query) {
    if (__builtin_cpu_supports("avx512f")) return epa8_grow_avx512(s, query);
    if (__builtin_cpu_supports("avx2")) return epa8_grow_avx2(s, query);
    return grow_scalar(s, query);
}

#else

epa8_function *epa8_get(simd_isa isa) { return isa == SIMD_SCALAR ? grow_scalar : NULL; }

epa8_end epa8_grow(epa8 *s, const epa8_query *query) { return grow_scalar(s, query); }

#endif
