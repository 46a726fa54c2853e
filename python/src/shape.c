// Shape: an immutable convex body; what it holds, and new shapes made of it. Its constructors are in shape_create.c.
#include "src/module.h"

#ifdef OVOID_PYTHON_IO
#include <ovoid/io.h>
#endif

#include <stdlib.h>
#include <string.h>

static const ovoid_shape *get(PyObject *self) { return ((shape_object *)self)->shape; }

// ---- arrays

static PyObject *get_vertices(PyObject *self, void *closure) {
    (void)closure;
    ovoid_polytope p = ovoid_shape_get_polytope(get(self));
    module_state *state = state_of(self);
    double *to;
    PyObject *array = array_make(state, RECORD_DOUBLE, 2, (Py_ssize_t[]){(Py_ssize_t)p.vertex_count, 3}, &to);
    for (size_t i = 0; array && i < p.vertex_count; i++) {
        to[3 * i] = p.origin.x + p.vertices[3 * i];
        to[3 * i + 1] = p.origin.y + p.vertices[3 * i + 1];
        to[3 * i + 2] = p.origin.z + p.vertices[3 * i + 2];
    }
    return array_wrap(state, array);
}

static PyObject *get_faces(PyObject *self, void *closure) {
    (void)closure;
    ovoid_polytope p = ovoid_shape_get_polytope(get(self));
    return array_copy(state_of(self), RECORD_UINT32, 2, (Py_ssize_t[]){(Py_ssize_t)p.triangle_count, 3}, p.triangles);
}

// ---- measures and ellipsoids

/// What is the same for every reader of a shape, in the user's local frame.
typedef struct shape_facts {
    double volume, area, radius;
    ovoid_vec3 centroid;
    ovoid_sym3 inertia;
    ovoid_box bounds;
    ovoid_allowance allowance;
    uint32_t rank;
} shape_facts;
_Static_assert(sizeof(shape_facts) <= FIELD_FACTS_MOST, "the facts of a shape");

static ovoid_vec3 move(ovoid_vec3 x, ovoid_vec3 by) { return (ovoid_vec3){x.x + by.x, x.y + by.y, x.z + by.z}; }

static void load_facts(PyObject *self, void *to) {
    ovoid_measures m = ovoid_shape_get_measures(get(self));
    ovoid_polytope p = ovoid_shape_get_polytope(get(self));
    *(shape_facts *)to = (shape_facts){.volume = m.volume,
                                       .area = m.area,
                                       .radius = ovoid_shape_get_radius(get(self)),
                                       .centroid = move(m.centroid, p.origin),
                                       .inertia = m.inertia,
                                       .bounds = {move(m.box.min, p.origin), move(m.box.max, p.origin)},
                                       .allowance = ovoid_shape_get_allowance(get(self)),
                                       .rank = p.rank};
}

typedef struct fit_object {
    PyObject_HEAD ovoid_fit fit;
} fit_object;

// The ellipsoid in the user's local frame.
PyObject *fit_wrap(module_state *state, const ovoid_fit *fit) {
    fit_object *made = object_make(state->fit);
    if (made) made->fit = *fit;
    return (PyObject *)made;
}

static PyObject *get_fit(PyObject *self, void *closure) {
    fit_object *made = object_make(state_of(self)->fit);
    if (!made) return NULL;
    made->fit = closure ? ovoid_shape_get_inner(get(self)) : ovoid_shape_get_outer(get(self));
    made->fit.ellipsoid.center = move(made->fit.ellipsoid.center, ovoid_shape_get_polytope(get(self)).origin);
    return (PyObject *)made;
}

static PyObject *get_radii(PyObject *self, void *closure) {
    (void)closure;
    return vec3_make(ovoid_ellipsoid_compute_radii(&((fit_object *)self)->fit.ellipsoid));
}

