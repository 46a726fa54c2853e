// Errors of the library as exceptions, with its sentence, its code and its place; members of the enumerations.
#include "src/module.h"

#include <stdarg.h>
#include <string.h>

// ovoid.Error(sentence, code, place). Takes over the sentence.
static void *raise(module_state *state, PyObject *sentence, ovoid_code code, long long place) {
    PyObject *member = sentence ? enum_get(state, ENUM_CODE, code) : NULL;
    PyObject *made = member ? PyObject_CallFunction(state->error, "OOL", sentence, member, place) : NULL;
    if (made) PyErr_SetObject(state->error, made);
    Py_XDECREF(made);
    Py_XDECREF(member);
    Py_XDECREF(sentence);
    return NULL;
}

void *raise_error(module_state *state, const ovoid_error *error) {
    if (error->code == OVOID_ERROR_MEMORY) return PyErr_NoMemory();
    // A path in a sentence may be any bytes.
    PyObject *sentence = PyUnicode_DecodeUTF8(error->message, (Py_ssize_t)strlen(error->message), "replace");
    return raise(state, sentence, error->code, error->place);
}

PyObject *none_or_raise(module_state *state, ovoid_code code, const ovoid_error *error) {
    return code == OVOID_OK ? Py_NewRef(Py_None) : raise_error(state, error);
}

void *raise_code(module_state *state, ovoid_code code, Py_ssize_t place, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    PyObject *sentence = PyUnicode_FromFormatV(format, arguments);
    va_end(arguments);
    return raise(state, sentence, code, place);
}

int bool_refuse(PyObject *self) {
    PyErr_Format(PyExc_TypeError,
                 "an answer is neither true nor false (%R): compare its status, for example answer.status == "
                 "\"overlapping\"",
                 (PyObject *)Py_TYPE(self));
    return -1;
}

PyObject *enum_get(module_state *state, enum_kind kind, uint32_t value) {
    PyObject *member = PyTuple_GetItem(state->enums[kind], (Py_ssize_t)value);
    Py_XINCREF(member);
    return member;
}
