// Memory that is given back at once: what a file holds lives as long as the file's object. Also texts, joined and
// printed, and indices of names.
#ifndef OVOID_ROBOT_READ_TEXT_POOL_H
#define OVOID_ROBOT_READ_TEXT_POOL_H

#include "io/text.h"

/// Blocks of memory, the newest first. All zero is an empty pool.
typedef struct pool {
    struct pool_block *blocks;
    size_t used; ///< of the newest block
} pool;

/// Cleared memory for count items of size bytes, aligned for any of them; NULL where there is none.
void *pool_get(pool *p, size_t count, size_t size);
/// A copy of length bytes, terminated; NULL where there is no memory.
char *pool_copy(pool *p, const char *text, size_t length);
/// Frees all of it.
void pool_clear(pool *p);

/// A name and what it is the name of.
typedef struct name_entry {
    const char *name;
    uint32_t index;
} name_entry;

/// Names in order: found by halving, so that no choice of names makes it slow, as one could of a hash table.
typedef struct name_index {
    name_entry *entries;
    size_t count;
} name_index;

/// Sorts the entries, equal names by their index. Returns the place of the first entry whose name an earlier one has
/// too, or count.
size_t name_index_sort(name_index *names);
/// The index of the (first) entry of that name, or UINT32_MAX.
uint32_t name_index_find(const name_index *names, const char *name);

#endif
