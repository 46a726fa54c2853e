// Motion: where a body is at which time; an exact mathematical object, checked when it is made.
#include "src/motion.h"

#include <stdlib.h>

PyObject *motion_wrap_arrays(module_state *state, ovoid_motion motion, double *times, ovoid_pose *poses) {
    ovoid_error error;
    motion_object *self = NULL;
    if (ovoid_motion_validate(&motion, &error) != OVOID_OK)
        raise_error(state, &error);
    else
        self = object_make(state->motion);
    if (self) {
        self->motion = motion;
        self->times = times;
        self->poses = poses;
    } else {
        free(times);
        free(poses);
    }
    return (PyObject *)self;
}

PyObject *motion_wrap(module_state *state, ovoid_motion motion) {
    return motion_wrap_arrays(state, motion, NULL, NULL);
}

PyObject *motion_read(module_state *state, PyObject *from, const char *what) {
    if (from && Py_TYPE(from) == state->motion) return Py_NewRef(from);
    ovoid_pose pose;
    if (pose_read(state, from, what, &pose)) return NULL;
    return motion_wrap(state, ovoid_motion_make_still(pose));
}

// ---- constructors

static PyObject *still(PyObject *type, PyObject *given) {
    module_state *state = state_of_type(type);
    ovoid_pose pose;
    return pose_read(state, given, "pose", &pose) ? NULL : motion_wrap(state, ovoid_motion_make_still(pose));
}

static PyObject *velocity(PyObject *type, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"start", "linear", "angular", "duration", "pivot", NULL};
    module_state *state = state_of_type(type);
    PyObject *start, *linear, *angular, *pivot = NULL;
    double duration;
    ovoid_pose pose;
    ovoid_vec3 along, around, still_point = {0, 0, 0};
    if (!arguments_read(arguments, keywords, "OOOd|$O:velocity", names, &start, &linear, &angular, &duration, &pivot) ||
        pose_read(state, start, "start", &pose) || vec3_read(state, linear, "linear", &along) ||
        vec3_read(state, angular, "angular", &around) || (pivot && vec3_read(state, pivot, "pivot", &still_point)))
        return NULL;
    ovoid_motion motion = ovoid_motion_make_velocity(pose, along, around, duration);
    motion.pivot = still_point;
    return motion_wrap(state, motion);
}

static PyObject *poses(PyObject *type, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"start", "end", "duration", NULL};
    module_state *state = state_of_type(type);
    PyObject *first, *last;
    double duration = 1;
    ovoid_pose start, end;
    if (!arguments_read(arguments, keywords, "OO|d:poses", names, &first, &last, &duration) ||
        pose_read(state, first, "start", &start) || pose_read(state, last, "end", &end))
        return NULL;
    return motion_wrap(state, ovoid_motion_make_poses(start, end, duration));
}

static PyObject *path(PyObject *type, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"times", "poses", "order", NULL};
    module_state *state = state_of_type(type);
    PyObject *given_times, *given_poses;
    const char *order = NULL;
    ovoid_pose *places;
    Py_ssize_t count;
    items times;
    if (!arguments_read(arguments, keywords, "OO|$z:path", names, &given_times, &given_poses, &order) ||
        poses_read(state, given_poses, order, &places, &count))
        return NULL;
    if (items_read(state, given_times, "times", 1, &count, 'd', &times)) {
        free(places);
        return NULL;
    }
    return motion_wrap_arrays(state, ovoid_motion_make_path(times.data, places, (size_t)count), times.data, places);
}

// ---- what it is

static PyObject *pose(PyObject *self, PyObject *given) {
    double time = PyFloat_AsDouble(given);
    if (time == -1 && PyErr_Occurred()) return NULL;
    if (time != time) return raise_code(state_of(self), OVOID_ERROR_NOT_FINITE, -1, "time: it is NaN");
    return pose_wrap(state_of(self), ovoid_motion_compute_pose(&((motion_object *)self)->motion, time));
}

static PyObject *swept(PyObject *self, PyObject *arguments) {
    module_state *state = state_of(self);
    PyObject *given;
    double begin, end;
    ovoid_body body;
    if (!PyArg_ParseTuple(arguments, "Odd:swept", &given, &begin, &end) || body_read(state, given, "body", &body))
        return NULL;
    ovoid_moving_body moving = {
        .shape = body.shape, .compound = body.compound, .solid = body.solid, .motion = ((motion_object *)self)->motion};
    ovoid_box box = ovoid_moving_body_compute_box(&moving, begin, end);
    if (box.min.x != box.min.x)
        return raise_code(state, OVOID_ERROR_ARGUMENT, -1, "swept: begin <= end is wanted, and no NaN");
    return Py_BuildValue("((ddd)(ddd))", box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z);
}

static void motion_dealloc(PyObject *self) {
    free(((motion_object *)self)->times);
    free(((motion_object *)self)->poses);
    object_free(self);
}

static PyMethodDef methods[] = {
    {"still", still, METH_O | METH_CLASS, "still(pose: PoseLike, /) -> Motion\n--\n\nAt a pose at all times."},
    {"velocity", METHOD_KEYWORDS(velocity), METH_VARARGS | METH_KEYWORDS | METH_CLASS,
     "velocity(start: PoseLike, linear: Numbers, angular: Numbers, duration: float, *, pivot: Numbers = (0, 0, 0)) -> "
     "Motion\n--\n\nConstant velocities from time 0 to duration: linear in lengths, angular in radians a unit of time, "
     "world axes. pivot,\nlocal frame: the point that moves along a straight line."},
    {"poses", METHOD_KEYWORDS(poses), METH_VARARGS | METH_KEYWORDS | METH_CLASS,
     "poses(start: PoseLike, end: PoseLike, duration: float = 1) -> Motion\n--\n\nFrom one pose to another, the "
     "shorter way round (slerp)."},
    {"path", METHOD_KEYWORDS(path), METH_VARARGS | METH_KEYWORDS | METH_CLASS,
     "path(times: Numbers, poses: PosesLike, *, order: Order = None) -> Motion\n--\n\nThrough poses at strictly "
     "increasing times (n,); poses and order as in Bodies."},
    {"pose", pose, METH_O,
     "pose(time: float, /) -> Pose\n--\n\nThe pose at a time; before and after its times a motion rests."},
    {"swept", swept, METH_VARARGS,
     "swept(body: Body, begin: float, end: float, /) -> Box\n--\n\nA box that holds a body at all times of [begin, "
     "end]: (least corner, greatest corner)."},
    {NULL, NULL, 0, NULL}};
static PyType_Slot slots[] = {{Py_tp_doc, "A motion: Motion.still, velocity, poses or path. Immutable."},
                              {Py_tp_dealloc, motion_dealloc},
                              {Py_tp_methods, methods},
                              {0, NULL}};
static PyType_Spec spec = {"ovoid.Motion", sizeof(motion_object), 0,
                           Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION, slots};

int motion_add(PyObject *module) { return type_add(module, &spec, &state_of_module(module)->motion); }
