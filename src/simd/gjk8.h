// GJK of small bodies, eight couples side by side: each has the bits of small_gjk.h's search. A support is the couple's
// own, and eight that do not wait for one another fill the pipeline; the steps of the simplex are in lanes. Lanes end
// and are filled again one by one.
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
    lane_column is_first, steps;                                  ///< is_first: the simplex has no corner yet
    lane_column start[3], start_square, start_gap;                ///< the first direction
    lane_column claim, lower_radii, upper_radii, tolerance, most; ///< of the query; most: its iterations
    lane_column lower, upper; ///< the bounds of lanes that ended apart: along the heading; of the latest support
    double far, near;
    int wants_bracket;
    unsigned active;          ///< lanes that are at work
    unsigned measured;        ///< those of them whose latest support is known already
    uint32_t blocks[PAIR8];   ///< points of the larger body, in eights
    small_gjk_bodies *bodies; ///< PAIR8 of them, set by the caller: where `begin` poses them
} gjk8;

/// How lanes of a round ended; the others go on.
typedef struct gjk8_ends {
    unsigned apart, near, inside, open;
} gjk8_ends;

/// Kernels of one instruction set.
typedef struct gjk8_kernels {
    /// Begins a search in a lane that is not at work.
    void (*begin)(gjk8 *g, unsigned k, const small_gjk_query *query);
    /// A support and a step of all lanes at work. Lanes that end are at work no more; until a search is begun there
    /// gjk8_get_result finds theirs.
    gjk8_ends (*advance)(gjk8 *g);
} gjk8_kernels;

/// What the search in lane k ended with.
void gjk8_get_result(const gjk8 *g, unsigned k, small_gjk_end end, small_gjk_result *result);

/// Makes lane k one that ended with a result; not OPEN or KEPT.
void gjk8_put_result(gjk8 *g, unsigned k, const small_gjk_result *result);

/// The kernels for lane groups of so many pairs: of the widest instruction set of this machine that they fill.
const gjk8_kernels *gjk8_get_kernels(size_t pairs);

/// The kernels of one instruction set, for tests; NULL where this machine or build lacks them.
const gjk8_kernels *gjk8_get_kernels_of(simd_isa isa);

#endif
