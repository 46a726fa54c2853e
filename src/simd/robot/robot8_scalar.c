// The scalar twin of the kernels of robot8.h, and the choice among them.
#include "simd/kernels/baseline_lanes.h"

#include "simd/robot/robot8_kernel.h"

#include "simd/robot/cover8_kernel.h"

#include <stddef.h>

static const robot8_kernels scalar = ROBOT8_KERNELS;

const robot8_kernels *robot8_get_kernels_of(simd_isa isa) {
    switch (isa) {
    case SIMD_SCALAR: return &scalar;
#if defined(__x86_64__) && defined(__GNUC__)
    case SIMD_AVX2: return __builtin_cpu_supports("avx2") ? &robot8_avx2 : NULL;
    case SIMD_AVX512: return __builtin_cpu_supports("avx512f") ? &robot8_avx512 : NULL;
#endif
    default: return NULL;
    }
}

const robot8_kernels *robot8_get_kernels(void) {
    for (int isa = SIMD_ISA_COUNT - 1; isa > SIMD_SCALAR; isa--) {
        const robot8_kernels *best = robot8_get_kernels_of((simd_isa)isa);
        if (best) return best;
    }
    return &scalar;
}
