// Cell: a robot among obstacles, what it holds, which pairs are left out. It keeps its bodies alive.
//
// Changes are made under the interpreter's lock, queries without it; so a change that finds a query of another thread
// at work raises RuntimeError and does nothing. Each query borrows a checker, and there are as many as there were
// queries at once.
#include "src/robot/robot.h"

#include <stdlib.h>

// ---- making and ending

static PyObject *cell_new(PyTypeObject *type, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"robot", NULL};
    PyObject *given;
    robot_object *robot;
    ovoid_error error;
    module_state *state = state_of_type((PyObject *)type);
    if (!arguments_read(arguments, keywords, "O:Cell", names, &given) || robot_read(state, given, "robot", &robot))
        return NULL;
    cell_object *self = object_make(type);
    if (!self) return NULL;
    self->robot = (robot_object *)Py_NewRef(given);
    self->kept = PyDict_New();
    self->cell = self->kept ? ovoid_robot_cell_create(robot->robot, NULL, &error) : NULL;
    if (self->cell) return (PyObject *)self;
    if (self->kept) raise_error(state, &error);
    Py_DECREF((PyObject *)self);
    return NULL;
}

static void cell_dealloc(PyObject *object) {
    cell_object *self = (cell_object *)object;
    for (size_t i = 0; i < self->idle_count; i++) ovoid_robot_checker_destroy(self->idle[i]);
    free(self->idle);
    ovoid_robot_cell_destroy(self->cell);
    Py_XDECREF(self->kept);
    Py_XDECREF((PyObject *)self->robot);
    object_free(object);
}

// ---- checkers

int checkers_borrow(cell_object *self, ovoid_robot_checker **checkers, size_t count) {
    ovoid_error error;
    for (size_t i = 0; i < count; i++) {
        checkers[i] =
            self->idle_count ? self->idle[--self->idle_count] : ovoid_robot_checker_create(self->cell, NULL, &error);
        if (checkers[i]) continue;
        raise_error(state_of((PyObject *)self), &error);
        self->readers++;
        checkers_return(self, checkers, i);
        return -1;
    }
    self->readers++;
    return 0;
}

// In the other order, so that the next call gets them in this one. Those that find no room are ended.
void checkers_return(cell_object *self, ovoid_robot_checker *const *checkers, size_t count) {
    self->readers--;
    if (self->idle_count + count > self->idle_capacity) {
        size_t capacity = 2 * (self->idle_count + count);
        ovoid_robot_checker **grown = realloc(self->idle, capacity * sizeof *grown);
        if (grown) {
            self->idle = grown;
            self->idle_capacity = capacity;
        }
    }
    while (count--)
        if (self->idle_count < self->idle_capacity)
            self->idle[self->idle_count++] = checkers[count];
        else
            ovoid_robot_checker_destroy(checkers[count]);
}

static PyObject *reset(PyObject *object, PyObject *ignored) {
    (void)ignored;
    cell_object *self = (cell_object *)object;
    for (size_t i = 0; i < self->idle_count; i++) ovoid_robot_checker_reset(self->idle[i]);
    Py_RETURN_NONE;
}

// ---- changes

// Before a change: -1 with RuntimeError where a query of another thread is at work.
static int begin_change(cell_object *self) {
    if (!self->readers) return 0;
    PyErr_SetString(PyExc_RuntimeError, "another thread is querying this cell");
    return -1;
}

static PyObject *end_change(cell_object *self, ovoid_code code, const ovoid_error *error) {
    self->version++;
    return code == OVOID_OK ? Py_NewRef(Py_None) : raise_error(state_of((PyObject *)self), error);
}

