// Robots, scenes of obstacles and planning problems from files. Notes of the readers become warnings.
#ifdef OVOID_PYTHON_ROBOT_READ
#include "src/query.h"
#include "src/robot/robot.h"

#include <ovoid/robot_io.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

// ---- notes: gathered while a file is read, without the interpreter's lock

typedef struct notes {
    char **texts;
    size_t count, capacity;
} notes;

static void gather(void *context, const ovoid_robot_note *note) {
    notes *n = context;
    if (n->count == n->capacity) {
        size_t capacity = 2 * n->capacity + 8;
        char **grown = realloc(n->texts, capacity * sizeof *grown);
        if (!grown) return;
        n->texts = grown;
        n->capacity = capacity;
    }
    size_t size = strlen(note->path) + strlen(note->text) + 32;
    char *text = malloc(size);
    if (!text) return;
    if (note->line)
        PyOS_snprintf(text, size, "%s:%lld: %s", note->path, (long long)note->line, note->text);
    else
        PyOS_snprintf(text, size, "%s: %s", note->path, note->text);
    n->texts[n->count++] = text;
}

// Tells them as warnings; -1 where one is made an exception.
static int tell(notes *n) {
    int failed = 0;
    for (size_t i = 0; i < n->count; i++) {
        PyObject *text = PyUnicode_DecodeUTF8(n->texts[i], (Py_ssize_t)strlen(n->texts[i]), "replace");
        PyObject *plain = text ? PyUnicode_AsUTF8String(text) : NULL;
        if (!failed) failed = !plain || PyErr_WarnEx(PyExc_UserWarning, PyBytes_AsString(plain), 1);
        Py_XDECREF(plain);
        Py_XDECREF(text);
        free(n->texts[i]);
    }
    free(n->texts);
    return failed ? -1 : 0;
}

// ---- options

typedef struct read_input {
    PyObject *urdf, *srdf;      ///< bytes
    PyObject *packages, *names; ///< a dict, and a list of what the packages' texts belong to
    ovoid_robot_package *list;
    PyObject *scales; ///< a dict of factors by the links' names; None: of all others
    ovoid_robot_link_scale *factors;
    ovoid_robot_read_options o;
    notes notes;
} read_input;

static void free_input(read_input *in) {
    Py_XDECREF(in->urdf);
    Py_XDECREF(in->srdf);
    Py_XDECREF(in->names);
    free(in->list);
    free(in->factors);
}

// The bytes of a path or a name, which the list keeps.
static const char *keep_path(PyObject *names, PyObject *from) {
    PyObject *bytes = NULL;
    if (!PyUnicode_FSConverter(from, &bytes)) return NULL;
    int failed = PyList_Append(names, bytes);
    const char *text = failed ? NULL : PyBytes_AsString(bytes);
    Py_DECREF(bytes);
    return text;
}

static int read_packages(read_input *in) {
    in->names = PyList_New(0);
    if (!in->names) return -1;
    if (!in->packages || in->packages == Py_None) return 0;
    if (!PyDict_Check(in->packages)) {
        PyErr_SetString(PyExc_TypeError, "packages: a dict of folders by the packages' names is wanted");
        return -1;
    }
    in->list = calloc((size_t)PyDict_Size(in->packages) + 1, sizeof *in->list);
    if (!in->list) {
        PyErr_NoMemory();
        return -1;
    }
    PyObject *pairs = PyDict_Items(in->packages);
    Py_ssize_t count = pairs ? PyList_Size(pairs) : -1;
    for (Py_ssize_t i = 0; i < count; i++) {
        PyObject *pair = PyList_GetItem(pairs, i);
        ovoid_robot_package *to = &in->list[i];
        to->name = keep_path(in->names, PyTuple_GetItem(pair, 0));
        to->folder = to->name ? keep_path(in->names, PyTuple_GetItem(pair, 1)) : NULL;
        if (!to->folder) count = -1;
    }
    Py_XDECREF(pairs);
    if (count < 0) return -1;
    in->o.packages = in->list;
    in->o.package_count = (size_t)count;
    return 0;
}

