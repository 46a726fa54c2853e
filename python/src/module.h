// What the files of the extension share: the module's state, its types, and the doors between Python's objects and C's.
//
// The limited API of CPython 3.11, so one build serves every later version. NumPy is not needed to build: arrays come
// in through the buffer protocol and go out as `Array`, which NumPy, where it can be imported, is asked to wrap.
//
// Functions that return an object return NULL, and those that return int return -1, with an exception set.
#ifndef OVOID_PYTHON_MODULE_H
#define OVOID_PYTHON_MODULE_H

#define PY_SSIZE_T_CLEAN
#include <Python.h>

#include <ovoid/ovoid.h>

// Slots of types are functions behind void pointers, which ISO C does not know; POSIX and Python do.
#pragma GCC diagnostic ignored "-Wpedantic"

/// The enumerations of ovoid/enums.py, each a tuple of its members by their numbers.
typedef enum enum_kind {
    ENUM_STATUS,
    ENUM_STAGE,
    ENUM_LIMIT,
    ENUM_CODE,
    ENUM_PROOF_KIND,
    ENUM_IMPACT_STATUS,
    ENUM_ROBOT_STATUS,
    ENUM_ROBOT_TOUCH,
    ENUM_INSIDE,
    ENUM_AGREEMENT,
    ENUM_AXIS,
    ENUM_MANIFOLD_PROOF,
    ENUM_COUNT
} enum_kind;

/// What an array holds (array.c).
typedef enum record_kind {
    RECORD_DOUBLE,
    RECORD_UINT32,
    RECORD_UINT64,
    RECORD_VERDICT,
    RECORD_WITNESS,
    RECORD_PROOF,
    RECORD_CONTACT,
    RECORD_STEP,
    RECORD_STATE,      ///< ovoid_robot_answer
    RECORD_NEAR,       ///< ovoid_robot_near
    RECORD_ROBOT_STEP, ///< ovoid_robot_step
    RECORD_MANIFOLD,
    RECORD_MANIFOLD_POINT,
    RECORD_BODY_MANIFOLD,
    RECORD_WORLD_MANIFOLD,
    RECORD_PARTING, ///< ovoid_world_parting
    RECORD_COUNT
} record_kind;

/// What the module keeps: the types that hold C values, names as in Python, in lower case; then what is Python's own.
/// All before numpy_formats are references, one after the other.
typedef struct module_state {
    PyTypeObject *array, *shape, *pose, *compound, *answer, *bodies, *world, *motion, *impact, *approach, *ray_hit,
        *smooth, *smooth_value, *gradient, *fit, *prepared, *swept_sphere, *solid, *robot, *cell, *robot_path,
        *manifold;
    PyObject *error; ///< ovoid.Error
    /// Named tuples of ovoid/_values.py.
    PyObject *contacts, *hit, *cast, *joint, *variable, *element, *side, *state_answer, *matrix_pair, *sphere_audit,
        *obstacle, *motion_request, *clearance, *comparison, *parts_audit, *trajectory, *manifold_polygon,
        *world_manifolds, *material, *swept_answer;
    PyObject *enums[ENUM_COUNT]; ///< tuples
    PyObject *dtype_name;        ///< "dtype"
    PyObject *numpy_array;       ///< numpy.ndarray; None where it cannot be imported, NULL where not yet tried
    PyObject *numpy_types[RECORD_COUNT];
    char *numpy_formats[RECORD_COUNT]; ///< how NumPy writes the format of a record; NULL: not yet asked
} module_state;

/// The state, from an object of one of the types, from one of the types, or from the module.
module_state *state_of(PyObject *self);
module_state *state_of_type(PyObject *type);
module_state *state_of_module(PyObject *module);

// ---- errors.c

/// Raises ovoid.Error with the library's sentence (MemoryError for MEMORY); returns NULL.
void *raise_error(module_state *state, const ovoid_error *error);
/// What a call without a result returns: None, or NULL where its code is an error, which it raises.
PyObject *none_or_raise(module_state *state, ovoid_code code, const ovoid_error *error);
/// bool() of an answer: -1 with a TypeError that says what to ask.
int bool_refuse(PyObject *self);
/// Raises ovoid.Error with a sentence as of PyUnicode_FromFormat; returns NULL.
void *raise_code(module_state *state, ovoid_code code, Py_ssize_t place, const char *format, ...);
/// Member `value` of an enumeration, a new reference.
PyObject *enum_get(module_state *state, enum_kind kind, uint32_t value);

