// Upper bounds from points inside the inner ellipsoids.
#ifndef OVOID_PAIR_INNER_H
#define OVOID_PAIR_INNER_H

#include "pair/frame.h"

/// An upper bound of d below zero from a point strictly inside both inner ellipsoids, or 0 if that is not proven.
/// x: in A's body frame. Solids only.
double inner_compute_upper(const pair_frame *frame, vec3 x);

/// Sets *x to a point between the centres that is well inside both inner ellipsoids, to rounding; 0 if there is none.
int inner_find_common(const pair_frame *frame, vec3 *x);

/// An upper bound of d from a point of each inner ellipsoid, each in its body frame; infinity if one point is outside.
/// error: added to the distance of the points.
double inner_points_compute_upper(const pair_frame *frame, vec3 a, vec3 b, double error);

/// inner_compute_upper before the pair has its frame (frame_place is enough). The result is above that of
/// inner_compute_upper for the same point, rounding included.
double inner_compute_upper_at(const pair_frame *frame, vec3 x);

/// The upper bound from a point of the segment between the centres, *x in A's body frame; 0 if no point of it is proven
/// common.
double inner_compute_upper_in_world(const pair_frame *frame, vec3 *x);

#endif
