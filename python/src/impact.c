// When two moving bodies meet, how near they come, casts and rays; each with the steps that verify() takes.
#include "src/motion.h"
#include "src/query.h"

#include <math.h>
#include <stdlib.h>

#define MOTION_REFUSED                                                                                                 \
    "a margin, tolerance or number of iterations is negative or NaN, or begin and end are not times that both "        \
    "motions have"
#define RAY_REFUSED "the ray is refused: NaN, too large, a direction of zero, or a negative length or radius"

static ovoid_moving_body make_moving(module_state *state, PyObject *body, PyObject *motion) {
    ovoid_body of = body_make(state, body, ovoid_pose_make_identity());
    return (ovoid_moving_body){
        .shape = of.shape, .compound = of.compound, .solid = of.solid, .motion = ((motion_object *)motion)->motion};
}

static ovoid_moving_shape make_moving_shape(const ovoid_moving_body *body) {
    return (ovoid_moving_shape){.shape = body->shape, .motion = body->motion};
}

impact_object *impact_make(PyTypeObject *type, PyObject *a, PyObject *b, PyObject *motion_a, PyObject *motion_b) {
    impact_object *self = object_make(type);
    if (!self) return NULL;
    self->a = Py_NewRef(a);
    self->b = Py_NewRef(b);
    self->motion_a = Py_NewRef(motion_a);
    self->motion_b = Py_NewRef(motion_b);
    return self;
}

static void impact_dealloc(PyObject *object) {
    impact_object *self = (impact_object *)object;
    Py_XDECREF(self->a);
    Py_XDECREF(self->b);
    Py_XDECREF(self->motion_a);
    Py_XDECREF(self->motion_b);
    free(self->steps);
    free(self->groups);
    object_free(object);
}

// ---- finding

enum { IMPACT, APPROACH };

// One search with room for so many steps and groups; what it needed goes to the two counts.
static void search(impact_object *self, int what, const ovoid_moving_body *a, const ovoid_moving_body *b,
                   ovoid_motion_options *o) {
    ovoid_moving_shape shape_a = make_moving_shape(a), shape_b = make_moving_shape(b);
    Py_BEGIN_ALLOW_THREADS;
    if (what == APPROACH)
        self->approach = ovoid_approach_find(&(ovoid_moving_pair){shape_a, shape_b, 0}, o);
    else if (a->shape && b->shape)
        self->of.impact = ovoid_impact_find(&(ovoid_moving_pair){shape_a, shape_b, self->margin}, o);
    else
        self->of = ovoid_body_impact_find(&(ovoid_moving_body_pair){*a, *b, self->margin}, o);
    Py_END_ALLOW_THREADS;
}

// Searches again where the steps were more than there was room for.
static int find_steps(module_state *state, impact_object *self, int what, ovoid_motion_options *o) {
    ovoid_moving_body a = make_moving(state, self->a, self->motion_a), b = make_moving(state, self->b, self->motion_b);
    o->capacity = 64;
    o->group_capacity = a.shape && b.shape ? 0 : 64;
    for (;;) {
        ovoid_step *steps = realloc(self->steps, o->capacity * sizeof *steps);
        if (steps) self->steps = o->steps = steps;
        ovoid_step_group *groups = realloc(self->groups, (o->group_capacity + 1) * sizeof *groups);
        if (groups) self->groups = groups;
        if (!steps || !groups) {
            PyErr_NoMemory();
            return -1;
        }
        o->groups = o->group_capacity ? groups : NULL;
        search(self, what, &a, &b, o);
        size_t count = what == APPROACH ? self->approach.step_count : self->of.impact.step_count;
        // Of compounds the steps counted are those of the deciding pair; the groups count all.
        if (o->groups && self->of.group_count <= o->group_capacity) {
            count = 0;
            for (size_t i = 0; i < self->of.group_count; i++) count += groups[i].count;
        }
        if (count <= o->capacity && (!o->groups || self->of.group_count <= o->group_capacity)) return 0;
        if (count > o->capacity)
            o->capacity = count;
        else
            o->capacity *= 2;
        if (o->groups && self->of.group_count > o->group_capacity) o->group_capacity = self->of.group_count;
    }
}