static int read_scales(read_input *in) {
    if (!in->scales || in->scales == Py_None) return 0;
    if (!PyDict_Check(in->scales)) {
        PyErr_SetString(PyExc_TypeError, "scales: a dict of factors by the links' names is wanted; None: all others");
        return -1;
    }
    in->factors = calloc((size_t)PyDict_Size(in->scales) + 1, sizeof *in->factors);
    if (!in->factors) {
        PyErr_NoMemory();
        return -1;
    }
    PyObject *key, *value;
    Py_ssize_t at = 0;
    while (PyDict_Next(in->scales, &at, &key, &value)) {
        ovoid_robot_link_scale *to = &in->factors[in->o.scale_count];
        to->link = key == Py_None ? NULL : keep_path(in->names, key);
        to->factor = PyFloat_AsDouble(value);
        if ((key != Py_None && !to->link) || PyErr_Occurred()) return -1;
        if (!(to->factor > 0 && to->factor < INFINITY)) {
            PyErr_SetString(PyExc_ValueError, "scales: a factor is a number above 0");
            return -1;
        }
        in->o.scale_count++;
    }
    in->o.scales = in->factors;
    return 0;
}

// ---- what a file says beside the description

/// A file, and of which of its parts.
typedef struct file_part {
    const ovoid_robot_file *file;
    ovoid_robot_description d;
    const uint32_t *indices; ///< of joints or links
} file_part;

static PyObject *make_joint_name(const void *context, size_t i) {
    const file_part *p = context;
    return PyUnicode_FromString(p->d.joints[p->indices[i]].name);
}

static PyObject *make_link_name(const void *context, size_t i) {
    const file_part *p = context;
    return PyUnicode_FromString(p->d.links[p->indices[i]].name);
}

static PyObject *make_group(const void *context, size_t i) {
    const file_part *p = context;
    ovoid_robot_group g = ovoid_robot_file_get_group(p->file, i);
    file_part joints = {p->file, p->d, g.joints}, links = {p->file, p->d, g.links};
    return Py_BuildValue("sNN", g.name, tuple_make(g.joint_count, make_joint_name, &joints),
                         tuple_make(g.link_count, make_link_name, &links));
}

static PyObject *make_end_effector(const void *context, size_t i) {
    const file_part *p = context;
    ovoid_robot_end_effector e = ovoid_robot_file_get_end_effector(p->file, i);
    return Py_BuildValue("sss", e.name, p->d.links[e.link].name, ovoid_robot_file_get_group(p->file, e.group).name);
}

static PyObject *make_number(const void *numbers, size_t i) { return PyFloat_FromDouble(((const double *)numbers)[i]); }

static PyObject *make_named_state(const void *context, size_t i) {
    const file_part *p = context;
    ovoid_robot_state s = ovoid_robot_file_get_state(p->file, i);
    PyObject *values = PyDict_New();
    for (size_t k = 0; values && k < s.value_count; k++) {
        const ovoid_robot_value *v = &s.values[k];
        PyObject *numbers = tuple_make(v->count, make_number, v->values);
        if (!numbers || PyDict_SetItemString(values, p->d.joints[v->joint].name, numbers)) Py_CLEAR(values);
        Py_XDECREF(numbers);
    }
    return Py_BuildValue("ssN", s.name, s.group, values);
}

static PyObject *make_mesh(const void *context, size_t i) {
    ovoid_robot_mesh m = ovoid_robot_file_get_mesh(((const file_part *)context)->file, i);
    return Py_BuildValue("{s:s,s:s,s:N,s:n,s:n,s:d,s:d,s:s,s:d}", "path", m.path, "address", m.address, "scale",
                         vec3_make(m.scale), "parts", (Py_ssize_t)m.part_count, "uses", (Py_ssize_t)m.use_count,
                         "mesh_volume", m.convexity.mesh_volume, "hull_volume", m.convexity.hull_volume, "kind",
                         ovoid_mesh_kind_get_name(m.kind), "allowance", m.allowance);
}

static PyObject *make_sphere(const void *context, size_t i) {
    const file_part *p = context;
    size_t count;
    const ovoid_robot_link_sphere *s = &ovoid_robot_file_get_spheres(p->file, &count)[i];
    return Py_BuildValue("sNd", p->d.links[s->link].name, vec3_make(s->ball.center), s->ball.radius);
}

static PyObject *make_ignored(const void *context, size_t i) {
    ovoid_robot_ignored ignored = ovoid_robot_file_get_ignored(((const file_part *)context)->file, i);
    return Py_BuildValue("sn", ignored.name, (Py_ssize_t)ignored.count);
}

