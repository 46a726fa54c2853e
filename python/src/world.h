// A world and what it keeps alive.
#ifndef OVOID_PYTHON_WORLD_H
#define OVOID_PYTHON_WORLD_H

#include "src/query.h"

typedef struct world_object {
    PyObject_HEAD ovoid_world *world;
    PyObject *kept;          ///< a dict: the Shape, Compound or Solid of each id
    int readers, is_written; ///< calls that run without the interpreter's lock
} world_object;

/// Every call of a world is between these: 0, or -1 with RuntimeError where another thread's call is in the way.
int world_enter(world_object *self, int is_writing);
void world_leave(world_object *self, int is_writing);

/// A Shape, Compound or Solid at a pose as a body of a world.
int probe_read(module_state *state, PyObject *body, PyObject *pose, ovoid_world_body *to);
/// The Hit of a query; probes: the tuple of querying bodies that are not in the world, and how they are posed; NULL:
/// none.
PyObject *hit_make(world_object *self, const ovoid_world_hit *hit, PyObject *probes, const ovoid_world_body *posed);
/// The body of an id, a new reference, and its pose.
int world_find(world_object *self, ovoid_id id, PyObject **body, ovoid_pose *pose);

#endif
