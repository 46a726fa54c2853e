// The last step of all fits of an ellipsoid inside a polytope: rounding and the proof.
#ifndef OVOID_ELLIPSOID_SHRINK_TO_FIT_H
#define OVOID_ELLIPSOID_SHRINK_TO_FIT_H

#include "ellipsoid/factor.h"
#include "ovoid/ellipsoid.h"

/// An ellipsoid of doubles for which ellipsoid_is_enclosed holds: the candidate, shrunk as little as the proof needs.
/// Where the candidate is too thin to be stored and proven, its long axes are shortened; where that fails too, the
/// result is a vertex (Q zero). Flat bodies: the candidate rounded, nothing proven.
ovoid_ellipsoid ellipsoid_shrink_to_fit(const ovoid_polytope *polytope, ovoid_vec3 center, const sym3dd *q);

/// Volume, area or length, by the rank.
double ellipsoid_compute_measure(const ovoid_ellipsoid *ellipsoid, uint32_t rank);

#endif
