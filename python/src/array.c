// Array: numbers or records in memory of their own, given out through the buffer protocol.
//
// Where NumPy can be imported, results are NumPy arrays over that memory; this is done through NumPy's Python
// functions, so nothing of it is needed to build. Its types of records are asked for once and kept.
#include "src/module.h"

#include <stdlib.h>
#include <string.h>

typedef struct array_object {
    PyObject_HEAD void *data;
    Py_ssize_t shape[4], strides[4], size;
    int axes;
    record_kind kind;
} array_object;

typedef struct record {
    const char *format;
    size_t size;
} record;

#define VERDICT_FIELDS "I:status:I:stage:I:limit:I:iterations:d:lower:d:upper:"
#define SIDE_FIELDS(which) "I:link_" which ":I:element_" which ":Q:body_" which ":I:part_" which ":4x"
#define MANIFOLD_FIELDS                                                                                                \
    "I:status:I:limit:d:lower:d:upper:(3)d:normal:(4)I:id:I:feature_a:I:feature_b:I:facet_a:I:facet_b:I:axis:B:count:" \
    "B:proof:H:corners:f:share:f:searched:(7)f:pose:I:flags:"
// Robots may be left out of a build; collide.c and robot_path.c say that these are the sizes.
enum { STATE_SIZE = 80, NEAR_SIZE = 152, ROBOT_STEP_SIZE = 48 };
static const record records[RECORD_COUNT] = {
    [RECORD_DOUBLE] = {"d", sizeof(double)},
    [RECORD_UINT32] = {"I", sizeof(uint32_t)},
    [RECORD_UINT64] = {"Q", sizeof(uint64_t)},
    [RECORD_VERDICT] = {"T{" VERDICT_FIELDS "}", sizeof(ovoid_verdict)},
    [RECORD_WITNESS] = {"T{(3)d:point_a:(3)d:point_b:(3)d:normal:}", sizeof(ovoid_witness)},
    [RECORD_PROOF] = {"T{(3)d:normal:(3)d:normal_low:I:kind:I:count:(6)I:a:(6)I:b:(6)d:weight_a:(6)d:weight_b:"
                      "(3)d:inner_a:(3)d:inner_b:}",
                      sizeof(ovoid_proof)},
    [RECORD_CONTACT] = {"T{Q:a:Q:b:Q:user_a:Q:user_b:I:part_a:I:part_b:" VERDICT_FIELDS "}", sizeof(ovoid_contact)},
    [RECORD_STEP] = {"T{d:until:(3)d:normal:I:frame:4x}", sizeof(ovoid_step)},
    [RECORD_STATE] = {"T{I:status:I:code:I:variable:4x" SIDE_FIELDS("a") SIDE_FIELDS("b") "d:lower:d:upper:}",
                      STATE_SIZE},
    [RECORD_NEAR] = {"T{" SIDE_FIELDS("a") SIDE_FIELDS("b") "I:status:4xd:lower:d:upper:"
                                                            "(3)d:point_a:(3)d:point_b:(3)d:normal:I:has_gradient:4x}",
                     NEAR_SIZE},
    [RECORD_ROBOT_STEP] = {"T{d:begin:d:end:I:pair:H:kind:H:mask:(3)d:normal:}", ROBOT_STEP_SIZE},
    [RECORD_MANIFOLD] = {"T{" MANIFOLD_FIELDS "}", sizeof(ovoid_manifold)},
    [RECORD_MANIFOLD_POINT] = {"T{(3)d:point_a:(3)d:point_b:d:separation:I:id:4x}", sizeof(ovoid_manifold_point)},
    [RECORD_BODY_MANIFOLD] = {"T{I:part_a:I:part_b:" MANIFOLD_FIELDS "}", sizeof(ovoid_body_manifold)},
    [RECORD_WORLD_MANIFOLD] = {"T{Q:a:Q:b:Q:user_a:Q:user_b:" VERDICT_FIELDS
                               "d:margin:d:friction:d:restitution:Q:first:I:count:I:event:}",
                               sizeof(ovoid_world_manifold)},
    [RECORD_PARTING] = {"T{Q:a:Q:b:Q:user_a:Q:user_b:}", sizeof(ovoid_world_parting)},
};
_Static_assert(sizeof(unsigned) == 4 && sizeof(ovoid_status) == 4, "a format names enumerations by I");
_Static_assert(sizeof(ovoid_verdict) == 32 && sizeof(ovoid_witness) == 72 && sizeof(ovoid_proof) == 248 &&
                   sizeof(ovoid_contact) == 72 && sizeof(ovoid_step) == 40,
               "the formats name every byte");
_Static_assert(sizeof(ovoid_manifold) == 128 && sizeof(ovoid_manifold_point) == 64 &&
                   sizeof(ovoid_body_manifold) == 136 && sizeof(ovoid_world_manifold) == 104 &&
                   sizeof(ovoid_world_parting) == 32,
               "and those of manifolds do");

