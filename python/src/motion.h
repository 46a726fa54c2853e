// Motions, and the bodies that make them.
#ifndef OVOID_PYTHON_MOTION_H
#define OVOID_PYTHON_MOTION_H

#include "src/module.h"

#include <ovoid/body_impact.h>

/// A motion, with the arrays of a path; immutable.
typedef struct motion_object {
    PyObject_HEAD ovoid_motion motion;
    double *times;
    ovoid_pose *poses;
} motion_object;

/// An impact or an approach, with its steps and what it is about. Approaches are of shapes alone.
typedef struct impact_object {
    PyObject_HEAD ovoid_body_impact of;
    ovoid_approach approach;
    PyObject *a, *b, *motion_a, *motion_b;
    double margin;
    ovoid_motion_options options; ///< as asked; where the proof went is not kept
    ovoid_step *steps;
    ovoid_step_group *groups;
} impact_object;
/// An empty one, an Impact or an Approach by the type.
impact_object *impact_make(PyTypeObject *type, PyObject *a, PyObject *b, PyObject *motion_a, PyObject *motion_b);
/// How many steps it has: of compounds and solids those of all groups.
size_t impact_count_steps(const impact_object *self);

/// A Motion, or anything that is a pose: then it stands still. A new reference.
PyObject *motion_read(module_state *state, PyObject *from, const char *what);
PyObject *motion_wrap(module_state *state, ovoid_motion motion);
/// A Motion of a path's arrays too, which it takes over (of others NULL); refused motions raise.
PyObject *motion_wrap_arrays(module_state *state, ovoid_motion motion, double *times, ovoid_pose *poses);

#endif