static PyObject *make_facts(const ovoid_robot_file *file) {
    size_t spheres, passive;
    ovoid_robot_file_get_spheres(file, &spheres);
    file_part part = {file, ovoid_robot_file_get_description(file), ovoid_robot_file_get_passive(file, &passive)};
    const struct {
        const char *key;
        size_t count;
        PyObject *(*make)(const void *context, size_t i);
    } facts[] = {{"groups", ovoid_robot_file_get_group_count(file), make_group},
                 {"end_effectors", ovoid_robot_file_get_end_effector_count(file), make_end_effector},
                 {"states", ovoid_robot_file_get_state_count(file), make_named_state},
                 {"meshes", ovoid_robot_file_get_mesh_count(file), make_mesh},
                 {"spheres", spheres, make_sphere},
                 {"passive", passive, make_joint_name},
                 {"ignored", ovoid_robot_file_get_ignored_count(file), make_ignored}};
    PyObject *all = Py_BuildValue("{s:n}", "fixed_mimics", (Py_ssize_t)ovoid_robot_file_get_fixed_mimic_count(file));
    for (size_t i = 0; all && i < sizeof facts / sizeof *facts; i++) {
        PyObject *made = tuple_make(facts[i].count, facts[i].make, &part);
        if (!made || PyDict_SetItemString(all, facts[i].key, made)) Py_CLEAR(all);
        Py_XDECREF(made);
    }
    return all;
}

// ---- shapes that belong to a file

static void destroy_file(PyObject *owner) { ovoid_robot_file_destroy(PyCapsule_GetPointer(owner, "robot file")); }
static void destroy_obstacles(PyObject *owner) { ovoid_obstacles_destroy(PyCapsule_GetPointer(owner, "obstacles")); }

static PyObject *make_robot(PyTypeObject *type, ovoid_robot_file *file) {
    PyObject *owner = PyCapsule_New(file, "robot file", destroy_file);
    if (!owner) {
        ovoid_robot_file_destroy(file);
        return NULL;
    }
    module_state *state = state_of_type((PyObject *)type);
    ovoid_robot_description d = ovoid_robot_file_get_description(file);
    PyObject *shapes = robot_shapes_make(state, &d, owner), *facts = shapes ? make_facts(file) : NULL;
    ovoid_error error;
    PyObject *made = NULL;
    if (facts)
        made = robot_wrap(type, ovoid_robot_create(&d, NULL, &error), Py_NewRef(shapes), Py_NewRef(facts), &error);
    Py_XDECREF(facts);
    Py_XDECREF(shapes);
    Py_DECREF(owner);
    return made;
}

// ---- Robot.read

static PyObject *read_robot(PyObject *type, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"urdf",   "srdf",   "packages",   "parts",     "visual",
                            "solids", "scales", "fixed_base", "tolerance", NULL};
    int solids = 1;
    PyObject *srdf = Py_None;
    read_input in = {.o.fixed_base = 1};
    ovoid_error error;
    if (!arguments_read(arguments, keywords, "O&|O$OpppOpd:read", names, PyUnicode_FSConverter, &in.urdf, &srdf,
                        &in.packages, &in.o.parts, &in.o.visual, &solids, &in.scales, &in.o.fixed_base,
                        &in.o.tolerance) ||
        (srdf != Py_None && !PyUnicode_FSConverter(srdf, &in.srdf)) || read_packages(&in) || read_scales(&in)) {
        free_input(&in);
        return NULL;
    }
    in.o.hull = !solids;
    in.o.note = gather;
    in.o.context = &in.notes;
    const char *first = PyBytes_AsString(in.urdf), *second = in.srdf ? PyBytes_AsString(in.srdf) : NULL;
    ovoid_robot_file *file;
    Py_BEGIN_ALLOW_THREADS;
    file = ovoid_robot_file_read(first, second, &in.o, &error);
    Py_END_ALLOW_THREADS;
    PyObject *made = NULL;
    if (tell(&in.notes))
        ovoid_robot_file_destroy(file);
    else
        made = file ? make_robot((PyTypeObject *)type, file) : raise_error(state_of_type(type), &error);
    free_input(&in);
    return made;
}

