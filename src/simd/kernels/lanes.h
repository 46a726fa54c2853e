// Numbers side by side, LANES of them: 8 (AVX-512), 4 (AVX2), 2 (WebAssembly's SIMD128) or 1 (plain C, the scalar
// twin); of single precision where LANES_ARE_FLOATS is defined (float_lanes.h). A kernel is written once over these
// (kernels/pair8.h) and compiled for each; every operation is IEEE 754's, lane by lane, so all widths give the same
// bits. Sums and products are the operators. lane_sign is 1 of -0 too; of NaN it is anything. lane_top and lane_min are
// b where one of them is NaN; lane_find_max is the greatest of the lanes, in all of them. lane_get_power is the largest
// power of two that is at most v, of positive normal numbers. lane_gather reads p at LANES indices; kernels that are
// eight wide load columns instead.
#ifndef OVOID_SIMD_KERNELS_LANES_H
#define OVOID_SIMD_KERNELS_LANES_H

#include <math.h>
#include <stdint.h>
#include <string.h>

/// The exponent's bits of a number.
#ifdef LANES_ARE_FLOATS
#define LANES_EXPONENT 0x7f800000
#else
#define LANES_EXPONENT 0x7ff0000000000000
#endif

#ifdef LANES_ARE_FLOATS

#include "simd/kernels/float_lanes.h"

#elif LANES == 8

#include <immintrin.h>

#define LANES_TARGET __attribute__((target("avx512f")))
#define LANES_INLINE LANES_TARGET static inline __attribute__((always_inline))

typedef __m512d lane;
typedef __mmask8 lane_mask;

LANES_INLINE lane lane_set(double x) { return _mm512_set1_pd(x); }
LANES_INLINE lane lane_load(const double *x) { return _mm512_loadu_pd(x); }
LANES_INLINE lane lane_load_floats(const float *x) { return _mm512_cvtps_pd(_mm256_loadu_ps(x)); }
LANES_INLINE lane lane_gather(const double *p, const uint32_t *at) {
    return _mm512_setr_pd(p[at[0]], p[at[1]], p[at[2]], p[at[3]], p[at[4]], p[at[5]], p[at[6]], p[at[7]]);
}
LANES_INLINE void lane_store(double *x, lane v) { _mm512_storeu_pd(x, v); }
LANES_INLINE lane lane_sqrt(lane v) { return _mm512_sqrt_pd(v); }
LANES_INLINE lane lane_abs(lane v) { return _mm512_abs_pd(v); }
LANES_INLINE lane lane_floor(lane v) { return _mm512_roundscale_pd(v, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC); }
LANES_INLINE lane_mask lane_greater(lane a, lane b) { return _mm512_cmp_pd_mask(a, b, _CMP_GT_OQ); }
LANES_INLINE lane_mask lane_at_least(lane a, lane b) { return _mm512_cmp_pd_mask(a, b, _CMP_GE_OQ); }
LANES_INLINE lane lane_select(lane_mask m, lane yes, lane no) { return _mm512_mask_blend_pd(m, no, yes); }
LANES_INLINE lane_mask lane_and(lane_mask a, lane_mask b) { return (lane_mask)(a & b); }
LANES_INLINE lane_mask lane_or(lane_mask a, lane_mask b) { return (lane_mask)(a | b); }
LANES_INLINE lane_mask lane_not(lane_mask m) { return (lane_mask)~m; }
LANES_INLINE unsigned lane_bits(lane_mask m) { return m; }
LANES_INLINE lane_mask lane_none(void) { return 0; }
LANES_INLINE lane_mask lane_sign(lane v) {
    return _mm512_test_epi64_mask(_mm512_castpd_si512(v), _mm512_castpd_si512(_mm512_set1_pd(-0.0)));
}
LANES_INLINE lane lane_top(lane a, lane b) { return _mm512_max_pd(a, b); }
LANES_INLINE lane lane_find_max(lane m) {
    m = _mm512_max_pd(m, _mm512_shuffle_f64x2(m, m, 0x4e));
    m = _mm512_max_pd(m, _mm512_shuffle_f64x2(m, m, 0xb1));
    return _mm512_max_pd(m, _mm512_permute_pd(m, 0x55));
}
LANES_INLINE lane lane_min(lane a, lane b) { return _mm512_min_pd(a, b); }
LANES_INLINE double lane_first(lane v) { return _mm512_cvtsd_f64(v); }
LANES_INLINE lane lane_get_power(lane v) {
    return _mm512_castsi512_pd(_mm512_and_si512(_mm512_castpd_si512(v), _mm512_set1_epi64(LANES_EXPONENT)));
}

