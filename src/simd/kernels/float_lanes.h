// The lanes of lanes.h in single precision: 16 (AVX-512), 8 (AVX2) or 1 (plain C). lanes.h includes this where
// LANES_ARE_FLOATS is defined. lane_store_mask stores truth values as sign bits, and lane_sign reads them.
#ifndef OVOID_SIMD_KERNELS_FLOAT_LANES_H
#define OVOID_SIMD_KERNELS_FLOAT_LANES_H

#include <math.h>
#include <stdint.h>

#if LANES == 16

#include <immintrin.h>

#define LANES_TARGET __attribute__((target("avx512f")))
#define LANES_INLINE LANES_TARGET static inline __attribute__((always_inline))

typedef __m512 lane;
typedef __mmask16 lane_mask;

LANES_INLINE lane lane_set(double x) { return _mm512_set1_ps((float)x); }
LANES_INLINE lane lane_load(const float *x) { return _mm512_load_ps(x); }
LANES_INLINE void lane_store(float *x, lane v) { _mm512_store_ps(x, v); }
LANES_INLINE lane lane_sqrt(lane v) { return _mm512_sqrt_ps(v); }
LANES_INLINE lane lane_abs(lane v) { return _mm512_abs_ps(v); }
LANES_INLINE lane_mask lane_greater(lane a, lane b) { return _mm512_cmp_ps_mask(a, b, _CMP_GT_OQ); }
LANES_INLINE lane_mask lane_at_least(lane a, lane b) { return _mm512_cmp_ps_mask(a, b, _CMP_GE_OQ); }
LANES_INLINE lane lane_select(lane_mask m, lane yes, lane no) { return _mm512_mask_blend_ps(m, no, yes); }
LANES_INLINE lane_mask lane_and(lane_mask a, lane_mask b) { return (lane_mask)(a & b); }
LANES_INLINE lane_mask lane_or(lane_mask a, lane_mask b) { return (lane_mask)(a | b); }
LANES_INLINE lane_mask lane_not(lane_mask m) { return (lane_mask)~m; }
LANES_INLINE unsigned lane_bits(lane_mask m) { return m; }
LANES_INLINE lane_mask lane_from_bits(unsigned bits) { return (lane_mask)bits; }
LANES_INLINE lane_mask lane_none(void) { return 0; }
LANES_INLINE lane_mask lane_sign(lane v) {
    return _mm512_test_epi32_mask(_mm512_castps_si512(v), _mm512_set1_epi32(INT32_MIN));
}
LANES_INLINE void lane_store_mask(float *x, lane_mask m) {
    _mm512_store_ps(x, _mm512_castsi512_ps(_mm512_maskz_set1_epi32(m, INT32_MIN)));
}
LANES_INLINE lane lane_get_power(lane v) {
    return _mm512_castsi512_ps(_mm512_and_si512(_mm512_castps_si512(v), _mm512_set1_epi32(LANES_EXPONENT)));
}
LANES_INLINE lane lane_top(lane a, lane b) { return _mm512_max_ps(a, b); }
LANES_INLINE lane lane_min(lane a, lane b) { return _mm512_min_ps(a, b); }

#elif LANES == 8

#include <immintrin.h>

#define LANES_TARGET __attribute__((target("avx2")))
#define LANES_INLINE LANES_TARGET static inline __attribute__((always_inline))

typedef __m256 lane;
typedef __m256 lane_mask;

