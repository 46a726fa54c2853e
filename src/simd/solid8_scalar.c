// The scalar twin of the kernels of solid8.h, and the choice among them.
#include "simd/narrowest.h"

#include "simd/solid8_kernel.h"

#include <stddef.h>

static const solid8_kernels scalar = {run_boxes, run_triangles};

const solid8_kernels *solid8_get_kernels_of(simd_isa isa) {
    switch (isa) {
    case SIMD_SCALAR: return &scalar;
#if defined(__x86_64__) && defined(__GNUC__)
    case SIMD_AVX2: return __builtin_cpu_supports("avx2") ? &solid8_avx2 : NULL;
    case SIMD_AVX512: return __builtin_cpu_supports("avx512f") ? &solid8_avx512 : NULL;
#endif
    default: return NULL;
    }
}

const solid8_kernels *solid8_get_kernels(void) {
    for (int isa = SIMD_ISA_COUNT - 1; isa > SIMD_SCALAR; isa--) {
        const solid8_kernels *best = solid8_get_kernels_of((simd_isa)isa);
        if (best) return best;
    }
    return &scalar;
}
