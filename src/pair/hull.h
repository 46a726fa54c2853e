// A few points that strictly contain the origin: the proof of an overlap.
#ifndef OVOID_PAIR_HULL_H
#define OVOID_PAIR_HULL_H

#include "linear/vec3.h"

/// A proven lower bound of the distance of the origin to the surface of 4 points (a tetrahedron) or of 5 or 6 (a double
/// pyramid with the tips 0 and 1 over the ring 2, 3, ...) that winds around it, when each coordinate may be off by
/// `error`; 0 if none is proven.
double hull_compute_depth(const vec3 *w, int count, double error);

/// hull_compute_depth, and weights of the origin, which are valid only if the depth is above 0: the weighted corners
/// are off the origin by no more than `error`, or by the roundings of their sum.
double hull_find_weights(const vec3 *w, int count, double error, double *weight);

/// The depth from the distance of the surface's triangles alone: costlier than hull_compute_depth, and better if the
/// tetrahedron is thin. The greater of both bounds is never below the bound for a larger error.
double hull_compute_clearance(const vec3 *w, int count, double error);

#endif