PyMethodDef robot_constructors[] = {
    {"read", METHOD_KEYWORDS(read_robot), METH_VARARGS | METH_KEYWORDS | METH_CLASS,
     "read(urdf: PathLike, srdf: PathLike | None = None, *, packages: dict[str, PathLike] | None = None, parts: bool = "
     "False, visual: bool = False, solids: bool = True, scales: dict[str | None, float] | None = None, fixed_base: "
     "bool = True, tolerance: float = 0) -> Robot\n--\n\nFrom a URDF with its meshes, perhaps with an SRDF; metres. "
     "packages: {name: folder} of package:// addresses. solids: a\nmesh counts as what it is, its hull, the solid that "
     "its triangles enclose, or, where they are not closed, their surface;\nFalse: as its hull. parts: as the hulls of "
     "its objects. visual: links without collision geometry take their visual one.\nscales: {link: factor} of the "
     "sizes of links, None: of all others. fixed_base=False: the SRDF's virtual joint moves the robot.\ntolerance: of "
     "cylinders. What should be known is a UserWarning."},
    {NULL, NULL, 0, NULL}};

// ---- scenes

static PyObject *make_solid(module_state *state, const ovoid_solid *solid, PyObject *owner) {
    return solid ? solid_borrow(state, solid, owner) : Py_NewRef(Py_None);
}

/// A scene, and the capsule that keeps its shapes.
typedef struct kept_obstacles {
    module_state *state;
    const ovoid_obstacles *obstacles;
    PyObject *owner;
} kept_obstacles;

static PyObject *make_obstacle(const void *context, size_t i) {
    const kept_obstacles *k = context;
    ovoid_obstacle o = ovoid_obstacles_get(k->obstacles, i);
    PyObject *solid = make_solid(k->state, o.solid, k->owner);
    if (!solid) return NULL;
    return PyObject_CallFunction(k->state->obstacle, "sNNNNN", o.name, shape_borrow(k->state, o.shape, k->owner),
                                 pose_wrap(k->state, o.pose), solid, robot_name_make(o.frame), robot_name_make(o.link));
}

// Reads a scene; the capsule owns it.
static PyObject *read_scene(module_state *state, PyObject *path, double tolerance, int solids) {
    notes told = {NULL, 0, 0};
    ovoid_robot_read_options o = {.tolerance = tolerance, .hull = !solids, .note = gather, .context = &told};
    ovoid_error error;
    ovoid_obstacles *obstacles;
    const char *text = PyBytes_AsString(path);
    Py_BEGIN_ALLOW_THREADS;
    obstacles = ovoid_obstacles_read(text, &o, &error);
    Py_END_ALLOW_THREADS;
    int failed = tell(&told);
    if (!failed && !obstacles) return raise_error(state, &error);
    PyObject *owner = failed ? NULL : PyCapsule_New(obstacles, "obstacles", destroy_obstacles);
    if (!owner) ovoid_obstacles_destroy(obstacles);
    return owner;
}

static PyObject *read_obstacles(PyObject *module, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"path", "tolerance", "solids", NULL};
    PyObject *path = NULL, *list = NULL;
    double tolerance = 0;
    int solids = 1;
    if (!arguments_read(arguments, keywords, "O&|d$p:read_obstacles", names, PyUnicode_FSConverter, &path, &tolerance,
                        &solids)) {
        Py_XDECREF(path);
        return NULL;
    }
    module_state *state = state_of_module(module);
    PyObject *owner = read_scene(state, path, tolerance, solids);
    Py_DECREF(path);
    kept_obstacles kept = {state, owner ? PyCapsule_GetPointer(owner, "obstacles") : NULL, owner};
    if (owner) list = list_make(ovoid_obstacles_get_count(kept.obstacles), make_obstacle, &kept);
    Py_XDECREF(owner);
    return list;
}

// ---- planning problems

static PyObject *make_positions(const ovoid_joint_position *positions, size_t count) {
    PyObject *made = PyDict_New();
    for (size_t i = 0; made && i < count; i++) {
        PyObject *number = PyFloat_FromDouble(positions[i].position);
        if (!number || PyDict_SetItemString(made, positions[i].joint, number)) Py_CLEAR(made);
        Py_XDECREF(number);
    }
    return made;
}

static PyObject *make_goal(const void *request, size_t i) {
    size_t count;
    const ovoid_joint_position *goal = ovoid_motion_request_get_goal(request, i, &count);
    return make_positions(goal, count);
}

// A goal without joints would be the start, or any state.
static int check_goals(module_state *state, const char *path, const ovoid_motion_request *request) {
    for (size_t i = 0; i < ovoid_motion_request_get_goal_count(request); i++) {
        size_t count;
        (void)ovoid_motion_request_get_goal(request, i, &count);
        if (count) continue;
        raise_code(state, OVOID_ERROR_EMPTY, -1, "%s: goal_constraints: goal %zu names no joint", path, i);
        return -1;
    }
    return 0;
}

