// The vertex extreme along a direction, of one body's columns of floats (float_gjk.h): the lowest index of those with
// the greatest (x n.x + y n.y) + z n.z, rounded in this order, so every instruction set finds the same.
#include "simd/kernels/float_columns.h"

#if LANES == 1 && !defined(FLOAT_ALONE)

static uint32_t run_float_find(const float *columns, uint32_t count, const float n[3]) {
    const float *x = columns, *y = columns + count, *z = columns + 2 * count;
    uint32_t best = 0;
    float most = -INFINITY;
    for (uint32_t i = 0; i < count; i++) {
        float value = (x[i] * n[0] + y[i] * n[1]) + z[i] * n[2];
        if (value > most) most = value, best = i;
    }
    return best;
}

#else

#include <immintrin.h>

LANES_INLINE float find_greatest_of_four(__m128 m) {
    m = _mm_max_ps(m, _mm_movehl_ps(m, m));
    return _mm_cvtss_f32(_mm_max_ss(m, _mm_movehdup_ps(m)));
}

LANES_INLINE float find_greatest_of_eight(__m256 v) {
    return find_greatest_of_four(_mm_max_ps(_mm256_castps256_ps128(v), _mm256_extractf128_ps(v, 1)));
}

LANES_INLINE __m256 measure_eight(const float *x, uint32_t count, const float n[3]) {
    __m256 xy = _mm256_add_ps(_mm256_mul_ps(_mm256_load_ps(x), _mm256_set1_ps(n[0])),
                              _mm256_mul_ps(_mm256_load_ps(x + count), _mm256_set1_ps(n[1])));
    return _mm256_add_ps(xy, _mm256_mul_ps(_mm256_load_ps(x + 2 * count), _mm256_set1_ps(n[2])));
}

LANES_INLINE uint32_t find_by_eights(const float *columns, uint32_t count, const float n[3]) {
    __m256 v[FLOAT_COLUMN_POINTS / 8], most = v[0] = measure_eight(columns, count, n);
    for (uint32_t i = 8; i < count; i += 8) most = _mm256_max_ps(most, v[i / 8] = measure_eight(columns + i, count, n));
    __m256 best = _mm256_set1_ps(find_greatest_of_eight(most));
    for (uint32_t i = 0; i < count; i += 8) {
        unsigned equal = (unsigned)_mm256_movemask_ps(_mm256_cmp_ps(v[i / 8], best, _CMP_EQ_OQ));
        if (equal) return i + (uint32_t)__builtin_ctz(equal);
    }
    return 0;
}

#if LANES == 16

LANES_INLINE __m512 measure_sixteen(const float *x, uint32_t count, const float n[3]) {
    __m512 xy = _mm512_add_ps(_mm512_mul_ps(_mm512_loadu_ps(x), _mm512_set1_ps(n[0])),
                              _mm512_mul_ps(_mm512_loadu_ps(x + count), _mm512_set1_ps(n[1])));
    return _mm512_add_ps(xy, _mm512_mul_ps(_mm512_loadu_ps(x + 2 * count), _mm512_set1_ps(n[2])));
}

// The last sixteen may have eight of those before them.
LANES_TARGET static uint32_t run_float_find(const float *columns, uint32_t count, const float n[3]) {
    if (count < 16) return find_by_eights(columns, count, n);
    __m512 v[FLOAT_COLUMN_POINTS / 16], most = v[0] = measure_sixteen(columns, count, n);
    for (uint32_t i = 16; i < count; i += 16)
        most = _mm512_max_ps(most, v[i / 16] = measure_sixteen(columns + (i < count - 16 ? i : count - 16), count, n));
    __m256 half = _mm256_max_ps(_mm512_castps512_ps256(most),
                                _mm256_castpd_ps(_mm512_extractf64x4_pd(_mm512_castps_pd(most), 1)));
    __m512 best = _mm512_set1_ps(find_greatest_of_eight(half));
    for (uint32_t i = 0; i < count; i += 16) {
        unsigned equal = _mm512_cmp_ps_mask(v[i / 16], best, _CMP_EQ_OQ);
        if (equal) return (i < count - 16 ? i : count - 16) + (uint32_t)__builtin_ctz(equal);
    }
    return 0;
}

#else

LANES_TARGET static uint32_t run_float_find(const float *columns, uint32_t count, const float n[3]) {
    return find_by_eights(columns, count, n);
}

#endif
#endif
