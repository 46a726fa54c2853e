// What pictures and pages of bodies are made of: a picture as SVG, and an answer as a line of results
// (docs/formats.md). ovoid/_draw.py and _page.py call these.
#ifdef OVOID_PYTHON_IO
#include "src/query.h"

#include <ovoid/io.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

// ---- texts

// What `write` writes as a string, or an exception. The stream is in memory.
typedef ovoid_code writer(FILE *file, void *context, ovoid_error *error);

static PyObject *write_text(module_state *state, writer *write, void *context) {
    char *text = NULL;
    size_t size = 0;
    ovoid_error error = {.code = OVOID_OK};
    FILE *file = open_memstream(&text, &size);
    if (!file) return PyErr_NoMemory();
    ovoid_code code;
    Py_BEGIN_ALLOW_THREADS;
    code = write(file, context, &error);
    if (fclose(file) != 0 && code == OVOID_OK) code = error.code = OVOID_ERROR_MEMORY;
    Py_END_ALLOW_THREADS;
    PyObject *made = code == OVOID_OK ? PyUnicode_DecodeUTF8(text, (Py_ssize_t)size, "replace") : NULL;
    if (code != OVOID_OK) raise_error(state, &error);
    free(text);
    return made;
}

// ---- pictures

/// A picture with the memory of its parts.
typedef struct picture_input {
    ovoid_picture picture;
    ovoid_picture_options options;
    ovoid_picture_body *bodies;
    ovoid_picture_link *links;
    ovoid_faces *faces; ///< of each body, where it is a solid
    uint32_t **memory;  ///< of these faces
} picture_input;

static void clear_input(picture_input *in) {
    for (size_t i = 0; in->memory && i < in->picture.body_count; i++) free(in->memory[i]);
    free(in->memory);
    free(in->faces);
    free(in->bodies);
    free(in->links);
}

// The triangles of a solid, in memory to be freed; NULL where it is out.
static uint32_t *make_faces(const ovoid_solid *solid, ovoid_faces *to) {
    ovoid_solid_report report = ovoid_solid_get_report(solid);
    size_t count = (size_t)report.triangles;
    uint32_t *indices = malloc((4 * count + 1) * sizeof *indices), *sizes = indices ? indices + 3 * count : NULL;
    for (size_t t = 0; indices && t < count; t++) {
        ovoid_solid_get_triangle(solid, t, indices + 3 * t);
        sizes[t] = 3;
    }
    *to = (ovoid_faces){ovoid_solid_get_points(solid), (size_t)report.points, indices, sizes, count};
    return indices;
}

// A body: (shape, solid or None, pose, name or None, group). A solid is drawn, and the shape is its hull.
static int read_body(module_state *state, PyObject *from, picture_input *in, size_t i) {
    ovoid_picture_body *to = &in->bodies[i];
    PyObject *shape, *solid, *pose;
    int group;
    if (!PyArg_ParseTuple(from, "O!OO!zi", state->shape, &shape, &solid, state->pose, &pose, &to->name, &group))
        return -1;
    to->shape = ((shape_object *)shape)->shape;
    to->pose = ((pose_object *)pose)->pose;
    to->group = (uint32_t)group;
    if (Py_TYPE(solid) != state->solid) return 0;
    const ovoid_solid *of = ((solid_object *)solid)->solid;
    if (!(in->memory[i] = make_faces(of, &in->faces[i]))) return PyErr_NoMemory(), -1;
    to->mesh = &in->faces[i];
    to->is_mesh = ovoid_solid_get_report(of).is_closed ? OVOID_PICTURE_CLOSED : 1;
    return 0;
}

// A link: (body, body, Answer).
static int read_link(module_state *state, PyObject *from, ovoid_picture_link *to) {
    PyObject *answer;
    Py_ssize_t a, b;
    if (!PyArg_ParseTuple(from, "nnO!", &a, &b, state->answer, &answer)) return -1;
    *to = (ovoid_picture_link){(size_t)a, (size_t)b, &((answer_object *)answer)->of.deciding};
    return 0;
}

