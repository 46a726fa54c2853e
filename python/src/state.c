// The state of a result as bytes, for pickle (ovoid/_pickle.py): one function for each kind of object tells what its
// state is, and is run to measure, to write and to read it.
//
// What is read may be any bytes: lengths, indices of parts and poses are checked, so that an object is valid or
// refused. Whether its numbers are true is the matter of verify().
#include "src/manifold/manifold.h"
#include "src/motion.h"
#include "src/query.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// A pass over a state. data NULL: it is measured.
typedef struct transfer {
    char *data;
    size_t size, at;
    int is_reading, failed;
} transfer;

static void pass(transfer *t, void *value, size_t size) {
    if (t->data && !t->failed && size <= t->size - t->at) {
        if (t->is_reading)
            memcpy(value, t->data + t->at, size);
        else
            memcpy(t->data + t->at, value, size);
    } else if (t->data) {
        t->failed = 1;
        return;
    }
    t->at += size;
}

// An array of *count items; read into memory of its own.
static void pass_array(transfer *t, void **array, size_t *count, size_t item) {
    pass(t, count, sizeof *count);
    if (t->failed) return;
    int is_fit = !t->is_reading || *count <= (t->size - t->at) / item;
    if (!is_fit || (t->is_reading && !(*array = calloc(*count + 1, item)))) {
        *count = 0;
        t->failed = 1;
        return;
    }
    if (*count) pass(t, *array, *count * item);
}

static size_t count_parts(const ovoid_body *body) {
    if (body->compound) return ovoid_compound_get_part_count(body->compound);
    return body->solid ? (size_t)ovoid_solid_get_report(body->solid).triangles : 1;
}

static int has_parts(module_state *state, PyObject *a, PyObject *b, uint32_t part_a, uint32_t part_b) {
    ovoid_pose still = ovoid_pose_make_identity();
    ovoid_body first = body_make(state, a, still), second = body_make(state, b, still);
    return part_a < count_parts(&first) && part_b < count_parts(&second);
}

// ---- answers

static size_t compute_cover_size(const kept_cover *cover) {
    return sizeof *cover + 2 * sizeof(uint32_t) * cover->point_count + 3 * sizeof(uint16_t) * cover->triangle_count;
}

static void pass_cover(transfer *t, kept_cover **cover) {
    size_t size = *cover ? compute_cover_size(*cover) : 0;
    pass_array(t, (void **)cover, &size, 1);
    if (!t->is_reading || t->failed) return;
    if (!size) {
        free(*cover);
        *cover = NULL;
        return;
    }
    t->failed = size < sizeof **cover || (*cover)->point_count > OVOID_COVER_POINTS_MAX ||
                (*cover)->triangle_count > 2 * OVOID_COVER_POINTS_MAX || size != compute_cover_size(*cover);
}

static void pass_answer(transfer *t, PyObject *object) {
    answer_object *self = (answer_object *)object;
    pass(t, &self->of, sizeof self->of);
    pass(t, &self->pose_a, sizeof self->pose_a);
    pass(t, &self->pose_b, sizeof self->pose_b);
    pass(t, &self->options.absolute_tolerance, sizeof(double));
    pass(t, &self->options.relative_tolerance, sizeof(double));
    pass(t, &self->options.cap, sizeof(double));
    pass(t, &self->options.iterations, sizeof(uint32_t));
    pass_cover(t, &self->cover);
    pass_array(t, (void **)&self->exclusions, &self->exclusion_count, sizeof *self->exclusions);
    if (!t->is_reading || t->failed) return;
    t->failed = ovoid_pose_validate(&self->pose_a) != OVOID_OK || ovoid_pose_validate(&self->pose_b) != OVOID_OK ||
                !has_parts(state_of(object), self->a, self->b, self->of.part_a, self->of.part_b);
}

static PyObject *read_answer(module_state *state, PyObject *objects, transfer *t) {
    PyObject *a, *b;
    ovoid_body first, second;
    ovoid_pose still = ovoid_pose_make_identity();
    if (!PyArg_ParseTuple(objects, "OO", &a, &b) || body_read(state, a, "a", &first) ||
        body_read(state, b, "b", &second))
        return NULL;
    PyObject *made = (PyObject *)answer_make(state, a, b, &still, &still);
    if (made) pass_answer(t, made);
    return made;
}

// ---- manifolds

