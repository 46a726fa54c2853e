// The vector kernel of a pair's support: both bodies at once, for bodies of few vertices.
#ifndef OVOID_SIMD_PAIR_H
#define OVOID_SIMD_PAIR_H

#include "simd/support.h"

/// The supports of two sets, each along a direction of its own: h of the first, l of the second.
typedef struct simd_pair {
    support_result high, low;
} simd_pair;

/// The result has the bits of two calls of simd_find_support. Fastest up to 64 points a set: all values stay in
/// registers or the first cache, and the index is that of the first one equal to the largest.
simd_pair simd_find_pair(const simd_points *high, vec3 h, const simd_points *low, vec3 l);

/// The difference B minus A that is least along n, of two sets in one frame.
typedef struct simd_difference {
    double gap; ///< least of B along n minus greatest of A
    double x, y, z;
    uint32_t a, b;
} simd_difference;

/// The indices and values are those of simd_find_pair of A along n and of B along -n: gap = -low - high.
simd_difference simd_find_difference(const simd_points *a, const simd_points *b, vec3 n);

/// The points rotated (by rows of a matrix) and translated, from->padded_count numbers of x, y and z each to their own
/// array. The same bits from every instruction set: ((r0 x + r1 y) + r2 z) + t.
void simd_pose_points(const simd_points *from, const double rows[9], const double t[3], double *const to[3]);
void simd_pose_points_scalar(const simd_points *from, const double rows[9], const double t[3], double *const to[3]);

typedef simd_pair simd_pair_function(const simd_points *high, vec3 h, const simd_points *low, vec3 l);

/// The kernel of one instruction set, for sets of at most 64 points; NULL where this machine or build lacks it.
simd_pair_function *simd_get_pair(simd_isa isa);

#endif
