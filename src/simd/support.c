// The vertex extreme along a direction, by a search of all vertices: for hulls up to some hundred vertices nothing is
// faster than reading them in order.
//
// Same bits from every instruction set: each value is (x n.x + y n.y) + z n.z with four roundings and no fused
// operation, and the answer is the lowest index among the largest values. A lane keeps the first of its own largest
// values (the comparison is strict), and the last step takes the lowest index among the lanes that reached the maximum.
// Equal values can differ in bits only as +0 and -0, so every kernel adds +0 to its result, which turns -0 into +0.
//
// The set is chosen at each call from what the compiler's runtime read at start (two loads and a test, no state of this
// library). Two accumulators in each kernel hide the latency of compare and blend.
#include "simd/support.h"

#include <stddef.h>

support_result simd_find_support_scalar(const simd_points *p, vec3 n) {
    const double *x = p->x, *y = p->y, *z = p->z;
    support_result best = {(x[0] * n.x + y[0] * n.y) + z[0] * n.z, 0};
    for (uint32_t i = 1; i < p->padded_count; i++) {
        double value = (x[i] * n.x + y[i] * n.y) + z[i] * n.z;
        if (value > best.value) best = (support_result){value, i};
    }
    best.value += 0.0;
    return best;
}

static support_result find_support_scalar(const simd_points *p, const vec3 *n) {
    return simd_find_support_scalar(p, *n);
}

#if defined(__x86_64__) && defined(__GNUC__)

#include "simd/kernels/vectors.h"

/// Lowest of the indices whose lane is set in mask; 0 where none is, as of values that are no numbers.
static inline uint32_t find_lowest(const uint64_t *indices, unsigned mask) {
    if (!mask) return 0;
    uint64_t best = indices[__builtin_ctz(mask)];
    while (mask &= mask - 1) {
        uint64_t other = indices[__builtin_ctz(mask)];
        if (other < best) best = other;
    }
    return (uint32_t)best;
}

/// The largest value and the index of each lane so far, two points wide.
typedef struct lanes2 {
    __m128d value;
    __m128i index;
} lanes2;

static inline __m128d select2(__m128d mask, __m128d yes, __m128d no) {
    return _mm_or_pd(_mm_and_pd(mask, yes), _mm_andnot_pd(mask, no));
}

static inline lanes2 step2(lanes2 best, __m128d value, __m128i index) {
    __m128d greater = _mm_cmpgt_pd(value, best.value);
    best.value = select2(greater, value, best.value);
    best.index = _mm_castpd_si128(select2(greater, _mm_castsi128_pd(index), _mm_castsi128_pd(best.index)));
    return best;
}

/// A direction, the same in all lanes.
typedef struct direction2 {
    __m128d x, y, z;
} direction2;

static inline direction2 spread2(vec3 n) { return (direction2){_mm_set1_pd(n.x), _mm_set1_pd(n.y), _mm_set1_pd(n.z)}; }

/// The values of two points from the i-th on.
static inline __m128d dot2(const simd_points *p, size_t i, direction2 n) {
    return _mm_add_pd(_mm_add_pd(_mm_mul_pd(_mm_loadu_pd(p->x + i), n.x), _mm_mul_pd(_mm_loadu_pd(p->y + i), n.y)),
                      _mm_mul_pd(_mm_loadu_pd(p->z + i), n.z));
}

static support_result find_support_sse2(const simd_points *p, const vec3 *along) {
    direction2 n = spread2(*along);
    __m128i index = _mm_set_epi64x(1, 0), two = _mm_set1_epi64x(2);
    lanes2 even = {dot2(p, 0, n), index}, odd = even;
    for (size_t i = 0; i < p->padded_count; i += 4) {
        even = step2(even, dot2(p, i, n), index);
        index = _mm_add_epi64(index, two);
        odd = step2(odd, dot2(p, i + 2, n), index);
        index = _mm_add_epi64(index, two);
    }

    // The maximum of the four lanes, then the lowest index that reaches it.
    __m128d m = _mm_max_pd(even.value, odd.value);
    m = _mm_max_pd(m, _mm_shuffle_pd(m, m, 1));
    unsigned mask = (unsigned)_mm_movemask_pd(_mm_cmpeq_pd(even.value, m)) |
                    (unsigned)_mm_movemask_pd(_mm_cmpeq_pd(odd.value, m)) << 2;
    uint64_t indices[4];
    _mm_storeu_si128((__m128i *)indices, even.index);
    _mm_storeu_si128((__m128i *)(indices + 2), odd.index);
    return (support_result){_mm_cvtsd_f64(m) + 0.0, find_lowest(indices, mask)};
}

#define AVX2 __attribute__((target("avx2")))

/// The largest value and the index of each lane so far, four points wide.
typedef struct lanes4 {
    __m256d value;
    __m256i index;
} lanes4;

AVX2 static inline lanes4 step4(lanes4 best, __m256d value, __m256i index) {
    __m256d greater = _mm256_cmp_pd(value, best.value, _CMP_GT_OQ);
    best.value = _mm256_blendv_pd(best.value, value, greater);
    best.index =
        _mm256_castpd_si256(_mm256_blendv_pd(_mm256_castsi256_pd(best.index), _mm256_castsi256_pd(index), greater));
    return best;
}

/// The values of four points from the i-th on.
AVX2 static inline __m256d dot4(const simd_points *p, size_t i, vectors4 n) {
    return vectors4_dot(vectors4_load(p->x + i, p->y + i, p->z + i), n);
}

