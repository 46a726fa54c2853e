// Packed scenes, as given and with the size and the checksum mended, without which little would get past them. What is
// read can be asked, written and read again, and written again it is the same file.
#include "fuzz.h"

#include "tools/checksum.h"

#include <ovoid/io.h>

// Where the header has the size of the file and the checksum, of all that is behind it.
enum { SIZE_AT = 16, CHECKSUM_AT = 24, CHECKED_AT = 32 };

static void check_scene(const ovoid_scene *scene) {
    size_t count = ovoid_scene_get_count(scene);
    for (size_t i = 0; i < count; i++) {
        ovoid_scene_object o = ovoid_scene_get(scene, i);
        ovoid_body body = ovoid_scene_get_body(scene, i, &o.pose);
        fuzz_require(o.name && o.name[0] && ovoid_scene_find(scene, o.name) == i);
        fuzz_require(ovoid_pose_validate(&o.pose) == OVOID_OK);
        fuzz_require(!!body.shape + !!body.compound + !!body.solid == 1 && body.solid == o.solid);
        fuzz_require(!o.is_asked || o.solid);
        fuzz_require(ovoid_scene_is_ignored(scene, 0, i) == ovoid_scene_is_ignored(scene, i, 0));
    }
    for (size_t i = 0; i < ovoid_scene_get_mesh_count(scene); i++) {
        ovoid_named_shape mesh = ovoid_scene_get_mesh(scene, i);
        fuzz_require(mesh.name && mesh.shape && (unsigned)mesh.convexity.kind <= OVOID_MESH_SURFACE);
    }
}

// The bytes of a file, which the caller frees.
static uint8_t *read_bytes(const char *path, size_t *size) {
    FILE *file = fopen(path, "rb");
    fuzz_require(file != NULL && fseek(file, 0, SEEK_END) == 0);
    *size = (size_t)ftell(file);
    uint8_t *data = malloc(*size + 1);
    fuzz_require(data != NULL && fseek(file, 0, SEEK_SET) == 0 && fread(data, 1, *size, file) == *size);
    (void)fclose(file); // it was read
    return data;
}

typedef ovoid_scene *read_scene(const char *path, const ovoid_shape_options *options, ovoid_error *error);

static void check_again(const ovoid_scene *scene, read_scene *read) {
    ovoid_error error = {OVOID_OK, -1, ""};
    char path[300];
    size_t size, size_again;
    (void)snprintf(path, sizeof path, "%s", fuzz_write_file("again.ovoids", (const uint8_t *)"", 0));
    fuzz_require(ovoid_scene_write(scene, path, &error) == OVOID_OK);
    uint8_t *first = read_bytes(path, &size);
    ovoid_scene *copy = read(path, NULL, &error);
    fuzz_require(copy != NULL);
    check_scene(copy);
    fuzz_require(ovoid_scene_write(copy, path, &error) == OVOID_OK);
    uint8_t *second = read_bytes(path, &size_again);
    fuzz_require(size == size_again && memcmp(first, second, size) == 0);
    free(first);
    free(second);
    ovoid_scene_destroy(copy);
}

static void try(const uint8_t *data, size_t size, read_scene *read) {
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_scene *scene = read(fuzz_write_file("scene.ovoids", data, size), NULL, &error);
    if (!scene) {
        fuzz_require_error(&error);
        return;
    }
    check_scene(scene);
    check_again(scene, read);
    ovoid_scene_destroy(scene);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    // Without the first bytes it is JSON, which another target has.
    if (size < 8 || memcmp(data, "\x89OVSCN\n\x1a", 8) != 0) return 0;
    try(data, size, ovoid_scene_read);
    // A whole file is one of words.
    if (size < CHECKED_AT || size % 8) return 0;
    uint8_t *mended = malloc(size);
    fuzz_require(mended != NULL);
    memcpy(mended, data, size);
    memcpy(mended + SIZE_AT, &(uint64_t){size}, 8);
    memcpy(mended + CHECKSUM_AT, &(uint64_t){checksum_words(mended + CHECKED_AT, size - CHECKED_AT)}, 8);
    try(mended, size, ovoid_scene_read);
    try(mended, size, ovoid_scene_read_hulls);
    free(mended);
    return 0;
}
