// Queries of a world between steps: nearest, any, overlaps, casts. They change nothing, and run without the
// interpreter's lock.
#include "src/world/world.h"

#include <math.h>
#include <stdlib.h>

// ---- hits

// Of solids the whole answer is asked again, with the deciding triangles first.
static PyObject *make_answer(module_state *state, PyObject *a, PyObject *b, const ovoid_pose poses[2],
                             const ovoid_body_answer *of, const ovoid_options *options) {
    ovoid_body_pair pair = {body_make(state, a, poses[0]), body_make(state, b, poses[1])};
    if (pair.a.solid || pair.b.solid) {
        ovoid_body_proof earlier = ovoid_body_answer_get_proof(of);
        return query_ask(state, a, b, &pair, -1, &earlier);
    }
    answer_object *made = answer_make(state, a, b, &poses[0], &poses[1]);
    if (made) made->of = *of;
    if (made && options) made->options = *options;
    return (PyObject *)made;
}

// One side of a hit: the probe of a number, with the pose it was asked with, or the body of an id; a new reference.
static int find_side(world_object *self, ovoid_id id, const hits_query *query, PyObject **body, ovoid_pose *pose) {
    if (!query || !query->probes) return world_find(self, id, body, pose);
    *body = Py_NewRef(PyTuple_GetItem(query->probes, (Py_ssize_t)id));
    *pose = query->posed[id].body.pose;
    return 0;
}

PyObject *hit_make(world_object *self, const ovoid_world_hit *hit, const hits_query *query) {
    if (!hit->b) Py_RETURN_NONE;
    module_state *state = state_of((PyObject *)self);
    PyObject *a = NULL, *b = NULL, *answer = NULL;
    ovoid_pose poses[2];
    const hits_query *others = hit->b & OVOID_WORLD_PROBE ? query : NULL;
    if (!find_side(self, hit->a, query, &a, &poses[0]) &&
        !find_side(self, hit->b & ~OVOID_WORLD_PROBE, others, &b, &poses[1]))
        answer = make_answer(state, a, b, poses, &hit->answer, query->options);
    Py_XDECREF(a);
    Py_XDECREF(b);
    if (!answer) return NULL;
    return PyObject_CallFunction(state->hit, "KKdN", hit->a, hit->b, hit->lower, answer);
}

// ---- nearest

static PyObject *nearest(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"id", QUERY_NAMES, NULL};
    world_object *self = (world_object *)object;
    module_state *state = state_of(object);
    query_keywords k = {0};
    ovoid_id id;
    ovoid_world_hit hit;
    ovoid_error error;
    ovoid_code code;
    if (!arguments_read(arguments, keywords, "O&|$" QUERY_FORMAT ":nearest", names, id_read, &id, QUERY_TARGETS(k)) ||
        query_keywords_validate(state, &k) || world_enter(self, 0))
        return NULL;
    Py_BEGIN_ALLOW_THREADS;
    code = ovoid_world_find_nearest(self->world, &(ovoid_world_query){.id = id, .options = &k.options}, &hit, &error);
    Py_END_ALLOW_THREADS;
    PyObject *made =
        code == OVOID_OK ? hit_make(self, &hit, &(hits_query){NULL, NULL, &k.options}) : raise_error(state, &error);
    world_leave(self, 0);
    return made;
}

static PyObject *nearest_to(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"body", "pose", "group", "mask", QUERY_NAMES, NULL};
    world_object *self = (world_object *)object;
    module_state *state = state_of(object);
    query_keywords k = {0};
    PyObject *body, *pose = NULL;
    ovoid_world_body probe = {0};
    ovoid_world_hit hit;
    ovoid_error error;
    ovoid_code code;
    if (!arguments_read(arguments, keywords, "O|O$O&O&" QUERY_FORMAT ":nearest_to", names, &body, &pose, bits_read,
                        &probe.groups.group, bits_read, &probe.groups.mask, QUERY_TARGETS(k)) ||
        probe_read(state, body, pose, &probe) || query_keywords_validate(state, &k) || world_enter(self, 0))
        return NULL;
    Py_BEGIN_ALLOW_THREADS;
    code = ovoid_world_find_nearest(self->world, &(ovoid_world_query){.probe = &probe, .options = &k.options}, &hit,
                                    &error);
    Py_END_ALLOW_THREADS;
    PyObject *probes = PyTuple_Pack(1, body), *made = NULL;
    if (code != OVOID_OK)
        raise_error(state, &error);
    else if (probes)
        made = hit_make(self, &hit, &(hits_query){probes, &probe, &k.options});
    Py_XDECREF(probes);
    world_leave(self, 0);
    return made;
}

