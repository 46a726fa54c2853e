// Compound: several shapes with poses in one body. It keeps its shapes.
#include "src/module.h"

#include <math.h>
#include <stdlib.h>

static const ovoid_compound *get(PyObject *self) { return ((compound_object *)self)->compound; }

// The shapes of a sequence as parts; the poses are filled already.
static int read_shapes(module_state *state, PyObject *shapes, ovoid_posed_shape *parts) {
    for (Py_ssize_t i = 0; i < PyTuple_Size(shapes); i++) {
        PyObject *shape = PyTuple_GetItem(shapes, i);
        if (Py_TYPE(shape) != state->shape) {
            PyErr_Format(PyExc_TypeError, "part %zd: a Shape is wanted, not %R", i, (PyObject *)Py_TYPE(shape));
            return -1;
        }
        parts[i].shape = ((shape_object *)shape)->shape;
    }
    return 0;
}

// Parts of shapes and poses (NULL: all at the identity). The caller frees them.
static ovoid_posed_shape *make_parts(module_state *state, PyObject *shapes, PyObject *given, const char *order) {
    Py_ssize_t count = PyTuple_Size(shapes), pose_count = count;
    ovoid_pose *poses = NULL;
    if (given && given != Py_None && poses_read(state, given, order, &poses, &pose_count)) return NULL;
    if (pose_count != count) {
        free(poses);
        return raise_code(state, OVOID_ERROR_ARGUMENT, -1, "poses: %zd shapes need as many poses, not %zd", count,
                          pose_count);
    }
    ovoid_posed_shape *parts = malloc((size_t)(count + 1) * sizeof *parts);
    if (!parts) PyErr_NoMemory();
    for (Py_ssize_t i = 0; parts && i < count; i++) parts[i].pose = poses ? poses[i] : ovoid_pose_make_identity();
    free(poses);
    if (!parts || !read_shapes(state, shapes, parts)) return parts;
    free(parts);
    return NULL;
}

// Takes over the tuple.
static PyObject *wrap(PyTypeObject *type, ovoid_compound *compound, PyObject *shapes) {
    compound_object *self = object_make(type);
    if (self) {
        self->compound = compound;
        self->shapes = shapes;
        return (PyObject *)self;
    }
    ovoid_compound_destroy(compound);
    Py_DECREF(shapes);
    return NULL;
}

static PyObject *compound_new(PyTypeObject *type, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"shapes", "poses", "order", NULL};
    PyObject *given, *poses = NULL;
    const char *order = NULL;
    module_state *state = state_of_type((PyObject *)type);
    if (!arguments_read(arguments, keywords, "O|O$z:Compound", names, &given, &poses, &order)) return NULL;
    PyObject *shapes = PySequence_Tuple(given);
    if (!shapes) return NULL;
    ovoid_posed_shape *parts = make_parts(state, shapes, poses, order);
    if (!parts) {
        Py_DECREF(shapes);
        return NULL;
    }
    ovoid_error error;
    ovoid_compound *compound;
    size_t count = (size_t)PyTuple_Size(shapes);
    Py_BEGIN_ALLOW_THREADS;
    compound = ovoid_compound_create(parts, count, NULL, &error);
    Py_END_ALLOW_THREADS;
    free(parts);
    if (compound) return wrap(type, compound, shapes);
    Py_DECREF(shapes);
    return raise_error(state, &error);
}

static PyObject *make_pose(const void *self, size_t i) {
    const compound_object *compound = self;
    return pose_wrap(state_of((PyObject *)self), ovoid_compound_get_part(compound->compound, i).pose);
}

static PyObject *get_poses(PyObject *self, void *closure) {
    (void)closure;
    return tuple_make(ovoid_compound_get_part_count(get(self)), make_pose, self);
}

static PyObject *get_ellipsoid(PyObject *self, void *closure) {
    ovoid_ellipsoid e = closure ? ovoid_compound_get_inner(get(self)) : ovoid_compound_get_outer(get(self));
    ovoid_fit fit = {.ellipsoid = e, .volume = ovoid_ellipsoid_compute_volume(&e), .gap = NAN};
    return fit_wrap(state_of(self), &fit);
}

static PyObject *get_order(PyObject *self, void *closure) {
    (void)closure;
    const uint32_t *order = ovoid_compound_get_order(get(self));
    return array_copy(state_of(self), RECORD_UINT32, 1,
                      (Py_ssize_t[]){(Py_ssize_t)ovoid_compound_get_part_count(get(self))}, order);
}

static PyObject *reduce(PyObject *self, PyObject *ignored) {
    (void)ignored;
    PyObject *poses = get_poses(self, NULL);
    return poses ? Py_BuildValue("O(ON)", (PyObject *)Py_TYPE(self), ((compound_object *)self)->shapes, poses) : NULL;
}

static Py_ssize_t length(PyObject *self) { return (Py_ssize_t)ovoid_compound_get_part_count(get(self)); }

static void compound_dealloc(PyObject *object) {
    compound_object *self = (compound_object *)object;
    ovoid_compound_destroy(self->compound);
    Py_XDECREF(self->shapes);
    object_free(object);
}

static PyGetSetDef fields[] = {
    FIELD_PYTHON(compound_object, "tuple[Shape, ...]", "shapes", shapes, "The shapes of its parts."),
    {"poses", get_poses, NULL, "tuple[Pose, ...]: The poses of its parts in its frame.", NULL},
    {"outer", get_ellipsoid, NULL,
     "Ellipsoid: An ellipsoid that encloses all parts; its gap is NaN, as it is not the smallest.", NULL},
    {"inner", get_ellipsoid, NULL, "Ellipsoid: The largest of the parts' inner ellipsoids.", ""},
    {"order", get_order, NULL, "Indices: The parts in the order of the tree's leaves.", NULL},
    {NULL, NULL, NULL, NULL, NULL}};
static PyMethodDef methods[] = {{"__reduce__", reduce, METH_NOARGS, NULL}, {NULL, NULL, 0, NULL}};
static PyType_Slot slots[] = {
    {Py_tp_doc, "Compound(shapes: Sequence[Shape], poses: PosesLike | None = None, *, order: Order = None) -> "
                "Compound\n--\n\nSeveral shapes in one body, which may overlap: the answer of a query is that of the "
                "nearest (deepest) parts.\n\nposes: in the compound's frame: a sequence of poses, or an array (n, 4, "
                "4) or (n, 7), whose order= is 'wxyz'\nor 'xyzw'; None: all at the identity."},
    {Py_tp_new, compound_new},
    {Py_tp_dealloc, compound_dealloc},
    {Py_mp_length, length},
    {Py_tp_getset, fields},
    {Py_tp_methods, methods},
    {0, NULL}};
static PyType_Spec spec = {"ovoid.Compound", sizeof(compound_object), 0, Py_TPFLAGS_DEFAULT, slots};

int compound_add(PyObject *module) { return type_add(module, &spec, &state_of_module(module)->compound); }