static PyObject *make_request(module_state *state, const char *path, const ovoid_motion_request *request) {
    size_t count;
    const ovoid_joint_position *start = ovoid_motion_request_get_start(request, &count);
    if (check_goals(state, path, request)) return NULL;
    return PyObject_CallFunction(state->motion_request, "sNN", ovoid_motion_request_get_group(request),
                                 make_positions(start, count),
                                 list_make(ovoid_motion_request_get_goal_count(request), make_goal, request));
}

static PyObject *read_motion_request(PyObject *module, PyObject *given) {
    PyObject *path = NULL;
    ovoid_error error;
    if (!PyUnicode_FSConverter(given, &path)) return NULL;
    notes told = {NULL, 0, 0};
    ovoid_robot_read_options o = {.note = gather, .context = &told};
    ovoid_motion_request *request = ovoid_motion_request_read(PyBytes_AsString(path), &o, &error);
    module_state *state = state_of_module(module);
    PyObject *made = NULL;
    if (!tell(&told))
        made = request ? make_request(state, PyBytes_AsString(path), request) : raise_error(state, &error);
    ovoid_motion_request_destroy(request);
    Py_DECREF(path);
    return made;
}

// ---- trajectories

/// A trajectory that begins farther than this from its trajectory_start is told of, as the tool does.
#define START_TOLERANCE 0.01

/// A trajectory, and what its file says up to the point at hand: the start and the points before.
typedef struct trajectory_walk {
    module_state *state;
    const char *path;
    const ovoid_trajectory *trajectory;
    PyObject *points, *last; ///< a list of dicts, and a dict
} trajectory_walk;

static PyObject *make_time(const void *trajectory, size_t i) {
    return PyFloat_FromDouble(ovoid_trajectory_get_time(trajectory, i));
}

// Tells of a first point that is elsewhere than the state in which the trajectory is said to begin.
static int compare_start(const trajectory_walk *w, const ovoid_joint_position *point, size_t count) {
    for (size_t i = 0; i < count; i++) {
        PyObject *start = PyDict_GetItemString(w->last, point[i].joint);
        if (!start || fabs(point[i].position - PyFloat_AsDouble(start)) <= START_TOLERANCE) continue;
        PyObject *first = PyFloat_FromDouble(point[i].position);
        PyObject *text = first ? PyUnicode_FromFormat("%s: %s is %R in trajectory_start, %R in the first point: the "
                                                      "way between is not checked",
                                                      w->path, point[i].joint, start, first)
                               : NULL;
        int failed = !text || PyErr_WarnFormat(PyExc_UserWarning, 1, "%U", text);
        Py_XDECREF(text);
        Py_XDECREF(first);
        return failed ? -1 : 0;
    }
    return 0;
}

// Paths in time go forwards, as the tool wants them.
static int check_time(const trajectory_walk *w, size_t i) {
    if (!i || isnan(ovoid_trajectory_get_time(w->trajectory, i)) ||
        ovoid_trajectory_get_time(w->trajectory, i) > ovoid_trajectory_get_time(w->trajectory, i - 1))
        return 0;
    PyObject *time = make_time(w->trajectory, i), *before = time ? make_time(w->trajectory, i - 1) : NULL;
    Py_ssize_t line = (Py_ssize_t)ovoid_trajectory_get_line(w->trajectory, i);
    if (before)
        raise_code(w->state, OVOID_ERROR_FORMAT, line,
                   "%s:%zd: point %zu: its time, %R s, is not after that of the point before, %R s", w->path, line, i,
                   time, before);
    Py_XDECREF(before);
    Py_XDECREF(time);
    return -1;
}

// A point names all joints that the start, a point before or itself names.
static int add_point(trajectory_walk *w, size_t i) {
    size_t count;
    const ovoid_joint_position *point = ovoid_trajectory_get_point(w->trajectory, i, &count);
    if (check_time(w, i) || (!i && compare_start(w, point, count))) return -1;
    PyObject *own = make_positions(point, count), *whole = own ? PyDict_Copy(w->last) : NULL;
    int failed = !whole || PyDict_Update(whole, own) || PyList_Append(w->points, whole);
    Py_XDECREF(own);
    if (failed) {
        Py_XDECREF(whole);
        return -1;
    }
    Py_DECREF(w->last);
    w->last = whole;
    return 0;
}

