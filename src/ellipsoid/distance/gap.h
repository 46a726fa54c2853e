// The functions that all proximity functions of ellipsoids use: the proven gap of two supports, and scaling of a pair.
#ifndef OVOID_ELLIPSOID_DISTANCE_GAP_H
#define OVOID_ELLIPSOID_DISTANCE_GAP_H

#include "linear/mat3.h"
#include "ovoid/ellipsoid.h"

/// Never more than the gap of the supports, min over b of n.x - max over a of n.x, for the exact unit vector along n;
/// so never more than the distance. n must be unit to rounding (or zero: the answer is minus infinity).
double ellipsoids_compute_gap(const ovoid_ellipsoid *a, const ovoid_ellipsoid *b, vec3 n);

/// sqrt(n' Q n), zero where rounding makes the form negative.
static inline double sym3_spread(sym3 q, vec3 n) { return sqrt(fmax(0, sym3_quadratic(q, n))); }

/// Two ellipsoids relative to the centre of the first, in units of a power of two near the pair's size: everything is
/// of order one, so that no product over- or underflows and no constant has a length. d = (cb - ca) / unit.
typedef struct scaled_pair {
    vec3 d;
    sym3 qa, qb;
    double unit;
} scaled_pair;

/// Scales a pair.
scaled_pair ellipsoids_make_scaled(const ovoid_ellipsoid *a, const ovoid_ellipsoid *b);

/// ovoid_ellipsoid_is_overlapping, for callers that have set up the floating-point environment.
int ellipsoids_are_overlapping(const ovoid_ellipsoid *a, const ovoid_ellipsoid *b, ovoid_vec3 *point);

#endif
