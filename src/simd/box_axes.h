// The planes of the difference of two parallelepipeds, in lanes: it is a sum of six segments (a zonotope), each pair of
// which spans two opposite faces.
#ifndef OVOID_SIMD_BOX_AXES_H
#define OVOID_SIMD_BOX_AXES_H

#include "linear/vec3.h"
#include "simd/support.h"

enum { BOX_AXES_SEGMENTS = 6, BOX_AXES_PAIRS = 15, BOX_AXES = 16 };

/// The pairs of segments, the last one again so that there are BOX_AXES.
extern const uint8_t box_axes_first[BOX_AXES], box_axes_second[BOX_AXES];

/// All x with x = center + sum t_k segment_k, |t_k| <= 1.
typedef struct box_axes_query {
    _Alignas(64) double segment[3][8]; ///< x, y, z of each; the last two are zero
    double center[3];
    double error; ///< what rounding does to a height where the pair is at right angles
    double doubt; ///< a face's height^2 |u x v|^2 must be above this times |u|^2 + |v|^2 of its pair u, v
} box_axes_query;

/// For each pair its unit normal n, along the first segment's cross product with the second.
typedef struct box_axes {
    _Alignas(64) double n[3][BOX_AXES];
    double height[BOX_AXES]; ///< of the origin below the nearer of the two faces: sum |n.segment| - |n.center|
    double error[BOX_AXES];  ///< what rounding does to it, at most; it grows as the pair becomes parallel
    double along[BOX_AXES];  ///< n.center
    uint32_t positive[BOX_AXES_SEGMENTS]; ///< bit i: n_i.segment_k > 0; that of a pair's own segments says nothing
} box_axes;

/// The kernel of one instruction set; the same bits from each. 1 if all signs but those of a pair's own segments are
/// beyond rounding, so that the faces are parallelograms and there are no others, and all heights beyond the doubt.
typedef int box_axes_function(const box_axes_query *query, box_axes *out);

/// Runs the kernel of the widest instruction set of this machine.
int box_axes_find(const box_axes_query *query, box_axes *out);

/// The kernel of one instruction set, for tests; NULL where this machine or build lacks it.
box_axes_function *box_axes_get(simd_isa isa);

// ---- an axis that separates two boxes
//
// All 15 axes are looked at in lanes, without a branch: S. Gottschalk, M. C. Lin, D. Manocha, OBBTree: a hierarchical
// structure for rapid interference detection, 1996.

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
