// Sides of a pair by their names, written as the tool writes them: "hand"; "hand[palm]" where the link has several
// elements or holds something; "table"; "table[1]" where several obstacles have the name.
#include "src/robot/robot.h"

/// A name among those that are alike: how many others there are, and how many of these come before.
typedef struct alike_count {
    size_t others, before;
} alike_count;

// "outer[inner]", or "outer" alone where inner is NULL. It takes over both references.
static PyObject *join(PyObject *outer, PyObject *inner) {
    PyObject *made = outer && inner ? PyUnicode_FromFormat("%U[%U]", outer, inner) : Py_XNewRef(outer);
    Py_XDECREF(outer);
    Py_XDECREF(inner);
    return made;
}

static PyObject *format_number(size_t number) { return PyUnicode_FromFormat("%zu", number); }

// Counts what a link holds.
static size_t count_held(const cell_object *cell, uint32_t link) {
    PyObject *key, *value;
    Py_ssize_t at = 0;
    size_t count = 0;
    while (PyDict_Next(cell->kept, &at, &key, &value)) {
        PyObject *holder = PyTuple_GetItem(value, KEPT_LINK);
        count += holder != Py_None && PyLong_AsUnsignedLong(holder) == link;
    }
    return count;
}

static PyObject *name_element(const cell_object *cell, const ovoid_robot_side *side) {
    ovoid_robot_description d = ovoid_robot_get_description(cell->robot->robot);
    alike_count alike = {count_held(cell, side->link), 0};
    for (uint32_t i = 0; i < d.element_count; i++)
        if (d.elements[i].link == side->link && i != side->element) alike.others++, alike.before += i < side->element;
    const char *own = side->element < d.element_count ? d.elements[side->element].name : NULL;
    PyObject *inner = !alike.others ? NULL : own ? robot_name_make(own) : format_number(alike.before);
    return join(robot_name_make(d.links[side->link].name), inner);
}

// What a link holds, behind the link's name.
static PyObject *name_held(const cell_object *cell, const ovoid_robot_side *side, PyObject *name) {
    const char *link = ovoid_robot_get_description(cell->robot->robot).links[side->link].name;
    return join(robot_name_make(link), Py_NewRef(name));
}

static PyObject *name_obstacle(const cell_object *cell, const ovoid_robot_side *side, PyObject *name) {
    PyObject *key, *value;
    Py_ssize_t at = 0;
    alike_count alike = {0, 0};
    while (PyDict_Next(cell->kept, &at, &key, &value)) {
        ovoid_id id = PyLong_AsUnsignedLongLong(key);
        if (id == side->body || PyTuple_GetItem(value, KEPT_LINK) != Py_None) continue;
        if (PyUnicode_Compare(PyTuple_GetItem(value, KEPT_NAME), name)) continue;
        alike.others++;
        alike.before += id < side->body;
    }
    return join(Py_NewRef(name), alike.others ? format_number(alike.before) : NULL);
}

static PyObject *name_side(const cell_object *cell, const ovoid_robot_side *side) {
    if (!side->body) return name_element(cell, side);
    PyObject *key = PyLong_FromUnsignedLongLong(side->body), *kept = key ? PyDict_GetItem(cell->kept, key) : NULL;
    Py_XDECREF(key);
    PyObject *name = kept ? PyTuple_GetItem(kept, KEPT_NAME) : NULL;
    if (!name) return PyUnicode_FromString("?");
    return side->link == OVOID_ROBOT_NONE ? name_obstacle(cell, side, name) : name_held(cell, side, name);
}

PyObject *side_make(const cell_object *cell, const ovoid_robot_side *side) {
    PyObject *link = side->link == OVOID_ROBOT_NONE ? Py_NewRef(Py_None) : PyLong_FromUnsignedLong(side->link);
    PyObject *element = side->element == OVOID_ROBOT_NONE ? Py_NewRef(Py_None) : PyLong_FromUnsignedLong(side->element);
    return PyObject_CallFunction(state_of((PyObject *)cell)->side, "NNKIN", link, element, side->body, side->part,
                                 name_side(cell, side));
}

// ---- records

/// Where the records of a kind have what names a pair.
typedef struct record_layout {
    record_kind kind;
    size_t size, a, b;
} record_layout;
static const record_layout layouts[] = {
    {RECORD_NEAR, sizeof(ovoid_robot_near), offsetof(ovoid_robot_near, a), offsetof(ovoid_robot_near, b)},
    {RECORD_STATE, sizeof(ovoid_robot_answer), offsetof(ovoid_robot_answer, a), offsetof(ovoid_robot_answer, b)}};

static int has_name(const cell_object *cell, const ovoid_robot_side *side) {
    size_t links = ovoid_robot_get_description(cell->robot->robot).link_count;
    return side->link == OVOID_ROBOT_NONE ? side->body != 0 : side->link < links;
}

// The names of a record's pair; None where it names none.
static PyObject *name_record(const cell_object *cell, const record_layout *layout, const char *record) {
    const ovoid_robot_answer *answer = (const void *)record;
    const ovoid_robot_side *a = (const void *)(record + layout->a), *b = (const void *)(record + layout->b);
    int is_named = layout->kind == RECORD_NEAR || state_has_pair(answer);
    if (!is_named || !has_name(cell, a) || !has_name(cell, b)) Py_RETURN_NONE;
    return Py_BuildValue("(NN)", name_side(cell, a), name_side(cell, b));
}

static PyObject *pair_names(PyObject *object, PyObject *given) {
    cell_object *self = (cell_object *)object;
    module_state *state = state_of(object);
    const record_layout *layout = &layouts[0];
    Py_buffer view;
    if (records_view(state, given, "records", layout->kind, -1, 0, &view)) {
        PyErr_Clear();
        layout++;
        if (records_view(state, given, "records", layout->kind, -1, 0, &view)) return NULL;
    }
    PyObject *list = PyList_New(0);
    for (Py_ssize_t at = 0; list && at < view.len; at += (Py_ssize_t)layout->size) {
        PyObject *one = name_record(self, layout, (const char *)view.buf + at);
        if (!one || PyList_Append(list, one)) Py_CLEAR(list);
        Py_XDECREF(one);
    }
    PyBuffer_Release(&view);
    return list;
}

PyMethodDef cell_sides[] = {
    {"pair_names", pair_names, METH_O,
     "pair_names(records: Records, /) -> list[tuple[str, str] | None]\n--\n\nThe names of the pairs of an array of "
     "records, as near(), nearest() or collide_batch() return it; None where a state is\nfree or refused."},
    {NULL, NULL, 0, NULL}};
