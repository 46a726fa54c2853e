// Merge sort from the bottom up: runs of 1, 2, 4, ... are merged until one is left. Stable, n log n, no recursion.
#include "polytope/sort.h"

#include <string.h>

static void merge(const uint32_t *from, uint32_t middle, uint32_t count, uint32_t *to, index_order order,
                  const void *context) {
    for (uint32_t i = 0, j = middle, k = 0; k < count; k++) {
        int take_left = j >= count || (i < middle && order(context, from[i], from[j]) <= 0);
        to[k] = take_left ? from[i++] : from[j++];
    }
}

void sort_indices(uint32_t *index, uint32_t *scratch, uint32_t count, index_order order, const void *context) {
    for (uint64_t run = 1; run < count; run *= 2) {
        for (uint64_t start = 0; start < count; start += 2 * run) {
            uint32_t length = (uint32_t)(count - start < 2 * run ? count - start : 2 * run);
            uint32_t middle = (uint32_t)(run < length ? run : length);
            merge(index + start, middle, length, scratch + start, order, context);
        }
        memcpy(index, scratch, count * sizeof *index);
    }
}
