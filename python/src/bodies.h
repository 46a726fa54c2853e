// Many posed bodies in one object.
#ifndef OVOID_PYTHON_BODIES_H
#define OVOID_PYTHON_BODIES_H

#include "src/query.h"

typedef struct bodies_object {
    PyObject_HEAD ovoid_posed_shape *items; ///< Shapes; NULL where some are of another kind
    ovoid_body *others;                     ///< all of them, where some are Compounds or Solids; else NULL
    Py_ssize_t count;
    PyObject *shapes; ///< a tuple: keeps them
    int has_solids;
    int users; ///< batches that run; read and written under the interpreter's lock
} bodies_object;

// ---- batch_bodies.c

/// A query of many couples of bodies of any kind; what is written for one has the same bits beside any others.
typedef struct bodies_query {
    query_name name;
    double margin;
    const ovoid_options *options;
    const ovoid_body *bodies;
    size_t body_count;
} bodies_query;
/// Answers couples: OVOID_OK, or INDEX, with nothing written. witnesses: as many, or NULL.
ovoid_code bodies_ask(const bodies_query *q, const ovoid_couple *couples, size_t count, ovoid_verdict *verdicts,
                      ovoid_witness *witnesses);

#endif
