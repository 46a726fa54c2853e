// The 15 axes of two boxes, in lanes: S. Gottschalk, M. C. Lin, D. Manocha, OBBTree: a hierarchical structure for rapid
// interference detection, 1996. Each face's normal is looked at, then each cross product of two edges, without a
// branch.
#ifndef OVOID_SIMD_BOX_SEPARATION_H
#define OVOID_SIMD_BOX_SEPARATION_H

#include "linear/vec3.h"
#include "simd/support.h"

/// Two boxes in one frame.
typedef struct box_separation_query {
    const double *a, *b;           ///< x of the unit vectors of a box's three edges, then y, then z
    const double *half_a, *half_b; ///< lengths along the edges
    vec3 between;                  ///< from A's centre to B's
    double least;                  ///< >= 0: an axis must separate the boxes by more than that
} box_separation_query;

/// The boxes along one direction.
typedef struct box_separation {
    vec3 n;                 ///< unit, from A to B
    double gap;             ///< min over B of n.x - max over A of n.x, measured along n
    unsigned high_a, low_b; ///< the corners there: bit k: the end of edge k at +1
} box_separation;

/// The kernel of one instruction set; the same bits from each. 1: an axis seems to separate the boxes by more than
/// `least`, the first of the faces, else of the pairs of edges. 0: none does, and *out is not set.
typedef int box_separation_function(const box_separation_query *query, box_separation *out);

/// Runs the kernel of the widest instruction set of this machine.
int box_separation_find(const box_separation_query *query, box_separation *out);

/// The kernel of one instruction set, for tests; NULL where this machine or build lacks it.
box_separation_function *box_separation_get(simd_isa isa);

#endif
