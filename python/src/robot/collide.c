// Which states of a cell are free, what they hit, what they are near: one state, or arrays of them without the
// interpreter's lock.
//
// A batch goes in chunks of whole blocks of OVOID_ROBOT_BLOCK states, each of which the library begins as if its
// checker were new; so neither the chunks nor the threads change a bit. Between chunks the caller looks for signals
// (Ctrl-C) and calls `progress` (interrupt.c).
#include "src/robot/robot.h"

#include <math.h>
#include <stdlib.h>

// As the formats of array.c say.
_Static_assert(sizeof(ovoid_robot_side) == 24 && sizeof(ovoid_robot_answer) == 80 && sizeof(ovoid_robot_near) == 152,
               "the formats name every byte");

// ---- answers

int state_has_pair(const ovoid_robot_answer *answer) {
    int is_empty = answer->status == OVOID_ROBOT_UNDECIDED && answer->code == OVOID_ERROR_EMPTY;
    return answer->status == OVOID_ROBOT_HIT || (answer->status == OVOID_ROBOT_UNDECIDED && !is_empty);
}

PyObject *state_answer_make(const cell_object *cell, const ovoid_robot_answer *answer) {
    module_state *state = state_of((PyObject *)cell);
    int is_refused = answer->status == OVOID_ROBOT_REFUSED;
    int is_empty = answer->status == OVOID_ROBOT_UNDECIDED && answer->code == OVOID_ERROR_EMPTY;
    int has_pair = state_has_pair(answer);
    PyObject *a = has_pair ? side_make(cell, &answer->a) : Py_NewRef(Py_None);
    PyObject *b = has_pair ? side_make(cell, &answer->b) : Py_NewRef(Py_None);
    PyObject *code = is_refused || is_empty ? enum_get(state, ENUM_CODE, answer->code) : Py_NewRef(Py_None);
    PyObject *variable = is_refused ? PyLong_FromUnsignedLong(answer->variable) : Py_NewRef(Py_None);
    return PyObject_CallFunction(state->state_answer, "NNNddNN", enum_get(state, ENUM_ROBOT_STATUS, answer->status), a,
                                 b, has_pair ? answer->lower : NAN, has_pair ? answer->upper : NAN, code, variable);
}

int query_options_validate(module_state *state, const ovoid_robot_query_options *o) {
    if (o->margin >= 0 && o->limit_slack >= 0) return 0;
    raise_code(state, OVOID_ERROR_ARGUMENT, -1, "margin and limit_slack are numbers >= 0");
    return -1;
}

// ---- one state

static PyObject *collide(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"q", ROBOT_QUERY_NAMES, NULL};
    cell_object *self = (cell_object *)object;
    module_state *state = state_of(object);
    PyObject *given;
    ovoid_robot_query_options o = {0};
    ovoid_robot_checker *checker;
    if (!arguments_read(arguments, keywords, "O|$" ROBOT_QUERY_FORMAT ":collide", names, &given,
                        ROBOT_QUERY_TARGETS(o)) ||
        query_options_validate(state, &o))
        return NULL;
    double *q = state_read(self->robot, given);
    if (!q || checkers_borrow(self, &checker, 1)) {
        free(q);
        return NULL;
    }
    ovoid_robot_answer answer;
    ovoid_error error;
    ovoid_code code;
    Py_BEGIN_ALLOW_THREADS;
    code = ovoid_robot_collide(checker, &(ovoid_robot_query){q, &o}, &answer, &error);
    Py_END_ALLOW_THREADS;
    checkers_return(self, &checker, 1);
    free(q);
    return code == OVOID_OK ? state_answer_make(self, &answer) : raise_error(state, &error);
}

// ---- near pairs

typedef struct near_query {
    const double *q;
    ovoid_robot_query_options options;
    int is_nearest;
} near_query;

// Asks again with more memory where the pairs were more than there was room for.
static ovoid_code find_near(ovoid_robot_checker *checker, const near_query *query, size_t variables,
                            ovoid_robot_nears *nears, ovoid_error *error) {
    for (nears->capacity = query->is_nearest ? 1 : 32;; nears->capacity = nears->count) {
        ovoid_robot_near *pairs = realloc(nears->items, nears->capacity * sizeof *pairs);
        if (pairs) nears->items = pairs;
        double *gradients = realloc(nears->gradients, nears->capacity * (variables + 1) * sizeof *gradients);
        if (gradients) nears->gradients = gradients;
        if (!pairs || !gradients) {
            error->code = OVOID_ERROR_MEMORY;
            return OVOID_ERROR_MEMORY;
        }
        ovoid_code code =
            query->is_nearest
                ? ovoid_robot_find_nearest(checker, &(ovoid_robot_query){query->q, &query->options}, nears, error)
                : ovoid_robot_find_near(checker, &(ovoid_robot_query){query->q, &query->options}, nears, error);
        if (code != OVOID_OK || nears->count <= nears->capacity) return code;
    }
}

