// Robot(...): a description that is read from tuples of names, Joints and elements.
#include "src/query.h"
#include "src/robot/robot.h"

#include <stdlib.h>
#include <string.h>

/// A description that is read from tuples: the arrays are its own, names are borrowed from Python's strings.
typedef struct parts {
    ovoid_robot_description d;
    ovoid_robot_link *links;
    ovoid_robot_joint *joints;
    ovoid_robot_element *elements;
    ovoid_robot_pair *disabled;
    PyObject *kept; ///< a list: what the names belong to
} parts;

static void free_parts(parts *p) {
    free(p->links);
    free(p->joints);
    free(p->elements);
    free(p->disabled);
    Py_XDECREF(p->kept);
}

// The text of a string, which is kept. NULL: an exception.
static const char *read_name(parts *p, PyObject *from, const char *what) {
    if (!from || !PyUnicode_Check(from)) {
        if (from) PyErr_Format(PyExc_TypeError, "%s: a name is wanted, not %R", what, (PyObject *)Py_TYPE(from));
        return NULL;
    }
    Py_ssize_t size;
    const char *text = PyUnicode_AsUTF8AndSize(from, &size);
    if (text && strlen(text) != (size_t)size) {
        PyErr_Format(PyExc_ValueError, "%s: a name holds a zero", what);
        return NULL;
    }
    return !text || PyList_Append(p->kept, from) ? NULL : text;
}

// The index of a name, or of an index itself, in a tuple of names that were kept first.
static int read_index(const ovoid_robot_link *names, size_t count, const char *name, const char *what, uint32_t *to) {
    for (size_t i = 0; name && i < count; i++)
        if (!strcmp(names[i].name, name)) {
            *to = (uint32_t)i;
            return 0;
        }
    if (name) PyErr_Format(PyExc_ValueError, "%s: there is no link '%s'", what, name);
    return -1;
}

static int read_links(parts *p, PyObject *given) {
    PyObject *links = PySequence_Tuple(given);
    size_t count = links ? (size_t)PyTuple_Size(links) : 0;
    p->links = links ? calloc(count + 1, sizeof *p->links) : NULL;
    int failed = !p->links || PyList_Append(p->kept, links);
    if (links && !p->links) PyErr_NoMemory();
    for (size_t i = 0; !failed && i < count; i++)
        failed = !(p->links[i].name = read_name(p, PyTuple_GetItem(links, (Py_ssize_t)i), "links"));
    Py_XDECREF(links);
    p->d.links = p->links;
    p->d.link_count = count;
    return failed ? -1 : 0;
}

static int read_type(const char *name, ovoid_joint_type *type) {
    for (int i = 0; name && i <= OVOID_JOINT_FLOATING; i++)
        if (!strcmp(ovoid_joint_type_get_name((ovoid_joint_type)i), name)) {
            *type = (ovoid_joint_type)i;
            return 0;
        }
    if (name) PyErr_Format(PyExc_ValueError, "joints: there is no type '%s'", name);
    return -1;
}

// (name, type, parent, child, origin, axis, lower, upper, velocity, mimic, multiplier, offset); mimics come later.
static int read_joint(module_state *state, parts *p, PyObject *from, ovoid_robot_joint *to, PyObject **mimic) {
    PyObject *name, *type, *parent, *child, *origin = Py_None, *axis = NULL;
    to->multiplier = 1;
    *mimic = Py_None;
    if (!PyTuple_Check(from)) {
        PyErr_Format(PyExc_TypeError, "joints: a Joint is wanted, not %R", (PyObject *)Py_TYPE(from));
        return -1;
    }
    if (!PyArg_ParseTuple(from, "OOOO|OOdddOdd;joints: a Joint is wanted", &name, &type, &parent, &child, &origin,
                          &axis, &to->lower, &to->upper, &to->velocity, mimic, &to->multiplier, &to->offset))
        return -1;
    to->mimic = OVOID_ROBOT_NONE;
    to->axis = (ovoid_vec3){1, 0, 0};
    to->name = read_name(p, name, "joints");
    if (!to->name || read_type(read_name(p, type, "joints"), &to->type) ||
        read_index(p->links, p->d.link_count, read_name(p, parent, "joints"), to->name, &to->parent) ||
        read_index(p->links, p->d.link_count, read_name(p, child, "joints"), to->name, &to->child) ||
        pose_read(state, origin, "origin", &to->origin))
        return -1;
    return axis && axis != Py_None ? vec3_read(state, axis, "axis", &to->axis) : 0;
}