#elif LANES == 4

#include <immintrin.h>

#define LANES_TARGET __attribute__((target("avx2")))
#define LANES_INLINE LANES_TARGET static inline __attribute__((always_inline))

typedef __m256d lane;
typedef __m256d lane_mask;

LANES_INLINE lane lane_set(double x) { return _mm256_set1_pd(x); }
LANES_INLINE lane lane_load(const double *x) { return _mm256_loadu_pd(x); }
LANES_INLINE lane lane_load_floats(const float *x) { return _mm256_cvtps_pd(_mm_loadu_ps(x)); }
LANES_INLINE lane lane_gather(const double *p, const uint32_t *at) {
    return _mm256_setr_pd(p[at[0]], p[at[1]], p[at[2]], p[at[3]]);
}
LANES_INLINE void lane_store(double *x, lane v) { _mm256_storeu_pd(x, v); }
LANES_INLINE lane lane_sqrt(lane v) { return _mm256_sqrt_pd(v); }
LANES_INLINE lane lane_abs(lane v) { return _mm256_andnot_pd(_mm256_set1_pd(-0.0), v); }
LANES_INLINE lane lane_floor(lane v) { return _mm256_floor_pd(v); }
LANES_INLINE lane_mask lane_greater(lane a, lane b) { return _mm256_cmp_pd(a, b, _CMP_GT_OQ); }
LANES_INLINE lane_mask lane_at_least(lane a, lane b) { return _mm256_cmp_pd(a, b, _CMP_GE_OQ); }
LANES_INLINE lane lane_select(lane_mask m, lane yes, lane no) { return _mm256_blendv_pd(no, yes, m); }
LANES_INLINE lane_mask lane_and(lane_mask a, lane_mask b) { return _mm256_and_pd(a, b); }
LANES_INLINE lane_mask lane_or(lane_mask a, lane_mask b) { return _mm256_or_pd(a, b); }
LANES_INLINE lane_mask lane_not(lane_mask m) { return _mm256_xor_pd(m, _mm256_castsi256_pd(_mm256_set1_epi64x(-1))); }
LANES_INLINE unsigned lane_bits(lane_mask m) { return (unsigned)_mm256_movemask_pd(m); }
LANES_INLINE lane_mask lane_none(void) { return _mm256_setzero_pd(); }
// Only the sign bits of a mask are read.
LANES_INLINE lane_mask lane_sign(lane v) { return v; }
LANES_INLINE lane lane_top(lane a, lane b) { return _mm256_max_pd(a, b); }
LANES_INLINE lane lane_find_max(lane m) {
    m = _mm256_max_pd(m, _mm256_permute2f128_pd(m, m, 1));
    return _mm256_max_pd(m, _mm256_permute_pd(m, 5));
}
LANES_INLINE lane lane_min(lane a, lane b) { return _mm256_min_pd(a, b); }
LANES_INLINE double lane_first(lane v) { return _mm256_cvtsd_f64(v); }
LANES_INLINE lane lane_get_power(lane v) {
    return _mm256_and_pd(v, _mm256_castsi256_pd(_mm256_set1_epi64x(LANES_EXPONENT)));
}

#elif LANES == 2

#include <wasm_simd128.h>

#define LANES_TARGET
#define LANES_INLINE static inline __attribute__((always_inline))

typedef double lane __attribute__((vector_size(16)));
typedef long long lane_mask __attribute__((vector_size(16)));

