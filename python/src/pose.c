// Poses: where a body is. What can be read in two ways (the order of four numbers) has to be named.
#include "src/module.h"

#include <stdlib.h>
#include <string.h>

PyObject *pose_wrap(module_state *state, ovoid_pose pose) {
    pose_object *self = object_make(state->pose);
    if (self) self->pose = pose;
    return (PyObject *)self;
}

// A pose made of numbers that are checked here: what it is wrong with it, as an exception.
static int validate_pose(module_state *state, const char *what, Py_ssize_t place, const ovoid_pose *pose) {
    ovoid_code code = ovoid_pose_validate(pose);
    if (code == OVOID_OK) return 0;
    const char *why = code == OVOID_ERROR_ROTATION ? "the quaternion is zero"
                      : code == OVOID_ERROR_RANGE  ? "the position or the quaternion is out of range"
                                                   : "a number is NaN or infinite";
    if (place < 0)
        raise_code(state, code, place, "%s: %s", what, why);
    else
        raise_code(state, code, place, "%s %zd: %s", what, place, why);
    return -1;
}

static ovoid_pose make_pose(ovoid_vec3 xyz, const double q[4], int is_xyzw) {
    ovoid_quat rotation = is_xyzw ? (ovoid_quat){q[3], q[0], q[1], q[2]} : (ovoid_quat){q[0], q[1], q[2], q[3]};
    return (ovoid_pose){xyz, rotation};
}

// ---- reading

static int read_matrix(module_state *state, PyObject *from, const char *what, ovoid_pose *pose) {
    double matrix[16];
    ovoid_error error;
    if (doubles_read(state, from, what, 2, (Py_ssize_t[]){4, 4}, matrix)) return -1;
    if (ovoid_pose_make_transform(matrix, pose, &error) == OVOID_OK) return 0;
    raise_code(state, error.code, (Py_ssize_t)error.place, "%s: %s", what, error.message);
    return -1;
}

// The quaternion of an object like SciPy's Rotation, whose as_quat() is x y z w.
static int read_rotation(module_state *state, PyObject *from, double q[4]) {
    PyObject *given = PyObject_CallMethod(from, "as_quat", NULL);
    int result = given ? doubles_read(state, given, "as_quat()", 1, (Py_ssize_t[]){4}, q) : -1;
    Py_XDECREF(given);
    return result;
}

// 1: what says how a pose is turned, an object like SciPy's Rotation or a 3x3 matrix; 0: its position.
static int is_turn(PyObject *from) { return PyObject_HasAttrString(from, "as_quat") || array_axes(from) == 2; }

static int read_turned(module_state *state, PyObject *xyz, PyObject *turn, ovoid_pose *pose) {
    ovoid_vec3 position;
    double q[4], matrix[9];
    ovoid_error error;
    if (vec3_read(state, xyz, "xyz", &position)) return -1;
    if (PyObject_HasAttrString(turn, "as_quat")) {
        if (read_rotation(state, turn, q)) return -1;
        *pose = make_pose(position, q, 1);
        return validate_pose(state, "as_quat()", -1, pose);
    }
    if (doubles_read(state, turn, "rotation", 2, (Py_ssize_t[]){3, 3}, matrix)) return -1;
    if (ovoid_pose_make_matrix(matrix, position, pose, &error) == OVOID_OK) return 0;
    raise_code(state, error.code, (Py_ssize_t)error.place, "rotation: %s", error.message);
    return -1;
}

// (xyz, rotation) or (rotation, xyz): which is which their shapes say.
static int read_two(module_state *state, PyObject *from, const char *what, ovoid_pose *pose) {
    PyObject *first = PyTuple_GetItem(from, 0), *second = PyTuple_GetItem(from, 1);
    if (is_turn(first) == is_turn(second)) {
        PyErr_Format(PyExc_TypeError,
                     "%s: of two things one is a position, the other a 3x3 matrix or an object with as_quat(), as "
                     "SciPy's Rotation; where it is four numbers, say their order: Pose.from_quaternion(xyz, wxyz=...) "
                     "or xyzw=...",
                     what);
        return -1;
    }
    return is_turn(first) ? read_turned(state, second, first, pose) : read_turned(state, first, second, pose);
}