static int read_mimic(const parts *p, const char *name, ovoid_robot_joint *joint) {
    for (size_t i = 0; name && i < p->d.joint_count; i++)
        if (!strcmp(p->joints[i].name, name)) {
            joint->mimic = (uint32_t)i;
            return 0;
        }
    if (name) PyErr_Format(PyExc_ValueError, "%s: there is no joint '%s' to mimic", joint->name, name);
    return -1;
}

static int read_joints(module_state *state, parts *p, PyObject *given) {
    PyObject *joints = PySequence_Tuple(given), *mimic;
    size_t count = joints ? (size_t)PyTuple_Size(joints) : 0;
    p->joints = joints ? calloc(count + 1, sizeof *p->joints) : NULL;
    int failed = !p->joints || PyList_Append(p->kept, joints);
    if (joints && !p->joints) PyErr_NoMemory();
    p->d.joint_count = count;
    for (size_t i = 0; !failed && i < count; i++)
        failed = read_joint(state, p, PyTuple_GetItem(joints, (Py_ssize_t)i), &p->joints[i], &mimic);
    // All names are known now.
    for (size_t i = 0; !failed && i < count; i++) {
        PyObject *joint = PyTuple_GetItem(joints, (Py_ssize_t)i);
        mimic = PyTuple_Size(joint) > 9 ? PyTuple_GetItem(joint, 9) : Py_None;
        if (mimic != Py_None) failed = read_mimic(p, read_name(p, mimic, "mimic"), &p->joints[i]);
    }
    Py_XDECREF(joints);
    p->d.joints = p->joints;
    return failed ? -1 : 0;
}

/// The bodies of an element, new references; the solid may be NULL.
typedef struct element_bodies {
    PyObject *shape, *solid;
} element_bodies;

// A solid's hull is made anew, whatever shape was given beside it: the library takes it for the hull.
static int read_bodies(module_state *state, PyObject *body, PyObject *solid, element_bodies *to) {
    if (Py_TYPE(body) == state->solid && solid == Py_None) solid = body;
    if (solid == Py_None && Py_TYPE(body) == state->shape) {
        to->shape = Py_NewRef(body);
        return 0;
    }
    if (Py_TYPE(solid) != state->solid) {
        PyErr_Format(PyExc_TypeError, "elements: a Shape or a Solid is wanted, not %R",
                     (PyObject *)Py_TYPE(solid == Py_None ? body : solid));
        return -1;
    }
    const ovoid_solid *of = ((solid_object *)solid)->solid;
    ovoid_error error;
    ovoid_shape *hull = ovoid_shape_create_from_points(ovoid_solid_get_points(of),
                                                       (size_t)ovoid_solid_get_report(of).points, NULL, &error);
    to->shape = shape_wrap(state, hull, &error);
    to->solid = Py_NewRef(solid);
    return to->shape ? 0 : -1;
}

// (link, shape, pose, name, solid)
static int read_element(module_state *state, parts *p, PyObject *from, ovoid_robot_element *to,
                        element_bodies *bodies) {
    PyObject *link, *body, *pose = Py_None, *name = Py_None, *solid = Py_None;
    if (!PyTuple_Check(from)) {
        PyErr_Format(PyExc_TypeError, "elements: tuples (link, shape, pose, name) are wanted, not %R",
                     (PyObject *)Py_TYPE(from));
        return -1;
    }
    if (!PyArg_ParseTuple(from, "OO|OOO;elements: (link, shape, pose, name) is wanted", &link, &body, &pose, &name,
                          &solid) ||
        read_index(p->links, p->d.link_count, read_name(p, link, "elements"), "elements", &to->link) ||
        (name != Py_None && !(to->name = read_name(p, name, "elements"))) ||
        pose_read(state, pose, "pose of an element", &to->pose) || read_bodies(state, body, solid, bodies))
        return -1;
    to->shape = ((shape_object *)bodies->shape)->shape;
    if (bodies->solid) to->solid = ((solid_object *)bodies->solid)->solid;
    return 0;
}

