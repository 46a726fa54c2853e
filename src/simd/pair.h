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

/// The same bits as two calls of simd_find_support. Fastest up to 64 points a set: all values stay in registers or the
/// first cache, and the index is that of the first one equal to the largest.
simd_pair simd_find_pair(const simd_points *high, const double h[3], const simd_points *low, const double l[3]);

typedef simd_pair simd_pair_function(const simd_points *high, const double along_high[3], const simd_points *low,
                                     const double along_low[3]);

/// The kernel of one instruction set, for sets of at most 64 points; NULL where this machine or build lacks it.
simd_pair_function *simd_get_pair(simd_isa isa);

#endif