// A position alone: nothing is turned.
static int read_position(module_state *state, PyObject *from, const char *what, ovoid_pose *pose) {
    *pose = ovoid_pose_make_identity();
    if (PySequence_Size(from) == 7) {
        raise_code(state, OVOID_ERROR_ARGUMENT, -1,
                   "%s: of seven numbers say the order of the quaternion: Pose.from_xyz_wxyz or Pose.from_xyz_xyzw",
                   what);
        return -1;
    }
    PyErr_Clear();
    if (vec3_read(state, from, what, &pose->position)) return -1;
    return validate_pose(state, what, -1, pose);
}

int pose_read(module_state *state, PyObject *from, const char *what, ovoid_pose *pose) {
    if (!from || from == Py_None)
        *pose = ovoid_pose_make_identity();
    else if (Py_TYPE(from) == state->pose)
        *pose = ((pose_object *)from)->pose;
    else if (PyTuple_Check(from) && PyTuple_Size(from) == 2)
        return read_two(state, from, what, pose);
    else if (array_axes(from) == 1)
        return read_position(state, from, what, pose);
    else
        return read_matrix(state, from, what, pose);
    return 0;
}

// 1: x y z w; 0: w x y z; -1: an exception.
static int read_order(module_state *state, const char *order) {
    if (order && !strcmp(order, "wxyz")) return 0;
    if (order && !strcmp(order, "xyzw")) return 1;
    raise_code(state, OVOID_ERROR_ARGUMENT, -1,
               "poses: of an array of shape (n, 7) say the order of the quaternions: order='wxyz' or order='xyzw'");
    return -1;
}

static int fill_sevens(module_state *state, const double *numbers, int is_xyzw, Py_ssize_t count, ovoid_pose *poses) {
    for (Py_ssize_t i = 0; i < count; i++) {
        const double *n = numbers + 7 * i;
        poses[i] = make_pose((ovoid_vec3){n[0], n[1], n[2]}, n + 3, is_xyzw);
        if (validate_pose(state, "pose", i, &poses[i])) return -1;
    }
    return 0;
}

static int fill_matrices(module_state *state, const double *numbers, Py_ssize_t count, ovoid_pose *poses) {
    ovoid_error error;
    for (Py_ssize_t i = 0; i < count; i++)
        if (ovoid_pose_make_transform(numbers + 16 * i, &poses[i], &error) != OVOID_OK) {
            raise_code(state, error.code, i, "pose %zd: %s", i, error.message);
            return -1;
        }
    return 0;
}

static int fill_objects(module_state *state, PyObject *from, Py_ssize_t count, ovoid_pose *poses) {
    for (Py_ssize_t i = 0; i < count; i++) {
        char what[32];
        PyOS_snprintf(what, sizeof what, "pose %zd", i);
        if (pose_read(state, PyTuple_GetItem(from, i), what, &poses[i])) return -1;
    }
    return 0;
}

static int read_pose_array(module_state *state, PyObject *from, const char *order, ovoid_pose **poses,
                           Py_ssize_t *count) {
    int is_matrix = buffer_axes(from) != 2, is_xyzw = 0, result;
    if (!is_matrix && (is_xyzw = read_order(state, order)) < 0) return -1;
    items numbers;
    const Py_ssize_t *wanted = is_matrix ? (Py_ssize_t[]){-1, 4, 4} : (Py_ssize_t[]){-1, 7};
    if (items_read(state, from, "poses", is_matrix ? 3 : 2, wanted, 'd', &numbers)) return -1;
    *count = numbers.shape[0];
    *poses = malloc((size_t)(*count ? *count : 1) * sizeof **poses);
    if (!*poses)
        PyErr_NoMemory(), result = -1;
    else if (is_matrix)
        result = fill_matrices(state, numbers.data, *count, *poses);
    else
        result = fill_sevens(state, numbers.data, is_xyzw, *count, *poses);
    free(numbers.data);
    return result;
}

