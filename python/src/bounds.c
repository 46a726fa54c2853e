// What is known of two shapes without a search: the bracket of their ellipsoids, and the gap along a direction.
#include "src/module.h"

// Two shapes at their poses, from the arguments that all queries begin with.
static int read_pair(module_state *state, PyObject *const given[4], ovoid_pair *pair) {
    ovoid_body a, b;
    if (body_read(state, given[0], "a", &a) || body_read(state, given[1], "b", &b) ||
        pose_read(state, given[2], "pose_a", &pair->pose_a) || pose_read(state, given[3], "pose_b", &pair->pose_b))
        return -1;
    pair->shape_a = a.shape;
    pair->shape_b = b.shape;
    if (a.shape && b.shape) return 0;
    PyErr_SetString(PyExc_TypeError, "two Shapes are wanted; of Compounds and Solids ask part by part");
    return -1;
}

static PyObject *bounds(PyObject *module, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"a", "b", "pose_a", "pose_b", NULL};
    module_state *state = state_of_module(module);
    PyObject *given[4] = {NULL, NULL, NULL, NULL};
    ovoid_pair pair;
    if (!arguments_read(arguments, keywords, "OO|OO:bounds", names, &given[0], &given[1], &given[2], &given[3]) ||
        read_pair(state, given, &pair))
        return NULL;
    answer_object *to = answer_make(state, given[0], given[1], &pair.pose_a, &pair.pose_b);
    if (!to) return NULL;
    ovoid_answer answer = ovoid_pair_compute_bounds(&pair);
    to->of = ovoid_body_answer_make(&answer, 0, 0);
    if (!limit_raise(state, to->of.limit, QUERY_REFUSED)) return (PyObject *)to;
    Py_DECREF((PyObject *)to);
    return NULL;
}

static PyObject *gap(PyObject *module, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"a", "b", "pose_a", "pose_b", "direction", NULL};
    module_state *state = state_of_module(module);
    PyObject *given[4] = {NULL, NULL, NULL, NULL}, *direction_given = NULL;
    ovoid_pair pair;
    ovoid_vec3 direction;
    if (!arguments_read(arguments, keywords, "OO|OO$O:gap", names, &given[0], &given[1], &given[2], &given[3],
                        &direction_given) ||
        read_pair(state, given, &pair))
        return NULL;
    if (!direction_given) return PyErr_Format(PyExc_TypeError, "gap() needs direction=");
    if (vec3_read(state, direction_given, "direction", &direction)) return NULL;
    return PyFloat_FromDouble(ovoid_pair_compute_gap(&pair, direction));
}

PyMethodDef bounds_methods[] = {
    {"bounds", METHOD_KEYWORDS(bounds), METH_VARARGS | METH_KEYWORDS,
     "bounds(a: Shape, b: Shape, pose_a: PoseLike = None, pose_b: PoseLike = None) -> Answer\n--\n\nThe bracket of the "
     "signed distance from the ellipsoids of two Shapes alone, without a search: an Answer whose\nbracket is wide."},
    {"gap", METHOD_KEYWORDS(gap), METH_VARARGS | METH_KEYWORDS,
     "gap(a: Shape, b: Shape, pose_a: PoseLike = None, pose_b: PoseLike = None, *, direction: Numbers) -> "
     "float\n--\n\nThe gap of two Shapes along a direction from a to b (world frame, any length but zero): a proven "
     "lower bound of\nthe signed distance; -inf where the direction is refused."},
    {NULL, NULL, 0, NULL}};
