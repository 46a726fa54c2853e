// The contacts of a World's step, with their points, and the materials of its bodies.
#include "src/manifold/manifold.h"
#include "src/world/world.h"

// The arrays of a step belong to the world until its next call: copies.
static PyObject *copy_manifolds(module_state *state, const ovoid_world_manifolds *m) {
    const Py_ssize_t count = (Py_ssize_t)m->count, parts = (Py_ssize_t)m->part_count,
                     ended = (Py_ssize_t)m->ended_count;
    PyObject *made[5] = {array_copy(state, RECORD_WORLD_MANIFOLD, 1, &count, m->items),
                         array_copy(state, RECORD_BODY_MANIFOLD, 1, &parts, m->parts),
                         manifold_points_copy(state, m->points, m->part_count),
                         manifold_grown_copy(state, m->points, m->part_count),
                         array_copy(state, RECORD_PARTING, 1, &ended, m->ended)};
    int failed = 0;
    for (int i = 0; i < 5; i++) failed |= !made[i];
    if (!failed)
        return PyObject_CallFunction(state->world_manifolds, "NNNNNnn", made[0], made[1], made[2], made[3], made[4],
                                     (Py_ssize_t)m->begun, (Py_ssize_t)m->kept);
    for (int i = 0; i < 5; i++) Py_XDECREF(made[i]);
    return NULL;
}

static PyObject *manifolds(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {MANIFOLD_NAMES, "ahead", NULL};
    world_object *self = (world_object *)object;
    module_state *state = state_of(object);
    ovoid_world_manifold_query query = {.ahead = 0};
    ovoid_world_manifolds found;
    ovoid_error error;
    ovoid_code code;
    if (!arguments_read(arguments, keywords, "|$" MANIFOLD_FORMAT "d:manifolds", names, MANIFOLD_TARGETS(query.options),
                        &query.ahead) ||
        world_enter(self, 1))
        return NULL;
    Py_BEGIN_ALLOW_THREADS;
    code = ovoid_world_compute_manifolds(self->world, &query, &found, &error);
    Py_END_ALLOW_THREADS;
    PyObject *made = code == OVOID_OK ? copy_manifolds(state, &found) : raise_error(state, &error);
    world_leave(self, 1);
    return made;
}

static PyObject *set_material(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"id", "margin", "friction", "restitution", NULL};
    world_object *self = (world_object *)object;
    ovoid_material material = {0};
    ovoid_id id;
    ovoid_error error;
    if (!arguments_read(arguments, keywords, "O&|$ddd:set_material", names, id_read, &id, &material.margin,
                        &material.friction, &material.restitution) ||
        world_enter(self, 1))
        return NULL;
    ovoid_code code = ovoid_world_set_material(self->world, id, &material, &error);
    world_leave(self, 1);
    return none_or_raise(state_of(object), code, &error);
}

static PyObject *material(PyObject *object, PyObject *given) {
    world_object *self = (world_object *)object;
    module_state *state = state_of(object);
    ovoid_material found;
    ovoid_id id;
    ovoid_error error;
    if (!id_read(given, &id) || world_enter(self, 0)) return NULL;
    ovoid_code code = ovoid_world_get_material(self->world, id, &found, &error);
    world_leave(self, 0);
    if (code != OVOID_OK) return raise_error(state, &error);
    return PyObject_CallFunction(state->material, "ddd", found.margin, found.friction, found.restitution);
}

PyMethodDef world_manifold_methods[] = {
    {"manifolds", METHOD_KEYWORDS(manifolds), METH_VARARGS | METH_KEYWORDS,
     "manifolds(*, " MANIFOLD_SIGNATURE
     ", ahead: float = 0) -> WorldManifolds\n--\n\nEnds a step as contacts() does, with "
     "the contacts of all pairs that are not proven farther apart than their margin: a\nWorldManifolds tuple. Each is "
     "found "
     "from that of the last call, and pairs begin, stay and end. The options are those of\nfind_manifold(). ahead: a "
     "body's "
     "margin grows by so many times the way that it went by its last move."},
    {"set_material", METHOD_KEYWORDS(set_material), METH_VARARGS | METH_KEYWORDS,
     "set_material(id: SupportsIndex, *, margin: float = 0, friction: float = 0, restitution: float = 0) -> "
     "None\n--\n\n"
     "What a body brings to its contacts. Of a pair the margins add up, friction is the square root of the product,\n"
     "restitution the larger one; the world uses neither."},
    {"material", material, METH_O,
     "material(id: SupportsIndex, /) -> Material\n--\n\nThe material of a body; zeros if none was set."},
    {NULL, NULL, 0, NULL}};
