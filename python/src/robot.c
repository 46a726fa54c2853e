// Robot: links that hang on joints, where they are for given joint numbers. Made of tuples here, of files in
// robot_file.c.
#include "src/robot.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const ovoid_robot *get(PyObject *self) { return ((robot_object *)self)->robot; }
size_t robot_variable_count(const robot_object *self) { return ovoid_robot_get_variable_count(self->robot); }

// ---- making

PyObject *robot_wrap(PyTypeObject *type, ovoid_robot *robot, PyObject *shapes, PyObject *facts,
                     const ovoid_error *error) {
    robot_object *self = robot && shapes && facts ? object_make(type) : NULL;
    if (!self) {
        if (!robot) raise_error(state_of_type((PyObject *)type), error);
        ovoid_robot_destroy(robot);
        Py_XDECREF(shapes);
        Py_XDECREF(facts);
        return NULL;
    }
    self->robot = robot;
    self->shapes = shapes;
    self->facts = facts;
    return (PyObject *)self;
}

static void robot_dealloc(PyObject *object) {
    robot_object *self = (robot_object *)object;
    ovoid_robot_destroy(self->robot);
    Py_XDECREF(self->shapes);
    Py_XDECREF(self->facts);
    object_free(object);
}

int robot_read(module_state *state, PyObject *from, const char *what, robot_object **to) {
    if (Py_TYPE(from) != state->robot) {
        PyErr_Format(PyExc_TypeError, "%s: a Robot is wanted, not %R", what, (PyObject *)Py_TYPE(from));
        return -1;
    }
    *to = (robot_object *)from;
    return 0;
}

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

// (link, shape, pose, name)
static int read_element(module_state *state, parts *p, PyObject *from, ovoid_robot_element *to, PyObject **shape) {
    PyObject *link, *pose = Py_None, *name = Py_None;
    if (!PyTuple_Check(from)) {
        PyErr_Format(PyExc_TypeError, "elements: tuples (link, shape, pose, name) are wanted, not %R",
                     (PyObject *)Py_TYPE(from));
        return -1;
    }
    if (!PyArg_ParseTuple(from, "OO|OO;elements: (link, shape, pose, name) is wanted", &link, shape, &pose, &name) ||
        read_index(p->links, p->d.link_count, read_name(p, link, "elements"), "elements", &to->link))
        return -1;
    if (Py_TYPE(*shape) != state->shape) {
        PyErr_Format(PyExc_TypeError, "elements: a Shape is wanted, not %R", (PyObject *)Py_TYPE(*shape));
        return -1;
    }
    to->shape = ((shape_object *)*shape)->shape;
    if (name != Py_None && !(to->name = read_name(p, name, "elements"))) return -1;
    return pose_read(state, pose, "pose of an element", &to->pose);
}

// The shapes go to a tuple; NULL: an exception.
static PyObject *read_elements(module_state *state, parts *p, PyObject *given) {
    PyObject *elements = PySequence_Tuple(given), *shape;
    Py_ssize_t count = elements ? PyTuple_Size(elements) : 0;
    PyObject *shapes = elements ? PyTuple_New(count) : NULL;
    p->elements = shapes ? calloc((size_t)count + 1, sizeof *p->elements) : NULL;
    int failed = !p->elements || PyList_Append(p->kept, elements);
    if (shapes && !p->elements) PyErr_NoMemory();
    for (Py_ssize_t i = 0; !failed && i < count; i++) {
        failed = read_element(state, p, PyTuple_GetItem(elements, i), &p->elements[i], &shape);
        if (!failed) PyTuple_SetItem(shapes, i, Py_NewRef(shape));
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
        PyObject *pair = PyTuple_GetItem(pairs, (Py_ssize_t)i);
        failed = !PyTuple_Check(pair);
        if (failed)
            PyErr_SetString(PyExc_TypeError, "disabled: tuples of two links' names are wanted");
        else
            failed =
                !PyArg_ParseTuple(pair, "OO;disabled: two links are wanted", &a, &b) ||
                read_index(p->links, p->d.link_count, read_name(p, a, "disabled"), "disabled", &p->disabled[i].a) ||
                read_index(p->links, p->d.link_count, read_name(p, b, "disabled"), "disabled", &p->disabled[i].b);
    }
    Py_XDECREF(pairs);
    p->d.disabled = p->disabled;
    p->d.disabled_count = count;
    return failed ? -1 : 0;
}

