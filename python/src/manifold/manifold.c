// Manifold: the contact of two Shapes, or of each two parts of Compounds: up to four points, a normal, a bracket.
//
// The cover of a search goes with the manifold that it proves, and on to those that are moved on from it.
#include "src/manifold/manifold.h"
#include "src/bodies.h"
#include "src/query.h"

#include <stdlib.h>
#include <string.h>

// ---- the object

manifold_object *manifold_make(module_state *state, PyObject *a, PyObject *b, const ovoid_body_pair *pair) {
    manifold_object *self = object_make(state->manifold);
    if (!self) return NULL;
    self->a = Py_NewRef(a);
    self->b = Py_NewRef(b);
    self->pose_a = pair->a.pose;
    self->pose_b = pair->b.pose;
    return self;
}

static ovoid_body_pair get_bodies(const manifold_object *self) {
    module_state *state = state_of((PyObject *)self);
    return (ovoid_body_pair){body_make(state, self->a, self->pose_a), body_make(state, self->b, self->pose_b)};
}

static ovoid_posed_shape get_part(const ovoid_body *body, uint32_t part) {
    if (!body->compound) return (ovoid_posed_shape){body->shape, body->pose};
    ovoid_posed_shape found = ovoid_compound_get_part(body->compound, part);
    found.pose = ovoid_pose_compute_product(&body->pose, &found.pose);
    return found;
}

// The two parts that meet.
static ovoid_pair get_pair(const ovoid_body_pair *bodies, const ovoid_body_manifold *of) {
    ovoid_posed_shape a = get_part(&bodies->a, of->part_a), b = get_part(&bodies->b, of->part_b);
    return (ovoid_pair){a.shape, b.shape, a.pose, b.pose};
}

int manifold_set_points(manifold_object *self) {
    ovoid_body_pair bodies = get_bodies(self);
    self->points = ovoid_body_manifold_compute_points(&bodies, &self->of);
    return self->points.count == self->of.manifold.count;
}

ovoid_code manifold_verify(const manifold_object *self, ovoid_error *error) {
    ovoid_cover cover = {.memory = NULL};
    ovoid_manifold_options options = self->options;
    ovoid_body_pair bodies = get_bodies(self);
    options.cover = cover_unpack(self->cover, &cover) ? &cover : NULL;
    return ovoid_body_manifold_verify(&bodies, &self->of, &options, error);
}

// ---- queries

typedef struct manifold_input {
    PyObject *a, *b;
    ovoid_body_pair pair;
    ovoid_manifold_options options;
} manifold_input;

static int validate_options(module_state *state, const ovoid_manifold_options *o) {
    if (o->margin >= 0 && o->tolerance >= 0 && o->keep >= 0 && o->angle >= 0 && o->angle <= 1.45 &&
        o->margin <= OVOID_LENGTH_MAX && o->tolerance <= OVOID_LENGTH_MAX && o->keep <= OVOID_LENGTH_MAX)
        return 0;
    raise_code(state, OVOID_ERROR_ARGUMENT, -1,
               "margin, tolerance and keep are lengths >= 0, angle is at most 1.45 radians");
    return -1;
}

// The manifold of two parts, from their earlier one, whose cover stays where nothing is searched.
static int find_one(manifold_object *self, const ovoid_body_pair *bodies, const manifold_object *earlier) {
    cover_room room;
    ovoid_manifold_options options = self->options;
    ovoid_pair pair = get_pair(bodies, &self->of);
    cover_room_make(&room);
    (void)cover_unpack(earlier ? earlier->cover : NULL, &room.cover);
    options.cover = &room.cover;
    do self->of.manifold = ovoid_manifold_find(&pair, &options, earlier ? &earlier->of.manifold : NULL);
    while (cover_room_grow(&room, self->of.manifold.limit));
    self->points = ovoid_manifold_compute_points(&pair, &self->of.manifold);
    return cover_room_keep(&room, &self->cover);
}

