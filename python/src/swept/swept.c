// SweptSphere: a body that is numbers alone, and the queries of two of them, which make no shape and have no proof.
#include "src/module.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct swept_object {
    PyObject_HEAD ovoid_swept_sphere of; ///< of a hull its points, which the object owns
    ovoid_pose pose;
} swept_object;

static const char *const kinds[] = {"sphere", "capsule", "cylinder", "box", "cone", "ellipsoid", "from_points"};

// ---- constructors

/// What a constructor read, before it is checked.
typedef struct swept_sizes {
    PyObject *pose, *sizes;
    double radius, half_length, rounding;
} swept_sizes;

// The least half length of which the queries know more than that it is small (ovoid/swept.h).
#define LEAST 1e-50

// A length from `least` to the greatest that the library knows.
static int length_validate(module_state *state, const char *what, double length, double least) {
    if (length >= least && length <= OVOID_LENGTH_MAX) return 0;
    ovoid_code code = !isfinite(length)            ? OVOID_ERROR_NOT_FINITE
                      : length < 0 && !(least > 0) ? OVOID_ERROR_RADIUS
                                                   : OVOID_ERROR_RANGE;
    raise_code(state, code, -1,
               least > 0 ? "%s: a length from 1e-50 to 1e50 is wanted" : "%s: a length from 0 to 1e50 is wanted", what);
    return -1;
}

static int lengths_validate(module_state *state, const char *what, const double *lengths, int count) {
    for (int i = 0; i < count; i++)
        if (length_validate(state, what, lengths[i], LEAST)) return -1;
    return 0;
}

// The body at the pose, whose axes are the columns of its rotation; that of a body around an axis is the pose's z.
static int place(module_state *state, PyObject *pose, swept_object *to) {
    ovoid_swept_sphere *of = &to->of;
    if (pose_read(state, pose, "pose", &to->pose)) return -1;
    of->center = to->pose.position;
    double far = fmax(fabs(of->center.x), fmax(fabs(of->center.y), fabs(of->center.z))), m[9];
    if (length_validate(state, "pose: how far the body is", far, 0)) return -1;
    ovoid_pose_compute_matrix(&to->pose, m);
    for (int k = 0; k < 3; k++) of->axis[k] = (ovoid_vec3){m[k], m[3 + k], m[6 + k]};
    int is_around_axis =
        of->core == OVOID_SWEPT_SEGMENT || of->core == OVOID_SWEPT_CYLINDER || of->core == OVOID_SWEPT_CONE;
    if (is_around_axis) of->axis[0] = of->axis[2];
    return 0;
}

// Takes over the points, also where it fails.
static PyObject *swept_wrap(module_state *state, const ovoid_swept_sphere *of, PyObject *pose) {
    swept_object *self = object_make(state->swept_sphere);
    if (!self) {
        free((void *)of->points);
        return NULL;
    }
    self->of = *of;
    if (!place(state, pose, self)) return (PyObject *)self;
    Py_DECREF(self);
    return NULL;
}

static PyObject *sphere(PyObject *type, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"radius", "pose", NULL};
    module_state *state = state_of_type(type);
    swept_sizes s = {.pose = NULL};
    if (!arguments_read(arguments, keywords, "d|O:sphere", names, &s.radius, &s.pose) ||
        length_validate(state, "radius", s.radius, 0))
        return NULL;
    return swept_wrap(state, &(ovoid_swept_sphere){.core = OVOID_SWEPT_POINT, .radius = s.radius}, s.pose);
}

static PyObject *capsule(PyObject *type, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"radius", "half_length", "pose", NULL};
    module_state *state = state_of_type(type);
    swept_sizes s = {.pose = NULL};
    if (!arguments_read(arguments, keywords, "dd|O:capsule", names, &s.radius, &s.half_length, &s.pose) ||
        length_validate(state, "radius", s.radius, 0) || lengths_validate(state, "half_length", &s.half_length, 1))
        return NULL;
    ovoid_swept_sphere of = {.core = OVOID_SWEPT_SEGMENT, .radius = s.radius, .half = {s.half_length}};
    return swept_wrap(state, &of, s.pose);
}

