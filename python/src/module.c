// The module ovoid._ovoid: its state, its types and functions.
#include "src/module.h"

#include <stdlib.h>
#include <string.h>

module_state *state_of_module(PyObject *module) { return PyModule_GetState(module); }
module_state *state_of_type(PyObject *type) { return PyType_GetModuleState((PyTypeObject *)type); }
module_state *state_of(PyObject *self) { return PyType_GetModuleState(Py_TYPE(self)); }

int type_add(PyObject *module, PyType_Spec *spec, PyTypeObject **type) {
    for (PyType_Slot *slot = spec->slots; slot->slot; slot++) {
        if (slot->slot == Py_tp_doc && !(slot->pfunc = (void *)doc_make(slot->pfunc))) return -1;
        if (slot->slot == Py_tp_methods && docs_make(slot->pfunc)) return -1;
    }
    *type = (PyTypeObject *)PyType_FromModuleAndSpec(module, spec, NULL);
    return *type ? PyModule_AddType(module, *type) : -1;
}

void slots_set_methods(PyType_Slot *slots, PyMethodDef *all, const PyMethodDef *first, const PyMethodDef *second) {
    size_t count = 0;
    for (const PyMethodDef *m = first; m->ml_name; m++) all[count++] = *m;
    for (const PyMethodDef *m = second; m->ml_name; m++) all[count++] = *m;
    for (PyType_Slot *slot = slots; slot->slot; slot++)
        if (slot->slot == Py_tp_methods) slot->pfunc = all;
}

void *object_make(PyTypeObject *type) { return PyType_GenericAlloc(type, 0); }

void object_free(PyObject *self) {
    PyTypeObject *type = Py_TYPE(self);
    PyObject_Free(self);
    Py_DECREF(type);
}

// ---- what is written in Python: the exception, the enumerations, the named tuples

static int import_enum(PyObject *enums, const char *name, PyObject **to) {
    PyObject *type = PyObject_GetAttrString(enums, name);
    *to = type ? PySequence_Tuple(type) : NULL;
    Py_XDECREF(type);
    return *to ? 0 : -1;
}

static int import_python(module_state *state) {
    static const char *const names[ENUM_COUNT] = {"Status",    "Stage",        "Limit",       "Code",
                                                  "ProofKind", "ImpactStatus", "RobotStatus", "Touch",
                                                  "Inside",    "Agreement",    "Axis",        "ManifoldProof"};
    state->dtype_name = PyUnicode_InternFromString("dtype");
    PyObject *enums = state->dtype_name ? PyImport_ImportModule("ovoid._enums") : NULL;
    if (!enums) return -1;
    state->error = PyObject_GetAttrString(enums, "Error");
    int failed = !state->error;
    for (int i = 0; !failed && i < ENUM_COUNT; i++) failed = import_enum(enums, names[i], &state->enums[i]);
    Py_DECREF(enums);
    PyObject *values = failed ? NULL : PyImport_ImportModule("ovoid._values");
    if (!values) return -1;
    static const char *const tuples[] = {
        "Contacts",  "Hit",         "Cast",       "Joint",       "Variable",        "Element",
        "Side",      "StateAnswer", "MatrixPair", "SphereAudit", "Obstacle",        "MotionRequest",
        "Clearance", "Comparison",  "PartsAudit", "Trajectory",  "ManifoldPolygon", "WorldManifolds",
        "Material",  "SweptAnswer"};
    enum { TUPLES = sizeof tuples / sizeof *tuples };
    _Static_assert(offsetof(module_state, enums) - offsetof(module_state, contacts) == TUPLES * sizeof(PyObject *),
                   "a name for each, in their order");
    PyObject **to = &state->contacts;
    for (size_t i = 0; !failed && i < TUPLES; i++) failed = !(to[i] = PyObject_GetAttrString(values, tuples[i]));
    Py_DECREF(values);
    return failed ? -1 : 0;
}

