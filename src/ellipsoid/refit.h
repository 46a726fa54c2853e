// Ellipsoids of a body, from scratch or from those of a body that differs little: one that was deformed or cut.
#ifndef OVOID_ELLIPSOID_REFIT_H
#define OVOID_ELLIPSOID_REFIT_H

#include "base/error.h"
#include "ovoid/ellipsoid.h"

/// Where to start: the outer and inner ellipsoid of the body that differs little, in the body frame of the one to fit.
typedef struct fit_start {
    ovoid_ellipsoid outer, inner;
} fit_start;

typedef struct fit_options {
    double gap;                       ///< relative volume gap to reach; 0 means 1e-6
    const fit_start *start;           ///< NULL: from scratch
    const ovoid_allocator *allocator; ///< NULL: malloc
} fit_options;

/// ovoid_ellipsoid_compute_outer and _inner, for callers that have set up the floating-point environment. A start
/// changes the cost; the same promises hold, and about the same ellipsoid is found.
ovoid_code ellipsoid_refit_outer(const ovoid_polytope *polytope, const fit_options *options, ovoid_fit *fit);
ovoid_code ellipsoid_refit_inner(const ovoid_polytope *polytope, const fit_options *options, ovoid_fit *fit);

/// The code of a fit, with its sentence in *error.
static inline ovoid_code fit_explain(ovoid_code code, ovoid_error *error) {
    if (code == OVOID_ERROR_ARGUMENT)
        error_write(error, code, -1, "no polytope, no vertices, no room for the fit, or a gap below 0");
    else if (code != OVOID_OK)
        error_write(error, code, -1, "no memory for the fit of an ellipsoid");
    return code;
}

#endif