static PyObject *robot_new(PyTypeObject *type, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"links", "joints", "elements", "disabled", "name", NULL};
    module_state *state = state_of_type((PyObject *)type);
    PyObject *links, *joints, *elements, *disabled, *nothing = PyTuple_New(0), *shapes = NULL, *made = NULL;
    elements = disabled = nothing;
    parts p = {.kept = PyList_New(0)};
    ovoid_error error;
    if (nothing && p.kept &&
        PyArg_ParseTupleAndKeywords(arguments, keywords, "OO|OO$z:Robot", names, &links, &joints, &elements, &disabled,
                                    &p.d.name) &&
        !read_links(&p, links) && !read_joints(state, &p, joints) && (shapes = read_elements(state, &p, elements))) {
        if (!read_disabled(&p, disabled))
            made = robot_wrap(type, ovoid_robot_create(&p.d, NULL, &error), Py_NewRef(shapes), PyDict_New(), &error);
        Py_DECREF(shapes);
    }
    Py_XDECREF(nothing);
    free_parts(&p);
    return made;
}

// ---- links and states as arguments

int link_read(const robot_object *self, PyObject *from, uint32_t *to) {
    module_state *state = state_of((PyObject *)self);
    size_t count = ovoid_robot_get_description(self->robot).link_count;
    if (PyUnicode_Check(from)) {
        const char *name = PyUnicode_AsUTF8AndSize(from, NULL);
        if (!name) return -1;
        *to = ovoid_robot_find_link(self->robot, name);
        if (*to != OVOID_ROBOT_NONE) return 0;
        raise_code(state, OVOID_ERROR_INDEX, -1, "the robot has no link %R", from);
        return -1;
    }
    if (!PyIndex_Check(from)) {
        PyErr_Format(PyExc_TypeError, "a link's name or index is wanted, not %R", (PyObject *)Py_TYPE(from));
        return -1;
    }
    Py_ssize_t index = PyNumber_AsSsize_t(from, NULL);
    if (index == -1 && PyErr_Occurred()) return -1;
    *to = (uint32_t)index;
    if (index >= 0 && (size_t)index < count) return 0;
    raise_code(state, OVOID_ERROR_INDEX, -1, "link %R: the robot has %zu", from, count);
    return -1;
}

int states_read(const robot_object *self, PyObject *from, const char *what, int *axes, items *states) {
    Py_ssize_t count = (Py_ssize_t)robot_variable_count(self);
    *axes = array_axes(from);
    return items_read(state_of((PyObject *)self), from, what, *axes,
                      *axes == 1 ? (Py_ssize_t[]){count} : (Py_ssize_t[]){-1, count}, 'd', states);
}

double *state_read(const robot_object *self, PyObject *from) {
    items state;
    Py_ssize_t count = (Py_ssize_t)robot_variable_count(self);
    return items_read(state_of((PyObject *)self), from, "q", 1, &count, 'd', &state) ? NULL : state.data;
}

// ---- where its links are

static ovoid_code compute_poses(const ovoid_robot *robot, const items *q, Py_ssize_t count, ovoid_pose *poses,
                                ovoid_error *error) {
    ovoid_code code;
    Py_BEGIN_ALLOW_THREADS;
    code = ovoid_robot_compute_poses_batch(robot, q->data, (size_t)count, poses, error);
    Py_END_ALLOW_THREADS;
    return code;
}

// Poses as 4x4 matrices, or as seven numbers: order as in poses_read, NULL for matrices. Of states (axes 2), or of one.
static PyObject *make_pose_array(module_state *state, const ovoid_pose *poses, int axes, Py_ssize_t states,
                                 Py_ssize_t links, const char *order) {
    Py_ssize_t shape[] = {states, links, order ? 7 : 4, 4}, count = states * links;
    double *to = NULL;
    int skipped = axes == 1;
    PyObject *array = array_make(state, RECORD_DOUBLE, axes + (order ? 1 : 2), shape + skipped, &to);
    for (Py_ssize_t i = 0; array && i < count; i++, to += order ? 7 : 16) {
        ovoid_vec3 x = poses[i].position;
        ovoid_quat r = poses[i].rotation;
        if (!order)
            ovoid_pose_compute_transform(&poses[i], to);
        else if (order[0] == 'w')
            memcpy(to, (double[]){x.x, x.y, x.z, r.w, r.x, r.y, r.z}, 7 * sizeof *to);
        else
            memcpy(to, (double[]){x.x, x.y, x.z, r.x, r.y, r.z, r.w}, 7 * sizeof *to);
    }
    return array_wrap(state, array);
}

