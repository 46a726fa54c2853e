// One step of GJK in lanes of AVX2, inline: corner.c has the method, its scalar twin, and the function for callers that
// are not compiled for AVX2.
#ifndef OVOID_SIMD_KERNELS_CORNER_AVX2_H
#define OVOID_SIMD_KERNELS_CORNER_AVX2_H

#include "simd/kernels/corner_pick.h"
#include "simd/kernels/vectors.h"

#define CORNER_AVX2 VECTORS_AVX2

/// Lane i becomes the old lane that follows i.
#define NEXT(v) _mm256_permute4x64_pd(v, 0xc9)

CORNER_AVX2 vectors4 next4(vectors4 a) { return (vectors4){NEXT(a.x), NEXT(a.y), NEXT(a.z)}; }

CORNER_AVX2 unsigned mask4(__m256d v) { return (unsigned)_mm256_movemask_pd(v); }

/// Lane i becomes the old lane before i.
#define PREVIOUS(v) _mm256_permute4x64_pd(v, 0xd2)

/// simd_step_from_corner to the new corner a, the same in all lanes. Signs are combined where they are, in the lanes'
/// sign bits, so that two masks are all that leaves the vectors.
CORNER_AVX2 corner_step corner_step_avx2(vectors4 old, unsigned valid, vectors4 a) {
#define SET (-INT64_MAX - 1)
    static const _Alignas(32) int64_t masks[8][2][4] = {
        {{0, 0, 0, 0}, {0, 0, 0, 0}},       {{SET, 0, 0, 0}, {0, 0, 0, 0}},          {{0, SET, 0, 0}, {0, 0, 0, 0}},
        {{SET, SET, 0, 0}, {SET, 0, 0, 0}}, {{0, 0, SET, 0}, {0, 0, 0, 0}},          {{SET, 0, SET, 0}, {0, 0, SET, 0}},
        {{0, SET, SET, 0}, {0, SET, 0, 0}}, {{SET, SET, SET, 0}, {SET, SET, SET, 0}}};
#undef SET
    __m256d corners = _mm256_load_pd((const double *)masks[valid & 7][0]);
    __m256d faces = _mm256_load_pd((const double *)masks[valid & 7][1]);
    __m256d full = valid == 7 ? faces : _mm256_setzero_pd();
    vectors4 e = {_mm256_sub_pd(old.x, a.x), _mm256_sub_pd(old.y, a.y), _mm256_sub_pd(old.z, a.z)};
    vectors4 f = next4(e), c = vectors4_cross(a, e), n = vectors4_cross(e, f), k = vectors4_cross(e, c);
    __m256d height = vectors4_dot(n, a), volume = vectors4_dot(n, next4(f));

    __m256d behind = _mm256_and_pd(_mm256_xor_pd(height, volume), full);
    __m256d first = _mm256_andnot_pd(vectors4_dot(n, c), faces), next = _mm256_and_pd(vectors4_dot(n, next4(c)), faces);
    __m256d face = _mm256_andnot_pd(behind, _mm256_and_pd(first, next));
    __m256d of_face = _mm256_or_pd(first, PREVIOUS(next));
    __m256d edge = _mm256_andnot_pd(of_face, _mm256_and_pd(vectors4_dot(a, e), corners));

    // Faces point away from the origin; the corner is the fourth of the edges.
    candidates all;
    __m256d flip = _mm256_and_pd(height, _mm256_set1_pd(-0.0));
    _mm256_store_pd(all.x, _mm256_xor_pd(n.x, flip));
    _mm256_store_pd(all.y, _mm256_xor_pd(n.y, flip));
    _mm256_store_pd(all.z, _mm256_xor_pd(n.z, flip));
    _mm256_store_pd(all.x + 4, _mm256_blend_pd(k.x, a.x, 8));
    _mm256_store_pd(all.y + 4, _mm256_blend_pd(k.y, a.y, 8));
    _mm256_store_pd(all.z + 4, _mm256_blend_pd(k.z, a.z, 8));
    _mm256_store_pd(all.edge, vectors4_dot(e, e));
    return candidates_pick(&all, mask4(face), mask4(edge), mask4(behind) == 7);
}

#undef PREVIOUS
#undef NEXT

#endif