static PyGetSetDef fit_fields[] = {
    FIELD(fit_object, VEC3, "center", fit.ellipsoid.center, "The centre, local frame."),
    FIELD(fit_object, SYM3, "matrix", fit.ellipsoid.q, "Q, (3, 3): the x with (x - center)' Q^-1 (x - center) <= 1."),
    FIELD(fit_object, DOUBLE, "volume", fit.volume, "Its volume; area or length of a flat one."),
    FIELD(fit_object, DOUBLE, "gap", fit.gap, "The proven relative gap of the volume to the optimum."),
    {"radii", get_radii, NULL, "Vec3: The radii, in descending order.", NULL},
    {NULL, NULL, NULL, NULL, NULL}};
static PyType_Slot fit_slots[] = {{Py_tp_doc, "An ellipsoid around or inside a shape."},
                                  {Py_tp_dealloc, object_free},
                                  {Py_tp_getset, fit_fields},
                                  {0, NULL}};
static PyType_Spec fit_spec = {"ovoid.Ellipsoid", sizeof(fit_object), 0,
                               Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION, fit_slots};

static PyObject *get_allowance_axis(PyObject *self, void *closure) {
    (void)closure;
    ovoid_vec3 axis = ovoid_shape_get_allowance(get(self)).axis;
    if (!(fabs(axis.x) + fabs(axis.y) + fabs(axis.z) > 0)) Py_RETURN_NONE;
    return vec3_make(axis);
}

static PyObject *get_is_lean(PyObject *self, void *closure) {
    (void)closure;
    return PyBool_FromLong(ovoid_shape_is_lean(get(self)));
}

static PyObject *get_round(PyObject *self, void *closure) {
    (void)closure;
    ovoid_round round = ovoid_shape_get_round(get(self));
    if (round.kind == OVOID_ROUND_NONE) Py_RETURN_NONE;
    ovoid_vec3 half = round.half_axes;
    if (round.kind == OVOID_ROUND_ELLIPSOID) return Py_BuildValue("(sddd)", "ellipsoid", half.x, half.y, half.z);
    const char *kind = round.kind == OVOID_ROUND_CONE ? "cone" : "cylinder";
    return Py_BuildValue("(sdd)", kind, round.radius, round.half_length);
}

static PyObject *get_report(PyObject *self, void *closure) {
    (void)closure;
    ovoid_report r = ovoid_shape_get_report(get(self));
    return Py_BuildValue("{sKsKsKsKsKsKsI}", "points", r.points, "vertices", r.vertices, "duplicates", r.duplicates,
                         "interior", r.interior, "coplanar", r.coplanar, "faces", r.faces, "rank", r.rank);
}

// ---- bytes and files

static PyObject *to_bytes(PyObject *self, PyObject *ignored) {
    (void)ignored;
    size_t size = ovoid_shape_write(get(self), NULL, 0);
    PyObject *bytes = PyBytes_FromStringAndSize(NULL, (Py_ssize_t)size);
    if (bytes) ovoid_shape_write(get(self), PyBytes_AsString(bytes), size);
    return bytes;
}

static PyObject *reduce(PyObject *self, PyObject *ignored) {
    PyObject *bytes = to_bytes(self, ignored);
    PyObject *reader = bytes ? PyObject_GetAttrString((PyObject *)Py_TYPE(self), "from_bytes") : NULL;
    if (!reader) {
        Py_XDECREF(bytes);
        return NULL;
    }
    return Py_BuildValue("N(N)", reader, bytes);
}

#ifdef OVOID_PYTHON_IO
static PyObject *write_file(PyObject *self, PyObject *arguments) {
    PyObject *path = NULL;
    ovoid_error error;
    if (!PyArg_ParseTuple(arguments, "O&:write", PyUnicode_FSConverter, &path)) return NULL;
    ovoid_code code = ovoid_shape_write_file(get(self), PyBytes_AsString(path), &error);
    Py_DECREF(path);
    return none_or_raise(state_of(self), code, &error);
}
#endif

// ---- new shapes

