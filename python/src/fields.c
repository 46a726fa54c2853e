// The fields of C values as attributes: one getter, told by a table where the field is and what it is.
#include "src/module.h"

PyObject *vec3_make(ovoid_vec3 v) { return Py_BuildValue("(ddd)", v.x, v.y, v.z); }

PyObject *sym3_make(module_state *state, const ovoid_sym3 *m) {
    double full[9] = {m->xx, m->xy, m->xz, m->xy, m->yy, m->yz, m->xz, m->yz, m->zz};
    return array_copy(state, RECORD_DOUBLE, 2, (Py_ssize_t[]){3, 3}, full);
}

PyObject *field_get(PyObject *self, void *closure) {
    const field *which = closure;
    const void *at = (const char *)self + which->offset;
    switch (which->kind) {
    case FIELD_DOUBLE: return PyFloat_FromDouble(*(const double *)at);
    case FIELD_UINT: return PyLong_FromUnsignedLong(*(const uint32_t *)at);
    case FIELD_SIZE: return PyLong_FromSize_t(*(const size_t *)at);
    case FIELD_BOOL: return PyBool_FromLong(*(const uint32_t *)at != 0);
    case FIELD_VEC3: return vec3_make(*(const ovoid_vec3 *)at);
    case FIELD_SYM3: return sym3_make(state_of(self), at);
    case FIELD_DOUBLES_12: return array_copy(state_of(self), RECORD_DOUBLE, 1, (Py_ssize_t[]){12}, at);
    case FIELD_DOUBLES_12_12: return array_copy(state_of(self), RECORD_DOUBLE, 2, (Py_ssize_t[]){12, 12}, at);
    default: return enum_get(state_of(self), (enum_kind)(which->kind - FIELD_ENUM), *(const uint32_t *)at);
    }
}
