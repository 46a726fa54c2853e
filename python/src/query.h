// A query of two bodies as it was asked: what query.c reads of the arguments, for shapes, compounds and solids.
#ifndef OVOID_PYTHON_QUERY_H
#define OVOID_PYTHON_QUERY_H

#include "src/module.h"

typedef enum query_name { QUERY_COLLIDE, QUERY_WITHIN, QUERY_DISTANCE, QUERY_DEPTH } query_name;

typedef struct query_input {
    query_name name;
    PyObject *a, *b;
    ovoid_body_pair pair;
    const ovoid_prepared_shape *prepared_a, *prepared_b; ///< both or none
    double margin;
    ovoid_options options;
    ovoid_body_proof earlier;
    int has_earlier;
    const kept_cover *cover; ///< of an earlier Answer; NULL: none
} query_input;

/// The Answer to the query.
PyObject *query_answer(module_state *state, const query_input *in);
/// The Answer to two bodies at the poses of the pair, asked for their distance, or where the margin is at least 0
/// whether they are within it. earlier: of this pair, or NULL.
PyObject *query_ask(module_state *state, PyObject *a, PyObject *b, const ovoid_body_pair *pair, double margin,
                    const ovoid_body_proof *earlier);

// ---- solid.c

typedef struct solid_object {
    PyObject_HEAD ovoid_solid *solid;
    PyObject *owner; ///< that the solid belongs to; NULL: this object
} solid_object;

/// A Solid of a file that the owner keeps.
PyObject *solid_borrow(module_state *state, const ovoid_solid *solid, PyObject *owner);

#endif
