// The cached answers of eight pairs of a world (world/state.h) at their present poses: whether a bound still holds, and
// proofs measured again, which are directions along which bodies were apart, or tetrahedra of differences that contain
// the origin. A lane has the same bits whatever the instruction set and the other lanes, and
// those of the single measurement (world/pair_revalidate.c): its operations in their order. Lanes that need more than
// the common case (a quaternion that has to be scaled, squares that over- or underflow, a tetrahedron too thin for its
// determinants) are reported as odd, and left to it.
#ifndef OVOID_SIMD_KEPT8_H
#define OVOID_SIMD_KEPT8_H

#include "simd/pair8.h"

/// The places of the numbers of a lane group. Pose: position xyz, rotation wxyz, one that is not read. Shape: two
/// that are not read, centre xyz, reach. Lengths: lower_radius, upper_radius, span, one that is not read.
typedef struct kept8_places {
    const double *pose_a[PAIR8], *pose_b[PAIR8], *shape_a[PAIR8], *shape_b[PAIR8], *lengths_a[PAIR8], *lengths_b[PAIR8];
    const double *normal[PAIR8];                           ///< read by `gaps`: the cached normal, world
    const double *vertex_a[4][PAIR8], *vertex_b[4][PAIR8]; ///< read by `depths`: of each difference, body frames
    unsigned count; ///< the lanes in use are the first so many; the places of the others are those of lane 0
} kept8_places;

/// What `gaps` measures. The gap along n is along - high - low - radii - claim, with `high` that of A along in_a and
/// `low` that of B along in_b.
typedef struct kept8_gaps {
    lane_column n[3], in_a[3], in_b[3]; ///< the unit normal: in the world, in A's axes, and minus it in B's
    lane_column between[3];             ///< from centre to centre of the enclosing spheres
    lane_column distance;               ///< its length
    lane_column along;                  ///< of B's body frame from A's, along n
    lane_column radii, claim, sphere;   ///< sphere: the lower bound of the enclosing spheres
} kept8_gaps;

/// What rounding can hide (pair/frame.h, reject.h), in parts of the size and as a length.
typedef struct kept8_errors {
    double reject, claim; ///< FRAME_REJECT, FRAME_CLAIM
    double hidden;        ///< OVOID_LENGTH_MIN
} kept8_errors;

/// The slack of a comparison, of the sum of all its lengths; and the error of both centres that comes from their
/// positions: 128 u of a position (world/body_bounds.c).
#define KEPT8_SLACK 0x1p-48
#define KEPT8_CENTERS 0x1p-45

/// Pairs side by side: entries of `size` bytes that begin with the numbers a and b (uint32_t) of two bodies, v (three
/// doubles) and c. Of each body four doubles: r xyz, travel.
typedef struct kept8_bounds {
    const void *entries;
    size_t size;
    const double *places;
    const double *ranges; ///< PAIR8 numbers: what a margin is greater by
    unsigned count;       ///< 1 to 8
} kept8_bounds;

/// For which pairs a comparison of each kind holds, as bits: c + v.d - t > slack, c - |d - v| - t > slack,
/// |d - v| > c + slack, with d = r_b - r_a and t the sum of the travels. The last slack has the centres' error in it.
typedef struct kept8_answers {
    unsigned plane, ball, sphere;
} kept8_answers;

/// Kernels of one instruction set. Those that return a number return the lanes that are odd.
typedef struct kept8_kernels {
    kept8_answers (*compare)(const kept8_bounds *bounds);
    unsigned (*gaps)(const kept8_places *from, const kept8_errors *errors, kept8_gaps *out);
    /// The upper bound that each tetrahedron proves; 0: the origin is proven to be outside.
    unsigned (*depths)(const kept8_places *from, const kept8_errors *errors, lane_column *upper);
} kept8_kernels;

/// The kernels for lane groups of so many pairs: of the widest instruction set of this machine that they fill.
const kept8_kernels *kept8_get_kernels(size_t pairs);

/// The kernels of one instruction set, for tests; NULL where this machine or build lacks them.
const kept8_kernels *kept8_get_kernels_of(simd_isa isa);

#endif