// A cylinder or a cone.
static PyObject *make_around(PyObject *type, PyObject *arguments, PyObject *keywords, ovoid_swept_core core) {
    static char *names[] = {"radius", "half_length", "pose", NULL};
    module_state *state = state_of_type(type);
    swept_sizes s = {.pose = NULL};
    const char *format = core == OVOID_SWEPT_CONE ? "dd|O:cone" : "dd|O:cylinder";
    if (!arguments_read(arguments, keywords, format, names, &s.radius, &s.half_length, &s.pose) ||
        lengths_validate(state, "radius", &s.radius, 1) || lengths_validate(state, "half_length", &s.half_length, 1))
        return NULL;
    return swept_wrap(state, &(ovoid_swept_sphere){.core = core, .half = {s.half_length, s.radius}}, s.pose);
}

static PyObject *cylinder(PyObject *type, PyObject *arguments, PyObject *keywords) {
    return make_around(type, arguments, keywords, OVOID_SWEPT_CYLINDER);
}
static PyObject *cone(PyObject *type, PyObject *arguments, PyObject *keywords) {
    return make_around(type, arguments, keywords, OVOID_SWEPT_CONE);
}

// A box or an ellipsoid, of three half lengths.
static PyObject *make_along(module_state *state, const swept_sizes *s, const char *what, ovoid_swept_core core) {
    ovoid_swept_sphere of = {.core = core, .radius = s->rounding};
    if (doubles_read(state, s->sizes, what, 1, (Py_ssize_t[]){3}, of.half) ||
        lengths_validate(state, what, of.half, 3) || length_validate(state, "rounding", s->rounding, 0))
        return NULL;
    return swept_wrap(state, &of, s->pose);
}

static PyObject *box(PyObject *type, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"half_sizes", "pose", "rounding", NULL};
    swept_sizes s = {.pose = NULL};
    if (!arguments_read(arguments, keywords, "O|O$d:box", names, &s.sizes, &s.pose, &s.rounding)) return NULL;
    return make_along(state_of_type(type), &s, "half_sizes", OVOID_SWEPT_BOX);
}

static PyObject *ellipsoid(PyObject *type, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"half_axes", "pose", NULL};
    swept_sizes s = {.pose = NULL};
    if (!arguments_read(arguments, keywords, "O|O:ellipsoid", names, &s.sizes, &s.pose)) return NULL;
    return make_along(state_of_type(type), &s, "half_axes", OVOID_SWEPT_ELLIPSOID);
}

// The mean of the six points that are extreme along the axes: a point of the hull, whatever the number of points.
static void find_middle(const double *points, size_t count, double *middle) {
    size_t least[3] = {0, 0, 0}, most[3] = {0, 0, 0};
    for (size_t i = 1; i < count; i++)
        for (size_t k = 0; k < 3; k++) {
            if (points[3 * i + k] < points[3 * least[k] + k]) least[k] = i;
            if (points[3 * i + k] > points[3 * most[k] + k]) most[k] = i;
        }
    for (size_t k = 0; k < 3; k++) {
        double sum = 0;
        for (size_t j = 0; j < 3; j++) sum += points[3 * least[j] + k] / 6 + points[3 * most[j] + k] / 6;
        middle[k] = sum;
    }
}

static int points_validate(module_state *state, const items *points, double rounding) {
    if (length_validate(state, "rounding", rounding, 0)) return -1;
    Py_ssize_t count = points->shape[0];
    if (count < 1 || count > UINT32_MAX) {
        raise_code(state, count ? OVOID_ERROR_LIMIT : OVOID_ERROR_EMPTY, -1,
                   "points: 1 to 2^32 - 1 are wanted, not %zd", count);
        return -1;
    }
    const double *at = points->data;
    for (Py_ssize_t i = 0; i < 3 * count; i++)
        if (!(fabs(at[i]) <= OVOID_LENGTH_MAX)) {
            raise_code(state, isfinite(at[i]) ? OVOID_ERROR_RANGE : OVOID_ERROR_NOT_FINITE, i / 3,
                       "point %zd: numbers within 1e50 are wanted", i / 3);
            return -1;
        }
    return 0;
}