LANES_INLINE lane lane_set(double x) { return (lane){x, x}; }
LANES_INLINE lane lane_load(const double *x) { return (lane)wasm_v128_load(x); }
LANES_INLINE lane lane_load_floats(const float *x) { return (lane){x[0], x[1]}; }
LANES_INLINE lane lane_gather(const double *p, const uint32_t *at) { return (lane){p[at[0]], p[at[1]]}; }
LANES_INLINE void lane_store(double *x, lane v) { wasm_v128_store(x, (v128_t)v); }
LANES_INLINE lane lane_sqrt(lane v) { return (lane)wasm_f64x2_sqrt((v128_t)v); }
LANES_INLINE lane lane_abs(lane v) { return (lane)wasm_f64x2_abs((v128_t)v); }
LANES_INLINE lane lane_floor(lane v) { return (lane)wasm_f64x2_floor((v128_t)v); }
LANES_INLINE lane_mask lane_greater(lane a, lane b) { return (lane_mask)(a > b); }
LANES_INLINE lane_mask lane_at_least(lane a, lane b) { return (lane_mask)(a >= b); }
LANES_INLINE lane lane_select(lane_mask m, lane yes, lane no) {
    return (lane)wasm_v128_bitselect((v128_t)yes, (v128_t)no, (v128_t)m);
}
LANES_INLINE lane_mask lane_and(lane_mask a, lane_mask b) { return a & b; }
LANES_INLINE lane_mask lane_or(lane_mask a, lane_mask b) { return a | b; }
LANES_INLINE lane_mask lane_not(lane_mask m) { return ~m; }
LANES_INLINE unsigned lane_bits(lane_mask m) { return wasm_i64x2_bitmask((v128_t)m); }
LANES_INLINE lane_mask lane_none(void) { return (lane_mask){0, 0}; }
LANES_INLINE lane_mask lane_sign(lane v) { return (lane_mask)v >> 63; }
LANES_INLINE lane lane_top(lane a, lane b) { return lane_select(lane_greater(a, b), a, b); }
LANES_INLINE lane lane_find_max(lane m) { return lane_top(m, (lane){m[1], m[0]}); }
LANES_INLINE lane lane_min(lane a, lane b) { return lane_select(lane_greater(b, a), a, b); }
LANES_INLINE double lane_first(lane v) { return v[0]; }
LANES_INLINE lane lane_get_power(lane v) { return (lane)((lane_mask)v & LANES_EXPONENT); }

#else

#define LANES_TARGET
#define LANES_INLINE static inline

typedef double lane;
typedef int lane_mask;

LANES_INLINE lane lane_set(double x) { return x; }
LANES_INLINE lane lane_load(const double *x) { return *x; }
LANES_INLINE lane lane_load_floats(const float *x) { return *x; }
LANES_INLINE lane lane_gather(const double *p, const uint32_t *at) { return p[*at]; }
LANES_INLINE void lane_store(double *x, lane v) { *x = v; }
LANES_INLINE lane lane_sqrt(lane v) { return sqrt(v); }
LANES_INLINE lane lane_abs(lane v) { return fabs(v); }
LANES_INLINE lane lane_floor(lane v) { return floor(v); }
LANES_INLINE lane_mask lane_greater(lane a, lane b) { return a > b; }
LANES_INLINE lane_mask lane_at_least(lane a, lane b) { return a >= b; }
LANES_INLINE lane lane_select(lane_mask m, lane yes, lane no) { return m ? yes : no; }
LANES_INLINE lane_mask lane_and(lane_mask a, lane_mask b) { return a & b; }
LANES_INLINE lane_mask lane_or(lane_mask a, lane_mask b) { return a | b; }
LANES_INLINE lane_mask lane_not(lane_mask m) { return !m; }
LANES_INLINE unsigned lane_bits(lane_mask m) { return (unsigned)m; }
LANES_INLINE lane_mask lane_none(void) { return 0; }
LANES_INLINE lane_mask lane_sign(lane v) { return signbit(v) != 0; }
LANES_INLINE lane lane_top(lane a, lane b) { return a > b ? a : b; }
LANES_INLINE lane lane_find_max(lane m) { return m; }
LANES_INLINE lane lane_min(lane a, lane b) { return a < b ? a : b; }
LANES_INLINE double lane_first(lane v) { return v; }
LANES_INLINE lane lane_get_power(lane v) {
    int64_t bits;
    memcpy(&bits, &v, sizeof bits);
    bits &= LANES_EXPONENT;
    memcpy(&v, &bits, sizeof v);
    return v;
}

#endif

/// What a kernel does several times: inlined where a call would store wide vectors, else one copy of the code.
#if LANES > 2
#define LANES_SHARED LANES_INLINE
#elif defined(__GNUC__)
#define LANES_SHARED LANES_TARGET static __attribute__((noinline))
#else
#define LANES_SHARED LANES_INLINE
#endif

LANES_INLINE lane_mask lane_less(lane a, lane b) { return lane_greater(b, a); }
LANES_INLINE lane_mask lane_at_most(lane a, lane b) { return lane_at_least(b, a); }
/// b where one of them is NaN.
LANES_INLINE lane lane_max(lane a, lane b) { return lane_select(lane_greater(a, b), a, b); }

/// Vectors, symmetric and general matrices in lanes, with the operations and the order of linear/vec3.h and mat3.h.
typedef struct lane3 {
    lane x, y, z;
} lane3;

typedef struct lane6 {
    lane xx, xy, xz, yy, yz, zz;
} lane6;

typedef struct lane9 {
    lane3 r0, r1, r2;
} lane9;

