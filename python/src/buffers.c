// Arrays of numbers from outside: buffers of any strides, what has `__array__`, nested sequences. Everything is checked
// (axes, lengths, kind of number) and copied, so no other thread can change it under a query. A refusal says what the
// array is for, what is wanted and what was given.
#include "src/module.h"

#include <stdlib.h>
#include <string.h>

// ---- one item

char buffer_kind(const Py_buffer *view) {
    const char *format = view->format ? view->format : "B";
    const uint16_t one = 1;
    int is_little = *(const unsigned char *)&one;
    if (*format == '@' || *format == '=' || *format == (is_little ? '<' : '>')) format++;
    if (format[0] == 0 || format[1] != 0) return 0;
    if (format[0] == 'd') return view->itemsize == 8 ? 'd' : 0;
    if (format[0] == 'f') return view->itemsize == 4 ? 'f' : 0;
    if (strchr("bhilqn", format[0])) return 'i';
    if (strchr("BHILQN?", format[0])) return 'u';
    return 0;
}

static int64_t signed_at(const char *at, Py_ssize_t size) {
    int8_t i8;
    int16_t i16;
    int32_t i32;
    int64_t i64;
    switch (size) {
    case 1: return memcpy(&i8, at, 1), i8;
    case 2: return memcpy(&i16, at, 2), i16;
    case 4: return memcpy(&i32, at, 4), i32;
    default: return memcpy(&i64, at, 8), i64;
    }
}

static uint64_t unsigned_at(const char *at, Py_ssize_t size) {
    uint8_t u8;
    uint16_t u16;
    uint32_t u32;
    uint64_t u64;
    switch (size) {
    case 1: return memcpy(&u8, at, 1), u8;
    case 2: return memcpy(&u16, at, 2), u16;
    case 4: return memcpy(&u32, at, 4), u32;
    default: return memcpy(&u64, at, 8), u64;
    }
}

static double double_at(const char *at, char kind, Py_ssize_t size) {
    double d;
    float f;
    if (kind == 'd') return memcpy(&d, at, 8), d;
    if (kind == 'f') return memcpy(&f, at, 4), (double)f;
    return kind == 'i' ? (double)signed_at(at, size) : (double)unsigned_at(at, size);
}

// ---- what is wanted

// "(n, 3)" of lengths; wanted ones that may be any are n.
static void write_shape(char *text, size_t size, int axes, const Py_ssize_t *shape) {
    size_t at = (size_t)PyOS_snprintf(text, size, "(");
    for (int i = 0; i < axes && at + 32 < size; i++) {
        if (shape[i] < 0)
            at += (size_t)PyOS_snprintf(text + at, size - at, i ? ", m" : "n");
        else
            at += (size_t)PyOS_snprintf(text + at, size - at, i ? ", %zd" : "%zd", shape[i]);
    }
    PyOS_snprintf(text + at, size - at, axes == 1 ? ",)" : ")");
}

static int validate_shape(module_state *state, const char *what, int axes, const Py_ssize_t *wanted, int given_axes,
                          const Py_ssize_t *given) {
    int is_right = given_axes == axes;
    for (int i = 0; is_right && i < axes; i++) is_right = wanted[i] < 0 || wanted[i] == given[i];
    if (is_right) return 0;
    char want[128], have[128];
    write_shape(want, sizeof want, axes, wanted);
    write_shape(have, sizeof have, given_axes, given);
    raise_code(state, OVOID_ERROR_ARGUMENT, -1, "%s: an array of shape %s is wanted, this one has %s", what, want,
               have);
    return -1;
}

// Memory for items of 8 bytes of that shape, at least one byte.
static void *allocate_items(int axes, const Py_ssize_t *shape) {
    size_t size = 8;
    for (int i = 0; i < axes; i++) {
        if (shape[i] && size > (size_t)PY_SSIZE_T_MAX / (size_t)shape[i]) return PyErr_NoMemory();
        size *= (size_t)shape[i];
    }
    void *memory = malloc(size ? size : 1);
    return memory ? memory : PyErr_NoMemory();
}

