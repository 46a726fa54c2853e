// Solid: triangles, convex or not, in one body, made of arrays, of meshes and of files.
#include "src/query.h"

#ifdef OVOID_PYTHON_IO
#include <ovoid/io.h>
#endif

#include <stdlib.h>

static const ovoid_solid *get(PyObject *self) { return ((solid_object *)self)->solid; }

// ---- making

// Takes over the solid; where that is NULL, raises the error.
static PyObject *wrap(PyObject *type, ovoid_solid *solid, const ovoid_error *error) {
    if (!solid) return raise_error(state_of_type(type), error);
    solid_object *self = object_make((PyTypeObject *)type);
    if (self)
        self->solid = solid;
    else
        ovoid_solid_destroy(solid);
    return (PyObject *)self;
}

PyObject *solid_borrow(module_state *state, const ovoid_solid *solid, PyObject *owner) {
    solid_object *self = object_make(state->solid);
    if (!self) return NULL;
    self->solid = (ovoid_solid *)solid;
    self->owner = Py_NewRef(owner);
    return (PyObject *)self;
}

// The indices (m, 3) in 32 bits; one that no point has is told by its triangle. The caller frees them.
static uint32_t *read_triangles(module_state *state, PyObject *from, Py_ssize_t *count) {
    items given;
    if (items_read(state, from, "faces", 2, (Py_ssize_t[]){-1, 3}, 'q', &given)) return NULL;
    *count = given.shape[0];
    uint32_t *made = malloc((size_t)(3 * *count + 1) * sizeof *made);
    if (!made) PyErr_NoMemory();
    for (Py_ssize_t i = 0; made && i < 3 * *count; i++) {
        int64_t index = ((const int64_t *)given.data)[i];
        made[i] = (uint32_t)index;
        if (index >= 0 && index <= UINT32_MAX) continue;
        raise_code(state, OVOID_ERROR_INDEX, i / 3, "triangle %zd: there is no point %lld", i / 3, (long long)index);
        free(made);
        made = NULL;
    }
    free(given.data);
    return made;
}

static PyObject *make_from_arrays(PyObject *type, PyObject *vertices, PyObject *faces) {
    module_state *state = state_of_type(type);
    items points;
    Py_ssize_t count;
    ovoid_error error;
    if (items_read(state, vertices, "vertices", 2, (Py_ssize_t[]){-1, 3}, 'd', &points)) return NULL;
    uint32_t *triangles = read_triangles(state, faces, &count);
    if (!triangles) {
        free(points.data);
        return NULL;
    }
    ovoid_solid *solid;
    Py_BEGIN_ALLOW_THREADS;
    solid = ovoid_solid_create_from_triangles(
        &(ovoid_triangles){points.data, (size_t)points.shape[0], triangles, (size_t)count}, NULL, &error);
    Py_END_ALLOW_THREADS;
    free(points.data);
    free(triangles);
    return wrap(type, solid, &error);
}

static PyObject *from_triangles(PyObject *type, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"vertices", "faces", NULL};
    PyObject *vertices, *faces;
    if (!arguments_read(arguments, keywords, "OO:from_triangles", names, &vertices, &faces)) return NULL;
    return make_from_arrays(type, vertices, faces);
}

static PyObject *from_mesh(PyObject *type, PyObject *mesh) {
    PyObject *vertices = PyObject_GetAttrString(mesh, "vertices"), *made = NULL;
    PyObject *faces = vertices ? PyObject_GetAttrString(mesh, "faces") : NULL;
    if (faces) made = make_from_arrays(type, vertices, faces);
    Py_XDECREF(vertices);
    Py_XDECREF(faces);
    return made;
}