int poses_read(module_state *state, PyObject *from, const char *order, ovoid_pose **poses, Py_ssize_t *count) {
    *poses = NULL;
    int result;
    if (PyTuple_Check(from) || PyList_Check(from)) {
        PyObject *list = PySequence_Tuple(from);
        if (!list) return -1;
        *count = PyTuple_Size(list);
        *poses = malloc((size_t)(*count ? *count : 1) * sizeof **poses);
        if (!*poses)
            PyErr_NoMemory(), result = -1;
        else
            result = fill_objects(state, list, *count, *poses);
        Py_DECREF(list);
    } else {
        result = read_pose_array(state, from, order, poses, count);
    }
    if (result) {
        free(*poses);
        *poses = NULL;
    }
    return result;
}

// ---- constructors

static PyObject *pose_new(PyTypeObject *type, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"pose", NULL};
    PyObject *from = NULL;
    module_state *state = state_of_type((PyObject *)type);
    ovoid_pose pose;
    if (!arguments_read(arguments, keywords, "|O:Pose", names, &from) || pose_read(state, from, "pose", &pose))
        return NULL;
    return pose_wrap(state, pose);
}

static PyObject *from_translation(PyObject *type, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"xyz", NULL};
    PyObject *xyz;
    module_state *state = state_of_type(type);
    ovoid_pose pose;
    if (!arguments_read(arguments, keywords, "O:from_translation", names, &xyz) ||
        read_position(state, xyz, "xyz", &pose))
        return NULL;
    return pose_wrap(state, pose);
}

static PyObject *from_quaternion(PyObject *type, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"xyz", "wxyz", "xyzw", NULL};
    PyObject *xyz = NULL, *wxyz = NULL, *xyzw = NULL;
    module_state *state = state_of_type(type);
    if (!arguments_read(arguments, keywords, "O|$OO:from_quaternion", names, &xyz, &wxyz, &xyzw)) return NULL;
    if (!wxyz == !xyzw)
        return raise_code(state, OVOID_ERROR_ARGUMENT, -1,
                          "from_quaternion: exactly one of wxyz= and xyzw= is wanted: it names the order");
    ovoid_vec3 position;
    double q[4];
    if (vec3_read(state, xyz, "xyz", &position) ||
        doubles_read(state, wxyz ? wxyz : xyzw, wxyz ? "wxyz" : "xyzw", 1, (Py_ssize_t[]){4}, q))
        return NULL;
    ovoid_pose pose = make_pose(position, q, xyzw != NULL);
    return validate_pose(state, "from_quaternion", -1, &pose) ? NULL : pose_wrap(state, pose);
}

static PyObject *from_rotation(PyObject *type, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"xyz", "rotation", NULL};
    PyObject *xyz, *rotation;
    module_state *state = state_of_type(type);
    if (!arguments_read(arguments, keywords, "OO:from_rotation", names, &xyz, &rotation)) return NULL;
    ovoid_pose pose;
    return read_turned(state, xyz, rotation, &pose) ? NULL : pose_wrap(state, pose);
}

static PyObject *make_of_seven(PyObject *type, PyObject *given, const char *what, int is_xyzw) {
    module_state *state = state_of_type(type);
    double n[7];
    if (doubles_read(state, given, what, 1, (Py_ssize_t[]){7}, n)) return NULL;
    ovoid_pose pose = make_pose((ovoid_vec3){n[0], n[1], n[2]}, n + 3, is_xyzw);
    return validate_pose(state, what, -1, &pose) ? NULL : pose_wrap(state, pose);
}

static PyObject *from_xyz_wxyz(PyObject *type, PyObject *given) {
    return make_of_seven(type, given, "from_xyz_wxyz", 0);
}
static PyObject *from_xyz_xyzw(PyObject *type, PyObject *given) {
    return make_of_seven(type, given, "from_xyz_xyzw", 1);
}

