// collide, within, distance, depth of two bodies at their poses: one answer each.
//
// The arguments are read by hand (METH_FASTCALL): a call should cost little more than the query. Two shapes keep the
// interpreter's lock, since a query of them takes microseconds; compounds and solids give it up.
#include "src/query.h"
#include "src/prepared.h"

#include <stdlib.h>
#include <string.h>

static const char *const query_names[] = {"collide", "within", "distance", "depth"};

enum { BODY_A, BODY_B, PLACE_A, PLACE_B, MARGIN, ABSOLUTE, RELATIVE, CAP, ITERATIONS, EARLIER, ARGUMENT_COUNT };
static const char *const argument_names[ARGUMENT_COUNT + 1] = {
    "a",   "b",          "pose_a",  "pose_b", "margin", "absolute_tolerance", "relative_tolerance",
    "cap", "iterations", "earlier", NULL};

// ---- arguments

static int find_argument(const char *function, PyObject *name) {
    for (int i = 0; i < ARGUMENT_COUNT; i++)
        if (PyUnicode_CompareWithASCIIString(name, argument_names[i]) == 0) return i;
    return argument_refuse(function, name, argument_names), -1;
}

static int sort_arguments(query_name which, PyObject *const *given, Py_ssize_t count, PyObject *names,
                          PyObject *sorted[ARGUMENT_COUNT]) {
    const char *function = query_names[which];
    if (count > MARGIN) {
        PyErr_Format(PyExc_TypeError, "%s() takes (a, b, pose_a, pose_b) by place, all else by name", function);
        return -1;
    }
    for (Py_ssize_t i = 0; i < count; i++) sorted[i] = given[i];
    Py_ssize_t named = names ? PyTuple_Size(names) : 0;
    for (Py_ssize_t i = 0; i < named; i++) {
        int place = find_argument(function, PyTuple_GetItem(names, i));
        if (place < 0) return -1;
        if (sorted[place] || (place == MARGIN && which != QUERY_WITHIN)) {
            PyErr_Format(PyExc_TypeError, sorted[place] ? "%s() has '%s' twice" : "%s() has no argument '%s'", function,
                         argument_names[place]);
            return -1;
        }
        sorted[place] = given[count + i];
    }
    if (sorted[BODY_A] && sorted[BODY_B] && (which != QUERY_WITHIN || sorted[MARGIN])) return 0;
    PyErr_Format(PyExc_TypeError, which == QUERY_WITHIN ? "%s() needs two bodies and margin=" : "%s() needs two bodies",
                 function);
    return -1;
}

static int read_double(PyObject *from, const char *name, double *to) {
    if (!from) return 0;
    *to = PyFloat_AsDouble(from);
    if (*to != -1 || !PyErr_Occurred()) return 0;
    if (PyErr_ExceptionMatches(PyExc_TypeError))
        PyErr_Format(PyExc_TypeError, "%s: a number is wanted, not %R", name, (PyObject *)Py_TYPE(from));
    return -1;
}

static int read_iterations(module_state *state, PyObject *from, uint32_t *to) {
    if (!from) return 0;
    long long wanted = PyLong_AsLongLong(from);
    if (wanted == -1 && PyErr_Occurred()) return -1;
    *to = (uint32_t)wanted;
    if (wanted >= 0 && wanted <= UINT32_MAX) return 0;
    raise_code(state, OVOID_ERROR_ARGUMENT, -1, "iterations: 0 to 2^32 - 1 are wanted");
    return -1;
}

int query_keywords_validate(module_state *state, query_keywords *k) {
    k->options.iterations = (uint32_t)k->iterations;
    if (k->iterations <= UINT32_MAX) return 0;
    raise_code(state, OVOID_ERROR_ARGUMENT, -1, "iterations: 0 to 2^32 - 1 are wanted");
    return -1;
}

ovoid_body body_make(module_state *state, PyObject *from, ovoid_pose pose) {
    ovoid_body body = {.pose = pose};
    if (Py_TYPE(from) == state->shape) body.shape = ((shape_object *)from)->shape;
    if (Py_TYPE(from) == state->compound) body.compound = ((compound_object *)from)->compound;
    if (Py_TYPE(from) == state->solid) body.solid = ((solid_object *)from)->solid;
    return body;
}

