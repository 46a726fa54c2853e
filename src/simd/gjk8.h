// The state of GJK of small bodies, eight couples side by side (group_gjk.h): each has the bits of small_gjk.h's search
// of unposed bodies.
#ifndef OVOID_SIMD_GJK8_H
#define OVOID_SIMD_GJK8_H

#include "simd/pair8.h"
#include "simd/small_gjk.h"

/// The differences of one corner of eight simplices, and which points they are of: a + 32 b, a whole number.
typedef struct gjk8_corner {
    lane_column x, y, z, id;
} gjk8_corner;

/// Eight searches. Truth values are numbers, 0 or 1.
typedef struct gjk8 {
    gjk8_corner old[3], fresh; ///< the simplex; the latest support
    lane_column is_valid[3];   ///< of the old corners
    lane_column n[3];          ///< the heading,
    lane_column height, square, gap;
    lane_column steps;
    lane_column start[3], start_square, start_gap;                ///< the first direction
    lane_column claim, lower_radii, upper_radii, tolerance, most; ///< of the query; most: its iterations
    lane_column lower, upper; ///< the bounds of lanes that ended apart: along the heading; of the latest support
    double far, near;
    int wants_bracket;
    unsigned active; ///< lanes that are at work
} gjk8;

/// How lanes ended; the others go on.
typedef struct gjk8_ends {
    unsigned apart, near, inside, open;
} gjk8_ends;

/// What the search in lane k ended with.
void gjk8_get_result(const gjk8 *g, unsigned k, small_gjk_end end, small_gjk_result *result);

/// Makes lane k one that ended near, with a result; of APART the only corner is its simplex.
void gjk8_put_result(gjk8 *g, unsigned k, const small_gjk_result *result);

#endif
