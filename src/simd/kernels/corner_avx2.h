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

#define SET (-INT64_MAX - 1)
/// Of the corners that are valid, by their mask: the corners; the faces between them; the faces if there are three.
static const _Alignas(32) int64_t corner_masks[8][3][4] = {
    {{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}},       {{SET, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}},
    {{0, SET, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}},     {{SET, SET, 0, 0}, {SET, 0, 0, 0}, {0, 0, 0, 0}},
    {{0, 0, SET, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}},     {{SET, 0, SET, 0}, {0, 0, SET, 0}, {0, 0, 0, 0}},
    {{0, SET, SET, 0}, {0, SET, 0, 0}, {0, 0, 0, 0}}, {{SET, SET, SET, 0}, {SET, SET, SET, 0}, {SET, SET, SET, 0}}};
#undef SET

CORNER_AVX2 __m256d corner_mask(unsigned corners, int what) {
    return _mm256_load_pd((const double *)corner_masks[corners & 7][what]);
}

/// The directions of faces, of edges and of the new corner, and in sign bits which face or edge is meant.
typedef struct directions4 {
    vectors4 n, k, a;
    __m256d face, edge;
} directions4;

/// The direction that is meant, in all lanes, and its number: a face's, 4 more than an edge's, or 7. bits: the signs of
/// the faces, and from 4 on of the edges. It is taken out of the lanes by masks, as a load from where it has just been
/// stored would be waited for. Where rounding has set several bits, the first of them counts.
CORNER_AVX2 vectors4 pick4(directions4 d, unsigned bits, unsigned *number) {
    unsigned i = *number = (unsigned)__builtin_ctz(bits | 1u << 7);
    if (__builtin_expect((bits & (bits - 1)) != 0, 0)) {
        d.face = corner_mask(1u << i, 0);
        d.edge = corner_mask(1u << i >> 4, 0);
    }
    __m256d any = spread4(_mm256_or_pd(d.face, d.edge)), zero = _mm256_setzero_pd();
#define PICK(v) spread4(_mm256_blendv_pd(_mm256_blendv_pd(zero, d.k.v, d.edge), d.n.v, d.face))
    vectors4 p = {PICK(x), PICK(y), PICK(z)};
#undef PICK
    return (vectors4){_mm256_blendv_pd(d.a.x, p.x, any), _mm256_blendv_pd(d.a.y, p.y, any),
                      _mm256_blendv_pd(d.a.z, p.z, any)};
}

/// simd_step_from_corner to the new corner a, the same in all lanes. Signs are combined where they are, in the lanes'
/// sign bits. The order is one in which few numbers are held at a time: a number that is stored and read again takes
/// longer than what is computed from it.
CORNER_AVX2 corner_step corner_step_avx2(vectors4 old, unsigned valid, vectors4 a) {
    vectors4 e = {_mm256_sub_pd(old.x, a.x), _mm256_sub_pd(old.y, a.y), _mm256_sub_pd(old.z, a.z)};
    vectors4 f = next4(e), n = vectors4_cross(e, f);
    __m256d height = vectors4_dot(n, a), volume = vectors4_dot(n, next4(f));
    __m256d behind = _mm256_and_pd(_mm256_xor_pd(height, volume), corner_mask(valid, 2));
    int is_inside = mask4(behind) == 7;

    vectors4 c = vectors4_cross(a, e);
    __m256d faces = corner_mask(valid, 1), first = _mm256_andnot_pd(vectors4_dot(n, c), faces);
    __m256d next = _mm256_and_pd(vectors4_dot(n, next4(c)), faces);
    __m256d of_face = _mm256_or_pd(first, PREVIOUS(next));
    __m256d face = _mm256_andnot_pd(behind, _mm256_and_pd(first, next));
    __m256d before = _mm256_and_pd(vectors4_dot(a, e), corner_mask(valid, 0));
    __m256d edge = _mm256_andnot_pd(of_face, before);

    // The square of a face's direction is above `least` where it is no sliver.
    __m256d square = vectors4_dot(e, e);
    _Alignas(32) double least[4];
    _mm256_store_pd(least, _mm256_mul_pd(_mm256_set1_pd(1e-4), _mm256_mul_pd(square, NEXT(square))));

    // Faces point away from the origin.
    __m256d flip = _mm256_and_pd(height, _mm256_set1_pd(-0.0));
    n = (vectors4){_mm256_xor_pd(n.x, flip), _mm256_xor_pd(n.y, flip), _mm256_xor_pd(n.z, flip)};
    unsigned i, bits = mask4(face) | mask4(edge) << 4;
    vectors4 p = pick4((directions4){n, vectors4_cross(e, c), a, face, edge}, bits, &i);
    double length = _mm256_cvtsd_f64(vectors4_dot(p, p)), x = _mm256_cvtsd_f64(p.x), y = _mm256_cvtsd_f64(p.y);
    int is_sliver = (i < 3) & !(length > least[i & 3]);
    return (corner_step){x, y, _mm256_cvtsd_f64(p.z), length, corner_kept[i], is_inside, is_sliver};
}

#undef PREVIOUS
#undef NEXT

/// The same from the one corner of lane 0, where all lanes hold it: the only edge or the new corner.
CORNER_AVX2 corner_step corner_step_from_one_avx2(vectors4 old, vectors4 a) {
    vectors4 e = {_mm256_sub_pd(old.x, a.x), _mm256_sub_pd(old.y, a.y), _mm256_sub_pd(old.z, a.z)};
    vectors4 k = vectors4_cross(e, vectors4_cross(a, e));
    __m256d before = vectors4_dot(a, e);
    vectors4 p = {_mm256_blendv_pd(a.x, k.x, before), _mm256_blendv_pd(a.y, k.y, before),
                  _mm256_blendv_pd(a.z, k.z, before)};
    double x = _mm256_cvtsd_f64(p.x), y = _mm256_cvtsd_f64(p.y), length = _mm256_cvtsd_f64(vectors4_dot(p, p));
    return (corner_step){x, y, _mm256_cvtsd_f64(p.z), length, mask4(before) & 1, 0, 0};
}

#endif
