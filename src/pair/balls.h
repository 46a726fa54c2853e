// Upper bounds from a ball in each body, of pairs with a true cylinder, cone or ellipsoid.
#ifndef OVOID_PAIR_BALLS_H
#define OVOID_PAIR_BALLS_H

#include "pair/proof.h"
#include "pair/round.h"

// With u = 2^-53, the radii of two balls are off by less than 60 u s (frame.h), beside what their centres are off by.
#define BALLS_CLAIM (128 * 0x1p-53)
#define BALLS_CHECK (64 * 0x1p-53)

/// The centres of two balls, each in its body frame. That in a body that is not round is a point of it, with a ball of
/// radius 0.
typedef struct ball_centers {
    vec3 a, b;
} ball_centers;

/// The point of a true body that x becomes when it is cut off at the body, to rounding; x where it is inside.
vec3 balls_cut_off(const ovoid_shape *shape, vec3 x);

/// The distance of the centres minus the radii of the balls, plus `error`; infinity if there are none.
double balls_measure(const pair_frame *frame, const ball_centers *centers, double error);

/// The rounding radii of both bodies, by which that is above the signed distance.
double balls_compute_radii(const pair_frame *frame);

/// The centres of a sound proof of kind BALLS.
ball_centers balls_find_centers(const pair_frame *frame, const ovoid_proof *proof);

/// The upper bound of d that a sound proof of kind BALLS shows.
double balls_compute_upper(const pair_frame *frame, const ovoid_proof *proof, double error);

/// The witness points of such a proof: of each ball the point toward the other body.
witness_points balls_compute_points(const pair_frame *frame, const ovoid_proof *proof);

#endif
