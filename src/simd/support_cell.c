// Products are (x n.x + y n.y) + z n.z as in support.c, so that a value has the same bits wherever it is computed, and
// the lowest index among equal values wins: entries are ascending, and a later one has to be greater.
#include "simd/support_cell.h"

#include <stddef.h>

static inline simd_extreme take(const simd_cell *c, unsigned lane, double value) {
    return (simd_extreme){value + 0.0, c->x[lane], c->y[lane], c->z[lane], c->index[lane]};
}

static simd_extreme find_scalar(const simd_cell *c, vec3 n) {
    unsigned lane = 0;
    double best = (c->x[0] * n.x + c->y[0] * n.y) + c->z[0] * n.z;
    for (unsigned i = 1; i < SIMD_CELL; i++) {
        double value = (c->x[i] * n.x + c->y[i] * n.y) + c->z[i] * n.z;
        if (value > best) best = value, lane = i;
    }
    return take(c, lane, best);
}

simd_extreme simd_find_in_cell_scalar(const simd_cell *first, const simd_cell *more, uint32_t count, const vec3 *n) {
    simd_extreme best = find_scalar(first, *n);
    for (; count > SIMD_CELL; count = count > 2 * SIMD_CELL ? count - SIMD_CELL : 0) {
        simd_extreme other = find_scalar(more++, *n);
        if (other.value > best.value) best = other;
    }
    return best;
}

static void find_unbeaten_scalar(const simd_cull *by, const simd_points *points, uint8_t *bits) {
    const double *x = points->x, *y = points->y, *z = points->z;
    for (uint32_t i = 0; i < points->padded_count; i++) {
        double v[4];
        for (int k = 0; k < 4; k++)
            v[k] = (x[i] * by->corners[k][0] + y[i] * by->corners[k][1]) + z[i] * by->corners[k][2];
        unsigned beaten = 0;
        for (uint32_t w = 0; w < by->limit_count; w++) {
            const double *limit = by->limits[w];
            beaten |= (unsigned)(v[0] < limit[0]) & (unsigned)(v[1] < limit[1]) & (unsigned)(v[2] < limit[2]) &
                      (unsigned)(v[3] < limit[3]);
        }
        unsigned all = i % 8 ? bits[i / 8] : 0;
        bits[i / 8] = (uint8_t)(all | (beaten ^ 1u) << i % 8);
    }
}

#if defined(__x86_64__) && defined(__GNUC__)

#include "simd/kernels/vectors.h"

#define AVX2 __attribute__((target("avx2")))

AVX2 static inline simd_extreme find_avx2(const simd_cell *c, vectors4 n) {
    __m256d low = vectors4_dot(vectors4_load(c->x, c->y, c->z), n),
            high = vectors4_dot(vectors4_load(c->x + 4, c->y + 4, c->z + 4), n);
    __m256d m = _mm256_max_pd(low, high);
    m = _mm256_max_pd(m, _mm256_permute2f128_pd(m, m, 1));
    m = _mm256_max_pd(m, _mm256_permute_pd(m, 5));
    unsigned equal = (unsigned)_mm256_movemask_pd(_mm256_cmp_pd(low, m, _CMP_EQ_OQ)) |
                     (unsigned)_mm256_movemask_pd(_mm256_cmp_pd(high, m, _CMP_EQ_OQ)) << 4 | 1u << 8;
    return take(c, (unsigned)__builtin_ctz(equal) & 7, _mm256_cvtsd_f64(m));
}

AVX2 static simd_extreme find_in_cell_avx2(const simd_cell *first, const simd_cell *more, uint32_t count,
                                           const vec3 *n) {
    vectors4 along = vectors4_spread(*n);
    simd_extreme best = find_avx2(first, along);
    for (; count > SIMD_CELL; count = count > 2 * SIMD_CELL ? count - SIMD_CELL : 0) {
        simd_extreme other = find_avx2(more++, along);
        if (other.value > best.value) best = other;
    }
    return best;
}

/// Four points, by their products with the four corners, that a limit beats.
AVX2 static inline __m256d find_beaten4(const __m256d v[4], const __m256d limit[4]) {
    __m256d a = _mm256_and_pd(_mm256_cmp_pd(v[0], limit[0], _CMP_LT_OQ), _mm256_cmp_pd(v[1], limit[1], _CMP_LT_OQ));
    __m256d b = _mm256_and_pd(_mm256_cmp_pd(v[2], limit[2], _CMP_LT_OQ), _mm256_cmp_pd(v[3], limit[3], _CMP_LT_OQ));
    return _mm256_and_pd(a, b);
}

