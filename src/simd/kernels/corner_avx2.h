// One step of GJK in lanes of AVX2, inline: corner.c has the method, its scalar twin, and the function for callers that
// are not compiled for AVX2.
#ifndef OVOID_SIMD_KERNELS_CORNER_AVX2_H
#define OVOID_SIMD_KERNELS_CORNER_AVX2_H

#include "simd/kernels/corner_pick.h"

#include <immintrin.h>

#define CORNER_AVX2 __attribute__((target("avx2"))) static inline __attribute__((always_inline))

typedef struct lanes3 {
    __m256d x, y, z;
} lanes3;

CORNER_AVX2 __m256d dot4(lanes3 a, lanes3 b) {
    return _mm256_add_pd(_mm256_add_pd(_mm256_mul_pd(a.x, b.x), _mm256_mul_pd(a.y, b.y)), _mm256_mul_pd(a.z, b.z));
}

CORNER_AVX2 lanes3 cross4(lanes3 a, lanes3 b) {
    return (lanes3){_mm256_sub_pd(_mm256_mul_pd(a.y, b.z), _mm256_mul_pd(a.z, b.y)),
                    _mm256_sub_pd(_mm256_mul_pd(a.z, b.x), _mm256_mul_pd(a.x, b.z)),
                    _mm256_sub_pd(_mm256_mul_pd(a.x, b.y), _mm256_mul_pd(a.y, b.x))};
}

/// Lane i becomes the old lane that follows i.
#define NEXT(v) _mm256_permute4x64_pd(v, 0xc9)

CORNER_AVX2 lanes3 next4(lanes3 a) { return (lanes3){NEXT(a.x), NEXT(a.y), NEXT(a.z)}; }

CORNER_AVX2 unsigned mask4(__m256d v) { return (unsigned)_mm256_movemask_pd(v); }

/// Lane i becomes the old lane before i.
#define PREVIOUS(v) _mm256_permute4x64_pd(v, 0xd2)

/// simd_step_from_corner to the new corner a, the same in all lanes. Signs are combined where they are, in the lanes'
/// sign bits, so that two masks are all that leaves the vectors.
CORNER_AVX2 corner_step corner_step_avx2(lanes3 old, unsigned valid, lanes3 a) {
#define SET (-INT64_MAX - 1)
    static const _Alignas(32) int64_t masks[8][2][4] = {
        {{0, 0, 0, 0}, {0, 0, 0, 0}},       {{SET, 0, 0, 0}, {0, 0, 0, 0}},          {{0, SET, 0, 0}, {0, 0, 0, 0}},
        {{SET, SET, 0, 0}, {SET, 0, 0, 0}}, {{0, 0, SET, 0}, {0, 0, 0, 0}},          {{SET, 0, SET, 0}, {0, 0, SET, 0}},
        {{0, SET, SET, 0}, {0, SET, 0, 0}}, {{SET, SET, SET, 0}, {SET, SET, SET, 0}}};
#undef SET
    __m256d corners = _mm256_load_pd((const double *)masks[valid & 7][0]);
    __m256d faces = _mm256_load_pd((const double *)masks[valid & 7][1]);
    __m256d full = valid == 7 ? faces : _mm256_setzero_pd();
    lanes3 e = {_mm256_sub_pd(old.x, a.x), _mm256_sub_pd(old.y, a.y), _mm256_sub_pd(old.z, a.z)};
    lanes3 f = next4(e), c = cross4(a, e), n = cross4(e, f), k = cross4(e, c);
    __m256d height = dot4(n, a), volume = dot4(n, next4(f));

    __m256d behind = _mm256_and_pd(_mm256_xor_pd(height, volume), full);
    __m256d first = _mm256_andnot_pd(dot4(n, c), faces), next = _mm256_and_pd(dot4(n, next4(c)), faces);
    __m256d face = _mm256_andnot_pd(behind, _mm256_and_pd(first, next));
    __m256d of_face = _mm256_or_pd(first, PREVIOUS(next));
    __m256d edge = _mm256_andnot_pd(of_face, _mm256_and_pd(dot4(a, e), corners));

    // Faces point away from the origin; the corner is the fourth of the edges.
    candidates all;
    __m256d flip = _mm256_and_pd(height, _mm256_set1_pd(-0.0));
    _mm256_store_pd(all.x, _mm256_xor_pd(n.x, flip));
    _mm256_store_pd(all.y, _mm256_xor_pd(n.y, flip));
    _mm256_store_pd(all.z, _mm256_xor_pd(n.z, flip));
    _mm256_store_pd(all.x + 4, _mm256_blend_pd(k.x, a.x, 8));
    _mm256_store_pd(all.y + 4, _mm256_blend_pd(k.y, a.y, 8));
    _mm256_store_pd(all.z + 4, _mm256_blend_pd(k.z, a.z, 8));
    _mm256_store_pd(all.edge, dot4(e, e));
    return candidates_pick(&all, mask4(face), mask4(edge), mask4(behind) == 7);
}

#undef PREVIOUS
#undef NEXT

#endif
