// A prepared shape and what it keeps alive.
#ifndef OVOID_PYTHON_PREPARED_H
#define OVOID_PYTHON_PREPARED_H

#include "src/module.h"

#include <ovoid/prepared.h>

typedef struct prepared_object {
    PyObject_HEAD ovoid_prepared_shape of;
    PyObject *shape;
} prepared_object;

#endif