static PyObject *make_trajectory(module_state *state, const char *path, const ovoid_trajectory *trajectory) {
    size_t count, points = ovoid_trajectory_get_count(trajectory);
    const ovoid_joint_position *positions = ovoid_trajectory_get_start(trajectory, &count);
    PyObject *start = make_positions(positions, count), *made = NULL;
    trajectory_walk walk = {state, path, trajectory, start ? PyList_New(0) : NULL, Py_XNewRef(start)};
    int failed = !walk.points;
    for (size_t i = 0; i < points && !failed; i++) failed = add_point(&walk, i);
    if (!failed)
        made = PyObject_CallFunction(state->trajectory, "OON", start, walk.points,
                                     isnan(ovoid_trajectory_get_time(trajectory, 0))
                                         ? Py_NewRef(Py_None)
                                         : list_make(points, make_time, trajectory));
    Py_XDECREF(walk.last);
    Py_XDECREF(walk.points);
    Py_XDECREF(start);
    return made;
}

static PyObject *read_trajectory(PyObject *module, PyObject *given) {
    PyObject *path = NULL, *made = NULL;
    ovoid_error error;
    if (!PyUnicode_FSConverter(given, &path)) return NULL;
    notes told = {NULL, 0, 0};
    ovoid_robot_read_options o = {.note = gather, .context = &told};
    ovoid_trajectory *trajectory = ovoid_trajectory_read(PyBytes_AsString(path), &o, &error);
    module_state *state = state_of_module(module);
    if (!tell(&told))
        made = trajectory ? make_trajectory(state, PyBytes_AsString(path), trajectory) : raise_error(state, &error);
    ovoid_trajectory_destroy(trajectory);
    Py_DECREF(path);
    return made;
}

// ---- problems

static PyObject *make_problem(const void *problems, size_t i) {
    ovoid_problem p = ovoid_problems_get(problems, i);
    return Py_BuildValue("sNN", p.name, PyUnicode_DecodeFSDefault(p.scene), PyUnicode_DecodeFSDefault(p.request));
}

static PyObject *find_problems(PyObject *module, PyObject *given) {
    PyObject *path = NULL;
    ovoid_error error;
    if (!PyUnicode_FSConverter(given, &path)) return NULL;
    ovoid_problems *problems = ovoid_problems_find(PyBytes_AsString(path), &error);
    Py_DECREF(path);
    if (!problems) return raise_error(state_of_module(module), &error);
    PyObject *list = list_make(ovoid_problems_get_count(problems), make_problem, problems);
    ovoid_problems_destroy(problems);
    return list;
}

PyMethodDef robot_file_functions[] = {
    {"read_obstacles", METHOD_KEYWORDS(read_obstacles), METH_VARARGS | METH_KEYWORDS,
     "read_obstacles(path: PathLike, tolerance: float = 0, *, solids: bool = True) -> list[Obstacle]\n--\n\nThe "
     "obstacles of a scene, MoveIt's YAML or ovoid's JSON: Obstacle tuples (name, shape, pose, solid, frame, link). A "
     "solid\ncounts in the place of the shape, which is its hull. frame: the link or fixed frame in which the pose is, "
     "None: the root's.\nlink: the link that holds it, or None. tolerance: of cylinders and cones, a length. "
     "solids=False: meshes are their hulls."},
    {"read_motion_request", read_motion_request, METH_O,
     "read_motion_request(path: PathLike, /) -> MotionRequest\n--\n\nA motion planning request of MoveIt (YAML): a "
     "MotionRequest (group, start, goals), states as dicts of joints."},
    {"read_trajectory", read_trajectory, METH_O,
     "read_trajectory(path: PathLike, /) -> Trajectory\n--\n\nA trajectory of MoveIt or ROS (YAML or JSON): a "
     "Trajectory "
     "(start, points, times), states as dicts of joints. A point has the joints that the start or a point before names "
     "too.\nTimes that do not rise are refused."},
    {"find_problems", find_problems, METH_O,
     "find_problems(folder: PathLike, /) -> list[tuple[str, str, str]]\n--\n\nThe planning problems of a folder: a "
     "list of (name, path of the scene, path of the request)."},
    {NULL, NULL, 0, NULL}};