// ---- arguments.c

/// Reads arguments as PyArg_ParseTupleAndKeywords does; the format ends with a colon and the function's name. 1, or 0
/// with an exception, which for an unknown name says which one was probably meant.
int arguments_read(PyObject *arguments, PyObject *keywords, const char *format, char **names, ...);
/// Raises TypeError for an argument that is none of the names, of which the last is NULL; returns NULL.
void *argument_refuse(const char *function, PyObject *name, const char *const *names);

// ---- interrupt.c

/// A call of the library that runs without the interpreter's lock, and that a signal's handler may end.
typedef struct interrupt {
    PyThreadState *thread;
    double looked;         ///< seconds of the monotonic clock
    unsigned calls, every; ///< the clock is asked at every so many calls
    int is_raised;
    PyObject *progress; ///< called with the two numbers, about twenty times a second; NULL: none
    size_t done, total;
} interrupt;

/// Gives up the lock; the watch goes to the library's options.
ovoid_watch interrupt_begin(interrupt *i);
/// Takes the lock back; -1 where a handler raised: then the answer is one of a call that was ended.
int interrupt_end(interrupt *i);

/// Work on many items that goes by pieces, of some hundredths of a second, each a multiple of `least` but the last.
typedef struct pieces {
    size_t total, least;
    ovoid_code (*run)(void *context, size_t first, size_t count, ovoid_error *error); ///< without the lock
    void *context;
    PyObject *progress; ///< called with (done, total) after each; NULL or None: none
} pieces;
/// Runs them all, with a look for signals after each; -1: an exception.
int pieces_run(module_state *state, const pieces *p);
/// Lets signals' handlers run and calls progress(done, total) (NULL or None: none), under the interpreter's lock; -1
/// where one of them raised.
int look_around(PyObject *progress, size_t done, size_t total);
/// Refuses what is no function; -1 then.
int progress_validate(PyObject *progress);
/// The most threads of a batch; refuses another number than 1 to that, -1 then.
enum { THREADS_MOST = 256 };
int threads_validate(module_state *state, int threads);
/// Seconds of the monotonic clock.
double seconds_get(void);

// ---- buffers.c

/// An array that was read: its items are a copy, double or int64_t as asked.
typedef struct items {
    void *data;
    Py_ssize_t shape[3];
} items;

/// Reads numbers from a buffer of any strides, from what has `__array__`, or from nested sequences. what: how messages
/// name it. wanted: `axes` lengths, -1 where any will do. type: 'd' or 'q' (integers only). The caller frees to->data.
int items_read(module_state *state, PyObject *from, const char *what, int axes, const Py_ssize_t *wanted, char type,
               items *to);
/// The same into memory of the caller, of exactly that shape.
int doubles_read(module_state *state, PyObject *from, const char *what, int axes, const Py_ssize_t *wanted, void *to);
int vec3_read(module_state *state, PyObject *from, const char *what, ovoid_vec3 *to);
/// How many axes are meant of what may have one or two: 1 of a buffer of one axis or a sequence of numbers, else 2.
int array_axes(PyObject *from);
/// The axes of a buffer, or 0.
int buffer_axes(PyObject *from);
/// The kind of a buffer's items: 'd', 'f', 'i' (signed), 'u' (unsigned); 0: none that is read here.
char buffer_kind(const Py_buffer *view);
/// A view of an array of `count` records (-1: any number), contiguous, of that kind; writable where asked.
int records_view(module_state *state, PyObject *from, const char *what, record_kind kind, Py_ssize_t count,
                 int writable, Py_buffer *view);

// ---- array.c

