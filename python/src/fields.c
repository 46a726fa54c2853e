// The fields of C values as attributes: one getter, told by a table where the field is and what it is.
#include "src/module.h"

PyObject *vec3_make(ovoid_vec3 v) { return Py_BuildValue("(ddd)", v.x, v.y, v.z); }

PyObject *sym3_make(module_state *state, const ovoid_sym3 *m) {
    double full[9] = {m->xx, m->xy, m->xz, m->xy, m->yy, m->yz, m->xz, m->yz, m->zz};
    return array_copy(state, RECORD_DOUBLE, 2, (Py_ssize_t[]){3, 3}, full);
}

PyObject *pair_make(double first, double second) { return Py_BuildValue("(dd)", first, second); }

PyObject *box_make(ovoid_box box) { return Py_BuildValue("(NN)", vec3_make(box.min), vec3_make(box.max)); }

PyObject *tuple_make(size_t count, PyObject *(*make)(const void *context, size_t i), const void *context) {
    PyObject *made = PyTuple_New((Py_ssize_t)count);
    for (size_t i = 0; made && i < count; i++) {
        PyObject *one = make(context, i);
        if (!one || PyTuple_SetItem(made, (Py_ssize_t)i, one)) Py_CLEAR(made);
    }
    return made;
}

PyObject *list_make(size_t count, PyObject *(*make)(const void *context, size_t i), const void *context) {
    PyObject *tuple = tuple_make(count, make, context), *list = tuple ? PySequence_List(tuple) : NULL;
    Py_XDECREF(tuple);
    return list;
}

PyObject *field_get(PyObject *self, void *closure) {
    const field *which = closure;
    union {
        char bytes[FIELD_FACTS_MOST];
        double aligned;
    } facts;
    if (which->load) which->load(self, &facts);
    const void *at = (which->load ? facts.bytes : (const char *)self) + which->offset;
    switch (which->kind) {
    case FIELD_DOUBLE: return PyFloat_FromDouble(*(const double *)at);
    case FIELD_UINT: return PyLong_FromUnsignedLong(*(const uint32_t *)at);
    case FIELD_SIZE: return PyLong_FromSize_t(*(const size_t *)at);
    case FIELD_BOOL: return PyBool_FromLong(*(const uint32_t *)at != 0);
    case FIELD_OBJECT: return Py_NewRef(*(PyObject *const *)at);
    case FIELD_POSE: return pose_wrap(state_of(self), *(const ovoid_pose *)at);
    case FIELD_BOX: return box_make(*(const ovoid_box *)at);
    case FIELD_PAIR: return pair_make(((const double *)at)[0], ((const double *)at)[1]);
    case FIELD_VEC3: return vec3_make(*(const ovoid_vec3 *)at);
    case FIELD_SYM3: return sym3_make(state_of(self), at);
    case FIELD_DOUBLES_12: return array_copy(state_of(self), RECORD_DOUBLE, 1, (Py_ssize_t[]){12}, at);
    case FIELD_DOUBLES_12_12: return array_copy(state_of(self), RECORD_DOUBLE, 2, (Py_ssize_t[]){12, 12}, at);
    default: return enum_get(state_of(self), (enum_kind)(which->kind - FIELD_ENUM), *(const uint32_t *)at);
    }
}