static PyObject *poses(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"q", "order", NULL};
    robot_object *self = (robot_object *)object;
    module_state *state = state_of(object);
    PyObject *given, *made = NULL;
    const char *order = NULL;
    items q;
    int axes;
    if (!PyArg_ParseTupleAndKeywords(arguments, keywords, "O|$z:poses", names, &given, &order)) return NULL;
    if (order && strcmp(order, "wxyz") != 0 && strcmp(order, "xyzw") != 0)
        return raise_code(state, OVOID_ERROR_ARGUMENT, -1, "poses: order is None (4x4), 'wxyz' or 'xyzw'");
    if (states_read(self, given, "q", &axes, &q)) return NULL;
    Py_ssize_t count = axes == 1 ? 1 : q.shape[0],
               links = (Py_ssize_t)ovoid_robot_get_description(self->robot).link_count;
    ovoid_error error;
    ovoid_pose *found = (size_t)count > PY_SSIZE_T_MAX / sizeof *found / (size_t)links
                            ? NULL
                            : malloc((size_t)(count * links + 1) * sizeof *found);
    if (!found)
        PyErr_NoMemory();
    else if (compute_poses(self->robot, &q, count, found, &error) != OVOID_OK)
        raise_error(state, &error);
    else
        made = make_pose_array(state, found, axes, count, links, order);
    free(found);
    free(q.data);
    return made;
}

static PyObject *pose_errors(PyObject *object, PyObject *given) {
    robot_object *self = (robot_object *)object;
    module_state *state = state_of(object);
    double *q = state_read(self, given);
    if (!q) return NULL;
    Py_ssize_t links = (Py_ssize_t)ovoid_robot_get_description(self->robot).link_count;
    ovoid_pose *found = malloc((size_t)links * sizeof *found);
    ovoid_error error;
    void *errors = NULL;
    PyObject *array = found ? array_make(state, RECORD_DOUBLE, 2, (Py_ssize_t[]){links, 2}, &errors) : PyErr_NoMemory();
    if (array && ovoid_robot_compute_poses(self->robot, q, found, errors, &error) != OVOID_OK) {
        Py_CLEAR(array);
        raise_error(state, &error);
    }
    free(found);
    free(q);
    return array_wrap(state, array);
}
_Static_assert(sizeof(ovoid_robot_pose_error) == 2 * sizeof(double), "a row of two numbers");

static PyObject *check_limits(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"q", "slack", NULL};
    PyObject *given;
    double slack = 0;
    if (!PyArg_ParseTupleAndKeywords(arguments, keywords, "O|d:check_limits", names, &given, &slack)) return NULL;
    module_state *state = state_of(object);
    if (!(slack >= 0)) return raise_code(state, OVOID_ERROR_ARGUMENT, -1, "slack: a number >= 0 is wanted");
    double *q = state_read((robot_object *)object, given);
    if (!q) return NULL;
    ovoid_error error;
    ovoid_code code = ovoid_robot_check_limits(get(object), q, slack, &error);
    free(q);
    return code == OVOID_OK ? Py_NewRef(Py_None) : raise_error(state, &error);
}

// ---- what it is made of

static PyObject *is_rigid_pair(PyObject *object, PyObject *arguments) {
    robot_object *self = (robot_object *)object;
    PyObject *first, *second;
    uint32_t a, b;
    if (!PyArg_ParseTuple(arguments, "OO:is_rigid_pair", &first, &second) || link_read(self, first, &a) ||
        link_read(self, second, &b))
        return NULL;
    return PyBool_FromLong(ovoid_robot_is_rigid_pair(self->robot, a, b));
}

static PyObject *find_link(PyObject *object, PyObject *given) {
    uint32_t link;
    return link_read((robot_object *)object, given, &link) ? NULL : PyLong_FromUnsignedLong(link);
}

