// Robot: links that hang on joints, where they are for given joint numbers. Made of tuples in robot_create.c, of files
// in robot_file.c; robot_facts.c has its attributes.
#include "src/robot/robot.h"

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

static int is_named_state(PyObject *from) { return PyUnicode_Check(from) || PyDict_Check(from); }

// The numbers of a name or a dict; of all else itself.
static PyObject *resolve_one(const robot_object *self, PyObject *from) {
    return is_named_state(from) ? PyObject_CallMethod((PyObject *)self, "q", "O", from) : Py_NewRef(from);
}

static PyObject *resolve_states(const robot_object *self, PyObject *from) {
    int is_list = PyList_Check(from) || PyTuple_Check(from), has_named = 0;
    Py_ssize_t count = is_list ? PySequence_Size(from) : 0;
    PyObject *list = is_list ? PySequence_Tuple(from) : NULL;
    if (is_list && !list) return NULL;
    for (Py_ssize_t i = 0; i < count && !has_named; i++) has_named = is_named_state(PyTuple_GetItem(list, i));
    PyObject *made = has_named ? PyList_New(0) : resolve_one(self, from);
    for (Py_ssize_t i = 0; i < count && has_named && made; i++) {
        PyObject *one = resolve_one(self, PyTuple_GetItem(list, i));
        if (!one || PyList_Append(made, one)) Py_CLEAR(made);
        Py_XDECREF(one);
    }
    Py_XDECREF(list);
    return made;
}

// States of so many axes; 0: as many as are given.
static int read_axes(const robot_object *self, PyObject *from, const char *what, int *axes, items *states) {
    Py_ssize_t count = (Py_ssize_t)robot_variable_count(self);
    PyObject *given = resolve_states(self, from);
    if (!given) return -1;
    if (!*axes) *axes = array_axes(given);
    int failed = items_read(state_of((PyObject *)self), given, what, *axes,
                            *axes == 1 ? (Py_ssize_t[]){count} : (Py_ssize_t[]){-1, count}, 'd', states);
    Py_DECREF(given);
    return failed;
}

int states_read(const robot_object *self, PyObject *from, const char *what, int *axes, items *states) {
    *axes = 0;
    return read_axes(self, from, what, axes, states);
}

int state_rows_read(const robot_object *self, PyObject *from, const char *what, items *states) {
    int axes = 2;
    return read_axes(self, from, what, &axes, states);
}

double *state_read(const robot_object *self, PyObject *from) {
    items state;
    int axes = 1;
    return read_axes(self, from, "q", &axes, &state) ? NULL : state.data;
}

// ---- where its links are

static ovoid_code compute_poses(const ovoid_robot *robot, const items *q, Py_ssize_t count, ovoid_pose *poses,
                                ovoid_error *error) {
    ovoid_code code;
    Py_BEGIN_ALLOW_THREADS;
    code = ovoid_robot_compute_poses_batch(robot, &(ovoid_robot_pose_batch){q->data, (size_t)count, poses}, error);
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
    if (!arguments_read(arguments, keywords, "O|$z:poses", names, &given, &order)) return NULL;
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
    if (array && ovoid_robot_compute_poses(self->robot, q, found, &error) != OVOID_OK) {
        Py_CLEAR(array);
        raise_error(state, &error);
    }
    if (array) ovoid_robot_compute_pose_errors(self->robot, q, found, errors);
    free(found);
    free(q);
    return array_wrap(state, array);
}
_Static_assert(sizeof(ovoid_robot_pose_error) == 2 * sizeof(double), "a row of two numbers");

static PyObject *validate_limits(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"q", "slack", NULL};
    PyObject *given;
    double slack = 0;
    if (!arguments_read(arguments, keywords, "O|d:validate_limits", names, &given, &slack)) return NULL;
    module_state *state = state_of(object);
    if (!(slack >= 0)) return raise_code(state, OVOID_ERROR_ARGUMENT, -1, "slack: a number >= 0 is wanted");
    double *q = state_read((robot_object *)object, given);
    if (!q) return NULL;
    ovoid_error error;
    ovoid_code code = ovoid_robot_validate_limits(get(object), q, slack, &error);
    free(q);
    return none_or_raise(state, code, &error);
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