static int read_input(module_state *state, PyObject *poses[2], manifold_input *in) {
    if (body_read(state, in->a, "a", &in->pair.a) || body_read(state, in->b, "b", &in->pair.b) ||
        pose_read(state, poses[0], "pose_a", &in->pair.a.pose) ||
        pose_read(state, poses[1], "pose_b", &in->pair.b.pose))
        return -1;
    return validate_options(state, &in->options);
}

static int read_earlier(module_state *state, PyObject *from, const manifold_object **earlier) {
    *earlier = NULL;
    if (!from || from == Py_None) return 0;
    if (Py_TYPE(from) != state->manifold) {
        PyErr_Format(PyExc_TypeError, "earlier: a Manifold is wanted, not %R", (PyObject *)Py_TYPE(from));
        return -1;
    }
    *earlier = (const manifold_object *)from;
    return 0;
}

static PyObject *find_manifold(PyObject *module, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"a", "b", "pose_a", "pose_b", MANIFOLD_NAMES, "earlier", NULL};
    module_state *state = state_of_module(module);
    PyObject *poses[2] = {NULL, NULL}, *given = NULL;
    manifold_input in = {.a = NULL};
    const manifold_object *earlier;
    if (!arguments_read(arguments, keywords, "OO|OO$" MANIFOLD_FORMAT "O:find_manifold", names, &in.a, &in.b, &poses[0],
                        &poses[1], MANIFOLD_TARGETS(in.options), &given) ||
        read_input(state, poses, &in) || read_earlier(state, given, &earlier))
        return NULL;
    if (!in.pair.a.shape || !in.pair.b.shape) {
        PyErr_SetString(PyExc_TypeError, "find_manifold() takes two Shapes; find_manifolds() has the contacts of "
                                         "Compounds and Solids, part by part");
        return NULL;
    }
    manifold_object *made = manifold_make(state, in.a, in.b, &in.pair);
    if (!made) return NULL;
    made->options = in.options;
    // Another pair's manifold is of no use.
    if (earlier && (earlier->a != in.a || earlier->b != in.b)) earlier = NULL;
    if (!find_one(made, &in.pair, earlier) && !limit_raise(state, made->of.manifold.limit, QUERY_REFUSED))
        return (PyObject *)made;
    Py_DECREF((PyObject *)made);
    return NULL;
}

// ---- part by part

// The earlier manifolds of these bodies, sorted as the library wants them; their objects are borrowed from `given`.
typedef struct earlier_list {
    PyObject *given; ///< a tuple
    ovoid_body_manifold *items;
    const manifold_object **objects;
    size_t count;
} earlier_list;

static void clear_list(earlier_list *list) {
    Py_XDECREF(list->given);
    free(list->items);
    free(list->objects);
}

static int read_list(module_state *state, PyObject *from, const manifold_input *in, earlier_list *list) {
    if (!from || from == Py_None) return 0;
    if (!(list->given = PySequence_Tuple(from))) return -1;
    size_t count = (size_t)PyTuple_Size(list->given);
    list->items = calloc(count + 1, sizeof *list->items);
    list->objects = calloc(count + 1, sizeof *list->objects);
    if (!list->items || !list->objects) return PyErr_NoMemory(), -1;
    for (size_t i = 0; i < count; i++) {
        const manifold_object *one;
        if (read_earlier(state, PyTuple_GetItem(list->given, (Py_ssize_t)i), &one)) return -1;
        if (!one || one->a != in->a || one->b != in->b) continue;
        // A list in another order than that of a result is put into it.
        size_t at = list->count++;
        for (; at > 0; at--) {
            const ovoid_body_manifold *before = &list->items[at - 1];
            if (before->part_a < one->of.part_a ||
                (before->part_a == one->of.part_a && before->part_b <= one->of.part_b))
                break;
            list->items[at] = *before;
            list->objects[at] = list->objects[at - 1];
        }
        list->items[at] = one->of;
        list->objects[at] = one;
    }
    return 0;
}

static const manifold_object *find_earlier(const earlier_list *list, const ovoid_body_manifold *of) {
    for (size_t i = 0; i < list->count; i++)
        if (list->items[i].part_a == of->part_a && list->items[i].part_b == of->part_b) return list->objects[i];
    return NULL;
}

