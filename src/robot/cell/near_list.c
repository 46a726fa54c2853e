// The order of near pairs. Keys of 16 bytes are sorted, by merging; items and rows, which are longer, move along
// the cycles of the permutation, once.
#include "robot/cell/near_list.h"

#include "tools/heap.h"

static int is_before(near_key a, near_key b) { return a.lower < b.lower || (a.lower == b.lower && a.found < b.found); }

// ---- the farthest of those that are kept

// The farthest belongs above.
static int is_farther(const void *a, const void *b) { return is_before(*(const near_key *)b, *(const near_key *)a); }

static void sink(near_key *keys, size_t count, size_t at) {
    near_key moved = keys[at];
    heap_sink((heap){keys, count, sizeof moved, is_farther}, at, &moved);
}

uint32_t near_list_find_slot(near_list *list, double lower) {
    uint32_t found = (uint32_t)list->found++;
    if (list->kept < list->capacity) {
        list->keys[list->kept] = (near_key){lower, found, (uint32_t)list->kept};
        return (uint32_t)list->kept++;
    }
    if (list->capacity == 0) return NEAR_LIST_FULL;
    for (size_t i = list->is_heap ? 0 : list->kept / 2; i-- > 0;) sink(list->keys, list->kept, i);
    list->is_heap = 1;
    if (!(lower < list->keys[0].lower)) return NEAR_LIST_FULL;
    list->keys[0] = (near_key){lower, found, list->keys[0].slot};
    uint32_t slot = list->keys[0].slot;
    sink(list->keys, list->kept, 0);
    return slot;
}

// ---- the order

// Two sorted runs, from[0 .. middle) and from[middle .. count), become one.
static void merge(const near_key *from, size_t middle, size_t count, near_key *to) {
    size_t a = 0, b = middle;
    while (a < middle && b < count) {
        int takes_b = is_before(from[b], from[a]);
        *to++ = from[takes_b ? b : a];
        b += (size_t)takes_b, a += (size_t)!takes_b;
    }
    while (a < middle) *to++ = from[a++];
    while (b < count) *to++ = from[b++];
}

static void sort_keys(near_list *list) {
    size_t n = list->kept;
    for (size_t width = 1; width < n; width *= 2) {
        for (size_t at = 0; at < n; at += 2 * width) {
            size_t count = n - at < 2 * width ? n - at : 2 * width;
            merge(list->keys + at, width < count ? width : count, count, list->scratch + at);
        }
        near_key *sorted = list->scratch;
        list->scratch = list->keys;
        list->keys = sorted;
    }
}

static double *get_row(const near_list *list, uint32_t slot) { return list->gradients + slot * list->variables; }

static void copy_row(const near_list *list, const double *from, double *to) {
    for (size_t i = 0; i < list->variables; i++) to[i] = from[i];
}

// What belongs at `begin` is moved there, what belongs where that was is moved there, and so on, until what was at
// `begin` has its place.
static void run_cycle(near_list *list, uint32_t begin) {
    ovoid_robot_near first = list->items[begin];
    uint32_t at = begin;
    if (list->gradients) copy_row(list, get_row(list, begin), list->row);
    for (uint32_t next = list->keys[at].slot; next != begin; next = list->keys[at].slot) {
        list->items[at] = list->items[next];
        if (list->gradients) copy_row(list, get_row(list, next), get_row(list, at));
        list->keys[at].slot = at;
        at = next;
    }
    list->items[at] = first;
    if (list->gradients) copy_row(list, list->row, get_row(list, at));
    list->keys[at].slot = at;
}

void near_list_sort(near_list *list) {
    sort_keys(list);
    for (uint32_t i = 0; i < list->kept; i++)
        if (list->keys[i].slot != i) run_cycle(list, i);
}