static PyObject *nearest_pair(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {QUERY_NAMES, NULL};
    world_object *self = (world_object *)object;
    module_state *state = state_of(object);
    query_keywords k = {0};
    ovoid_world_hit hit;
    ovoid_error error;
    ovoid_code code;
    if (!arguments_read(arguments, keywords, "|$" QUERY_FORMAT ":nearest_pair", names, QUERY_TARGETS(k)) ||
        query_keywords_validate(state, &k) || world_enter(self, 0))
        return NULL;
    Py_BEGIN_ALLOW_THREADS;
    code = ovoid_world_find_nearest_pair(self->world, &k.options, &hit, &error);
    Py_END_ALLOW_THREADS;
    PyObject *made =
        code == OVOID_OK ? hit_make(self, &hit, &(hits_query){NULL, NULL, &k.options}) : raise_error(state, &error);
    world_leave(self, 0);
    return made;
}

// ---- any

static PyObject *find_any(PyObject *object, PyObject *arguments) {
    world_object *self = (world_object *)object;
    module_state *state = state_of(object);
    PyObject *given = Py_None;
    items ids = {NULL, {0, 0, 0}};
    ovoid_world_hit hit;
    ovoid_error error;
    ovoid_code code;
    if (!PyArg_ParseTuple(arguments, "|O:find_any", &given)) return NULL;
    if (given != Py_None && items_read(state, given, "ids", 1, (Py_ssize_t[]){-1}, 'q', &ids)) return NULL;
    if (world_enter(self, 0)) {
        free(ids.data);
        return NULL;
    }
    Py_BEGIN_ALLOW_THREADS;
    code = ovoid_world_find_any(
        self->world, given != Py_None ? &(ovoid_world_ids){ids.data, (size_t)ids.shape[0]} : NULL, &hit, &error);
    Py_END_ALLOW_THREADS;
    PyObject *made =
        code == OVOID_OK ? hit_make(self, &hit, &(hits_query){NULL, NULL, NULL}) : raise_error(state, &error);
    world_leave(self, 0);
    free(ids.data);
    return made;
}

// Couples of numbers of probes as the library's, which the caller frees; what names no probe stays too large.
static ovoid_couple *read_couples(module_state *state, PyObject *from, size_t *count) {
    items given;
    if (items_read(state, from, "couples", 2, (Py_ssize_t[]){-1, 2}, 'q', &given)) return NULL;
    *count = (size_t)given.shape[0];
    ovoid_couple *made = malloc((*count + 1) * sizeof *made);
    const int64_t *from_items = given.data;
    for (size_t i = 0; made && i < 2 * *count; i++)
        *(i % 2 ? &made[i / 2].b : &made[i / 2].a) =
            from_items[i] >= 0 && from_items[i] < UINT32_MAX ? (uint32_t)from_items[i] : UINT32_MAX;
    free(given.data);
    return made ? made : (ovoid_couple *)PyErr_NoMemory();
}

static PyObject *find_any_among(world_object *self, PyObject *bodies, const ovoid_pose *poses, ovoid_world_probes *of) {
    module_state *state = state_of((PyObject *)self);
    Py_ssize_t count = PyTuple_Size(bodies);
    ovoid_world_body *probes = calloc((size_t)count + 1, sizeof *probes);
    if (!probes) return PyErr_NoMemory();
    int failed = 0;
    for (Py_ssize_t i = 0; !failed && i < count; i++) {
        failed = body_read(state, PyTuple_GetItem(bodies, i), "bodies", &probes[i].body);
        probes[i].body.pose = poses[i];
    }
    PyObject *made = NULL;
    of->items = probes;
    of->count = (size_t)count;
    if (!failed && !world_enter(self, 0)) {
        ovoid_world_hit hit;
        ovoid_error error;
        ovoid_code code;
        Py_BEGIN_ALLOW_THREADS;
        code = ovoid_world_find_any_of(self->world, of, &hit, &error);
        Py_END_ALLOW_THREADS;
        made =
            code == OVOID_OK ? hit_make(self, &hit, &(hits_query){bodies, probes, NULL}) : raise_error(state, &error);
        world_leave(self, 0);
    }
    free(probes);
    return made;
}

static PyObject *find_any_with(PyObject *object, PyObject *given, PyObject *given_poses, const char *order,
                               PyObject *couples) {
    module_state *state = state_of(object);
    ovoid_world_probes of = {.couple_count = 0};
    ovoid_couple *made_couples = NULL;
    ovoid_pose *poses;
    Py_ssize_t count;
    PyObject *made = NULL;
    if (poses_read(state, given_poses, order, &poses, &count)) return NULL;
    PyObject *bodies = PySequence_Tuple(given);
    if (bodies && couples) of.couples = made_couples = read_couples(state, couples, &of.couple_count);
    if (!bodies || (couples && !made_couples))
        made = NULL;
    else if (PyTuple_Size(bodies) == count)
        made = find_any_among((world_object *)object, bodies, poses, &of);
    else
        raise_code(state, OVOID_ERROR_ARGUMENT, -1, "poses: %zd bodies need as many, not %zd", PyTuple_Size(bodies),
                   count);
    Py_XDECREF(bodies);
    free(made_couples);
    free(poses);
    return made;
}

