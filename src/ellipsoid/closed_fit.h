// Both ellipsoids of a body in closed form (polytope/closed_form.h).
#ifndef OVOID_ELLIPSOID_CLOSED_FIT_H
#define OVOID_ELLIPSOID_CLOSED_FIT_H

#include "ovoid/ellipsoid.h"
#include "polytope/closed_form.h"

/// 1 and the smallest ellipsoid around the body, if there is a form and its gap is not above the one to reach. The gap
/// is 2^-45 for a box, and 2^-39 for each side more for a prism or pyramid.
int closed_fit_outer(const closed_form *form, double gap, ovoid_fit *fit);
/// 1 and the largest ellipsoid inside the body.
int closed_fit_inner(const closed_form *form, double gap, ovoid_fit *fit);

/// 1 if the ellipsoid is proven to lie in the body of that form: it is upright around the body's centre, or a pyramid's
/// axis at that of the largest, and no radius exceeds the largest one's by rounding. 0 proves nothing.
int closed_fit_is_enclosed(const closed_form *form, const ovoid_ellipsoid *ellipsoid);

#endif
