// The smooth bracket of the signed distance with its derivatives, and the gradient of the exact one.
#include "src/module.h"

typedef struct smooth_object {
    PyObject_HEAD ovoid_smooth smooth;
} smooth_object;

typedef struct smooth_value_object {
    PyObject_HEAD ovoid_smooth_value value;
} smooth_value_object;

typedef struct gradient_object {
    PyObject_HEAD ovoid_gradient gradient;
} gradient_object;

// ---- what is called

static PyObject *smooth(PyObject *module, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"a", "b", "pose_a", "pose_b", "order", NULL};
    module_state *state = state_of_module(module);
    PyObject *first, *second, *place_a = NULL, *place_b = NULL;
    int order = 1;
    ovoid_body a, b;
    ovoid_pair pair;
    if (!arguments_read(arguments, keywords, "OO|OO$i:smooth", names, &first, &second, &place_a, &place_b, &order) ||
        body_read(state, first, "a", &a) || body_read(state, second, "b", &b) ||
        pose_read(state, place_a, "pose_a", &pair.pose_a) || pose_read(state, place_b, "pose_b", &pair.pose_b))
        return NULL;
    if (!a.shape || !b.shape) {
        PyErr_SetString(PyExc_TypeError, "smooth: two Shapes are wanted; of Compounds and Solids ask part by part");
        return NULL;
    }
    if (order < 0 || order > 2)
        return raise_code(state, OVOID_ERROR_ARGUMENT, -1, "order: 0, 1 or 2 is wanted, not %d", order);
    pair.shape_a = a.shape;
    pair.shape_b = b.shape;
    smooth_object *made = object_make(state->smooth);
    if (!made) return NULL;
    made->smooth = ovoid_pair_compute_smooth(&pair, order);
    return (PyObject *)made;
}

static PyObject *gradient(PyObject *module, PyObject *given) {
    module_state *state = state_of_module(module);
    if (Py_TYPE(given) != state->answer) {
        PyErr_Format(PyExc_TypeError, "an Answer of distance or depth is wanted, not %R", (PyObject *)Py_TYPE(given));
        return NULL;
    }
    const answer_object *answer = (const answer_object *)given;
    if (Py_TYPE(answer->a) != state->shape || Py_TYPE(answer->b) != state->shape) {
        PyErr_SetString(PyExc_TypeError, "gradient: the Answer of two Shapes is wanted");
        return NULL;
    }
    ovoid_pair pair = {((shape_object *)answer->a)->shape, ((shape_object *)answer->b)->shape, answer->pose_a,
                       answer->pose_b};
    gradient_object *made = object_make(state->gradient);
    if (!made) return NULL;
    ovoid_cover cover = {.memory = NULL};
    made->gradient = ovoid_answer_compute_gradient(&pair, &answer->of.deciding, cover_unpack(answer->cover, &cover));
    return (PyObject *)made;
}

PyMethodDef smooth_methods[] = {
    {"smooth", METHOD_KEYWORDS(smooth), METH_VARARGS | METH_KEYWORDS,
     "smooth(a: Shape, b: Shape, pose_a: PoseLike = None, pose_b: PoseLike = None, *, order: Literal[0, 1, 2] = 1) -> "
     "Smooth\n--\n\nA smooth bracket of the signed distance of two Shapes, from their ellipsoids: outer.value <= d <= "
     "inner.value.\norder: 0 values, 1 gradients too, 2 Hessians too. Derivatives are by 12 numbers: the translation "
     "of a (world), its\nrotation vector (world axes, radians), those of b."},
    {"gradient", gradient, METH_O,
     "gradient(answer: Answer, /) -> Gradient\n--\n\nThe gradient of the exact signed distance, as far as the Answer "
     "of distance or depth shows it; numbers as in smooth."},
    {NULL, NULL, 0, NULL}};

// ---- the types

static PyObject *get_side(PyObject *self, void *closure) {
    smooth_value_object *made = object_make(state_of(self)->smooth_value);
    if (made) made->value = closure ? ((smooth_object *)self)->smooth.inner : ((smooth_object *)self)->smooth.outer;
    return (PyObject *)made;
}

