// Robots and scenes of obstacles from files. Notes of the readers become warnings.
#ifdef OVOID_PYTHON_ROBOT_READ
#include "src/query.h"
#include "src/robot/notes.h"
#include "src/robot/robot.h"

#include <ovoid/robot_io.h>

#include <math.h>
#include <stdlib.h>

// ---- options

typedef struct read_input {
    PyObject *urdf, *srdf;      ///< bytes
    PyObject *packages, *names; ///< a dict, and a list of what the packages' texts belong to
    ovoid_robot_package *list;
    PyObject *scales; ///< a dict of factors by the links' names; None: of all others
    ovoid_robot_link_scale *factors;
    ovoid_robot_read_options o;
    read_notes notes;
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
    in.o.note = notes_gather;
    in.o.context = &in.notes;
    const char *first = PyBytes_AsString(in.urdf), *second = in.srdf ? PyBytes_AsString(in.srdf) : NULL;
    ovoid_robot_file *file;
    Py_BEGIN_ALLOW_THREADS;
    file = ovoid_robot_file_read(first, second, &in.o, &error);
    Py_END_ALLOW_THREADS;
    PyObject *made = NULL;
    if (notes_tell(&in.notes))
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
    read_notes told = {NULL, 0, 0};
    ovoid_robot_read_options o = {.tolerance = tolerance, .hull = !solids, .note = notes_gather, .context = &told};
    ovoid_error error;
    ovoid_obstacles *obstacles;
    const char *text = PyBytes_AsString(path);
    Py_BEGIN_ALLOW_THREADS;
    obstacles = ovoid_obstacles_read(text, &o, &error);
    Py_END_ALLOW_THREADS;
    int failed = notes_tell(&told);
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

PyMethodDef robot_file_functions[] = {
    {"read_obstacles", METHOD_KEYWORDS(read_obstacles), METH_VARARGS | METH_KEYWORDS,
     "read_obstacles(path: PathLike, tolerance: float = 0, *, solids: bool = True) -> list[Obstacle]\n--\n\nThe "
     "obstacles of a scene, MoveIt's YAML or ovoid's JSON: Obstacle tuples (name, shape, pose, solid, frame, link). A "
     "solid\ncounts in the place of the shape, which is its hull. frame: the link or fixed frame in which the pose is, "
     "None: the root's.\nlink: the link that holds it, or None. tolerance: of a planning scene's cylinders and cones, "
     "a "
     "length; ovoid's JSON says its own. solids=False: meshes are their hulls."},
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
