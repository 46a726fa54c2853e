// Columns of sixteen floats as lanes, from the lane `at` on.
#ifndef OVOID_SIMD_KERNELS_FLOAT_COLUMNS_H
#define OVOID_SIMD_KERNELS_FLOAT_COLUMNS_H

#include "simd/float_gjk.h"
#include "simd/kernels/lanes.h"

LANES_INLINE lane get(const float_column *c, int at) { return lane_load(c->lane + at); }
LANES_INLINE void put(float_column *c, int at, lane v) { lane_store(c->lane + at, v); }
LANES_INLINE lane3 get3(const float_column *c, int at) { return (lane3){get(c, at), get(c + 1, at), get(c + 2, at)}; }
LANES_INLINE void put3(float_column *c, int at, lane3 v) {
    put(c, at, v.x);
    put(c + 1, at, v.y);
    put(c + 2, at, v.z);
}
LANES_INLINE lane9 get9(const float_column *c, int at) {
    return (lane9){get3(c, at), get3(c + 3, at), get3(c + 6, at)};
}
LANES_INLINE void put_some(float_column *c, int at, lane_mask some, lane v) {
    put(c, at, lane_select(some, v, get(c, at)));
}
LANES_INLINE void put_some3(float_column *c, int at, lane_mask some, lane3 v) {
    put_some(c, at, some, v.x);
    put_some(c + 1, at, some, v.y);
    put_some(c + 2, at, some, v.z);
}

enum { LANES_ALL = (int)((1ull << LANES) - 1) };
// The lanes of a mask from `at` on.
static inline unsigned get_lanes(unsigned lanes, int at) { return lanes >> at & LANES_ALL; }
// 1 if a mask has lanes from `at` on.
static inline int has_more(unsigned lanes, int at) { return at < FLOATS && lanes >> at; }

// The lanes of a vector that are written, and those at work whose numbers are kept: without any, all are written.
typedef struct float_places {
    lane_mask is_new;
    unsigned kept;
} float_places;

LANES_INLINE float_places get_places(const float_gjk *s, unsigned lanes, int at) {
    return (float_places){lane_from_bits(get_lanes(lanes, at)), get_lanes(s->live & ~lanes, at)};
}
LANES_INLINE void put_new(float_column *c, int at, const float_places *places, lane v) {
    put(c, at, places->kept ? lane_select(places->is_new, v, get(c, at)) : v);
}
LANES_INLINE void put_new3(float_column *c, int at, const float_places *places, lane3 v) {
    put_new(c, at, places, v.x);
    put_new(c + 1, at, places, v.y);
    put_new(c + 2, at, places, v.z);
}

#if LANES == 16
// Four rows of four floats, in each block of four lanes, as columns.
LANES_INLINE void transpose_four(const lane r[4], lane c[4]) {
    for (int i = 0; i < 2; i++) {
        __m512 t = i ? _mm512_unpackhi_ps(r[0], r[1]) : _mm512_unpacklo_ps(r[0], r[1]);
        __m512 u = i ? _mm512_unpackhi_ps(r[2], r[3]) : _mm512_unpacklo_ps(r[2], r[3]);
        c[2 * i] = _mm512_castpd_ps(_mm512_unpacklo_pd(_mm512_castps_pd(t), _mm512_castps_pd(u)));
        c[2 * i + 1] = _mm512_castpd_ps(_mm512_unpackhi_pd(_mm512_castps_pd(t), _mm512_castps_pd(u)));
    }
}
// LANES rows of eight floats each, from the lane `at` on, as eight columns.
LANES_INLINE void read_eight(const float *const rows[FLOATS], int at, lane c[8]) {
    const __m512i low = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
    const __m512i high = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
    __m512 r[8], u[8];
    for (int i = 0; i < 8; i++) {
        __m256d first = _mm256_castps_pd(_mm256_load_ps(rows[at + i]));
        __m256d second = _mm256_castps_pd(_mm256_load_ps(rows[at + i + 8]));
        r[i] = _mm512_castpd_ps(_mm512_insertf64x4(_mm512_castpd256_pd512(first), second, 1));
    }
    transpose_four(r, u);
    transpose_four(r + 4, u + 4);
    for (int i = 0; i < 4; i++) {
        __m512d one = _mm512_castps_pd(u[i]), two = _mm512_castps_pd(u[4 + i]);
        c[i] = _mm512_castpd_ps(_mm512_permutex2var_pd(one, low, two));
        c[4 + i] = _mm512_castpd_ps(_mm512_permutex2var_pd(one, high, two));
    }
}
#elif LANES == 8
LANES_INLINE void transpose_four(const lane r[4], lane c[4]) {
    for (int i = 0; i < 2; i++) {
        __m256 t = i ? _mm256_unpackhi_ps(r[0], r[1]) : _mm256_unpacklo_ps(r[0], r[1]);
        __m256 u = i ? _mm256_unpackhi_ps(r[2], r[3]) : _mm256_unpacklo_ps(r[2], r[3]);
        c[2 * i] = _mm256_shuffle_ps(t, u, 0x44);
        c[2 * i + 1] = _mm256_shuffle_ps(t, u, 0xee);
    }
}
LANES_INLINE void read_eight(const float *const rows[FLOATS], int at, lane c[8]) {
    __m256 r[8], u[8];
    for (int i = 0; i < 8; i++) r[i] = _mm256_load_ps(rows[at + i]);
    transpose_four(r, u);
    transpose_four(r + 4, u + 4);
    for (int i = 0; i < 4; i++) {
        c[i] = _mm256_permute2f128_ps(u[i], u[4 + i], 0x20);
        c[4 + i] = _mm256_permute2f128_ps(u[i], u[4 + i], 0x31);
    }
}
#else
LANES_INLINE void read_eight(const float *const rows[FLOATS], int at, lane c[8]) {
    for (int i = 0; i < 8; i++) c[i] = rows[at][i];
}
#endif

#endif
