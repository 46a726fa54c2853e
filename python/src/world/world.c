// World: many bodies that move, and the contacts of each step. It keeps its shapes alive.
//
// The library wants exclusive access for what changes a world; so a call that finds another thread's in the way raises
// RuntimeError and does nothing.
#include "src/world/world.h"

#include <stdlib.h>
#include <string.h>

int world_enter(world_object *self, int is_writing) {
    if (self->is_written || (is_writing && self->readers)) {
        PyErr_SetString(PyExc_RuntimeError, "another thread is using this world");
        return -1;
    }
    if (is_writing)
        self->is_written = 1;
    else
        self->readers++;
    return 0;
}

void world_leave(world_object *self, int is_writing) {
    if (is_writing)
        self->is_written = 0;
    else
        self->readers--;
}

int probe_read(module_state *state, PyObject *body, PyObject *pose, ovoid_world_body *to) {
    return body_read(state, body, "body", &to->body) || pose_read(state, pose, "pose", &to->body.pose) ? -1 : 0;
}

int id_read(PyObject *from, void *to) {
    PyObject *index = PyNumber_Index(from);
    *(ovoid_id *)to = index ? PyLong_AsUnsignedLongLong(index) : 0;
    Py_XDECREF(index);
    if (!PyErr_Occurred()) return 1;
    PyErr_Clear();
    PyErr_Format(PyExc_TypeError, "an id of this world is wanted, not %R", from);
    return 0;
}

int bits_read(PyObject *from, void *to) {
    long long bits = PyLong_AsLongLong(from);
    if (bits == -1 && PyErr_Occurred() && !PyErr_ExceptionMatches(PyExc_OverflowError)) return 0;
    *(uint32_t *)to = (uint32_t)bits;
    if (!PyErr_Occurred() && bits >= INT32_MIN && bits <= UINT32_MAX) return 1;
    PyErr_Clear();
    PyErr_Format(PyExc_ValueError, "group and mask have 32 bits: 0 to 2^32 - 1 is wanted, or -1 for all, not %R", from);
    return 0;
}

int cap_refuse(module_state *state, const query_keywords *k, const char *method) {
    if (!(k->options.cap > 0)) return 0;
    raise_code(state, OVOID_ERROR_ARGUMENT, -1, "cap: the margin is the cap of %s(): give margin= alone", method);
    return -1;
}

// ---- making and ending

static PyObject *world_new(PyTypeObject *type, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"threads", "enlargement", NULL};
    int threads = 1;
    ovoid_world_options options = {0};
    ovoid_error error;
    module_state *state = state_of_type((PyObject *)type);
    if (!arguments_read(arguments, keywords, "|$id:World", names, &threads, &options.enlargement)) return NULL;
    if (threads < 1 || threads > (int)OVOID_WORLD_THREADS_MAX)
        return raise_code(state, OVOID_ERROR_ARGUMENT, -1, "threads: 1 to %d are wanted, not %d",
                          (int)OVOID_WORLD_THREADS_MAX, threads);
    options.threads = (uint32_t)threads;
    world_object *self = object_make(type);
    if (!self) return NULL;
    self->options = options;
    self->kept = PyDict_New();
    self->world = self->kept ? ovoid_world_create(&options, &error) : NULL;
    if (self->world) return (PyObject *)self;
    if (self->kept) raise_error(state, &error);
    Py_DECREF((PyObject *)self);
    return NULL;
}

static void world_dealloc(PyObject *object) {
    world_object *self = (world_object *)object;
    ovoid_world_destroy(self->world);
    Py_XDECREF(self->kept);
    object_free(object);
}

// ---- adding and removing

static int keep(world_object *self, ovoid_id id, PyObject *body) {
    PyObject *key = PyLong_FromUnsignedLongLong(id);
    int result = key ? PyDict_SetItem(self->kept, key, body) : -1;
    Py_XDECREF(key);
    if (result) ovoid_world_remove(self->world, id, NULL);
    return result;
}

static void forget(world_object *self, ovoid_id id) {
    PyObject *key = PyLong_FromUnsignedLongLong(id);
    if (!key || PyDict_DelItem(self->kept, key)) PyErr_Clear();
    Py_XDECREF(key);
}