const char *record_format(record_kind kind) { return records[kind].format; }
Py_ssize_t record_size(record_kind kind) { return (Py_ssize_t)records[kind].size; }

PyObject *array_make(module_state *state, record_kind kind, int axes, const Py_ssize_t *shape, void *data) {
    Py_ssize_t size = record_size(kind);
    array_object *self = object_make(state->array);
    if (!self) return NULL;
    self->kind = kind;
    self->axes = axes;
    for (int i = axes - 1; i >= 0; i--) {
        self->shape[i] = shape[i];
        self->strides[i] = size;
        if (shape[i] && size > PY_SSIZE_T_MAX / shape[i]) {
            Py_DECREF(self);
            return PyErr_NoMemory();
        }
        size *= shape[i];
    }
    self->size = size;
    self->data = calloc(1, size ? (size_t)size : 1);
    if (!self->data) {
        Py_DECREF(self);
        return PyErr_NoMemory();
    }
    if (data) *(void **)data = self->data;
    return (PyObject *)self;
}

// ---- NumPy

// numpy.ndarray, or None. Any failure to import is taken as that there is none.
static PyObject *get_numpy(module_state *state) {
    if (!state->numpy_array) {
        PyObject *numpy = PyImport_ImportModule("numpy");
        state->numpy_array = numpy ? PyObject_GetAttrString(numpy, "ndarray") : NULL;
        Py_XDECREF(numpy);
        if (!state->numpy_array) {
            PyErr_Clear();
            state->numpy_array = Py_NewRef(Py_None);
        }
    }
    return state->numpy_array;
}

// NumPy's type of a kind of record: that of an array that it makes of ours by itself.
static PyObject *get_numpy_type(module_state *state, record_kind kind) {
    if (state->numpy_types[kind]) return state->numpy_types[kind];
    PyObject *numpy = PyImport_ImportModule("numpy");
    PyObject *one = numpy ? array_make(state, kind, 1, (Py_ssize_t[]){1}, NULL) : NULL;
    PyObject *made = one ? PyObject_CallMethod(numpy, "asarray", "O", one) : NULL;
    if (made) state->numpy_types[kind] = PyObject_GetAttrString(made, "dtype");
    Py_XDECREF(made);
    Py_XDECREF(one);
    Py_XDECREF(numpy);
    return state->numpy_types[kind];
}

int array_is_own(module_state *state, PyObject *from, record_kind kind) {
    PyTypeObject *type = Py_TYPE(from);
    // Asked first by who hands in arrays but has got none yet: its type is that of NumPy, if it has one of this name.
    if (!state->numpy_array && type != &PyTuple_Type && type != &PyList_Type &&
        PyObject_HasAttr(from, state->dtype_name) && get_numpy(state) != Py_None && !get_numpy_type(state, kind))
        PyErr_Clear();
    if (!state->numpy_types[kind] || (PyObject *)type != state->numpy_array) return 0;
    PyObject *found = PyObject_GetAttr(from, state->dtype_name);
    int is_own = found == state->numpy_types[kind];
    if (!found) PyErr_Clear();
    Py_XDECREF(found);
    return is_own;
}

const char *record_numpy_format(module_state *state, record_kind kind) {
    if (state->numpy_formats[kind]) return state->numpy_formats[kind];
    PyObject *numpy = get_numpy(state);
    if (numpy == Py_None) return "";
    PyObject *type = get_numpy_type(state, kind);
    PyObject *made = type ? PyObject_CallFunction(numpy, "(i)O", 1, type) : NULL;
    Py_buffer view;
    if (made && PyObject_GetBuffer(made, &view, PyBUF_FULL_RO) == 0) {
        size_t length = strlen(view.format) + 1;
        state->numpy_formats[kind] = malloc(length);
        if (state->numpy_formats[kind])
            memcpy(state->numpy_formats[kind], view.format, length);
        else
            PyErr_NoMemory();
        PyBuffer_Release(&view);
    }
    Py_XDECREF(made);
    return state->numpy_formats[kind];
}

PyObject *array_wrap(module_state *state, PyObject *array) {
    if (!array || get_numpy(state) == Py_None) return array;
    array_object *self = (array_object *)array;
    PyObject *shape = PyTuple_New(self->axes);
    for (int i = 0; shape && i < self->axes; i++) PyTuple_SetItem(shape, i, PyLong_FromSsize_t(self->shape[i]));
    PyObject *type = shape ? get_numpy_type(state, self->kind) : NULL;
    PyObject *made = type ? PyObject_CallFunctionObjArgs(state->numpy_array, shape, type, array, NULL) : NULL;
    Py_XDECREF(shape);
    Py_DECREF(array);
    return made;
}

PyObject *array_copy(module_state *state, record_kind kind, int axes, const Py_ssize_t *shape, const void *from) {
    void *data = NULL;
    PyObject *array = array_make(state, kind, axes, shape, &data);
    // Of nothing there may be no address.
    if (array && from) memcpy(data, from, (size_t)((array_object *)array)->size);
    return array_wrap(state, array);
}

// ---- the type

