// The file of the targets whose readers want a path, and the body of the mesh targets.
#define _POSIX_C_SOURCE 200809L
#include "fuzz.h"

#include <ovoid/io.h>

#include <math.h>
#include <unistd.h>

static char folder[64], path[128];

static void remove_folder(void) {
    (void)unlink(path);
    (void)rmdir(folder);
}

const char *fuzz_write_file(const char *name, const uint8_t *data, size_t size) {
    if (!folder[0]) {
        // In memory where there is such a folder: the disk is the slowest part.
        (void)snprintf(folder, sizeof folder, "/dev/shm/ovoid-fuzz-XXXXXX");
        if (!mkdtemp(folder)) {
            (void)snprintf(folder, sizeof folder, "/tmp/ovoid-fuzz-XXXXXX");
            fuzz_require(mkdtemp(folder) != NULL);
        }
        (void)atexit(remove_folder);
    }
    (void)snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "wb");
    fuzz_require(file != NULL);
    fuzz_require(fwrite(data, 1, size, file) == size);
    fuzz_require(fclose(file) == 0);
    return path;
}

void fuzz_walk_part(ovoid_mesh_part part) {
    fuzz_require(part.name != NULL);
    for (size_t i = 0; i < 3 * part.faces.vertex_count; i++) fuzz_require(isfinite(part.faces.vertices[i]));
    const uint32_t *index = part.faces.indices;
    for (size_t i = 0; i < part.faces.face_count; i++)
        for (uint32_t k = 0; k < part.faces.sizes[i]; k++) fuzz_require(*index++ < part.faces.vertex_count);
}

int fuzz_mesh(const char *name, const uint8_t *data, size_t size) {
    const char *file = fuzz_write_file(name, data, size);
    for (int parts = 0; parts < 2; parts++) {
        ovoid_error error = {OVOID_OK, -1, ""};
        ovoid_read_options options = {.parts = parts};
        ovoid_mesh *mesh = ovoid_mesh_read(file, &options, &error);
        if (!mesh) {
            fuzz_require_error(&error);
            continue;
        }
        size_t count = ovoid_mesh_get_part_count(mesh);
        fuzz_require(count >= 1);
        for (size_t i = 0; i < count; i++) fuzz_walk_part(ovoid_mesh_get_part(mesh, i));
        ovoid_mesh_destroy(mesh);
    }
    return 0;
}
