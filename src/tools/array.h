// Arrays that grow by doubling, from malloc. Code with a caller's allocator sizes its arrays first instead.
#ifndef OVOID_TOOLS_ARRAY_H
#define OVOID_TOOLS_ARRAY_H

#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

/// Makes room for one more item of `size` bytes in an array of `count`; NULL is an empty array of capacity 0. 0 if
/// memory runs out: the array is unchanged.
static inline int array_reserve(void **items, size_t *capacity, size_t count, size_t size) {
    if (count < *capacity) return 1;
    if (*capacity > SIZE_MAX / 4 / size) return 0;
    size_t grown = *capacity ? 2 * *capacity : 16;
    void *moved = realloc(*items, grown * size);
    if (!moved) return 0;
    *items = moved;
    *capacity = grown;
    return 1;
}

#endif