// Eight points at a time share the limits.
AVX2 static void find_unbeaten_avx2(const simd_cull *by, const simd_points *points, uint8_t *bits) {
    const double *x = points->x, *y = points->y, *z = points->z;
    vectors4 d[4];
    for (int k = 0; k < 4; k++) d[k] = vectors4_spread(vec3_at(by->corners[k], 0));
    for (uint32_t i = 0; i < points->padded_count; i += 8) {
        __m256d v[4], w[4], limit[4], first = _mm256_setzero_pd(), second = _mm256_setzero_pd();
        vectors4 p = vectors4_load(x + i, y + i, z + i), q = vectors4_load(x + i + 4, y + i + 4, z + i + 4);
        for (int k = 0; k < 4; k++) v[k] = vectors4_dot(p, d[k]), w[k] = vectors4_dot(q, d[k]);
        for (uint32_t n = 0; n < by->limit_count; n++) {
            for (int k = 0; k < 4; k++) limit[k] = _mm256_set1_pd(by->limits[n][k]);
            first = _mm256_or_pd(first, find_beaten4(v, limit));
            second = _mm256_or_pd(second, find_beaten4(w, limit));
        }
        bits[i / 8] = (uint8_t) ~((unsigned)_mm256_movemask_pd(first) | (unsigned)_mm256_movemask_pd(second) << 4);
    }
}

#define AVX512 __attribute__((target("avx512f")))

AVX512 static void find_unbeaten_avx512(const simd_cull *by, const simd_points *points, uint8_t *bits) {
    const double *x = points->x, *y = points->y, *z = points->z;
    vectors8 d[4];
    for (int k = 0; k < 4; k++) d[k] = vectors8_spread(vec3_at(by->corners[k], 0));
    for (uint32_t i = 0; i < points->padded_count; i += 8) {
        __m512d v[4];
        unsigned beaten = 0;
        vectors8 p = vectors8_load(x + i, y + i, z + i);
        for (int k = 0; k < 4; k++) v[k] = vectors8_dot(p, d[k]);
        for (uint32_t w = 0; w < by->limit_count; w++) {
            const double *limit = by->limits[w];
            __mmask8 all = _mm512_cmp_pd_mask(v[0], _mm512_set1_pd(limit[0]), _CMP_LT_OQ);
            all = _mm512_mask_cmp_pd_mask(all, v[1], _mm512_set1_pd(limit[1]), _CMP_LT_OQ);
            all = _mm512_mask_cmp_pd_mask(all, v[2], _mm512_set1_pd(limit[2]), _CMP_LT_OQ);
            all = _mm512_mask_cmp_pd_mask(all, v[3], _mm512_set1_pd(limit[3]), _CMP_LT_OQ);
            beaten |= all;
        }
        bits[i / 8] = (uint8_t)~beaten;
    }
}

simd_extreme simd_find_in_cell(const simd_cell *first, const simd_cell *more, uint32_t count, const vec3 *n) {
    if (__builtin_cpu_supports("avx2")) return find_in_cell_avx2(first, more, count, n);
    return simd_find_in_cell_scalar(first, more, count, n);
}

void simd_find_unbeaten(const simd_cull *by, const simd_points *points, uint8_t *bits) {
    if (__builtin_cpu_supports("avx512f"))
        find_unbeaten_avx512(by, points, bits);
    else if (__builtin_cpu_supports("avx2"))
        find_unbeaten_avx2(by, points, bits);
    else
        find_unbeaten_scalar(by, points, bits);
}

simd_unbeaten_function *simd_get_unbeaten(simd_isa isa) {
    if (isa == SIMD_AVX512) return __builtin_cpu_supports("avx512f") ? find_unbeaten_avx512 : NULL;
    if (isa == SIMD_AVX2) return __builtin_cpu_supports("avx2") ? find_unbeaten_avx2 : NULL;
    return isa == SIMD_SCALAR ? find_unbeaten_scalar : NULL;
}

#else

simd_extreme simd_find_in_cell(const simd_cell *first, const simd_cell *more, uint32_t count, const vec3 *n) {
    return simd_find_in_cell_scalar(first, more, count, n);
}

void simd_find_unbeaten(const simd_cull *by, const simd_points *points, uint8_t *bits) {
    find_unbeaten_scalar(by, points, bits);
}

simd_unbeaten_function *simd_get_unbeaten(simd_isa isa) { return isa == SIMD_SCALAR ? find_unbeaten_scalar : NULL; }

#endif
