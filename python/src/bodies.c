// Bodies: many posed bodies, read and checked once, for batches over couples of them.
#include "src/bodies.h"

#include <stdlib.h>

static int is_body(module_state *state, PyObject *from) {
    return Py_TYPE(from) == state->shape || Py_TYPE(from) == state->compound || Py_TYPE(from) == state->solid;
}

// Shapes, Compounds and Solids as a tuple: a sequence of them, or one for all poses.
static PyObject *read_shapes(module_state *state, PyObject *given, Py_ssize_t count) {
    if (is_body(state, given)) return PyTuple_Pack(1, given);
    PyObject *shapes = PySequence_Tuple(given);
    if (!shapes) return NULL;
    for (Py_ssize_t i = 0; i < PyTuple_Size(shapes); i++) {
        PyObject *shape = PyTuple_GetItem(shapes, i);
        if (is_body(state, shape)) continue;
        PyErr_Format(PyExc_TypeError, "shape %zd: a Shape, Compound or Solid is wanted, not %R", i,
                     (PyObject *)Py_TYPE(shape));
        Py_DECREF(shapes);
        return NULL;
    }
    if (PyTuple_Size(shapes) == count) return shapes;
    raise_code(state, OVOID_ERROR_ARGUMENT, -1, "shapes: %zd poses need as many shapes, or one for all, not %zd", count,
               PyTuple_Size(shapes));
    Py_DECREF(shapes);
    return NULL;
}

static PyObject *get_shape(const bodies_object *self, Py_ssize_t i) {
    return PyTuple_GetItem(self->shapes, PyTuple_Size(self->shapes) == 1 ? 0 : i);
}

static int has_others(module_state *state, PyObject *shapes) {
    for (Py_ssize_t i = 0; i < PyTuple_Size(shapes); i++)
        if (Py_TYPE(PyTuple_GetItem(shapes, i)) != state->shape) return 1;
    return 0;
}

// Bodies of any kind, or shapes alone, which the library's batches take.
static int fill(module_state *state, bodies_object *self, const ovoid_pose *poses) {
    size_t room = (size_t)self->count + 1;
    if (has_others(state, self->shapes))
        self->others = malloc(room * sizeof *self->others);
    else
        self->items = malloc(room * sizeof *self->items);
    if (!self->others && !self->items) return -1;
    for (Py_ssize_t i = 0; i < self->count; i++) {
        ovoid_body body = body_make(state, get_shape(self, i), poses[i]);
        self->has_solids |= body.solid != NULL;
        if (self->others)
            self->others[i] = body;
        else
            self->items[i] = (ovoid_posed_shape){body.shape, poses[i]};
    }
    return 0;
}

// Takes over the tuple of shapes.
static PyObject *make_bodies(module_state *state, PyObject *shapes, const ovoid_pose *poses, Py_ssize_t count) {
    bodies_object *self = object_make(state->bodies);
    if (!self) {
        Py_DECREF(shapes);
        return NULL;
    }
    self->count = count;
    self->shapes = shapes;
    if (!fill(state, self, poses)) return (PyObject *)self;
    Py_DECREF((PyObject *)self);
    return PyErr_NoMemory();
}

static PyObject *bodies_new(PyTypeObject *type, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"shapes", "poses", "order", NULL};
    PyObject *given, *poses_given;
    const char *order = NULL;
    module_state *state = state_of_type((PyObject *)type);
    ovoid_pose *poses;
    Py_ssize_t count;
    if (!arguments_read(arguments, keywords, "OO|$z:Bodies", names, &given, &poses_given, &order) ||
        poses_read(state, poses_given, order, &poses, &count))
        return NULL;
    PyObject *shapes = read_shapes(state, given, count);
    PyObject *made = NULL;
    if (shapes && (size_t)count > UINT32_MAX)
        Py_DECREF(shapes), PyErr_NoMemory();
    else if (shapes)
        made = make_bodies(state, shapes, poses, count);
    free(poses);
    return made;
}

static PyObject *move(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"poses", "order", NULL};
    bodies_object *self = (bodies_object *)object;
    PyObject *given;
    const char *order = NULL;
    module_state *state = state_of(object);
    ovoid_pose *poses;
    Py_ssize_t count;
    if (!arguments_read(arguments, keywords, "O|$z:move", names, &given, &order) ||
        poses_read(state, given, order, &poses, &count))
        return NULL;
    int is_fit = count == self->count && !self->users;
    if (count != self->count)
        raise_code(state, OVOID_ERROR_ARGUMENT, -1, "poses: %zd bodies need as many, not %zd", self->count, count);
    else if (self->users)
        PyErr_SetString(PyExc_RuntimeError, "a batch of another thread is using these bodies");
    for (Py_ssize_t i = 0; is_fit && i < count; i++)
        *(self->others ? &self->others[i].pose : &self->items[i].pose) = poses[i];
    free(poses);
    return is_fit ? Py_NewRef(Py_None) : NULL;
}

static PyObject *make_shape(const void *self, size_t i) { return Py_NewRef(get_shape(self, (Py_ssize_t)i)); }

static PyObject *make_pose(const void *context, size_t i) {
    const bodies_object *self = context;
    return pose_wrap(state_of((PyObject *)context), self->others ? self->others[i].pose : self->items[i].pose);
}

static PyObject *get_shapes(PyObject *self, void *closure) {
    (void)closure;
    return tuple_make((size_t)((bodies_object *)self)->count, make_shape, self);
}

static PyObject *get_poses(PyObject *self, void *closure) {
    (void)closure;
    return tuple_make((size_t)((bodies_object *)self)->count, make_pose, self);
}

static Py_ssize_t length(PyObject *self) { return ((bodies_object *)self)->count; }

static void bodies_dealloc(PyObject *object) {
    bodies_object *self = (bodies_object *)object;
    free(self->items);
    free(self->others);
    Py_XDECREF(self->shapes);
    object_free(object);
}

static PyGetSetDef fields[] = {
    {"shapes", get_shapes, NULL, "tuple[Body, ...]: The Shape, Compound or Solid of each body.", NULL},
    {"poses", get_poses, NULL, "tuple[Pose, ...]: Their poses as they are now.", NULL},
    {NULL, NULL, NULL, NULL, NULL}};
static PyMethodDef methods[] = {{"move", METHOD_KEYWORDS(move), METH_VARARGS | METH_KEYWORDS,
                                 "move(poses: PosesLike, *, order: Order = None) -> None\n--\n\nNew poses for all "
                                 "bodies, as in Bodies(...); where one is refused none has moved."},
                                {NULL, NULL, 0, NULL}};
static PyType_Slot slots[] = {
    {Py_tp_doc,
     "Bodies(shapes: Sequence[Body] | Body, poses: PosesLike, *, order: Order = None) -> Bodies\n--\n\nPosed bodies "
     "for batches.\n\nshapes: a sequence of Shapes, Compounds and Solids, or one for all. poses: an array (n, 4, 4), "
     "or (n, 7) of x y z and a quaternion whose\norder= is 'wxyz' or 'xyzw', or a sequence of poses. Copied and "
     "checked; a pose that is refused is named by the\nError's place."},
    {Py_tp_new, bodies_new},
    {Py_tp_dealloc, bodies_dealloc},
    {Py_mp_length, length},
    {Py_tp_methods, methods},
    {Py_tp_getset, fields},
    {0, NULL}};
static PyType_Spec spec = {"ovoid.Bodies", sizeof(bodies_object), 0, Py_TPFLAGS_DEFAULT, slots};

int bodies_add(PyObject *module) { return type_add(module, &spec, &state_of_module(module)->bodies); }