static PyObject *add(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"body", "pose", "group", "mask", "user", NULL};
    world_object *self = (world_object *)object;
    module_state *state = state_of(object);
    PyObject *body, *pose = NULL, *user = NULL;
    ovoid_world_body made = {0};
    ovoid_error error;
    if (!arguments_read(arguments, keywords, "O|O$O&O&O!:add", names, &body, &pose, bits_read, &made.groups.group,
                        bits_read, &made.groups.mask, &PyLong_Type, &user) ||
        probe_read(state, body, pose, &made))
        return NULL;
    made.user = user ? PyLong_AsUnsignedLongLong(user) : 0;
    if ((made.user == UINT64_MAX && PyErr_Occurred()) || world_enter(self, 1)) return NULL;
    ovoid_id id = ovoid_world_add(self->world, &made, &error);
    world_leave(self, 1);
    if (!id) return raise_error(state, &error);
    return keep(self, id, body) ? NULL : PyLong_FromUnsignedLongLong(id);
}

// Many bodies from a tuple of them and their poses; the caller frees what it gets.
static ovoid_world_body *read_many(module_state *state, PyObject *bodies, const ovoid_pose *poses, uint32_t group,
                                   uint32_t mask) {
    Py_ssize_t count = PyTuple_Size(bodies);
    ovoid_world_body *made = calloc((size_t)count + 1, sizeof *made);
    if (!made) return (ovoid_world_body *)PyErr_NoMemory();
    for (Py_ssize_t i = 0; i < count; i++) {
        char what[32];
        PyOS_snprintf(what, sizeof what, "body %zd", i);
        if (body_read(state, PyTuple_GetItem(bodies, i), what, &made[i].body)) {
            free(made);
            return NULL;
        }
        made[i].body.pose = poses[i];
        made[i].groups.group = group;
        made[i].groups.mask = mask;
    }
    return made;
}

static PyObject *add_all(world_object *self, PyObject *bodies, ovoid_world_body *made) {
    module_state *state = state_of((PyObject *)self);
    Py_ssize_t count = PyTuple_Size(bodies), kept = 0;
    ovoid_id *ids;
    ovoid_error error;
    PyObject *array = array_make(state, RECORD_UINT64, 1, &count, &ids);
    if (!array) return NULL;
    ovoid_code code = ovoid_world_add_many(self->world, &(ovoid_world_additions){made, (size_t)count, ids}, &error);
    if (code != OVOID_OK) {
        Py_DECREF(array);
        return raise_error(state, &error);
    }
    while (kept < count && !keep(self, ids[kept], PyTuple_GetItem(bodies, kept))) kept++;
    if (kept == count) return array_wrap(state, array);
    for (Py_ssize_t i = kept + 1; i < count; i++) ovoid_world_remove(self->world, ids[i], NULL);
    Py_DECREF(array);
    return NULL;
}

static PyObject *add_many(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"bodies", "poses", "order", "group", "mask", NULL};
    world_object *self = (world_object *)object;
    module_state *state = state_of(object);
    PyObject *given, *given_poses, *ids = NULL;
    const char *order = NULL;
    uint32_t group = 0, mask = 0;
    ovoid_pose *poses;
    Py_ssize_t count;
    if (!arguments_read(arguments, keywords, "OO|$zO&O&:add_many", names, &given, &given_poses, &order, bits_read,
                        &group, bits_read, &mask) ||
        poses_read(state, given_poses, order, &poses, &count))
        return NULL;
    PyObject *bodies = PySequence_Tuple(given);
    if (bodies && PyTuple_Size(bodies) != count)
        raise_code(state, OVOID_ERROR_ARGUMENT, -1, "poses: %zd bodies need as many, not %zd", PyTuple_Size(bodies),
                   count);
    ovoid_world_body *made =
        bodies && PyTuple_Size(bodies) == count ? read_many(state, bodies, poses, group, mask) : NULL;
    if (made && !world_enter(self, 1)) {
        ids = add_all(self, bodies, made);
        world_leave(self, 1);
    }
    free(made);
    free(poses);
    Py_XDECREF(bodies);
    return ids;
}

static PyObject *remove_one(PyObject *object, PyObject *given) {
    world_object *self = (world_object *)object;
    ovoid_id id;
    ovoid_error error;
    if (!id_read(given, &id) || world_enter(self, 1)) return NULL;
    ovoid_code code = ovoid_world_remove(self->world, id, &error);
    world_leave(self, 1);
    if (code != OVOID_OK) return raise_error(state_of(object), &error);
    forget(self, id);
    Py_RETURN_NONE;
}