#ifdef OVOID_PYTHON_IO
static PyObject *read_solid(PyObject *type, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"path", "scale", "unit", NULL};
    PyObject *path = NULL;
    ovoid_read_options read = {.scale = 0};
    ovoid_error error;
    if (!arguments_read(arguments, keywords, "O&|dz:read", names, PyUnicode_FSConverter, &path, &read.scale,
                        &read.unit)) {
        Py_XDECREF(path);
        return NULL;
    }
    const char *name = PyBytes_AsString(path);
    ovoid_solid *solid;
    Py_BEGIN_ALLOW_THREADS;
    solid = ovoid_solid_read_file(name, &read, &error);
    Py_END_ALLOW_THREADS;
    Py_DECREF(path);
    return wrap(type, solid, &error);
}
#endif

static void solid_dealloc(PyObject *self) {
    solid_object *solid = (solid_object *)self;
    if (!solid->owner) ovoid_solid_destroy(solid->solid);
    Py_XDECREF(solid->owner);
    object_free(self);
}

// ---- what it is

static PyObject *get_vertices(PyObject *self, void *closure) {
    (void)closure;
    Py_ssize_t count = (Py_ssize_t)ovoid_solid_get_report(get(self)).points;
    return array_copy(state_of(self), RECORD_DOUBLE, 2, (Py_ssize_t[]){count, 3}, ovoid_solid_get_points(get(self)));
}

static PyObject *get_faces(PyObject *self, void *closure) {
    (void)closure;
    Py_ssize_t count = (Py_ssize_t)ovoid_solid_get_report(get(self)).triangles;
    uint32_t *to;
    PyObject *array = array_make(state_of(self), RECORD_UINT32, 2, (Py_ssize_t[]){count, 3}, &to);
    for (Py_ssize_t i = 0; array && i < count; i++) ovoid_solid_get_triangle(get(self), (size_t)i, to + 3 * i);
    return array_wrap(state_of(self), array);
}

static PyObject *get_order(PyObject *self, void *closure) {
    (void)closure;
    Py_ssize_t count = (Py_ssize_t)ovoid_solid_get_report(get(self)).triangles;
    return array_copy(state_of(self), RECORD_UINT32, 1, &count, ovoid_solid_get_order(get(self)));
}

static PyObject *get_kind(PyObject *self, void *closure) {
    (void)closure;
    return PyUnicode_FromString(ovoid_solid_get_report(get(self)).is_closed ? "solid" : "surface");
}

static void load_report(PyObject *self, void *to) { *(ovoid_solid_report *)to = ovoid_solid_get_report(get(self)); }
_Static_assert(sizeof(ovoid_solid_report) <= FIELD_FACTS_MOST, "the facts of a solid");

static PyObject *get_report(PyObject *self, void *closure) {
    (void)closure;
    ovoid_solid_report r = ovoid_solid_get_report(get(self));
    return Py_BuildValue("{sKsKsKsKsKsKsKsN}", "points", r.points, "triangles", r.triangles, "components", r.components,
                         "edges_unmatched", r.edges_unmatched, "edges_crowded", r.edges_crowded, "degenerate",
                         r.degenerate, "duplicates", r.duplicates, "is_flat", PyBool_FromLong(r.is_flat));
}

static PyObject *winding(PyObject *self, PyObject *given) {
    ovoid_vec3 point;
    int64_t times;
    if (vec3_read(state_of(self), given, "point", &point)) return NULL;
    if (!ovoid_solid_compute_winding(get(self), point, &times)) Py_RETURN_NONE;
    return PyLong_FromLongLong(times);
}

static PyObject *crossings(PyObject *self, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"most", NULL};
    unsigned long long most = UINT64_MAX;
    if (!arguments_read(arguments, keywords, "|K:crossings", names, &most)) return NULL;
    ovoid_solid_crossings found;
    Py_BEGIN_ALLOW_THREADS;
    found = ovoid_solid_compute_crossings(get(self), most);
    Py_END_ALLOW_THREADS;
    PyObject *pair = found.pairs ? Py_BuildValue("(II)", found.triangle_a, found.triangle_b) : Py_NewRef(Py_None);
    return Py_BuildValue("KNN", (unsigned long long)found.pairs, PyBool_FromLong(found.is_complete), pair);
}