// ---- buffers

static int refuse_kind(const char *what, char type, const Py_buffer *view) {
    PyErr_Format(PyExc_TypeError, "%s: an array of %s is wanted, this one holds items of %zd bytes of format '%s'",
                 what, type == 'd' ? "float64, float32 or integers" : "integers", view->itemsize,
                 view->format ? view->format : "B");
    return -1;
}

// Copies one item; -1 for an unsigned integer above int64.
static int copy_item(const char *from, char kind, Py_ssize_t size, char type, void *to) {
    if (type == 'd') {
        *(double *)to = double_at(from, kind, size);
        return 0;
    }
    if (kind == 'u' && unsigned_at(from, size) > INT64_MAX) return -1;
    *(int64_t *)to = kind == 'i' ? signed_at(from, size) : (int64_t)unsigned_at(from, size);
    return 0;
}

static int copy_buffer(module_state *state, const char *what, const Py_buffer *view, char type, void *to) {
    Py_ssize_t shape[3] = {1, 1, 1}, strides[3] = {0, 0, 0};
    for (int i = 0; i < view->ndim; i++) shape[i] = view->shape[i], strides[i] = view->strides[i];
    char kind = buffer_kind(view), *next = to;
    if (kind == type && PyBuffer_IsContiguous(view, 'C')) {
        memcpy(to, view->buf, (size_t)view->len);
        return 0;
    }
    for (Py_ssize_t i = 0; i < shape[0]; i++)
        for (Py_ssize_t j = 0; j < shape[1]; j++)
            for (Py_ssize_t k = 0; k < shape[2]; k++, next += 8) {
                const char *at = (const char *)view->buf + i * strides[0] + j * strides[1] + k * strides[2];
                if (copy_item(at, kind, view->itemsize, type, next)) {
                    raise_code(state, OVOID_ERROR_RANGE, i, "%s: an integer is above 2^63", what);
                    return -1;
                }
            }
    return 0;
}

// What is given again and again, a 4x4 array of doubles, is asked for without its format.
static int read_own_doubles(module_state *state, PyObject *from, int axes, const Py_ssize_t *wanted, void *to) {
    Py_buffer view;
    if (!array_is_own(state, from, RECORD_DOUBLE)) return 0;
    if (PyObject_GetBuffer(from, &view, PyBUF_ND)) {
        PyErr_Clear();
        return 0;
    }
    int is_right = view.ndim == axes;
    for (int i = 0; is_right && i < axes; i++) is_right = view.shape[i] == wanted[i];
    if (is_right) memcpy(to, view.buf, (size_t)view.len);
    PyBuffer_Release(&view);
    return is_right;
}

static int is_wanted_kind(const Py_buffer *view, char type) {
    char kind = buffer_kind(view);
    return kind && !view->suboffsets && (type == 'd' || kind == 'i' || kind == 'u');
}

static int read_view(module_state *state, const char *what, int axes, const Py_ssize_t *wanted, char type,
                     const Py_buffer *view, items *to) {
    if (!is_wanted_kind(view, type)) return refuse_kind(what, type, view);
    if (validate_shape(state, what, axes, wanted, view->ndim, view->shape)) return -1;
    void *memory = to->data ? to->data : allocate_items(axes, view->shape);
    if (!memory) return -1;
    for (int i = 0; i < axes; i++) to->shape[i] = view->shape[i];
    if (copy_buffer(state, what, view, type, memory)) {
        if (!to->data) free(memory);
        return -1;
    }
    to->data = memory;
    return 0;
}

static int read_buffer(module_state *state, PyObject *from, const char *what, int axes, const Py_ssize_t *wanted,
                       char type, items *to) {
    Py_buffer view;
    if (PyObject_GetBuffer(from, &view, PyBUF_FULL_RO)) {
        PyErr_Clear();
        PyErr_Format(PyExc_TypeError, "%s: an array of %s is wanted; this object gives no buffer of numbers", what,
                     type == 'd' ? "float64, float32 or integers" : "integers");
        return -1;
    }
    int result = read_view(state, what, axes, wanted, type, &view, to);
    PyBuffer_Release(&view);
    return result;
}

