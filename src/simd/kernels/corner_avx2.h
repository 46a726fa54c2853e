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

/// The one lane that is not zero, in all lanes.
CORNER_AVX2 __m256d spread4(__m256d v) {
    v = _mm256_or_pd(v, _mm256_permute2f128_pd(v, v, 1));
    return _mm256_or_pd(v, _mm256_permute_pd(v, 5));
}

/// The candidate whose sign bit is set: of the faces, of the edges, else the corner. In registers: a load from where it
/// has just been written would be waited for. Where rounding has set more than one, the first.
CORNER_AVX2 vectors4 pick4(vectors4 n, __m256d face, vectors4 k, __m256d edge, vectors4 corner, unsigned bits,
                           unsigned *place) {
    unsigned i = *place = (unsigned)__builtin_ctz(bits | 1u << 7);
    if (__builtin_expect((bits & (bits - 1)) != 0, 0)) {
        static const _Alignas(32) int64_t only[8][4] = {{-1, 0, 0, 0}, {0, -1, 0, 0}, {0, 0, -1, 0}, {0, 0, 0, -1},
                                                        {0, 0, 0, 0},  {0, 0, 0, 0},  {0, 0, 0, 0},  {0, 0, 0, 0}};
        face = _mm256_load_pd((const double *)only[i]);
        edge = _mm256_load_pd((const double *)only[i ^ 4]);
    }
    __m256d any = spread4(_mm256_or_pd(face, edge)), zero = _mm256_setzero_pd();
#define PICK(v) _mm256_blendv_pd(corner.v, spread4(_mm256_blendv_pd(_mm256_blendv_pd(zero, k.v, edge), n.v, face)), any)
    return (vectors4){PICK(x), PICK(y), PICK(z)};
#undef PICK
}

/// simd_step_from_corner to the new corner a, the same in all lanes. Signs are combined where they are, in the lanes'
/// sign bits, so that two masks are all that leaves the vectors.
CORNER_AVX2 corner_step corner_step_avx2(vectors4 old, unsigned valid, vectors4 a) {
#define SET (-INT64_MAX - 1)
    // Of the corners that are valid: the corners; the faces between them; the faces if there are three of them.
    static const _Alignas(32) int64_t masks[8][3][4] = {
        {{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}},       {{SET, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}},
        {{0, SET, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}},     {{SET, SET, 0, 0}, {SET, 0, 0, 0}, {0, 0, 0, 0}},
        {{0, 0, SET, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}},     {{SET, 0, SET, 0}, {0, 0, SET, 0}, {0, 0, 0, 0}},
        {{0, SET, SET, 0}, {0, SET, 0, 0}, {0, 0, 0, 0}}, {{SET, SET, SET, 0}, {SET, SET, SET, 0}, {SET, SET, SET, 0}}};
#undef SET
    vectors4 e = {_mm256_sub_pd(old.x, a.x), _mm256_sub_pd(old.y, a.y), _mm256_sub_pd(old.z, a.z)};
    vectors4 f = next4(e), n = vectors4_cross(e, f);
    __m256d height = vectors4_dot(n, a), volume = vectors4_dot(n, next4(f));
    __m256d behind = _mm256_and_pd(_mm256_xor_pd(height, volume), _mm256_load_pd((const double *)masks[valid & 7][2]));
    int is_inside = mask4(behind) == 7;

    vectors4 c = vectors4_cross(a, e);
    __m256d faces = _mm256_load_pd((const double *)masks[valid & 7][1]);
    __m256d first = _mm256_andnot_pd(vectors4_dot(n, c), faces), next = _mm256_and_pd(vectors4_dot(n, next4(c)), faces);
    __m256d of_face = _mm256_or_pd(first, PREVIOUS(next));
    __m256d face = _mm256_andnot_pd(behind, _mm256_and_pd(first, next));
    __m256d before = _mm256_and_pd(vectors4_dot(a, e), _mm256_load_pd((const double *)masks[valid & 7][0]));
    __m256d edge = _mm256_andnot_pd(of_face, before);

    // The least square of a face's direction, where it is no sliver.
    __m256d square = vectors4_dot(e, e);
    _Alignas(32) double least[4];
    _mm256_store_pd(least, _mm256_mul_pd(_mm256_set1_pd(1e-4), _mm256_mul_pd(square, NEXT(square))));

    // Faces point away from the origin.
    __m256d flip = _mm256_and_pd(height, _mm256_set1_pd(-0.0));
    n = (vectors4){_mm256_xor_pd(n.x, flip), _mm256_xor_pd(n.y, flip), _mm256_xor_pd(n.z, flip)};
    unsigned i, bits = mask4(face) | mask4(edge) << 4;
    vectors4 p = pick4(n, face, vectors4_cross(e, c), edge, a, bits, &i);
    double length = _mm256_cvtsd_f64(vectors4_dot(p, p));
    return (corner_step){_mm256_cvtsd_f64(p.x),
                         _mm256_cvtsd_f64(p.y),
                         _mm256_cvtsd_f64(p.z),
                         length,
                         candidates_kept[i],
                         is_inside,
                         (i < 3) & !(length > least[i & 3])};
}

#undef PREVIOUS
#undef NEXT

#endif
