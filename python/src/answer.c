// Answer: what a query proved of two bodies, with its proof and what it takes to check it.
#include "src/manifold/manifold.h"
#include "src/query.h"
#ifdef OVOID_PYTHON_ROBOT
#include "src/robot/robot.h"
#endif

#include <stdlib.h>
#include <string.h>

answer_object *answer_make(module_state *state, PyObject *a, PyObject *b, const ovoid_pose *pose_a,
                           const ovoid_pose *pose_b) {
    answer_object *self = object_make(state->answer);
    if (!self) return NULL;
    self->a = Py_NewRef(a);
    self->b = Py_NewRef(b);
    self->pose_a = *pose_a;
    self->pose_b = *pose_b;
    return self;
}

int cover_keep(kept_cover **to, const ovoid_cover *cover) {
    free(*to);
    *to = NULL;
    if (!cover->point_count) return 0;
    size_t points = cover->point_count * sizeof *cover->a, triangles = cover->triangle_count * sizeof *cover->triangles;
    kept_cover *kept = malloc(sizeof *kept + 2 * points + triangles);
    if (!kept) {
        PyErr_NoMemory();
        return -1;
    }
    kept->point_count = cover->point_count;
    kept->triangle_count = cover->triangle_count;
    char *data = kept->data;
    memcpy(data, cover->a, points);
    memcpy(data + points, cover->b, points);
    memcpy(data + 2 * points, cover->triangles, triangles);
    *to = kept;
    return 0;
}

int answer_keep_exclusions(answer_object *to, ovoid_exclusions *exclusions) {
    size_t count = exclusions->count;
    int failed = count > exclusions->capacity;
    if (!failed && count) {
        to->exclusions = malloc(count * sizeof *to->exclusions);
        failed = !to->exclusions;
        if (!failed) memcpy(to->exclusions, exclusions->items, count * sizeof *to->exclusions);
    }
    ovoid_exclusions_release(exclusions);
    if (failed) {
        PyErr_NoMemory();
        return -1;
    }
    to->exclusion_count = count;
    return 0;
}

const ovoid_cover *cover_unpack(const kept_cover *kept, ovoid_cover *to) {
    to->point_count = to->triangle_count = 0;
    if (!kept) return NULL;
    size_t points = kept->point_count * sizeof *to->a;
    const void *a = kept->data, *b = kept->data + points, *triangles = kept->data + 2 * points;
    to->point_count = kept->point_count;
    to->triangle_count = kept->triangle_count;
    to->a = a;
    to->b = b;
    to->triangles = (const uint16_t(*)[3])triangles;
    return to;
}

void cover_room_make(cover_room *room) {
    room->large = NULL;
    room->cover = (ovoid_cover){.memory = room->memory, .size = sizeof room->memory};
}

int cover_room_grow(cover_room *room, ovoid_limit limit) {
    if (limit != OVOID_LIMIT_CAPACITY || room->large) return 0;
    size_t size = ovoid_cover_get_size(OVOID_COVER_POINTS_MAX);
    room->large = malloc(size);
    if (room->large) room->cover = (ovoid_cover){.memory = room->large, .size = size};
    return room->large != NULL;
}

int cover_room_keep(cover_room *room, kept_cover **to) {
    int failed = cover_keep(to, &room->cover);
    free(room->large);
    return failed;
}

int limit_raise(module_state *state, ovoid_limit limit, const char *options) {
    const char *what = limit == OVOID_LIMIT_POSE_A    ? "pose_a: the body would lie beyond the range of lengths, 1e50"
                       : limit == OVOID_LIMIT_POSE_B  ? "pose_b: the body would lie beyond the range of lengths, 1e50"
                       : limit == OVOID_LIMIT_OPTIONS ? options
                                                      : NULL;
    if (!what) return 0;
    raise_code(state, limit == OVOID_LIMIT_OPTIONS ? OVOID_ERROR_ARGUMENT : OVOID_ERROR_RANGE, -1, "%s", what);
    return -1;
}

// ---- checking

ovoid_code answer_verify(const answer_object *self, ovoid_error *error) {
    module_state *state = state_of((PyObject *)self);
    ovoid_cover unpacked = {.memory = NULL};
    const ovoid_cover *cover = cover_unpack(self->cover, &unpacked);
    ovoid_body_pair bodies = {body_make(state, self->a, self->pose_a), body_make(state, self->b, self->pose_b)};
    if (bodies.a.shape && bodies.b.shape) {
        ovoid_pair pair = {bodies.a.shape, bodies.b.shape, self->pose_a, self->pose_b};
        return ovoid_answer_verify(&pair, &self->of.deciding,
                                   &(ovoid_answer_basis){.options = &self->options, .cover = cover}, error);
    }
    ovoid_exclusions exclusions = {.items = self->exclusions,
                                   .capacity = self->exclusion_count,
                                   .count = self->exclusion_count,
                                   .cover = self->cover ? &unpacked : NULL};
    ovoid_code code;
    Py_BEGIN_ALLOW_THREADS;
    code = ovoid_body_verify(&bodies, &self->of,
                             &(ovoid_body_basis){.options = &self->options, .exclusions = &exclusions}, error);
    Py_END_ALLOW_THREADS;
    return code;
}

