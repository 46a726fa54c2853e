// Sorting pairs of indices.
#ifndef OVOID_WORLD_TREE_RADIX_SORT_H
#define OVOID_WORLD_TREE_RADIX_SORT_H

#include <stddef.h>
#include <stdint.h>

/// Ascending order; scratch has room for as many keys. Radix sort from the lowest byte (H. H. Seward, 1954); bytes that
/// are equal in all keys are skipped. Cost: linear.
void radix_sort(uint64_t *keys, uint64_t *scratch, size_t count);

#endif