static PyObject *from_points(PyObject *type, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"points", "pose", "rounding", NULL};
    module_state *state = state_of_type(type);
    swept_sizes s = {.pose = NULL};
    items points;
    if (!arguments_read(arguments, keywords, "O|O$d:from_points", names, &s.sizes, &s.pose, &s.rounding) ||
        items_read(state, s.sizes, "points", 2, (Py_ssize_t[]){-1, 3}, 'd', &points))
        return NULL;
    if (points_validate(state, &points, s.rounding)) {
        free(points.data);
        return NULL;
    }
    ovoid_swept_sphere of = {.core = OVOID_SWEPT_POINTS, .radius = s.rounding, .points = points.data};
    of.count = (uint32_t)points.shape[0];
    find_middle(of.points, of.count, of.half);
    return swept_wrap(state, &of, s.pose);
}

// ---- queries

// The points and the normal as tuples; three times None where none were written.
static PyObject *witness_make(const ovoid_witness *w) {
    if (isnan(w->normal.x)) return Py_BuildValue("OOO", Py_None, Py_None, Py_None);
    return Py_BuildValue("NNN", vec3_make(w->point_a), vec3_make(w->point_b), vec3_make(w->normal));
}

static PyObject *answer_make_of(module_state *state, const ovoid_verdict *v, const ovoid_witness *w) {
    PyObject *witness = witness_make(w);
    if (!witness) return NULL;
    PyObject *made = PyObject_CallFunction(
        state->swept_answer, "NddNNIOOO", enum_get(state, ENUM_STATUS, v->status), v->lower, v->upper,
        enum_get(state, ENUM_STAGE, v->stage), enum_get(state, ENUM_LIMIT, v->limit), v->iterations,
        PyTuple_GetItem(witness, 0), PyTuple_GetItem(witness, 1), PyTuple_GetItem(witness, 2));
    Py_DECREF(witness);
    return made;
}

static ovoid_verdict find_sign(ovoid_swept_pair pair, ovoid_witness *witness) {
    (void)witness;
    return ovoid_swept_collide(pair);
}

static PyObject *ask(PyObject *self, PyObject *other, ovoid_verdict (*find)(ovoid_swept_pair, ovoid_witness *)) {
    module_state *state = state_of(self);
    if (Py_TYPE(other) != state->swept_sphere)
        return PyErr_Format(PyExc_TypeError, "other: a SweptSphere is wanted, not %R", (PyObject *)Py_TYPE(other));
    ovoid_swept_pair pair = {&((swept_object *)self)->of, &((swept_object *)other)->of};
    ovoid_witness witness = {.normal = {NAN, NAN, NAN}};
    ovoid_verdict found = find(pair, &witness);
    return answer_make_of(state, &found, &witness);
}

static PyObject *collide(PyObject *self, PyObject *other) { return ask(self, other, find_sign); }
static PyObject *distance(PyObject *self, PyObject *other) { return ask(self, other, ovoid_swept_distance); }
static PyObject *depth(PyObject *self, PyObject *other) { return ask(self, other, ovoid_swept_depth); }
static PyObject *contact_depth(PyObject *self, PyObject *other) { return ask(self, other, ovoid_swept_contact); }

// ---- what it is

static PyObject *get_kind(PyObject *self, void *closure) {
    (void)closure;
    return PyUnicode_FromString(kinds[((swept_object *)self)->of.core]);
}

static PyObject *get_sizes(PyObject *self, void *closure) {
    (void)closure;
    const ovoid_swept_sphere *of = &((swept_object *)self)->of;
    switch (of->core) {
    case OVOID_SWEPT_POINT: return Py_BuildValue("(d)", of->radius);
    case OVOID_SWEPT_SEGMENT: return Py_BuildValue("(dd)", of->radius, of->half[0]);
    case OVOID_SWEPT_CYLINDER:
    case OVOID_SWEPT_CONE: return Py_BuildValue("(dd)", of->half[1], of->half[0]);
    case OVOID_SWEPT_POINTS:
        return array_copy(state_of(self), RECORD_DOUBLE, 2, (Py_ssize_t[]){(Py_ssize_t)of->count, 3}, of->points);
    default: return Py_BuildValue("(ddd)", of->half[0], of->half[1], of->half[2]);
    }
}

static PyObject *get_rounding(PyObject *self, void *closure) {
    (void)closure;
    const ovoid_swept_sphere *of = &((swept_object *)self)->of;
    int is_given = of->core == OVOID_SWEPT_BOX || of->core == OVOID_SWEPT_POINTS;
    return PyFloat_FromDouble(is_given ? of->radius : 0);
}

