// Scenes, beside an L that is closed and does not fill its hull, and one that is open: l.obj, open.obj.
#include "fuzz.h"

#include <ovoid/io.h>

static const char angle[] =
    "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 1\nv 2 0 1\nv 2 1 1\nv 1 1 1\nv 1 2 1\n"
    "v 0 2 1\nf 4 3 2\nf 4 2 1\nf 4 1 6\nf 4 6 5\nf 10 8 9\nf 10 7 8\nf 10 12 7\nf 10 11 12\nf 1 2 8 7\n"
    "f 2 3 9 8\nf 3 4 10 9\nf 4 5 11 10\nf 5 6 12 11\n";
static const char rest[] = "f 6 1 7 12\n";

static void write_meshes(void) {
    char all[sizeof angle + sizeof rest];
    int size = snprintf(all, sizeof all, "%s%s", angle, rest);
    (void)fuzz_write_file("l.obj", (const uint8_t *)all, (size_t)size);
    (void)fuzz_write_file("open.obj", (const uint8_t *)angle, sizeof angle - 1);
}

static void check_object(const ovoid_scene *scene, size_t i) {
    ovoid_scene_object o = ovoid_scene_get(scene, i);
    ovoid_body body = ovoid_scene_get_body(scene, i, &o.pose);
    fuzz_require(!o.shape != !o.compound);
    fuzz_require(!!body.shape + !!body.compound + !!body.solid == 1 && body.solid == o.solid);
    fuzz_require((o.kind == OVOID_MESH_SOLID || o.kind == OVOID_MESH_SURFACE) == (o.solid != NULL));
    fuzz_require(!o.is_asked || o.solid);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static int is_written;
    if (!is_written) write_meshes();
    is_written = 1;
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_scene *scene = ovoid_scene_read(fuzz_write_file("scene.json", data, size), NULL, &error);
    if (!scene) {
        fuzz_require_error(&error);
        return 0;
    }
    size_t count = ovoid_scene_get_count(scene);
    for (size_t i = 0; i < count; i++) {
        ovoid_scene_object object = ovoid_scene_get(scene, i);
        fuzz_require(object.name != NULL);
        check_object(scene, i);
        fuzz_require(ovoid_scene_find(scene, object.name) == i);
        fuzz_require(ovoid_pose_validate(&object.pose) == OVOID_OK);
        fuzz_require(ovoid_scene_is_ignored(scene, 0, i) == ovoid_scene_is_ignored(scene, i, 0));
    }
    ovoid_scene_destroy(scene);
    scene = ovoid_scene_read_hulls(fuzz_write_file("scene.json", data, size), NULL, &error);
    if (!scene) fuzz_require_error(&error);
    for (size_t i = 0; i < count && scene; i++) check_object(scene, i);
    ovoid_scene_destroy(scene);
    return 0;
}