static PyObject *near_or_nearest(PyObject *object, PyObject *arguments, PyObject *keywords, int is_nearest) {
    static char *names[] = {"q", ROBOT_QUERY_NAMES, NULL};
    static char *near_names[] = {"q", ROBOT_QUERY_NAMES, "without_depths", NULL};
    cell_object *self = (cell_object *)object;
    module_state *state = state_of(object);
    PyObject *given;
    int without_depths = 0;
    near_query query = {.options.margin = is_nearest ? INFINITY : 0, .is_nearest = is_nearest};
    ovoid_robot_checker *checker;
    int is_read = is_nearest ? arguments_read(arguments, keywords, "O|$" ROBOT_QUERY_FORMAT ":nearest", names, &given,
                                              ROBOT_QUERY_TARGETS(query.options))
                             : arguments_read(arguments, keywords, "Od|$dppp:near", near_names, &given,
                                              ROBOT_QUERY_TARGETS(query.options), &without_depths);
    if (!is_read || query_options_validate(state, &query.options)) return NULL;
    double *q = state_read(self->robot, given);
    if (!q || checkers_borrow(self, &checker, 1)) {
        free(q);
        return NULL;
    }
    query.q = q;
    ovoid_robot_nears nears = {.without_depths = without_depths};
    size_t variables = robot_variable_count(self->robot);
    ovoid_error error;
    ovoid_code code;
    Py_BEGIN_ALLOW_THREADS;
    code = find_near(checker, &query, variables, &nears, &error);
    Py_END_ALLOW_THREADS;
    checkers_return(self, &checker, 1);
    PyObject *made = NULL;
    if (code != OVOID_OK) {
        raise_error(state, &error);
    } else {
        Py_ssize_t shape[] = {(Py_ssize_t)nears.count, (Py_ssize_t)variables};
        PyObject *pairs = array_copy(state, RECORD_NEAR, 1, shape, nears.items);
        PyObject *gradients = pairs ? array_copy(state, RECORD_DOUBLE, 2, shape, nears.gradients) : NULL;
        if (gradients)
            made = Py_BuildValue("NN", pairs, gradients);
        else
            Py_XDECREF(pairs);
    }
    free(nears.items);
    free(nears.gradients);
    free(q);
    return made;
}

static PyObject *near(PyObject *object, PyObject *arguments, PyObject *keywords) {
    return near_or_nearest(object, arguments, keywords, 0);
}
static PyObject *nearest(PyObject *object, PyObject *arguments, PyObject *keywords) {
    return near_or_nearest(object, arguments, keywords, 1);
}

// ---- many states

/// States in work: of collide_batch the answers, of nearest_batch the nearest pairs and their gradients.
typedef struct job {
    ovoid_robot_checker *checkers[THREADS_MOST];
    size_t checker_count, variables, count;
    const double *q;
    ovoid_robot_query_options options;
    ovoid_robot_answer *answers;
    ovoid_robot_near *nears;
    double *gradients;
} job;

// The nearest pair of some states, by one checker, blocks as a batch has them.
static ovoid_code find_nearest_of(const job *j, size_t first, size_t count, ovoid_error *error) {
    for (size_t i = first; i < first + count; i++) {
        if (i % OVOID_ROBOT_BLOCK == 0) ovoid_robot_checker_reset(j->checkers[0]);
        ovoid_robot_nears one = {.items = &j->nears[i], .gradients = j->gradients + i * j->variables, .capacity = 1};
        const double *q = j->q + i * j->variables;
        ovoid_code code = ovoid_robot_find_nearest(j->checkers[0], &(ovoid_robot_query){q, &j->options}, &one, error);
        if (code != OVOID_OK) {
            if (code != OVOID_ERROR_MEMORY) error->place = (int64_t)i;
            return code;
        }
        if (one.count) continue;
        j->nears[i] = (ovoid_robot_near){.a = {OVOID_ROBOT_NONE, OVOID_ROBOT_NONE, 0, 0},
                                         .b = {OVOID_ROBOT_NONE, OVOID_ROBOT_NONE, 0, 0},
                                         .status = OVOID_SEPARATED,
                                         .lower = j->options.margin,
                                         .upper = INFINITY};
        for (size_t k = 0; k < j->variables; k++) one.gradients[k] = 0;
    }
    return OVOID_OK;
}