static void swept_dealloc(PyObject *object) {
    free((void *)((swept_object *)object)->of.points);
    object_free(object);
}

static PyGetSetDef fields[] = {
    FIELD(swept_object, POSE, "pose", pose, "Its Pose, world frame."),
    {"kind", get_kind, NULL, "str: The name of its constructor.", NULL},
    {"sizes", get_sizes, NULL,
     "Numbers: What its constructor was given: a tuple of the radius, of radius and half length, or of three half "
     "lengths; of\na hull the points (n, 3).",
     NULL},
    {"rounding", get_rounding, NULL, "float: The rounding of a box or a hull; 0 of others.", NULL},
    {NULL, NULL, NULL, NULL, NULL}};

#define SWEPT_POSE "\n\npose: the body's frame in the world; None, a position, or any other form of a pose."
#define CONSTRUCTOR(name, signature, doc)                                                                              \
    {                                                                                                                  \
#name, METHOD_KEYWORDS(name), METH_VARARGS | METH_KEYWORDS | METH_CLASS,                                       \
            #name "(" signature ") -> SweptSphere\n--\n\n" doc SWEPT_POSE                                              \
    }
#define QUERY(name, doc)                                                                                               \
    { #name, name, METH_O, #name "(other: SweptSphere, /) -> SweptAnswer\n--\n\n" doc }

static PyMethodDef methods[] = {
    CONSTRUCTOR(sphere, "radius: float, pose: PoseLike = None", "A sphere of radius >= 0 around the pose's position."),
    CONSTRUCTOR(capsule, "radius: float, half_length: float, pose: PoseLike = None",
                "A capsule along the pose's z axis: a segment of length 2 half_length > 0 with a radius >= 0."),
    CONSTRUCTOR(cylinder, "radius: float, half_length: float, pose: PoseLike = None",
                "A cylinder around the pose's z axis, half_length to either side."),
    CONSTRUCTOR(cone, "radius: float, half_length: float, pose: PoseLike = None",
                "A cone around the pose's z axis, its apex at z = +half_length, its base at -half_length."),
    CONSTRUCTOR(box, "half_sizes: Numbers, pose: PoseLike = None, *, rounding: float = 0",
                "A box of half sizes (x, y, z) along the pose's axes, enlarged by a rounding >= 0."),
    CONSTRUCTOR(ellipsoid, "half_axes: Numbers, pose: PoseLike = None",
                "The ellipsoid with half axes (a, b, c) along the pose's axes."),
    CONSTRUCTOR(from_points, "points: Numbers, pose: PoseLike = None, *, rounding: float = 0",
                "The convex hull of points (n, 3), which are copied, enlarged by a rounding >= 0. No hull is made: a "
                "query reads all\npoints, of which there may be up to about a hundred."),
    QUERY(collide, "Do the bodies have a common point? No points and no normal are given."),
    QUERY(
        distance,
        "The distance of bodies that are apart, to a part in 1e12 of the sizes, or in 1e9 where it is searched; of an\n"
        "overlap the sign alone, with two points of a common part."),
    QUERY(depth,
          "The signed distance: of an overlap minus the depth, to a part in 1e12 of the sizes. Undecided of some "
          "that overlap,\nmost where many translations are as short."),
    QUERY(contact_depth, "depth(other), but of bodies that are apart the sign alone, without points and normal."),
    {NULL, NULL, 0, NULL}};

static PyType_Slot slots[] = {
    {Py_tp_doc,
     "A ball swept over a point, a segment, a cylinder, a box, a cone, an ellipsoid or the hull of points, at a pose: "
     "a body\nof numbers alone, to be asked about once or a few times. No Shape is made, and an answer has no proof. "
     "Where it is\nundecided, Shapes of the same sizes have an answer with its proof: collide, distance, depth of the "
     "module. Immutable."},
    {Py_tp_dealloc, swept_dealloc},
    {Py_tp_getset, fields},
    {Py_tp_methods, methods},
    {0, NULL}};
static PyType_Spec spec = {"ovoid.SweptSphere", sizeof(swept_object), 0,
                           Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION, slots};

int swept_add(PyObject *module) { return type_add(module, &spec, &state_of_module(module)->swept_sphere); }