// One of a list; where a search proves it, it is found again by itself, with the cover and the same bits.
static PyObject *make_part(module_state *state, const manifold_input *in, const ovoid_body_manifold *of,
                           const earlier_list *list) {
    manifold_object *made = manifold_make(state, in->a, in->b, &in->pair);
    if (!made) return NULL;
    made->options = in->options;
    made->of = *of;
    int failed = 0;
    if (of->manifold.proof == OVOID_MANIFOLD_PROOF_SEARCH)
        failed = find_one(made, &in->pair, find_earlier(list, of));
    else
        manifold_set_points(made);
    if (!failed) return (PyObject *)made;
    Py_DECREF((PyObject *)made);
    return NULL;
}

static PyObject *make_list(module_state *state, const manifold_input *in, const earlier_list *earlier) {
    ovoid_body_manifolds room = {.capacity = 16, .earlier = earlier->items, .earlier_count = earlier->count};
    ovoid_limit limit = OVOID_LIMIT_NONE;
    for (;;) {
        ovoid_body_manifold *larger = realloc(room.items, room.capacity * sizeof *larger);
        if (!larger) return free(room.items), PyErr_NoMemory();
        room.items = larger;
        Py_BEGIN_ALLOW_THREADS;
        limit = ovoid_body_manifolds_find(&in->pair, &in->options, &room);
        Py_END_ALLOW_THREADS;
        if (room.count <= room.capacity) break;
        room.capacity = room.count;
    }
    PyObject *list = limit_raise(state, limit, QUERY_REFUSED) ? NULL : PyList_New(0);
    for (size_t i = 0; list && i < room.count; i++) {
        PyObject *one = make_part(state, in, &room.items[i], earlier);
        if (!one || PyList_Append(list, one)) Py_CLEAR(list);
        Py_XDECREF(one);
    }
    free(room.items);
    return list;
}

static PyObject *find_manifolds(PyObject *module, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"a", "b", "pose_a", "pose_b", MANIFOLD_NAMES, "earlier", NULL};
    module_state *state = state_of_module(module);
    PyObject *poses[2] = {NULL, NULL}, *given = NULL;
    manifold_input in = {.a = NULL};
    if (!arguments_read(arguments, keywords, "OO|OO$" MANIFOLD_FORMAT "O:find_manifolds", names, &in.a, &in.b,
                        &poses[0], &poses[1], MANIFOLD_TARGETS(in.options), &given) ||
        read_input(state, poses, &in))
        return NULL;
    if (in.pair.a.solid && in.pair.b.solid) {
        PyErr_SetString(PyExc_TypeError,
                        "find_manifolds() takes at most one Solid: Compound(solid.decompose()) makes a Compound of the "
                        "other");
        return NULL;
    }
    earlier_list list = {.count = 0};
    PyObject *made = read_list(state, given, &in, &list) ? NULL : make_list(state, &in, &list);
    clear_list(&list);
    return made;
}

// ---- batches

PyObject *manifold_points_copy(module_state *state, const ovoid_manifold_points *points, size_t count) {
    ovoid_manifold_point *to = NULL;
    PyObject *made = array_make(state, RECORD_MANIFOLD_POINT, 2, (Py_ssize_t[]){(Py_ssize_t)count, 4}, &to);
    for (size_t i = 0; made && i < count; i++) memcpy(to + 4 * i, points[i].points, points[i].count * sizeof *to);
    return array_wrap(state, made);
}

PyObject *manifold_grown_copy(module_state *state, const ovoid_manifold_points *points, size_t count) {
    double *to = NULL;
    PyObject *made = array_make(state, RECORD_DOUBLE, 1, (Py_ssize_t[]){(Py_ssize_t)count}, &to);
    for (size_t i = 0; made && i < count; i++) to[i] = points[i].grown;
    return array_wrap(state, made);
}

