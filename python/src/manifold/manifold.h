// Manifold: the contact of two bodies, or of two of their parts, with what it takes to check it.
#ifndef OVOID_PYTHON_MANIFOLD_H
#define OVOID_PYTHON_MANIFOLD_H

#include "src/module.h"

typedef struct manifold_object {
    PyObject_HEAD ovoid_body_manifold of;
    PyObject *a, *b; ///< shapes or compounds
    ovoid_pose pose_a, pose_b;
    ovoid_manifold_options options; ///< of the query; no pointers
    ovoid_manifold_points points;
    kept_cover *cover; ///< of the last search; NULL: none
} manifold_object;

/// A manifold of two bodies at the poses of the pair, all zero.
manifold_object *manifold_make(module_state *state, PyObject *a, PyObject *b, const ovoid_body_pair *pair);
/// Computes its points; 0 where it is no manifold of its bodies.
int manifold_set_points(manifold_object *self);
/// Verifies it without a search: OVOID_OK, or what ovoid_body_manifold_verify says.
ovoid_code manifold_verify(const manifold_object *self, ovoid_error *error);

/// The options of manifolds, as arguments of arguments_read.
#define MANIFOLD_FORMAT "dddd"
#define MANIFOLD_NAMES "margin", "tolerance", "keep", "angle"
#define MANIFOLD_TARGETS(o) &(o).margin, &(o).tolerance, &(o).keep, &(o).angle
#define MANIFOLD_SIGNATURE "margin: float = 0, tolerance: float = 0, keep: float = 0, angle: float = 0"

/// Many manifolds' points as an array (n, 4) of records, and as an array what each is grown by.
PyObject *manifold_points_copy(module_state *state, const ovoid_manifold_points *points, size_t count);
PyObject *manifold_grown_copy(module_state *state, const ovoid_manifold_points *points, size_t count);

#endif
