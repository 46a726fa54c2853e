// Ellipsoids of a body, for callers that have set up the floating-point environment.
#ifndef OVOID_ELLIPSOID_FIT_H
#define OVOID_ELLIPSOID_FIT_H

#include "base/error.h"
#include "ovoid/ellipsoid.h"
#include "polytope/closed_form.h"

typedef struct fit_options {
    double gap;                       ///< relative volume gap to reach; 0 means 1e-6
    const ovoid_measures *measures;   ///< of a hull's polytope, with its exact triangles; NULL: computed where needed
    const ovoid_allocator *allocator; ///< NULL: malloc
    const closed_form *form;          ///< of the polytope; NULL: found where it is needed
} fit_options;

/// The polytope's closed form, that of the options if they have one.
static inline closed_form fit_find_form(const fit_options *options, const ovoid_polytope *polytope) {
    if (options->form) return *options->form;
    if (polytope->rank < 3) return (closed_form){.kind = FORM_NONE};
    return closed_form_find(polytope->vertices, polytope->vertex_count);
}

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

/// The ellipsoid of the first and second moments of a solid, whose triangles are exactly those of its hull, scaled
/// until it is proven to be inside, in doubles; its gap is not known. 0 if that fails. Cost: a pass over the triangles,
/// a twentieth of ellipsoid_fit_inner of few vertices.
int ellipsoid_fit_moments(const ovoid_polytope *polytope, const ovoid_measures *measures, ovoid_fit *fit);

#endif