static PyObject *find_joint(PyObject *object, PyObject *given) {
    const char *name = PyUnicode_Check(given) ? PyUnicode_AsUTF8AndSize(given, NULL) : NULL;
    if (!name)
        return PyErr_Occurred() ? NULL : PyErr_Format(PyExc_TypeError, "a joint's name is wanted, not %R", given);
    uint32_t joint = ovoid_robot_find_joint(get(object), name);
    if (joint != OVOID_ROBOT_NONE) return PyLong_FromUnsignedLong(joint);
    return raise_code(state_of(object), OVOID_ERROR_INDEX, -1, "the robot has no joint %R", given);
}

// An index, or None.
static PyObject *make_index(uint32_t index) {
    return index == OVOID_ROBOT_NONE ? Py_NewRef(Py_None) : PyLong_FromUnsignedLong(index);
}

static PyObject *parent_joint(PyObject *object, PyObject *given) {
    uint32_t link;
    if (link_read((robot_object *)object, given, &link)) return NULL;
    return make_index(ovoid_robot_get_parent_joint(get(object), link));
}

static PyObject *joint_variable(PyObject *object, PyObject *given) {
    PyObject *found = find_joint(object, given);
    if (!found) return NULL;
    uint32_t joint = (uint32_t)PyLong_AsUnsignedLong(found);
    Py_DECREF(found);
    return make_index(ovoid_robot_get_joint_variable(get(object), joint));
}

// Names need not be UTF-8.
static PyObject *make_name(const char *name) {
    if (!name) return Py_NewRef(Py_None);
    return PyUnicode_DecodeUTF8(name, (Py_ssize_t)strlen(name), "replace");
}

static PyObject *get_name(PyObject *self, void *closure) {
    (void)closure;
    return make_name(ovoid_robot_get_description(get(self)).name);
}

static PyObject *get_root(PyObject *self, void *closure) {
    (void)closure;
    return make_name(ovoid_robot_get_description(get(self)).links[ovoid_robot_get_root(get(self))].name);
}

// A tuple of count objects, each made by make(self, i).
static PyObject *make_tuple(PyObject *self, size_t count, PyObject *(*make)(PyObject *self, size_t i)) {
    PyObject *made = PyTuple_New((Py_ssize_t)count);
    for (size_t i = 0; made && i < count; i++) {
        PyObject *one = make(self, i);
        if (!one)
            Py_CLEAR(made);
        else
            PyTuple_SetItem(made, (Py_ssize_t)i, one);
    }
    return made;
}

static PyObject *make_link(PyObject *self, size_t i) {
    return make_name(ovoid_robot_get_description(get(self)).links[i].name);
}

static PyObject *make_joint(PyObject *self, size_t i) {
    module_state *state = state_of(self);
    ovoid_robot_description d = ovoid_robot_get_description(get(self));
    const ovoid_robot_joint *j = &d.joints[i];
    return PyObject_CallFunction(state->joint, "NsNNNNdddNdd", make_name(j->name), ovoid_joint_type_get_name(j->type),
                                 make_link(self, j->parent), make_link(self, j->child), pose_wrap(state, j->origin),
                                 vec3_make(j->axis), j->lower, j->upper, j->velocity,
                                 make_name(j->mimic == OVOID_ROBOT_NONE ? NULL : d.joints[j->mimic].name),
                                 j->multiplier, j->offset);
}

// "shoulder", or of a joint of several variables "floor/x".
static PyObject *make_variable_name(const ovoid_robot_joint *joint, uint32_t component) {
    static const char *const planar[] = {"x", "y", "angle"}, *const floating[] = {"x",  "y",  "z", "qw",
                                                                                  "qx", "qy", "qz"};
    PyObject *name = make_name(joint->name);
    if (!name || ovoid_joint_type_get_variable_count(joint->type) == 1) return name;
    PyObject *made = PyUnicode_FromFormat("%U/%s", name,
                                          joint->type == OVOID_JOINT_PLANAR ? planar[component] : floating[component]);
    Py_DECREF(name);
    return made;
}

static PyObject *make_variable(PyObject *self, size_t i) {
    ovoid_robot_variable v = ovoid_robot_get_variable(get(self), i);
    const ovoid_robot_joint *joint = &ovoid_robot_get_description(get(self)).joints[v.joint];
    return PyObject_CallFunction(state_of(self)->variable, "NNIddd", make_variable_name(joint, v.component),
                                 make_name(joint->name), v.component, v.lower, v.upper, v.velocity);
}

