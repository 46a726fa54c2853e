// A pool gives memory from blocks that double in size up to a limit; an item that is larger has a block of its own.
// Cost: constant an item.
#include "robot/read/text/pool.h"

#include <stdlib.h>
#include <string.h>

enum { ALIGNMENT = 16, BLOCK_LEAST = 1 << 12, BLOCK_MOST = 1 << 20 };

typedef struct pool_block {
    struct pool_block *next;
    size_t size; ///< of the bytes
    // aligned by malloc and by being 16 bytes in
    char bytes[];
} pool_block;

_Static_assert(sizeof(pool_block) % ALIGNMENT == 0, "a block's bytes are aligned");

static pool_block *add_block(pool *p, size_t needed) {
    size_t size = p->blocks ? 2 * p->blocks->size : BLOCK_LEAST;
    if (size > BLOCK_MOST) size = BLOCK_MOST;
    if (size < needed) size = needed;
    pool_block *block = calloc(1, sizeof *block + size);
    if (!block) return NULL;
    block->next = p->blocks;
    block->size = size;
    p->blocks = block;
    p->used = 0;
    return block;
}

void *pool_get(pool *p, size_t count, size_t size) {
    if (size && count > SIZE_MAX / 4 / size) return NULL;
    size_t needed = (count * size + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    if (!needed) needed = ALIGNMENT;
    if ((!p->blocks || p->blocks->size - p->used < needed) && !add_block(p, needed)) return NULL;
    void *item = p->blocks->bytes + p->used;
    p->used += needed;
    return item;
}

char *pool_copy(pool *p, const char *text, size_t length) {
    char *copy = pool_get(p, length + 1, 1);
    if (copy && length) memcpy(copy, text, length);
    return copy;
}

void pool_clear(pool *p) {
    for (pool_block *block = p->blocks; block;) {
        pool_block *next = block->next;
        free(block);
        block = next;
    }
    *p = (pool){NULL, 0};
}

static int compare_entries(const void *a, const void *b) {
    const name_entry *m = a, *n = b;
    int order = strcmp(m->name, n->name);
    return order ? order : (m->index > n->index) - (m->index < n->index);
}

size_t name_index_sort(name_index *names) {
    if (names->count) qsort(names->entries, names->count, sizeof *names->entries, compare_entries);
    for (size_t i = 1; i < names->count; i++)
        if (strcmp(names->entries[i - 1].name, names->entries[i].name) == 0) return i;
    return names->count;
}

uint32_t name_index_find(const name_index *names, const char *name) {
    size_t low = 0, high = names->count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (strcmp(names->entries[middle].name, name) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    int is_found = low < names->count && strcmp(names->entries[low].name, name) == 0;
    return is_found ? names->entries[low].index : UINT32_MAX;
}
