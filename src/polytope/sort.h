// Stable sorting of indices: merge sort from the bottom up (J. von Neumann, 1945).
#ifndef OVOID_POLYTOPE_SORT_H
#define OVOID_POLYTOPE_SORT_H

#include <stdint.h>

/// The order of indices. compare: negative where a comes before b.
typedef struct index_order {
    int (*compare)(const void *context, uint32_t a, uint32_t b);
    const void *context;
} index_order;

/// Sorts `count` indices; scratch has room for as many. Cost: n log n.
void sort_indices(uint32_t *index, uint32_t *scratch, uint32_t count, index_order order);

/// A key and its index.
typedef struct sort_entry {
    uint64_t key;
    uint32_t index;
} sort_entry;

/// Sorts by ascending keys, stably; scratch has room for as many. Cost: linear.
void sort_entries(sort_entry *entries, sort_entry *scratch, uint32_t count);

#endif
