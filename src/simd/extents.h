// How far points reach along three directions, both ways: the box of a body's vertices at its pose.
#ifndef OVOID_SIMD_EXTENTS_H
#define OVOID_SIMD_EXTENTS_H

#include "linear/mat3.h"
#include "simd/support.h"

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

#endif