int body_read(module_state *state, PyObject *from, const char *what, ovoid_body *body) {
    *body = body_make(state, from, (ovoid_pose){{0, 0, 0}, {0, 0, 0, 0}});
    if (body->shape || body->compound || body->solid) return 0;
    PyErr_Format(PyExc_TypeError, "%s: a Shape, Compound or Solid is wanted, not %R", what, (PyObject *)Py_TYPE(from));
    return -1;
}

static int read_earlier(module_state *state, PyObject *from, query_input *in) {
    if (!from || from == Py_None) return 0;
    in->has_earlier = 1;
    if (Py_TYPE(from) == state->answer) {
        const answer_object *answer = (const answer_object *)from;
        in->earlier = ovoid_body_answer_get_proof(&answer->of);
        in->cover = answer->cover;
        return 0;
    }
    if (!PyObject_CheckBuffer(from)) {
        PyErr_Format(PyExc_TypeError,
                     "earlier: an Answer, or an array of one proof as of ovoid.zeros, is wanted, not %R",
                     (PyObject *)Py_TYPE(from));
        return -1;
    }
    Py_buffer view;
    if (records_view(state, from, "earlier", RECORD_PROOF, 1, 0, &view)) return -1;
    in->earlier = (ovoid_body_proof){.part_a = 0};
    memcpy(&in->earlier.proof, view.buf, sizeof in->earlier.proof);
    PyBuffer_Release(&view);
    return 0;
}

// Two Prepared ones, which bring their poses.
static int read_prepared(module_state *state, PyObject *const x[ARGUMENT_COUNT], query_input *in) {
    if (Py_TYPE(in->a) != state->prepared || Py_TYPE(in->b) != state->prepared) {
        PyErr_SetString(PyExc_TypeError, "a Prepared is asked with another Prepared: a and b are both, or none is");
        return -1;
    }
    for (int i = PLACE_A; i <= PLACE_B; i++)
        if (x[i] && x[i] != Py_None) {
            PyErr_Format(PyExc_TypeError, "%s: a Prepared has its pose", argument_names[i]);
            return -1;
        }
    const prepared_object *a = (const prepared_object *)in->a, *b = (const prepared_object *)in->b;
    in->prepared_a = &a->of;
    in->prepared_b = &b->of;
    in->pair.a = (ovoid_body){.shape = a->of.body.shape, .pose = a->of.body.pose};
    in->pair.b = (ovoid_body){.shape = b->of.body.shape, .pose = b->of.body.pose};
    in->a = a->shape;
    in->b = b->shape;
    return 0;
}

static int read_bodies(module_state *state, PyObject *const x[ARGUMENT_COUNT], query_input *in) {
    in->a = x[BODY_A];
    in->b = x[BODY_B];
    in->prepared_a = NULL;
    if (Py_TYPE(in->a) == state->prepared || Py_TYPE(in->b) == state->prepared) return read_prepared(state, x, in);
    if (body_read(state, in->a, "a", &in->pair.a) || body_read(state, in->b, "b", &in->pair.b) ||
        pose_read(state, x[PLACE_A], "pose_a", &in->pair.a.pose))
        return -1;
    return pose_read(state, x[PLACE_B], "pose_b", &in->pair.b.pose);
}

static int read_input(module_state *state, PyObject *const x[ARGUMENT_COUNT], query_input *in) {
    in->margin = 0;
    in->has_earlier = 0;
    in->cover = NULL;
    in->options = (ovoid_options){0};
    if (read_bodies(state, x, in)) return -1;
    if (read_double(x[MARGIN], "margin", &in->margin) ||
        read_double(x[ABSOLUTE], "absolute_tolerance", &in->options.absolute_tolerance) ||
        read_double(x[RELATIVE], "relative_tolerance", &in->options.relative_tolerance) ||
        read_double(x[CAP], "cap", &in->options.cap) || read_iterations(state, x[ITERATIONS], &in->options.iterations))
        return -1;
    return read_earlier(state, x[EARLIER], in);
}

// ---- two shapes