static ovoid_code run_piece(void *context, size_t first, size_t count, ovoid_error *error) {
    ovoid_manifold_batch part = *(const ovoid_manifold_batch *)context;
    part.couples += first;
    part.couple_count = count;
    part.manifolds += first;
    part.points += first;
    ovoid_code code = ovoid_manifold_find_batch(&part, error);
    if (code == OVOID_ERROR_INDEX && error->place >= 0) error->place += (int64_t)first;
    return code;
}

// The couples of a batch, which the caller frees: all are checked before anything is written.
static ovoid_couple *read_couples(module_state *state, PyObject *from, Py_ssize_t body_count, Py_ssize_t *count) {
    items given;
    if (items_read(state, from, "couples", 2, (Py_ssize_t[]){-1, 2}, 'q', &given)) return NULL;
    const int64_t *index = given.data;
    *count = given.shape[0];
    ovoid_couple *made = malloc((size_t)(*count + 1) * sizeof *made);
    if (!made) PyErr_NoMemory();
    for (Py_ssize_t i = 0; made && i < 2 * *count; i++) {
        if (index[i] >= 0 && index[i] < body_count) {
            *(i % 2 ? &made[i / 2].b : &made[i / 2].a) = (uint32_t)index[i];
            continue;
        }
        raise_code(state, OVOID_ERROR_INDEX, i / 2, "couple %zd names body %lld of %zd", i / 2, (long long)index[i],
                   body_count);
        free(made);
        made = NULL;
    }
    free(given.data);
    return made;
}

// The array of manifolds is that of the caller, or a new one of zeros.
static PyObject *run_batch(module_state *state, ovoid_manifold_batch *batch, PyObject *given, PyObject *progress) {
    Py_buffer view = {.obj = NULL};
    Py_ssize_t count = (Py_ssize_t)batch->couple_count;
    PyObject *array = NULL, *points = NULL, *grown = NULL;
    if (given && given != Py_None) {
        if (records_view(state, given, "manifolds", RECORD_MANIFOLD, count, 1, &view)) return NULL;
        batch->manifolds = view.buf;
    } else if (!(array = array_make(state, RECORD_MANIFOLD, 1, &count, &batch->manifolds)))
        return NULL;
    batch->points = malloc(((size_t)count + 1) * sizeof *batch->points);
    const pieces work = {(size_t)count, 256, run_piece, batch, progress};
    int failed = !batch->points;
    if (failed) PyErr_NoMemory();
    failed = failed || pieces_run(state, &work);
    if (!failed) points = manifold_points_copy(state, batch->points, (size_t)count);
    if (points) grown = manifold_grown_copy(state, batch->points, (size_t)count);
    free(batch->points);
    if (view.obj)
        PyBuffer_Release(&view), array = Py_NewRef(given);
    else if (grown)
        array = array_wrap(state, array);
    if (array && points && grown) return Py_BuildValue("NNN", array, points, grown);
    Py_XDECREF(array);
    Py_XDECREF(points);
    Py_XDECREF(grown);
    return NULL;
}

static PyObject *find_manifold_batch(PyObject *module, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"bodies", "couples", MANIFOLD_NAMES, "manifolds", "progress", NULL};
    module_state *state = state_of_module(module);
    PyObject *given_bodies, *given_couples, *manifolds = NULL, *progress = NULL;
    ovoid_manifold_options options = {0};
    if (!arguments_read(arguments, keywords, "OO|$" MANIFOLD_FORMAT "OO:find_manifold_batch", names, &given_bodies,
                        &given_couples, MANIFOLD_TARGETS(options), &manifolds, &progress) ||
        validate_options(state, &options) || progress_validate(progress))
        return NULL;
    bodies_object *bodies = (bodies_object *)given_bodies;
    if (Py_TYPE(given_bodies) != state->bodies || bodies->others)
        return PyErr_Format(PyExc_TypeError, "bodies: Bodies of Shapes alone are wanted, not %R",
                            (PyObject *)Py_TYPE(given_bodies));
    Py_ssize_t count;
    ovoid_couple *couples = read_couples(state, given_couples, bodies->count, &count);
    if (!couples) return NULL;
    ovoid_manifold_batch batch = {.bodies = bodies->items,
                                  .body_count = (size_t)bodies->count,
                                  .couples = couples,
                                  .couple_count = (size_t)count,
                                  .options = &options};
    bodies->users++;
    PyObject *made = run_batch(state, &batch, manifolds, progress == Py_None ? NULL : progress);
    bodies->users--;
    free(couples);
    return made;
}

