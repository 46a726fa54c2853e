// The vector kernel of support queries: the index of the largest dot product.
#ifndef OVOID_SIMD_SUPPORT_H
#define OVOID_SIMD_SUPPORT_H

#include <stdint.h>

/// The vertex extreme along a direction.
typedef struct support_result {
    double value;   ///< (x dx + y dy) + z dz of that vertex, rounded in this order; zero is always +0
    uint32_t index; ///< lowest index among equal values
} support_result;

/// The extreme vertex of points as structure of arrays, padded_count (a multiple of 8, not 0) finite entries; padding
/// repeats point 0. The same bits from every instruction set. Cost: padded_count / lanes steps.
support_result simd_find_support(const double *x, const double *y, const double *z, uint32_t padded_count, double dx,
                                 double dy, double dz);

/// The scalar twin, always compiled, for tests and machines without vectors.
support_result simd_find_support_scalar(const double *x, const double *y, const double *z, uint32_t padded_count,
                                        double dx, double dy, double dz);

/// The instruction sets that have a kernel.
typedef enum simd_isa { SIMD_SCALAR, SIMD_SSE2, SIMD_AVX2, SIMD_AVX512, SIMD_ISA_COUNT } simd_isa;

typedef support_result simd_support_function(const double *x, const double *y, const double *z, uint32_t padded_count,
                                             double dx, double dy, double dz);

/// The kernel of one instruction set, for tests and measurements; NULL where this machine or build lacks it.
simd_support_function *simd_get_support(simd_isa isa);

/// "scalar", "sse2", "avx2", "avx512".
const char *simd_isa_get_name(simd_isa isa);

#endif
