// Bodies: many posed shapes, read and checked once, for batches over couples of them.
#include "src/bodies.h"

#include <stdlib.h>

// Shapes as a tuple: a sequence of them, or one for all poses.
static PyObject *read_shapes(module_state *state, PyObject *given, Py_ssize_t count) {
    if (Py_TYPE(given) == state->shape) return PyTuple_Pack(1, given);
    PyObject *shapes = PySequence_Tuple(given);
    if (!shapes) return NULL;
    for (Py_ssize_t i = 0; i < PyTuple_Size(shapes); i++)
        if (Py_TYPE(PyTuple_GetItem(shapes, i)) != state->shape) {
            PyErr_Format(PyExc_TypeError, "shape %zd: a Shape is wanted, not %R", i,
                         (PyObject *)Py_TYPE(PyTuple_GetItem(shapes, i)));
            Py_DECREF(shapes);
            return NULL;
        }
    if (PyTuple_Size(shapes) == count) return shapes;
    raise_code(state, OVOID_ERROR_ARGUMENT, -1, "shapes: %zd poses need as many shapes, or one for all, not %zd", count,
               PyTuple_Size(shapes));
    Py_DECREF(shapes);
    return NULL;
}

// Takes over the tuple of shapes.
static PyObject *make_bodies(PyTypeObject *type, PyObject *shapes, const ovoid_pose *poses, Py_ssize_t count,
                             int is_same) {
    bodies_object *self = object_make(type);
    ovoid_posed_shape *made = malloc((size_t)(count + 1) * sizeof *made);
    if (!self || !made) {
        free(made);
        Py_XDECREF((PyObject *)self);
        Py_DECREF(shapes);
        return PyErr_NoMemory();
    }
    for (Py_ssize_t i = 0; i < count; i++) {
        PyObject *shape = PyTuple_GetItem(shapes, is_same ? 0 : i);
        made[i] = (ovoid_posed_shape){((shape_object *)shape)->shape, poses[i]};
    }
    self->items = made;
    self->count = count;
    self->shapes = shapes;
    return (PyObject *)self;
}

static PyObject *bodies_new(PyTypeObject *type, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"shapes", "poses", "order", NULL};
    PyObject *given, *poses_given;
    const char *order = NULL;
    module_state *state = state_of_type((PyObject *)type);
    ovoid_pose *poses;
    Py_ssize_t count;
    if (!PyArg_ParseTupleAndKeywords(arguments, keywords, "OO|$z:Bodies", names, &given, &poses_given, &order) ||
        poses_read(state, poses_given, order, &poses, &count))
        return NULL;
    PyObject *shapes = read_shapes(state, given, count);
    PyObject *made = NULL;
    if (shapes && (size_t)count > UINT32_MAX)
        Py_DECREF(shapes), PyErr_NoMemory();
    else if (shapes)
        made = make_bodies(type, shapes, poses, count, Py_TYPE(given) == state->shape);
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
    if (!PyArg_ParseTupleAndKeywords(arguments, keywords, "O|$z:move", names, &given, &order) ||
        poses_read(state, given, order, &poses, &count))
        return NULL;
    int is_fit = count == self->count && !self->users;
    if (count != self->count)
        raise_code(state, OVOID_ERROR_ARGUMENT, -1, "poses: %zd bodies need as many, not %zd", self->count, count);
    else if (self->users)
        PyErr_SetString(PyExc_RuntimeError, "a batch of another thread is using these bodies");
    for (Py_ssize_t i = 0; is_fit && i < count; i++) self->items[i].pose = poses[i];
    free(poses);
    return is_fit ? Py_NewRef(Py_None) : NULL;
}

static Py_ssize_t length(PyObject *self) { return ((bodies_object *)self)->count; }

static void bodies_dealloc(PyObject *object) {
    bodies_object *self = (bodies_object *)object;
    free(self->items);
    Py_XDECREF(self->shapes);
    object_free(object);
}

static PyMethodDef methods[] = {{"move", METHOD_KEYWORDS(move), METH_VARARGS | METH_KEYWORDS,
                                 "move(poses, *, order=None)\n--\n\nNew poses for all bodies, as in Bodies(...); where "
                                 "one is refused none has moved."},
                                {NULL, NULL, 0, NULL}};
static PyType_Slot slots[] = {
    {Py_tp_doc,
     "Bodies(shapes, poses, *, order=None)\n--\n\nPosed shapes for batches.\n\nshapes: a sequence, or one Shape for "
     "all. poses: an array (n, 4, 4), or (n, 7) of x y z and a quaternion whose\norder= is 'wxyz' or 'xyzw', or "
     "a sequence of poses. Copied and checked; a pose that is refused is named by the\nError's place."},
    {Py_tp_new, bodies_new},
    {Py_tp_dealloc, bodies_dealloc},
    {Py_mp_length, length},
    {Py_tp_methods, methods},
    {0, NULL}};
static PyType_Spec spec = {"ovoid.Bodies", sizeof(bodies_object), 0, Py_TPFLAGS_DEFAULT | Py_TPFLAGS_IMMUTABLETYPE,
                           slots};

int bodies_add(PyObject *module) { return type_add(module, &spec, &state_of_module(module)->bodies); }