// ---- what it has

static const ovoid_manifold_point *get_points(const manifold_object *self, Py_ssize_t *count) {
    *count = (Py_ssize_t)self->points.count;
    return self->points.points;
}

static PyObject *get_all_points(PyObject *self, void *closure) {
    (void)closure;
    Py_ssize_t count;
    const ovoid_manifold_point *points = get_points((const manifold_object *)self, &count);
    return array_copy(state_of(self), RECORD_MANIFOLD_POINT, 1, &count, points);
}

static PyObject *get_vectors(PyObject *self, void *closure) {
    Py_ssize_t count;
    const ovoid_manifold_point *points = get_points((const manifold_object *)self, &count);
    double to[4][3];
    for (Py_ssize_t i = 0; i < count; i++) {
        const ovoid_vec3 *v = closure ? &points[i].point_b : &points[i].point_a;
        to[i][0] = v->x, to[i][1] = v->y, to[i][2] = v->z;
    }
    return array_copy(state_of(self), RECORD_DOUBLE, 2, (Py_ssize_t[]){count, 3}, to);
}

static PyObject *get_separations(PyObject *self, void *closure) {
    (void)closure;
    Py_ssize_t count;
    const ovoid_manifold_point *points = get_points((const manifold_object *)self, &count);
    double to[4];
    for (Py_ssize_t i = 0; i < count; i++) to[i] = points[i].separation;
    return array_copy(state_of(self), RECORD_DOUBLE, 1, &count, to);
}

static PyObject *get_ids(PyObject *self, void *closure) {
    (void)closure;
    Py_ssize_t count;
    const ovoid_manifold_point *points = get_points((const manifold_object *)self, &count);
    uint32_t to[4];
    for (Py_ssize_t i = 0; i < count; i++) to[i] = points[i].id;
    return array_copy(state_of(self), RECORD_UINT32, 1, &count, to);
}

static PyObject *get_proof(PyObject *self, void *closure) {
    (void)closure;
    return enum_get(state_of(self), ENUM_MANIFOLD_PROOF, ((manifold_object *)self)->of.manifold.proof);
}

static PyObject *get_corners(PyObject *self, void *closure) {
    (void)closure;
    return PyLong_FromUnsignedLong(((manifold_object *)self)->of.manifold.corners);
}

static PyObject *get_share(PyObject *self, void *closure) {
    (void)closure;
    return PyFloat_FromDouble((double)((manifold_object *)self)->of.manifold.share);
}

static PyObject *polygon(PyObject *object, PyObject *ignored) {
    (void)ignored;
    manifold_object *self = (manifold_object *)object;
    module_state *state = state_of(object);
    ovoid_body_pair bodies = get_bodies(self);
    if (bodies.a.solid || bodies.b.solid)
        return raise_code(state, OVOID_ERROR_ARGUMENT, -1,
                          "a facet of a Solid need not be convex: its contact has points but no polygon");
    ovoid_pair pair = get_pair(&bodies, &self->of);
    ovoid_manifold_polygon found = {.count = 0};
    if (self->of.manifold.count &&
        ovoid_manifold_compute_polygon(&pair, &self->of.manifold, &self->options, &found) != OVOID_OK)
        return raise_code(state, OVOID_ERROR_ARGUMENT, -1, "the manifold is not one of its bodies");
    PyObject *points =
        array_copy(state, RECORD_MANIFOLD_POINT, 1, (Py_ssize_t[]){(Py_ssize_t)found.count}, found.points);
    if (!points) return NULL;
    return PyObject_CallFunction(state->manifold_polygon, "Nddd", points, found.grown, found.inner, found.outer);
}