static PyObject *from_rpy(PyObject *type, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"xyz", "rpy", NULL};
    PyObject *first, *second;
    ovoid_vec3 xyz, rpy;
    module_state *state = state_of_type(type);
    if (!arguments_read(arguments, keywords, "OO:from_rpy", names, &first, &second) ||
        vec3_read(state, first, "xyz", &xyz) || vec3_read(state, second, "rpy", &rpy))
        return NULL;
    ovoid_pose pose = ovoid_pose_make_rpy(xyz, rpy);
    return validate_pose(state, "from_rpy", -1, &pose) ? NULL : pose_wrap(state, pose);
}

static PyObject *from_axis_angle(PyObject *type, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"xyz", "axis", "angle", NULL};
    PyObject *first, *second;
    double angle;
    ovoid_vec3 xyz, axis;
    module_state *state = state_of_type(type);
    if (!arguments_read(arguments, keywords, "OOd:from_axis_angle", names, &first, &second, &angle) ||
        vec3_read(state, first, "xyz", &xyz) || vec3_read(state, second, "axis", &axis))
        return NULL;
    ovoid_pose pose;
    ovoid_code code = ovoid_pose_make_axis_angle(xyz, axis, angle, &pose);
    if (code != OVOID_OK)
        return raise_code(state, code, -1, "from_axis_angle: %s",
                          code == OVOID_ERROR_ROTATION ? "the axis is zero" : ovoid_code_get_name(code));
    return pose_wrap(state, pose);
}

// ---- what it is

static const ovoid_pose *get(PyObject *self) { return &((pose_object *)self)->pose; }

static PyObject *get_matrix(PyObject *self, void *closure) {
    (void)closure;
    double matrix[16];
    ovoid_pose_compute_transform(get(self), matrix);
    return array_copy(state_of(self), RECORD_DOUBLE, 2, (Py_ssize_t[]){4, 4}, matrix);
}

static PyObject *get_rotation(PyObject *self, void *closure) {
    (void)closure;
    double m[16];
    ovoid_pose_compute_transform(get(self), m);
    const double rows[9] = {m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]};
    return array_copy(state_of(self), RECORD_DOUBLE, 2, (Py_ssize_t[]){3, 3}, rows);
}

static PyObject *get_seven(PyObject *self, void *closure) {
    ovoid_vec3 p = get(self)->position;
    ovoid_quat q = get(self)->rotation;
    if (closure) return Py_BuildValue("(ddddddd)", p.x, p.y, p.z, q.x, q.y, q.z, q.w);
    return Py_BuildValue("(ddddddd)", p.x, p.y, p.z, q.w, q.x, q.y, q.z);
}

static PyObject *get_quaternion(PyObject *self, void *closure) {
    ovoid_quat q = get(self)->rotation;
    if (closure) return Py_BuildValue("(dddd)", q.x, q.y, q.z, q.w);
    return Py_BuildValue("(dddd)", q.w, q.x, q.y, q.z);
}

static PyObject *inverse(PyObject *self, PyObject *ignored) {
    (void)ignored;
    return pose_wrap(state_of(self), ovoid_pose_compute_inverse(get(self)));
}

// Products may leave the range in which poses are poses.
static PyObject *multiply(PyObject *left, PyObject *right) {
    module_state *state = NULL;
    if (PyType_GetSlot(Py_TYPE(left), Py_nb_matrix_multiply) == (void *)multiply) state = state_of(left);
    if (!state || Py_TYPE(right) != state->pose) Py_RETURN_NOTIMPLEMENTED;
    ovoid_pose product = ovoid_pose_compute_product(get(left), get(right));
    return validate_pose(state, "product", -1, &product) ? NULL : pose_wrap(state, product);
}

static PyObject *move_points(PyObject *self, PyObject *points, ovoid_vec3 (*move)(const ovoid_pose *, ovoid_vec3)) {
    module_state *state = state_of(self);
    items given;
    int axes = array_axes(points);
    const Py_ssize_t *wanted = axes == 1 ? (Py_ssize_t[]){3} : (Py_ssize_t[]){-1, 3};
    if (items_read(state, points, "points", axes, wanted, 'd', &given)) return NULL;
    Py_ssize_t count = axes == 1 ? 1 : given.shape[0];
    double *p = given.data;
    for (Py_ssize_t i = 0; i < count; i++, p += 3) {
        ovoid_vec3 to = move(get(self), (ovoid_vec3){p[0], p[1], p[2]});
        p[0] = to.x, p[1] = to.y, p[2] = to.z;
    }
    PyObject *result = array_copy(state, RECORD_DOUBLE, axes, given.shape, given.data);
    free(given.data);
    return result;
}

