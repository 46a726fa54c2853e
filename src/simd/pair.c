// The largest value is found first, by a tree of maxima without indices; then one mask of the values that equal it,
// whose lowest bit is the index. No branch depends on the values. The chains of both sets run side by side.
#include "simd/pair.h"

#include <stddef.h>

static simd_pair find_pair_scalar(const simd_points *high, vec3 h, const simd_points *low, vec3 l) {
    return (simd_pair){simd_find_support_scalar(high, h), simd_find_support_scalar(low, l)};
}

static inline simd_difference difference_of(const simd_points *a, const simd_points *b, support_result high,
                                            support_result low) {
    uint32_t i = high.index, k = low.index;
    return (simd_difference){-low.value - high.value, b->x[k] - a->x[i], b->y[k] - a->y[i], b->z[k] - a->z[i], i, k};
}

void simd_pose_points_scalar(const simd_points *from, const double rows[9], const double t[3], double *const to[3]) {
    for (uint32_t i = 0; i < from->padded_count; i++)
        for (int k = 0; k < 3; k++)
            to[k][i] =
                ((rows[3 * k] * from->x[i] + rows[3 * k + 1] * from->y[i]) + rows[3 * k + 2] * from->z[i]) + t[k];
}

#if defined(__x86_64__) && defined(__GNUC__)

#include "simd/kernels/vectors.h"

enum { MOST = 64 };

#define AVX2 __attribute__((target("avx2")))

AVX2 static inline __attribute__((always_inline)) support_result find_avx2(const simd_points *p, vec3 n) {
    vectors4 along = vectors4_spread(n);
    __m256d value[MOST / 4];
    __m256d even = _mm256_set1_pd(-__builtin_inf()), odd = even;
    uint32_t count = p->padded_count / 4;
    for (uint32_t i = 0; i < count; i += 2) {
        for (uint32_t k = 0; k < 2; k++)
            value[i + k] =
                vectors4_dot(vectors4_load(p->x + 4 * (i + k), p->y + 4 * (i + k), p->z + 4 * (i + k)), along);
        even = _mm256_max_pd(even, value[i]);
        odd = _mm256_max_pd(odd, value[i + 1]);
    }
    __m256d m = _mm256_max_pd(even, odd);
    m = _mm256_max_pd(m, _mm256_permute2f128_pd(m, m, 1));
    m = _mm256_max_pd(m, _mm256_permute_pd(m, 5));
    uint64_t equal = 0;
    for (uint32_t i = 0; i < count; i++)
        equal |= (uint64_t)(unsigned)_mm256_movemask_pd(_mm256_cmp_pd(value[i], m, _CMP_EQ_OQ)) << 4 * i;
    return (support_result){_mm256_cvtsd_f64(m) + 0.0, equal ? (uint32_t)__builtin_ctzll(equal) : 0};
}

AVX2 static simd_pair find_pair_avx2(const simd_points *high, vec3 h, const simd_points *low, vec3 l) {
    return (simd_pair){find_avx2(high, h), find_avx2(low, l)};
}

AVX2 static simd_difference find_difference_avx2(const simd_points *a, const simd_points *b, vec3 n) {
    return difference_of(a, b, find_avx2(a, n), find_avx2(b, vec3_neg(n)));
}

AVX2 static void pose_points_avx2(const simd_points *from, const double rows[9], const double t[3],
                                  double *const to[3]) {
    double *const out[3] = {to[0], to[1], to[2]};
    for (uint32_t i = 0; i < from->padded_count; i += 4) {
        __m256d px = _mm256_loadu_pd(from->x + i), py = _mm256_loadu_pd(from->y + i), pz = _mm256_loadu_pd(from->z + i);
        for (int k = 0; k < 3; k++) {
            __m256d sum = _mm256_add_pd(_mm256_mul_pd(_mm256_set1_pd(rows[3 * k]), px),
                                        _mm256_mul_pd(_mm256_set1_pd(rows[3 * k + 1]), py));
            sum = _mm256_add_pd(sum, _mm256_mul_pd(_mm256_set1_pd(rows[3 * k + 2]), pz));
            _mm256_storeu_pd(out[k] + i, _mm256_add_pd(sum, _mm256_set1_pd(t[k])));
        }
    }
}

#define AVX512 __attribute__((target("avx512f")))

AVX512 static inline __m512d dot8(const simd_points *p, uint32_t i, vectors8 n) {
    return vectors8_dot(vectors8_load(p->x + 8 * i, p->y + 8 * i, p->z + 8 * i), n);
}

