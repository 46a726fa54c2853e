// Robots, scenes of obstacles and planning problems from files. Notes of the readers become warnings.
#ifdef OVOID_PYTHON_ROBOT_READ
#include "src/robot.h"

#include <ovoid/robot_io.h>

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
    ovoid_robot_read_options o;
    notes notes;
} read_input;

static void free_input(read_input *in) {
    Py_XDECREF(in->urdf);
    Py_XDECREF(in->srdf);
    Py_XDECREF(in->names);
    free(in->list);
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

// ---- what a file says beside the description

static const char *joint_name(const ovoid_robot_description *d, uint32_t i) { return d->joints[i].name; }
static const char *link_name(const ovoid_robot_description *d, uint32_t i) { return d->links[i].name; }

static PyObject *make_names(const ovoid_robot_description *d, const uint32_t *indices, size_t count,
                            const char *(*name)(const ovoid_robot_description *, uint32_t)) {
    PyObject *made = PyTuple_New((Py_ssize_t)count);
    for (size_t i = 0; made && i < count; i++) {
        PyObject *text = PyUnicode_FromString(name(d, indices[i]));
        if (!text)
            Py_CLEAR(made);
        else
            PyTuple_SetItem(made, (Py_ssize_t)i, text);
    }
    return made;
}

static PyObject *make_group(const ovoid_robot_file *file, const ovoid_robot_description *d, size_t i) {
    ovoid_robot_group g = ovoid_robot_file_get_group(file, i);
    return Py_BuildValue("sNN", g.name, make_names(d, g.joints, g.joint_count, joint_name),
                         make_names(d, g.links, g.link_count, link_name));
}

static PyObject *make_named_state(const ovoid_robot_file *file, const ovoid_robot_description *d, size_t i) {
    ovoid_robot_state s = ovoid_robot_file_get_state(file, i);
    PyObject *values = PyDict_New();
    for (size_t k = 0; values && k < s.value_count; k++) {
        const ovoid_robot_value *v = &s.values[k];
        PyObject *numbers = PyTuple_New(v->count);
        for (uint32_t c = 0; numbers && c < v->count; c++)
            PyTuple_SetItem(numbers, c, PyFloat_FromDouble(v->values[c]));
        if (!numbers || PyDict_SetItemString(values, joint_name(d, v->joint), numbers)) Py_CLEAR(values);
        Py_XDECREF(numbers);
    }
    return Py_BuildValue("ssN", s.name, s.group, values);
}

static PyObject *make_mesh(const ovoid_robot_file *file, const ovoid_robot_description *d, size_t i) {
    (void)d;
    ovoid_robot_mesh m = ovoid_robot_file_get_mesh(file, i);
    return Py_BuildValue("{s:s,s:s,s:N,s:n,s:n,s:d,s:d,s:O}", "path", m.path, "address", m.address, "scale",
                         vec3_make(m.scale), "parts", (Py_ssize_t)m.part_count, "uses", (Py_ssize_t)m.use_count,
                         "mesh_volume", m.convexity.mesh_volume, "hull_volume", m.convexity.hull_volume, "is_convex",
                         m.convexity.kind != OVOID_MESH_HULL ? Py_False : Py_True);
}

static PyObject *make_sphere(const ovoid_robot_file *file, const ovoid_robot_description *d, size_t i) {
    size_t count;
    return Py_BuildValue("sNd", link_name(d, ovoid_robot_file_get_spheres(file, &count)[i].link),
                         vec3_make(ovoid_robot_file_get_spheres(file, &count)[i].ball.center),
                         ovoid_robot_file_get_spheres(file, &count)[i].ball.radius);
}

static PyObject *make_ignored(const ovoid_robot_file *file, const ovoid_robot_description *d, size_t i) {
    (void)d;
    ovoid_robot_ignored ignored = ovoid_robot_file_get_ignored(file, i);
    return Py_BuildValue("sn", ignored.name, (Py_ssize_t)ignored.count);
}

typedef PyObject *fact_maker(const ovoid_robot_file *file, const ovoid_robot_description *d, size_t i);

static int add_facts(PyObject *facts, const char *key, const ovoid_robot_file *file, size_t count, fact_maker *make) {
    ovoid_robot_description d = ovoid_robot_file_get_description(file);
    PyObject *made = PyTuple_New((Py_ssize_t)count);
    for (size_t i = 0; made && i < count; i++) {
        PyObject *one = make(file, &d, i);
        if (!one)
            Py_CLEAR(made);
        else
            PyTuple_SetItem(made, (Py_ssize_t)i, one);
    }
    int failed = !made || PyDict_SetItemString(facts, key, made);
    Py_XDECREF(made);
    return failed ? -1 : 0;
}

static PyObject *make_facts(const ovoid_robot_file *file) {
    ovoid_robot_description d = ovoid_robot_file_get_description(file);
    size_t spheres, passive;
    ovoid_robot_file_get_spheres(file, &spheres);
    const uint32_t *joints = ovoid_robot_file_get_passive(file, &passive);
    PyObject *facts = PyDict_New(), *names = make_names(&d, joints, passive, joint_name);
    if (!facts || !names || PyDict_SetItemString(facts, "passive", names) ||
        add_facts(facts, "groups", file, ovoid_robot_file_get_group_count(file), make_group) ||
        add_facts(facts, "states", file, ovoid_robot_file_get_state_count(file), make_named_state) ||
        add_facts(facts, "meshes", file, ovoid_robot_file_get_mesh_count(file), make_mesh) ||
        add_facts(facts, "spheres", file, spheres, make_sphere) ||
        add_facts(facts, "ignored", file, ovoid_robot_file_get_ignored_count(file), make_ignored))
        Py_CLEAR(facts);
    size_t mimics = ovoid_robot_file_get_fixed_mimic_count(file);
    PyObject *count = facts ? PyLong_FromSize_t(mimics) : NULL;
    if (facts && (!count || PyDict_SetItemString(facts, "fixed_mimics", count))) Py_CLEAR(facts);
    Py_XDECREF(count);
    Py_XDECREF(names);
    return facts;
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

// ---- Robot.load

static PyObject *load(PyObject *type, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"urdf", "srdf", "packages", "parts", "visual", "fixed_base", "tolerance", NULL};
    PyObject *srdf = Py_None;
    read_input in = {.urdf = NULL};
    ovoid_error error;
    if (!PyArg_ParseTupleAndKeywords(arguments, keywords, "O&|O$Opppd:load", names, PyUnicode_FSConverter, &in.urdf,
                                     &srdf, &in.packages, &in.o.parts, &in.o.visual, &in.o.fixed_base,
                                     &in.o.tolerance) ||
        (srdf != Py_None && !PyUnicode_FSConverter(srdf, &in.srdf)) || read_packages(&in)) {
        free_input(&in);
        return NULL;
    }
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
    {"load", METHOD_KEYWORDS(load), METH_VARARGS | METH_KEYWORDS | METH_CLASS,
     "load(urdf, srdf=None, *, packages=None, parts=False, visual=False, fixed_base=False, tolerance=0)\n--\n\nFrom a "
     "URDF with its meshes, perhaps with an SRDF; metres. packages: {name: folder} of package:// addresses. parts: a\n"
     "mesh counts as the hulls of its objects, not as its hull. visual: links without collision geometry take their "
     "visual\none. fixed_base: the SRDF's virtual joint adds nothing. tolerance: of cylinders. What should be known is "
     "a UserWarning."},
    {NULL, NULL, 0, NULL}};

// ---- scenes

// The obstacles of a file as a list of (name, Shape, Pose); the owner keeps the shapes.
static PyObject *make_obstacles(module_state *state, ovoid_obstacles *obstacles) {
    PyObject *owner = PyCapsule_New(obstacles, "obstacles", destroy_obstacles);
    if (!owner) {
        ovoid_obstacles_destroy(obstacles);
        return NULL;
    }
    size_t count = ovoid_obstacles_get_count(obstacles);
    PyObject *list = PyList_New(0);
    for (size_t i = 0; list && i < count; i++) {
        ovoid_obstacle o = ovoid_obstacles_get(obstacles, i);
        PyObject *one = PyObject_CallFunction(state->obstacle, "sNN", o.name, shape_borrow(state, o.shape, owner),
                                              pose_wrap(state, o.pose));
        if (!one || PyList_Append(list, one)) Py_CLEAR(list);
        Py_XDECREF(one);
    }
    Py_DECREF(owner);
    return list;
}

static PyObject *read_obstacles(module_state *state, PyObject *path, double tolerance) {
    notes told = {NULL, 0, 0};
    ovoid_robot_read_options o = {.tolerance = tolerance, .note = gather, .context = &told};
    ovoid_error error;
    ovoid_obstacles *obstacles;
    const char *text = PyBytes_AsString(path);
    Py_BEGIN_ALLOW_THREADS;
    obstacles = ovoid_obstacles_read(text, &o, &error);
    Py_END_ALLOW_THREADS;
    if (tell(&told)) {
        ovoid_obstacles_destroy(obstacles);
        return NULL;
    }
    return obstacles ? make_obstacles(state, obstacles) : raise_error(state, &error);
}

static PyObject *load_obstacles(PyObject *module, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"path", "tolerance", NULL};
    PyObject *path = NULL;
    double tolerance = 0;
    if (!PyArg_ParseTupleAndKeywords(arguments, keywords, "O&|d:load_obstacles", names, PyUnicode_FSConverter, &path,
                                     &tolerance)) {
        Py_XDECREF(path);
        return NULL;
    }
    PyObject *list = read_obstacles(state_of_module(module), path, tolerance);
    Py_DECREF(path);
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

static PyObject *make_request(module_state *state, const ovoid_motion_request *request) {
    size_t count;
    const ovoid_joint_position *start = ovoid_motion_request_get_start(request, &count);
    PyObject *first = make_positions(start, count), *goals = PyList_New(0);
    for (size_t i = 0; goals && i < ovoid_motion_request_get_goal_count(request); i++) {
        const ovoid_joint_position *goal = ovoid_motion_request_get_goal(request, i, &count);
        PyObject *one = make_positions(goal, count);
        if (!one || PyList_Append(goals, one)) Py_CLEAR(goals);
        Py_XDECREF(one);
    }
    return PyObject_CallFunction(state->motion_request, "sNN", ovoid_motion_request_get_group(request), first, goals);
}

static PyObject *load_motion_request(PyObject *module, PyObject *given) {
    PyObject *path = NULL;
    ovoid_error error;
    if (!PyUnicode_FSConverter(given, &path)) return NULL;
    notes told = {NULL, 0, 0};
    ovoid_robot_read_options o = {.note = gather, .context = &told};
    ovoid_motion_request *request = ovoid_motion_request_read(PyBytes_AsString(path), &o, &error);
    Py_DECREF(path);
    module_state *state = state_of_module(module);
    PyObject *made = NULL;
    if (!tell(&told)) made = request ? make_request(state, request) : raise_error(state, &error);
    ovoid_motion_request_destroy(request);
    return made;
}

static PyObject *find_problems(PyObject *module, PyObject *given) {
    PyObject *path = NULL;
    ovoid_error error;
    if (!PyUnicode_FSConverter(given, &path)) return NULL;
    ovoid_problems *problems = ovoid_problems_find(PyBytes_AsString(path), &error);
    Py_DECREF(path);
    if (!problems) return raise_error(state_of_module(module), &error);
    PyObject *list = PyList_New(0);
    for (size_t i = 0; list && i < ovoid_problems_get_count(problems); i++) {
        ovoid_problem p = ovoid_problems_get(problems, i);
        PyObject *one =
            Py_BuildValue("sNN", p.name, PyUnicode_DecodeFSDefault(p.scene), PyUnicode_DecodeFSDefault(p.request));
        if (!one || PyList_Append(list, one)) Py_CLEAR(list);
        Py_XDECREF(one);
    }
    ovoid_problems_destroy(problems);
    return list;
}

PyMethodDef robot_file_functions[] = {
    {"load_obstacles", METHOD_KEYWORDS(load_obstacles), METH_VARARGS | METH_KEYWORDS,
     "load_obstacles(path, tolerance=0)\n--\n\nThe convex obstacles of a scene, MoveIt's YAML or ovoid's JSON: "
     "Obstacle "
     "tuples (name, shape, pose). tolerance: of\ncylinders and cones, a length."},
    {"load_motion_request", load_motion_request, METH_O,
     "load_motion_request(path, /)\n--\n\nA motion planning request of MoveIt (YAML): a MotionRequest (group, start, "
     "goals), states as dicts of joints."},
    {"find_problems", find_problems, METH_O,
     "find_problems(folder, /)\n--\n\nThe planning problems of a folder: a list of (name, path of the scene, path of "
     "the request)."},
    {NULL, NULL, 0, NULL}};

// ---- Cell.load

static PyObject *add_obstacles(cell_object *self, PyObject *obstacles) {
    module_state *state = state_of((PyObject *)self);
    PyObject *list = PyList_New(0);
    for (Py_ssize_t i = 0; list && i < PyList_Size(obstacles); i++) {
        PyObject *obstacle = PyList_GetItem(obstacles, i), *shape = PyTuple_GetItem(obstacle, 1);
        ovoid_body body = {.shape = ((shape_object *)shape)->shape,
                           .pose = ((pose_object *)PyTuple_GetItem(obstacle, 2))->pose};
        ovoid_error error;
        ovoid_id id = ovoid_robot_cell_add(self->cell, &body, &error);
        if (!id) raise_error(state, &error);
        PyObject *one = id && !cell_keep(self, id, shape)
                            ? Py_BuildValue("(OK)", PyTuple_GetItem(obstacle, 0), (unsigned long long)id)
                            : NULL;
        if (!one || PyList_Append(list, one)) Py_CLEAR(list);
        Py_XDECREF(one);
    }
    return list;
}

static PyObject *load_into(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"path", "tolerance", NULL};
    cell_object *self = (cell_object *)object;
    PyObject *path = NULL, *made = NULL;
    double tolerance = 0;
    if (!PyArg_ParseTupleAndKeywords(arguments, keywords, "O&|d:load", names, PyUnicode_FSConverter, &path,
                                     &tolerance)) {
        Py_XDECREF(path);
        return NULL;
    }
    PyObject *obstacles = read_obstacles(state_of(object), path, tolerance);
    Py_DECREF(path);
    if (obstacles && self->readers)
        PyErr_SetString(PyExc_RuntimeError, "another thread is querying this cell");
    else if (obstacles)
        made = add_obstacles(self, obstacles);
    Py_XDECREF(obstacles);
    return made;
}

PyMethodDef cell_scenes[] = {
    {"load", METHOD_KEYWORDS(load_into), METH_VARARGS | METH_KEYWORDS,
     "load(path, tolerance=0)\n--\n\nAdds the obstacles of a scene, as load_obstacles reads it: a list of (name, id)."},
    {NULL, NULL, 0, NULL}};
#else
typedef int nothing_to_read; // ISO C wants a declaration
#endif
