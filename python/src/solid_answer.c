// SolidAnswer: what a query proved of two bodies of which one at least is a solid, with its proof.
#include "src/query.h"

#include <stdlib.h>

typedef struct solid_answer_object {
    PyObject_HEAD ovoid_body_answer of;
    PyObject *a, *b; ///< shapes, compounds or solids
    ovoid_pose pose_a, pose_b;
    ovoid_options options; ///< of the query
    ovoid_exclusion *exclusions;
    size_t exclusion_count;
} solid_answer_object;

static ovoid_body_pair make_pair(module_state *state, const solid_answer_object *x) {
    return (ovoid_body_pair){body_make(state, x->a, x->pose_a), body_make(state, x->b, x->pose_b)};
}

// ---- asking

// Asks again with more memory where the exclusions were more than there was room for.
static int find_answer(module_state *state, const query_input *in, solid_answer_object *to) {
    query_input own = *in;
    own.pair = make_pair(state, to);
    for (size_t capacity = 256;; capacity = to->exclusion_count) {
        ovoid_exclusion *grown = realloc(to->exclusions, capacity * sizeof *grown);
        if (!grown) {
            PyErr_NoMemory();
            return -1;
        }
        to->exclusions = grown;
        ovoid_exclusions exclusions = {grown, capacity, 0, NULL};
        Py_BEGIN_ALLOW_THREADS;
        to->of = query_once(&own, &exclusions);
        Py_END_ALLOW_THREADS;
        to->exclusion_count = exclusions.count;
        if (exclusions.count <= capacity) return limit_raise(state, to->of.limit);
    }
}

PyObject *solid_query(module_state *state, const query_input *in) {
    if (in->name == QUERY_DEPTH) {
        PyErr_SetString(PyExc_TypeError, "depth() takes Shapes and Compounds: distance() of solids that overlap has a "
                                         "bracket of their depth");
        return NULL;
    }
    solid_answer_object *to = object_make(state->solid_answer);
    if (!to) return NULL;
    to->a = Py_NewRef(in->a);
    to->b = Py_NewRef(in->b);
    to->pose_a = in->pair.a.pose;
    to->pose_b = in->pair.b.pose;
    to->options = in->options;
    if (!find_answer(state, in, to)) return (PyObject *)to;
    Py_DECREF((PyObject *)to);
    return NULL;
}

PyObject *solid_answer_ask(module_state *state, PyObject *a, PyObject *b, const ovoid_body_pair *pair, double margin,
                           const ovoid_body_proof *earlier) {
    query_input in = {.name = margin >= 0 ? QUERY_WITHIN : QUERY_DISTANCE, .a = a, .b = b, .pair = *pair};
    in.margin = margin;
    in.has_earlier = earlier != NULL;
    if (earlier) in.earlier = *earlier;
    return solid_query(state, &in);
}

ovoid_body_proof solid_answer_get_proof(PyObject *answer) {
    const ovoid_body_answer *of = &((const solid_answer_object *)answer)->of;
    return ovoid_body_answer_get_proof(of);
}

ovoid_code solid_answer_verify(PyObject *answer, ovoid_error *error) {
    const solid_answer_object *self = (const solid_answer_object *)answer;
    ovoid_body_pair pair = make_pair(state_of(answer), self);
    ovoid_exclusions exclusions = {self->exclusions, self->exclusion_count, self->exclusion_count, NULL};
    ovoid_code code;
    Py_BEGIN_ALLOW_THREADS;
    code = ovoid_body_verify(&pair, &self->of, &self->options, &exclusions, error);
    Py_END_ALLOW_THREADS;
    return code;
}

// ---- what it is

static PyObject *get_proof(PyObject *self, void *closure) {
    (void)closure;
    const ovoid_proof *proof = &((solid_answer_object *)self)->of.deciding.proof;
    return array_copy(state_of(self), RECORD_PROOF, 1, (Py_ssize_t[]){1}, proof);
}

static PyObject *get_component(PyObject *self, void *closure) {
    (void)closure;
    const ovoid_body_answer *of = &((solid_answer_object *)self)->of;
    int is = of->inside == OVOID_BODY_A_INSIDE || of->inside == OVOID_BODY_B_INSIDE;
    return is ? PyLong_FromUnsignedLong(of->component) : Py_NewRef(Py_None);
}

static PyObject *get_body(PyObject *self, void *closure) {
    solid_answer_object *answer = (solid_answer_object *)self;
    return Py_NewRef(closure ? answer->b : answer->a);
}

static PyObject *get_pose(PyObject *self, void *closure) {
    solid_answer_object *answer = (solid_answer_object *)self;
    return pose_wrap(state_of(self), closure ? answer->pose_b : answer->pose_a);
}

static PyObject *is_within(PyObject *self, PyObject *margin) {
    double wanted = PyFloat_AsDouble(margin);
    if (wanted == -1 && PyErr_Occurred()) return NULL;
    int within = ovoid_body_answer_is_within(&((solid_answer_object *)self)->of, wanted);
    return within < 0 ? Py_NewRef(Py_None) : PyBool_FromLong(within);
}

