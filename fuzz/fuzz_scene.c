// Scenes.
#include "fuzz.h"

#include <ovoid/io.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_scene *scene = ovoid_scene_read(fuzz_write_file("scene.json", data, size), NULL, &error);
    if (!scene) {
        fuzz_require_error(&error);
        return 0;
    }
    size_t count = ovoid_scene_get_count(scene);
    for (size_t i = 0; i < count; i++) {
        ovoid_scene_object object = ovoid_scene_get(scene, i);
        fuzz_require(object.name != NULL && object.shape != NULL);
        fuzz_require(ovoid_scene_find(scene, object.name) == i);
        fuzz_require(ovoid_pose_compute_check(&object.pose) == OVOID_OK);
        fuzz_require(ovoid_scene_is_ignored(scene, 0, i) == ovoid_scene_is_ignored(scene, i, 0));
    }
    ovoid_scene_destroy(scene);
    return 0;
}
