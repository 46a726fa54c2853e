// Many posed shapes in one object.
#ifndef OVOID_PYTHON_BODIES_H
#define OVOID_PYTHON_BODIES_H

#include "src/module.h"

typedef struct bodies_object {
    PyObject_HEAD ovoid_posed_shape *items;
    Py_ssize_t count;
    PyObject *shapes; ///< a tuple: keeps them
    int users;        ///< batches that run; read and written under the interpreter's lock
} bodies_object;

#endif
