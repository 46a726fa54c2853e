// The collision matrix of a robot: which pairs of links never touch, always do, or sometimes do.
#include "src/robot/robot.h"

#include <ovoid/robot_matrix.h>

static PyObject *make_state(module_state *state, const double *q, size_t variables) {
    if (!q) Py_RETURN_NONE;
    return array_copy(state, RECORD_DOUBLE, 1, (Py_ssize_t[]){(Py_ssize_t)variables}, q);
}

/// A matrix and whose it is.
typedef struct pairs {
    const robot_object *robot;
    const ovoid_robot_matrix *matrix;
} pairs;

static PyObject *make_pair(const void *context, size_t i) {
    const pairs *p = context;
    ovoid_robot_matrix_pair pair = ovoid_robot_matrix_get_pair(p->matrix, i);
    module_state *state = state_of((PyObject *)p->robot);
    size_t variables = robot_variable_count(p->robot);
    const ovoid_robot_link *links = ovoid_robot_get_description(p->robot->robot).links;
    return PyObject_CallFunction(state->matrix_pair, "ssNNnnnnNNzz", links[pair.a].name, links[pair.b].name,
                                 enum_get(state, ENUM_ROBOT_TOUCH, pair.touch), PyBool_FromLong(pair.is_neighbour),
                                 (Py_ssize_t)pair.samples, (Py_ssize_t)pair.hits, (Py_ssize_t)pair.frees,
                                 (Py_ssize_t)pair.cells, make_state(state, pair.hit, variables),
                                 make_state(state, pair.free, variables), ovoid_robot_matrix_pair_get_reason(&pair, 0),
                                 ovoid_robot_matrix_pair_get_reason(&pair, 1));
}

static PyObject *compute_matrix(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"samples", "budget", "seed", NULL};
    robot_object *self = (robot_object *)object;
    Py_ssize_t samples = 0, budget = 0;
    unsigned long long seed = 0;
    ovoid_error error;
    if (!arguments_read(arguments, keywords, "|$nnK:compute_matrix", names, &samples, &budget, &seed)) return NULL;
    if (samples < 0 || budget < 0)
        return raise_code(state_of(object), OVOID_ERROR_ARGUMENT, -1, "samples and budget are numbers >= 0");
    interrupt signals;
    ovoid_robot_matrix_options o = {
        .samples = (size_t)samples, .budget = (size_t)budget, .seed = seed, .watch = interrupt_begin(&signals)};
    ovoid_robot_matrix *matrix = ovoid_robot_matrix_create(self->robot, &o, &error);
    int is_raised = interrupt_end(&signals);
    if (!matrix && !is_raised) return raise_error(state_of(object), &error);
    pairs all = {self, matrix};
    PyObject *made = is_raised ? NULL : tuple_make(ovoid_robot_matrix_get_count(matrix), make_pair, &all);
    ovoid_robot_matrix_destroy(matrix);
    return made;
}

PyMethodDef robot_matrix_methods[] = {
    {"compute_matrix", METHOD_KEYWORDS(compute_matrix), METH_VARARGS | METH_KEYWORDS,
     "compute_matrix(*, samples: int = 0, budget: int = 0, seed: int = 0) -> tuple[MatrixPair, ...]\n--\n\nWhich pairs "
     "of links never touch, always do, or sometimes do, within the limits: MatrixPair tuples. samples: random\nstates, "
     "0: 10 000; budget: cells of joint space a proof looks at, 0: 100 000. Takes seconds; Ctrl-C ends it."},
    {NULL, NULL, 0, NULL}};
