// The records of an importer that is not trusted (io/stream.h), from a memory that it may have broken.
#include "fuzz.h"

#include <io/mesh/stream.h>

typedef struct bytes_left {
    const uint8_t *data;
    size_t size;
} bytes_left;

// In pieces, as a pipe would.
static ptrdiff_t read_bytes(void *context, void *buffer, size_t size) {
    bytes_left *left = context;
    size_t n = left->size < 100 ? left->size : 100;
    if (n > size) n = size;
    if (n) memcpy(buffer, left->data, n);
    left->data += n;
    left->size -= n;
    return (ptrdiff_t)n;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    ovoid_error error = {OVOID_OK, -1, ""};
    bytes_left left = {data, size};
    record_source source = {read_bytes, &left};
    mesh_reader reader = {.path = "records", .scale = 1, .parts = 1, .error = &error};
    reader.mesh = calloc(1, sizeof *reader.mesh);
    fuzz_require(reader.mesh != NULL);
    int ended;
    ovoid_code code = record_read_mesh(&reader, &source, &ended);
    if (ended && code) fuzz_require_error(&error);
    fuzz_require(ended || code != OVOID_OK);
    for (size_t i = 0; !code && i < ovoid_mesh_get_part_count(reader.mesh); i++)
        fuzz_walk_part(ovoid_mesh_get_part(reader.mesh, i));
    ovoid_mesh_destroy(reader.mesh);
    return 0;
}