static PyObject *repr(PyObject *self) {
    ovoid_robot_description d = ovoid_robot_get_description(get(self));
    PyObject *name = robot_name_make(d.name);
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
     "poses(q: StatesLike, *, order: Order = None) -> Floats\n--\n\nWhere the links are, in the root link's frame: of "
     "one "
     "state (variables,) an array (links, 4, 4), of many (n, variables)\n(n, links, 4, 4). order 'wxyz' or 'xyzw': x y "
     "z and a quaternion instead, (..., 7). Limits are not looked at."},
    {"pose_errors", pose_errors, METH_O,
     "pose_errors(q: StateLike, /) -> Floats\n--\n\nHow far the poses of one state are from the exact kinematics at "
     "most: an array (links, 2), of the origin (a length) and\nof the rotation (operator norm)."},
    {"validate_limits", METHOD_KEYWORDS(validate_limits), METH_VARARGS | METH_KEYWORDS,
     "validate_limits(q: StateLike, slack: float = 0) -> None\n--\n\nRaises Error, place the variable, where one is "
     "outside its limits by more than slack."},
    {"is_rigid_pair", is_rigid_pair, METH_VARARGS,
     "is_rigid_pair(a: LinkLike, b: LinkLike, /) -> bool\n--\n\nTrue where nothing but fixed joints is between two "
     "links (names or indices)."},
    {"find_link", find_link, METH_O, "find_link(name: LinkLike, /) -> int\n--\n\nThe index of a link."},
    {"find_joint", find_joint, METH_O, "find_joint(name: str, /) -> int\n--\n\nThe index of a joint."},
    {"parent_joint", parent_joint, METH_O,
     "parent_joint(link: LinkLike, /) -> int | None\n--\n\nThe index of the joint whose child a link is; None for the "
     "root."},
    {"joint_variable", joint_variable, METH_O,
     "joint_variable(joint: str, /) -> int | None\n--\n\nThe first variable that moves a joint, which may be that of "
     "the joint it mimics; None: it is fixed."},
    {NULL, NULL, 0, NULL}};

static PyType_Slot slots[] = {
    {Py_tp_doc,
     "Robot(links: Sequence[str], joints: Sequence[Joint], elements: Sequence[tuple[Any, ...]] = (), disabled: "
     "Sequence[tuple[Any, ...]] = (), *, name: str | None = None) -> Robot\n--\n\nLinks that hang on joints. "
     "Robot.read reads a URDF.\n\nlinks: names. joints: Joint tuples, which make one tree of all links; mimic names "
     "another joint. elements:\n(link, shape, pose, name) each, pose and name may be left out; a Solid may be in the "
     "place "
     "of the shape. disabled: pairs of names.\nLengths are the caller's unit, angles radians. Immutable; a Cell says "
     "what it touches."},
    {Py_tp_new, robot_new},
    {Py_tp_dealloc, robot_dealloc},
    {Py_tp_repr, repr},
    {Py_tp_methods, NULL},
    {Py_tp_getset, robot_fields},
    {0, NULL}};
static PyType_Spec spec = {"ovoid.Robot", sizeof(robot_object), 0, Py_TPFLAGS_DEFAULT, slots};

int robot_add(PyObject *module) {
    static PyMethodDef all[24], more[24], own[24];
    slots_set_methods(slots, more, robot_spheres_methods, robot_matrix_methods);
    slots_set_methods(slots, own, own_methods, robot_facts_methods);
    slots_set_methods(slots, all, own, more);
#ifdef OVOID_PYTHON_ROBOT_READ
    static PyMethodDef with_files[24];
    slots_set_methods(slots, with_files, all, robot_constructors);
    if (functions_add(module, robot_file_functions) || functions_add(module, robot_message_functions)) return -1;
#endif
    return type_add(module, &spec, &state_of_module(module)->robot);
}