AVX2 static support_result find_support_avx2(const simd_points *p, const vec3 *along) {
    vectors4 n = vectors4_spread(*along);
    __m256i index = _mm256_set_epi64x(3, 2, 1, 0), four = _mm256_set1_epi64x(4);
    lanes4 even = {dot4(p, 0, n), index};
    index = _mm256_add_epi64(index, four);
    lanes4 odd = {dot4(p, 4, n), index};
    for (size_t i = 8; i < p->padded_count; i += 8) {
        index = _mm256_add_epi64(index, four);
        even = step4(even, dot4(p, i, n), index);
        index = _mm256_add_epi64(index, four);
        odd = step4(odd, dot4(p, i + 4, n), index);
    }

    __m256d m = _mm256_max_pd(even.value, odd.value);
    m = _mm256_max_pd(m, _mm256_permute2f128_pd(m, m, 1));
    m = _mm256_max_pd(m, _mm256_permute_pd(m, 5));
    unsigned mask = (unsigned)_mm256_movemask_pd(_mm256_cmp_pd(even.value, m, _CMP_EQ_OQ)) |
                    (unsigned)_mm256_movemask_pd(_mm256_cmp_pd(odd.value, m, _CMP_EQ_OQ)) << 4;
    uint64_t indices[8];
    _mm256_storeu_si256((__m256i *)indices, even.index);
    _mm256_storeu_si256((__m256i *)(indices + 4), odd.index);
    return (support_result){_mm256_cvtsd_f64(m) + 0.0, find_lowest(indices, mask)};
}

#define AVX512 __attribute__((target("avx512f")))

/// The largest value and the index of each lane so far, eight points wide.
typedef struct lanes8 {
    __m512d value;
    __m512i index;
} lanes8;

AVX512 static inline lanes8 step8(lanes8 best, __m512d value, __m512i index) {
    __mmask8 greater = _mm512_cmp_pd_mask(value, best.value, _CMP_GT_OQ);
    best.value = _mm512_mask_mov_pd(best.value, greater, value);
    best.index = _mm512_mask_mov_epi64(best.index, greater, index);
    return best;
}

/// The values of eight points from the i-th on.
AVX512 static inline __m512d dot8(const simd_points *p, size_t i, vectors8 n) {
    return vectors8_dot(vectors8_load(p->x + i, p->y + i, p->z + i), n);
}

AVX512 static support_result find_support_avx512(const simd_points *p, const vec3 *along) {
    vectors8 n = vectors8_spread(*along);
    __m512i index = _mm512_set_epi64(7, 6, 5, 4, 3, 2, 1, 0), eight = _mm512_set1_epi64(8);
    lanes8 even = {dot8(p, 0, n), index}, odd = even;
    size_t i = 8;
    for (; i + 8 < p->padded_count; i += 16) {
        index = _mm512_add_epi64(index, eight);
        odd = step8(odd, dot8(p, i, n), index);
        index = _mm512_add_epi64(index, eight);
        even = step8(even, dot8(p, i + 8, n), index);
    }
    if (i < p->padded_count) odd = step8(odd, dot8(p, i, n), _mm512_add_epi64(index, eight));

    __m512d m = _mm512_max_pd(even.value, odd.value);
    m = _mm512_max_pd(m, _mm512_shuffle_f64x2(m, m, 0x4e));
    m = _mm512_max_pd(m, _mm512_shuffle_f64x2(m, m, 0xb1));
    m = _mm512_max_pd(m, _mm512_permute_pd(m, 0x55));
    unsigned mask = (unsigned)_mm512_cmp_pd_mask(even.value, m, _CMP_EQ_OQ) |
                    (unsigned)_mm512_cmp_pd_mask(odd.value, m, _CMP_EQ_OQ) << 8;
    uint64_t indices[16];
    _mm512_storeu_si512(indices, even.index);
    _mm512_storeu_si512(indices + 8, odd.index);
    return (support_result){_mm512_cvtsd_f64(m) + 0.0, find_lowest(indices, mask)};
}

support_result simd_find_support(const simd_points *points, const vec3 *n) {
    // Up to 16 points the wider kernel's longer last step costs more than it saves (measured).
    if (points->padded_count > 16 && __builtin_cpu_supports("avx512f")) return find_support_avx512(points, n);
    if (__builtin_cpu_supports("avx2")) return find_support_avx2(points, n);
    return find_support_sse2(points, n);
}

simd_support_function *simd_get_support(simd_isa isa) {
    switch (isa) {
    case SIMD_SCALAR: return find_support_scalar;
    case SIMD_SSE2: return find_support_sse2;
    case SIMD_AVX2: return __builtin_cpu_supports("avx2") ? find_support_avx2 : NULL;
    case SIMD_AVX512: return __builtin_cpu_supports("avx512f") ? find_support_avx512 : NULL;
    case SIMD_ISA_COUNT: break;
    }
    return NULL;
}

#else

support_result simd_find_support(const simd_points *points, const vec3 *n) { return find_support_scalar(points, n); }

simd_support_function *simd_get_support(simd_isa isa) { return isa == SIMD_SCALAR ? find_support_scalar : NULL; }

#endif

const char *simd_isa_get_name(simd_isa isa) {
    static const char *const names[SIMD_ISA_COUNT] = {"scalar", "sse2", "avx2", "avx512"};
    return isa < SIMD_ISA_COUNT ? names[isa] : "unknown";
}
