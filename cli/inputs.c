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

ovoid_shape *inputs_read_shape(const char *path, const read_settings *settings) {
    ovoid_error error;
    ovoid_read_options read = inputs_make_options(settings);
    ovoid_shape *shape = ovoid_shape_read_file(path, &read, NULL, &error);
    if (!shape) message_error("%s", error.message);
    return shape;
}

static int open_body(const char *path, const read_settings *settings, int parts, cli_body *body) {
    ovoid_error error;
    *body = (cli_body){NULL, NULL, NULL};
    if (!parts) {
        body->shape = inputs_read_shape(path, settings);
        return body->shape ? 0 : EXIT_INPUT;
    }
    ovoid_read_options read = inputs_make_options(settings);
    read.parts = 1;
    body->parts = ovoid_shapes_read_file(path, &read, NULL, &error);
    if (body->parts) body->compound = ovoid_shapes_create_compound(body->parts, NULL, &error);
    if (!body->compound) message_error("%s", error.message);
    return body->compound ? 0 : EXIT_INPUT;
}

int inputs_open_pair(const char *const paths[2], const read_settings *settings, int parts, cli_body bodies[2]) {
    bodies[1] = (cli_body){NULL, NULL, NULL};
    int code = open_body(paths[0], settings, parts, &bodies[0]);
    if (!code) code = open_body(paths[1], settings, parts, &bodies[1]);
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
    ovoid_shape_destroy(body->shape);
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