// The hull of the triangles' points with the allowance for the difference of both; NULL: it is not what they enclose,
// and *error is as it was, or the error.
static ovoid_shape *create_match(const ovoid_triangles *t, ovoid_error *error) {
    ovoid_hull_match match;
    ovoid_shape *made = NULL, *hull = ovoid_shape_create_from_points(t->xyz, t->point_count, NULL, error);
    if (hull && !ovoid_triangles_compute_hull_match(t, hull, &match, error) && match.is_closed && match.is_hull)
        made = ovoid_shape_create_allowed(
            hull, &(ovoid_shape_options){.allowance = (ovoid_allowance){.inside = match.allowance}}, error);
    ovoid_shape_destroy(hull);
    return made;
}

static PyObject *match_hull(PyObject *self, PyObject *ignored) {
    (void)ignored;
    ovoid_solid_report r = ovoid_solid_get_report(get(self));
    uint32_t *indices = malloc((size_t)(3 * r.triangles + 1) * sizeof *indices);
    if (!indices) return PyErr_NoMemory();
    for (size_t i = 0; i < r.triangles; i++) ovoid_solid_get_triangle(get(self), i, indices + 3 * i);
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_triangles triangles = {ovoid_solid_get_points(get(self)), (size_t)r.points, indices, (size_t)r.triangles};
    ovoid_shape *shape;
    Py_BEGIN_ALLOW_THREADS;
    shape = create_match(&triangles, &error);
    Py_END_ALLOW_THREADS;
    free(indices);
    if (!shape && !error.code) Py_RETURN_NONE;
    return shape_wrap(state_of(self), shape, &error);
}

static PyObject *reduce(PyObject *self, PyObject *ignored) {
    (void)ignored;
    PyObject *helper = PyImport_ImportModule("ovoid._records");
    PyObject *made = helper ? PyObject_CallMethod(helper, "reduce_solid", "O", self) : NULL;
    Py_XDECREF(helper);
    return made;
}

static PyObject *copy(PyObject *self, PyObject *ignored) {
    (void)ignored;
    return Py_NewRef(self);
}

static PyObject *repr(PyObject *self) {
    ovoid_solid_report r = ovoid_solid_get_report(get(self));
    return PyUnicode_FromFormat("<ovoid.Solid: %llu triangles, %llu components, %s>", (unsigned long long)r.triangles,
                                (unsigned long long)r.components, r.is_closed ? "closed" : "open");
}

// ---- the type

static PyMethodDef methods[] = {
    {"from_triangles", METHOD_KEYWORDS(from_triangles), METH_VARARGS | METH_KEYWORDS | METH_CLASS,
     "from_triangles(vertices: Numbers, faces: Numbers) -> Solid\n--\n\nOf points (n, 3) and triangles (m, 3), indices "
     "of points, counter-clockwise from outside. Every triangle is kept,\nalso what has no area; equal points become "
     "one. Whether the surface is closed, and what else was found, is told by\n.report; how triangles face does not "
     "matter to queries."},
    {"from_mesh", from_mesh, METH_O | METH_CLASS,
     "from_mesh(mesh: HasFaces, /) -> Solid\n--\n\nOf anything with .vertices (n, 3) and .faces (m, 3), as a "
     "trimesh.Trimesh."},
#ifdef OVOID_PYTHON_IO
    {"read", METHOD_KEYWORDS(read_solid), METH_VARARGS | METH_KEYWORDS | METH_CLASS,
     "read(path: PathLike, scale: float = 1, unit: str | None = None) -> Solid\n--\n\nThe triangles of a mesh file "
     "(STL, OBJ, OFF, PLY, ...) as one solid; polygons are cut into triangles. Arguments as of\nShape.read."},
#endif
    {"winding", winding, METH_O,
     "winding(point: Numbers, /) -> int | None\n--\n\nHow often a closed solid winds around a point (x, y, z) of its "
     "frame, exactly: 0 outside, 1 inside, -1 inside one that\nis inside out. None where it is not closed, or the "
     "point is on its surface."},
    {"crossings", METHOD_KEYWORDS(crossings), METH_VARARGS | METH_KEYWORDS,
     "crossings(most: int = 18446744073709551615) -> tuple[int, bool, tuple[int, int] | None]\n--\n\nWhere the surface "
     "meets itself: (pairs, is_complete, pair), how many pairs of triangles have a point in common that is\nno corner "
     "or edge of both, by exact signs; False where the search ended at most of them; the first pair, or None."},
    {"match_hull", match_hull, METH_NOARGS,
     "match_hull() -> Shape | None\n--\n\nThe Shape that it is: the convex hull of its points where the triangles are "
     "closed and lie on it, exactly or so\nnearly that the shape's allowance holds the difference; else None. Exact "
     "signs decide."},
    {"__reduce__", reduce, METH_NOARGS, NULL},
    {"__copy__", copy, METH_NOARGS, NULL},
    {"__deepcopy__", copy, METH_O, NULL},
    {NULL, NULL, 0, NULL}};