typedef struct moving_input {
    PyObject *a, *b, *motion_a, *motion_b;
    double margin;
    ovoid_motion_options options;
    unsigned long long iterations;
} moving_input;

static PyObject *find(module_state *state, moving_input *in, int what) {
    ovoid_body a, b;
    if (body_read(state, in->a, "a", &a) || body_read(state, in->b, "b", &b)) return NULL;
    if (what == APPROACH && (!a.shape || !b.shape)) {
        PyErr_SetString(PyExc_TypeError,
                        "find_approach: two Shapes are wanted; of Compounds and Solids ask part by part");
        return NULL;
    }
    if (in->iterations > UINT32_MAX || !(in->margin >= 0)) {
        limit_raise(state, OVOID_LIMIT_OPTIONS, MOTION_REFUSED);
        return NULL;
    }
    in->options.iterations = (uint32_t)in->iterations;
    PyObject *motion_a = motion_read(state, in->motion_a, "motion_a");
    PyObject *motion_b = motion_a ? motion_read(state, in->motion_b, "motion_b") : NULL;
    impact_object *made = NULL;
    if (motion_b)
        made = impact_make(what == APPROACH ? state->approach : state->impact, in->a, in->b, motion_a, motion_b);
    Py_XDECREF(motion_a);
    Py_XDECREF(motion_b);
    if (!made) return NULL;
    made->margin = in->margin;
    made->options = in->options;
    if (!find_steps(state, made, what, &in->options) &&
        !limit_raise(state, what == APPROACH ? made->approach.limit : made->of.impact.limit, MOTION_REFUSED))
        return (PyObject *)made;
    Py_DECREF((PyObject *)made);
    return NULL;
}

static PyObject *find_impact(PyObject *module, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"a",     "b",   "motion_a",  "motion_b",   "margin",
                            "begin", "end", "tolerance", "iterations", NULL};
    moving_input in = {.margin = 0};
    if (!arguments_read(arguments, keywords, "OO|OO$ddddK:find_impact", names, &in.a, &in.b, &in.motion_a, &in.motion_b,
                        &in.margin, &in.options.begin, &in.options.end, &in.options.tolerance, &in.iterations))
        return NULL;
    return find(state_of_module(module), &in, IMPACT);
}

static PyObject *find_approach(PyObject *module, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"a", "b", "motion_a", "motion_b", "begin", "end", "tolerance", "iterations", NULL};
    moving_input in = {.margin = 0};
    if (!arguments_read(arguments, keywords, "OO|OO$dddK:find_approach", names, &in.a, &in.b, &in.motion_a,
                        &in.motion_b, &in.options.begin, &in.options.end, &in.options.tolerance, &in.iterations))
        return NULL;
    return find(state_of_module(module), &in, APPROACH);
}

// ---- checking

ovoid_code impact_verify(module_state *state, PyObject *object, ovoid_error *error) {
    const impact_object *self = (const impact_object *)object;
    ovoid_moving_body a = make_moving(state, self->a, self->motion_a), b = make_moving(state, self->b, self->motion_b);
    ovoid_moving_shape shape_a = make_moving_shape(&a), shape_b = make_moving_shape(&b);
    if (Py_TYPE(object) == state->approach)
        return ovoid_approach_verify(&(ovoid_moving_pair){shape_a, shape_b, 0}, &self->approach,
                                     &(ovoid_motion_basis){.options = &self->options, .steps = self->steps}, error);
    if (a.shape && b.shape)
        return ovoid_impact_verify(&(ovoid_moving_pair){shape_a, shape_b, self->margin}, &self->of.impact,
                                   &(ovoid_motion_basis){.options = &self->options, .steps = self->steps}, error);
    ovoid_code code;
    Py_BEGIN_ALLOW_THREADS;
    code = ovoid_body_impact_verify(
        &(ovoid_moving_body_pair){a, b, self->margin}, &self->of,
        &(ovoid_motion_basis){.options = &self->options, .steps = self->steps, .groups = self->groups}, error);
    Py_END_ALLOW_THREADS;
    return code;
}