static PyGetSetDef smooth_fields[] = {
    {"outer", get_side, NULL, "SmoothValue: Of the outer ellipsoids: value <= d.", NULL},
    {"inner", get_side, NULL, "SmoothValue: Of the inner ellipsoids: d <= value.", ""},
    {NULL, NULL, NULL, NULL, NULL}};
static PyType_Slot smooth_slots[] = {{Py_tp_doc, "outer.value <= d <= inner.value."},
                                     {Py_tp_dealloc, object_free},
                                     {Py_tp_getset, smooth_fields},
                                     {0, NULL}};
static PyType_Spec smooth_spec = {"ovoid.Smooth", sizeof(smooth_object), 0,
                                  Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION, smooth_slots};

static PyGetSetDef value_fields[] = {
    FIELD(smooth_value_object, DOUBLE, "value", value.value, "Proven, rounding included."),
    FIELD(smooth_value_object, DOUBLE, "error", value.error, "The ellipsoids' own distance is within this of value."),
    FIELD(smooth_value_object, DOUBLE, "condition", value.condition, "How much roundings grow in the gradient."),
    FIELD(smooth_value_object, BOOL, "is_smooth", value.is_smooth, "False: not known to be differentiable here."),
    FIELD(smooth_value_object, VEC3, "point_a", value.point_a, "The point of a's ellipsoid, world frame."),
    FIELD(smooth_value_object, VEC3, "point_b", value.point_b, "The point of b's ellipsoid, world frame."),
    FIELD(smooth_value_object, VEC3, "normal", value.normal, "Unit, from a to b, world frame."),
    FIELD(smooth_value_object, DOUBLES_12, "gradient", value.gradient, "(12,); zero where order is 0."),
    FIELD(smooth_value_object, DOUBLES_12_12, "hessian", value.hessian, "(12, 12); zero where order is below 2."),
    {NULL, NULL, NULL, NULL, NULL}};
static PyType_Slot value_slots[] = {{Py_tp_doc, "One side of the smooth bracket."},
                                    {Py_tp_dealloc, object_free},
                                    {Py_tp_getset, value_fields},
                                    {0, NULL}};
static PyType_Spec value_spec = {"ovoid.SmoothValue", sizeof(smooth_value_object), 0,
                                 Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION, value_slots};

static PyGetSetDef gradient_fields[] = {
    FIELD(gradient_object, DOUBLES_12, "gradient", gradient.gradient,
          "(12,): by translations and rotations of a and b."),
    FIELD(gradient_object, BOOL, "has_translation", gradient.has_translation, "That by translations is shown."),
    FIELD(gradient_object, BOOL, "has_rotation", gradient.has_rotation, "That by rotations is shown too."),
    FIELD(gradient_object, DOUBLE, "turn", gradient.turn, "Radians: how far the exact normal may be."),
    FIELD(gradient_object, DOUBLE, "slope", gradient.slope, "0: the witness points are not unique."),
    FIELD(gradient_object, DOUBLE, "slide", gradient.slide, "Length: how far the exact witness points may be."),
    FIELD(gradient_object, DOUBLE, "margin", gradient.margin, "Of a depth: every other way out is longer by this."),
    {NULL, NULL, NULL, NULL, NULL}};
static PyType_Slot gradient_slots[] = {{Py_tp_doc, "The gradient of the exact signed distance."},
                                       {Py_tp_dealloc, object_free},
                                       {Py_tp_getset, gradient_fields},
                                       {0, NULL}};
static PyType_Spec gradient_spec = {"ovoid.Gradient", sizeof(gradient_object), 0,
                                    Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION, gradient_slots};

int smooth_add(PyObject *module) {
    module_state *state = state_of_module(module);
    return type_add(module, &smooth_spec, &state->smooth) || type_add(module, &value_spec, &state->smooth_value) ||
           type_add(module, &gradient_spec, &state->gradient);
}
