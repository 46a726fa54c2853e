// Merge sort from the bottom up: runs of 1, 2, 4, ... are merged until one is left. Stable, n log n, no recursion.
// Radix sort from the lowest byte (H. H. Seward, Information sorting in the application of electronic digital computers
// to business operations, 1954); bytes that are equal in all keys are skipped.
#include "polytope/sort.h"

#include <string.h>

// Two sorted runs that follow one another: the first ends at `middle`.
typedef struct two_runs {
    const uint32_t *from;
    uint32_t middle, count;
} two_runs;

static void merge(const two_runs *runs, uint32_t *to, index_order order) {
    const uint32_t *from = runs->from, middle = runs->middle, count = runs->count;
    for (uint32_t i = 0, j = middle, k = 0; k < count; k++) {
        int take_left = j >= count || (i < middle && order.compare(order.context, from[i], from[j]) <= 0);
        to[k] = take_left ? from[i++] : from[j++];
    }
}

void sort_indices(uint32_t *index, uint32_t *scratch, uint32_t count, index_order order) {
    for (uint64_t run = 1; run < count; run *= 2) {
        for (uint64_t start = 0; start < count; start += 2 * run) {
            uint32_t length = (uint32_t)(count - start < 2 * run ? count - start : 2 * run);
            uint32_t middle = (uint32_t)(run < length ? run : length);
            merge(&(two_runs){index + start, middle, length}, scratch + start, order);
        }
        memcpy(index, scratch, count * sizeof *index);
    }
}

// Radix sort is faster from this number of entries on.
enum { BYTES = 8, VALUES = 256, RADIX_LEAST = 256 };

// Short runs are sorted by insertion.
enum { RUN = 8 };

static void sort_run(sort_entry *entries, uint32_t count) {
    for (uint32_t i = 1; i < count; i++) {
        sort_entry entry = entries[i];
        uint32_t k = i;
        for (; k > 0 && entries[k - 1].key > entry.key; k--) entries[k] = entries[k - 1];
        entries[k] = entry;
    }
}

// Merges runs between the two arrays in turn. Returns the one that holds the result.
static sort_entry *merge_entries(sort_entry *from, sort_entry *to, uint32_t count) {
    for (uint32_t start = 0; start < count; start += RUN)
        sort_run(from + start, count - start < RUN ? count - start : RUN);
    for (uint32_t run = RUN; run < count; run *= 2) {
        for (uint32_t start = 0; start < count; start += 2 * run) {
            uint32_t i = start, middle = start + run < count ? start + run : count, j = middle;
            uint32_t end = middle + run < count ? middle + run : count;
            for (uint32_t k = start; k < end; k++)
                to[k] = j == end || (i < middle && from[i].key <= from[j].key) ? from[i++] : from[j++];
        }
        sort_entry *swapped = from;
        from = to;
        to = swapped;
    }
    return from;
}

// Returns the array that holds the result.
static sort_entry *sort_by_radix(sort_entry *entries, sort_entry *scratch, uint32_t count) {
    uint32_t places[BYTES][VALUES] = {{0}};
    for (uint32_t i = 0; i < count; i++)
        for (int byte = 0; byte < BYTES; byte++) places[byte][entries[i].key >> 8 * byte & (VALUES - 1)]++;
    sort_entry *from = entries, *to = scratch;
    for (int byte = 0; byte < BYTES; byte++) {
        uint32_t *place = places[byte], at = 0;
        if (count == 0 || place[from[0].key >> 8 * byte & (VALUES - 1)] == count) continue;
        for (int v = 0; v < VALUES; v++) {
            uint32_t here = place[v];
            place[v] = at;
            at += here;
        }
        for (uint32_t i = 0; i < count; i++) to[place[from[i].key >> 8 * byte & (VALUES - 1)]++] = from[i];
        sort_entry *swapped = from;
        from = to;
        to = swapped;
    }
    return from;
}

void sort_entries(sort_entry *entries, sort_entry *scratch, uint32_t count) {
    const sort_entry *sorted =
        count < RADIX_LEAST ? merge_entries(entries, scratch, count) : sort_by_radix(entries, scratch, count);
    if (sorted != entries) memcpy(entries, sorted, count * sizeof *entries);
}
