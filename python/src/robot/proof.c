// Files of path proofs, as `ovoid robot path --proofs` writes them: their paths as claims about a cell, which verify()
// measures.
#ifdef OVOID_PYTHON_ROBOT_READ
#include "src/robot/robot.h"

#include <ovoid/robot_proof.h>

#include <string.h>

// ---- what the paths of a file are of

static PyObject *make_text(const void *texts, size_t i) { return robot_name_make(((const char *const *)texts)[i]); }
static PyObject *make_texts(const char *const *texts, size_t count) { return tuple_make(count, make_text, texts); }

static PyObject *make_source(const ovoid_robot_proofs_reader *file) {
    const ovoid_robot_proof_source *s = ovoid_robot_proofs_reader_get_source(file);
    size_t attached_count;
    const char *const *attached = ovoid_robot_proofs_reader_get_attached(file, &attached_count);
    return Py_BuildValue("{s:N,s:N,s:N,s:N,s:N,s:N,s:N,s:O,s:O,s:O,s:O,s:d,s:d,s:d,s:n,s:K,s:N}", "robot",
                         robot_name_make(s->robot), "srdf", robot_name_make(s->srdf), "scene",
                         robot_name_make(s->scene), "packages", make_texts(s->packages, s->package_count), "scales",
                         make_texts(s->scales, s->scale_count), "paddings", make_texts(s->paddings, s->padding_count),
                         "attached", make_texts(attached, attached_count), "parts", s->parts ? Py_True : Py_False,
                         "hull", s->hull ? Py_True : Py_False, "visual", s->visual ? Py_True : Py_False, "fixed_base",
                         s->fixed_base ? Py_True : Py_False, "tolerance", s->tolerance, "margin", s->margin,
                         "limit_slack", s->limit_slack, "path_count", (Py_ssize_t)s->path_count, "digest",
                         (unsigned long long)s->digest, "variables", make_texts(s->variables, s->variable_count));
}

// ---- the same robot and pairs

static int is_text(const char *a, const char *b) { return !a == !b && (!a || strcmp(a, b) == 0); }

// An obstacle has no name in a cell, so it is one of any name.
static int is_side(const cell_object *cell, const ovoid_robot_side *side, const ovoid_robot_proof_side *named) {
    ovoid_robot_description d = ovoid_robot_get_description(cell->robot->robot);
    if (side->link == OVOID_ROBOT_NONE) return !named->link;
    if (side->body) return is_text(d.links[side->link].name, named->link); // nor has what a link holds
    const char *element = side->element == OVOID_ROBOT_NONE ? NULL : d.elements[side->element].name;
    return is_text(d.links[side->link].name, named->link) && is_text(element, named->name);
}

static int has_variables(const cell_object *cell, const ovoid_robot_proof_source *s) {
    size_t count = robot_variable_count(cell->robot);
    int is_same = s->variable_count == count;
    for (size_t i = 0; is_same && i < count; i++) {
        PyObject *name = robot_variable_name_make(cell->robot, i);
        if (!name) return -1;
        is_same = PyUnicode_CompareWithASCIIString(name, s->variables[i]) == 0;
        Py_DECREF(name);
    }
    return is_same;
}

// -1 with an Error where the cell is of another robot, or has other pairs.
static int validate_source(const cell_object *cell, const ovoid_robot_proof_source *s, int64_t line) {
    module_state *state = state_of((PyObject *)cell);
    int is_same = has_variables(cell, s);
    if (is_same < 0) return -1;
    const char *what = is_same ? NULL : "variables";
    if (!what && s->pair_count != ovoid_robot_cell_get_pair_count(cell->cell)) what = "pairs of bodies";
    for (size_t i = 0; !what && i < s->pair_count; i++) {
        ovoid_robot_sides sides;
        (void)ovoid_robot_cell_get_pair(cell->cell, i, &sides, NULL);
        if (!is_side(cell, &sides.a, &s->pairs[2 * i]) || !is_side(cell, &sides.b, &s->pairs[2 * i + 1]))
            what = "pairs of bodies";
    }
    if (!what) return 0;
    raise_code(state, OVOID_ERROR_PROOF, (Py_ssize_t)line,
               "the file's paths are of another robot or scene: it has other %s", what);
    return -1;
}