static PyObject *make_element(PyObject *self, size_t i) {
    const ovoid_robot_element *e = &ovoid_robot_get_description(get(self)).elements[i];
    PyObject *shape = PyTuple_GetItem(((robot_object *)self)->shapes, (Py_ssize_t)i);
    return PyObject_CallFunction(state_of(self)->element, "NONN", make_link(self, e->link), shape,
                                 pose_wrap(state_of(self), e->pose), make_name(e->name));
}

static PyObject *make_disabled(PyObject *self, size_t i) {
    ovoid_robot_pair pair = ovoid_robot_get_description(get(self)).disabled[i];
    return Py_BuildValue("NNN", make_link(self, pair.a), make_link(self, pair.b), make_name(pair.reason));
}

static PyObject *get_links(PyObject *self, void *closure) {
    (void)closure;
    return make_tuple(self, ovoid_robot_get_description(get(self)).link_count, make_link);
}
static PyObject *get_joints(PyObject *self, void *closure) {
    (void)closure;
    return make_tuple(self, ovoid_robot_get_description(get(self)).joint_count, make_joint);
}
static PyObject *get_variables(PyObject *self, void *closure) {
    (void)closure;
    return make_tuple(self, ovoid_robot_get_variable_count(get(self)), make_variable);
}
static PyObject *get_elements(PyObject *self, void *closure) {
    (void)closure;
    return make_tuple(self, ovoid_robot_get_description(get(self)).element_count, make_element);
}
static PyObject *get_disabled(PyObject *self, void *closure) {
    (void)closure;
    return make_tuple(self, ovoid_robot_get_description(get(self)).disabled_count, make_disabled);
}

// The lower limits of all variables, or with a closure the upper ones.
static PyObject *get_limits(PyObject *self, void *closure) {
    Py_ssize_t count = (Py_ssize_t)ovoid_robot_get_variable_count(get(self));
    double *to = NULL;
    PyObject *array = array_make(state_of(self), RECORD_DOUBLE, 1, &count, &to);
    for (Py_ssize_t i = 0; array && i < count; i++) {
        ovoid_robot_variable v = ovoid_robot_get_variable(get(self), (size_t)i);
        to[i] = closure ? v.upper : v.lower;
    }
    return array_wrap(state_of(self), array);
}

static PyObject *get_fact(PyObject *self, void *closure) {
    PyObject *found = PyDict_GetItemString(((robot_object *)self)->facts, closure);
    return found ? Py_NewRef(found) : PyTuple_New(0);
}

static PyObject *get_fixed_mimics(PyObject *self, void *closure) {
    (void)closure;
    PyObject *found = PyDict_GetItemString(((robot_object *)self)->facts, "fixed_mimics");
    return found ? Py_NewRef(found) : PyLong_FromLong(0);
}

static PyObject *repr(PyObject *self) {
    ovoid_robot_description d = ovoid_robot_get_description(get(self));
    PyObject *name = make_name(d.name);
    PyObject *text = name ? PyUnicode_FromFormat("<ovoid.Robot %R: %zu links, %zu joints, %zu variables, %zu elements>",
                                                 name, d.link_count, d.joint_count,
                                                 ovoid_robot_get_variable_count(get(self)), d.element_count)
                          : NULL;
    Py_XDECREF(name);
    return text;
}

// ---- the type

