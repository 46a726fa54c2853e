// The scalar twin of the kernels of pair8.h, and the choice among them.
#include "simd/narrowest.h"

#include "simd/pair8_kernel.h"

#include <stddef.h>

static const pair8_kernels scalar = {run_spheres, run_ellipsoids, run_supports};

const pair8_kernels *pair8_get_kernels_of(simd_isa isa) {
    switch (isa) {
    case SIMD_SCALAR: return &scalar;
#if defined(__x86_64__) && defined(__GNUC__)
    case SIMD_AVX2: return __builtin_cpu_supports("avx2") ? &pair8_avx2 : NULL;
    case SIMD_AVX512: return __builtin_cpu_supports("avx512f") ? &pair8_avx512 : NULL;
#endif
    default: return NULL;
    }
}

const pair8_kernels *pair8_get_kernels(void) {
    for (int isa = SIMD_ISA_COUNT - 1; isa > SIMD_SCALAR; isa--) {
        const pair8_kernels *best = pair8_get_kernels_of((simd_isa)isa);
        if (best) return best;
    }
    return &scalar;
}