static PyObject *swapped(PyObject *object, PyObject *ignored) {
    (void)ignored;
    const manifold_object *self = (const manifold_object *)object;
    const ovoid_body_pair bodies = get_bodies(self), other = {bodies.b, bodies.a};
    manifold_object *made = manifold_make(state_of(object), self->b, self->a, &other);
    if (!made) return NULL;
    made->of = (ovoid_body_manifold){self->of.part_b, self->of.part_a, ovoid_manifold_make_swapped(&self->of.manifold)};
    made->options = self->options;
    manifold_set_points(made);
    // The cover is in the order in which both bodies were taken, which the manifold keeps.
    ovoid_cover cover = {.memory = NULL};
    if (!cover_unpack(self->cover, &cover) || !cover_keep(&made->cover, &cover)) return (PyObject *)made;
    Py_DECREF((PyObject *)made);
    return NULL;
}

static PyObject *repr(PyObject *self) {
    const ovoid_manifold *m = &((manifold_object *)self)->of.manifold;
    char text[160];
    PyOS_snprintf(text, sizeof text, "<ovoid.Manifold: %u point%s by %s, %.17g <= d <= %.17g>", (unsigned)m->count,
                  m->count == 1 ? "" : "s", ovoid_manifold_axis_get_name(m->axis), m->lower, m->upper);
    return PyUnicode_FromString(text);
}

static Py_ssize_t length(PyObject *self) { return (Py_ssize_t)((manifold_object *)self)->points.count; }

static void manifold_dealloc(PyObject *object) {
    manifold_object *self = (manifold_object *)object;
    Py_XDECREF(self->a);
    Py_XDECREF(self->b);
    free(self->cover);
    object_free(object);
}

#define OF(kind, name, member, doc) FIELD(manifold_object, kind, name, of.manifold.member, doc)
static PyGetSetDef fields[] = {
    OF(STATUS, "status", status, "What is proven of the signed distance d."),
    OF(DOUBLE, "lower", lower,
       "Proven: lower <= d. It is the gap along the normal: moving b by -lower along it parts both."),
    OF(DOUBLE, "upper", upper, "Proven: d <= upper; no direction parts the bodies by less than -upper."),
    OF(LIMIT, "limit", limit, "Why the bracket is not narrower; CAP where they are farther apart than the margin."),
    OF(VEC3, "normal", normal, "Unit normal from a to b, world frame."),
    OF(AXIS, "axis", axis, "What the normal is made of."),
    OF(UINT, "feature_a", feature_a, "What of a makes the axis: a vertex, an edge or a facet (docs/contact.md)."),
    OF(UINT, "feature_b", feature_b, "What of b makes it."),
    OF(UINT, "facet_a", facet_a, "The feature of a that was clipped."),
    OF(UINT, "facet_b", facet_b, "The feature of b that was clipped."),
    {"proof", get_proof, NULL, "ManifoldProof: What the upper bound rests on.", NULL},
    {"corners", get_corners, NULL, "int: Corners of the whole polygon; the points are four of them if there are more.",
     NULL},
    {"share", get_share, NULL, "float: The area of the points' quadrilateral divided by that of the polygon.", NULL},
    {"points", get_all_points, NULL, "Records: The points, records point_a, point_b, separation, id.", NULL},
    {"points_a", get_vectors, NULL, "Floats: The points on a, (n, 3), world frame.", NULL},
    {"points_b", get_vectors, NULL,
     "Floats: The points on b, (n, 3): points_b - points_a = separations[:, None] * normal.", "b"},
    {"separations", get_separations, NULL, "Floats: Of each point, along the normal; negative: overlap.", NULL},
    {"ids", get_ids, NULL, "Indices: Of each point, the same as long as its features are.", NULL},
    FIELD(manifold_object, DOUBLE, "grown", points.grown,
          "Each point of a lies in a grown by this, each of b in b: rounding, snapping, kept corners."),
    FIELD(manifold_object, UINT, "part_a", of.part_a, "The part of a Compound a; of a Shape 0."),
    FIELD(manifold_object, UINT, "part_b", of.part_b, "The part of b."),
    FIELD_PYTHON(manifold_object, "Body", "a", a, "The first body."),
    FIELD_PYTHON(manifold_object, "Body", "b", b, "The second body."),
    FIELD(manifold_object, POSE, "pose_a", pose_a, "The pose of a."),
    FIELD(manifold_object, POSE, "pose_b", pose_b, "The pose of b."),
    {NULL, NULL, NULL, NULL, NULL}};