// Depths are asked as of shapes: their proof is a cover, which prepared queries do not give.
static void query_prepared(const query_input *in, answer_object *to) {
    ovoid_proof proof = {.count = 0};
    if (in->has_earlier) proof = in->earlier.proof;
    ovoid_evidence evidence = {.proof = in->has_earlier ? &proof : NULL, .answer = &to->of.deciding};
    if (in->name == QUERY_COLLIDE)
        ovoid_prepared_collide((ovoid_prepared_pair){in->prepared_a, in->prepared_b}, &in->options, &evidence);
    else if (in->name == QUERY_WITHIN)
        ovoid_prepared_within((ovoid_prepared_pair){in->prepared_a, in->prepared_b}, in->margin, &in->options,
                              &evidence);
    else
        ovoid_prepared_distance((ovoid_prepared_pair){in->prepared_a, in->prepared_b}, &in->options, &evidence);
}

static int query_shapes(const query_input *in, answer_object *to) {
    ovoid_pair pair = {in->pair.a.shape, in->pair.b.shape, in->pair.a.pose, in->pair.b.pose};
    const ovoid_proof *earlier = in->has_earlier ? &in->earlier.proof : NULL;
    ovoid_answer *answer = &to->of.deciding;
    cover_room room;
    cover_room_make(&room);
    // A depth starts from the cover of an earlier Answer, where that one has it.
    if (in->name == QUERY_DEPTH) (void)cover_unpack(in->cover, &room.cover);
    if (in->prepared_a && in->name != QUERY_DEPTH)
        query_prepared(in, to);
    else if (in->name == QUERY_COLLIDE)
        *answer = ovoid_collide(&pair, &in->options, earlier);
    else if (in->name == QUERY_WITHIN)
        *answer = ovoid_within(&pair, in->margin, &in->options, earlier);
    else if (in->name == QUERY_DISTANCE)
        *answer = ovoid_distance(&pair, &in->options, earlier);
    else
        do *answer = ovoid_depth_from(&pair, &in->options, earlier, &room.cover);
        while (cover_room_grow(&room, answer->limit));
    to->of = ovoid_body_answer_make(answer, 0, 0);
    return cover_room_keep(&room, &to->cover);
}

// ---- compounds and solids

static ovoid_body_answer query_once(const query_input *in, ovoid_exclusions *exclusions) {
    const ovoid_body_proof *earlier = in->has_earlier ? &in->earlier : NULL;
    switch (in->name) {
    case QUERY_COLLIDE:
        return ovoid_body_collide(&in->pair, &in->options,
                                  &(ovoid_body_evidence){.earlier = earlier, .exclusions = exclusions});
    case QUERY_WITHIN:
        return ovoid_body_within(&in->pair, in->margin, &in->options,
                                 &(ovoid_body_evidence){.earlier = earlier, .exclusions = exclusions});
    case QUERY_DISTANCE:
        return ovoid_body_distance(&in->pair, &in->options,
                                   &(ovoid_body_evidence){.earlier = earlier, .exclusions = exclusions});
    default:
        return ovoid_body_depth(&in->pair, &in->options,
                                &(ovoid_body_evidence){.earlier = earlier, .exclusions = exclusions});
    }
}

static int query_bodies(const query_input *in, answer_object *to) {
    cover_room room;
    cover_room_make(&room);
    ovoid_exclusions exclusions = {.cover = in->name == QUERY_DEPTH ? &room.cover : NULL, .grows = 1};
    Py_BEGIN_ALLOW_THREADS;
    do to->of = query_once(in, &exclusions);
    while (exclusions.cover && cover_room_grow(&room, to->of.limit));
    Py_END_ALLOW_THREADS;
    int failed = answer_keep_exclusions(to, &exclusions);
    return cover_room_keep(&room, &to->cover) || failed ? -1 : 0;
}

// ---- what is called

