// The constructors of Shape: from points, faces, sizes, files, bytes, and from other shapes.
//
// What they read of Python is copied first; the building itself runs without the interpreter's lock.
#include "src/module.h"
#include "src/query.h"

#ifdef OVOID_PYTHON_IO
#include <ovoid/io.h>
#endif

#include <stdlib.h>
#include <string.h>

// ---- the options of all shapes

typedef struct shape_keywords {
    double rounding, gap;
    ovoid_allowance allowance;
    const char *inner;
} shape_keywords;
#define SHAPE_FORMAT "$ddzO&"
#define SHAPE_NAMES "rounding", "gap", "inner", "allowance"
#define SHAPE_TARGETS(k) &(k).rounding, &(k).gap, &(k).inner, read_allowance, &(k).allowance
#define SHAPE_DOC                                                                                                      \
    "\n\nrounding: a radius >= 0 added around the hull. gap: the relative volume gap of the ellipsoids, 0 for 1e-6.\n" \
    "inner: 'maximum' or 'phases', which inner ellipsoid; 'lean': a lean shape, which is made in two thirds of the "   \
    "time and has\n"                                                                                                   \
    "slower queries, gap 0.1. allowance: (outside, inside), by how much the true body may stand out of the shape, "    \
    "and\nthe shape out of the true body; (outside, inside, (x, y, z)): it stands out across that axis alone."
#define SHAPE_SIGNATURE                                                                                                \
    "*, rounding: float = 0, gap: float = 0, inner: Literal['maximum', 'phases', 'lean'] = 'maximum', allowance: "     \
    "Allowance = "                                                                                                     \
    "(0, 0)"

// (outside, inside), or with an axis.
static int read_allowance(PyObject *from, void *to) {
    ovoid_allowance a = {0};
    PyObject *all = PySequence_Tuple(from);
    if (!all) return 0;
    int ok = PyArg_ParseTuple(all, "dd|(ddd);allowance: (outside, inside) or (outside, inside, (x, y, z)) is wanted",
                              &a.outside, &a.inside, &a.axis.x, &a.axis.y, &a.axis.z);
    Py_DECREF(all);
    if (ok) *(ovoid_allowance *)to = a;
    return ok;
}

static int make_options(module_state *state, const shape_keywords *k, ovoid_shape_options *options) {
    *options = (ovoid_shape_options){.radius = k->rounding, .gap = k->gap, .allowance = k->allowance};
    static const char *const names[] = {"maximum", "phases", "lean"};
    for (int i = 0; i < 3 && k->inner; i++) {
        options->inner = (ovoid_inner_method)i;
        if (!strcmp(k->inner, names[i])) return 0;
    }
    if (!k->inner) return 0;
    raise_code(state, OVOID_ERROR_ARGUMENT, -1, "inner: 'maximum', 'phases' or 'lean' is wanted, not '%s'", k->inner);
    return -1;
}

PyObject *shape_borrow(module_state *state, const ovoid_shape *shape, PyObject *owner) {
    shape_object *self = object_make(state->shape);
    if (!self) return NULL;
    self->shape = (ovoid_shape *)shape;
    self->owner = Py_NewRef(owner);
    return (PyObject *)self;
}

PyObject *shape_wrap(module_state *state, ovoid_shape *shape, const ovoid_error *error) {
    if (!shape) return raise_error(state, error);
    shape_object *self = object_make(state->shape);
    if (self)
        self->shape = shape;
    else
        ovoid_shape_destroy(shape);
    return (PyObject *)self;
}

// ---- from points and faces

static PyObject *make_from_points(module_state *state, PyObject *points, const shape_keywords *k) {
    ovoid_shape_options options;
    items given;
    ovoid_error error;
    if (make_options(state, k, &options) || items_read(state, points, "points", 2, (Py_ssize_t[]){-1, 3}, 'd', &given))
        return NULL;
    ovoid_shape *shape;
    Py_BEGIN_ALLOW_THREADS;
    shape = ovoid_shape_create_from_points(given.data, (size_t)given.shape[0], &options, &error);
    Py_END_ALLOW_THREADS;
    free(given.data);
    return shape_wrap(state, shape, &error);
}

