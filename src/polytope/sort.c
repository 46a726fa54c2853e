// Indices: merge sort from the bottom up: runs of 1, 2, 4, ... are merged until one is left. Stable, n log n, no
// recursion. Entries: one distribution over slots; for many, or where that fails, radix sort from the lowest byte (H.
// H. Seward, Information sorting in the application of electronic digital computers to business operations, 1954);
// bytes that are equal in all keys are skipped.
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

// Entries are distributed up to this number, beyond it sorted by all bytes of their keys.
enum { BYTES = 8, VALUES = 256, DISTRIBUTED_MOST = 4096, SLOTS = 2048 };

// Sorts nearly sorted entries by insertion. 0 if they are not, after eight moves an entry.
static int insert_entries(sort_entry *entries, uint32_t count) {
    uint32_t left = 8 * count;
    for (uint32_t i = 1; i < count; i++) {
        sort_entry entry = entries[i];
        uint32_t k = i;
        for (; k > 0 && entries[k - 1].key > entry.key; k--) entries[k] = entries[k - 1];
        entries[k] = entry;
        if (i - k > left) return 0;
        left -= i - k;
    }
    return 1;
}

static uint32_t count_bits(uint64_t value) { return value ? 64 - (uint32_t)__builtin_clzll(value) : 0; }

// Distributes the entries over about as many slots as there are entries, by the leading bits of what their keys are
// above the least, and sorts the slots by insertion (E. J. Isaac, R. C. Singleton, Sorting by address calculation,
// 1956). 0 if most keys fall into few slots; `entries` is unchanged then.
static int distribute(const sort_entry *entries, sort_entry *to, uint32_t count) {
    uint64_t least = entries[0].key, most = least;
    for (uint32_t i = 1; i < count; i++) {
        least = entries[i].key < least ? entries[i].key : least;
        most = entries[i].key > most ? entries[i].key : most;
    }
    uint32_t places[SLOTS], slots = 16, at = 0;
    while (slots < count && slots < SLOTS) slots *= 2;
    uint32_t bits = count_bits(most - least), kept = count_bits(slots - 1), shift = bits > kept ? bits - kept : 0;
    memset(places, 0, slots * sizeof *places);
    for (uint32_t i = 0; i < count; i++) places[(entries[i].key - least) >> shift]++;
    for (uint32_t v = 0; v < slots; v++) {
        uint32_t here = places[v];
        places[v] = at;
        at += here;
    }
    for (uint32_t i = 0; i < count; i++) to[places[(entries[i].key - least) >> shift]++] = entries[i];
    return insert_entries(to, count);
}

// Returns the array that holds the result.
static sort_entry *sort_by_radix(sort_entry *entries, sort_entry *scratch, uint32_t count) {
    uint32_t places[BYTES][VALUES] = {{0}};
    for (uint32_t i = 0; i < count; i++)
        for (int byte = 0; byte < BYTES; byte++) places[byte][entries[i].key >> 8 * byte & (VALUES - 1)]++;
    sort_entry *from = entries, *to = scratch;
    for (int byte = 0; byte < BYTES; byte++) {
        uint32_t *place = places[byte], at = 0;
        if (place[from[0].key >> 8 * byte & (VALUES - 1)] == count) continue;
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
    if (count < 2) return;
    int is_done = count <= DISTRIBUTED_MOST && distribute(entries, scratch, count);
    const sort_entry *sorted = is_done ? scratch : sort_by_radix(entries, scratch, count);
    if (sorted != entries) memcpy(entries, sorted, count * sizeof *entries);
}