static int set_kept(cell_object *self, const placed_body *placed, PyObject *body, PyObject *name) {
    if (name && name != Py_None && !PyUnicode_Check(name)) {
        PyErr_Format(PyExc_TypeError, "name: a string is wanted, not %R", (PyObject *)Py_TYPE(name));
        return -1;
    }
    PyObject *key = PyLong_FromUnsignedLongLong(placed->id);
    PyObject *link = placed->link == OVOID_ROBOT_NONE ? Py_NewRef(Py_None) : PyLong_FromUnsignedLong(placed->link);
    PyObject *named = name && name != Py_None ? Py_NewRef(name) : PyUnicode_FromFormat("body %llu", placed->id);
    PyObject *kept = Py_BuildValue("(ONNN)", body, named, link, pose_wrap(state_of((PyObject *)self), placed->pose));
    int result = key && kept ? PyDict_SetItem(self->kept, key, kept) : -1;
    Py_XDECREF(key);
    Py_XDECREF(kept);
    return result;
}

int cell_keep(cell_object *self, const placed_body *placed, PyObject *body, PyObject *name) {
    int result = set_kept(self, placed, body, name);
    if (result) ovoid_robot_cell_remove(self->cell, placed->id, NULL);
    self->version++;
    return result;
}

/// A body that is added: what the caller gave.
typedef struct added_body {
    PyObject *body, *name;
    ovoid_pose pose;
    uint32_t link;
} added_body;

static PyObject *end_adding(cell_object *self, ovoid_id id, const added_body *added, const ovoid_error *error) {
    if (!id) return raise_error(state_of((PyObject *)self), error);
    const placed_body placed = {id, added->link, added->pose};
    return cell_keep(self, &placed, added->body, added->name) ? NULL : PyLong_FromUnsignedLongLong(id);
}

static PyObject *add(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"body", "pose", "name", NULL};
    cell_object *self = (cell_object *)object;
    module_state *state = state_of(object);
    PyObject *pose = NULL;
    added_body added = {.link = OVOID_ROBOT_NONE};
    ovoid_body body;
    ovoid_error error;
    if (!arguments_read(arguments, keywords, "O|O$O:add", names, &added.body, &pose, &added.name) ||
        body_read(state, added.body, "body", &body) || pose_read(state, pose, "pose", &body.pose) || begin_change(self))
        return NULL;
    added.pose = body.pose;
    return end_adding(self, ovoid_robot_cell_add(self->cell, &body, &error), &added, &error);
}

// Links as an array of its own, which the caller frees; NULL: an exception.
static uint32_t *read_links(const cell_object *self, PyObject *given, size_t *count) {
    PyObject *links = PySequence_Tuple(given);
    if (!links) return NULL;
    *count = (size_t)PyTuple_Size(links);
    uint32_t *made = malloc((*count + 1) * sizeof *made);
    if (!made) PyErr_NoMemory();
    for (size_t i = 0; made && i < *count; i++)
        if (link_read(self->robot, PyTuple_GetItem(links, (Py_ssize_t)i), &made[i])) {
            free(made);
            made = NULL;
        }
    Py_DECREF(links);
    return made;
}

static PyObject *attach(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"link", "body", "pose", "touching", "name", NULL};
    cell_object *self = (cell_object *)object;
    module_state *state = state_of(object);
    PyObject *link_given, *pose = NULL, *touching = NULL, *made = NULL;
    added_body added = {.name = NULL};
    uint32_t *links = NULL;
    size_t count = 0;
    ovoid_body body;
    ovoid_error error;
    if (!arguments_read(arguments, keywords, "OO|OO$O:attach", names, &link_given, &added.body, &pose, &touching,
                        &added.name) ||
        link_read(self->robot, link_given, &added.link) || body_read(state, added.body, "body", &body) ||
        pose_read(state, pose, "pose", &body.pose) || (touching && !(links = read_links(self, touching, &count))))
        return NULL;
    added.pose = body.pose;
    const ovoid_robot_attachment attachment = {added.link, body, links, count};
    if (!begin_change(self))
        made = end_adding(self, ovoid_robot_cell_attach(self->cell, &attachment, &error), &added, &error);
    free(links);
    return made;
}