// ---- nested sequences

static int read_number(PyObject *from, const char *what, char type, void *to) {
    if (type == 'd')
        *(double *)to = PyFloat_AsDouble(from);
    else
        *(int64_t *)to = PyLong_AsLongLong(from);
    if (!PyErr_Occurred()) return 0;
    if (PyErr_ExceptionMatches(PyExc_TypeError) || PyErr_ExceptionMatches(PyExc_OverflowError)) {
        PyErr_Clear();
        PyErr_Format(PyExc_TypeError, "%s: an array, or a sequence of %s, is wanted; one item is %R", what,
                     type == 'd' ? "numbers" : "integers", (PyObject *)Py_TYPE(from));
    }
    return -1;
}

// The items of a nested sequence whose lengths along all axes are known.
static int read_nested(module_state *state, PyObject *from, const char *what, int axes, const Py_ssize_t *shape,
                       char type, char **next) {
    if (axes == 0) {
        int result = read_number(from, what, type, *next);
        *next += 8;
        return result;
    }
    PyObject *row = PySequence_Tuple(from);
    if (!row) return -1;
    int result = 0;
    if (PyTuple_Size(row) != shape[0]) {
        raise_code(state, OVOID_ERROR_ARGUMENT, -1, "%s: %zd items are wanted in each row, one has %zd", what, shape[0],
                   PyTuple_Size(row));
        result = -1;
    }
    for (Py_ssize_t i = 0; !result && i < shape[0]; i++)
        result = read_nested(state, PyTuple_GetItem(row, i), what, axes - 1, shape + 1, type, next);
    Py_DECREF(row);
    return result;
}

// The lengths of a nested sequence along its first items; -1 where it is not that deep.
static int measure_nested(PyObject *from, int axes, Py_ssize_t *shape) {
    if (axes == 0) return 0;
    if (!PySequence_Check(from) || PyUnicode_Check(from)) return -1;
    shape[0] = PySequence_Size(from);
    if (shape[0] < 0) return -1;
    if (shape[0] == 0) {
        for (int i = 1; i < axes; i++) shape[i] = 0;
        return 0;
    }
    PyObject *first = PySequence_GetItem(from, 0);
    int result = first ? measure_nested(first, axes - 1, shape + 1) : -1;
    Py_XDECREF(first);
    return result;
}

static int read_sequence(module_state *state, PyObject *from, const char *what, int axes, const Py_ssize_t *wanted,
                         char type, items *to) {
    Py_ssize_t shape[3];
    if (measure_nested(from, axes, shape)) {
        if (PyErr_Occurred() && !PyErr_ExceptionMatches(PyExc_Exception)) return -1;
        PyErr_Clear();
        char want[128];
        write_shape(want, sizeof want, axes, wanted);
        PyErr_Format(PyExc_TypeError, "%s: an array of shape %s is wanted, not %R", what, want,
                     (PyObject *)Py_TYPE(from));
        return -1;
    }
    // An empty list has no rows to count: it stands for any empty array.
    if (shape[0] == 0 && wanted[0] < 0)
        for (int i = 1; i < axes; i++) shape[i] = wanted[i] < 0 ? 0 : wanted[i];
    if (validate_shape(state, what, axes, wanted, axes, shape)) return -1;
    void *memory = to->data ? to->data : allocate_items(axes, shape);
    if (!memory) return -1;
    char *next = memory;
    if (read_nested(state, from, what, axes, shape, type, &next)) {
        if (!to->data) free(memory);
        return -1;
    }
    memcpy(to->shape, shape, (size_t)axes * sizeof *shape);
    to->data = memory;
    return 0;
}

// ---- what is called