// The shapes go to a tuple, the solids behind them; NULL: an exception.
static PyObject *read_elements(module_state *state, parts *p, PyObject *given) {
    PyObject *elements = PySequence_Tuple(given);
    Py_ssize_t count = elements ? PyTuple_Size(elements) : 0;
    PyObject *shapes = elements ? PyTuple_New(2 * count) : NULL;
    p->elements = shapes ? calloc((size_t)count + 1, sizeof *p->elements) : NULL;
    int failed = !p->elements || PyList_Append(p->kept, elements);
    if (shapes && !p->elements) PyErr_NoMemory();
    for (Py_ssize_t i = 0; !failed && i < count; i++) {
        element_bodies bodies = {NULL, NULL};
        failed = read_element(state, p, PyTuple_GetItem(elements, i), &p->elements[i], &bodies);
        PyTuple_SetItem(shapes, i, bodies.shape ? bodies.shape : Py_NewRef(Py_None));
        PyTuple_SetItem(shapes, count + i, bodies.solid ? bodies.solid : Py_NewRef(Py_None));
    }
    Py_XDECREF(elements);
    if (failed) Py_CLEAR(shapes);
    p->d.elements = p->elements;
    p->d.element_count = (size_t)count;
    return shapes;
}

static int read_disabled(parts *p, PyObject *given) {
    PyObject *pairs = PySequence_Tuple(given), *a, *b;
    size_t count = pairs ? (size_t)PyTuple_Size(pairs) : 0;
    p->disabled = pairs ? calloc(count + 1, sizeof *p->disabled) : NULL;
    int failed = !p->disabled || PyList_Append(p->kept, pairs);
    if (pairs && !p->disabled) PyErr_NoMemory();
    for (size_t i = 0; !failed && i < count; i++) {
        PyObject *pair = PyTuple_GetItem(pairs, (Py_ssize_t)i), *reason = Py_None;
        failed = !PyTuple_Check(pair);
        if (failed)
            PyErr_SetString(PyExc_TypeError, "disabled: tuples of two links' names are wanted");
        else
            failed =
                !PyArg_ParseTuple(pair, "OO|O;disabled: two links are wanted, and perhaps why", &a, &b, &reason) ||
                (reason != Py_None && !(p->disabled[i].reason = read_name(p, reason, "disabled"))) ||
                read_index(p->links, p->d.link_count, read_name(p, a, "disabled"), "disabled", &p->disabled[i].a) ||
                read_index(p->links, p->d.link_count, read_name(p, b, "disabled"), "disabled", &p->disabled[i].b);
    }
    Py_XDECREF(pairs);
    p->d.disabled = p->disabled;
    p->d.disabled_count = count;
    return failed ? -1 : 0;
}

// ---- shapes that belong to something else

PyObject *robot_shapes_make(module_state *state, const ovoid_robot_description *d, PyObject *owner) {
    PyObject *shapes = PyTuple_New((Py_ssize_t)d->element_count), *made = PyDict_New();
    for (size_t i = 0; shapes && made && i < d->element_count; i++) {
        PyObject *key = PyLong_FromVoidPtr((void *)d->elements[i].shape);
        PyObject *shape = key ? Py_XNewRef(PyDict_GetItemWithError(made, key)) : NULL;
        if (key && !shape && !PyErr_Occurred()) {
            shape = shape_borrow(state, d->elements[i].shape, owner);
            if (shape && PyDict_SetItem(made, key, shape)) Py_CLEAR(shape);
        }
        Py_XDECREF(key);
        if (!shape)
            Py_CLEAR(shapes);
        else
            PyTuple_SetItem(shapes, (Py_ssize_t)i, shape);
    }
    if (!made) Py_CLEAR(shapes);
    Py_XDECREF(made);
    return shapes;
}

// ---- the constructor

PyObject *robot_new(PyTypeObject *type, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"links", "joints", "elements", "disabled", "name", NULL};
    module_state *state = state_of_type((PyObject *)type);
    PyObject *links, *joints, *elements, *disabled, *nothing = PyTuple_New(0), *shapes = NULL, *made = NULL;
    elements = disabled = nothing;
    parts p = {.kept = PyList_New(0)};
    ovoid_error error;
    if (nothing && p.kept &&
        arguments_read(arguments, keywords, "OO|OO$z:Robot", names, &links, &joints, &elements, &disabled, &p.d.name) &&
        !read_links(&p, links) && !read_joints(state, &p, joints) && (shapes = read_elements(state, &p, elements))) {
        if (!read_disabled(&p, disabled))
            made = robot_wrap(type, ovoid_robot_create(&p.d, NULL, &error), Py_NewRef(shapes), PyDict_New(), &error);
        Py_DECREF(shapes);
    }
    Py_XDECREF(nothing);
    free_parts(&p);
    return made;
}
