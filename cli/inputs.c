// Reading shapes, lists and scenes; each failure becomes one message and the caller's exit code 3.
#include "inputs.h"

#include "message.h"

#include <string.h>

ovoid_read_options inputs_make_options(const read_settings *settings) {
    static const char *const units[] = {"m", "cm", "mm", "in", "ft"};
    double scale = settings->scale > 0 ? settings->scale : 1;
    if (settings->unit != INPUTS_NO_UNIT) scale *= ovoid_unit_get_scale(units[settings->unit]);
    return (ovoid_read_options){.scale = scale};
}

ovoid_shape *inputs_read_shape(const char *path, const read_settings *settings) {
    ovoid_error error;
    ovoid_read_options read = inputs_make_options(settings);
    ovoid_shape *shape = ovoid_shape_read_file(path, &read, NULL, &error);
    if (!shape) message_error("%s", error.message);
    return shape;
}

int inputs_read_pair(const char *const paths[2], const read_settings *settings, ovoid_shape *shapes[2]) {
    shapes[1] = NULL;
    shapes[0] = inputs_read_shape(paths[0], settings);
    if (shapes[0]) shapes[1] = inputs_read_shape(paths[1], settings);
    if (shapes[1]) return 0;
    ovoid_shape_destroy(shapes[0]);
    return EXIT_INPUT;
}

ovoid_scene *inputs_read_scene(const char *path) {
    ovoid_error error;
    ovoid_scene *scene = ovoid_scene_read(path, NULL, &error);
    if (!scene) message_error("%s", error.message);
    return scene;
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