LANES_INLINE lane lane_set(double x) { return _mm256_set1_ps((float)x); }
LANES_INLINE lane lane_load(const float *x) { return _mm256_load_ps(x); }
LANES_INLINE void lane_store(float *x, lane v) { _mm256_store_ps(x, v); }
LANES_INLINE lane lane_sqrt(lane v) { return _mm256_sqrt_ps(v); }
LANES_INLINE lane lane_abs(lane v) { return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), v); }
LANES_INLINE lane_mask lane_greater(lane a, lane b) { return _mm256_cmp_ps(a, b, _CMP_GT_OQ); }
LANES_INLINE lane_mask lane_at_least(lane a, lane b) { return _mm256_cmp_ps(a, b, _CMP_GE_OQ); }
LANES_INLINE lane lane_select(lane_mask m, lane yes, lane no) { return _mm256_blendv_ps(no, yes, m); }
LANES_INLINE lane_mask lane_and(lane_mask a, lane_mask b) { return _mm256_and_ps(a, b); }
LANES_INLINE lane_mask lane_or(lane_mask a, lane_mask b) { return _mm256_or_ps(a, b); }
LANES_INLINE lane_mask lane_not(lane_mask m) { return _mm256_xor_ps(m, _mm256_castsi256_ps(_mm256_set1_epi32(-1))); }
LANES_INLINE unsigned lane_bits(lane_mask m) { return (unsigned)_mm256_movemask_ps(m); }
LANES_INLINE lane_mask lane_from_bits(unsigned bits) {
    __m256i shift = _mm256_setr_epi32(31, 30, 29, 28, 27, 26, 25, 24);
    return _mm256_castsi256_ps(_mm256_sllv_epi32(_mm256_set1_epi32((int)bits), shift));
}
LANES_INLINE lane_mask lane_none(void) { return _mm256_setzero_ps(); }
// Only the sign bits of a mask are read.
LANES_INLINE lane_mask lane_sign(lane v) { return v; }
LANES_INLINE void lane_store_mask(float *x, lane_mask m) { _mm256_store_ps(x, m); }
LANES_INLINE lane lane_get_power(lane v) {
    return _mm256_and_ps(v, _mm256_castsi256_ps(_mm256_set1_epi32(LANES_EXPONENT)));
}
LANES_INLINE lane lane_top(lane a, lane b) { return _mm256_max_ps(a, b); }
LANES_INLINE lane lane_min(lane a, lane b) { return _mm256_min_ps(a, b); }

#else

#ifndef LANES_TARGET
#define LANES_TARGET
#define LANES_INLINE static inline
#endif

typedef float lane;
typedef int lane_mask;

LANES_INLINE lane lane_set(double x) { return (float)x; }
LANES_INLINE lane lane_load(const float *x) { return *x; }
LANES_INLINE void lane_store(float *x, lane v) { *x = v; }
LANES_INLINE lane lane_sqrt(lane v) { return sqrtf(v); }
LANES_INLINE lane lane_abs(lane v) { return fabsf(v); }
LANES_INLINE lane_mask lane_greater(lane a, lane b) { return a > b; }
LANES_INLINE lane_mask lane_at_least(lane a, lane b) { return a >= b; }
LANES_INLINE lane lane_select(lane_mask m, lane yes, lane no) { return m ? yes : no; }
LANES_INLINE lane_mask lane_and(lane_mask a, lane_mask b) { return a & b; }
LANES_INLINE lane_mask lane_or(lane_mask a, lane_mask b) { return a | b; }
LANES_INLINE lane_mask lane_not(lane_mask m) { return !m; }
LANES_INLINE unsigned lane_bits(lane_mask m) { return (unsigned)m; }
LANES_INLINE lane_mask lane_from_bits(unsigned bits) { return (int)(bits & 1); }
LANES_INLINE lane_mask lane_none(void) { return 0; }
LANES_INLINE lane_mask lane_sign(lane v) { return signbit(v) != 0; }
LANES_INLINE void lane_store_mask(float *x, lane_mask m) { *x = m ? -0.0f : 0.0f; }
LANES_INLINE lane lane_get_power(lane v) {
    int32_t bits;
    memcpy(&bits, &v, sizeof bits);
    bits &= LANES_EXPONENT;
    memcpy(&v, &bits, sizeof v);
    return v;
}
LANES_INLINE lane lane_top(lane a, lane b) { return a > b ? a : b; }
LANES_INLINE lane lane_min(lane a, lane b) { return a < b ? a : b; }

#endif

#endif