static PyObject *from_points(PyObject *type, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"points", SHAPE_NAMES, NULL};
    PyObject *points;
    shape_keywords k = {0};
    if (!arguments_read(arguments, keywords, "O|" SHAPE_FORMAT ":from_points", names, &points, SHAPE_TARGETS(k)))
        return NULL;
    return make_from_points(state_of_type(type), points, &k);
}

static PyObject *hull_of(PyObject *type, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"mesh", SHAPE_NAMES, NULL};
    PyObject *mesh;
    shape_keywords k = {0};
    if (!arguments_read(arguments, keywords, "O|" SHAPE_FORMAT ":hull_of", names, &mesh, SHAPE_TARGETS(k))) return NULL;
    PyObject *points = PyObject_GetAttrString(mesh, "vertices");
    PyObject *made = points ? make_from_points(state_of_type(type), points, &k) : NULL;
    Py_XDECREF(points);
    return made;
}

// Faces as runs of indices: of an array (m, k), or of a sequence of sequences of any lengths.
typedef struct face_runs {
    uint32_t *indices, *counts;
    size_t face_count, index_count;
} face_runs;

static int append_face(module_state *state, const int64_t *face, size_t count, face_runs *to) {
    Py_ssize_t place = (Py_ssize_t)to->face_count;
    uint32_t *grown = realloc(to->indices, (to->index_count + count + 1) * sizeof *grown);
    if (!grown) {
        PyErr_NoMemory();
        return -1;
    }
    to->indices = grown;
    for (size_t i = 0; i < count; i++) {
        if (face[i] < 0 || face[i] > UINT32_MAX) {
            raise_code(state, OVOID_ERROR_INDEX, place, "face %zd: there is no vertex %lld", place, (long long)face[i]);
            return -1;
        }
        to->indices[to->index_count++] = (uint32_t)face[i];
    }
    to->counts[to->face_count++] = (uint32_t)count;
    return 0;
}

// Of a sequence, face by face.
static int read_face_list(module_state *state, PyObject *faces, face_runs *to) {
    PyObject *list = PySequence_Tuple(faces);
    if (!list) return -1;
    Py_ssize_t count = PyTuple_Size(list);
    to->counts = calloc((size_t)count + 1, sizeof *to->counts);
    int result = to->counts ? 0 : -1;
    if (result) PyErr_NoMemory();
    for (Py_ssize_t i = 0; !result && i < count; i++) {
        items face;
        result = items_read(state, PyTuple_GetItem(list, i), "faces", 1, (Py_ssize_t[]){-1}, 'q', &face);
        if (!result) result = append_face(state, face.data, (size_t)face.shape[0], to);
        free(face.data);
    }
    Py_DECREF(list);
    return result;
}

static int read_faces(module_state *state, PyObject *faces, face_runs *to) {
    *to = (face_runs){NULL, NULL, 0, 0};
    if (!PyObject_CheckBuffer(faces)) return read_face_list(state, faces, to);
    items given;
    if (items_read(state, faces, "faces", 2, (Py_ssize_t[]){-1, -1}, 'q', &given)) return -1;
    to->counts = calloc((size_t)given.shape[0] + 1, sizeof *to->counts);
    int result = to->counts ? 0 : -1;
    if (result) PyErr_NoMemory();
    for (Py_ssize_t i = 0; !result && i < given.shape[0]; i++)
        result = append_face(state, (const int64_t *)given.data + i * given.shape[1], (size_t)given.shape[1], to);
    free(given.data);
    return result;
}

static PyObject *from_faces(PyObject *type, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"vertices", "faces", SHAPE_NAMES, NULL};
    PyObject *points, *list;
    shape_keywords k = {0};
    ovoid_shape_options options;
    module_state *state = state_of_type(type);
    items given = {NULL, {0, 0, 0}};
    face_runs runs = {NULL, NULL, 0, 0};
    ovoid_shape *shape = NULL;
    ovoid_error error;
    if (!arguments_read(arguments, keywords, "OO|" SHAPE_FORMAT ":from_faces", names, &points, &list,
                        SHAPE_TARGETS(k)) ||
        make_options(state, &k, &options))
        return NULL;
    int is_read = !items_read(state, points, "vertices", 2, (Py_ssize_t[]){-1, 3}, 'd', &given) &&
                  !read_faces(state, list, &runs);
    if (is_read) {
        ovoid_faces faces = {given.data, (size_t)given.shape[0], runs.indices, runs.counts, runs.face_count};
        Py_BEGIN_ALLOW_THREADS;
        shape = ovoid_shape_create_from_faces(&faces, &options, &error);
        Py_END_ALLOW_THREADS;
    }
    free(given.data);
    free(runs.indices);
    free(runs.counts);
    return is_read ? shape_wrap(state, shape, &error) : NULL;
}