static PyObject *remove_many(PyObject *object, PyObject *given) {
    world_object *self = (world_object *)object;
    module_state *state = state_of(object);
    items ids;
    ovoid_error error;
    if (items_read(state, given, "ids", 1, (Py_ssize_t[]){-1}, 'q', &ids)) return NULL;
    ovoid_code code = OVOID_ERROR_ARGUMENT;
    int is_entered = !world_enter(self, 1);
    if (is_entered) {
        code = ovoid_world_remove_many(self->world, ids.data, (size_t)ids.shape[0], &error);
        world_leave(self, 1);
        if (code != OVOID_OK) raise_error(state, &error);
    }
    for (Py_ssize_t i = 0; code == OVOID_OK && i < ids.shape[0]; i++) forget(self, ((ovoid_id *)ids.data)[i]);
    free(ids.data);
    return code == OVOID_OK ? Py_NewRef(Py_None) : NULL;
}

// ---- moving

static PyObject *move(PyObject *object, PyObject *arguments) {
    world_object *self = (world_object *)object;
    module_state *state = state_of(object);
    ovoid_id id;
    PyObject *given;
    ovoid_pose pose;
    ovoid_error error;
    if (!PyArg_ParseTuple(arguments, "O&O:move", id_read, &id, &given) || pose_read(state, given, "pose", &pose) ||
        world_enter(self, 1))
        return NULL;
    ovoid_code code = ovoid_world_move(self->world, id, &pose, &error);
    world_leave(self, 1);
    return none_or_raise(state, code, &error);
}

static PyObject *move_many(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"ids", "poses", "order", NULL};
    world_object *self = (world_object *)object;
    module_state *state = state_of(object);
    PyObject *given, *given_poses;
    const char *order = NULL;
    items ids;
    ovoid_pose *poses;
    Py_ssize_t count;
    ovoid_error error = {.code = OVOID_OK};
    if (!arguments_read(arguments, keywords, "OO|$z:move_many", names, &given, &given_poses, &order) ||
        poses_read(state, given_poses, order, &poses, &count))
        return NULL;
    int failed = items_read(state, given, "ids", 1, &count, 'q', &ids) || world_enter(self, 1);
    if (!failed) {
        Py_BEGIN_ALLOW_THREADS;
        ovoid_world_move_many(self->world, &(ovoid_world_moves){ids.data, poses, (size_t)count}, &error);
        Py_END_ALLOW_THREADS;
        world_leave(self, 1);
    }
    free(ids.data);
    free(poses);
    if (failed) return NULL;
    if (error.code != OVOID_OK) return raise_error(state, &error);
    Py_RETURN_NONE;
}

// ---- what is there

static int get_body(world_object *self, ovoid_id id, ovoid_world_body *body) {
    ovoid_error error;
    if (ovoid_world_get(self->world, id, body, &error) == OVOID_OK) return 0;
    raise_error(state_of((PyObject *)self), &error);
    return -1;
}

static PyObject *get_pose(PyObject *object, PyObject *given) {
    world_object *self = (world_object *)object;
    ovoid_id id;
    ovoid_world_body body;
    if (!id_read(given, &id) || world_enter(self, 0)) return NULL;
    int failed = get_body(self, id, &body);
    world_leave(self, 0);
    return failed ? NULL : pose_wrap(state_of(object), body.body.pose);
}

static PyObject *find_kept(world_object *self, ovoid_id id) {
    PyObject *key = PyLong_FromUnsignedLongLong(id);
    PyObject *body = key ? PyObject_GetItem(self->kept, key) : NULL;
    Py_XDECREF(key);
    return body;
}

static PyObject *get_kept(PyObject *object, PyObject *given) {
    world_object *self = (world_object *)object;
    ovoid_id id;
    ovoid_world_body body;
    if (!id_read(given, &id) || world_enter(self, 0)) return NULL;
    int failed = get_body(self, id, &body);
    world_leave(self, 0);
    return failed ? NULL : find_kept(self, id);
}

static PyObject *get_ids(PyObject *object, PyObject *ignored) {
    (void)ignored;
    world_object *self = (world_object *)object;
    if (world_enter(self, 0)) return NULL;
    Py_ssize_t count = (Py_ssize_t)ovoid_world_get_count(self->world);
    ovoid_id *to;
    PyObject *array = array_make(state_of(object), RECORD_UINT64, 1, &count, &to);
    if (array)
        for (ovoid_id id = 0; (id = ovoid_world_find_next(self->world, id));) *to++ = id;
    world_leave(self, 0);
    return array_wrap(state_of(object), array);
}