LANES_INLINE lane3 lane3_add(lane3 a, lane3 b) { return (lane3){a.x + b.x, a.y + b.y, a.z + b.z}; }
LANES_INLINE lane3 lane3_sub(lane3 a, lane3 b) { return (lane3){a.x - b.x, a.y - b.y, a.z - b.z}; }
LANES_INLINE lane3 lane3_scale(lane3 a, lane s) { return (lane3){a.x * s, a.y * s, a.z * s}; }
LANES_INLINE lane3 lane3_add_scaled(lane3 a, lane3 b, lane s) {
    return (lane3){a.x + b.x * s, a.y + b.y * s, a.z + b.z * s};
}
LANES_INLINE lane3 lane3_neg(lane3 a) { return (lane3){-a.x, -a.y, -a.z}; }
LANES_INLINE lane lane3_dot(lane3 a, lane3 b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }
LANES_INLINE lane3 lane3_cross(lane3 a, lane3 b) {
    return (lane3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
LANES_INLINE lane lane3_norm(lane3 a) { return lane_sqrt(lane3_dot(a, a)); }
LANES_INLINE lane3 lane3_select(lane_mask m, lane3 yes, lane3 no) {
    return (lane3){lane_select(m, yes.x, no.x), lane_select(m, yes.y, no.y), lane_select(m, yes.z, no.z)};
}
/// vec3_unit in its common case, where no square over- or underflows. *good loses the other lanes.
LANES_INLINE lane3 lane3_unit(lane3 a, lane_mask *good) {
    lane square = lane3_dot(a, a);
    *good = lane_and(*good, lane_and(lane_greater(square, lane_set(1e-250)), lane_less(square, lane_set(1e250))));
    return lane3_scale(a, lane_set(1) / lane_sqrt(square));
}
LANES_INLINE lane9 lane9_transpose(lane9 m) {
    return (lane9){{m.r0.x, m.r1.x, m.r2.x}, {m.r0.y, m.r1.y, m.r2.y}, {m.r0.z, m.r1.z, m.r2.z}};
}
LANES_INLINE lane3 lane9_mul3(lane9 m, lane3 v) {
    return (lane3){lane3_dot(m.r0, v), lane3_dot(m.r1, v), lane3_dot(m.r2, v)};
}
/// m' v
LANES_INLINE lane3 lane9_mul3_transposed(lane9 m, lane3 v) { return lane9_mul3(lane9_transpose(m), v); }
/// a' b
LANES_INLINE lane9 lane9_mul_transposed(lane9 a, lane9 b) {
    lane9 t = lane9_transpose(a);
    return (lane9){lane9_mul3_transposed(b, t.r0), lane9_mul3_transposed(b, t.r1), lane9_mul3_transposed(b, t.r2)};
}
LANES_INLINE lane3 lane6_mul3(lane6 s, lane3 v) {
    return (lane3){(s.xx * v.x + s.xy * v.y) + s.xz * v.z, (s.xy * v.x + s.yy * v.y) + s.yz * v.z,
                   (s.xz * v.x + s.yz * v.y) + s.zz * v.z};
}
LANES_INLINE lane lane6_trace(lane6 s) { return s.xx + s.yy + s.zz; }
LANES_INLINE lane6 lane6_add(lane6 a, lane6 b) {
    return (lane6){a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yy + b.yy, a.yz + b.yz, a.zz + b.zz};
}
LANES_INLINE lane6 lane6_scale(lane6 a, lane s) {
    return (lane6){a.xx * s, a.xy * s, a.xz * s, a.yy * s, a.yz * s, a.zz * s};
}
LANES_INLINE lane6 lane6_adjugate(lane6 s) {
    return (lane6){s.yy * s.zz - s.yz * s.yz, s.xz * s.yz - s.xy * s.zz, s.xy * s.yz - s.xz * s.yy,
                   s.xx * s.zz - s.xz * s.xz, s.xy * s.xz - s.xx * s.yz, s.xx * s.yy - s.xy * s.xy};
}
/// R S R'
LANES_INLINE lane6 lane6_rotate(lane6 s, lane9 r) {
    lane3 a = lane6_mul3(s, r.r0), b = lane6_mul3(s, r.r1), c = lane6_mul3(s, r.r2);
    return (lane6){lane3_dot(r.r0, a), lane3_dot(r.r1, a), lane3_dot(r.r2, a),
                   lane3_dot(r.r1, b), lane3_dot(r.r2, b), lane3_dot(r.r2, c)};
}

#endif
