// RobotPath: whether a path of a cell is free for all times in between, with the steps that prove it.
#include "src/robot/robot.h"

#ifdef OVOID_PYTHON_ROBOT_READ
#include <ovoid/robot_proof.h>
#endif

#include <math.h>
#include <stdlib.h>
#include <string.h>

_Static_assert(sizeof(ovoid_robot_step) == 48, "the format of array.c names every byte");

/// The answer to a path and what it takes to check it again.
typedef struct path_object {
    PyObject_HEAD ovoid_robot_path_answer of;
    ovoid_robot_path_options options; ///< of the question; its steps are these
    cell_object *cell;
    size_t version; ///< of the cell when it was asked
    double *states;
    size_t state_count;
    ovoid_robot_step *steps;
} path_object;

static path_object *make_object(cell_object *cell, const ovoid_robot_path_options *o, items *states) {
    path_object *self = object_make(state_of((PyObject *)cell)->robot_path);
    if (!self) {
        free(states->data);
        return NULL;
    }
    self->cell = (cell_object *)Py_NewRef((PyObject *)cell);
    self->version = cell->version;
    self->options = *o;
    self->states = states->data;
    self->state_count = (size_t)states->shape[0];
    return self;
}

static void path_dealloc(PyObject *object) {
    path_object *self = (path_object *)object;
    Py_XDECREF((PyObject *)self->cell);
    free(self->states);
    free(self->steps);
    object_free(object);
}

// Asks again with more memory where the steps were more than there was room for.
static ovoid_code find_steps(path_object *self, ovoid_robot_checker *checker, ovoid_error *error) {
    ovoid_robot_path path = {self->states, self->state_count};
    ovoid_robot_path_options o = self->options;
    for (o.capacity = 256;; o.capacity = self->of.step_count) {
        o.steps = realloc(self->steps, o.capacity * sizeof *o.steps);
        if (!o.steps) {
            error->code = OVOID_ERROR_MEMORY;
            return OVOID_ERROR_MEMORY;
        }
        self->steps = o.steps;
        // From the same memory of earlier states, so that the second time has as many steps.
        ovoid_robot_checker_reset(checker);
        ovoid_code code = ovoid_robot_path_find_hit(checker, &(ovoid_robot_path_query){&path, &o}, &self->of, error);
        if (code != OVOID_OK || self->of.step_count <= o.capacity) return code;
    }
}

int path_arguments_read(cell_object *cell, PyObject *arguments, PyObject *keywords, const char *format, char **names,
                        path_arguments *in) {
    module_state *state = state_of((PyObject *)cell);
    PyObject *given;
    unsigned long long most = 0;
    *in = (path_arguments){.tolerance = 0};
    // The last one is read where the format has it.
    if (!arguments_read(arguments, keywords, format, names, &given, ROBOT_QUERY_TARGETS(in->query), &in->tolerance,
                        &most, &in->any_hit) ||
        query_options_validate(state, &in->query))
        return -1;
    if (most > UINT32_MAX) {
        raise_code(state, OVOID_ERROR_ARGUMENT, -1, "most_states: 0 to 2^32 - 1 are wanted");
        return -1;
    }
    in->most_states = (uint32_t)most;
    return state_rows_read(cell->robot, given, "states", &in->states);
}

PyObject *find_hit(PyObject *object, PyObject *arguments, PyObject *keywords);
PyObject *find_hit(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {PATH_NAMES, "any_hit", NULL};
    cell_object *cell = (cell_object *)object;
    module_state *state = state_of(object);
    path_arguments in;
    ovoid_robot_checker *checker;
    if (path_arguments_read(cell, arguments, keywords, "O|$" ROBOT_QUERY_FORMAT "dKp:find_hit", names, &in))
        return NULL;
    ovoid_robot_path_options o = {
        .query = in.query, .tolerance = in.tolerance, .states = in.most_states, .any_hit = in.any_hit};
    path_object *self = make_object(cell, &o, &in.states);
    if (!self || checkers_borrow(cell, &checker, 1)) {
        Py_XDECREF((PyObject *)self);
        return NULL;
    }
    ovoid_error error;
    ovoid_code code;
    interrupt signals;
    self->options.watch = interrupt_begin(&signals);
    code = find_steps(self, checker, &error);
    int is_raised = interrupt_end(&signals);
    self->options.watch = (ovoid_watch){NULL, NULL};
    checkers_return(cell, &checker, 1);
    if (code == OVOID_OK && !is_raised) return (PyObject *)self;
    Py_DECREF((PyObject *)self);
    return is_raised ? NULL : raise_error(state, &error);
}

ovoid_code path_verify(PyObject *object, ovoid_error *error) {
    path_object *self = (path_object *)object;
    ovoid_error unused, *to = error ? error : &unused;
    if (self->version != self->cell->version) {
        *to = (ovoid_error){.code = OVOID_ERROR_ARGUMENT, .place = -1};
        strcpy(to->message, "the cell has changed since this path was asked: ask again");
        return to->code;
    }
    ovoid_robot_path path = {self->states, self->state_count};
    ovoid_code code;
    self->cell->readers++;
    Py_BEGIN_ALLOW_THREADS;
    code = ovoid_robot_path_verify(self->cell->cell, &self->of,
                                   &(ovoid_robot_path_basis){{&path, &self->options}, self->steps}, to);
    Py_END_ALLOW_THREADS;
    self->cell->readers--;
    return code;
}

