// Exclusions: their memory, their order, and the search for one by its ranges.
#include "body/exclusions.h"

#include "base/allocator.h"
#include "exact/cover_memory.h"
#include "tools/heap.h"

#include <string.h>

enum { FIRST_CAPACITY = 64 };

void exclusions_begin(ovoid_exclusions *exclusions) {
    if (!exclusions) return;
    exclusions->count = 0;
    cover_clear(exclusions->cover);
}

void exclusions_grow(ovoid_exclusions *exclusions) {
    ovoid_allocator allocator = allocator_make(exclusions->allocator);
    size_t capacity = exclusions->capacity ? 2 * exclusions->capacity : FIRST_CAPACITY;
    ovoid_exclusion *items = allocator_allocate(&allocator, capacity, sizeof *items);
    if (!items) return;
    if (exclusions->count) memcpy(items, exclusions->items, exclusions->count * sizeof *items);
    allocator_release(&allocator, exclusions->items);
    exclusions->items = items;
    exclusions->capacity = capacity;
}

void ovoid_exclusions_release(ovoid_exclusions *exclusions) {
    if (!exclusions || !exclusions->grows) return;
    ovoid_allocator allocator = allocator_make(exclusions->allocator);
    allocator_release(&allocator, exclusions->items);
    exclusions->items = NULL;
    exclusions->capacity = exclusions->count = 0;
}

static int compare(const ovoid_exclusion *a, const ovoid_exclusion *b) {
    if (a->first_a != b->first_a) return a->first_a < b->first_a ? -1 : 1;
    if (a->end_a != b->end_a) return a->end_a < b->end_a ? -1 : 1;
    if (a->first_b != b->first_b) return a->first_b < b->first_b ? -1 : 1;
    return a->end_b < b->end_b ? -1 : a->end_b > b->end_b;
}

static int is_later(const void *a, const void *b) { return compare(a, b) > 0; }

// Heap sort: J. W. J. Williams, Algorithm 232, 1964.
static void sort(ovoid_exclusion *items, size_t count) {
    for (size_t i = count / 2; i-- > 0;) {
        ovoid_exclusion moved = items[i];
        heap_sink((heap){items, count, sizeof moved, is_later}, i, &moved);
    }
    for (size_t end = count; end-- > 1;) {
        ovoid_exclusion last = items[end];
        items[end] = items[0];
        heap_sink((heap){items, end, sizeof last, is_later}, 0, &last);
    }
}

void exclusions_finish(ovoid_exclusions *exclusions) {
    if (exclusions && exclusions->count <= exclusions->capacity) sort(exclusions->items, exclusions->count);
}

int exclusions_have(const ovoid_exclusions *exclusions, const ovoid_exclusion *wanted) {
    size_t low = 0, high = exclusions->count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        int order = compare(&exclusions->items[middle], wanted);
        if (order == 0) return 1;
        if (order < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return 0;
}