// ---- from sizes

static PyObject *box(PyObject *type, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"half_sizes", SHAPE_NAMES, NULL};
    PyObject *sizes;
    ovoid_vec3 half;
    shape_keywords k = {0};
    ovoid_shape_options options;
    ovoid_error error;
    module_state *state = state_of_type(type);
    if (!arguments_read(arguments, keywords, "O|" SHAPE_FORMAT ":box", names, &sizes, SHAPE_TARGETS(k)) ||
        make_options(state, &k, &options) || vec3_read(state, sizes, "half_sizes", &half))
        return NULL;
    return shape_wrap(state, ovoid_shape_create_box(half, &options, &error), &error);
}

static PyObject *ellipsoid(PyObject *type, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"half_axes", "tolerance", SHAPE_NAMES, NULL};
    PyObject *sizes;
    ovoid_vec3 half;
    double tolerance = 0;
    shape_keywords k = {0};
    ovoid_shape_options options;
    ovoid_error error;
    module_state *state = state_of_type(type);
    if (!arguments_read(arguments, keywords, "O|d" SHAPE_FORMAT ":ellipsoid", names, &sizes, &tolerance,
                        SHAPE_TARGETS(k)) ||
        make_options(state, &k, &options) || vec3_read(state, sizes, "half_axes", &half))
        return NULL;
    options.tolerance = tolerance;
    return shape_wrap(state, ovoid_shape_create_ellipsoid(half, &options, &error), &error);
}

/// What round bodies are made of; a constructor takes some of it.
typedef struct round_sizes {
    double radius, half_length, tolerance;
    long sides;
} round_sizes;

static int validate_sides(module_state *state, long sides) {
    if (sides >= 3 && sides <= 1 << 24) return 0;
    raise_code(state, OVOID_ERROR_ARGUMENT, -1, "sides: 3 to %d are wanted, not %ld", 1 << 24, sides);
    return -1;
}

