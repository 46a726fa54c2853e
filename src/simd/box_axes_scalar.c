// The scalar twin of the kernel of box_axes.h, and the choice among them.
#include "simd/narrowest.h"

#include "simd/box_axes_kernel.h"

#include <stddef.h>

const uint8_t box_axes_first[BOX_AXES] = {0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 3, 3, 4, 4};
const uint8_t box_axes_second[BOX_AXES] = {1, 2, 3, 4, 5, 2, 3, 4, 5, 3, 4, 5, 4, 5, 5, 5};

static int find_scalar(const box_axes_query *query, box_axes *out) { return run_axes(query, out); }

#if defined(__x86_64__) && defined(__GNUC__)

box_axes_function *box_axes_get(simd_isa isa) {
    switch (isa) {
    case SIMD_SCALAR: return find_scalar;
    case SIMD_AVX2: return __builtin_cpu_supports("avx2") ? box_axes_find_avx2 : NULL;
    case SIMD_AVX512: return __builtin_cpu_supports("avx512f") ? box_axes_find_avx512 : NULL;
    default: return NULL;
    }
}

int box_axes_find(const box_axes_query *query, box_axes *out) {
    if (__builtin_cpu_supports("avx512f")) return box_axes_find_avx512(query, out);
    if (__builtin_cpu_supports("avx2")) return box_axes_find_avx2(query, out);
    return find_scalar(query, out);
}

#else

box_axes_function *box_axes_get(simd_isa isa) { return isa == SIMD_SCALAR ? find_scalar : NULL; }

int box_axes_find(const box_axes_query *query, box_axes *out) { return find_scalar(query, out); }

#endif
