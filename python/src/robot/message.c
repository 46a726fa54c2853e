// Messages of MoveIt and ROS: planning requests, trajectories; and the planning problems of a folder.
#ifdef OVOID_PYTHON_ROBOT_READ
#include "src/robot/notes.h"
#include "src/robot/robot.h"

#include <math.h>

// ---- requests

static PyObject *make_positions(const ovoid_joint_position *positions, size_t count) {
    PyObject *made = PyDict_New();
    for (size_t i = 0; made && i < count; i++) {
        PyObject *number = PyFloat_FromDouble(positions[i].position);
        if (!number || PyDict_SetItemString(made, positions[i].joint, number)) Py_CLEAR(made);
        Py_XDECREF(number);
    }
    return made;
}

static PyObject *make_goal(const void *request, size_t i) {
    size_t count;
    const ovoid_joint_position *goal = ovoid_motion_request_get_goal(request, i, &count);
    return make_positions(goal, count);
}

static PyObject *make_request(module_state *state, const ovoid_motion_request *request) {
    size_t count;
    const ovoid_joint_position *start = ovoid_motion_request_get_start(request, &count);
    return PyObject_CallFunction(state->motion_request, "sNN", ovoid_motion_request_get_group(request),
                                 make_positions(start, count),
                                 list_make(ovoid_motion_request_get_goal_count(request), make_goal, request));
}

static PyObject *read_motion_request(PyObject *module, PyObject *given) {
    PyObject *path = NULL;
    ovoid_error error;
    if (!PyUnicode_FSConverter(given, &path)) return NULL;
    read_notes told = {NULL, 0, 0};
    ovoid_robot_read_options o = {.note = notes_gather, .context = &told};
    ovoid_motion_request *request = ovoid_motion_request_read(PyBytes_AsString(path), &o, &error);
    module_state *state = state_of_module(module);
    PyObject *made = NULL;
    if (!notes_tell(&told)) made = request ? make_request(state, request) : raise_error(state, &error);
    ovoid_motion_request_destroy(request);
    Py_DECREF(path);
    return made;
}

// ---- trajectories

/// A trajectory, and what its file says up to the point at hand: the start and the points before.
typedef struct trajectory_walk {
    const ovoid_trajectory *trajectory;
    PyObject *points, *last; ///< a list of dicts, and a dict
} trajectory_walk;

static PyObject *make_time(const void *trajectory, size_t i) {
    return PyFloat_FromDouble(ovoid_trajectory_get_time(trajectory, i));
}

// A point names all joints that the start, a point before or itself names.
static int add_point(trajectory_walk *w, size_t i) {
    size_t count;
    const ovoid_joint_position *point = ovoid_trajectory_get_point(w->trajectory, i, &count);
    PyObject *own = make_positions(point, count), *whole = own ? PyDict_Copy(w->last) : NULL;
    int failed = !whole || PyDict_Update(whole, own) || PyList_Append(w->points, whole);
    Py_XDECREF(own);
    if (failed) {
        Py_XDECREF(whole);
        return -1;
    }
    Py_DECREF(w->last);
    w->last = whole;
    return 0;
}

static PyObject *make_trajectory(module_state *state, const ovoid_trajectory *trajectory) {
    size_t count, points = ovoid_trajectory_get_count(trajectory);
    const ovoid_joint_position *positions = ovoid_trajectory_get_start(trajectory, &count);
    PyObject *start = make_positions(positions, count), *made = NULL;
    trajectory_walk walk = {trajectory, start ? PyList_New(0) : NULL, Py_XNewRef(start)};
    int failed = !walk.points;
    for (size_t i = 0; i < points && !failed; i++) failed = add_point(&walk, i);
    if (!failed)
        made = PyObject_CallFunction(state->trajectory, "OON", start, walk.points,
                                     isnan(ovoid_trajectory_get_time(trajectory, 0))
                                         ? Py_NewRef(Py_None)
                                         : list_make(points, make_time, trajectory));
    Py_XDECREF(walk.last);
    Py_XDECREF(walk.points);
    Py_XDECREF(start);
    return made;
}

static PyObject *read_trajectory(PyObject *module, PyObject *given) {
    PyObject *path = NULL, *made = NULL;
    ovoid_error error;
    if (!PyUnicode_FSConverter(given, &path)) return NULL;
    read_notes told = {NULL, 0, 0};
    ovoid_robot_read_options o = {.note = notes_gather, .context = &told};
    ovoid_trajectory *trajectory = ovoid_trajectory_read(PyBytes_AsString(path), &o, &error);
    module_state *state = state_of_module(module);
    if (!notes_tell(&told)) made = trajectory ? make_trajectory(state, trajectory) : raise_error(state, &error);
    ovoid_trajectory_destroy(trajectory);
    Py_DECREF(path);
    return made;
}

// ---- problems

static PyObject *make_problem(const void *problems, size_t i) {
    ovoid_problem p = ovoid_problems_get(problems, i);
    return Py_BuildValue("sNN", p.name, PyUnicode_DecodeFSDefault(p.scene), PyUnicode_DecodeFSDefault(p.request));
}

static PyObject *find_problems(PyObject *module, PyObject *given) {
    PyObject *path = NULL;
    ovoid_error error;
    if (!PyUnicode_FSConverter(given, &path)) return NULL;
    ovoid_problems *problems = ovoid_problems_find(PyBytes_AsString(path), &error);
    Py_DECREF(path);
    if (!problems) return raise_error(state_of_module(module), &error);
    PyObject *list = list_make(ovoid_problems_get_count(problems), make_problem, problems);
    ovoid_problems_destroy(problems);
    return list;
}

PyMethodDef robot_message_functions[] = {
    {"read_motion_request", read_motion_request, METH_O,
     "read_motion_request(path: PathLike, /) -> MotionRequest\n--\n\nA motion planning request of MoveIt (YAML): a "
     "MotionRequest (group, start, goals), states as dicts of joints."},
    {"read_trajectory", read_trajectory, METH_O,
     "read_trajectory(path: PathLike, /) -> Trajectory\n--\n\nA trajectory of MoveIt or ROS (YAML or JSON): a "
     "Trajectory "
     "(start, points, times), states as dicts of joints. A point has the joints that the start or a point before names "
     "too.\nTimes that do not rise are refused."},
    {"find_problems", find_problems, METH_O,
     "find_problems(folder: PathLike, /) -> list[tuple[str, str, str]]\n--\n\nThe planning problems of a folder: a "
     "list of (name, path of the scene, path of the request)."},
    {NULL, NULL, 0, NULL}};
#else
typedef int nothing_to_read; // ISO C wants a declaration
#endif
