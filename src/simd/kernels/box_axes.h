// The kernels of box_axes.h, written once over lanes; scalar.c, avx2.c and avx512.c include
// this. Every number is computed lane by lane in one order, so all widths give the same bits.
#include "simd/box_axes.h"
#include "simd/kernels/lanes.h"

// For each segment the pairs that it is of.
static const uint16_t own_pairs[BOX_AXES_SEGMENTS] = {0x001f, 0x01e1, 0x0e22, 0x3244, 0xd488, 0xe910};

#if LANES == 8
/// The numbers of an array of eight at LANES places.
LANES_INLINE lane lane_take(const double p[8], const uint8_t *at) {
    long long places;
    __builtin_memcpy(&places, at, sizeof places);
    return _mm512_permutexvar_pd(_mm512_cvtepu8_epi64(_mm_cvtsi64_si128(places)), _mm512_load_pd(p));
}
LANES_INLINE lane_mask lane_mask_of(unsigned bits) { return (lane_mask)bits; }
#elif LANES == 4
LANES_INLINE lane lane_take(const double p[8], const uint8_t *at) {
    return _mm256_setr_pd(p[at[0]], p[at[1]], p[at[2]], p[at[3]]);
}
LANES_INLINE lane_mask lane_mask_of(unsigned bits) {
    __m256i each = _mm256_setr_epi64x(1, 2, 4, 8), all = _mm256_set1_epi64x((long long)bits);
    return _mm256_castsi256_pd(_mm256_cmpeq_epi64(_mm256_and_si256(all, each), each));
}
#elif LANES == 2
LANES_INLINE lane lane_take(const double p[8], const uint8_t *at) { return (lane){p[at[0]], p[at[1]]}; }
LANES_INLINE lane_mask lane_mask_of(unsigned bits) {
    return (lane_mask){-(long long)(bits & 1), -(long long)(bits >> 1 & 1)};
}
#else
LANES_INLINE lane lane_take(const double p[8], const uint8_t *at) { return p[*at]; }
LANES_INLINE lane_mask lane_mask_of(unsigned bits) { return (lane_mask)(bits & 1); }
#endif

LANES_INLINE lane3 take_segments(const box_axes_query *q, const uint8_t *at) {
    return (lane3){lane_take(q->segment[0], at), lane_take(q->segment[1], at), lane_take(q->segment[2], at)};
}

// LANES pairs from pair i on: the lanes that are known beyond rounding.
LANES_INLINE unsigned find_planes(const box_axes_query *q, uint32_t i, box_axes *out) {
    lane3 u = take_segments(q, box_axes_first + i), v = take_segments(q, box_axes_second + i), n = lane3_cross(u, v);
    lane square = lane3_dot(n, n), scale = lane_set(1) / lane_sqrt(square);
    // One over the sine of the pair's angle: so much more do the roundings of the cross product turn the normal.
    lane uu = lane3_dot(u, u), vv = lane3_dot(v, v), error = lane_set(q->error) * (lane_sqrt(uu * vv) * scale);
    n = lane3_scale(n, scale);
    lane height = lane_set(0);
    lane_mask known = lane_greater(square, lane_set(0));
    for (uint32_t k = 0; k < BOX_AXES_SEGMENTS; k++) {
        lane3 g = {lane_set(q->segment[0][k]), lane_set(q->segment[1][k]), lane_set(q->segment[2][k])};
        lane along = lane3_dot(n, g), size = lane_abs(along);
        lane_mask own = lane_mask_of((unsigned)own_pairs[k] >> i);
        known = lane_and(known, lane_or(own, lane_greater(size, error)));
        height = height + lane_select(own, lane_set(0), size);
        out->positive[k] |= lane_bits(lane_greater(along, lane_set(0))) << i;
    }
    lane3 c = {lane_set(q->center[0]), lane_set(q->center[1]), lane_set(q->center[2])};
    lane along = lane3_dot(n, c);
    height = height - lane_abs(along);
    known = lane_and(known, lane_greater(height, lane_set(0)));
    known = lane_and(known, lane_greater(square * (height * height), lane_set(q->doubt) * (uu + vv)));
    lane_store(out->n[0] + i, n.x);
    lane_store(out->n[1] + i, n.y);
    lane_store(out->n[2] + i, n.z);
    lane_store(out->along + i, along);
    lane_store(out->height + i, height);
    lane_store(out->error + i, error);
    return lane_bits(known) << i;
}

LANES_INLINE int run_axes(const box_axes_query *q, box_axes *out) {
    unsigned known = 0;
    for (uint32_t k = 0; k < BOX_AXES_SEGMENTS; k++) out->positive[k] = 0;
    for (uint32_t i = 0; i < BOX_AXES; i += LANES) known |= find_planes(q, i, out);
    return known == (1u << BOX_AXES) - 1;
}
