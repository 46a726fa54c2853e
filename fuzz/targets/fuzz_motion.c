// Motions of a scene.
#include "fuzz.h"

#include <ovoid/io.h>

#include <math.h>

static const char scene_text[] = "{\"objects\":[{\"name\":\"a\",\"sphere\":1},{\"name\":\"b, c\",\"sphere\":1}]}";

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    ovoid_error error = {OVOID_OK, -1, ""};
    const void *text = scene_text;
    ovoid_scene *scene = ovoid_scene_read(fuzz_write_file("motion.json", text, sizeof scene_text - 1), NULL, &error);
    fuzz_require(scene != NULL);
    ovoid_motion_reader *reader = ovoid_motion_reader_open(fuzz_write_file("motion.csv", data, size), scene, &error);
    ovoid_motion_line line;
    double time = -INFINITY;
    int got = reader ? 1 : -1;
    while (got == 1 && (got = ovoid_motion_reader_read(reader, &line, &error)) == 1) {
        fuzz_require(line.body < 2 && line.time >= time && isfinite(line.time));
        fuzz_require(ovoid_pose_validate(&line.pose) == OVOID_OK);
        time = line.time;
    }
    if (got < 0) fuzz_require_error(&error);
    ovoid_motion_reader_close(reader);
    ovoid_scene_destroy(scene);
    return 0;
}