static PyMethodDef methods[] = {
    {"polygon", polygon, METH_NOARGS,
     "polygon() -> ManifoldPolygon\n--\n\nThe whole polygon of the contact, with an inner and an outer area."},
    {"swapped", swapped, METH_NOARGS, "swapped() -> Manifold\n--\n\nThe contact of (b, a)."},
    {NULL, NULL, 0, NULL}};

static PyType_Slot slots[] = {
    {Py_tp_doc, "The contact of two bodies, or of two of their parts: a normal, a bracket lower <= d <= upper, and "
                "len(manifold) points, up to\nfour; none where they are proven farther apart than the margin. "
                "ovoid.verify(manifold) checks it without a search."},
    {Py_tp_dealloc, manifold_dealloc},
    {Py_tp_repr, repr},
    {Py_mp_length, length},
    {Py_nb_bool, bool_refuse},
    {Py_tp_getset, fields},
    {Py_tp_methods, methods},
    {0, NULL}};
static PyType_Spec spec = {"ovoid.Manifold", sizeof(manifold_object), 0,
                           Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION, slots};

#define OPTIONS_DOC                                                                                                    \
    "margin: contacts\nare given up to this distance. tolerance: a kept contact is used again without a search while " \
    "its "                                                                                                             \
    "bracket is at most this\nwide; 0: 1e-9 of the pair's size. keep: a kept corner stays while it is outside by at "  \
    "most "                                                                                                            \
    "this; 0: exact polygons. angle: facets\nturned from the plane of contact by more touch with an edge or a vertex " \
    "alone; 0: 1.45 radians."

PyMethodDef manifold_methods[] = {
    {"find_manifold", METHOD_KEYWORDS(find_manifold), METH_VARARGS | METH_KEYWORDS,
     "find_manifold(a: Shape, b: Shape, pose_a: PoseLike = None, pose_b: PoseLike = None, *, " MANIFOLD_SIGNATURE
     ", earlier: Manifold | None = None) -> Manifold\n--\n\nThe contact of two Shapes. " OPTIONS_DOC
     " earlier: the last\nManifold of these two, which is moved on and measured again where it still holds: ids stay."},
    {"find_manifolds", METHOD_KEYWORDS(find_manifolds), METH_VARARGS | METH_KEYWORDS,
     "find_manifolds(a: Body, b: Body, pose_a: PoseLike = None, pose_b: PoseLike = None, "
     "*, " MANIFOLD_SIGNATURE ", earlier: Sequence[Manifold] | None = None) -> list[Manifold]\n--\n\nThe contacts of "
     "all pairs of parts that are not proven farther apart than the margin, sorted by their parts; of one Solid the "
     "parts "
     "are its flat facets. " OPTIONS_DOC " earlier: the last list of these two."},
    {"find_manifold_batch", METHOD_KEYWORDS(find_manifold_batch), METH_VARARGS | METH_KEYWORDS,
     "find_manifold_batch(bodies: Bodies, couples: Numbers, *, " MANIFOLD_SIGNATURE
     ", manifolds: Records | None = None, progress: Progress | None = None) -> tuple[Records, Records, Floats]\n--\n\n"
     "find_manifold() for each couple, with the same bits: the manifolds, an array of records with the fields of a "
     "Manifold; their\npoints, (m, 4) records of which each manifold has its count; and what they are grown by. "
     "bodies: Bodies of Shapes. couples: integers\n(m, 2). manifolds: of ovoid.zeros, or of the call before: the "
     "earlier ones of these couples, replaced by the new. " OPTIONS_DOC " progress(done, total) is called now and "
     "then; on one thread, without the interpreter's lock."},
    {NULL, NULL, 0, NULL}};

int manifold_add(PyObject *module) { return type_add(module, &spec, &state_of_module(module)->manifold); }
