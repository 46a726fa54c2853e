// Sorting pairs of indices.
#ifndef OVOID_WORLD_TREE_RADIX_SORT_H
#define OVOID_WORLD_TREE_RADIX_SORT_H

#include <stddef.h>
#include <stdint.h>

/// Ascending; scratch has room for as many. Radix sort from the lowest byte (H. H. Seward, 1954); bytes that are the
/// same in all keys are passed over. Cost: linear.
void radix_sort(uint64_t *keys, uint64_t *scratch, size_t count);

#endif
