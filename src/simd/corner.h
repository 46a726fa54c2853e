// One step of GJK: a new corner joins a simplex whose nearest point to the origin is known. The step finds which of the
// faces with that corner holds the nearest point of the larger simplex.
#ifndef OVOID_SIMD_CORNER_H
#define OVOID_SIMD_CORNER_H

#include "linear/vec3.h"

/// The old corners, in lanes 0 to 2; lane 3 is not used. All numbers finite.
typedef struct corner_lanes {
    _Alignas(32) double x[4];
    _Alignas(32) double y[4];
    _Alignas(32) double z[4];
} corner_lanes;

/// What the step finds.
typedef struct corner_step {
    double x, y, z; ///< the direction from the origin to the nearest point, of any length
    double square;  ///< of that length
    unsigned kept;  ///< the lanes that stay; the new corner always does
    int is_inside;  ///< 1: the origin is in the tetrahedron; the other members then mean nothing
    int is_sliver;  ///< 1: a face whose edges meet at an angle below 0.01, so that its normal is uncertain
} corner_step;

/// The step from the corners of the lanes in `valid` (a mask, not 0) to the new corner a. It is read where it is: a
/// copy for the call would be read in other pieces than it has just been written in, for which a processor waits. The
/// same bits from every instruction set. Where rounding spoils a sign, another face than the nearest is found: the
/// caller compares the distance.
corner_step simd_step_from_corner(const corner_lanes *old, unsigned valid, const vec3 *a);

/// The scalar twin, for tests and machines without vectors.
corner_step simd_step_from_corner_scalar(const corner_lanes *old, unsigned valid, vec3 a);

#endif
