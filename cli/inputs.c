// Reading shapes, lists and scenes; each failure becomes one message and the caller's exit code 3.
#include "inputs.h"

#include "message.h"

#include <stdlib.h>
#include <string.h>

const char *inputs_get_unit(const read_settings *settings) {
    static const char *const units[] = {"m", "cm", "mm", "um", "in", "ft"};
    return settings->unit == INPUTS_NO_UNIT ? "" : units[settings->unit];
}

ovoid_read_options inputs_make_options(const read_settings *settings) {
    const char *unit = inputs_get_unit(settings);
    return (ovoid_read_options){.scale = settings->scale, .unit = unit[0] ? unit : NULL};
}

void inputs_warn_nonconvex(const char *path, const char *part, const ovoid_convexity *c) {
    if (!c->is_nonconvex) return;
    message_warning("%s%s%s is not convex and counts as its hull, of which it is %.3g %% (%.6g of %.6g); for the mesh "
                    "itself decompose it (CoACD, V-HACD), then --parts, or \"parts\": true in a scene",
                    path, *part ? ": " : "", part, 100 * c->mesh_volume / c->hull_volume, c->mesh_volume,
                    c->hull_volume);
}

/// Most warnings about the meshes of one list or scene.
#define WARNINGS_MAX 10

/// Warns of the meshes of a list or a scene, each name once.
static void warn_all(size_t count, ovoid_named_shape (*get)(const void *context, size_t i), const void *context) {
    const char *named[WARNINGS_MAX];
    size_t warned = 0, left_out = 0;
    for (size_t i = 0; i < count; i++) {
        ovoid_named_shape mesh = get(context, i);
        size_t k = 0;
        if (!mesh.convexity.is_nonconvex) continue;
        while (k < warned && strcmp(named[k], mesh.name) != 0) k++;
        left_out += k == WARNINGS_MAX;
        if (k < warned || k == WARNINGS_MAX) continue;
        named[warned++] = mesh.name;
        inputs_warn_nonconvex(mesh.name, "", &mesh.convexity);
    }
    if (left_out) message_warning("%zu more meshes are not convex and count as their hulls", left_out);
}

static ovoid_named_shape get_shape(const void *context, size_t i) { return ovoid_shapes_get(context, i); }
static ovoid_named_shape get_mesh(const void *context, size_t i) { return ovoid_scene_get_mesh(context, i); }

void inputs_warn_body(const char *path, const cli_body *body) {
    for (size_t i = 0; i < ovoid_shapes_get_count(body->parts); i++) {
        ovoid_named_shape part = ovoid_shapes_get(body->parts, i);
        inputs_warn_nonconvex(path, body->compound ? part.name : "", &part.convexity);
    }
}

void inputs_warn_list(const ovoid_shapes *shapes) { warn_all(ovoid_shapes_get_count(shapes), get_shape, shapes); }
void inputs_warn_scene(const ovoid_scene *scene) { warn_all(ovoid_scene_get_mesh_count(scene), get_mesh, scene); }

int inputs_open_body(const char *path, const read_settings *settings, int parts, cli_body *body) {
    ovoid_error error;
    *body = (cli_body){NULL, NULL, NULL};
    ovoid_read_options read = inputs_make_options(settings);
    read.parts = parts;
    body->parts = ovoid_shapes_read_file(path, &read, NULL, &error);
    if (body->parts && parts) body->compound = ovoid_shapes_create_compound(body->parts, NULL, &error);
    if (body->parts && !parts) body->shape = ovoid_shapes_get(body->parts, 0).shape;
    if (!body->shape && !body->compound) {
        message_error("%s", error.message);
        inputs_close_body(body);
        return EXIT_INPUT;
    }
    return 0;
}

int inputs_open_pair(const char *const paths[2], const read_settings *settings, int parts, cli_body bodies[2]) {
    bodies[1] = (cli_body){NULL, NULL, NULL};
    int code = inputs_open_body(paths[0], settings, parts, &bodies[0]);
    if (!code) code = inputs_open_body(paths[1], settings, parts, &bodies[1]);
    if (!code) return 0;
    inputs_close_body(&bodies[0]);
    inputs_close_body(&bodies[1]);
    return code;
}

ovoid_body inputs_get_body(const cli_body *body, const ovoid_pose *pose) {
    return (ovoid_body){body->shape, body->compound, *pose};
}

void inputs_close_body(cli_body *body) {
    ovoid_compound_destroy(body->compound);
    ovoid_shapes_destroy(body->parts);
    *body = (cli_body){NULL, NULL, NULL};
}

ovoid_scene *inputs_read_scene(const char *path) {
    ovoid_error error;
    ovoid_scene *scene = ovoid_scene_read(path, NULL, &error);
    if (!scene) message_error("%s", error.message);
    return scene;
}

ovoid_pose *inputs_copy_poses(const ovoid_scene *scene) {
    size_t count = ovoid_scene_get_count(scene);
    ovoid_pose *poses = malloc((count + 1) * sizeof *poses);
    if (!poses) message_error("out of memory");
    for (size_t i = 0; i < count && poses; i++) poses[i] = ovoid_scene_get(scene, i).pose;
    return poses;
}

ovoid_shapes *inputs_read_list(const char *path, const read_settings *settings) {
    ovoid_error error;
    ovoid_read_options read = inputs_make_options(settings);
    ovoid_shapes *shapes = ovoid_shapes_read_list(path, &read, NULL, &error);
    if (!shapes) message_error("%s", error.message);
    return shapes;
}

int inputs_is_scene(const char *path) {
    size_t length = strlen(path);
    return length > 5 && strcmp(path + length - 5, ".json") == 0;
}
