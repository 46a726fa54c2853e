// Vectors side by side, four in AVX2 and eight in AVX-512: x, y and z of each in lanes. Included only where these sets
// are compiled for; every operation is that of linear/vec3.h, in its order.
#ifndef OVOID_SIMD_KERNELS_VECTORS_H
#define OVOID_SIMD_KERNELS_VECTORS_H

#include "linear/vec3.h"

#include <immintrin.h>

#define VECTORS_AVX2 __attribute__((target("avx2"))) static inline __attribute__((always_inline))
#define VECTORS_AVX512 __attribute__((target("avx512f"))) static inline __attribute__((always_inline))

typedef struct vectors4 {
    __m256d x, y, z;
} vectors4;

VECTORS_AVX2 vectors4 vectors4_load(const double *x, const double *y, const double *z) {
    return (vectors4){_mm256_loadu_pd(x), _mm256_loadu_pd(y), _mm256_loadu_pd(z)};
}
/// The same vector in all lanes.
VECTORS_AVX2 vectors4 vectors4_spread(vec3 v) {
    return (vectors4){_mm256_set1_pd(v.x), _mm256_set1_pd(v.y), _mm256_set1_pd(v.z)};
}
VECTORS_AVX2 __m256d vectors4_dot(vectors4 a, vectors4 b) {
    return _mm256_add_pd(_mm256_add_pd(_mm256_mul_pd(a.x, b.x), _mm256_mul_pd(a.y, b.y)), _mm256_mul_pd(a.z, b.z));
}
VECTORS_AVX2 vectors4 vectors4_cross(vectors4 a, vectors4 b) {
    return (vectors4){_mm256_sub_pd(_mm256_mul_pd(a.y, b.z), _mm256_mul_pd(a.z, b.y)),
                      _mm256_sub_pd(_mm256_mul_pd(a.z, b.x), _mm256_mul_pd(a.x, b.z)),
                      _mm256_sub_pd(_mm256_mul_pd(a.x, b.y), _mm256_mul_pd(a.y, b.x))};
}

typedef struct vectors8 {
    __m512d x, y, z;
} vectors8;

VECTORS_AVX512 vectors8 vectors8_load(const double *x, const double *y, const double *z) {
    return (vectors8){_mm512_loadu_pd(x), _mm512_loadu_pd(y), _mm512_loadu_pd(z)};
}
VECTORS_AVX512 vectors8 vectors8_spread(vec3 v) {
    return (vectors8){_mm512_set1_pd(v.x), _mm512_set1_pd(v.y), _mm512_set1_pd(v.z)};
}
VECTORS_AVX512 __m512d vectors8_dot(vectors8 a, vectors8 b) {
    return _mm512_add_pd(_mm512_add_pd(_mm512_mul_pd(a.x, b.x), _mm512_mul_pd(a.y, b.y)), _mm512_mul_pd(a.z, b.z));
}

#endif
