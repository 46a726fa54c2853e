// Products are (x n.x + y n.y) + z n.z as in support.c, so that a value has the same bits wherever it is computed, and
// the lowest index among equal values wins: entries are ascending, and a later one has to be greater.
#include "simd/support_cell.h"

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

simd_extreme simd_find_in_cell(const simd_cell *first, const simd_cell *more, uint32_t count, const vec3 *n) {
    if (__builtin_cpu_supports("avx2")) return find_in_cell_avx2(first, more, count, n);
    return simd_find_in_cell_scalar(first, more, count, n);
}

#else

simd_extreme simd_find_in_cell(const simd_cell *first, const simd_cell *more, uint32_t count, const vec3 *n) {
    return simd_find_in_cell_scalar(first, more, count, n);
}

#endif
