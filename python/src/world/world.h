// A world and what it keeps alive.
#ifndef OVOID_PYTHON_WORLD_WORLD_H
#define OVOID_PYTHON_WORLD_WORLD_H

#include "src/query.h"

typedef struct world_object {
    PyObject_HEAD ovoid_world *world;
    ovoid_world_options options; ///< it was made with; of those that Python gives
    ovoid_options asked;         ///< the options of the last contacts
    PyObject *kept;              ///< a dict: the Shape, Compound or Solid of each id
    int readers, is_written;     ///< calls that run without the interpreter's lock
} world_object;

/// Every call of a world is between these: 0, or -1 with RuntimeError where another thread's call is in the way.
int world_enter(world_object *self, int is_writing);
void world_leave(world_object *self, int is_writing);

/// 32 bits of a group or a mask, as a converter of PyArg_ParseTuple.
int bits_read(PyObject *from, void *to);
/// Raises Error where there is a cap, which the margin of that method is.
int cap_refuse(module_state *state, const query_keywords *k, const char *method);
/// A Shape, Compound or Solid at a pose as a body of a world.
int probe_read(module_state *state, PyObject *body, PyObject *pose, ovoid_world_body *to);
/// What a query that found hits was asked with.
typedef struct hits_query {
    PyObject *probes;              ///< the tuple of querying bodies that are not in the world; NULL: none
    const ovoid_world_body *posed; ///< how these are posed
    const ovoid_options *options;  ///< NULL: the default
} hits_query;
/// The Hit of a query.
PyObject *hit_make(world_object *self, const ovoid_world_hit *hit, const hits_query *query);
/// The body of an id, a new reference, and its pose.
int world_find(world_object *self, ovoid_id id, PyObject **body, ovoid_pose *pose);

#endif