#ifdef OVOID_PYTHON_ROBOT_READ
PyObject *path_claim(cell_object *cell, const ovoid_robot_proof *proof, double limit_slack) {
    size_t variables = robot_variable_count(cell->robot), size = proof->count * variables * sizeof(double);
    const ovoid_robot_path_options o = {.query = {.margin = proof->margin, .limit_slack = limit_slack}};
    items states = {malloc(size + 1), {(Py_ssize_t)proof->count, 0, 0}};
    size_t steps = proof->answer.step_count * sizeof *proof->steps;
    path_object *self = states.data ? make_object(cell, &o, &states) : NULL;
    if (!states.data) PyErr_NoMemory();
    if (!self) return NULL;
    memcpy(self->states, proof->states, size);
    self->of = proof->answer;
    self->of.refused = SIZE_MAX; // not told
    ovoid_robot_sides sides;
    if (proof->has_pair && ovoid_robot_cell_get_pair(cell->cell, proof->pair, &sides, NULL) == OVOID_OK) {
        self->of.hit.a = sides.a;
        self->of.hit.b = sides.b;
    }
    self->steps = malloc(steps + 1);
    if (!self->steps) {
        Py_DECREF((PyObject *)self);
        return PyErr_NoMemory();
    }
    if (steps) memcpy(self->steps, proof->steps, steps);
    return (PyObject *)self;
}
#endif

// ---- what it is

// Of a file's path that is refused nothing more is told.
static PyObject *get_hit(PyObject *self, void *closure) {
    (void)closure;
    const path_object *path = (path_object *)self;
    if (path->of.status == OVOID_ROBOT_FREE || (path->of.status == OVOID_ROBOT_REFUSED && path->of.refused == SIZE_MAX))
        Py_RETURN_NONE;
    return state_answer_make(path->cell, &path->of.hit);
}

static PyObject *get_refused(PyObject *self, void *closure) {
    (void)closure;
    const path_object *path = (path_object *)self;
    if (path->of.status != OVOID_ROBOT_REFUSED || path->of.refused == SIZE_MAX) Py_RETURN_NONE;
    return PyLong_FromSize_t(path->of.refused);
}

static PyObject *get_steps(PyObject *self, void *closure) {
    (void)closure;
    const path_object *path = (path_object *)self;
    return array_copy(state_of(self), RECORD_ROBOT_STEP, 1, (Py_ssize_t[]){(Py_ssize_t)path->of.step_count},
                      path->steps);
}

static PyObject *get_states(PyObject *self, void *closure) {
    (void)closure;
    const path_object *path = (path_object *)self;
    Py_ssize_t shape[] = {(Py_ssize_t)path->state_count, (Py_ssize_t)robot_variable_count(path->cell->robot)};
    return array_copy(state_of(self), RECORD_DOUBLE, 2, shape, path->states);
}

static PyObject *repr(PyObject *self) {
    static const char *const words[] = {"undecided", "free", "hit", "refused"};
    const ovoid_robot_path_answer *x = &((path_object *)self)->of;
    char text[160];
    PyOS_snprintf(text, sizeof text, "<ovoid.RobotPath: %s, free before %.17g, %zu steps>", words[x->status],
                  x->free_until, x->step_count);
    return PyUnicode_FromString(text);
}

static PyGetSetDef fields[] = {
    FIELD(path_object, ROBOT_STATUS, "status", of.status, "What is proven of the path."),
    FIELD(path_object, DOUBLE, "free_until", of.free_until,
          "Proven: free at all s before it; s is i at state i, linear in between."),
    FIELD(path_object, DOUBLE, "hit_at", of.hit_at, "Where it is proven to be a hit; inf where it is not one."),
    FIELD(path_object, DOUBLE, "margin", options.query.margin, "What is nearer than this counts as a hit."),
    FIELD(path_object, DOUBLE, "limit_slack", options.query.limit_slack,
          "By how much variables may be outside of their limits."),
    FIELD(path_object, UINT, "looked_at", of.states, "How many states were looked at."),
    {"hit", get_hit, NULL,
     "StateAnswer | None: The StateAnswer at hit_at, or of what is undecided or refused; None where it is free, or a "
     "file does not tell.",
     NULL},
    {"refused", get_refused, NULL,
     "int | None: The state that is refused, or at whose beginning a segment is; else None.", NULL},
    {"steps", get_steps, NULL,
     "Records: The proof: an array of records begin, end, pair, kind (1 outer, 2 middle, 3 ends), mask, normal.", NULL},
    {"states", get_states, NULL, "Floats: The states of the path, (n, variables).", NULL},
    FIELD_PYTHON(path_object, "Cell", "cell", cell, "The Cell that was asked."),
    {NULL, NULL, NULL, NULL, NULL}};

static PyType_Slot slots[] = {{Py_tp_doc,
                               "Whether a path of a Cell is free for all times in between. ovoid.verify(path) measures "
                               "its steps again, without a\n"
                               "search, and raises Error where they prove less, or where the cell has changed since."},
                              {Py_tp_dealloc, path_dealloc},
                              {Py_tp_repr, repr},
                              {Py_nb_bool, bool_refuse},
                              {Py_tp_getset, fields},
                              {0, NULL}};
static PyType_Spec spec = {"ovoid.RobotPath", sizeof(path_object), 0,
                           Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION, slots};

int robot_path_add(PyObject *module) { return type_add(module, &spec, &state_of_module(module)->robot_path); }