static PyGetSetDef fields[] = {
    {"vertices", get_vertices, NULL, "Floats: The points that triangles use, (n, 3), its frame.", NULL},
    {"faces", get_faces, NULL, "Indices: The triangles as given, (m, 3) indices of vertices.", NULL},
    {"order", get_order, NULL, "Indices: The triangles in the order of the tree's leaves.", NULL},
    {"kind", get_kind, NULL,
     "Literal['solid', 'surface']: \"solid\" where the triangles are closed, else \"surface\", as results have it.",
     NULL},
    FIELD_FACT(load_report, ovoid_solid_report, BOOL, "is_closed", is_closed,
               "True: a solid with an inside; False: a surface, the triangles alone."),
    FIELD_FACT(load_report, ovoid_solid_report, DOUBLE, "volume", volume,
               "Below 0 where it is inside out; 0 where it is not closed. Rounded."),
    FIELD_FACT(load_report, ovoid_solid_report, DOUBLE, "area", area, "The area of all triangles, rounded."),
    FIELD_FACT(load_report, ovoid_solid_report, BOX, "bounds", box,
               "The box of the points: ((x, y, z) of its least corner, of its greatest)."),
    {"report", get_report, NULL,
     "dict[str, int]: What was found of the triangles, a dict: points, triangles, components, edges_unmatched (0: "
     "closed), "
     "edges_crowded\n(of more than two triangles), degenerate (without area), duplicates.",
     NULL},
    {NULL, NULL, NULL, NULL, NULL}};

static PyObject *refuse_new(PyTypeObject *type, PyObject *arguments, PyObject *names) {
    (void)type, (void)arguments, (void)names;
    PyErr_SetString(PyExc_TypeError, "ovoid.Solid is made by Solid.from_triangles, from_mesh or read");
    return NULL;
}

static PyType_Slot slots[] = {
    {Py_tp_new, refuse_new},
    {Py_tp_doc,
     "Triangles and what they enclose, convex or not: immutable, shared by any number of poses and threads.\n\nMade by "
     "Solid.from_triangles, from_mesh and read. Where the triangles are not closed the body is their surface alone."},
    {Py_tp_dealloc, solid_dealloc},
    {Py_tp_repr, repr},
    {Py_tp_methods, NULL},
    {Py_tp_getset, fields},
    {0, NULL}};
static PyType_Spec spec = {"ovoid.Solid", sizeof(solid_object), 0, Py_TPFLAGS_DEFAULT, slots};

int solid_add(PyObject *module) {
    static PyMethodDef all[16];
    slots_set_methods(slots, all, methods, solid_decompositions);
    return type_add(module, &spec, &state_of_module(module)->solid);
}