static PyObject *apply(PyObject *self, PyObject *points) { return move_points(self, points, ovoid_pose_compute_point); }
static PyObject *apply_inverse(PyObject *self, PyObject *points) {
    return move_points(self, points, ovoid_pose_compute_local_point);
}

static PyObject *compare(PyObject *left, PyObject *right, int operation) {
    if (Py_TYPE(left) != Py_TYPE(right) || (operation != Py_EQ && operation != Py_NE)) Py_RETURN_NOTIMPLEMENTED;
    const ovoid_pose *a = get(left), *b = get(right);
    int same = a->position.x == b->position.x && a->position.y == b->position.y && a->position.z == b->position.z &&
               a->rotation.w == b->rotation.w && a->rotation.x == b->rotation.x && a->rotation.y == b->rotation.y &&
               a->rotation.z == b->rotation.z;
    return PyBool_FromLong(same == (operation == Py_EQ));
}

static PyObject *repr(PyObject *self) {
    PyObject *xyz = vec3_make(get(self)->position), *wxyz = get_quaternion(self, NULL);
    PyObject *text = xyz && wxyz ? PyUnicode_FromFormat("Pose.from_quaternion(%R, wxyz=%R)", xyz, wxyz) : NULL;
    Py_XDECREF(xyz);
    Py_XDECREF(wxyz);
    return text;
}

static PyObject *reduce(PyObject *self, PyObject *ignored) {
    (void)ignored;
    const ovoid_pose *p = get(self);
    PyObject *maker = PyObject_GetAttrString((PyObject *)Py_TYPE(self), "_make");
    return Py_BuildValue("N((ddd)(dddd))", maker, p->position.x, p->position.y, p->position.z, p->rotation.w,
                         p->rotation.x, p->rotation.y, p->rotation.z);
}

static PyObject *make(PyObject *type, PyObject *arguments) {
    ovoid_pose p;
    if (!PyArg_ParseTuple(arguments, "(ddd)(dddd)", &p.position.x, &p.position.y, &p.position.z, &p.rotation.w,
                          &p.rotation.x, &p.rotation.y, &p.rotation.z))
        return NULL;
    module_state *state = state_of_type(type);
    return validate_pose(state, "pose", -1, &p) ? NULL : pose_wrap(state, p);
}