static Py_ssize_t length(PyObject *object) {
    world_object *self = (world_object *)object;
    if (world_enter(self, 0)) return -1;
    Py_ssize_t count = (Py_ssize_t)ovoid_world_get_count(self->world);
    world_leave(self, 0);
    return count;
}

// ---- which pairs

// For pickle: the options, [(body, pose, group, mask)] in the order of the ids, and the ids.
static PyObject *get_state(PyObject *object, PyObject *ignored) {
    world_object *self = (world_object *)object;
    module_state *state = state_of(object);
    if (world_enter(self, 0)) return NULL;
    PyObject *bodies = PyList_New(0), *ids = get_ids(object, ignored);
    ovoid_world_body body;
    for (ovoid_id id = 0; bodies && (id = ovoid_world_find_next(self->world, id));) {
        if (ovoid_world_get(self->world, id, &body, NULL) != OVOID_OK) break;
        PyObject *kept = find_kept(self, id);
        PyObject *one =
            kept ? Py_BuildValue("NNII", kept, pose_wrap(state, body.body.pose), body.groups.group, body.groups.mask)
                 : NULL;
        if (!one || PyList_Append(bodies, one)) Py_CLEAR(bodies);
        Py_XDECREF(one);
    }
    world_leave(self, 0);
    if (bodies && ids)
        return Py_BuildValue("{s:I,s:d}NN", "threads", self->options.threads, "enlargement", self->options.enlargement,
                             bodies, ids);
    Py_XDECREF(bodies);
    Py_XDECREF(ids);
    return NULL;
}

static PyObject *set_groups(PyObject *object, PyObject *arguments) {
    world_object *self = (world_object *)object;
    ovoid_id id;
    uint32_t group, mask;
    ovoid_error error;
    if (!PyArg_ParseTuple(arguments, "O&O&O&:set_groups", id_read, &id, bits_read, &group, bits_read, &mask) ||
        world_enter(self, 1))
        return NULL;
    ovoid_code code = ovoid_world_set_groups(self->world, id, (ovoid_groups){group, mask}, &error);
    world_leave(self, 1);
    return none_or_raise(state_of(object), code, &error);
}

static PyObject *set_ignored(PyObject *object, PyObject *arguments) {
    world_object *self = (world_object *)object;
    ovoid_id a, b;
    int ignored = 1;
    ovoid_error error;
    if (!PyArg_ParseTuple(arguments, "O&O&|p:set_ignored", id_read, &a, id_read, &b, &ignored) || world_enter(self, 1))
        return NULL;
    ovoid_code code = ignored ? ovoid_world_add_ignored(self->world, a, b, &error)
                              : ovoid_world_remove_ignored(self->world, a, b, &error);
    world_leave(self, 1);
    return none_or_raise(state_of(object), code, &error);
}

static PyObject *is_pair(PyObject *object, PyObject *arguments) {
    world_object *self = (world_object *)object;
    ovoid_id a, b;
    if (!PyArg_ParseTuple(arguments, "O&O&:is_pair", id_read, &a, id_read, &b) || world_enter(self, 0)) return NULL;
    int is = ovoid_world_is_pair(self->world, a, b);
    world_leave(self, 0);
    return PyBool_FromLong(is);
}

// ---- contacts

static int read_kind(module_state *state, const char *name, ovoid_query_kind *kind) {
    static const char *const names[] = {"collide", "within", "distance", "depth"};
    for (int i = 0; i < 4; i++)
        if (!strcmp(name, names[i])) {
            *kind = (ovoid_query_kind)i;
            return 0;
        }
    raise_code(state, OVOID_ERROR_ARGUMENT, -1, "kind: 'collide', 'within', 'distance' or 'depth' is wanted, not '%s'",
               name);
    return -1;
}

