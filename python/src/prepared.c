// Prepared: a shape at a pose, prepared once for those who ask about it many times.
#include "src/prepared.h"

static PyObject *prepared_new(PyTypeObject *type, PyObject *arguments, PyObject *keywords) {
    static char *names[] = {"shape", "pose", NULL};
    module_state *state = state_of_type((PyObject *)type);
    PyObject *shape, *given = NULL;
    ovoid_posed_shape body;
    if (!arguments_read(arguments, keywords, "O|O:Prepared", names, &shape, &given) ||
        pose_read(state, given, "pose", &body.pose))
        return NULL;
    if (Py_TYPE(shape) != state->shape)
        return PyErr_Format(PyExc_TypeError, "shape: a Shape is wanted, not %R", (PyObject *)Py_TYPE(shape));
    prepared_object *self = object_make(type);
    if (!self) return NULL;
    body.shape = ((shape_object *)shape)->shape;
    self->shape = Py_NewRef(shape);
    ovoid_prepared_shape_make(&body, &self->of);
    return (PyObject *)self;
}

static void prepared_dealloc(PyObject *object) {
    Py_XDECREF(((prepared_object *)object)->shape);
    object_free(object);
}

static PyGetSetDef fields[] = {FIELD_PYTHON(prepared_object, "Shape", "shape", shape, "The Shape."),
                               FIELD(prepared_object, POSE, "pose", of.body.pose, "Its Pose."),
                               {NULL, NULL, NULL, NULL, NULL}};
static PyType_Slot slots[] = {
    {Py_tp_doc, "Prepared(shape: Shape, pose: PoseLike = None) -> Prepared\n--\n\nA Shape at a pose, prepared once to "
                "be asked about many times: collide(prepared_a, prepared_b), and so within,\ndistance, depth, without "
                "poses. The answers have the bits of the same queries of Shapes. Immutable."},
    {Py_tp_new, prepared_new},
    {Py_tp_dealloc, prepared_dealloc},
    {Py_tp_getset, fields},
    {0, NULL}};
static PyType_Spec spec = {"ovoid.Prepared", sizeof(prepared_object), 0, Py_TPFLAGS_DEFAULT, slots};

int prepared_add(PyObject *module) { return type_add(module, &spec, &state_of_module(module)->prepared); }
