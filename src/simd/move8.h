// Eight bodies of a world moved to new poses (world/move.c derives the numbers): their centres, how far they travel,
// and whether they leave their boxes. A lane has the same bits whatever the instruction set and the other lanes, and
// those of one body (place_body in world/move.c): its operations in their order. Lanes whose quaternions are not of
// about unit length are reported as odd, and left to it.
#ifndef OVOID_SIMD_MOVE8_H
#define OVOID_SIMD_MOVE8_H

#include "simd/pair8.h"

/// The places of the numbers of eight bodies.
typedef struct move8_places {
    const double *from[PAIR8], *to[PAIR8]; ///< poses: position xyz, rotation wxyz
    const double *ball[PAIR8];             ///< of the enclosing sphere in the local frame: centre xyz, size
    const double *reach[PAIR8];            ///< reach, one that is not read, error of the centre, one that is not read
    const double *place[PAIR8];            ///< centre xyz, travel
    const double *placed[PAIR8];           ///< those when the box was computed
    const float *room[PAIR8];              ///< how far the body may move from there: against each axis, along each axis
    unsigned count; ///< the lanes in use are the first so many; the places of the others are those of lane 0
} move8_places;

/// Constants of the floor above (world/move.c, world/body_bounds.c).
typedef struct move8_errors {
    double slack;       ///< what sums of few terms are multiplied by
    double nearly_unit; ///< the largest deviation of a quaternion's square from 1
    double center;      ///< the error of a centre, as a part of the lengths it is made of
    double hidden;      ///< OVOID_LENGTH_MIN
} move8_errors;

/// The bodies afterwards, and which have moved, left their boxes, are odd, as bits.
typedef struct move8_result {
    lane_column place[4]; ///< centre xyz, travel
    lane_column displacement[3], turn, center_error;
    unsigned moved, left, odd;
} move8_result;

typedef void move8_function(const move8_places *from, const move8_errors *errors, move8_result *out);

/// The kernel of the widest instruction set of this machine that so many bodies fill.
move8_function *move8_get(size_t bodies);
/// The kernel of one instruction set, for tests; NULL where this machine or build lacks it.
move8_function *move8_get_of(simd_isa isa);

#endif
