// Bytes that grow.
#ifndef OVOID_IO_SCENE_SCENE_BYTES_H
#define OVOID_IO_SCENE_SCENE_BYTES_H

#include <stddef.h>

typedef struct scene_bytes {
    char *data; ///< the caller frees it
    size_t length, capacity;
    int is_failed; ///< there was no memory: what was added since is missing
} scene_bytes;

void scene_bytes_add(scene_bytes *b, const void *from, size_t size);

#endif