// ---- what they hold

static PyObject *get_part(PyObject *body, module_state *state, uint32_t part) {
    if (Py_TYPE(body) == state->shape) return body;
    return PyTuple_GetItem(((compound_object *)body)->shapes, (Py_ssize_t)part);
}

static ovoid_pose get_part_pose(const ovoid_moving_body *body, uint32_t part, double time) {
    if (body->shape) return ovoid_motion_compute_pose(&body->motion, time);
    ovoid_moving_shape moving = ovoid_moving_body_get_part(body, part);
    return ovoid_moving_shape_compute_pose(&moving, time);
}

// A triangle is no body of Python's: solids are asked again, with the deciding triangles first.
static PyObject *ask_solids(const impact_object *self, const ovoid_moving_body *a, const ovoid_moving_body *b,
                            double time, const ovoid_answer *answer) {
    module_state *state = state_of((PyObject *)self);
    ovoid_body_pair pair = {body_make(state, self->a, ovoid_motion_compute_pose(&a->motion, time)),
                            body_make(state, self->b, ovoid_motion_compute_pose(&b->motion, time))};
    ovoid_body_proof earlier = {self->of.part_a, self->of.part_b, answer->proof};
    return query_ask(state, self->a, self->b, &pair, self->margin, &earlier);
}

// The answer of the deciding parts at a time.
static PyObject *make_answer(const impact_object *self, double time, const ovoid_answer *answer) {
    module_state *state = state_of((PyObject *)self);
    ovoid_moving_body a = make_moving(state, self->a, self->motion_a), b = make_moving(state, self->b, self->motion_b);
    if (a.solid || b.solid) return ask_solids(self, &a, &b, time, answer);
    ovoid_pose pose_a = get_part_pose(&a, self->of.part_a, time), pose_b = get_part_pose(&b, self->of.part_b, time);
    answer_object *made = answer_make(state, get_part(self->a, state, self->of.part_a),
                                      get_part(self->b, state, self->of.part_b), &pose_a, &pose_b);
    if (made) made->of = ovoid_body_answer_make(answer, 0, 0);
    return (PyObject *)made;
}

static PyObject *get_free(PyObject *object, void *closure) {
    (void)closure;
    const impact_object *self = (const impact_object *)object;
    if (self->of.impact.free.stage == OVOID_STAGE_NONE) Py_RETURN_NONE;
    return make_answer(self, self->of.impact.free_until, &self->of.impact.free);
}

static PyObject *get_hit(PyObject *object, void *closure) {
    (void)closure;
    const impact_object *self = (const impact_object *)object;
    if (self->of.impact.status != OVOID_IMPACT_HIT) Py_RETURN_NONE;
    return make_answer(self, self->of.impact.hit_at, &self->of.impact.hit);
}

static PyObject *get_nearest(PyObject *object, void *closure) {
    (void)closure;
    const impact_object *self = (const impact_object *)object;
    return make_answer(self, self->approach.time, &self->approach.answer);
}

size_t impact_count_steps(const impact_object *self) {
    module_state *state = state_of((PyObject *)self);
    if (Py_TYPE((PyObject *)self) == state->approach) return self->approach.step_count;
    if (Py_TYPE(self->a) == state->shape && Py_TYPE(self->b) == state->shape) return self->of.impact.step_count;
    size_t count = 0;
    for (size_t i = 0; i < self->of.group_count; i++) count += self->groups[i].count;
    return count;
}

static PyObject *get_steps(PyObject *object, void *closure) {
    (void)closure;
    const impact_object *self = (const impact_object *)object;
    Py_ssize_t count = (Py_ssize_t)impact_count_steps(self);
    return array_copy(state_of(object), RECORD_STEP, 1, &count, self->steps);
}