static PyObject *remove_body(PyObject *object, PyObject *given) {
    cell_object *self = (cell_object *)object;
    ovoid_id id;
    ovoid_error error;
    if (!id_read(given, &id) || begin_change(self)) return NULL;
    ovoid_code code = ovoid_robot_cell_remove(self->cell, id, &error);
    PyObject *key = code == OVOID_OK ? PyLong_FromUnsignedLongLong(id) : NULL;
    if (key && PyDict_DelItem(self->kept, key)) PyErr_Clear();
    Py_XDECREF(key);
    return end_change(self, code, &error);
}

// Keeps where a body is now.
static int keep_pose(cell_object *self, ovoid_id id, ovoid_pose pose) {
    PyObject *key = PyLong_FromUnsignedLongLong(id), *kept = key ? PyDict_GetItem(self->kept, key) : NULL;
    Py_XDECREF(key);
    if (!kept) return PyErr_Occurred() ? -1 : 0;
    PyObject *link = PyTuple_GetItem(kept, KEPT_LINK), *body = Py_NewRef(PyTuple_GetItem(kept, KEPT_BODY));
    PyObject *name = Py_NewRef(PyTuple_GetItem(kept, KEPT_NAME));
    uint32_t index = link == Py_None ? OVOID_ROBOT_NONE : (uint32_t)PyLong_AsUnsignedLong(link);
    int result = set_kept(self, &(placed_body){id, index, pose}, body, name);
    Py_DECREF(body);
    Py_DECREF(name);
    return result;
}

static PyObject *move(PyObject *object, PyObject *arguments) {
    cell_object *self = (cell_object *)object;
    PyObject *given = NULL;
    ovoid_id id;
    ovoid_pose pose;
    ovoid_error error;
    if (!PyArg_ParseTuple(arguments, "O&O:move", id_read, &id, &given) ||
        pose_read(state_of(object), given, "pose", &pose) || begin_change(self))
        return NULL;
    ovoid_code code = ovoid_robot_cell_move(self->cell, id, &pose, &error);
    if (code == OVOID_OK && keep_pose(self, id, pose)) return NULL;
    return end_change(self, code, &error);
}

static PyObject *allow(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"a", "b", "allowed", NULL};
    cell_object *self = (cell_object *)object;
    PyObject *first, *second;
    uint32_t a, b;
    int allowed = 1;
    ovoid_error error;
    if (!arguments_read(arguments, keywords, "OO|p:allow", names, &first, &second, &allowed) ||
        link_read(self->robot, first, &a) || link_read(self->robot, second, &b) || begin_change(self))
        return NULL;
    ovoid_code code = allowed ? ovoid_robot_cell_add_allowed(self->cell, a, b, &error)
                              : ovoid_robot_cell_remove_allowed(self->cell, a, b, &error);
    return end_change(self, code, &error);
}

static PyObject *allow_body(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"id", "link", "allowed", NULL};
    cell_object *self = (cell_object *)object;
    PyObject *given;
    ovoid_id id;
    uint32_t link;
    int allowed = 1;
    ovoid_error error;
    if (!arguments_read(arguments, keywords, "O&O|p:allow_body", names, id_read, &id, &given, &allowed) ||
        link_read(self->robot, given, &link) || begin_change(self))
        return NULL;
    ovoid_code code = allowed ? ovoid_robot_cell_add_body_allowed(self->cell, id, link, &error)
                              : ovoid_robot_cell_remove_body_allowed(self->cell, id, link, &error);
    return end_change(self, code, &error);
}

static PyObject *set_padding(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"link", "padding", NULL};
    cell_object *self = (cell_object *)object;
    PyObject *given;
    uint32_t link;
    double padding;
    ovoid_error error;
    if (!arguments_read(arguments, keywords, "Od:set_padding", names, &given, &padding) ||
        link_read(self->robot, given, &link) || begin_change(self))
        return NULL;
    return end_change(self, ovoid_robot_cell_set_padding(self->cell, link, padding, &error), &error);
}

