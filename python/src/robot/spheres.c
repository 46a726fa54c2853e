// Spheres that stand for a link: how far they are from covering it, and spheres that are proven to.
//
// A sphere is four numbers, its centre in the link's frame and its radius; the library's struct is those.
#include "src/robot/robot.h"

#include <ovoid/robot_spheres.h>

#include <stdlib.h>

static PyObject *make_bracket(ovoid_robot_bracket b) { return Py_BuildValue("(dd)", b.lower, b.upper); }

static PyObject *audit_spheres(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"link", "spheres", "tolerance", "depth_cells", "volume_cells", "without_volumes", NULL};
    robot_object *self = (robot_object *)object;
    module_state *state = state_of(object);
    PyObject *link_given, *given;
    ovoid_robot_audit_options o = {0};
    Py_ssize_t depth_cells = 0, volume_cells = 0;
    uint32_t link;
    items spheres;
    if (!arguments_read(arguments, keywords, "OO|$dnnp:audit_spheres", names, &link_given, &given, &o.tolerance,
                        &depth_cells, &volume_cells, &o.without_volumes) ||
        link_read(self, link_given, &link))
        return NULL;
    if (depth_cells < 0 || volume_cells < 0)
        return raise_code(state, OVOID_ERROR_ARGUMENT, -1, "numbers of cells are >= 0");
    if (items_read(state, given, "spheres", 2, (Py_ssize_t[]){-1, 4}, 'd', &spheres)) return NULL;
    o.depth_cells = (size_t)depth_cells;
    o.volume_cells = (size_t)volume_cells;
    ovoid_robot_sphere_audit audit;
    ovoid_error error;
    interrupt signals;
    o.watch = interrupt_begin(&signals);
    ovoid_code code = ovoid_robot_compute_sphere_audit(
        &(ovoid_robot_sphere_model){self->robot, link, spheres.data, (size_t)spheres.shape[0]}, &o, &audit, &error);
    int is_raised = interrupt_end(&signals);
    free(spheres.data);
    if (is_raised) return NULL;
    if (code != OVOID_OK) return raise_error(state, &error);
    return PyObject_CallFunction(state->sphere_audit, "NNIINNNNn", make_bracket(audit.depth), vec3_make(audit.point),
                                 audit.element, audit.sphere, make_bracket(audit.uncovered), make_bracket(audit.excess),
                                 make_bracket(audit.link), make_bracket(audit.spheres), (Py_ssize_t)audit.cells);
}

static PyObject *cover_spheres(PyObject *object, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"link", "count", "excess", "rounds", "seed", NULL};
    robot_object *self = (robot_object *)object;
    module_state *state = state_of(object);
    PyObject *link_given;
    Py_ssize_t count, rounds = 0;
    unsigned long long seed = 0;
    ovoid_robot_cover_options o = {0};
    uint32_t link;
    if (!arguments_read(arguments, keywords, "On|$dnK:cover_spheres", names, &link_given, &count, &o.excess, &rounds,
                        &seed) ||
        link_read(self, link_given, &link))
        return NULL;
    if (count < 1 || count > 4096 || rounds < 0)
        return raise_code(state, OVOID_ERROR_ARGUMENT, -1, "count: 1 to 4096 are wanted; rounds >= 0");
    o.rounds = (size_t)rounds;
    o.seed = seed;
    void *spheres = calloc((size_t)count, 4 * sizeof(double));
    if (!spheres) return PyErr_NoMemory();
    ovoid_robot_sphere_cover cover = {.link = link, .spheres = spheres, .capacity = (size_t)count};
    ovoid_error error;
    interrupt signals;
    o.watch = interrupt_begin(&signals);
    ovoid_code code = ovoid_robot_compute_sphere_cover(self->robot, &o, &cover, &error);
    PyObject *array = NULL;
    if (!interrupt_end(&signals))
        array = code == OVOID_OK
                    ? array_copy(state, RECORD_DOUBLE, 2, (Py_ssize_t[]){(Py_ssize_t)cover.count, 4}, spheres)
                    : raise_error(state, &error);
    free(spheres);
    return array ? Py_BuildValue("N(dd)", array, cover.depth.lower, cover.depth.upper) : NULL;
}