static PyMethodDef own_methods[] = {
    {"poses", METHOD_KEYWORDS(poses), METH_VARARGS | METH_KEYWORDS,
     "poses(q, *, order=None)\n--\n\nWhere the links are, in the root link's frame: of one state (variables,) an array "
     "(links, 4, 4), of many (n, variables)\n(n, links, 4, 4). order 'wxyz' or 'xyzw': x y z and a quaternion instead, "
     "(..., 7). Limits are not looked at."},
    {"pose_errors", pose_errors, METH_O,
     "pose_errors(q)\n--\n\nHow far the poses of one state are from the exact kinematics at most: an array (links, 2), "
     "of the origin (a length) and\nof the rotation (operator norm)."},
    {"check_limits", METHOD_KEYWORDS(check_limits), METH_VARARGS | METH_KEYWORDS,
     "check_limits(q, slack=0)\n--\n\nRaises Error, place the variable, where one is outside its limits by more than "
     "slack."},
    {"is_rigid_pair", is_rigid_pair, METH_VARARGS,
     "is_rigid_pair(a, b, /)\n--\n\nTrue where nothing but fixed joints is between two links (names or indices)."},
    {"find_link", find_link, METH_O, "find_link(name, /)\n--\n\nThe index of a link."},
    {"find_joint", find_joint, METH_O, "find_joint(name, /)\n--\n\nThe index of a joint."},
    {"parent_joint", parent_joint, METH_O,
     "parent_joint(link, /)\n--\n\nThe index of the joint whose child a link is; None for the root."},
    {"joint_variable", joint_variable, METH_O,
     "joint_variable(joint, /)\n--\n\nThe first variable that moves a joint, which may be that of the joint it mimics; "
     "None: it is fixed."},
    {NULL, NULL, 0, NULL}};

static PyGetSetDef fields[] = {
    {"name", get_name, NULL, "The robot's name, or None.", NULL},
    {"root", get_root, NULL, "The name of the link that is no joint's child.", NULL},
    {"links", get_links, NULL, "The links' names.", NULL},
    {"joints", get_joints, NULL, "The joints: Joint tuples.", NULL},
    {"variables", get_variables, NULL, "What the numbers of a state are: Variable tuples.", NULL},
    {"elements", get_elements, NULL, "The convex parts of the links: Element tuples.", NULL},
    {"disabled", get_disabled, NULL, "Pairs of links that are never queried: (a, b, reason), sorted.", NULL},
    {"lower", get_limits, NULL, "The variables' lower limits, an array; -inf where there is none.", NULL},
    {"upper", get_limits, NULL, "The variables' upper limits, an array; inf where there is none.", ""},
    {"groups", get_fact, NULL, "Of an SRDF: (name, joints, links) of each group, names.", "groups"},
    {"states", get_fact, NULL, "Of an SRDF: (name, group, {joint: numbers}) of each named state.", "states"},
    {"spheres", get_fact, NULL, "Of an SRDF: (link, (x, y, z), radius), in the link's frame.", "spheres"},
    {"passive", get_fact, NULL, "Of an SRDF: the passive joints' names.", "passive"},
    {"meshes", get_fact, NULL, "Of a URDF: a dict for each mesh file at each scale.", "meshes"},
    {"ignored", get_fact, NULL, "Of the files: (where, how often) of what had no effect.", "ignored"},
    {"fixed_mimics", get_fixed_mimics, NULL, "Of a URDF: how many mimics stood on fixed joints and were dropped.",
     NULL},
    {NULL, NULL, NULL, NULL, NULL}};

static PyType_Slot slots[] = {
    {Py_tp_doc,
     "Robot(links, joints, elements=(), disabled=(), *, name=None)\n--\n\nLinks that hang on joints. Robot.load reads "
     "a URDF.\n\nlinks: names. joints: Joint tuples, which make one tree of all links; mimic names another joint. "
     "elements:\n(link, shape, pose, name) each, pose and name may be left out. disabled: pairs of names. Lengths are "
     "the caller's\nunit, angles radians. Immutable; a Cell says what it touches."},
    {Py_tp_new, robot_new},
    {Py_tp_dealloc, robot_dealloc},
    {Py_tp_repr, repr},
    {Py_tp_methods, NULL},
    {Py_tp_getset, fields},
    {0, NULL}};
static PyType_Spec spec = {"ovoid.Robot", sizeof(robot_object), 0, Py_TPFLAGS_DEFAULT | Py_TPFLAGS_IMMUTABLETYPE,
                           slots};

int robot_add(PyObject *module) {
    static PyMethodDef all[24], more[24];
    slots_set_methods(slots, more, robot_spheres_methods, robot_matrix_methods);
    slots_set_methods(slots, all, own_methods, more);
#ifdef OVOID_PYTHON_ROBOT_READ
    static PyMethodDef with_files[24];
    slots_set_methods(slots, with_files, all, robot_constructors);
    if (PyModule_AddFunctions(module, robot_file_functions)) return -1;
#endif
    return type_add(module, &spec, &state_of_module(module)->robot);
}