static PyObject *find_any_to(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"bodies", "poses", "order", NULL};
    PyObject *given, *poses;
    const char *order = NULL;
    if (!arguments_read(arguments, keywords, "OO|$z:find_any_to", names, &given, &poses, &order)) return NULL;
    return find_any_with(object, given, poses, order, NULL);
}

static PyObject *find_any_of(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"bodies", "poses", "couples", "order", NULL};
    PyObject *given, *poses, *couples;
    const char *order = NULL;
    if (!arguments_read(arguments, keywords, "OOO|$z:find_any_of", names, &given, &poses, &couples, &order))
        return NULL;
    return find_any_with(object, given, poses, order, couples);
}

// ---- all within a margin

static PyObject *make_hits(world_object *self, const ovoid_world_hits *hits, PyObject *body,
                           const ovoid_world_query *of) {
    PyObject *probes = PyTuple_Pack(1, body);
    PyObject *list = probes ? PyList_New(0) : NULL;
    const hits_query query = {probes, of->probe, of->options};
    for (size_t i = 0; list && i < hits->count; i++) {
        PyObject *hit = hit_make(self, &hits->items[i], &query);
        if (!hit || PyList_Append(list, hit)) Py_CLEAR(list);
        Py_XDECREF(hit);
    }
    Py_XDECREF(probes);
    return list;
}

static PyObject *find_overlaps(world_object *self, PyObject *body, const ovoid_world_query *of) {
    module_state *state = state_of((PyObject *)self);
    ovoid_world_hits hits = {.capacity = 16};
    PyObject *made = NULL;
    for (;;) {
        ovoid_world_hit *grown = realloc(hits.items, hits.capacity * sizeof *grown);
        if (!grown) {
            PyErr_NoMemory();
            break;
        }
        hits.items = grown;
        ovoid_error error;
        ovoid_code code;
        Py_BEGIN_ALLOW_THREADS;
        code = ovoid_world_find_overlaps(self->world, of, &hits, &error);
        Py_END_ALLOW_THREADS;
        if (code != OVOID_OK) {
            raise_error(state, &error);
            break;
        }
        if (hits.count <= hits.capacity) {
            made = make_hits(self, &hits, body, of);
            break;
        }
        hits.capacity = hits.count;
    }
    free(hits.items);
    return made;
}

static PyObject *overlaps(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"body", "pose", "margin", "group", "mask", QUERY_NAMES, NULL};
    world_object *self = (world_object *)object;
    module_state *state = state_of(object);
    query_keywords k = {0};
    PyObject *body, *pose = NULL;
    double margin = 0;
    ovoid_world_body probe = {0};
    if (!arguments_read(arguments, keywords, "O|O$dO&O&" QUERY_FORMAT ":overlaps", names, &body, &pose, &margin,
                        bits_read, &probe.groups.group, bits_read, &probe.groups.mask, QUERY_TARGETS(k)) ||
        probe_read(state, body, pose, &probe) || query_keywords_validate(state, &k) ||
        cap_refuse(state, &k, "overlaps") || world_enter(self, 0))
        return NULL;
    PyObject *made =
        find_overlaps(self, body, &(ovoid_world_query){.probe = &probe, .margin = margin, .options = &k.options});
    world_leave(self, 0);
    return made;
}

// ---- casts

static PyObject *make_cast(module_state *state, const ovoid_world_cast *c) {
    PyObject *point = vec3_make(c->point), *normal = vec3_make(c->normal);
    if (point && normal)
        return PyObject_CallFunction(state->cast, "KIIddNNI", c->body, c->part, c->probe, c->lower, c->upper, point,
                                     normal, c->undecided);
    Py_XDECREF(point);
    Py_XDECREF(normal);
    return NULL;
}

static PyObject *cast_ray(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"origin", "direction", "length", "radius", "group", "mask", NULL};
    world_object *self = (world_object *)object;
    module_state *state = state_of(object);
    PyObject *origin, *direction;
    ovoid_world_ray ray = {.ray = {.length = INFINITY}};
    ovoid_world_cast cast;
    ovoid_error error;
    if (!arguments_read(arguments, keywords, "OO|d$dO&O&:cast_ray", names, &origin, &direction, &ray.ray.length,
                        &ray.ray.radius, bits_read, &ray.groups.group, bits_read, &ray.groups.mask) ||
        vec3_read(state, origin, "origin", &ray.ray.origin) ||
        vec3_read(state, direction, "direction", &ray.ray.direction) || world_enter(self, 0))
        return NULL;
    ovoid_code code = ovoid_world_cast_ray(self->world, &ray, &cast, &error);
    world_leave(self, 0);
    return code == OVOID_OK ? make_cast(state, &cast) : raise_error(state, &error);
}

