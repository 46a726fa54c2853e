// The last step of all fits of an ellipsoid inside a polytope: rounding and the proof.
#ifndef OVOID_ELLIPSOID_SHRINK_TO_FIT_H
#define OVOID_ELLIPSOID_SHRINK_TO_FIT_H

#include "ellipsoid/factor.h"
#include "ovoid/ellipsoid.h"

/// An ellipsoid of doubles for which ellipsoid_is_enclosed holds: the candidate, shrunk as little as the proof needs.
/// If the candidate is too thin to be stored and proven, its long axes are shortened; if that fails too, the result is
/// a vertex (Q zero). Flat bodies: the candidate is only rounded, and nothing is proven.
ovoid_ellipsoid ellipsoid_shrink_to_fit(const ovoid_polytope *polytope, ovoid_vec3 center, const sym3dd *q);

/// Volume, area or length of an ellipsoid of rank 3, 2 or 1.
double ellipsoid_compute_measure(const ovoid_ellipsoid *ellipsoid, uint32_t rank);

#endif
