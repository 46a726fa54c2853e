// What a Robot is made of, as attributes: names, joints, variables, elements, limits, and what its files said beside.
#include "src/query.h"
#include "src/robot/robot.h"

#include <string.h>

static const ovoid_robot *get(PyObject *self) { return ((robot_object *)self)->robot; }

// Names need not be UTF-8.
PyObject *robot_name_make(const char *name) {
    if (!name) return Py_NewRef(Py_None);
    return PyUnicode_DecodeUTF8(name, (Py_ssize_t)strlen(name), "replace");
}

static PyObject *get_name(PyObject *self, void *closure) {
    (void)closure;
    return robot_name_make(ovoid_robot_get_description(get(self)).name);
}

static PyObject *get_root(PyObject *self, void *closure) {
    (void)closure;
    return robot_name_make(ovoid_robot_get_description(get(self)).links[ovoid_robot_get_root(get(self))].name);
}

static PyObject *make_link(const void *context, size_t i) {
    PyObject *self = (PyObject *)context;
    return robot_name_make(ovoid_robot_get_description(get(self)).links[i].name);
}

static PyObject *make_joint(const void *context, size_t i) {
    PyObject *self = (PyObject *)context;
    module_state *state = state_of(self);
    ovoid_robot_description d = ovoid_robot_get_description(get(self));
    const ovoid_robot_joint *j = &d.joints[i];
    return PyObject_CallFunction(
        state->joint, "NsNNNNdddNdd", robot_name_make(j->name), ovoid_joint_type_get_name(j->type),
        make_link(self, j->parent), make_link(self, j->child), pose_wrap(state, j->origin), vec3_make(j->axis),
        j->lower, j->upper, j->velocity, robot_name_make(j->mimic == OVOID_ROBOT_NONE ? NULL : d.joints[j->mimic].name),
        j->multiplier, j->offset);
}

// "shoulder", or of a joint of several variables "floor/x".
static PyObject *make_variable_name(const ovoid_robot_joint *joint, uint32_t component) {
    static const char *const planar[] = {"x", "y", "angle"}, *const floating[] = {"x",  "y",  "z", "qw",
                                                                                  "qx", "qy", "qz"};
    PyObject *name = robot_name_make(joint->name);
    if (!name || ovoid_joint_type_get_variable_count(joint->type) == 1) return name;
    PyObject *made = PyUnicode_FromFormat("%U/%s", name,
                                          joint->type == OVOID_JOINT_PLANAR ? planar[component] : floating[component]);
    Py_DECREF(name);
    return made;
}

PyObject *robot_variable_name_make(const robot_object *self, size_t i) {
    ovoid_robot_variable v = ovoid_robot_get_variable(self->robot, i);
    return make_variable_name(&ovoid_robot_get_description(self->robot).joints[v.joint], v.component);
}

static PyObject *make_variable(const void *context, size_t i) {
    PyObject *self = (PyObject *)context;
    ovoid_robot_variable v = ovoid_robot_get_variable(get(self), i);
    const ovoid_robot_joint *joint = &ovoid_robot_get_description(get(self)).joints[v.joint];
    return PyObject_CallFunction(state_of(self)->variable, "NNIddd", make_variable_name(joint, v.component),
                                 robot_name_make(joint->name), v.component, v.lower, v.upper, v.velocity);
}

static PyObject *make_element(const void *context, size_t i) {
    PyObject *self = (PyObject *)context;
    const ovoid_robot_element *e = &ovoid_robot_get_description(get(self)).elements[i];
    PyObject *shape = PyTuple_GetItem(((robot_object *)self)->shapes, (Py_ssize_t)i);
    PyObject *solid = e->solid ? solid_borrow(state_of(self), e->solid, self) : Py_NewRef(Py_None);
    return PyObject_CallFunction(state_of(self)->element, "NONNN", make_link(self, e->link), shape,
                                 pose_wrap(state_of(self), e->pose), robot_name_make(e->name), solid);
}

static PyObject *make_disabled(const void *context, size_t i) {
    PyObject *self = (PyObject *)context;
    ovoid_robot_pair pair = ovoid_robot_get_description(get(self)).disabled[i];
    return Py_BuildValue("NNN", make_link(self, pair.a), make_link(self, pair.b), robot_name_make(pair.reason));
}

static PyObject *get_links(PyObject *self, void *closure) {
    (void)closure;
    return tuple_make(ovoid_robot_get_description(get(self)).link_count, make_link, self);
}
static PyObject *get_joints(PyObject *self, void *closure) {
    (void)closure;
    return tuple_make(ovoid_robot_get_description(get(self)).joint_count, make_joint, self);
}
static PyObject *get_variables(PyObject *self, void *closure) {
    (void)closure;
    return tuple_make(ovoid_robot_get_variable_count(get(self)), make_variable, self);
}
static PyObject *get_elements(PyObject *self, void *closure) {
    (void)closure;
    return tuple_make(ovoid_robot_get_description(get(self)).element_count, make_element, self);
}
static PyObject *get_disabled(PyObject *self, void *closure) {
    (void)closure;
    return tuple_make(ovoid_robot_get_description(get(self)).disabled_count, make_disabled, self);
}

