// The vector kernel of a pair's support: both bodies at once, for bodies of few vertices.
#ifndef OVOID_SIMD_PAIR_H
#define OVOID_SIMD_PAIR_H

#include "simd/support.h"

/// Points as structure of arrays, padded as simd_find_support has them.
typedef struct simd_points {
    const double *x, *y, *z;
    uint32_t padded_count;
} simd_points;

/// The supports of two sets, each along a direction of its own: h of the first, l of the second.
typedef struct simd_pair {
    support_result high, low;
} simd_pair;

/// The result has the bits of two calls of simd_find_support. Fastest up to 64 points a set: all values stay in
/// registers or the first cache, and the index is that of the first one equal to the largest.
simd_pair simd_find_pair(const simd_points *high, const double h[3], const simd_points *low, const double l[3]);

/// The difference B minus A that is least along n, of two sets in one frame.
typedef struct simd_difference {
    double gap; ///< least of B along n minus greatest of A
    double x, y, z;
    uint32_t a, b;
} simd_difference;

/// The indices and values are those of simd_find_pair of A along n and of B along -n: gap = -low - high.
simd_difference simd_find_difference(const simd_points *a, const simd_points *b, double nx, double ny, double nz);

/// The points rotated (by rows of a matrix) and translated, from->padded_count numbers each to x, y, z. The same bits
/// from every instruction set: ((r0 x + r1 y) + r2 z) + t.
void simd_pose_points(const simd_points *from, const double rows[9], const double t[3], double *x, double *y,
                      double *z);
void simd_pose_points_scalar(const simd_points *from, const double rows[9], const double t[3], double *x, double *y,
                             double *z);

typedef simd_pair simd_pair_function(const simd_points *high, const double along_high[3], const simd_points *low,
                                     const double along_low[3]);

/// The kernel of one instruction set, for sets of at most 64 points; NULL where this machine or build lacks it.
simd_pair_function *simd_get_pair(simd_isa isa);

#endif
