// Cell.find_hit_batch: many edges, several side by side.
#include "src/robot/robot.h"

#include <ovoid/robot_path.h>

#include <stdlib.h>
#include <string.h>

/// Edges in work, and where their answers go.
typedef struct job {
    ovoid_robot_checker *checkers[THREADS_MOST];
    size_t checker_count, variables, count;
    double *states; ///< two of each
    ovoid_robot_path_options options;
    ovoid_robot_answer *answers;
    double *times; ///< free_until and hit_at of each
} job;

static ovoid_code run_piece(void *context, size_t first, size_t count, ovoid_error *error) {
    const job *j = context;
    ovoid_robot_path_answer *found = calloc(count + 1, sizeof *found);
    if (!found) return error->code = OVOID_ERROR_MEMORY;
    const ovoid_robot_edge_batch batch = {j->states + 2 * first * j->variables, count, &j->options, found};
    ovoid_code code = ovoid_robot_path_find_hit_batch(j->checkers, j->checker_count, &batch, error);
    for (size_t i = 0; i < count; i++) {
        ovoid_robot_answer *to = &j->answers[first + i];
        *to = found[i].hit;
        to->status = found[i].status;
        j->times[2 * (first + i)] = found[i].free_until;
        j->times[2 * (first + i) + 1] = found[i].hit_at;
    }
    free(found);
    return code == OVOID_ERROR_LIMIT ? OVOID_OK : code; // fewer threads could be started; the others did the work
}

// The states of both arrays in turn; -1: raised.
static int join(module_state *state, const items ends[2], job *j) {
    if (ends[0].shape[0] != ends[1].shape[0]) {
        raise_code(state, OVOID_ERROR_ARGUMENT, -1,
                   "find_hit_batch: as many begins as ends are wanted, not %zd and %zd", ends[0].shape[0],
                   ends[1].shape[0]);
        return -1;
    }
    size_t size = j->variables * sizeof(double);
    j->count = (size_t)ends[0].shape[0];
    j->states = malloc(2 * j->count * size + 1);
    if (!j->states) {
        PyErr_NoMemory();
        return -1;
    }
    for (size_t i = 0; size && i < 2 * j->count; i++)
        memcpy(j->states + i * j->variables, (const double *)ends[i % 2].data + i / 2 * j->variables, size);
    return 0;
}

static PyObject *run(cell_object *self, job *j, PyObject *progress) {
    module_state *state = state_of((PyObject *)self);
    Py_ssize_t shape[] = {(Py_ssize_t)j->count, 2};
    PyObject *answers = array_make(state, RECORD_STATE, 1, shape, &j->answers);
    PyObject *times = answers ? array_make(state, RECORD_DOUBLE, 2, shape, &j->times) : NULL;
    int failed = !times || checkers_borrow(self, j->checkers, j->checker_count);
    if (!failed) {
        const pieces work = {j->count, OVOID_ROBOT_BLOCK * j->checker_count, run_piece, j, progress};
        failed = pieces_run(state, &work);
        checkers_return(self, j->checkers, j->checker_count);
    }
    if (failed) {
        Py_XDECREF(answers);
        Py_XDECREF(times);
        return NULL;
    }
    answers = array_wrap(state, answers);
    times = array_wrap(state, times);
    if (answers && times) return Py_BuildValue("NN", answers, times);
    Py_XDECREF(answers);
    Py_XDECREF(times);
    return NULL;
}

PyObject *find_hit_batch(PyObject *object, PyObject *arguments, PyObject *keywords);
PyObject *find_hit_batch(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"begins",  "ends",    ROBOT_QUERY_NAMES, "tolerance", "most_states",
                            "any_hit", "threads", "progress",        NULL};
    cell_object *self = (cell_object *)object;
    module_state *state = state_of(object);
    job j = {.variables = robot_variable_count(self->robot)};
    PyObject *given[2], *progress = NULL;
    unsigned long long most = 0;
    int threads = 1;
    items ends[2] = {{NULL, {0, 0, 0}}, {NULL, {0, 0, 0}}};
    if (!arguments_read(arguments, keywords, "OO|$" ROBOT_QUERY_FORMAT "dKpiO:find_hit_batch", names, &given[0],
                        &given[1], ROBOT_QUERY_TARGETS(j.options.query), &j.options.tolerance, &most,
                        &j.options.any_hit, &threads, &progress) ||
        query_options_validate(state, &j.options.query) || threads_validate(state, threads) ||
        progress_validate(progress))
        return NULL;
    if (most > UINT32_MAX) return raise_code(state, OVOID_ERROR_ARGUMENT, -1, "most_states: 0 to 2^32 - 1 are wanted");
    j.options.states = (uint32_t)most;
    j.checker_count = (size_t)threads;
    PyObject *made = NULL;
    if (!state_rows_read(self->robot, given[0], "begins", &ends[0]) &&
        !state_rows_read(self->robot, given[1], "ends", &ends[1]) && !join(state, ends, &j))
        made = run(self, &j, progress);
    free(ends[0].data);
    free(ends[1].data);
    free(j.states);
    return made;
}