// The points follow from the rest.
static void pass_manifold(transfer *t, PyObject *object) {
    manifold_object *self = (manifold_object *)object;
    double options[4] = {self->options.margin, self->options.tolerance, self->options.keep, self->options.angle};
    pass(t, &self->of, sizeof self->of);
    pass(t, &self->pose_a, sizeof self->pose_a);
    pass(t, &self->pose_b, sizeof self->pose_b);
    pass(t, options, sizeof options);
    pass_cover(t, &self->cover);
    if (!t->is_reading || t->failed) return;
    self->options = (ovoid_manifold_options){
        .margin = options[0], .tolerance = options[1], .keep = options[2], .angle = options[3]};
    t->failed = ovoid_pose_validate(&self->pose_a) != OVOID_OK || ovoid_pose_validate(&self->pose_b) != OVOID_OK ||
                !has_parts(state_of(object), self->a, self->b, self->of.part_a, self->of.part_b);
    if (!t->failed) t->failed = !manifold_set_points(self);
}

static PyObject *read_manifold(module_state *state, PyObject *objects, transfer *t) {
    PyObject *a, *b;
    ovoid_body_pair still;
    if (!PyArg_ParseTuple(objects, "OO", &a, &b) || body_read(state, a, "a", &still.a) ||
        body_read(state, b, "b", &still.b))
        return NULL;
    if (still.a.solid || still.b.solid) return PyErr_Format(PyExc_TypeError, "a Manifold is of Shapes and Compounds");
    still.a.pose = still.b.pose = ovoid_pose_make_identity();
    PyObject *made = (PyObject *)manifold_make(state, a, b, &still);
    if (made) pass_manifold(t, made);
    return made;
}

// ---- motions, impacts and approaches

static void pass_motion(transfer *t, ovoid_motion *m, double **times, ovoid_pose **poses) {
    size_t time_count = m->count, pose_count = m->count;
    pass(t, &m->kind, sizeof m->kind);
    pass(t, &m->start, sizeof m->start);
    pass(t, &m->end, sizeof m->end);
    pass(t, &m->linear, sizeof m->linear);
    pass(t, &m->angular, sizeof m->angular);
    pass(t, &m->pivot, sizeof m->pivot);
    pass(t, &m->duration, sizeof m->duration);
    pass_array(t, (void **)times, &time_count, sizeof **times);
    pass_array(t, (void **)poses, &pose_count, sizeof **poses);
    if (!t->is_reading) return;
    m->times = *times;
    m->poses = *poses;
    m->count = time_count;
    t->failed |= time_count != pose_count;
}

static PyObject *read_motion(module_state *state, PyObject *objects, transfer *t) {
    ovoid_motion motion = {.count = 0};
    double *times = NULL;
    ovoid_pose *poses = NULL;
    (void)objects;
    pass_motion(t, &motion, &times, &poses);
    if (!t->failed) return motion_wrap_arrays(state, motion, times, poses);
    free(times);
    free(poses);
    return motion_wrap(state, ovoid_motion_make_still(ovoid_pose_make_identity()));
}

static void pass_impact(transfer *t, PyObject *object) {
    impact_object *self = (impact_object *)object;
    size_t step_count = t->is_reading ? 0 : impact_count_steps(self), group_count = self->of.group_count;
    pass(t, &self->of, sizeof self->of);
    pass(t, &self->approach, sizeof self->approach);
    pass(t, &self->margin, sizeof self->margin);
    pass(t, &self->options.begin, sizeof(double));
    pass(t, &self->options.end, sizeof(double));
    pass(t, &self->options.tolerance, sizeof(double));
    pass(t, &self->options.iterations, sizeof(uint32_t));
    pass_array(t, (void **)&self->steps, &step_count, sizeof *self->steps);
    pass_array(t, (void **)&self->groups, &group_count, sizeof *self->groups);
    if (!t->is_reading) return;
    size_t wanted = self->of.group_count;
    self->of.group_count = group_count;
    for (size_t i = 0; !t->failed && i < group_count; i++) t->failed = self->groups[i].count > step_count;
    t->failed |= wanted != group_count || impact_count_steps(self) != step_count || isnan(self->of.impact.free_until) ||
                 isnan(self->of.impact.hit_at) || isnan(self->approach.time) ||
                 !has_parts(state_of(object), self->a, self->b, self->of.part_a, self->of.part_b);
}

static PyObject *read_impact(module_state *state, PyTypeObject *type, PyObject *objects, transfer *t) {
    PyObject *of[4];
    ovoid_body first, second;
    if (!PyArg_ParseTuple(objects, "OOOO", &of[0], &of[1], &of[2], &of[3]) || body_read(state, of[0], "a", &first) ||
        body_read(state, of[1], "b", &second))
        return NULL;
    if (Py_TYPE(of[2]) != state->motion || Py_TYPE(of[3]) != state->motion ||
        (type == state->approach && (!first.shape || !second.shape)))
        return PyErr_Format(PyExc_TypeError, "an Impact is of two bodies and two Motions");
    PyObject *made = (PyObject *)impact_make(type, of[0], of[1], of[2], of[3]);
    if (made) pass_impact(t, made);
    return made;
}

