// The collision matrix of a robot: which pairs of links never touch, always do, or sometimes do.
#include "src/robot/robot.h"

#include <ovoid/robot_matrix.h>

static PyObject *make_state(module_state *state, const double *q, size_t variables) {
    if (!q) Py_RETURN_NONE;
    return array_copy(state, RECORD_DOUBLE, 1, (Py_ssize_t[]){(Py_ssize_t)variables}, q);
}

static PyObject *make_pair(const robot_object *self, const ovoid_robot_matrix_pair *pair) {
    module_state *state = state_of((PyObject *)self);
    size_t variables = robot_variable_count(self);
    const ovoid_robot_link *links = ovoid_robot_get_description(self->robot).links;
    return PyObject_CallFunction(state->matrix_pair, "ssNNnnnnNNzz", links[pair->a].name, links[pair->b].name,
                                 enum_get(state, ENUM_ROBOT_TOUCH, pair->touch), PyBool_FromLong(pair->is_neighbour),
                                 (Py_ssize_t)pair->samples, (Py_ssize_t)pair->hits, (Py_ssize_t)pair->frees,
                                 (Py_ssize_t)pair->cells, make_state(state, pair->hit, variables),
                                 make_state(state, pair->free, variables), ovoid_robot_matrix_pair_get_reason(pair, 0),
                                 ovoid_robot_matrix_pair_get_reason(pair, 1));
}

static PyObject *make_pairs(const robot_object *self, const ovoid_robot_matrix *matrix) {
    size_t count = ovoid_robot_matrix_get_count(matrix);
    PyObject *made = PyTuple_New((Py_ssize_t)count);
    for (size_t i = 0; made && i < count; i++) {
        ovoid_robot_matrix_pair pair = ovoid_robot_matrix_get_pair(matrix, i);
        PyObject *one = make_pair(self, &pair);
        if (!one)
            Py_CLEAR(made);
        else
            PyTuple_SetItem(made, (Py_ssize_t)i, one);
    }
    return made;
}

static PyObject *compute_matrix(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"samples", "budget", "seed", NULL};
    robot_object *self = (robot_object *)object;
    Py_ssize_t samples = 0, budget = 0;
    unsigned long long seed = 0;
    ovoid_error error;
    if (!PyArg_ParseTupleAndKeywords(arguments, keywords, "|$nnK:compute_matrix", names, &samples, &budget, &seed))
        return NULL;
    if (samples < 0 || budget < 0)
        return raise_code(state_of(object), OVOID_ERROR_ARGUMENT, -1, "samples and budget are numbers >= 0");
    interrupt signals;
    ovoid_robot_matrix_options o = {
        .samples = (size_t)samples, .budget = (size_t)budget, .seed = seed, .watch = interrupt_begin(&signals)};
    ovoid_robot_matrix *matrix = ovoid_robot_matrix_create(self->robot, &o, NULL, &error);
    int is_raised = interrupt_end(&signals);
    if (!matrix && !is_raised) return raise_error(state_of(object), &error);
    PyObject *made = is_raised ? NULL : make_pairs(self, matrix);
    ovoid_robot_matrix_destroy(matrix);
    return made;
}

PyMethodDef robot_matrix_methods[] = {
    {"compute_matrix", METHOD_KEYWORDS(compute_matrix), METH_VARARGS | METH_KEYWORDS,
     "compute_matrix(*, samples: int = 0, budget: int = 0, seed: int = 0) -> tuple[MatrixPair, ...]\n--\n\nWhich pairs "
     "of links never touch, always do, or sometimes do, within the limits: MatrixPair tuples. samples: random\nstates, "
     "0: 10 000; budget: cells of joint space a proof looks at, 0: 100 000. Takes seconds; Ctrl-C ends it."},
    {NULL, NULL, 0, NULL}};
