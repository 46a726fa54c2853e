// The smallest clearance of a path of a cell.
#include "src/robot/robot.h"

#include <math.h>
#include <stdlib.h>

// What is not known is None.
static PyObject *make_clearance(const cell_object *cell, const ovoid_robot_clearance *c) {
    module_state *state = state_of((PyObject *)cell);
    int is_refused = c->status == OVOID_ROBOT_REFUSED, has_pair = !is_refused && c->upper < INFINITY;
    PyObject *a = has_pair ? side_make(cell, &c->a) : Py_NewRef(Py_None);
    PyObject *b = has_pair ? side_make(cell, &c->b) : Py_NewRef(Py_None);
    PyObject *at = has_pair ? PyFloat_FromDouble(c->at) : Py_NewRef(Py_None);
    PyObject *refused = is_refused ? PyLong_FromSize_t(c->refused) : Py_NewRef(Py_None);
    int is_empty = c->status == OVOID_ROBOT_UNDECIDED && c->code == OVOID_ERROR_EMPTY;
    PyObject *code = is_refused || is_empty ? enum_get(state, ENUM_CODE, c->code) : Py_NewRef(Py_None);
    PyObject *variable = is_refused ? PyLong_FromUnsignedLong(c->variable) : Py_NewRef(Py_None);
    return PyObject_CallFunction(state->clearance, "NddNNNNNNI", enum_get(state, ENUM_ROBOT_STATUS, c->status),
                                 c->lower, c->upper, at, a, b, refused, code, variable, c->states);
}

static PyObject *clearance(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {PATH_NAMES, NULL};
    cell_object *self = (cell_object *)object;
    module_state *state = state_of(object);
    path_arguments in;
    ovoid_robot_checker *checker;
    if (path_arguments_read(self, arguments, keywords, "O|$" ROBOT_QUERY_FORMAT "dK:clearance", names, &in))
        return NULL;
    ovoid_robot_path_options o = {.query = in.query, .tolerance = in.tolerance, .states = in.most_states};
    if (checkers_borrow(self, &checker, 1)) {
        free(in.states.data);
        return NULL;
    }
    const ovoid_robot_path path = {in.states.data, (size_t)in.states.shape[0]};
    ovoid_robot_clearance found;
    ovoid_error error;
    interrupt signals;
    o.watch = interrupt_begin(&signals);
    ovoid_code code = ovoid_robot_path_compute_clearance(checker, &(ovoid_robot_path_query){&path, &o}, &found, &error);
    int is_raised = interrupt_end(&signals);
    checkers_return(self, &checker, 1);
    free(in.states.data);
    if (is_raised) return NULL;
    return code == OVOID_OK ? make_clearance(self, &found) : raise_error(state, &error);
}

PyMethodDef cell_clearances[] = {
    {"clearance", METHOD_KEYWORDS(clearance), METH_VARARGS | METH_KEYWORDS,
     "clearance(states: StatesLike, *, " ROBOT_QUERY_SIGNATURE
     ", tolerance: float = 0, most_states: int = 0) -> Clearance\n--\n\nThe least signed distance of any pair at any "
     "time of the path through states (n, variables), linear in between: a\nClearance, whose bracket is proven. "
     "margin: of its status. tolerance: of the bracket, a length, 0: 1/1024 of the\nradius of the largest element; "
     "most_states: looked at, 0: 100 000 and 100 a segment. Ctrl-C ends it."},
    {NULL, NULL, 0, NULL}};