// ---- what it is

static PyObject *is_allowed(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"a", "b", NULL};
    cell_object *self = (cell_object *)object;
    PyObject *first, *second;
    uint32_t a, b;
    if (!arguments_read(arguments, keywords, "OO:is_allowed", names, &first, &second) ||
        link_read(self->robot, first, &a) || link_read(self->robot, second, &b))
        return NULL;
    return PyBool_FromLong(ovoid_robot_cell_is_allowed(self->cell, a, b));
}

static PyObject *is_body_allowed(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"id", "link", NULL};
    cell_object *self = (cell_object *)object;
    PyObject *given;
    ovoid_id id;
    uint32_t link;
    if (!arguments_read(arguments, keywords, "O&O:is_body_allowed", names, id_read, &id, &given) ||
        link_read(self->robot, given, &link))
        return NULL;
    return PyBool_FromLong(ovoid_robot_cell_is_body_allowed(self->cell, id, link));
}

static PyObject *get_padding(PyObject *object, PyObject *given) {
    cell_object *self = (cell_object *)object;
    uint32_t link;
    if (link_read(self->robot, given, &link)) return NULL;
    return PyFloat_FromDouble(ovoid_robot_cell_get_padding(self->cell, link));
}

// What is kept of each id at one place, or all of it.
static PyObject *get_kept(PyObject *self, void *closure) {
    PyObject *key, *value, *made = PyDict_New();
    const kept_place *place = closure;
    Py_ssize_t at = 0;
    while (made && PyDict_Next(((cell_object *)self)->kept, &at, &key, &value))
        if (PyDict_SetItem(made, key, place ? PyTuple_GetItem(value, *place) : value)) Py_CLEAR(made);
    return made;
}

static PyObject *get_pair_count(PyObject *self, void *closure) {
    (void)closure;
    return PyLong_FromSize_t(ovoid_robot_cell_get_pair_count(((cell_object *)self)->cell));
}

static PyObject *pair(PyObject *object, PyObject *given) {
    cell_object *self = (cell_object *)object;
    module_state *state = state_of(object);
    size_t number = PyLong_AsSize_t(given);
    if (PyErr_Occurred()) return NULL;
    ovoid_robot_sides sides;
    ovoid_error error;
    if (ovoid_robot_cell_get_pair(self->cell, number, &sides, &error) != OVOID_OK) return raise_error(state, &error);
    PyObject *first = side_make(self, &sides.a), *second = side_make(self, &sides.b);
    if (first && second) return Py_BuildValue("NN", first, second);
    Py_XDECREF(first);
    Py_XDECREF(second);
    return NULL;
}

// ---- the type