static ovoid_code verify_any(module_state *state, PyObject *what, ovoid_error *error) {
    if (Py_TYPE(what) == state->answer) return answer_verify((const answer_object *)what, error);
    if (Py_TYPE(what) == state->manifold) return manifold_verify((const manifold_object *)what, error);
#ifdef OVOID_PYTHON_ROBOT
    if (Py_TYPE(what) == state->robot_path) return path_verify(what, error);
#endif
    return impact_verify(state, what, error);
}

static int is_verifiable(module_state *state, PyObject *what) {
    PyTypeObject *const types[] = {state->answer, state->impact, state->approach, state->robot_path, state->manifold};
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (Py_TYPE(what) == types[i]) return 1;
    PyErr_Format(PyExc_TypeError, "an Answer, Manifold, Impact, Approach or RobotPath is wanted, not %R",
                 (PyObject *)Py_TYPE(what));
    return 0;
}

static PyObject *verify(PyObject *module, PyObject *what) {
    module_state *state = state_of_module(module);
    ovoid_error error;
    if (!is_verifiable(state, what)) return NULL;
    if (verify_any(state, what, &error) != OVOID_OK) return raise_error(state, &error);
    Py_RETURN_NONE;
}

static PyObject *is_proven(PyObject *module, PyObject *what) {
    module_state *state = state_of_module(module);
    if (!is_verifiable(state, what)) return NULL;
    return PyBool_FromLong(verify_any(state, what, NULL) == OVOID_OK);
}

static PyMethodDef verify_methods[] = {
    {"verify", verify, METH_O,
     "verify(answer: Answer | Manifold | Impact | Approach | RobotPath, /) -> None\n--\n\nChecks an Answer, Manifold, "
     "Impact, Approach or "
     "RobotPath by its proof alone, without any search; raises Error where\nthe proof does not hold."},
    {"is_proven", is_proven, METH_O,
     "is_proven(answer: Answer | Manifold | Impact | Approach | RobotPath, /) -> bool\n--\n\nTrue where verify(answer) "
     "finds "
     "nothing wrong."},
    {NULL, NULL, 0, NULL}};

// ---- what it is

static int has_solid(const answer_object *self) {
    const PyTypeObject *solid = state_of((PyObject *)self)->solid;
    return Py_TYPE(self->a) == solid || Py_TYPE(self->b) == solid;
}

// A field of answers of solids; None of others.
static PyObject *get_of_solid(PyObject *self, void *closure) {
    return has_solid((const answer_object *)self) ? field_get(self, closure) : Py_NewRef(Py_None);
}

static PyObject *get_component(PyObject *self, void *closure) {
    const ovoid_body_answer *of = &((answer_object *)self)->of;
    int is = of->inside == OVOID_BODY_A_INSIDE || of->inside == OVOID_BODY_B_INSIDE;
    return is ? field_get(self, closure) : Py_NewRef(Py_None);
}

static PyObject *get_common(PyObject *self, void *closure) {
    int is = ((answer_object *)self)->of.inside == OVOID_BODY_COMMON_POINT;
    return is ? field_get(self, closure) : Py_NewRef(Py_None);
}

static PyObject *get_parting(PyObject *self, void *closure) {
    int is = ((answer_object *)self)->of.lower < 0;
    return is ? get_of_solid(self, closure) : Py_NewRef(Py_None);
}

static PyObject *get_distance(PyObject *self, void *closure) {
    (void)closure;
    ovoid_answer answer = ovoid_body_answer_get_answer(&((answer_object *)self)->of);
    return PyFloat_FromDouble(ovoid_answer_get_distance(&answer));
}

static PyObject *get_proof(PyObject *self, void *closure) {
    (void)closure;
    const ovoid_proof *proof = &((answer_object *)self)->of.deciding.proof;
    return array_copy(state_of(self), RECORD_PROOF, 1, (Py_ssize_t[]){1}, proof);
}

static PyObject *is_within(PyObject *self, PyObject *margin) {
    double wanted = PyFloat_AsDouble(margin);
    if (wanted == -1 && PyErr_Occurred()) return NULL;
    int within = ovoid_body_answer_is_within(&((answer_object *)self)->of, wanted);
    if (within < 0) Py_RETURN_NONE;
    return PyBool_FromLong(within);
}

static PyObject *repr(PyObject *self) {
    const ovoid_body_answer *x = &((answer_object *)self)->of;
    char text[160];
    PyOS_snprintf(text, sizeof text, "<ovoid.Answer: %s, %.17g <= d <= %.17g, by %s>", ovoid_status_get_name(x->status),
                  x->lower, x->upper, ovoid_stage_get_name(x->deciding.stage));
    return PyUnicode_FromString(text);
}