PyObject *query_answer(module_state *state, const query_input *in) {
    if (in->name == QUERY_DEPTH && (in->pair.a.solid || in->pair.b.solid)) {
        PyErr_SetString(PyExc_TypeError, "depth() takes Shapes and Compounds: distance() of solids that overlap has a "
                                         "bracket of their depth");
        return NULL;
    }
    answer_object *to = answer_make(state, in->a, in->b, &in->pair.a.pose, &in->pair.b.pose);
    if (!to) return NULL;
    to->options = in->options;
    int failed = in->pair.a.shape && in->pair.b.shape ? query_shapes(in, to) : query_bodies(in, to);
    if (!failed && !limit_raise(state, to->of.limit, QUERY_REFUSED)) return (PyObject *)to;
    Py_DECREF(to);
    return NULL;
}

PyObject *query_ask(module_state *state, PyObject *a, PyObject *b, const ovoid_body_pair *pair, double margin,
                    const ovoid_body_proof *earlier) {
    query_input in = {.name = margin >= 0 ? QUERY_WITHIN : QUERY_DISTANCE, .a = a, .b = b, .pair = *pair};
    in.margin = margin;
    in.has_earlier = earlier != NULL;
    if (earlier) in.earlier = *earlier;
    return query_answer(state, &in);
}

static PyObject *query(PyObject *module, query_name name, PyObject *const *given, Py_ssize_t count, PyObject *names) {
    module_state *state = PyModule_GetState(module);
    PyObject *sorted[ARGUMENT_COUNT] = {NULL};
    query_input in;
    in.name = name;
    if (sort_arguments(name, given, count, names, sorted) || read_input(state, sorted, &in)) return NULL;
    return query_answer(state, &in);
}

static PyObject *collide(PyObject *module, PyObject *const *given, Py_ssize_t count, PyObject *names) {
    return query(module, QUERY_COLLIDE, given, count, names);
}
static PyObject *within(PyObject *module, PyObject *const *given, Py_ssize_t count, PyObject *names) {
    return query(module, QUERY_WITHIN, given, count, names);
}
static PyObject *distance(PyObject *module, PyObject *const *given, Py_ssize_t count, PyObject *names) {
    return query(module, QUERY_DISTANCE, given, count, names);
}
static PyObject *depth(PyObject *module, PyObject *const *given, Py_ssize_t count, PyObject *names) {
    return query(module, QUERY_DEPTH, given, count, names);
}

#define ASKED "(a: Body | Prepared, b: Body | Prepared, pose_a: PoseLike = None, pose_b: PoseLike = None, *, "
#define ANSWERED QUERY_SIGNATURE ", earlier: Answer | Records | None = None) -> Answer\n--\n\n"
#define QUERY_DOC                                                                                                      \
    "\n\na, b: Shapes, Compounds or Solids, or two Prepared without poses. pose_a, pose_b: "                           \
    "None (the identity), a Pose, a "                                                                                  \
    "4x4 array, or (xyz, SciPy "                                                                                       \
    "Rotation);\n"                                                                                                     \
    "lengths in the shapes' unit, world frame. It stops where upper - lower is at most absolute_tolerance or\n"        \
    "relative_tolerance (0: 1e-9) of the pair's size, or d is proven above cap (0: none). earlier: the Answer or "     \
    "proof\n"                                                                                                          \
    "of an earlier query of this pair, a warm start that is never trusted. Returns an Answer."

PyMethodDef query_methods[] = {
    {"collide", METHOD_KEYWORDS(collide), METH_FASTCALL | METH_KEYWORDS,
     "collide" ASKED ANSWERED
     "Do the bodies touch? Stops as soon as the sign of the signed distance is proven." QUERY_DOC},
    {"within", METHOD_KEYWORDS(within), METH_FASTCALL | METH_KEYWORDS,
     "within" ASKED "margin: float, " ANSWERED
     "Are the bodies within margin >= 0 of each other? Ask answer.is_within(margin)." QUERY_DOC},
    {"distance", METHOD_KEYWORDS(distance), METH_FASTCALL | METH_KEYWORDS,
     "distance" ASKED ANSWERED
     "The distance to the tolerance, where the bodies are apart; where they overlap only that is proven." QUERY_DOC},
    {"depth", METHOD_KEYWORDS(depth), METH_FASTCALL | METH_KEYWORDS,
     "depth" ASKED ANSWERED
     "The signed distance to the tolerance: where the bodies overlap, minus the penetration depth." QUERY_DOC},
    {NULL, NULL, 0, NULL}};