static PyMethodDef own_methods[] = {
    {"add", METHOD_KEYWORDS(add), METH_VARARGS | METH_KEYWORDS,
     "add(body: Body, pose: PoseLike = None, *, name: str | None = None) -> int\n--\n\nAdds an obstacle, posed in the "
     "root "
     "link's frame: its id. name: by which answers call it, by default \"body ID\"."},
    {"attach", METHOD_KEYWORDS(attach), METH_VARARGS | METH_KEYWORDS,
     "attach(link: LinkLike, body: Body, pose: PoseLike = None, touching: Sequence[LinkLike] = (), *, name: str "
     "| None = None) -> int\n--\n\nAttaches a body to a link, in whose frame its pose is: its id. It may touch this "
     "link and "
     "those of touching. name: by\nwhich answers call it, by default \"body ID\"."},
    {"remove", remove_body, METH_O, "remove(id: int, /) -> None\n--\n\nRemoves an obstacle or an attached body."},
    {"move", move, METH_VARARGS,
     "move(id: int, pose: PoseLike, /) -> None\n--\n\nMoves an obstacle, or an attached body in its link's frame."},
    {"allow", METHOD_KEYWORDS(allow), METH_VARARGS | METH_KEYWORDS,
     "allow(a: LinkLike, b: LinkLike, allowed: bool = True) -> None\n--\n\nLets two links touch, or takes that back."},
    {"allow_body", METHOD_KEYWORDS(allow_body), METH_VARARGS | METH_KEYWORDS,
     "allow_body(id: int, link: LinkLike, allowed: bool = True) -> None\n--\n\nLets an obstacle or an attached body "
     "touch a link, or takes that back."},
    {"set_padding", METHOD_KEYWORDS(set_padding), METH_VARARGS | METH_KEYWORDS,
     "set_padding(link: LinkLike, padding: float) -> None\n--\n\nEnlarges a link, with what is attached to it, against "
     "obstacles by a length >= 0."},
    {"is_allowed", METHOD_KEYWORDS(is_allowed), METH_VARARGS | METH_KEYWORDS,
     "is_allowed(a: LinkLike, b: LinkLike) -> bool\n--\n\nWhether a pair of links is not queried: disabled, allowed, "
     "or rigid."},
    {"is_body_allowed", METHOD_KEYWORDS(is_body_allowed), METH_VARARGS | METH_KEYWORDS,
     "is_body_allowed(id: int, link: LinkLike) -> bool\n--\n\nWhether an obstacle or an attached body and a link are "
     "not queried."},
    {"get_padding", get_padding, METH_O,
     "get_padding(link: LinkLike, /) -> float\n--\n\nBy how much a link is enlarged against obstacles."},
    {"pair", pair, METH_O,
     "pair(number: int, /) -> tuple[Side, Side]\n--\n\nThe two Sides of a pair, 0 <= number < pair_count."},
    {"reset", reset, METH_NOARGS,
     "reset() -> None\n--\n\nForgets the states before: the next query has the bits of a new cell's."},
    {NULL, NULL, 0, NULL}};

static PyGetSetDef fields[] = {
    FIELD_PYTHON(cell_object, "Robot", "robot", robot, "The Robot."),
    {"bodies", get_kept, NULL, "dict[int, Body]: A dict of the bodies by their ids.", &(kept_place){KEPT_BODY}},
    {"names", get_kept, NULL, "dict[int, str]: A dict of the bodies' names by their ids.", &(kept_place){KEPT_NAME}},
    {"_kept", get_kept, NULL, NULL, NULL},
    {"pair_count", get_pair_count, NULL, "int: How many pairs there are, queried or left out.", NULL},
    {NULL, NULL, NULL, NULL, NULL}};

static PyType_Slot slots[] = {
    {Py_tp_doc,
     "Cell(robot: Robot) -> Cell\n--\n\nA robot among obstacles, what it holds, which pairs are left out. A pair of "
     "links is queried unless the description\ndisables it, the cell allows it, or nothing but fixed joints is between "
     "the two. Any number of threads may query it\nat once; a change meanwhile raises RuntimeError."},
    {Py_tp_new, cell_new},
    {Py_tp_dealloc, cell_dealloc},
    {Py_tp_methods, NULL},
    {Py_tp_getset, fields},
    {0, NULL}};
static PyType_Spec spec = {"ovoid.Cell", sizeof(cell_object), 0, Py_TPFLAGS_DEFAULT, slots};

int cell_add(PyObject *module) {
    static PyMethodDef queries[24], all[24];
    static PyMethodDef about[8], found[8];
    slots_set_methods(slots, about, cell_clearances, cell_sides);
    slots_set_methods(slots, found, about, cell_plans);
    slots_set_methods(slots, queries, cell_queries, found);
    slots_set_methods(slots, all, own_methods, queries);
#ifdef OVOID_PYTHON_ROBOT_READ
    static PyMethodDef files[8], with_files[32];
    slots_set_methods(slots, files, cell_scenes, cell_proofs);
    slots_set_methods(slots, with_files, all, files);
    if (functions_add(module, robot_proof_functions)) return -1;
#endif
    if (functions_add(module, robot_functions)) return -1;
    return type_add(module, &spec, &state_of_module(module)->cell);
}
