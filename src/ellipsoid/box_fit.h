// Both ellipsoids of a box in closed form (polytope/centered_box.h).
#ifndef OVOID_ELLIPSOID_BOX_FIT_H
#define OVOID_ELLIPSOID_BOX_FIT_H

#include "ovoid/ellipsoid.h"

/// 1 and the smallest ellipsoid around the polytope, to 2^-45 of its volume, if the polytope is such a box.
int box_fit_outer(const ovoid_polytope *polytope, double gap, ovoid_fit *fit);
/// 1 and the largest ellipsoid inside the polytope, to 2^-45 of its volume, if the polytope is such a box.
int box_fit_inner(const ovoid_polytope *polytope, double gap, ovoid_fit *fit);

/// 1 if the ellipsoid lies in the polytope because the polytope is such a box, the centre is its centre, the axes are
/// its axes, and no radius exceeds a half size: exact. 0 proves nothing.
int box_fit_is_enclosed(const ovoid_polytope *polytope, const ovoid_ellipsoid *ellipsoid);

#endif