// The arrays of a step belong to the world until its next call: copies.
static PyObject *copy_contacts(module_state *state, const ovoid_contacts *c) {
    Py_ssize_t count = (Py_ssize_t)c->count;
    PyObject *found = array_copy(state, RECORD_CONTACT, 1, &count, c->items);
    PyObject *witnesses =
        c->witnesses ? array_copy(state, RECORD_WITNESS, 1, &count, c->witnesses) : Py_NewRef(Py_None);
    if (!found || !witnesses) {
        Py_XDECREF(found);
        Py_XDECREF(witnesses);
        return NULL;
    }
    return PyObject_CallFunction(state->contacts, "NNnnnnnnnOn", found, witnesses, (Py_ssize_t)c->bodies,
                                 (Py_ssize_t)c->pairs, (Py_ssize_t)c->aged, (Py_ssize_t)c->queried,
                                 (Py_ssize_t)c->added, (Py_ssize_t)c->dropped, (Py_ssize_t)c->moved,
                                 c->rebuilt ? Py_True : Py_False, (Py_ssize_t)c->memory);
}

static PyObject *contacts(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"kind", "margin", QUERY_NAMES, NULL};
    world_object *self = (world_object *)object;
    module_state *state = state_of(object);
    const char *kind = "distance";
    query_keywords k = {0};
    ovoid_contact_query query = {.options = &k.options};
    ovoid_contacts found;
    ovoid_error error;
    ovoid_code code;
    if (!arguments_read(arguments, keywords, "|sd$" QUERY_FORMAT ":contacts", names, &kind, &query.margin,
                        QUERY_TARGETS(k)) ||
        read_kind(state, kind, &query.kind) || query_keywords_validate(state, &k) ||
        cap_refuse(state, &k, "contacts") || world_enter(self, 1))
        return NULL;
    Py_BEGIN_ALLOW_THREADS;
    code = ovoid_world_compute_contacts(self->world, &query, &found, &error);
    Py_END_ALLOW_THREADS;
    PyObject *made = code == OVOID_OK ? copy_contacts(state, &found) : raise_error(state, &error);
    if (code == OVOID_OK) self->asked = k.options;
    world_leave(self, 1);
    return made;
}

// ---- answers

int world_find(world_object *self, ovoid_id id, PyObject **body, ovoid_pose *pose) {
    ovoid_world_body found;
    if (get_body(self, id, &found)) return -1;
    *pose = found.body.pose;
    *body = find_kept(self, id);
    return *body ? 0 : -1;
}

// Fills an answer to two bodies without a solid.
static PyObject *fill_proof(world_object *self, const ovoid_contact *contact, answer_object *made) {
    cover_room room;
    ovoid_code code;
    ovoid_error error;
    if (!made) return NULL;
    cover_room_make(&room);
    ovoid_exclusions exclusions = {.cover = &room.cover, .grows = 1};
    ovoid_contact_proof proof = {.exclusions = &exclusions};
    do code = ovoid_world_compute_proof(self->world, contact, &proof, &error);
    while (code == OVOID_OK && cover_room_grow(&room, proof.answer.limit));
    made->of = proof.answer;
    made->options = self->asked;
    int failed = answer_keep_exclusions(made, &exclusions);
    if (!failed && code != OVOID_OK) raise_error(state_of((PyObject *)self), &error);
    if (cover_room_keep(&room, &made->cover) || failed || code != OVOID_OK) Py_CLEAR(made);
    return (PyObject *)made;
}

// Of solids the world keeps no proof: they are asked.
static PyObject *compute_proof(world_object *self, const ovoid_contact *contact) {
    module_state *state = state_of((PyObject *)self);
    PyObject *a = NULL, *b = NULL, *made = NULL;
    ovoid_pose pose_a, pose_b;
    if (!world_find(self, contact->a, &a, &pose_a) && !world_find(self, contact->b, &b, &pose_b)) {
        ovoid_body_pair pair = {body_make(state, a, pose_a), body_make(state, b, pose_b)};
        made = pair.a.solid || pair.b.solid ? query_ask(state, a, b, &pair, -1, NULL)
                                            : fill_proof(self, contact, answer_make(state, a, b, &pose_a, &pose_b));
    }
    Py_XDECREF(a);
    Py_XDECREF(b);
    return made;
}

static PyObject *proof(PyObject *object, PyObject *arguments) {
    world_object *self = (world_object *)object;
    ovoid_contact contact = {0};
    if (!PyArg_ParseTuple(arguments, "O&O&:proof", id_read, &contact.a, id_read, &contact.b) || world_enter(self, 0))
        return NULL;
    PyObject *made = compute_proof(self, &contact);
    world_leave(self, 0);
    return made;
}

