#include "io/scene/scene_bytes.h"

#include <stdlib.h>
#include <string.h>

void scene_bytes_add(scene_bytes *b, const void *from, size_t size) {
    if (b->is_failed || !size) return;
    if (b->capacity - b->length < size) {
        size_t capacity = 2 * b->capacity + size + 256;
        char *grown = realloc(b->data, capacity);
        b->is_failed = !grown;
        if (!grown) return;
        b->data = grown;
        b->capacity = capacity;
    }
    memcpy(b->data + b->length, from, size);
    b->length += size;
}