static void answer_dealloc(PyObject *object) {
    answer_object *self = (answer_object *)object;
    Py_XDECREF(self->a);
    Py_XDECREF(self->b);
    free(self->cover);
    free(self->exclusions);
    object_free(object);
}

static PyGetSetDef fields[] = {
    FIELD(answer_object, STATUS, "status", of.status, "What is proven of the signed distance d."),
    FIELD(answer_object, DOUBLE, "lower", of.lower, "Proven: lower <= d, rounding included."),
    FIELD(answer_object, DOUBLE, "upper", of.upper, "Proven: d <= upper, rounding included."),
    FIELD(
        answer_object, VEC3, "point_a", of.deciding.point_a,
        "Witness point of a, of the deciding parts, world frame. Of distance and depth: point_b - point_a = d normal."),
    FIELD(answer_object, VEC3, "point_b", of.deciding.point_b, "Witness point of b, world frame."),
    FIELD(answer_object, VEC3, "normal", of.deciding.normal, "Unit normal from a to b, world frame."),
    FIELD(answer_object, LIMIT, "limit", of.limit,
          "Why the bracket is not narrower; of an overlap of Solids NONE, though its depth is not searched "
          "for."),
    FIELD(answer_object, STAGE, "stage", of.deciding.stage, "What decided about the deciding parts."),
    FIELD(answer_object, UINT, "iterations", of.deciding.iterations, "Iterations of the exact methods."),
    FIELD(answer_object, UINT, "part_a", of.part_a,
          "The deciding part of a: of a Compound its part, of a Solid its triangle, of a Shape 0."),
    FIELD(answer_object, UINT, "part_b", of.part_b, "The deciding part of b."),
    FIELD(answer_object, UINT, "visited", of.visited,
          "How many pairs of nodes and parts were bounded; 0 of two Shapes."),
    FIELD(answer_object, UINT, "tested", of.tested, "How many pairs of parts were queried; 0 of two Shapes."),
    FIELD_OPTIONAL(get_of_solid, answer_object, DOUBLE, "surfaces_lower", of.deciding.lower,
                   "Proven: no triangle of a is nearer to one of b. None without a Solid."),
    FIELD_OPTIONAL(get_of_solid, answer_object, DOUBLE, "surfaces_upper", of.deciding.upper,
                   "Proven: the deciding triangles are no farther apart. None without a Solid."),
    FIELD_OPTIONAL(get_of_solid, answer_object, INSIDE, "inside", of.inside,
                   "What is inside, where that is what proves an overlap. None without a Solid."),
    FIELD_OPTIONAL(get_component, answer_object, UINT, "component", of.component,
                   "The component that is inside where inside is Inside.A or Inside.B; else None."),
    FIELD_OPTIONAL(get_common, answer_object, VEC3, "common", of.common,
                   "The point that both bodies cover, frame of a, where inside is Inside.POINT; else None."),
    FIELD_OPTIONAL(
        get_parting, answer_object, VEC3, "parting", of.parting,
        "Unit direction, world frame, along which a translation by -lower parts the bodies, where lower is below "
        "0. None\nwithout a Solid."),
    {"distance", get_distance, NULL,
     "float: The signed distance as one number, never above the true one; NaN where the bracket is wider than the "
     "tolerance.",
     NULL},
    {"proof", get_proof, NULL, "Records: The proof of the deciding parts, an array of one record: earlier= takes it.",
     NULL},
    FIELD_PYTHON(answer_object, "Body", "a", a, "The first body."),
    FIELD_PYTHON(answer_object, "Body", "b", b, "The second body."),
    FIELD(answer_object, POSE, "pose_a", pose_a, "The pose of a."),
    FIELD(answer_object, POSE, "pose_b", pose_b, "The pose of b."),
    {NULL, NULL, NULL, NULL, NULL}};

static PyMethodDef methods[] = {{"is_within", is_within, METH_O,
                                 "is_within(margin: float, /) -> bool | None\n--\n\nTrue: proven within the margin; "
                                 "False: proven farther; None: the bracket straddles it."},
                                {NULL, NULL, 0, NULL}};

static PyType_Slot slots[] = {
    {Py_tp_doc,
     "The answer to a query of two bodies: lower <= d <= upper, where d is the signed distance, positive apart,\n"
     "minus the depth where they overlap: of Compounds that of the deepest pair of parts, of Solids the least "
     "translation\n"
     "that parts the bodies. ovoid.verify(answer) checks its proof. What only Solids have is None without one."},
    {Py_tp_dealloc, answer_dealloc},
    {Py_tp_repr, repr},
    {Py_nb_bool, bool_refuse},
    {Py_tp_getset, fields},
    {Py_tp_methods, methods},
    {0, NULL}};
static PyType_Spec spec = {"ovoid.Answer", sizeof(answer_object), 0,
                           Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION, slots};

int answer_add(PyObject *module) {
    return type_add(module, &spec, &state_of_module(module)->answer) || functions_add(module, verify_methods);
}