// ---- a robot of spheres

// (link, (x, y, z), radius), as robot.spheres has them.
static int read_sphere(robot_object *self, PyObject *from, ovoid_robot_link_sphere *to) {
    PyObject *link, *center;
    if (!PyTuple_Check(from)) {
        PyErr_Format(PyExc_TypeError, "spheres: tuples (link, (x, y, z), radius) are wanted, not %R",
                     (PyObject *)Py_TYPE(from));
        return -1;
    }
    if (!PyArg_ParseTuple(from, "OOd;spheres: (link, (x, y, z), radius) is wanted", &link, &center, &to->ball.radius) ||
        link_read(self, link, &to->link))
        return -1;
    return vec3_read(state_of((PyObject *)self), center, "centre of a sphere", &to->ball.center);
}

static void destroy_robot(PyObject *owner) { ovoid_robot_destroy(PyCapsule_GetPointer(owner, "robot")); }

// The robot that owns its shapes is kept by them; the Robot borrows them from it.
static PyObject *wrap_owner(PyTypeObject *type, ovoid_robot *made, const ovoid_error *why) {
    if (!made) return raise_error(state_of_type((PyObject *)type), why);
    PyObject *owner = PyCapsule_New(made, "robot", destroy_robot);
    if (!owner) {
        ovoid_robot_destroy(made);
        return NULL;
    }
    ovoid_error error;
    ovoid_robot_description d = ovoid_robot_get_description(made);
    PyObject *shapes = robot_shapes_make(state_of_type((PyObject *)type), &d, owner);
    PyObject *robot =
        shapes ? robot_wrap(type, ovoid_robot_create(&d, NULL, &error), shapes, PyDict_New(), &error) : NULL;
    Py_DECREF(owner);
    return robot;
}

static PyObject *with_spheres(PyObject *object, PyObject *given) {
    robot_object *self = (robot_object *)object;
    PyObject *list = PySequence_Tuple(given), *made = NULL;
    if (!list) return NULL;
    Py_ssize_t count = PyTuple_Size(list), read = 0;
    ovoid_robot_link_sphere *spheres = malloc((size_t)(count + 1) * sizeof *spheres);
    if (!spheres) PyErr_NoMemory();
    while (spheres && read < count && !read_sphere(self, PyTuple_GetItem(list, read), &spheres[read])) read++;
    if (spheres && read == count) {
        ovoid_error error;
        ovoid_robot *robot = ovoid_robot_create_from_spheres(
            self->robot, &(ovoid_robot_link_spheres){spheres, (size_t)count}, NULL, &error);
        made = wrap_owner(Py_TYPE(object), robot, &error);
    }
    free(spheres);
    Py_DECREF(list);
    return made;
}

PyMethodDef robot_spheres_methods[] = {
    {"with_spheres", with_spheres, METH_O,
     "with_spheres(spheres: Sequence[tuple[LinkLike, Numbers, float]], /) -> Robot\n--\n\nThe Robot with spheres in "
     "the place of its elements: (link, (x, y, z), radius) each, centre in the link's frame, as\n.spheres has them. A "
     "link that no sphere is of has no elements."},
    {"audit_spheres", METHOD_KEYWORDS(audit_spheres), METH_VARARGS | METH_KEYWORDS,
     "audit_spheres(link: LinkLike, spheres: Numbers, *, tolerance: float = 0, depth_cells: int = 0, volume_cells: int "
     "= 0, without_volumes: bool = False) -> SphereAudit\n--\n\nHow far spheres, (n, 4) of centre (link's frame) and "
     "radius, are from covering a link: a SphereAudit of brackets."},
    {"cover_spheres", METHOD_KEYWORDS(cover_spheres), METH_VARARGS | METH_KEYWORDS,
     "cover_spheres(link: LinkLike, count: int, *, excess: float = 0, rounds: int = 0, seed: int = 0) -> "
     "tuple[Floats, tuple[float, float]]\n--\n\nAt most count spheres that are proven to cover a link: an array (n, "
     "4), and the bracket of the deepest uncovered\npoint's depth, whose upper end is at most 0. excess > 0: the "
     "fewest spheres of which none stands out by more."},
    {NULL, NULL, 0, NULL}};
