// Exclusions: their order, and the search for one by its ranges.
#include "body/exclusions.h"

void exclusions_begin(ovoid_exclusions *exclusions) {
    if (!exclusions) return;
    exclusions->count = 0;
    ovoid_cover *cover = exclusions->cover;
    if (cover) cover->point_count = cover->triangle_count = 0;
}

static int compare(const ovoid_exclusion *a, const ovoid_exclusion *b) {
    if (a->first_a != b->first_a) return a->first_a < b->first_a ? -1 : 1;
    if (a->end_a != b->end_a) return a->end_a < b->end_a ? -1 : 1;
    if (a->first_b != b->first_b) return a->first_b < b->first_b ? -1 : 1;
    return a->end_b < b->end_b ? -1 : a->end_b > b->end_b;
}

// Sifts the heap's item at `at` down. Heap sort: J. W. J. Williams, Algorithm 232, 1964.
static void sink(ovoid_exclusion *items, size_t at, size_t count) {
    ovoid_exclusion x = items[at];
    for (size_t child; (child = 2 * at + 1) < count; at = child) {
        if (child + 1 < count && compare(&items[child], &items[child + 1]) < 0) child++;
        if (compare(&x, &items[child]) >= 0) break;
        items[at] = items[child];
    }
    items[at] = x;
}

static void sort(ovoid_exclusion *items, size_t count) {
    for (size_t i = count / 2; i-- > 0;) sink(items, i, count);
    for (size_t end = count; end-- > 1;) {
        ovoid_exclusion last = items[end];
        items[end] = items[0];
        items[0] = last;
        sink(items, 0, end);
    }
}

void exclusions_finish(ovoid_exclusions *exclusions) {
    if (exclusions && exclusions->count <= exclusions->capacity) sort(exclusions->items, exclusions->count);
}

int exclusions_have(const ovoid_exclusions *all, const ovoid_exclusion *wanted) {
    size_t low = 0, high = all->count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        int order = compare(&all->items[middle], wanted);
        if (order == 0) return 1;
        if (order < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return 0;
}
