// Ellipsoids of a body, for callers that have set up the floating-point environment.
#ifndef OVOID_ELLIPSOID_FIT_H
#define OVOID_ELLIPSOID_FIT_H

#include "base/error.h"
#include "ovoid/ellipsoid.h"

typedef struct fit_options {
    double gap;                       ///< relative volume gap to reach; 0 means 1e-6
    const ovoid_measures *measures;   ///< of the polytope; NULL: computed where they are needed
    const ovoid_allocator *allocator; ///< NULL: malloc
} fit_options;

/// ovoid_ellipsoid_compute_outer and _inner.
ovoid_code ellipsoid_fit_outer(const ovoid_polytope *polytope, const fit_options *options, ovoid_fit *fit);
ovoid_code ellipsoid_fit_inner(const ovoid_polytope *polytope, const fit_options *options, ovoid_fit *fit);

/// The code of a fit, with its sentence in *error.
static inline ovoid_code fit_explain(ovoid_code code, ovoid_error *error) {
    if (code == OVOID_ERROR_ARGUMENT)
        error_write(error, code, -1, "no polytope, no vertices, no room for the fit, or a gap below 0");
    else if (code != OVOID_OK)
        error_write(error, code, -1, "no memory for the fit of an ellipsoid");
    return code;
}

#endif