// ---- values that are their bytes

static PyTypeObject *find_plain(module_state *s, PyTypeObject *type, size_t *size) {
    PyTypeObject *const plain[] = {s->ray_hit, s->smooth, s->smooth_value, s->gradient, s->fit};
    PyObject *basic = PyObject_GetAttrString((PyObject *)type, "__basicsize__");
    *size = basic ? PyLong_AsSize_t(basic) - sizeof(PyObject) : 0;
    Py_XDECREF(basic);
    for (size_t i = 0; i < sizeof plain / sizeof *plain; i++)
        if (type == plain[i]) return type;
    return NULL;
}

static void pass_plain(transfer *t, PyObject *object, size_t size) { pass(t, (char *)object + sizeof(PyObject), size); }

// ---- both ways

static void pass_any(module_state *state, transfer *t, PyObject *object, size_t size) {
    PyTypeObject *type = Py_TYPE(object);
    motion_object *motion = (motion_object *)object;
    if (type == state->answer)
        pass_answer(t, object);
    else if (type == state->manifold)
        pass_manifold(t, object);
    else if (type == state->motion)
        pass_motion(t, &motion->motion, &motion->times, &motion->poses);
    else if (type == state->impact || type == state->approach)
        pass_impact(t, object);
    else
        pass_plain(t, object, size);
}

static PyObject *get_objects(module_state *state, PyObject *object) {
    const answer_object *answer = (const answer_object *)object;
    const impact_object *impact = (const impact_object *)object;
    const manifold_object *manifold = (const manifold_object *)object;
    if (Py_TYPE(object) == state->answer) return PyTuple_Pack(2, answer->a, answer->b);
    if (Py_TYPE(object) == state->manifold) return PyTuple_Pack(2, manifold->a, manifold->b);
    if (Py_TYPE(object) != state->impact && Py_TYPE(object) != state->approach) return PyTuple_New(0);
    return PyTuple_Pack(4, impact->a, impact->b, impact->motion_a, impact->motion_b);
}

static int has_state(module_state *state, PyTypeObject *type, size_t *size) {
    int is_plain = find_plain(state, type, size) != NULL;
    if (is_plain || type == state->answer || type == state->manifold || type == state->motion ||
        type == state->impact || type == state->approach)
        return 1;
    if (!PyErr_Occurred()) PyErr_Format(PyExc_TypeError, "%R has no state as bytes", (PyObject *)type);
    return 0;
}

static PyObject *get_state(PyObject *module, PyObject *object) {
    module_state *state = state_of_module(module);
    size_t size;
    if (!has_state(state, Py_TYPE(object), &size)) return NULL;
    transfer t = {.data = NULL};
    pass_any(state, &t, object, size);
    PyObject *bytes = PyBytes_FromStringAndSize(NULL, (Py_ssize_t)t.at);
    if (!bytes) return NULL;
    t = (transfer){.data = PyBytes_AsString(bytes), .size = t.at};
    pass_any(state, &t, object, size);
    PyObject *objects = get_objects(state, object);
    return objects ? Py_BuildValue("NN", objects, bytes) : NULL;
}

static PyObject *read_any(module_state *state, PyTypeObject *type, PyObject *objects, transfer *t, size_t size) {
    if (type == state->answer) return read_answer(state, objects, t);
    if (type == state->manifold) return read_manifold(state, objects, t);
    if (type == state->motion) return read_motion(state, objects, t);
    if (type == state->impact || type == state->approach) return read_impact(state, type, objects, t);
    PyObject *made = object_make(type);
    if (made) pass_plain(t, made, size);
    return made;
}

static PyObject *make_from_state(PyObject *module, PyObject *arguments) {
    module_state *state = state_of_module(module);
    PyObject *type, *objects;
    const char *data;
    Py_ssize_t length;
    size_t size;
    if (!PyArg_ParseTuple(arguments, "O!O!y#:_make_from_state", &PyType_Type, &type, &PyTuple_Type, &objects, &data,
                          &length) ||
        !has_state(state, (PyTypeObject *)type, &size))
        return NULL;
    transfer t = {.data = (char *)data, .size = (size_t)length, .is_reading = 1};
    PyObject *made = read_any(state, (PyTypeObject *)type, objects, &t, size);
    if (!made || (!t.failed && t.at == t.size)) return made;
    Py_DECREF(made);
    return raise_code(state, OVOID_ERROR_FORMAT, -1, "the state of this %R is damaged", type);
}

PyMethodDef state_methods[] = {
    {"_get_state", get_state, METH_O, "The objects that a result is about, and its state as bytes."},
    {"_make_from_state", make_from_state, METH_VARARGS, "The result of a type, its objects and its state."},
    {NULL, NULL, 0, NULL}};