/// A new zeroed array of `axes` lengths, at most 4; *data (may be NULL) receives its memory.
PyObject *array_make(module_state *state, record_kind kind, int axes, const Py_ssize_t *shape, void *data);
/// The array as NumPy's where there is NumPy, else itself. Takes over the reference; NULL is passed on.
PyObject *array_wrap(module_state *state, PyObject *array);
/// 1 if it is a NumPy array of the very type that this kind has: then its format, which NumPy writes anew at each call,
/// is known.
int array_is_own(module_state *state, PyObject *from, record_kind kind);
/// A wrapped copy of items.
PyObject *array_copy(module_state *state, record_kind kind, int axes, const Py_ssize_t *shape, const void *from);
/// How an array of that kind is written, and how NumPy writes it ("" where there is no NumPy); NULL: an exception.
const char *record_format(record_kind kind);
const char *record_numpy_format(module_state *state, record_kind kind);
Py_ssize_t record_size(record_kind kind);

// ---- fields.c

/// How a field of a C value is shown.
typedef enum field_kind {
    FIELD_DOUBLE,
    FIELD_UINT,
    FIELD_SIZE,
    FIELD_BOOL,
    FIELD_VEC3,
    FIELD_SYM3,
    FIELD_BOX,
    FIELD_PAIR,
    FIELD_POSE,
    FIELD_OBJECT, ///< of Python, never NULL
    FIELD_DOUBLES_12,
    FIELD_DOUBLES_12_12,
    FIELD_ENUM, ///< plus enum_kind
    FIELD_STATUS = FIELD_ENUM + ENUM_STATUS,
    FIELD_STAGE = FIELD_ENUM + ENUM_STAGE,
    FIELD_LIMIT = FIELD_ENUM + ENUM_LIMIT,
    FIELD_IMPACT_STATUS = FIELD_ENUM + ENUM_IMPACT_STATUS,
    FIELD_ROBOT_STATUS = FIELD_ENUM + ENUM_ROBOT_STATUS,
    FIELD_INSIDE = FIELD_ENUM + ENUM_INSIDE,
    FIELD_AXIS = FIELD_ENUM + ENUM_AXIS
} field_kind;
#define FIELD_TYPE_DOUBLE "float"
#define FIELD_TYPE_UINT "int"
#define FIELD_TYPE_SIZE "int"
#define FIELD_TYPE_BOOL "bool"
#define FIELD_TYPE_VEC3 "Vec3"
#define FIELD_TYPE_SYM3 "Floats"
#define FIELD_TYPE_BOX "Box"
#define FIELD_TYPE_PAIR "tuple[float, float]"
#define FIELD_TYPE_POSE "Pose"
#define FIELD_TYPE_DOUBLES_12 "Floats"
#define FIELD_TYPE_DOUBLES_12_12 "Floats"
#define FIELD_TYPE_STATUS "Status"
#define FIELD_TYPE_STAGE "Stage"
#define FIELD_TYPE_LIMIT "Limit"
#define FIELD_TYPE_IMPACT_STATUS "ImpactStatus"
#define FIELD_TYPE_ROBOT_STATUS "RobotStatus"
#define FIELD_TYPE_INSIDE "Inside"
#define FIELD_TYPE_AXIS "Axis"
enum { FIELD_FACTS_MOST = 512 };
typedef struct field {
    int kind;
    size_t offset;                          ///< in the object, or in its facts
    void (*load)(PyObject *self, void *to); ///< writes the facts, at most FIELD_FACTS_MOST bytes; NULL: there are none
} field;
/// The getter of all fields; closure: a field.
PyObject *field_get(PyObject *self, void *closure);
#define FIELD_BY(getter, object, kind, name, member, doc)                                                              \
    {                                                                                                                  \
        name, getter, NULL, doc, &(field) { FIELD_##kind, offsetof(object, member), NULL }                             \
    }
/// An attribute: the object that has it, how it is shown, its name, where it is, its words.
#define FIELD(object, kind, name, member, doc)                                                                         \
    FIELD_BY(field_get, object, kind, name, member, FIELD_TYPE_##kind ": " doc)
/// One of Python, of the type that is named.
#define FIELD_PYTHON(object, type, name, member, doc) FIELD_BY(field_get, object, OBJECT, name, member, type ": " doc)
/// One of the facts that load writes.
#define FIELD_FACT(load, facts, kind, name, member, doc)                                                               \
    {                                                                                                                  \
        name, field_get, NULL, FIELD_TYPE_##kind ": " doc, &(field) { FIELD_##kind, offsetof(facts, member), load }    \
    }
/// One that may be None, as its getter says.
#define FIELD_OPTIONAL(getter, object, kind, name, member, doc)                                                        \
    FIELD_BY(getter, object, kind, name, member, FIELD_TYPE_##kind " | None: " doc)

PyObject *vec3_make(ovoid_vec3 v);
PyObject *pair_make(double first, double second);
PyObject *box_make(ovoid_box box);
/// A tuple of count objects, each made by make(context, i).
PyObject *tuple_make(size_t count, PyObject *(*make)(const void *context, size_t i), const void *context);
PyObject *list_make(size_t count, PyObject *(*make)(const void *context, size_t i), const void *context);
/// A matrix of an ellipsoid as a (3, 3) array.
PyObject *sym3_make(module_state *state, const ovoid_sym3 *m);

// ---- the objects

typedef struct shape_object {
    PyObject_HEAD ovoid_shape *shape;
    PyObject *owner; ///< what the shape belongs to; NULL: this object
} shape_object;

typedef struct compound_object {
    PyObject_HEAD ovoid_compound *compound;
    PyObject *shapes; ///< a tuple: keeps them
} compound_object;

typedef struct pose_object {
    PyObject_HEAD ovoid_pose pose;
} pose_object;

/// A cover that is kept, in one block: a of all points, then b, then the triangles.
typedef struct kept_cover {
    uint32_t point_count, triangle_count;
    char data[];
} kept_cover;

/// A cover with memory for a query: as much as most need, and more once a search has filled its own.
typedef struct cover_room {
    ovoid_cover cover;
    void *large; ///< of malloc, or NULL
    uint64_t memory[OVOID_COVER_SIZE / sizeof(uint64_t)];
} cover_room;

/// The answer to a query, with what it takes to check it.
typedef struct answer_object {
    PyObject_HEAD ovoid_body_answer of;
    PyObject *a, *b; ///< shapes, compounds or solids
    ovoid_pose pose_a, pose_b;
    ovoid_options options;       ///< of the query
    kept_cover *cover;           ///< of a depth; NULL: none
    ovoid_exclusion *exclusions; ///< of compounds and solids
    size_t exclusion_count;
} answer_object;

/// A Shape, Compound or Solid at a pose; without any where it is none of them.
ovoid_body body_make(module_state *state, PyObject *from, ovoid_pose pose);
/// A Shape, Compound or Solid as a body, its pose to be set. what: how messages name the argument.
int body_read(module_state *state, PyObject *from, const char *what, ovoid_body *body);
/// A new Shape around a C shape, which it takes over; where that is NULL, raises the error.
PyObject *shape_wrap(module_state *state, ovoid_shape *shape, const ovoid_error *error);
/// An Ellipsoid.
PyObject *fit_wrap(module_state *state, const ovoid_fit *fit);
/// A new Shape around a C shape that belongs to `owner`, which it keeps.
PyObject *shape_borrow(module_state *state, const ovoid_shape *shape, PyObject *owner);

/// Anything that is a pose: None, Pose, a 4x4 array, (xyz, a rotation with as_quat).
int pose_read(module_state *state, PyObject *from, const char *what, ovoid_pose *pose);
PyObject *pose_wrap(module_state *state, ovoid_pose pose);
/// An array of poses: (n, 4, 4), (n, 7) in the order named ("wxyz" or "xyzw"; NULL: none was), or a sequence of poses.
/// The caller frees *poses.
int poses_read(module_state *state, PyObject *from, const char *order, ovoid_pose **poses, Py_ssize_t *count);

/// The options that every query takes, as arguments of arguments_read.
typedef struct query_keywords {
    ovoid_options options;
    unsigned long long iterations;
} query_keywords;
#define QUERY_FORMAT "dddK"
#define QUERY_SIGNATURE                                                                                                \
    "absolute_tolerance: float = 0, relative_tolerance: float = 0, cap: float = 0, iterations: int = 0"
#define QUERY_NAMES "absolute_tolerance", "relative_tolerance", "cap", "iterations"
#define QUERY_TARGETS(k)                                                                                               \
    &(k).options.absolute_tolerance, &(k).options.relative_tolerance, &(k).options.cap, &(k).iterations
/// Checks them; options.iterations is filled.
int query_keywords_validate(module_state *state, query_keywords *k);

/// An id of Python's as the library's, as a converter of PyArg_ParseTuple.
int id_read(PyObject *from, void *to);

/// An empty answer of two bodies at their poses.
answer_object *answer_make(module_state *state, PyObject *a, PyObject *b, const ovoid_pose *pose_a,
                           const ovoid_pose *pose_b);
/// Keeps of a cover what is used of it, in the place of what was kept; NULL where it is empty.
int cover_keep(kept_cover **to, const ovoid_cover *cover);
/// Keeps a copy of exclusions that grow, and releases them; -1 with MemoryError where memory was or is out.
int answer_keep_exclusions(answer_object *to, ovoid_exclusions *exclusions);
void cover_room_make(cover_room *room);
/// 1 where the answer's limit says that a search had too little memory, and there is more of it now: ask again. It
/// needs no lock of Python's.
int cover_room_grow(cover_room *room, ovoid_limit limit);
/// cover_keep, and frees what the room holds.
int cover_room_keep(cover_room *room, kept_cover **to);
/// What was kept as the library reads it, where it is; NULL where there is none, and *to shows nothing.
const ovoid_cover *cover_unpack(const kept_cover *kept, ovoid_cover *to);
/// What is wrong with options that a query refuses.
#define QUERY_REFUSED "a margin, tolerance or cap is negative or NaN"
/// Raises where an answer was refused; -1 then. options: what is wrong with them, where it is they.
int limit_raise(module_state *state, ovoid_limit limit, const char *options);
/// Verifies an answer by its proof and the options of its query: OVOID_OK, or what ovoid_body_verify says.
ovoid_code answer_verify(const answer_object *self, ovoid_error *error);
/// Verifies an impact or an approach by its proof and the options of its query.
ovoid_code impact_verify(module_state *state, PyObject *object, ovoid_error *error);

// ---- what each file adds to the module

int array_add(PyObject *module);
int pose_add(PyObject *module);
int shape_add(PyObject *module);
int compound_add(PyObject *module);
int answer_add(PyObject *module);
int bodies_add(PyObject *module);
int world_add(PyObject *module);
int motion_add(PyObject *module);
int impact_add(PyObject *module);
int smooth_add(PyObject *module);
int prepared_add(PyObject *module);
int swept_add(PyObject *module);
int manifold_add(PyObject *module);
int solid_add(PyObject *module);
int robot_add(PyObject *module);
int cell_add(PyObject *module);
int robot_path_add(PyObject *module);

extern PyMethodDef query_methods[], batch_methods[], impact_methods[], smooth_methods[], array_methods[],
    bounds_methods[], shape_file_methods[], draw_methods[], decompose_methods[], state_methods[], manifold_methods[];
extern PyMethodDef shape_constructors[], world_queries[], world_manifold_methods[], solid_decompositions[];

/// Joins two tables of methods in `all`, which the type keeps, and enters it in the slots.
void slots_set_methods(PyType_Slot *slots, PyMethodDef *all, const PyMethodDef *first, const PyMethodDef *second);
// ---- docs.c

/// A docstring as Python has it, from one whose signature has types; NULL: an exception. It is never freed.
const char *doc_make(const char *doc);
/// Makes those of a table, in place.
int docs_make(PyMethodDef *methods);
/// Adds functions to the module, with their docstrings made.
int functions_add(PyObject *module, PyMethodDef *functions);

/// Makes a type of the module from its spec and adds it by its name, with its docstrings made.
int type_add(PyObject *module, PyType_Spec *spec, PyTypeObject **type);
/// A new object of a type without arguments, zeroed.
void *object_make(PyTypeObject *type);
/// Ends an object of a heap type.
void object_free(PyObject *self);

#define METHOD_KEYWORDS(function) ((PyCFunction)(void (*)(void))(function))

#endif