static PyMethodDef methods[] = {
    {"add", METHOD_KEYWORDS(add), METH_VARARGS | METH_KEYWORDS,
     "add(body: Body, pose: PoseLike = None, *, group: int = 0, mask: int = 0, user: int = 0) -> int\n--\n\nAdds a "
     "Shape, Compound or Solid; returns its id. user: a number of yours, which contacts carry. Two bodies are a pair "
     "if a.group & b.mask and b.group & a.mask are\nboth not zero; both "
     "zero: all of both."},
    {"add_many", METHOD_KEYWORDS(add_many), METH_VARARGS | METH_KEYWORDS,
     "add_many(bodies: Sequence[Body], poses: PosesLike, *, order: Order = None, group: int = 0, mask: int = 0) -> "
     "Ids\n--\n\nAdds many, all or none; returns an array of their ids. poses and order as in Bodies."},
    {"remove", remove_one, METH_O, "remove(id: SupportsIndex, /) -> None\n--\n\nRemoves a body."},
    {"remove_many", remove_many, METH_O,
     "remove_many(ids: Numbers, /) -> None\n--\n\nRemoves many bodies, all or none."},
    {"move", move, METH_VARARGS, "move(id: SupportsIndex, pose: PoseLike, /) -> None\n--\n\nMoves a body to a pose."},
    {"move_many", METHOD_KEYWORDS(move_many), METH_VARARGS | METH_KEYWORDS,
     "move_many(ids: Numbers, poses: PosesLike, *, order: Order = None) -> None\n--\n\nMoves many, all or none. poses "
     "and order as in Bodies."},
    {"pose", get_pose, METH_O, "pose(id: SupportsIndex, /) -> Pose\n--\n\nThe pose of a body."},
    {"body", get_kept, METH_O, "body(id: SupportsIndex, /) -> Body\n--\n\nThe Shape, Compound or Solid of a body."},
    {"ids", get_ids, METH_NOARGS, "ids() -> Ids\n--\n\nThe ids of all bodies, in ascending order."},
    {"_get_state", get_state, METH_NOARGS, NULL},
    {"set_groups", set_groups, METH_VARARGS,
     "set_groups(id: SupportsIndex, group: int, mask: int, /) -> None\n--\n\nOther groups for a body."},
    {"set_ignored", set_ignored, METH_VARARGS,
     "set_ignored(a: SupportsIndex, b: SupportsIndex, ignored: bool = True, /) -> None\n--\n\nLeaves a pair of ids out "
     "from now on, or takes it back."},
    {"is_pair", is_pair, METH_VARARGS,
     "is_pair(a: SupportsIndex, b: SupportsIndex, /) -> bool\n--\n\nTrue where the two would be queried as a pair."},
    {"contacts", METHOD_KEYWORDS(contacts), METH_VARARGS | METH_KEYWORDS,
     "contacts(kind: Literal['collide', 'within', 'distance', 'depth'] = 'distance', margin: float = 0, "
     "*, " QUERY_SIGNATURE ") -> Contacts\n--\n\nAll pairs that are not proven farther than the margin: a Contacts "
     "tuple. kind: 'collide' (margin 0), 'within',\n'distance' or 'depth'."},
    {"proof", proof, METH_VARARGS,
     "proof(a: SupportsIndex, b: SupportsIndex, /) -> Answer\n--\n\nThe whole Answer of a contact at the present "
     "poses, which verify() takes."},
    {NULL, NULL, 0, NULL}};

static PyType_Slot slots[] = {
    {Py_tp_doc, "World(*, threads: int = 1, enlargement: float = 0) -> World\n--\n\nMany bodies that move, and from "
                "step to step which of them touch or are near; the proof of each pair is kept and\ngoes into the next "
                "step. Contacts have the same bits on any number of threads. enlargement: how far a body may "
                "go\nbefore the tree is updated, in units of its size; 0: the world's choice."},
    {Py_tp_new, world_new},
    {Py_tp_dealloc, world_dealloc},
    {Py_mp_length, length},
    {Py_tp_methods, NULL},
    {0, NULL}};
static PyType_Spec spec = {"ovoid.World", sizeof(world_object), 0, Py_TPFLAGS_DEFAULT, slots};

int world_add(PyObject *module) {
    static PyMethodDef both[48], all[48];
    slots_set_methods(slots, both, methods, world_queries);
    slots_set_methods(slots, all, both, world_manifold_methods);
    return type_add(module, &spec, &state_of_module(module)->world);
}