/// The constructor of a round body: the kinds of its sizes (PyArg_ParseTupleAndKeywords), where in round_sizes s they
/// go, the call that makes it, and their names.
#define LISTED(...) __VA_ARGS__
#define ROUND(name, kinds, targets, create, ...)                                                                       \
    static PyObject *name(PyObject *type, PyObject *arguments, PyObject *keywords) {                                   \
        static char *names[] = {__VA_ARGS__, SHAPE_NAMES, NULL};                                                       \
        module_state *state = state_of_type(type);                                                                     \
        round_sizes s = {.sides = 3};                                                                                  \
        shape_keywords k = {0};                                                                                        \
        ovoid_shape_options options;                                                                                   \
        ovoid_error error;                                                                                             \
        if (!arguments_read(arguments, keywords, kinds SHAPE_FORMAT ":" #name, names, targets, SHAPE_TARGETS(k)) ||    \
            make_options(state, &k, &options) || validate_sides(state, s.sides))                                       \
            return NULL;                                                                                               \
        ovoid_shape *shape;                                                                                            \
        Py_BEGIN_ALLOW_THREADS;                                                                                        \
        shape = create;                                                                                                \
        Py_END_ALLOW_THREADS;                                                                                          \
        return shape_wrap(state, shape, &error);                                                                       \
    }

ROUND(sphere, "d|", &s.radius, ovoid_shape_create_sphere(s.radius, &options, &error), "radius")
ROUND(capsule, "dd|", LISTED(&s.radius, &s.half_length),
      ovoid_shape_create_capsule(s.radius, s.half_length, &options, &error), "radius", "half_length")
ROUND(cylinder, "dd|d", LISTED(&s.radius, &s.half_length, &s.tolerance),
      (options.tolerance = s.tolerance, ovoid_shape_create_cylinder(s.radius, s.half_length, &options, &error)),
      "radius", "half_length", "tolerance")
ROUND(cone, "dd|d", LISTED(&s.radius, &s.half_length, &s.tolerance),
      (options.tolerance = s.tolerance, ovoid_shape_create_cone(s.radius, s.half_length, &options, &error)), "radius",
      "half_length", "tolerance")
ROUND(prism, "ddl|", LISTED(&s.radius, &s.half_length, &s.sides),
      ovoid_shape_create_prism(&(ovoid_prism){s.radius, s.half_length, (uint32_t)s.sides}, &options, &error), "radius",
      "half_length", "sides")
ROUND(pyramid, "ddl|", LISTED(&s.radius, &s.half_length, &s.sides),
      ovoid_shape_create_pyramid(&(ovoid_prism){s.radius, s.half_length, (uint32_t)s.sides}, &options, &error),
      "radius", "half_length", "sides")

// ---- from bytes and files

static PyObject *from_bytes(PyObject *type, PyObject *bytes) {
    module_state *state = state_of_type(type);
    Py_buffer view;
    ovoid_error error;
    if (PyObject_GetBuffer(bytes, &view, PyBUF_SIMPLE)) return NULL;
    // The reader checks first and builds then; a copy cannot be changed in between.
    void *copy = malloc(view.len ? (size_t)view.len : 1);
    size_t size = (size_t)view.len;
    if (copy) memcpy(copy, view.buf, size);
    PyBuffer_Release(&view);
    if (!copy) return PyErr_NoMemory();
    ovoid_shape *shape;
    Py_BEGIN_ALLOW_THREADS;
    shape = ovoid_shape_read(copy, size, NULL, &error);
    Py_END_ALLOW_THREADS;
    free(copy);
    return shape_wrap(state, shape, &error);
}

#ifdef OVOID_PYTHON_IO
/// Which file is to be read, and how.
typedef struct file_keywords {
    PyObject *path; ///< owned once it is read
    ovoid_read_options read;
    ovoid_shape_options options;
} file_keywords;

// Reads the arguments of a function of a file; without `hull` where the hulls are what it makes.
static int read_file_keywords(module_state *state, PyObject *arguments, PyObject *keywords, const char *format,
                              file_keywords *f) {
    static char *names[] = {"path", "scale", "unit", SHAPE_NAMES, "hull", NULL};
    static char *parts_names[] = {"path", "scale", "unit", SHAPE_NAMES, NULL};
    shape_keywords k = {0};
    int has_hull = !f->read.parts;
    if (!arguments_read(arguments, keywords, format, has_hull ? names : parts_names, PyUnicode_FSConverter, &f->path,
                        &f->read.scale, &f->read.unit, SHAPE_TARGETS(k), &f->read.hull))
        return -1;
    if (!make_options(state, &k, &f->options)) return 0;
    Py_DECREF(f->path);
    return -1;
}

static PyObject *read_shape(PyObject *type, PyObject *arguments, PyObject *keywords) {
    file_keywords f = {.read = {.scale = 0}};
    ovoid_error error;
    module_state *state = state_of_type(type);
    if (read_file_keywords(state, arguments, keywords, "O&|dz" SHAPE_FORMAT "p:read", &f)) return NULL;
    ovoid_shape *shape;
    const char *name = PyBytes_AsString(f.path);
    Py_BEGIN_ALLOW_THREADS;
    shape = ovoid_shape_read_file(name, &f.read, &f.options, &error);
    Py_END_ALLOW_THREADS;
    Py_DECREF(f.path);
    return shape_wrap(state, shape, &error);
}

static void destroy_shapes(PyObject *owner) { ovoid_shapes_destroy(PyCapsule_GetPointer(owner, "shapes")); }

/// The shapes of a file, and the capsule that keeps them.
typedef struct kept_shapes {
    module_state *state;
    const ovoid_shapes *shapes;
    PyObject *owner;
} kept_shapes;

static PyObject *make_named(const void *context, size_t i) {
    const kept_shapes *k = context;
    ovoid_named_shape one = ovoid_shapes_get(k->shapes, i);
    return Py_BuildValue("NN", PyUnicode_DecodeFSDefault(one.name), shape_borrow(k->state, one.shape, k->owner));
}

// The shapes of the file in a capsule that owns them; NULL with an exception. Releases the path.
static PyObject *read_shapes(module_state *state, file_keywords *f) {
    ovoid_error error;
    ovoid_shapes *shapes;
    const char *name = PyBytes_AsString(f->path);
    Py_BEGIN_ALLOW_THREADS;
    shapes = ovoid_shapes_read_file(name, &f->read, &f->options, &error);
    Py_END_ALLOW_THREADS;
    Py_DECREF(f->path);
    if (!shapes) return raise_error(state, &error);
    PyObject *owner = PyCapsule_New(shapes, "shapes", destroy_shapes);
    if (!owner) ovoid_shapes_destroy(shapes);
    return owner;
}

static PyObject *read_parts(PyObject *module, PyObject *arguments, PyObject *keywords) {
    file_keywords f = {.read = {.parts = 1}};
    module_state *state = state_of_module(module);
    if (read_file_keywords(state, arguments, keywords, "O&|dz" SHAPE_FORMAT ":read_parts", &f)) return NULL;
    PyObject *owner = read_shapes(state, &f);
    if (!owner) return NULL;
    kept_shapes kept = {state, PyCapsule_GetPointer(owner, "shapes"), owner};
    PyObject *list = list_make(ovoid_shapes_get_count(kept.shapes), make_named, &kept);
    Py_DECREF(owner);
    return list;
}

// The body of a file: its triangles where they are not their hull, else the shape. Borrowed from the owner.
static PyObject *make_body(module_state *state, ovoid_named_shape one, const ovoid_shape_options *o, PyObject *owner) {
    if (!one.solid) return shape_borrow(state, one.shape, owner);
    if (o->radius == 0 && o->allowance.outside == 0 && o->allowance.inside == 0)
        return solid_borrow(state, one.solid, owner);
    PyErr_Format(PyExc_ValueError,
                 "%s: the mesh is not its hull: a Solid has no rounding and no allowance; hull=True takes the hull",
                 one.name);
    return NULL;
}

static PyObject *read_body(PyObject *module, PyObject *arguments, PyObject *keywords) {
    file_keywords f = {.read = {.scale = 0}};
    module_state *state = state_of_module(module);
    if (read_file_keywords(state, arguments, keywords, "O&|dz" SHAPE_FORMAT "p:read", &f)) return NULL;
    PyObject *owner = read_shapes(state, &f), *body = NULL;
    if (owner) body = make_body(state, ovoid_shapes_get(PyCapsule_GetPointer(owner, "shapes"), 0), &f.options, owner);
    Py_XDECREF(owner);
    return body;
}

PyMethodDef shape_file_methods[] = {
    {"read", METHOD_KEYWORDS(read_body), METH_VARARGS | METH_KEYWORDS,
     "read(path: PathLike, scale: float = 1, unit: str | None = None, " SHAPE_SIGNATURE
     ", hull: bool = False) -> Shape | Solid\n--\n\nThe body that a file holds: a Shape of an .ovoid file and of a "
     "mesh that is its convex hull, or nearly so (then with\nan allowance for the difference); a Solid of any other "
     "mesh, a surface where that is open. hull=True: the hull of any\nmesh. scale: of the file's numbers; unit: of the "
     "result, 'm' or 'mm' for example, where the file says its own. A Solid\nhas no rounding and no "
     "allowance." SHAPE_DOC},
    {"read_parts", METHOD_KEYWORDS(read_parts), METH_VARARGS | METH_KEYWORDS,
     "read_parts(path: PathLike, scale: float = 1, unit: str | None = None, " SHAPE_SIGNATURE
     ") -> list[tuple[str, Shape]]\n--\n\nThe objects of a mesh file, each as its convex hull: a list of (name, "
     "Shape), each where the file has it; Compound([shape\nfor name, shape in ...]) is the body of them all. Arguments "
     "as of Shape.read." SHAPE_DOC},
    {NULL, NULL, 0, NULL}};
#endif

PyMethodDef shape_constructors[] = {
    {"from_points", METHOD_KEYWORDS(from_points), METH_VARARGS | METH_KEYWORDS | METH_CLASS,
     "from_points(points: Numbers, " SHAPE_SIGNATURE
     ") -> Shape\n--\n\nThe convex hull of points (n, 3), in any unit of length." SHAPE_DOC},
    {"hull_of", METHOD_KEYWORDS(hull_of), METH_VARARGS | METH_KEYWORDS | METH_CLASS,
     "hull_of(mesh: HasVertices, " SHAPE_SIGNATURE
     ") -> Shape\n--\n\nThe convex hull of anything with .vertices (n, 3), as a trimesh.Trimesh." SHAPE_DOC},
    {"from_faces", METHOD_KEYWORDS(from_faces), METH_VARARGS | METH_KEYWORDS | METH_CLASS,
     "from_faces(vertices: Numbers, faces: Numbers, " SHAPE_SIGNATURE
     ") -> Shape\n--\n\nFrom vertices (n, 3) and faces that claim to be convex, counter-clockwise from outside: an "
     "array (m, k) of\nindices or a sequence of sequences. Checked, never trusted." SHAPE_DOC},
    {"box", METHOD_KEYWORDS(box), METH_VARARGS | METH_KEYWORDS | METH_CLASS,
     "box(half_sizes: Numbers, " SHAPE_SIGNATURE
     ") -> Shape\n--\n\nAn axis-aligned box around the origin, of the given half sizes (x, y, z)." SHAPE_DOC},
    {"sphere", METHOD_KEYWORDS(sphere), METH_VARARGS | METH_KEYWORDS | METH_CLASS,
     "sphere(radius: float, " SHAPE_SIGNATURE ") -> Shape\n--\n\nA sphere around the origin; exact." SHAPE_DOC},
    {"capsule", METHOD_KEYWORDS(capsule), METH_VARARGS | METH_KEYWORDS | METH_CLASS,
     "capsule(radius: float, half_length: float, " SHAPE_SIGNATURE
     ") -> Shape\n--\n\nA capsule along z: a segment of length 2 half_length with a radius; exact." SHAPE_DOC},
    {"cylinder", METHOD_KEYWORDS(cylinder), METH_VARARGS | METH_KEYWORDS | METH_CLASS,
     "cylinder(radius: float, half_length: float, tolerance: float = 0, " SHAPE_SIGNATURE
     ") -> Shape\n--\n\nThe cylinder along z, held by a prism with an allowance of at most the tolerance, a length; 0: "
     "radius / 200." SHAPE_DOC},
    {"cone", METHOD_KEYWORDS(cone), METH_VARARGS | METH_KEYWORDS | METH_CLASS,
     "cone(radius: float, half_length: float, tolerance: float = 0, " SHAPE_SIGNATURE
     ") -> Shape\n--\n\nThe cone, apex at z = +half_length; as cylinder." SHAPE_DOC},
    {"ellipsoid", METHOD_KEYWORDS(ellipsoid), METH_VARARGS | METH_KEYWORDS | METH_CLASS,
     "ellipsoid(half_axes: Numbers, tolerance: float = 0, " SHAPE_SIGNATURE
     ") -> Shape\n--\n\nThe ellipsoid around the origin with half axes (a, b, c), held by a polyhedron with an "
     "allowance of at most the\ntolerance, a length; 0: a 13th of the largest." SHAPE_DOC},
    {"prism", METHOD_KEYWORDS(prism), METH_VARARGS | METH_KEYWORDS | METH_CLASS,
     "prism(radius: float, half_length: float, sides: int, " SHAPE_SIGNATURE
     ") -> Shape\n--\n\nA prism along z, inscribed in the cylinder." SHAPE_DOC},
    {"pyramid", METHOD_KEYWORDS(pyramid), METH_VARARGS | METH_KEYWORDS | METH_CLASS,
     "pyramid(radius: float, half_length: float, sides: int, " SHAPE_SIGNATURE
     ") -> Shape\n--\n\nA pyramid along z, apex at z = +half_length." SHAPE_DOC},
    {"from_bytes", from_bytes, METH_O | METH_CLASS,
     "from_bytes(data: Any, /) -> Shape\n--\n\nA shape from the bytes of an .ovoid file, each of them checked; bit for "
     "bit the one that was written."},
#ifdef OVOID_PYTHON_IO
    {"read", METHOD_KEYWORDS(read_shape), METH_VARARGS | METH_KEYWORDS | METH_CLASS,
     "read(path: PathLike, scale: float = 1, unit: str | None = None, " SHAPE_SIGNATURE
     ", hull: bool = False) -> Shape\n--\n\nA shape from an .ovoid file, or from a mesh file (STL, OBJ, OFF, PLY, ...) "
     "whose mesh is its convex hull, or nearly\nso: then the shape has an allowance for the difference. Any other "
     "mesh, closed and not convex or open, is refused:\nSolid.read takes it as it is, hull=True takes its "
     "hull." SHAPE_DOC},
#endif
    {NULL, NULL, 0, NULL}};