static int read_any(module_state *state, PyObject *from, const char *what, int axes, const Py_ssize_t *wanted,
                    char type, items *to) {
    if (PyObject_CheckBuffer(from)) return read_buffer(state, from, what, axes, wanted, type, to);
    if (!PyTuple_Check(from) && !PyList_Check(from) && PyObject_HasAttrString(from, "__array__")) {
        PyObject *array = PyObject_CallMethod(from, "__array__", NULL);
        int result = array ? read_buffer(state, array, what, axes, wanted, type, to) : -1;
        Py_XDECREF(array);
        return result;
    }
    return read_sequence(state, from, what, axes, wanted, type, to);
}

int items_read(module_state *state, PyObject *from, const char *what, int axes, const Py_ssize_t *wanted, char type,
               items *to) {
    to->data = NULL;
    return read_any(state, from, what, axes, wanted, type, to);
}

int doubles_read(module_state *state, PyObject *from, const char *what, int axes, const Py_ssize_t *wanted, void *to) {
    if (read_own_doubles(state, from, axes, wanted, to)) return 0;
    items into = {to, {0, 0, 0}};
    return read_any(state, from, what, axes, wanted, 'd', &into);
}

int vec3_read(module_state *state, PyObject *from, const char *what, ovoid_vec3 *to) {
    double xyz[3];
    if (doubles_read(state, from, what, 1, (Py_ssize_t[]){3}, xyz)) return -1;
    *to = (ovoid_vec3){xyz[0], xyz[1], xyz[2]};
    return 0;
}

int buffer_axes(PyObject *from) {
    Py_buffer view;
    if (!PyObject_CheckBuffer(from)) return 0;
    if (PyObject_GetBuffer(from, &view, PyBUF_FULL_RO)) {
        PyErr_Clear();
        return 0;
    }
    int axes = view.ndim;
    PyBuffer_Release(&view);
    return axes;
}

int array_axes(PyObject *from) {
    int axes = buffer_axes(from);
    if (axes || !PySequence_Check(from)) return axes == 1 ? 1 : 2;
    PyObject *first = PySequence_GetItem(from, 0);
    axes = first && PyNumber_Check(first) && !PySequence_Check(first) ? 1 : 2;
    if (!first) PyErr_Clear();
    Py_XDECREF(first);
    return axes;
}

// 1 if the buffer's format is that of a kind of records, as this module or NumPy writes it.
static int is_record(module_state *state, const Py_buffer *view, record_kind kind) {
    if (!view->format || view->itemsize != record_size(kind)) return 0;
    if (!strcmp(view->format, record_format(kind))) return 1;
    const char *numpy = record_numpy_format(state, kind);
    if (!numpy) PyErr_Clear();
    return numpy && !strcmp(view->format, numpy);
}

int records_view(module_state *state, PyObject *from, const char *what, record_kind kind, Py_ssize_t count,
                 int writable, Py_buffer *view) {
    int is_own = array_is_own(state, from, kind);
    int flags = (writable ? PyBUF_FULL : PyBUF_FULL_RO) & ~(is_own ? PyBUF_FORMAT : 0);
    if (PyObject_GetBuffer(from, view, flags)) {
        PyErr_Clear();
        PyErr_Format(PyExc_TypeError, "%s: %s array is wanted, as of ovoid.zeros, not %R", what,
                     writable ? "a writable" : "an", (PyObject *)Py_TYPE(from));
        return -1;
    }
    const char *wrong = NULL;
    if (!is_own && !is_record(state, view, kind))
        wrong = "its items are of another type";
    else if (view->ndim != 1 || !PyBuffer_IsContiguous(view, 'C'))
        wrong = "it is not contiguous, of one axis";
    else if ((uintptr_t)view->buf % sizeof(double))
        wrong = "it is not aligned to 8 bytes";
    if (wrong) {
        PyErr_Format(PyExc_TypeError, "%s: an array as of ovoid.zeros is wanted; %s", what, wrong);
    } else if (count >= 0 && view->shape[0] != count) {
        raise_code(state, OVOID_ERROR_ARGUMENT, -1, "%s: an array of %zd items is wanted, this one has %zd", what,
                   count, view->shape[0]);
    } else {
        return 0;
    }
    PyBuffer_Release(view);
    return -1;
}