static PyObject *repr(PyObject *self) {
    const ovoid_body_answer *x = &((solid_answer_object *)self)->of;
    char text[160];
    PyOS_snprintf(text, sizeof text, "<ovoid.SolidAnswer: %s, %.17g <= d <= %.17g>", ovoid_status_get_name(x->status),
                  x->lower, x->upper);
    return PyUnicode_FromString(text);
}

static void solid_answer_dealloc(PyObject *object) {
    solid_answer_object *self = (solid_answer_object *)object;
    Py_XDECREF(self->a);
    Py_XDECREF(self->b);
    free(self->exclusions);
    object_free(object);
}

// ---- the type

static PyMethodDef methods[] = {
    {"is_within", is_within, METH_O,
     "is_within(margin)\n--\n\nTrue: proven within the margin; False: proven farther; None: the bracket straddles it."},
    {NULL, NULL, 0, NULL}};

static PyGetSetDef fields[] = {
    FIELD(solid_answer_object, FIELD_ENUM + ENUM_STATUS, "status", of.status,
          "What is proven of the signed distance d: a Status."),
    FIELD(solid_answer_object, FIELD_ENUM + ENUM_LIMIT, "limit", of.limit,
          "Why the bracket is not narrower: a Limit; of an overlap NONE, though its depth is not searched for."),
    FIELD(solid_answer_object, FIELD_DOUBLE, "lower", of.lower, "Proven: lower <= d, rounding included."),
    FIELD(solid_answer_object, FIELD_DOUBLE, "upper", of.upper, "Proven: d <= upper, rounding included."),
    FIELD(solid_answer_object, FIELD_VEC3, "point_a", of.deciding.point_a,
          "Witness point of a, of the deciding triangles, world frame."),
    FIELD(solid_answer_object, FIELD_VEC3, "point_b", of.deciding.point_b, "Witness point of b, world frame."),
    FIELD(solid_answer_object, FIELD_VEC3, "normal", of.deciding.normal, "Unit normal from a to b, world frame."),
    FIELD(solid_answer_object, FIELD_DOUBLE, "surfaces_lower", of.deciding.lower,
          "Proven: no triangle of a is nearer to one of b."),
    FIELD(solid_answer_object, FIELD_DOUBLE, "surfaces_upper", of.deciding.upper,
          "Proven: the deciding triangles are no farther apart."),
    FIELD(solid_answer_object, FIELD_VEC3, "parting", of.parting,
          "Unit direction, world frame, along which a way of -lower parts the bodies, where lower is below 0."),
    FIELD(solid_answer_object, FIELD_ENUM + ENUM_INSIDE, "inside", of.inside,
          "What is inside, where that is what proves an overlap: an Inside."),
    {"component", get_component, NULL, "The component that is inside, or None.", NULL},
    FIELD(solid_answer_object, FIELD_VEC3, "common", of.common,
          "Where inside is Inside.POINT: the point that both bodies cover, frame of a; else zeros."),
    FIELD(solid_answer_object, FIELD_UINT, "triangle_a", of.part_a,
          "The deciding triangle of a; of a compound the part, of a shape 0."),
    FIELD(solid_answer_object, FIELD_UINT, "triangle_b", of.part_b,
          "The deciding triangle of b; of a compound the part, of a shape 0."),
    FIELD(solid_answer_object, FIELD_UINT, "visited", of.visited,
          "How many pairs of nodes and triangles were bounded."),
    FIELD(solid_answer_object, FIELD_UINT, "tested", of.tested, "How many pairs of triangles were queried."),
    {"proof", get_proof, NULL, "The proof of the deciding triangles, an array of one record.", NULL},
    {"a", get_body, NULL, "The first body.", NULL},
    {"b", get_body, NULL, "The second body.", ""},
    {"pose_a", get_pose, NULL, "The pose of a.", NULL},
    {"pose_b", get_pose, NULL, "The pose of b.", ""},
    {NULL, NULL, NULL, NULL, NULL}};

static PyType_Slot slots[] = {
    {Py_tp_doc,
     "The answer to a query of two bodies of which one is a Solid at least: lower <= d <= upper, where d is the "
     "distance, "
     "or\nminus the least way that parts the bodies where they overlap. ovoid.verify(answer) checks its proof."},
    {Py_tp_dealloc, solid_answer_dealloc},
    {Py_tp_repr, repr},
    {Py_nb_bool, bool_refuse},
    {Py_tp_getset, fields},
    {Py_tp_methods, methods},
    {0, NULL}};
static PyType_Spec spec = {"ovoid.SolidAnswer", sizeof(solid_answer_object), 0,
                           Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION, slots};

int solid_answer_add(PyObject *module) { return type_add(module, &spec, &state_of_module(module)->solid_answer); }