static int read_lists(module_state *state, PyObject *bodies, PyObject *links, picture_input *in) {
    size_t count = (size_t)PyTuple_Size(bodies), link_count = (size_t)PyTuple_Size(links);
    in->bodies = calloc(count + 1, sizeof *in->bodies);
    in->faces = calloc(count + 1, sizeof *in->faces);
    in->memory = calloc(count + 1, sizeof *in->memory);
    in->links = calloc(link_count + 1, sizeof *in->links);
    if (!in->bodies || !in->faces || !in->memory || !in->links) return PyErr_NoMemory(), -1;
    in->picture.bodies = in->bodies;
    in->picture.links = in->links;
    in->picture.body_count = count;
    in->picture.link_count = link_count;
    for (size_t i = 0; i < count; i++)
        if (read_body(state, PyTuple_GetItem(bodies, (Py_ssize_t)i), in, i)) return -1;
    for (size_t i = 0; i < link_count; i++)
        if (read_link(state, PyTuple_GetItem(links, (Py_ssize_t)i), &in->links[i])) return -1;
    return 0;
}

static ovoid_code write_picture(FILE *file, void *context, ovoid_error *error) {
    const picture_input *in = context;
    return ovoid_picture_write_stream(file, &in->picture, &in->options, error);
}

static PyObject *draw(PyObject *module, PyObject *arguments) {
    PyObject *bodies, *links, *made = NULL;
    picture_input in = {.bodies = NULL};
    ovoid_picture_options *o = &in.options;
    if (!PyArg_ParseTuple(arguments, "O!O!zzII(ddd)I", &PyTuple_Type, &bodies, &PyTuple_Type, &links, &in.picture.title,
                          &in.picture.unit, &o->width, &o->height, &o->view.x, &o->view.y, &o->view.z, &o->layers))
        return NULL;
    module_state *state = state_of_module(module);
    if (!read_lists(state, bodies, links, &in)) made = write_text(state, write_picture, &in);
    clear_input(&in);
    return made;
}

// ---- answers

static ovoid_mesh_kind get_kind(const module_state *state, PyObject *body) {
    if (Py_TYPE(body) == state->compound) return OVOID_MESH_PARTS;
    if (Py_TYPE(body) != state->solid) return OVOID_MESH_HULL;
    return ovoid_solid_get_report(((solid_object *)body)->solid).is_closed ? OVOID_MESH_SOLID : OVOID_MESH_SURFACE;
}

static ovoid_code write_record(FILE *file, void *context, ovoid_error *error) {
    ovoid_code code = ovoid_record_write_json(file, context);
    *error = (ovoid_error){.code = code, .place = -1};
    PyOS_snprintf(error->message, sizeof error->message, "%s",
                  code == OVOID_ERROR_LIMIT ? "the answer's proof is too long for a line of results"
                                            : "the line of results could not be written");
    return code;
}

static PyObject *write_answer(PyObject *module, PyObject *given) {
    module_state *state = state_of_module(module);
    if (Py_TYPE(given) != state->answer) {
        PyErr_Format(PyExc_TypeError, "an Answer is wanted, not %R", (PyObject *)Py_TYPE(given));
        return NULL;
    }
    const answer_object *answer = (const answer_object *)given;
    int has_parts_a = Py_TYPE(answer->a) == state->compound, has_parts_b = Py_TYPE(answer->b) == state->compound;
    ovoid_cover cover = {.memory = NULL};
    ovoid_record record = {.a = "a",
                           .b = "b",
                           .fields = OVOID_RECORD_PARTS,
                           .frame = NAN,
                           .answer = answer->of.deciding,
                           .cover = cover_unpack(answer->cover, &cover),
                           .exclusions = answer->exclusions,
                           .exclusion_count = answer->exclusion_count,
                           .kind_a = get_kind(state, answer->a),
                           .kind_b = get_kind(state, answer->b),
                           .mesh_a = {.mesh_volume = NAN, .hull_volume = NAN},
                           .mesh_b = {.mesh_volume = NAN, .hull_volume = NAN}};
    if (Py_TYPE(answer->a) == state->solid || Py_TYPE(answer->b) == state->solid)
        ovoid_record_set_solid(&record, &answer->of);
    record.part_a = has_parts_a ? answer->of.part_a : OVOID_RECORD_NO_PART;
    record.part_b = has_parts_b ? answer->of.part_b : OVOID_RECORD_NO_PART;
    return write_text(state, write_record, &record);
}

PyMethodDef draw_methods[] = {
    {"_draw", draw, METH_VARARGS, NULL}, {"_write_answer", write_answer, METH_O, NULL}, {NULL, NULL, 0, NULL}};
#else
typedef int nothing_to_draw; // ISO C wants a declaration
#endif
