// Solids in convex parts: made by cuts, proven against the solid, grown until they cover it.
#include "src/query.h"

#include <stdlib.h>

static const ovoid_solid *get(PyObject *self) { return ((solid_object *)self)->solid; }

/// A decomposition at work: its options have the watch and the callback of its progress.
typedef struct job {
    ovoid_decomposition_options options;
    interrupt signals;
} job;

// Without the interpreter's lock; the watch tells Python.
static void note_progress(void *context, size_t done, size_t total) {
    interrupt *signals = context;
    signals->done = done;
    signals->total = total;
}

static void begin(job *j, PyObject *progress) {
    j->options.watch = interrupt_begin(&j->signals);
    // A cut may take a hundredth of a second.
    j->signals.every = 1;
    j->signals.progress = progress == Py_None ? NULL : progress;
    j->options.progress = note_progress;
    j->options.progress_context = &j->signals;
}

// ---- the parts

// Shapes of a sequence, as the library takes them; *kept holds them. The caller frees what it gets.
static const ovoid_shape **read_parts(module_state *state, PyObject *given, PyObject **kept, size_t *count) {
    *kept = PySequence_Tuple(given);
    if (!*kept) return NULL;
    *count = (size_t)PyTuple_Size(*kept);
    const ovoid_shape **parts = malloc((*count + 1) * sizeof *parts);
    if (!parts) PyErr_NoMemory();
    for (size_t i = 0; parts && i < *count; i++) {
        PyObject *part = PyTuple_GetItem(*kept, (Py_ssize_t)i);
        if (Py_TYPE(part) == state->shape) {
            parts[i] = ((shape_object *)part)->shape;
            continue;
        }
        PyErr_Format(PyExc_TypeError, "part %zd: a Shape is wanted, not %R", (Py_ssize_t)i, (PyObject *)Py_TYPE(part));
        free(parts);
        parts = NULL;
    }
    if (!parts) Py_CLEAR(*kept);
    return parts;
}

static void destroy_parts(PyObject *owner) { ovoid_parts_destroy(PyCapsule_GetPointer(owner, "parts")); }

/// Shapes that belong to a capsule.
typedef struct owned_parts {
    module_state *state;
    const ovoid_shape *const *shapes;
    PyObject *owner;
} owned_parts;

static PyObject *borrow_part(const void *context, size_t i) {
    const owned_parts *p = context;
    return shape_borrow(p->state, p->shapes[i], p->owner);
}

// A tuple of Shapes, which keep the parts that they belong to.
static PyObject *wrap_parts(module_state *state, ovoid_parts *made, const ovoid_error *error) {
    if (!made) return raise_error(state, error);
    PyObject *owner = PyCapsule_New(made, "parts", destroy_parts);
    if (!owner) {
        ovoid_parts_destroy(made);
        return NULL;
    }
    owned_parts all = {state, ovoid_parts_get_shapes(made), owner};
    PyObject *shapes = tuple_make(ovoid_parts_get_count(made), borrow_part, &all);
    Py_DECREF(owner);
    return shapes;
}

static PyObject *decompose(PyObject *self, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"error", "parts", "progress", NULL};
    module_state *state = state_of(self);
    job j = {.options = {0}};
    Py_ssize_t count = 0;
    PyObject *progress = Py_None;
    if (!arguments_read(arguments, keywords, "|$dnO:decompose", names, &j.options.error, &count, &progress) ||
        progress_validate(progress))
        return NULL;
    if (count < 0) return raise_code(state, OVOID_ERROR_ARGUMENT, -1, "parts: a number of at least 0 is wanted");
    j.options.parts = (size_t)count;
    ovoid_error error;
    begin(&j, progress);
    ovoid_parts *made = ovoid_parts_create_from_solid(get(self), &j.options, &error);
    if (!interrupt_end(&j.signals)) return wrap_parts(state, made, &error);
    ovoid_parts_destroy(made);
    return NULL;
}

static PyObject *enlarge_parts(PyObject *module, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"parts", "radius", NULL};
    module_state *state = state_of_module(module);
    PyObject *given, *kept;
    double radius;
    ovoid_decomposition d = {.solid = NULL};
    if (!arguments_read(arguments, keywords, "Od:enlarge_parts", names, &given, &radius)) return NULL;
    const ovoid_shape **parts = read_parts(state, given, &kept, &d.part_count);
    if (!parts) return NULL;
    d.parts = parts;
    ovoid_error error;
    ovoid_parts *made;
    Py_BEGIN_ALLOW_THREADS;
    made = ovoid_parts_create_enlarged(&d, radius, NULL, &error);
    Py_END_ALLOW_THREADS;
    free(parts);
    Py_DECREF(kept);
    return wrap_parts(state, made, &error);
}

