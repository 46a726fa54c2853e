// Motions, and the bodies that make them.
#ifndef OVOID_PYTHON_MOTION_H
#define OVOID_PYTHON_MOTION_H

#include "src/module.h"

/// A motion, with the arrays of a path; immutable.
typedef struct motion_object {
    PyObject_HEAD ovoid_motion motion;
    double *times;
    ovoid_pose *poses;
} motion_object;

/// A Motion, or anything that is a pose: then it stands still. A new reference.
PyObject *motion_read(module_state *state, PyObject *from, const char *what);
PyObject *motion_wrap(module_state *state, ovoid_motion motion);

#endif
