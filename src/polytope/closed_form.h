// Bodies whose hull, measures and ellipsoids are written down in place of being searched for: boxes, regular prisms,
// regular pyramids and the polyhedra of ellipsoids. They are recognised by their vertices.
#ifndef OVOID_POLYTOPE_CLOSED_FORM_H
#define OVOID_POLYTOPE_CLOSED_FORM_H

#include "ovoid/polytope.h"
#include "polytope/ellipsoid_grid.h"
#include "polytope/regular_solid.h"

typedef enum form_kind { FORM_NONE, FORM_BOX, FORM_REGULAR, FORM_ELLIPSOID } form_kind;

typedef struct closed_form {
    form_kind kind;
    ovoid_vec3 half;     ///< of a box (centered_box.h)
    regular_solid solid; ///< of a prism or pyramid
    ellipsoid_grid grid; ///< of an ellipsoid
} closed_form;

/// Writes a triangle of a form, and returns the place of the next one.
static inline uint32_t *closed_form_put_triangle(uint32_t *to, uint32_t a, uint32_t b, uint32_t c) {
    to[0] = a, to[1] = b, to[2] = c;
    return to + 3;
}

/// The form of vertices; FORM_NONE for most. Cost: a few tests for most bodies, else linear.
closed_form closed_form_find(const double *vertices, size_t count);

/// The measures that the form has. The polytope's vertices alone are read.
ovoid_measures closed_form_compute_measures(const closed_form *form, const ovoid_polytope *polytope);

#endif