static ovoid_code run_piece(void *context, size_t first, size_t count, ovoid_error *error) {
    const job *j = context;
    if (j->nears) return find_nearest_of(j, first, count, error);
    ovoid_robot_batch batch = {j->q + first * j->variables, count, &j->options, j->answers + first};
    ovoid_code code = ovoid_robot_collide_batch(j->checkers, j->checker_count, &batch, error);
    return code == OVOID_ERROR_LIMIT ? OVOID_OK : code; // fewer threads could be started; the others did the work
}

typedef struct states_input {
    PyObject *q, *out, *progress;
    int threads;
    items states;
} states_input;

static int read_input(cell_object *self, states_input *in, job *j) {
    module_state *state = state_of((PyObject *)self);
    j->variables = robot_variable_count(self->robot);
    if (query_options_validate(state, &j->options)) return -1;
    if (threads_validate(state, in->threads) || progress_validate(in->progress)) return -1;
    if (state_rows_read(self->robot, in->q, "q", &in->states)) return -1;
    j->q = in->states.data;
    j->count = (size_t)in->states.shape[0];
    j->checker_count = (size_t)in->threads;
    return 0;
}

// Runs the job into arrays that are there.
static int borrow_and_run(cell_object *self, job *j, PyObject *progress) {
    if (checkers_borrow(self, j->checkers, j->checker_count)) return -1;
    const pieces work = {j->count, OVOID_ROBOT_BLOCK * j->checker_count, run_piece, j, progress};
    int failed = pieces_run(state_of((PyObject *)self), &work);
    checkers_return(self, j->checkers, j->checker_count);
    return failed;
}

static PyObject *collide_batch(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"q", ROBOT_QUERY_NAMES, "threads", "out", "progress", NULL};
    cell_object *self = (cell_object *)object;
    module_state *state = state_of(object);
    states_input in = {.threads = 1};
    job j = {.count = 0};
    if (!arguments_read(arguments, keywords, "O|$" ROBOT_QUERY_FORMAT "iOO:collide_batch", names, &in.q,
                        ROBOT_QUERY_TARGETS(j.options), &in.threads, &in.out, &in.progress) ||
        read_input(self, &in, &j))
        return NULL;
    Py_buffer view = {.obj = NULL};
    Py_ssize_t count = (Py_ssize_t)j.count;
    PyObject *array = NULL;
    if (!in.out || in.out == Py_None) {
        array = array_make(state, RECORD_STATE, 1, &count, &j.answers);
    } else if (!records_view(state, in.out, "out", RECORD_STATE, count, 1, &view)) {
        array = Py_NewRef(in.out);
        j.answers = view.buf;
    }
    if (array && borrow_and_run(self, &j, in.progress)) Py_CLEAR(array);
    free(in.states.data);
    if (!view.obj) return array_wrap(state, array);
    PyBuffer_Release(&view);
    return array;
}

static PyObject *nearest_batch(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"q", ROBOT_QUERY_NAMES, "progress", NULL};
    cell_object *self = (cell_object *)object;
    module_state *state = state_of(object);
    states_input in = {.threads = 1};
    job j = {.options.margin = INFINITY};
    if (!arguments_read(arguments, keywords, "O|$" ROBOT_QUERY_FORMAT "O:nearest_batch", names, &in.q,
                        ROBOT_QUERY_TARGETS(j.options), &in.progress) ||
        read_input(self, &in, &j))
        return NULL;
    Py_ssize_t shape[] = {(Py_ssize_t)j.count, (Py_ssize_t)j.variables};
    PyObject *pairs = array_make(state, RECORD_NEAR, 1, shape, &j.nears);
    PyObject *gradients = pairs ? array_make(state, RECORD_DOUBLE, 2, shape, &j.gradients) : NULL;
    int failed = !gradients || borrow_and_run(self, &j, in.progress);
    free(in.states.data);
    if (failed) {
        Py_XDECREF(pairs);
        Py_XDECREF(gradients);
        return NULL;
    }
    pairs = array_wrap(state, pairs);
    gradients = array_wrap(state, gradients);
    if (pairs && gradients) return Py_BuildValue("NN", pairs, gradients);
    Py_XDECREF(pairs);
    Py_XDECREF(gradients);
    return NULL;
}

// ---- proven paths: robot_path.c

PyObject *find_hit(PyObject *object, PyObject *arguments, PyObject *keywords);
PyObject *find_hit_batch(PyObject *object, PyObject *arguments, PyObject *keywords);

