// The last step of everything that returns an ellipsoid inside a polytope: rounding and the proof.
#ifndef OVOID_ELLIPSOID_SEAL_H
#define OVOID_ELLIPSOID_SEAL_H

#include "ellipsoid/factor.h"
#include "ovoid/ellipsoid.h"

/// An ellipsoid of doubles for which ellipsoid_is_enclosed holds: the candidate, shrunk as little as the proof needs.
/// Where the candidate is too thin to be stored and proven, its long axes are shortened; where nothing else helps, the
/// result is a vertex (Q zero). Flat bodies: the candidate rounded, nothing proven.
ovoid_ellipsoid ellipsoid_compute_sealed(const ovoid_polytope *polytope, ovoid_vec3 center, const sym3dd *q);

/// Volume, area or length, by the rank.
double ellipsoid_compute_measure(const ovoid_ellipsoid *ellipsoid, uint32_t rank);

#endif