// The lower limits of all variables, or with a closure the upper ones.
static PyObject *get_limits(PyObject *self, void *closure) {
    Py_ssize_t count = (Py_ssize_t)ovoid_robot_get_variable_count(get(self));
    double *to = NULL;
    PyObject *array = array_make(state_of(self), RECORD_DOUBLE, 1, &count, &to);
    for (Py_ssize_t i = 0; array && i < count; i++) {
        ovoid_robot_variable v = ovoid_robot_get_variable(get(self), (size_t)i);
        to[i] = closure ? v.upper : v.lower;
    }
    return array_wrap(state_of(self), array);
}

static PyObject *get_fact(PyObject *self, void *closure) {
    PyObject *found = PyDict_GetItemString(((robot_object *)self)->facts, closure);
    return found ? Py_NewRef(found) : PyTuple_New(0);
}

static PyObject *get_facts(PyObject *self, PyObject *ignored) {
    (void)ignored;
    return PyDict_Copy(((robot_object *)self)->facts);
}

static PyObject *set_facts(PyObject *self, PyObject *facts) {
    if (!PyDict_Check(facts)) return PyErr_Format(PyExc_TypeError, "facts: a dict is wanted");
    PyObject *copy = PyDict_Copy(facts), *old = ((robot_object *)self)->facts;
    if (!copy) return NULL;
    ((robot_object *)self)->facts = copy;
    Py_DECREF(old);
    Py_RETURN_NONE;
}

static PyObject *get_fixed_mimics(PyObject *self, void *closure) {
    (void)closure;
    PyObject *found = PyDict_GetItemString(((robot_object *)self)->facts, "fixed_mimics");
    return found ? Py_NewRef(found) : PyLong_FromLong(0);
}

PyGetSetDef robot_fields[] = {
    {"name", get_name, NULL, "str | None: The robot's name, or None.", NULL},
    {"root", get_root, NULL, "str: The name of the link that is no joint's child.", NULL},
    {"links", get_links, NULL, "tuple[str, ...]: The links' names.", NULL},
    {"joints", get_joints, NULL, "tuple[Joint, ...]: The joints: Joint tuples.", NULL},
    {"variables", get_variables, NULL, "tuple[Variable, ...]: What the numbers of a state are: Variable tuples.", NULL},
    {"elements", get_elements, NULL, "tuple[Element, ...]: The parts of the links, shapes and solids: Element tuples.",
     NULL},
    {"disabled", get_disabled, NULL,
     "tuple[tuple[str, str, str | None], ...]: Pairs of links that are never queried: (a, b, reason), sorted.", NULL},
    {"lower", get_limits, NULL, "Floats: The variables' lower limits, an array; -inf where there is none.", NULL},
    {"upper", get_limits, NULL, "Floats: The variables' upper limits, an array; inf where there is none.", ""},
    {"groups", get_fact, NULL,
     "tuple[tuple[str, tuple[str, ...], tuple[str, ...]], ...]: Of an SRDF: (name, joints, links) of each group, "
     "names.",
     "groups"},
    {"end_effectors", get_fact, NULL,
     "tuple[tuple[str, str, str], ...]: Of an SRDF: (name, the link that carries it, the group of its links).",
     "end_effectors"},
    {"states", get_fact, NULL,
     "tuple[tuple[str, str, dict[str, tuple[float, ...]]], ...]: Of an SRDF: (name, group, {joint: numbers}) of each "
     "named state.",
     "states"},
    {"spheres", get_fact, NULL,
     "tuple[tuple[str, Vec3, float], ...]: Of an SRDF: (link, (x, y, z), radius), in the link's frame.", "spheres"},
    {"passive", get_fact, NULL, "tuple[str, ...]: Of an SRDF: the passive joints' names.", "passive"},
    {"meshes", get_fact, NULL, "tuple[dict[str, Any], ...]: Of a URDF: a dict for each mesh file at each scale.",
     "meshes"},
    {"ignored", get_fact, NULL, "tuple[tuple[str, int], ...]: Of the files: (where, how often) of what had no effect.",
     "ignored"},
    {"fixed_mimics", get_fixed_mimics, NULL, "int: Of a URDF: how many mimics stood on fixed joints and were dropped.",
     NULL},
    {NULL, NULL, NULL, NULL, NULL}};

// For pickle.
PyMethodDef robot_facts_methods[] = {
    {"_get_facts", get_facts, METH_NOARGS, NULL}, {"_set_facts", set_facts, METH_O, NULL}, {NULL, NULL, 0, NULL}};