// ---- Cell.read

// Links' paddings by their names; None: of all links without one of their own.
static int set_paddings(cell_object *self, PyObject *paddings) {
    PyObject *key, *value;
    Py_ssize_t at = 0;
    ovoid_error error;
    size_t links = ovoid_robot_get_description(self->robot->robot).link_count;
    if (!paddings || paddings == Py_None) return 0;
    if (!PyDict_Check(paddings)) {
        PyErr_SetString(PyExc_TypeError, "paddings: a dict of lengths by the links' names is wanted; None: all others");
        return -1;
    }
    for (int pass = 0; pass < 2; pass++)
        for (at = 0; PyDict_Next(paddings, &at, &key, &value);) {
            uint32_t link = 0;
            double padding = PyFloat_AsDouble(value);
            if (PyErr_Occurred()) return -1;
            if ((key == Py_None) == pass) continue;
            if (key != Py_None && link_read(self->robot, key, &link)) return -1;
            for (size_t end = key == Py_None ? links : link + 1; link < end; link++)
                if (ovoid_robot_cell_set_padding(self->cell, link, padding, &error) != OVOID_OK)
                    return raise_error(state_of((PyObject *)self), &error), -1;
        }
    return 0;
}

// Puts the scene around the robot, and keeps it with each of its bodies.
static PyObject *add_obstacles(cell_object *self, PyObject *owner) {
    module_state *state = state_of((PyObject *)self);
    const ovoid_obstacles *obstacles = PyCapsule_GetPointer(owner, "obstacles");
    size_t count = ovoid_obstacles_get_count(obstacles);
    ovoid_placed_obstacle *placed = malloc((count + 1) * sizeof *placed);
    ovoid_error error;
    if (!placed) return PyErr_NoMemory();
    ovoid_code code = ovoid_robot_cell_add_obstacles(self->cell, obstacles, placed, &error);
    self->version++;
    PyObject *list = code == OVOID_OK ? PyList_New(0) : raise_error(state, &error);
    for (size_t i = 0; list && i < count; i++) {
        ovoid_obstacle o = ovoid_obstacles_get(obstacles, i);
        PyObject *body = o.solid ? solid_borrow(state, o.solid, owner) : shape_borrow(state, o.shape, owner);
        PyObject *name = robot_name_make(o.name);
        const placed_body at = {placed[i].id, placed[i].link, placed[i].pose};
        PyObject *one = body && name && !cell_keep(self, &at, body, name)
                            ? Py_BuildValue("(OK)", name, (unsigned long long)placed[i].id)
                            : NULL;
        if (!one || PyList_Append(list, one)) Py_CLEAR(list);
        Py_XDECREF(one);
        Py_XDECREF(name);
        Py_XDECREF(body);
    }
    free(placed);
    return list;
}

static PyObject *read_into(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"path", "tolerance", "solids", "paddings", NULL};
    cell_object *self = (cell_object *)object;
    PyObject *path = NULL, *paddings = NULL, *made = NULL;
    double tolerance = 0;
    int solids = 1;
    if (!arguments_read(arguments, keywords, "O&|d$pO:read", names, PyUnicode_FSConverter, &path, &tolerance, &solids,
                        &paddings)) {
        Py_XDECREF(path);
        return NULL;
    }
    PyObject *owner = read_scene(state_of(object), path, tolerance, solids);
    Py_DECREF(path);
    if (owner && self->readers)
        PyErr_SetString(PyExc_RuntimeError, "another thread is querying this cell");
    else if (owner)
        made = add_obstacles(self, owner);
    // Those that are given count before those of the scene.
    if (made && set_paddings(self, paddings)) Py_CLEAR(made);
    Py_XDECREF(owner);
    return made;
}

PyMethodDef cell_scenes[] = {
    {"read", METHOD_KEYWORDS(read_into), METH_VARARGS | METH_KEYWORDS,
     "read(path: PathLike, tolerance: float = 0, *, solids: bool = True, paddings: dict[str | None, float] | None = "
     "None) -> list[tuple[str, int]]\n--\n\nPuts a scene around the robot, as read_obstacles reads it: obstacles, what "
     "links hold, paddings and allowed collisions. A\nlist of (name, id). paddings: {link: length}, None: of all other "
     "links; they count before those of the scene."},
    {NULL, NULL, 0, NULL}};
#else
typedef int nothing_to_read; // ISO C wants a declaration
#endif
