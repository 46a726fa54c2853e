// Cell._search: the search for a path by a planner of OMPL, which the module ovoid._ompl has where it was built;
// ovoid/_planning.py calls it.
#include "plan/search.h"
#include "src/robot/robot.h"

#include <stdlib.h>
#include <string.h>

/// What the search is given, in memory to be freed.
typedef struct search_input {
    search_problem problem;
    items start, goals, moving; ///< moving: int64_t
    uint32_t *variables;
} search_input;

static void clear_input(search_input *in) {
    free(in->start.data);
    free(in->goals.data);
    free(in->moving.data);
    free(in->variables);
}

static const search_entry *read_entry(PyObject *capsule) {
    const search_entry *entry = PyCapsule_GetPointer(capsule, "ovoid search");
    if (entry && strcmp(entry->version, ovoid_get_version()) != 0) {
        PyErr_Format(PyExc_ImportError, "ovoid._ompl is of version %s, ovoid of %s", entry->version,
                     ovoid_get_version());
        return NULL;
    }
    return entry;
}

static int read_input(cell_object *self, PyObject *const given[3], search_input *in) {
    module_state *state = state_of((PyObject *)self);
    Py_ssize_t count = (Py_ssize_t)robot_variable_count(self->robot);
    if (query_options_validate(state, &in->problem.query) ||
        items_read(state, given[0], "start", 1, &count, 'd', &in->start) ||
        items_read(state, given[1], "goals", 2, (Py_ssize_t[]){-1, count}, 'd', &in->goals) ||
        items_read(state, given[2], "moving", 1, (Py_ssize_t[]){-1}, 'q', &in->moving))
        return -1;
    size_t moving = (size_t)in->moving.shape[0];
    in->variables = malloc((moving + 1) * sizeof *in->variables);
    if (!in->variables) return PyErr_NoMemory(), -1;
    for (size_t i = 0; i < moving; i++) in->variables[i] = (uint32_t)((const int64_t *)in->moving.data)[i];
    in->problem.robot = self->robot->robot;
    in->problem.cell = self->cell;
    in->problem.start = in->start.data;
    in->problem.goals = in->goals.data;
    in->problem.goal_count = (size_t)in->goals.shape[0];
    in->problem.moving = in->variables;
    in->problem.moving_count = moving;
    return 0;
}

// (states, length, raw length, seconds to plan, to shorten, motions); states None: no path.
static PyObject *make_result(cell_object *self, const search_result *found) {
    module_state *state = state_of((PyObject *)self);
    if (found->why[0]) return raise_code(state, OVOID_ERROR_ARGUMENT, -1, "the planner refused: %s", found->why);
    Py_ssize_t shape[] = {(Py_ssize_t)found->count, (Py_ssize_t)robot_variable_count(self->robot)};
    PyObject *states = found->q ? array_copy(state, RECORD_DOUBLE, 2, shape, found->q) : Py_NewRef(Py_None);
    return Py_BuildValue("(NddddI)", states, found->length, found->raw_length, found->planned, found->shortened,
                         found->motions);
}

static PyObject *search(PyObject *object, PyObject *arguments) {
    cell_object *self = (cell_object *)object;
    search_input in = {.variables = NULL};
    search_problem *p = &in.problem;
    PyObject *capsule, *given[3], *made = NULL;
    int planner;
    if (!PyArg_ParseTuple(arguments, "OOOOddppiIdp:_search", &capsule, &given[0], &given[1], &given[2],
                          &p->query.margin, &p->query.limit_slack, &p->query.without_self, &p->query.without_obstacles,
                          &planner, &p->seed, &p->seconds, &p->is_raw))
        return NULL;
    p->planner = (search_planner)planner;
    const search_entry *entry = read_entry(capsule);
    if (entry && !read_input(self, given, &in)) {
        interrupt signals;
        self->readers++;
        p->watch = interrupt_begin(&signals);
        search_result found = entry->search(p);
        int is_raised = interrupt_end(&signals);
        self->readers--;
        if (!is_raised) made = make_result(self, &found);
        free(found.q);
    }
    clear_input(&in);
    return made;
}

PyMethodDef cell_plans[] = {{"_search", search, METH_VARARGS, NULL}, {NULL, NULL, 0, NULL}};
