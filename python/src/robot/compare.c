// States that a robot and a model of it disagree about.
#include "src/robot/robot.h"

#include <ovoid/robot_compare.h>

#include <stdlib.h>

_Static_assert(sizeof(ovoid_robot_agreement) == 4, "agreements are an array of uint32");

/// States in work.
typedef struct comparing {
    ovoid_robot_checker *checkers[2]; ///< of the robot, of its model
    const double *q;
    size_t variables;
    ovoid_robot_query_options options;
    ovoid_robot_agreement *agreements;
    ovoid_robot_comparison sum;
} comparing;

static ovoid_code compare_piece(void *context, size_t first, size_t count, ovoid_error *error) {
    comparing *c = context;
    const ovoid_robot_comparison_batch batch = {.robot = c->checkers[0],
                                                .model = c->checkers[1],
                                                .q = c->q + first * c->variables,
                                                .count = count,
                                                .options = &c->options,
                                                .agreements = c->agreements + first};
    ovoid_code code = ovoid_robot_compare_states(&batch, &c->sum, error);
    return code;
}

static PyObject *make_counts(module_state *state, const ovoid_robot_comparison *sum) {
    PyObject *counts = PyDict_New();
    for (uint32_t i = 0; counts && i < OVOID_ROBOT_AGREEMENTS; i++) {
        PyObject *key = enum_get(state, ENUM_AGREEMENT, i), *value = PyLong_FromSize_t(sum->counts[i]);
        if (!key || !value || PyDict_SetItem(counts, key, value)) Py_CLEAR(counts);
        Py_XDECREF(key);
        Py_XDECREF(value);
    }
    return counts;
}

// Takes over the array of agreements.
static PyObject *make_comparison(module_state *state, const ovoid_robot_comparison *sum, PyObject *agreements) {
    int is_missed = sum->counts[OVOID_ROBOT_COMPARED_MISSED] > 0;
    PyObject *at = is_missed ? PyLong_FromSize_t(sum->deepest_state) : Py_NewRef(Py_None);
    PyObject *pair =
        is_missed ? array_copy(state, RECORD_NEAR, 1, (Py_ssize_t[]){1}, &sum->deepest) : Py_NewRef(Py_None);
    return PyObject_CallFunction(state->comparison, "NNNN", make_counts(state, sum), array_wrap(state, agreements), at,
                                 pair);
}

static PyObject *compare_read(module_state *state, cell_object *const cells[2], const items *states,
                              const ovoid_robot_query_options *o, PyObject *progress) {
    comparing c = {.q = states->data, .variables = (size_t)states->shape[1], .options = *o};
    PyObject *agreements = array_make(state, RECORD_UINT32, 1, states->shape, &c.agreements);
    if (!agreements) return NULL;
    int failed = checkers_borrow(cells[0], &c.checkers[0], 1);
    if (!failed) {
        failed = checkers_borrow(cells[1], &c.checkers[1], 1);
        if (!failed) {
            const pieces work = {(size_t)states->shape[0], OVOID_ROBOT_BLOCK, compare_piece, &c, progress};
            failed = pieces_run(state, &work);
            checkers_return(cells[1], &c.checkers[1], 1);
        }
        checkers_return(cells[0], &c.checkers[0], 1);
    }
    if (!failed) return make_comparison(state, &c.sum, agreements);
    Py_DECREF(agreements);
    return NULL;
}

static int read_cell(module_state *state, PyObject *from, const char *what, cell_object **to) {
    *to = (cell_object *)from;
    if (Py_TYPE(from) == state->cell) return 0;
    PyErr_Format(PyExc_TypeError, "%s: a Cell is wanted, not %R", what, (PyObject *)Py_TYPE(from));
    return -1;
}

static PyObject *compare_states(PyObject *module, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"robot", "model", "q", ROBOT_QUERY_NAMES, "progress", NULL};
    module_state *state = state_of_module(module);
    PyObject *first, *second, *given, *progress = NULL;
    cell_object *cells[2];
    ovoid_robot_query_options o = {0};
    items states;
    if (!arguments_read(arguments, keywords, "OOO|$" ROBOT_QUERY_FORMAT "O:compare_states", names, &first, &second,
                        &given, ROBOT_QUERY_TARGETS(o), &progress) ||
        query_options_validate(state, &o) || progress_validate(progress) ||
        read_cell(state, first, "robot", &cells[0]) || read_cell(state, second, "model", &cells[1]))
        return NULL;
    size_t variables = robot_variable_count(cells[0]->robot), of_model = robot_variable_count(cells[1]->robot);
    if (variables != of_model)
        return raise_code(state, OVOID_ERROR_ARGUMENT, -1, "the robot has %zu variables and its model %zu", variables,
                          of_model);
    if (state_rows_read(cells[0]->robot, given, "q", &states)) return NULL;
    PyObject *made = compare_read(state, cells, &states, &o, progress);
    free(states.data);
    return made;
}

PyMethodDef robot_functions[] = {
    {"compare_states", METHOD_KEYWORDS(compare_states), METH_VARARGS | METH_KEYWORDS,
     "compare_states(robot: Cell, model: Cell, q: StatesLike, *, " ROBOT_QUERY_SIGNATURE
     ", progress: Progress | None = None) -> Comparison\n--\n\nIn which states (n, variables) do two Cells disagree, "
     "of a robot and of a model of it such as robot.with_spheres(...)?\nA Comparison: counts, an Agreement of each "
     "state, and the missed state where the robot overlaps most. What is said to\nbe missed or invented is proven. "
     "progress(done, total) is called now and then; Ctrl-C ends it."},
    {NULL, NULL, 0, NULL}};
