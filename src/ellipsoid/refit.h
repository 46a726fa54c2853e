// Ellipsoids of a body that is nearly another one, whose ellipsoids are known: deformed, or cut.
#ifndef OVOID_ELLIPSOID_REFIT_H
#define OVOID_ELLIPSOID_REFIT_H

#include "ovoid/ellipsoid.h"

/// Where to start: the outer and inner ellipsoid of a body near by, in the body frame of the one that is asked for.
typedef struct fit_start {
    ovoid_ellipsoid outer, inner;
} fit_start;

/// As ovoid_ellipsoid_compute_outer and _inner, started from there; NULL: from nothing. The same promises hold, and
/// about the same ellipsoid comes out. The public functions' arguments are checked already.
ovoid_code ellipsoid_refit_outer(const ovoid_polytope *polytope, double gap, const fit_start *start, ovoid_fit *fit,
                                 const ovoid_allocator *allocator);
ovoid_code ellipsoid_refit_inner(const ovoid_polytope *polytope, double gap, const fit_start *start, ovoid_fit *fit,
                                 const ovoid_allocator *allocator);

#endif