// ---- reading

// Calls take for each path; -1: an exception.
static int read_all(module_state *state, ovoid_robot_proofs_reader *file, PyObject *list,
                    PyObject *(*take)(void *context, const ovoid_robot_proof *, const ovoid_robot_proofs_reader *),
                    void *context) {
    ovoid_robot_proof proof;
    ovoid_error error;
    int got;
    while ((got = ovoid_robot_proofs_reader_read(file, &proof, &error)) > 0) {
        PyObject *one = take(context, &proof, file);
        int failed = !one || (one != Py_None && PyList_Append(list, one)) || PyErr_CheckSignals();
        Py_XDECREF(one);
        if (failed) return -1;
    }
    if (got < 0) raise_error(state, &error);
    return got;
}

static PyObject *read_file(module_state *state, PyObject *given,
                           PyObject *(*take)(void *, const ovoid_robot_proof *, const ovoid_robot_proofs_reader *),
                           void *context) {
    PyObject *path = NULL;
    ovoid_error error;
    if (!PyUnicode_FSConverter(given, &path)) return NULL;
    ovoid_robot_proofs_reader *file = ovoid_robot_proofs_reader_open(PyBytes_AsString(path), &error);
    Py_DECREF(path);
    if (!file) return raise_error(state, &error);
    PyObject *list = PyList_New(0);
    if (list && read_all(state, file, list, take, context)) Py_CLEAR(list);
    ovoid_robot_proofs_reader_close(file);
    return list;
}

/// The cell, and the last source of which it is known that its paths are of it.
typedef struct claims {
    cell_object *cell;
    size_t sources;
} claims;

static PyObject *take_path(void *context, const ovoid_robot_proof *proof, const ovoid_robot_proofs_reader *file) {
    claims *c = context;
    const ovoid_robot_proof_source *source = ovoid_robot_proofs_reader_get_source(file);
    if (proof->source >= c->sources && validate_source(c->cell, source, proof->line)) return NULL;
    c->sources = proof->source + 1;
    return path_claim(c->cell, proof, source->limit_slack);
}

static PyObject *read_paths(PyObject *object, PyObject *given) {
    claims c = {(cell_object *)object, 0};
    return read_file(state_of(object), given, take_path, &c);
}

static PyObject *take_source(void *context, const ovoid_robot_proof *proof, const ovoid_robot_proofs_reader *file) {
    size_t *sources = context;
    if (proof->source < *sources) Py_RETURN_NONE;
    *sources = proof->source + 1;
    return make_source(file);
}

static PyObject *read_path_sources(PyObject *module, PyObject *given) {
    size_t sources = 0;
    return read_file(state_of_module(module), given, take_source, &sources);
}

PyMethodDef cell_proofs[] = {
    {"read_paths", read_paths, METH_O,
     "read_paths(path: PathLike, /) -> list[RobotPath]\n--\n\nThe paths of a file that `ovoid robot path --proofs` "
     "wrote, as claims about this cell: a list of RobotPaths, which verify()\nmeasures. Error where the file's "
     "variables or pairs of bodies are others; the cell's obstacles count by their\norder, not by name."},
    {NULL, NULL, 0, NULL}};
PyMethodDef robot_proof_functions[] = {
    {"read_path_sources", read_path_sources, METH_O,
     "read_path_sources(path: PathLike, /) -> list[dict[str, Any]]\n--\n\nWhat the paths of a file of path proofs are "
     "of, a list of dicts: the files robot, srdf and scene, packages, scales,\npaddings, what links hold, how they "
     "were read, margin, "
     "limit_slack, variables, path_count, digest."},
    {NULL, NULL, 0, NULL}};
#else
typedef int nothing_to_prove; // ISO C wants a declaration
#endif