// ---- the proof

static PyObject *make_audit(module_state *state, const ovoid_decomposition_proof *p, size_t count,
                            const double *excess) {
    const ovoid_decomposition_length *r = &p->uncovered, *e = &p->excess;
    return PyObject_CallFunction(state->parts_audit, "(dd)(dd)NININn", r->lower, r->upper, e->lower, e->upper,
                                 vec3_make(r->point), r->part, vec3_make(e->point), e->part,
                                 array_copy(state, RECORD_DOUBLE, 1, (Py_ssize_t[]){(Py_ssize_t)count}, excess),
                                 (Py_ssize_t)p->cells);
}

static PyObject *run_audit(PyObject *self, job *j, const ovoid_decomposition *d, PyObject *progress) {
    module_state *state = state_of(self);
    double *excess = calloc(d->part_count + 1, sizeof *excess);
    if (!excess) return PyErr_NoMemory();
    ovoid_decomposition_proof proof;
    ovoid_error error;
    begin(j, progress);
    j->options.excesses = excess;
    ovoid_code code = ovoid_decomposition_compute_proof(d, &j->options, &proof, &error);
    PyObject *made = NULL;
    if (!interrupt_end(&j->signals))
        made = code == OVOID_OK ? make_audit(state, &proof, d->part_count, excess) : raise_error(state, &error);
    free(excess);
    return made;
}

static PyObject *audit_parts(PyObject *self, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"parts", "tolerance", "cells", "work", "progress", NULL};
    module_state *state = state_of(self);
    job j = {.options = {0}};
    Py_ssize_t cells = 0, work = 0;
    PyObject *given, *kept, *progress = Py_None;
    ovoid_decomposition d = {.solid = get(self)};
    if (!arguments_read(arguments, keywords, "O|$dnnO:audit_parts", names, &given, &j.options.tolerance, &cells, &work,
                        &progress) ||
        progress_validate(progress))
        return NULL;
    if (cells < 0 || work < 0) return raise_code(state, OVOID_ERROR_ARGUMENT, -1, "numbers of cells are >= 0");
    j.options.cells = (size_t)cells;
    j.options.work = (size_t)work;
    const ovoid_shape **parts = read_parts(state, given, &kept, &d.part_count);
    if (!parts) return NULL;
    d.parts = parts;
    PyObject *made = run_audit(self, &j, &d, progress);
    free(parts);
    Py_DECREF(kept);
    return made;
}

PyMethodDef solid_decompositions[] = {
    {"decompose", METHOD_KEYWORDS(decompose), METH_VARARGS | METH_KEYWORDS,
     "decompose(*, error: float = 0, parts: int = 0, progress: Progress | None = None) -> tuple[Shape, "
     "...]\n--\n\nCuts a closed solid into convex parts: a tuple of Shapes in its frame, which together cover it but "
     "for rounding.\n\nerror: a length, by how much none shall stand out of the solid, as estimated; audit_parts "
     "proves it. parts: at most so\nmany. Both 0: an error of 1/50 of the diagonal of its box. progress(done, total) "
     "is called about twenty times a second."},
    {"audit_parts", METHOD_KEYWORDS(audit_parts), METH_VARARGS | METH_KEYWORDS,
     "audit_parts(parts: Iterable[Shape], *, tolerance: float = 0, cells: int = 0, work: int = 0, progress: Progress | "
     "None = None) -> PartsAudit\n--\n\nHow far convex parts, Shapes in the solid's frame, are from it: a PartsAudit "
     "of brackets that are true.\n\ntolerance: a length; they need not be narrower (0: 1/1000 of the diagonal). cells, "
     "work: most cells held, and looked at\nfor each length (0: 2^18, 2^21). progress(done, total) is called about "
     "twenty times a second."},
    {NULL, NULL, 0, NULL}};

PyMethodDef decompose_methods[] = {
    {"enlarge_parts", METHOD_KEYWORDS(enlarge_parts), METH_VARARGS | METH_KEYWORDS,
     "enlarge_parts(parts: Iterable[Shape], radius: float) -> tuple[Shape, ...]\n--\n\nShapes that hold all points "
     "within radius of the Shapes given, and little more: what has to be grown by r to cover a\nsolid covers it so."},
    {NULL, NULL, 0, NULL}};