AVX512 static inline __attribute__((always_inline)) support_result find_avx512(const simd_points *p, vec3 n) {
    vectors8 along = vectors8_spread(n);
    __m512d value[MOST / 8];
    uint32_t count = p->padded_count / 8;
    __m512d m = value[0] = dot8(p, 0, along);
    for (uint32_t i = 1; i < count; i++) {
        value[i] = dot8(p, i, along);
        m = _mm512_max_pd(m, value[i]);
    }
    m = _mm512_max_pd(m, _mm512_shuffle_f64x2(m, m, 0x4e));
    m = _mm512_max_pd(m, _mm512_shuffle_f64x2(m, m, 0xb1));
    m = _mm512_max_pd(m, _mm512_permute_pd(m, 0x55));
    uint64_t equal = _mm512_cmp_pd_mask(value[0], m, _CMP_EQ_OQ);
    for (uint32_t i = 1; i < count; i++) equal |= (uint64_t)_mm512_cmp_pd_mask(value[i], m, _CMP_EQ_OQ) << 8 * i;
    return (support_result){_mm512_cvtsd_f64(m) + 0.0, equal ? (uint32_t)__builtin_ctzll(equal) : 0};
}

AVX512 static simd_pair find_pair_avx512(const simd_points *high, vec3 h, const simd_points *low, vec3 l) {
    return (simd_pair){find_avx512(high, h), find_avx512(low, l)};
}

AVX512 static simd_difference find_difference_avx512(const simd_points *a, const simd_points *b, vec3 n) {
    return difference_of(a, b, find_avx512(a, n), find_avx512(b, vec3_neg(n)));
}

static simd_difference find_difference_apart(const simd_points *a, const simd_points *b, vec3 n) {
    vec3 back = vec3_neg(n);
    return difference_of(a, b, simd_find_support(a, &n), simd_find_support(b, &back));
}

simd_difference simd_find_difference(const simd_points *a, const simd_points *b, vec3 n) {
    if (a->padded_count > MOST || b->padded_count > MOST) return find_difference_apart(a, b, n);
    int is_small = a->padded_count <= 16 && b->padded_count <= 16;
    if (!is_small && __builtin_cpu_supports("avx512f")) return find_difference_avx512(a, b, n);
    if (__builtin_cpu_supports("avx2")) return find_difference_avx2(a, b, n);
    return find_difference_apart(a, b, n);
}

void simd_pose_points(const simd_points *from, const double rows[9], const double t[3], double *const to[3]) {
    if (__builtin_cpu_supports("avx2"))
        pose_points_avx2(from, rows, t, to);
    else
        simd_pose_points_scalar(from, rows, t, to);
}

simd_pair simd_find_pair(const simd_points *high, vec3 h, const simd_points *low, vec3 l) {
    if (high->padded_count > MOST || low->padded_count > MOST)
        return (simd_pair){simd_find_support(high, &h), simd_find_support(low, &l)};
    // Up to 16 points the wider kernel's last step costs more than it saves, as in simd_find_support.
    int is_small = high->padded_count <= 16 && low->padded_count <= 16;
    if (!is_small && __builtin_cpu_supports("avx512f")) return find_pair_avx512(high, h, low, l);
    if (__builtin_cpu_supports("avx2")) return find_pair_avx2(high, h, low, l);
    return (simd_pair){simd_find_support(high, &h), simd_find_support(low, &l)};
}

simd_pair_function *simd_get_pair(simd_isa isa) {
    switch (isa) {
    case SIMD_SCALAR: return find_pair_scalar;
    case SIMD_AVX2: return __builtin_cpu_supports("avx2") ? find_pair_avx2 : NULL;
    case SIMD_AVX512: return __builtin_cpu_supports("avx512f") ? find_pair_avx512 : NULL;
    default: return NULL;
    }
}

#else

simd_difference simd_find_difference(const simd_points *a, const simd_points *b, vec3 n) {
    return difference_of(a, b, simd_find_support_scalar(a, n), simd_find_support_scalar(b, vec3_neg(n)));
}

void simd_pose_points(const simd_points *from, const double rows[9], const double t[3], double *const to[3]) {
    simd_pose_points_scalar(from, rows, t, to);
}

simd_pair simd_find_pair(const simd_points *high, vec3 h, const simd_points *low, vec3 l) {
    return find_pair_scalar(high, h, low, l);
}

simd_pair_function *simd_get_pair(simd_isa isa) { return isa == SIMD_SCALAR ? find_pair_scalar : NULL; }

#endif
