// The scalar twin of the kernels of octet.h, and the choice among them.
#define LANES 1
#include "simd/octet_kernel.h"

#include "simd/octet_sets.h"

#include <stddef.h>

static const octet_kernels scalar = {place, part, meet};

const octet_kernels *octet_get_kernels_of(simd_isa isa) {
    switch (isa) {
    case SIMD_SCALAR: return &scalar;
#if defined(__x86_64__) && defined(__GNUC__)
    case SIMD_AVX2: return __builtin_cpu_supports("avx2") ? &octet_avx2 : NULL;
    case SIMD_AVX512: return __builtin_cpu_supports("avx512f") ? &octet_avx512 : NULL;
#endif
    default: return NULL;
    }
}

const octet_kernels *octet_get_kernels(void) {
    for (int isa = SIMD_ISA_COUNT - 1; isa > SIMD_SCALAR; isa--) {
        const octet_kernels *best = octet_get_kernels_of((simd_isa)isa);
        if (best) return best;
    }
    return &scalar;
}