static PyGetSetDef impact_fields[] = {
    FIELD(impact_object, IMPACT_STATUS, "status", of.impact.status, "What is proven."),
    FIELD(impact_object, LIMIT, "limit", of.impact.limit, "Why it is not decided."),
    FIELD(impact_object, DOUBLE, "free_until", of.impact.free_until,
          "Proven: farther apart than the margin before it."),
    FIELD(impact_object, DOUBLE, "hit_at", of.impact.hit_at,
          "Proven: within the margin then; infinity where that is not proven."),
    FIELD(impact_object, DOUBLE, "begin", of.impact.begin, "The first time queried."),
    FIELD(impact_object, DOUBLE, "end", of.impact.end, "The last time queried."),
    FIELD(impact_object, UINT, "iterations", of.impact.iterations, "Queries at single times."),
    FIELD(impact_object, UINT, "part_a", of.part_a, "The deciding part of a compound a, triangle of a solid."),
    FIELD(impact_object, UINT, "part_b", of.part_b, "The deciding part of a compound b, triangle of a solid."),
    FIELD(impact_object, DOUBLE, "margin", margin, "The margin that was asked about."),
    {"free", get_free, NULL, "Answer | None: The Answer (of Solids asked again) at free_until, or None.", NULL},
    {"hit", get_hit, NULL, "Answer | None: The Answer (of Solids asked again) at hit_at, or None.", NULL},
    {"steps", get_steps, NULL, "Records: The steps that prove free_until: until, normal, frame.", NULL},
    {NULL, NULL, NULL, NULL, NULL}};
static PyType_Slot impact_slots[] = {
    {Py_tp_doc, "When two moving bodies come within a margin: the true time is in [free_until, hit_at]."},
    {Py_tp_dealloc, impact_dealloc},
    {Py_nb_bool, bool_refuse},
    {Py_tp_getset, impact_fields},
    {0, NULL}};
static PyType_Spec impact_spec = {"ovoid.Impact", sizeof(impact_object), 0,
                                  Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION, impact_slots};

static PyGetSetDef approach_fields[] = {
    FIELD(impact_object, STATUS, "status", approach.status, "What is proven of the smallest distance."),
    FIELD(impact_object, LIMIT, "limit", approach.limit, "Why the bracket is not narrower."),
    FIELD(impact_object, DOUBLE, "lower", approach.lower, "Proven: at no time are they nearer."),
    FIELD(impact_object, DOUBLE, "upper", approach.upper, "Proven: at .time they are this near."),
    FIELD(impact_object, DOUBLE, "time", approach.time, "The distance at this time is at most upper."),
    FIELD(impact_object, DOUBLE, "begin", approach.begin, "The first time queried."),
    FIELD(impact_object, DOUBLE, "end", approach.end, "The last time queried."),
    FIELD(impact_object, UINT, "iterations", approach.iterations, "Queries at single times."),
    {"answer", get_nearest, NULL, "Answer: The Answer at .time.", NULL},
    {"steps", get_steps, NULL, "Records: The steps that prove lower: until, normal, frame.", NULL},
    {NULL, NULL, NULL, NULL, NULL}};
static PyType_Slot approach_slots[] = {
    {Py_tp_doc, "How near two moving bodies come: lower <= smallest signed distance <= upper."},
    {Py_tp_dealloc, impact_dealloc},
    {Py_nb_bool, bool_refuse},
    {Py_tp_getset, approach_fields},
    {0, NULL}};
static PyType_Spec approach_spec = {"ovoid.Approach", sizeof(impact_object), 0,
                                    Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION, approach_slots};

// ---- rays

typedef struct ray_hit_object {
    PyObject_HEAD ovoid_ray_hit hit;
} ray_hit_object;