static PyMethodDef methods[] = {
    {"from_translation", METHOD_KEYWORDS(from_translation), METH_VARARGS | METH_KEYWORDS | METH_CLASS,
     "from_translation(xyz: Numbers) -> Pose\n--\n\nFrom a position; nothing is turned. Three numbers mean this "
     "wherever a pose is wanted."},
    {"from_quaternion", METHOD_KEYWORDS(from_quaternion), METH_VARARGS | METH_KEYWORDS | METH_CLASS,
     "from_quaternion(xyz: Numbers, *, wxyz: Numbers = None, xyzw: Numbers = None) -> Pose\n--\n\nFrom a position and "
     "four numbers whose order is named.\n\nAny norm but zero: the rotation is that of the normalised quaternion."},
    {"from_xyz_wxyz", from_xyz_wxyz, METH_O | METH_CLASS,
     "from_xyz_wxyz(numbers: Numbers, /) -> Pose\n--\n\nFrom seven numbers: the position, then the quaternion w x y "
     "z."},
    {"from_xyz_xyzw", from_xyz_xyzw, METH_O | METH_CLASS,
     "from_xyz_xyzw(numbers: Numbers, /) -> Pose\n--\n\nFrom seven numbers: the position, then the quaternion x y z "
     "w, as ROS and PyBullet have them."},
    {"from_rotation", METHOD_KEYWORDS(from_rotation), METH_VARARGS | METH_KEYWORDS | METH_CLASS,
     "from_rotation(xyz: Numbers, rotation: Rotation | Numbers) -> Pose\n--\n\nFrom a position and a 3x3 matrix or a "
     "SciPy Rotation (anything with as_quat(), x y z w). The way back: scipy.spatial.transform.Rotation.from_quat(\n"
     "pose.xyzw), and pose.rotation."},
    {"from_rpy", METHOD_KEYWORDS(from_rpy), METH_VARARGS | METH_KEYWORDS | METH_CLASS,
     "from_rpy(xyz: Numbers, rpy: Numbers) -> Pose\n--\n\nAs in URDF: fixed-axis roll, pitch, yaw in radians, Rz(yaw) "
     "Ry(pitch) Rx(roll)."},
    {"from_axis_angle", METHOD_KEYWORDS(from_axis_angle), METH_VARARGS | METH_KEYWORDS | METH_CLASS,
     "from_axis_angle(xyz: Numbers, axis: Numbers, angle: float) -> Pose\n--\n\nTurned by an angle in radians about an "
     "axis of any length but zero."},
    {"inverse", inverse, METH_NOARGS, "inverse() -> Pose\n--\n\nThe inverse pose."},
    {"apply", apply, METH_O,
     "apply(points: Numbers, /) -> Floats\n--\n\nLocal points, (3,) or (n, 3), in the world frame."},
    {"apply_inverse", apply_inverse, METH_O,
     "apply_inverse(points: Numbers, /) -> Floats\n--\n\nWorld points, (3,) or (n, 3), in the local frame."},
    {"_make", make, METH_VARARGS | METH_CLASS, NULL},
    {"__reduce__", reduce, METH_NOARGS, NULL},
    {NULL, NULL, 0, NULL}};

static PyGetSetDef fields[] = {
    FIELD(pose_object, VEC3, "xyz", pose.position, "The position, in the world frame."),
    {"wxyz", get_quaternion, NULL, "Vec4: The quaternion, w x y z, as it was given.", NULL},
    {"xyzw", get_quaternion, NULL, "Vec4: The quaternion, x y z w, as it was given.", ""},
    {"xyz_wxyz", get_seven, NULL,
     "tuple[float, float, float, float, float, float, float]: The position and the quaternion, w x y z.", NULL},
    {"xyz_xyzw", get_seven, NULL,
     "tuple[float, float, float, float, float, float, float]: The position and the quaternion, x y z w.", ""},
    {"rotation", get_rotation, NULL, "Floats: The 3x3 rotation matrix R: world = R @ local + xyz.", NULL},
    {"matrix", get_matrix, NULL, "Floats: The 4x4 homogeneous matrix: world = matrix @ local.", NULL},
    {NULL, NULL, NULL, NULL, NULL}};

static PyType_Slot slots[] = {
    {Py_tp_doc,
     "Pose(pose: PoseLike = None) -> Pose\n--\n\nWhere a body is: world = xyz + R local.\n\nFrom None (the "
     "identity), three numbers (a position), a 4x4 array whose last row is\n0 0 0 1, a tuple (xyz, rotation) "
     "or (rotation, xyz) of a position and a 3x3 matrix or SciPy Rotation, or another Pose. a\n@ b is the "
     "pose of b in the frame that a poses. Immutable."},
    {Py_tp_new, pose_new},
    {Py_tp_dealloc, object_free},
    {Py_tp_richcompare, compare},
    {Py_tp_hash, PyObject_HashNotImplemented},
    {Py_tp_repr, repr},
    {Py_tp_methods, methods},
    {Py_tp_getset, fields},
    {Py_nb_matrix_multiply, multiply},
    {0, NULL}};
static PyType_Spec spec = {"ovoid.Pose", sizeof(pose_object), 0, Py_TPFLAGS_DEFAULT | Py_TPFLAGS_IMMUTABLETYPE, slots};

int pose_add(PyObject *module) { return type_add(module, &spec, &state_of_module(module)->pose); }