static PyObject *divided(PyObject *self, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"normal", "offset", "rounding", NULL};
    PyObject *direction;
    ovoid_plane plane;
    ovoid_shape_options options = {0};
    ovoid_error error;
    module_state *state = state_of(self);
    if (!arguments_read(arguments, keywords, "Od|$d:divided", names, &direction, &plane.offset, &options.radius) ||
        vec3_read(state, direction, "normal", &plane.normal))
        return NULL;
    ovoid_shape_halves halves = ovoid_shape_create_divided(get(self), &plane, &options, &error);
    if (halves.code != OVOID_OK) return raise_error(state, &error);
    PyObject *below = halves.below ? shape_wrap(state, halves.below, &error) : Py_NewRef(Py_None);
    PyObject *above = halves.above ? shape_wrap(state, halves.above, &error) : Py_NewRef(Py_None);
    if (below && above) return Py_BuildValue("NN", below, above);
    Py_XDECREF(below);
    Py_XDECREF(above);
    return NULL;
}

static PyObject *deformed(PyObject *self, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"points", "rounding", NULL};
    PyObject *points;
    items given;
    ovoid_shape_options options = {0};
    ovoid_error error;
    module_state *state = state_of(self);
    Py_ssize_t count = (Py_ssize_t)ovoid_shape_get_polytope(get(self)).vertex_count;
    if (!arguments_read(arguments, keywords, "O|$d:deformed", names, &points, &options.radius) ||
        items_read(state, points, "points", 2, (Py_ssize_t[]){count, 3}, 'd', &given))
        return NULL;
    ovoid_shape *shape;
    Py_BEGIN_ALLOW_THREADS;
    shape = ovoid_shape_create_deformed(get(self), given.data, &options, &error);
    Py_END_ALLOW_THREADS;
    free(given.data);
    return shape_wrap(state, shape, &error);
}

static PyObject *copy(PyObject *self, PyObject *ignored) {
    (void)ignored;
    return Py_NewRef(self);
}

static PyObject *repr(PyObject *self) {
    ovoid_polytope p = ovoid_shape_get_polytope(get(self));
    PyObject *radius = PyFloat_FromDouble(ovoid_shape_get_radius(get(self)));
    PyObject *text = radius ? PyUnicode_FromFormat("<ovoid.Shape: %u vertices, %u faces, radius %S>", p.vertex_count,
                                                   p.triangle_count, radius)
                            : NULL;
    Py_XDECREF(radius);
    return text;
}

static void shape_dealloc(PyObject *self) {
    PyObject *owner = ((shape_object *)self)->owner;
    if (owner)
        Py_DECREF(owner);
    else
        ovoid_shape_destroy(((shape_object *)self)->shape);
    object_free(self);
}

static PyMethodDef methods[] = {
    {"to_bytes", to_bytes, METH_NOARGS,
     "to_bytes() -> bytes\n--\n\nThe bytes of an .ovoid file; pickle uses them too."},
#ifdef OVOID_PYTHON_IO
    {"write", write_file, METH_VARARGS,
     "write(path: PathLike, /) -> None\n--\n\nWrites an .ovoid file: all of it, or the path is as it was."},
#endif
    {"divided", METHOD_KEYWORDS(divided), METH_VARARGS | METH_KEYWORDS,
     "divided(normal: Numbers, offset: float, *, rounding: float = 0) -> tuple[Shape | None, Shape | None]\n--\n\nThe "
     "shape cut by the plane normal . x = offset (local frame): the part below and the part above; None where\nnothing "
     "is left."},
    {"deformed", METHOD_KEYWORDS(deformed), METH_VARARGS | METH_KEYWORDS,
     "deformed(points: Numbers, *, rounding: float = 0) -> Shape\n--\n\nThe shape with its vertices moved: one point "
     "(n, 3) for each of .vertices, in their order."},
    {"__reduce__", reduce, METH_NOARGS, NULL},
    {"__copy__", copy, METH_NOARGS, NULL},
    {"__deepcopy__", copy, METH_O, NULL},
    {NULL, NULL, 0, NULL}};