static PyObject *cast_body(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"body", "pose", "displacement", "group", "mask", NULL};
    world_object *self = (world_object *)object;
    module_state *state = state_of(object);
    PyObject *body, *pose, *way;
    ovoid_vec3 displacement;
    ovoid_world_body probe = {0};
    ovoid_world_cast cast;
    ovoid_error error;
    ovoid_code code;
    if (!arguments_read(arguments, keywords, "OOO|$O&O&:cast_body", names, &body, &pose, &way, bits_read,
                        &probe.groups.group, bits_read, &probe.groups.mask) ||
        probe_read(state, body, pose, &probe) || vec3_read(state, way, "displacement", &displacement) ||
        world_enter(self, 0))
        return NULL;
    Py_BEGIN_ALLOW_THREADS;
    code = ovoid_world_cast_body(self->world, &(ovoid_world_sweep){probe, displacement}, &cast, &error);
    Py_END_ALLOW_THREADS;
    world_leave(self, 0);
    return code == OVOID_OK ? make_cast(state, &cast) : raise_error(state, &error);
}

PyMethodDef world_queries[] = {
    {"nearest", METHOD_KEYWORDS(nearest), METH_VARARGS | METH_KEYWORDS,
     "nearest(id: SupportsIndex, *, " QUERY_SIGNATURE
     ") -> Hit | None\n--\n\nThe body nearest to a body, within cap (0: any): a Hit, or None. Of those that "
     "overlap it, one."},
    {"nearest_to", METHOD_KEYWORDS(nearest_to), METH_VARARGS | METH_KEYWORDS,
     "nearest_to(body: Body, pose: PoseLike = None, *, group: int = 0, mask: int = 0, " QUERY_SIGNATURE
     ") -> Hit | None\n--\n\nThe body nearest to one that is not in the world: a Hit, or None."},
    {"nearest_pair", METHOD_KEYWORDS(nearest_pair), METH_VARARGS | METH_KEYWORDS,
     "nearest_pair(*, " QUERY_SIGNATURE
     ") -> Hit | None\n--\n\nThe two nearest of all bodies: a Hit, or None. Two that overlap end the search."},
    {"find_any", find_any, METH_VARARGS,
     "find_any(ids: Numbers | None = None, /) -> Hit | None\n--\n\nDoes any of these bodies (None: of all) touch "
     "another? The first Hit that is not proven apart, or None."},
    {"find_any_to", METHOD_KEYWORDS(find_any_to), METH_VARARGS | METH_KEYWORDS,
     "find_any_to(bodies: Sequence[Body], poses: PosesLike, *, order: Order = None) -> Hit | None\n--\n\nDoes any of "
     "these bodies, which are not in the world, touch one of it? The Hit whose a is its number, or None."},
    {"find_any_of", METHOD_KEYWORDS(find_any_of), METH_VARARGS | METH_KEYWORDS,
     "find_any_of(bodies: Sequence[Body], poses: PosesLike, couples: Numbers, *, order: Order = None) -> Hit | "
     "None\n--\n\nfind_any_to, and then whether two of these bodies touch: couples (m, 2), numbers of bodies, in the "
     "order given. Of\nsuch a couple the Hit's b is 2**63 plus the number of the other."},
    {"overlaps", METHOD_KEYWORDS(overlaps), METH_VARARGS | METH_KEYWORDS,
     "overlaps(body: Body, pose: PoseLike = None, *, margin: float = 0, group: int = 0, mask: int = 0, " QUERY_SIGNATURE
     ") -> list[Hit]\n--\n\nAll bodies that are not proven farther than margin from one that is not in the world: "
     "Hits, sorted by id."},
    {"cast_ray", METHOD_KEYWORDS(cast_ray), METH_VARARGS | METH_KEYWORDS,
     "cast_ray(origin: Numbers, direction: Numbers, length: float = 1e999, *, radius: float = 0, group: int = 0, mask: "
     "int = 0) -> Cast\n--\n\nThe first hit of a ray, thick where its radius is above 0: a Cast, whose body is 0 where "
     "there is none; t and length\nin lengths of direction."},
    {"cast_body", METHOD_KEYWORDS(cast_body), METH_VARARGS | METH_KEYWORDS,
     "cast_body(body: Body, pose: PoseLike, displacement: Numbers, *, group: int = 0, mask: int = 0) -> "
     "Cast\n--\n\nThe first hit of a body moved along displacement without turning: a Cast, t from 0 to 1."},
    {NULL, NULL, 0, NULL}};