static PyObject *cast_ray(PyObject *module, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"shape", "pose", "origin", "direction", "length", "radius", NULL};
    module_state *state = state_of_module(module);
    PyObject *given, *place, *origin, *direction;
    ovoid_ray ray = {.length = INFINITY};
    ovoid_body body;
    ovoid_posed_shape posed;
    if (!arguments_read(arguments, keywords, "OOOO|d$d:cast_ray", names, &given, &place, &origin, &direction,
                        &ray.length, &ray.radius) ||
        body_read(state, given, "shape", &body) || pose_read(state, place, "pose", &posed.pose) ||
        vec3_read(state, origin, "origin", &ray.origin) || vec3_read(state, direction, "direction", &ray.direction))
        return NULL;
    if (!body.shape) {
        PyErr_SetString(PyExc_TypeError, "shape: a Shape is wanted; a World casts at Compounds and Solids");
        return NULL;
    }
    posed.shape = body.shape;
    ray_hit_object *made = object_make(state->ray_hit);
    if (!made) return NULL;
    made->hit = ovoid_shape_cast_ray(&posed, &ray);
    if (!limit_raise(state, made->hit.limit, RAY_REFUSED)) return (PyObject *)made;
    Py_DECREF((PyObject *)made);
    return NULL;
}

static PyGetSetDef ray_fields[] = {
    FIELD(ray_hit_object, IMPACT_STATUS, "status", hit.status, "What is proven."),
    FIELD(ray_hit_object, LIMIT, "limit", hit.limit, "Why it is not decided."),
    FIELD(ray_hit_object, DOUBLE, "lower", hit.lower,
          "lower <= t: the first t in the body; the length where it misses."),
    FIELD(ray_hit_object, DOUBLE, "upper", hit.upper, "t <= upper; infinity where it misses."),
    FIELD(ray_hit_object, VEC3, "point", hit.point, "The body's point that is met, world frame."),
    FIELD(ray_hit_object, VEC3, "normal", hit.normal, "Unit, out of the body."),
    {NULL, NULL, NULL, NULL, NULL}};
static PyType_Slot ray_slots[] = {{Py_tp_doc, "Where a ray meets a shape."},
                                  {Py_tp_dealloc, object_free},
                                  {Py_nb_bool, bool_refuse},
                                  {Py_tp_getset, ray_fields},
                                  {0, NULL}};
static PyType_Spec ray_spec = {"ovoid.RayHit", sizeof(ray_hit_object), 0,
                               Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION, ray_slots};

int impact_add(PyObject *module) {
    module_state *state = state_of_module(module);
    return type_add(module, &impact_spec, &state->impact) || type_add(module, &approach_spec, &state->approach) ||
           type_add(module, &ray_spec, &state->ray_hit);
}

#define MOTION_DOC                                                                                                     \
    "\n\nmotion_a, motion_b: a Motion, or a pose: it stands still. begin, end: the times queried; both 0: those that " \
    "both "                                                                                                            \
    "motions\nhave. tolerance: of the bracket; 0: the default. verify() checks the result."

PyMethodDef impact_methods[] = {
    {"find_impact", METHOD_KEYWORDS(find_impact), METH_VARARGS | METH_KEYWORDS,
     "find_impact(a: Body, b: Body, motion_a: MotionLike = None, motion_b: MotionLike = None, *, margin: float = 0, "
     "begin: float = 0, end: float = 0, tolerance: float = 0, iterations: int = 0) -> Impact\n--\n\nWhen do two moving "
     "bodies first come within margin >= 0 of each other? An Impact: no tunnels." MOTION_DOC},
    {"find_approach", METHOD_KEYWORDS(find_approach), METH_VARARGS | METH_KEYWORDS,
     "find_approach(a: Shape, b: Shape, motion_a: MotionLike = None, motion_b: MotionLike = None, *, begin: float = 0, "
     "end: float = 0, tolerance: float = 0, iterations: int = 0) -> Approach\n--\n\nHow near do two moving shapes "
     "come, and when? An Approach." MOTION_DOC},
    {"cast_ray", METHOD_KEYWORDS(cast_ray), METH_VARARGS | METH_KEYWORDS,
     "cast_ray(shape: Shape, pose: PoseLike, origin: Numbers, direction: Numbers, length: float = 1e999, *, radius: "
     "float = 0) -> RayHit\n--\n\nWhere does a ray, thick where radius > 0, first meet a shape? A RayHit; t and length "
     "in lengths of direction."},
    {NULL, NULL, 0, NULL}};