static PyObject *get_names(PyObject *module, PyObject *ignored) {
    (void)module;
    (void)ignored;
    PyObject *all = PyDict_New();
    for (int kind = 0; all && kind < 5; kind++) {
        static const char *const names[] = {"Status", "Stage", "Limit", "Code", "ProofKind"};
        PyObject *list = PyList_New(0);
        for (int i = 0; list && i < 32; i++) {
            const char *name = kind == 0   ? ovoid_status_get_name((ovoid_status)i)
                               : kind == 1 ? ovoid_stage_get_name((ovoid_stage)i)
                               : kind == 2 ? ovoid_limit_get_name((ovoid_limit)i)
                               : kind == 3 ? ovoid_code_get_name((ovoid_code)i)
                                           : ovoid_proof_kind_get_name((ovoid_proof_kind)i);
            PyObject *text = PyUnicode_FromString(name);
            if (!text || PyList_Append(list, text)) Py_CLEAR(list);
            Py_XDECREF(text);
        }
        if (!list || PyDict_SetItemString(all, names[kind], list)) Py_CLEAR(all);
        Py_XDECREF(list);
    }
    return all;
}

static PyMethodDef own_methods[] = {
    {"_get_names", get_names, METH_NOARGS, "The library's names of its enumerations, for the tests."},
    {NULL, NULL, 0, NULL}};

// ---- the module

static int execute(PyObject *module) {
    static int (*const adders[])(PyObject *) = {array_add,    pose_add,  shape_add,      compound_add, answer_add,
                                                bodies_add,   world_add, motion_add,     impact_add,   smooth_add,
#ifdef OVOID_PYTHON_ROBOT
                                                robot_add,    cell_add,  robot_path_add,
#endif
                                                prepared_add, swept_add, solid_add,      manifold_add};
    PyMethodDef *const functions[] = {
        own_methods,        query_methods,  batch_methods,     impact_methods, smooth_methods,
        array_methods,      bounds_methods, decompose_methods, state_methods,  manifold_methods,
#ifdef OVOID_PYTHON_IO
        shape_file_methods, draw_methods,
#endif
    };
    if (import_python(state_of_module(module))) return -1;
    for (size_t i = 0; i < sizeof adders / sizeof *adders; i++)
        if (adders[i](module)) return -1;
    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++)
        if (functions_add(module, functions[i])) return -1;
    int has_io = 0, has_robot = 0;
#ifdef OVOID_PYTHON_IO
    has_io = 1;
#endif
#ifdef OVOID_PYTHON_ROBOT
    has_robot = 1;
#endif
    if (PyModule_AddIntConstant(module, "has_io", has_io) || PyModule_AddIntConstant(module, "has_robot", has_robot))
        return -1;
    return PyModule_AddStringConstant(module, "__version__", ovoid_get_version());
}

// The references, from the first to the last.
enum { REFERENCES = offsetof(module_state, numpy_formats) / sizeof(PyObject *) };
_Static_assert(offsetof(module_state, array) == 0 && sizeof(PyTypeObject *) == sizeof(PyObject *), "references alone");

static int traverse(PyObject *module, visitproc visit, void *arg) {
    PyObject **objects = (PyObject **)(void *)state_of_module(module);
    for (size_t i = 0; objects && i < REFERENCES; i++) Py_VISIT(objects[i]);
    return 0;
}

static int clear(PyObject *module) {
    PyObject **objects = (PyObject **)(void *)state_of_module(module);
    for (size_t i = 0; objects && i < REFERENCES; i++) Py_CLEAR(objects[i]);
    return 0;
}

static void finish(void *module) {
    module_state *state = state_of_module(module);
    clear(module);
    for (int i = 0; state && i < RECORD_COUNT; i++) free(state->numpy_formats[i]);
}

static PyModuleDef_Slot module_slots[] = {{Py_mod_exec, execute}, {0, NULL}};
static PyModuleDef definition = {.m_base = PyModuleDef_HEAD_INIT,
                                 .m_name = "_ovoid",
                                 .m_doc = "The C extension of the package ovoid.",
                                 .m_size = sizeof(module_state),
                                 .m_slots = module_slots,
                                 .m_traverse = traverse,
                                 .m_clear = clear,
                                 .m_free = finish};

PyMODINIT_FUNC PyInit__ovoid(void);
PyMODINIT_FUNC PyInit__ovoid(void) { return PyModuleDef_Init(&definition); }