static PyGetSetDef fields[] = {
    {"vertices", get_vertices, NULL, "Floats: The extreme points, (n, 3), local frame.", NULL},
    {"faces", get_faces, NULL, "Indices: Triangles, (m, 3) indices of vertices, counter-clockwise from outside.", NULL},
    FIELD_FACT(load_facts, shape_facts, DOUBLE, "volume", volume,
               "Volume of the polyhedron, without the rounding radius."),
    FIELD_FACT(load_facts, shape_facts, DOUBLE, "area", area,
               "Surface of the polyhedron; of a flat polygon both sides."),
    FIELD_FACT(load_facts, shape_facts, VEC3, "centroid", centroid, "Centroid, local frame."),
    FIELD_FACT(load_facts, shape_facts, SYM3, "inertia", inertia,
               "Inertia tensor about the centroid, (3, 3), unit density."),
    FIELD_FACT(load_facts, shape_facts, BOX, "bounds", bounds,
               "The box of the vertices: ((x, y, z) of its least corner, of its greatest)."),
    {"outer", get_fit, NULL, "Ellipsoid: The smallest ellipsoid around the polyhedron.", NULL},
    {"inner", get_fit, NULL, "Ellipsoid: The largest ellipsoid inside the polyhedron.", ""},
    {"is_lean", get_is_lean, NULL, "bool: Was it made with inner='lean'?", NULL},
    FIELD_FACT(load_facts, shape_facts, DOUBLE, "radius", radius, "The rounding radius, part of the body."),
    FIELD_FACT(load_facts, shape_facts, PAIR, "allowance", allowance,
               "(outside, inside): what the true body may differ by."),
    {"allowance_axis", get_allowance_axis, NULL,
     "tuple[float, float, float] | None: The direction, of length 1, across which alone the true body stands out; "
     "None: it may in all directions.",
     NULL},
    {"round", get_round, NULL,
     "tuple[str, float, float] | tuple[str, float, float, float] | None: The true body, 'cylinder' or 'cone', its "
     "radius and half length, or 'ellipsoid' and its half axes; None: not known in closed form.",
     NULL},
    FIELD_FACT(load_facts, shape_facts, UINT, "rank", rank, "0 a point, 1 a segment, 2 flat, 3 solid."),
    {"report", get_report, NULL, "dict[str, int]: What the constructor did with the points given, a dict.", NULL},
    {NULL, NULL, NULL, NULL, NULL}};

/// Points alone do not say whether they may be other than corners, so no constructor guesses.
static PyObject *refuse_new(PyTypeObject *type, PyObject *arguments, PyObject *names) {
    (void)type, (void)arguments, (void)names;
    PyErr_SetString(PyExc_TypeError,
                    "ovoid.Shape is made by Shape.from_points, hull_of, from_faces, box, sphere, capsule, "
                    "cylinder, cone, ellipsoid, prism, pyramid, read or from_bytes");
    return NULL;
}

static PyType_Slot slots[] = {
    {Py_tp_new, refuse_new},
    {Py_tp_doc,
     "An immutable convex body, shared by any number of poses and threads.\n\nMade by Shape.from_points, hull_of, "
     "from_faces, box, sphere, capsule, cylinder, cone, ellipsoid, prism, pyramid,\nread and from_bytes. The unit of "
     "length is the caller's and the same everywhere."},
    {Py_tp_dealloc, shape_dealloc},
    {Py_tp_repr, repr},
    {Py_tp_methods, NULL},
    {Py_tp_getset, fields},
    {0, NULL}};
static PyType_Spec spec = {"ovoid.Shape", sizeof(shape_object), 0, Py_TPFLAGS_DEFAULT, slots};

int shape_add(PyObject *module) {
    static PyMethodDef all[40];
    slots_set_methods(slots, all, shape_constructors, methods);
    return type_add(module, &fit_spec, &state_of_module(module)->fit) ||
           type_add(module, &spec, &state_of_module(module)->shape);
}
