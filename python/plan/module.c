// The module ovoid._ompl: the search of `ovoid robot plan`, which needs OMPL and a C++ library, for the extension
// ovoid._ovoid, which needs neither. It is built where OMPL is.
#define PY_SSIZE_T_CLEAN
#include <Python.h>

#include "plan/search.h"

#include <ovoid/ovoid.h>

// Slots of modules are functions behind void pointers, which ISO C does not know; POSIX and Python do.
#pragma GCC diagnostic ignored "-Wpedantic"

static search_entry entry = {NULL, search_path};

static int execute(PyObject *module) {
    entry.version = ovoid_get_version();
    PyObject *capsule = PyCapsule_New(&entry, "ovoid search", NULL);
    int result = capsule ? PyModule_AddObjectRef(module, "search", capsule) : -1;
    Py_XDECREF(capsule);
    return result;
}

static PyModuleDef_Slot slots[] = {{Py_mod_exec, execute}, {0, NULL}};
static PyModuleDef definition = {
    .m_base = PyModuleDef_HEAD_INIT, .m_name = "_ompl", .m_doc = "The planners of OMPL.", .m_slots = slots};

PyMODINIT_FUNC PyInit__ompl(void);
PyMODINIT_FUNC PyInit__ompl(void) { return PyModuleDef_Init(&definition); }