#define NEAREST_SIGNATURE                                                                                              \
    "margin: float = 1e999, limit_slack: float = 0, without_self: bool = False, without_obstacles: bool = False"
#define NEAR_DOC                                                                                                       \
    "records link_a, element_a, body_a, part_a,\nlink_b, ..., status, lower, upper, point_a, point_b, normal (root "   \
    "link's frame), has_gradient; and the gradients\nd distance / d q, "
PyMethodDef cell_queries[] = {
    {"collide", METHOD_KEYWORDS(collide), METH_VARARGS | METH_KEYWORDS,
     "collide(q: StateLike, *, " ROBOT_QUERY_SIGNATURE
     ") -> StateAnswer\n--\n\nIs a state, an array (variables,), free? A StateAnswer: its status is FREE (all pairs "
     "proven farther apart than\nmargin), HIT (a pair proven within it), UNDECIDED (treat it as a hit) or REFUSED "
     "(outside its limits by more than\nlimit_slack). Begins with the pair that ended the state before."},
    {"collide_batch", METHOD_KEYWORDS(collide_batch), METH_VARARGS | METH_KEYWORDS,
     "collide_batch(q: StatesLike, *, " ROBOT_QUERY_SIGNATURE
     ", threads: int = 1, out: Records | None = None, progress: Progress | None = None) -> Records\n--\n\nMany states, "
     "(n, variables): an array of n records status (RobotStatus by number), code, variable, link_a, "
     "element_a,\nbody_a, part_a, link_b, ..., lower, upper; 2**32 - 1 is no link, no element. The same bits on any "
     "number of threads.\nout: an array of zeros('states', n). progress(done, total) is called now and then; Ctrl-C "
     "ends it."},
    {"near", METHOD_KEYWORDS(near), METH_VARARGS | METH_KEYWORDS,
     "near(q: StateLike, margin: float, *, limit_slack: float = 0, without_self: bool = False, without_obstacles: bool "
     "= "
     "False, without_depths: bool = False) -> tuple[Records, Floats]\n--\n\nAll pairs that are not proven farther "
     "apart than margin, nearest first: " NEAR_DOC "(m, variables). without_depths: of most pairs that overlap only "
     "that is\nsaid, by a bracket that ends below zero."},
    {"nearest", METHOD_KEYWORDS(nearest), METH_VARARGS | METH_KEYWORDS,
     "nearest(q: StateLike, *, " NEAREST_SIGNATURE
     ") -> tuple[Records, Floats]\n--\n\nThe nearest pair, where one is not proven farther apart than margin: one "
     "record or none, as of near, and its gradient."},
    {"nearest_batch", METHOD_KEYWORDS(nearest_batch), METH_VARARGS | METH_KEYWORDS,
     "nearest_batch(q: StatesLike, *, " NEAREST_SIGNATURE
     ", progress: Progress | None = None) -> tuple[Records, Floats]\n--\n\nThe nearest pair of many states, (n, "
     "variables): n " NEAR_DOC "(n, variables). Where none is within margin, lower is margin\nand upper inf. A state "
     "that is refused raises Error, place its number."},
    {"find_hit", METHOD_KEYWORDS(find_hit), METH_VARARGS | METH_KEYWORDS,
     "find_hit(states: StatesLike, *, " ROBOT_QUERY_SIGNATURE
     ", tolerance: float = 0, most_states: int = 0, any_hit: bool = False) -> RobotPath\n--\n\nIs the path through "
     "states (n, variables), linear in between, free at all times? A RobotPath with its proof,\nwhich verify() checks. "
     "tolerance: of hit_at - free_until, 0: 2**-20; most_states: looked at, 0: 100 000. any_hit: the search ends with "
     "any hit, which need not be the first; the pair's bracket may then be wide."},
    {"find_hit_batch", METHOD_KEYWORDS(find_hit_batch), METH_VARARGS | METH_KEYWORDS,
     "find_hit_batch(begins: StatesLike, ends: StatesLike, *, " ROBOT_QUERY_SIGNATURE
     ", tolerance: float = 0, most_states: int = 0, any_hit: bool = False, threads: int = 1, progress: Progress | None "
     "= None) -> tuple[Records, Floats]\n--\n\nIs each of many edges, from a state of begins (n, variables) to that of "
     "ends, free at all times? n records as those of\ncollide_batch, with the edge's status and the pair of its hit; "
     "and (n, 2) times: free_until, hit_at, as of find_hit.\nany_hit is sooner: short edges are proven side by side. "
     "The "
     "same bits on any number of threads. progress(done, total)\nis called now and then; Ctrl-C ends it."},
    {NULL, NULL, 0, NULL}};