static int array_getbuffer(PyObject *object, Py_buffer *view, int flags) {
    (void)flags; // contiguous and writable: all that may be asked for
    array_object *self = (array_object *)object;
    *view = (Py_buffer){.buf = self->data,
                        .obj = Py_NewRef(object),
                        .len = self->size,
                        .itemsize = record_size(self->kind),
                        .ndim = self->axes,
                        .format = (char *)records[self->kind].format,
                        .shape = self->shape,
                        .strides = self->strides};
    if ((flags & PyBUF_FORMAT) != PyBUF_FORMAT) view->format = NULL;
    return 0;
}

static void array_dealloc(PyObject *self) {
    free(((array_object *)self)->data);
    object_free(self);
}

static Py_ssize_t array_length(PyObject *self) { return ((array_object *)self)->shape[0]; }

// Numbers by memoryview, which knows them; records, which it does not, by struct's format without the names.
static PyObject *array_subscript(PyObject *self, PyObject *key) {
    PyObject *view = PyMemoryView_FromObject(self);
    PyObject *found = view ? PyObject_GetItem(view, key) : NULL;
    Py_XDECREF(view);
    return found;
}

static PyObject *array_tolist(PyObject *self, PyObject *ignored) {
    (void)ignored;
    array_object *array = (array_object *)self;
    PyObject *helper = PyImport_ImportModule("ovoid._records");
    PyObject *view = helper ? PyMemoryView_FromObject(self) : NULL;
    PyObject *list = NULL;
    if (view) list = PyObject_CallMethod(helper, "unpack", "Os", view, records[array->kind].format);
    Py_XDECREF(view);
    Py_XDECREF(helper);
    return list;
}

static PyObject *array_repr(PyObject *self) {
    array_object *array = (array_object *)self;
    PyObject *shape = PyTuple_New(array->axes);
    for (int i = 0; shape && i < array->axes; i++) PyTuple_SetItem(shape, i, PyLong_FromSsize_t(array->shape[i]));
    const char *what = array->kind <= RECORD_UINT64 ? "numbers" : "records";
    PyObject *text = shape ? PyUnicode_FromFormat("<ovoid.Array of %s, shape %S: tolist()>", what, shape) : NULL;
    Py_XDECREF(shape);
    return text;
}

static PyMethodDef methods[] = {{"tolist", array_tolist, METH_NOARGS,
                                 "tolist() -> list[Any]\n--\n\nThe items as lists; records as dicts by their fields."},
                                {NULL, NULL, 0, NULL}};

static PyType_Slot slots[] = {
    {Py_tp_doc, "Numbers or records of a result, where there is no NumPy. memoryview(array) and whatever reads buffers "
                "take it; tolist() and, of numbers, indexing work."},
    {Py_tp_dealloc, array_dealloc},
    {Py_tp_repr, array_repr},
    {Py_bf_getbuffer, array_getbuffer},
    {Py_mp_length, array_length},
    {Py_mp_subscript, array_subscript},
    {Py_tp_methods, methods},
    {0, NULL}};
static PyType_Spec spec = {"ovoid.Array", sizeof(array_object), 0,
                           Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION, slots};

int array_add(PyObject *module) { return type_add(module, &spec, &state_of_module(module)->array); }

// ---- zeros(kind, count)

static const char *const made_by_name[RECORD_COUNT] = {[RECORD_VERDICT] = "verdicts",
                                                       [RECORD_WITNESS] = "witnesses",
                                                       [RECORD_PROOF] = "proofs",
                                                       [RECORD_STATE] = "states",
                                                       [RECORD_MANIFOLD] = "manifolds"};

static PyObject *zeros(PyObject *module, PyObject *arguments) {
    const char *name;
    Py_ssize_t count;
    if (!PyArg_ParseTuple(arguments, "sn", &name, &count)) return NULL;
    module_state *state = state_of_module(module);
    if (count < 0)
        return raise_code(state, OVOID_ERROR_ARGUMENT, -1, "zeros: a number of items >= 0 is wanted, not %zd", count);
    for (int kind = 0; kind < RECORD_COUNT; kind++)
        if (made_by_name[kind] && !strcmp(name, made_by_name[kind]))
            return array_wrap(state, array_make(state, (record_kind)kind, 1, &count, NULL));
    return raise_code(state, OVOID_ERROR_ARGUMENT, -1,
                      "zeros: 'verdicts', 'witnesses', 'proofs', 'states' or 'manifolds' is wanted, not '%s'", name);
}

PyMethodDef array_methods[] = {{"zeros", zeros, METH_VARARGS,
                                "zeros(kind: Literal['verdicts', 'witnesses', 'proofs', 'states', 'manifolds'], count: "
                                "int, /) -> Records\n--\n\nAn array of "
                                "zeros for the results of batches: kind is 'verdicts', 'witnesses', 'proofs', "
                                "'manifolds' or,\nof a Cell's, 'states'. Proofs "
                                "and manifolds of zeros say nothing, so they begin a series of batches."},
                               {NULL, NULL, 0, NULL}};
