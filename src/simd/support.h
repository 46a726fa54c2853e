// The vector kernel of support queries: the index of the largest dot product. And that of boxes: how far points reach
// along three directions, both ways.
#ifndef OVOID_SIMD_SUPPORT_H
#define OVOID_SIMD_SUPPORT_H

#include "linear/mat3.h"

#include <stdint.h>

/// The entries of a column that the kernels read: a multiple of 8.
static inline uint64_t simd_get_padded(uint32_t count) { return ((uint64_t)count + 7) / 8 * 8; }

/// Points as structure of arrays: padded_count (a multiple of 8, not 0) finite entries; padding repeats point 0.
typedef struct simd_points {
    const double *x, *y, *z;
    uint32_t padded_count;
} simd_points;

/// The vertex extreme along a direction.
typedef struct support_result {
    double value;   ///< (x n.x + y n.y) + z n.z of that vertex, rounded in this order; zero is always +0
    uint32_t index; ///< lowest index among equal values
} support_result;

/// The vertex extreme along n, which is read where it is, as in simd/corner.h. The same bits from every instruction
/// set. Cost: padded_count / lanes steps.
support_result simd_find_support(const simd_points *points, const vec3 *n);

/// The scalar twin, always compiled, for tests and machines without vectors.
support_result simd_find_support_scalar(const simd_points *points, vec3 n);

/// The instruction sets that have a kernel.
typedef enum simd_isa { SIMD_SCALAR, SIMD_SSE2, SIMD_AVX2, SIMD_AVX512, SIMD_ISA_COUNT } simd_isa;

typedef support_result simd_support_function(const simd_points *points, const vec3 *n);

/// The kernel of one instruction set, for tests and measurements; NULL where this machine or build lacks it.
simd_support_function *simd_get_support(simd_isa isa);

/// The least and the greatest of row.p over the points, for each row of a matrix.
typedef struct simd_extents {
    double low[3], high[3];
} simd_extents;

/// The same bits from every instruction set, those of simd_find_support: (x n.x + y n.y) + z n.z, but for the sign of
/// zero. Cost: padded_count / lanes steps.
simd_extents simd_find_extents(const simd_points *points, const mat3 *rows);

typedef simd_extents simd_extents_function(const simd_points *points, const mat3 *rows);

/// The kernel of one instruction set, for tests; NULL where this machine or build lacks it.
simd_extents_function *simd_get_extents(simd_isa isa);

/// "scalar", "sse2", "avx2", "avx512".
const char *simd_isa_get_name(simd_isa isa);

#endif
