// Binary heaps (J. W. J. Williams, Algorithm 232: heapsort, 1964) over the items of an array that the caller owns. The
// functions are inlined into their callers, where size and order are constants, so the comparison is not a call.
#ifndef OVOID_TOOLS_HEAP_H
#define OVOID_TOOLS_HEAP_H

#include <stddef.h>
#include <string.h>

/// 1 if *a belongs above *b.
typedef int heap_order(const void *a, const void *b);

#define HEAP_INLINE static inline __attribute__((always_inline))

/// A heap in an array of `count` items, `size` bytes each.
typedef struct heap {
    void *items;
    size_t count, size;
    heap_order *is_above;
} heap;

/// Adds an item; there must be room for it.
HEAP_INLINE void heap_push(heap h, const void *item) {
    char *all = h.items;
    size_t at = h.count;
    for (size_t parent; at > 0 && h.is_above(item, all + (parent = (at - 1) / 2) * h.size); at = parent)
        memcpy(all + at * h.size, all + parent * h.size, h.size);
    memcpy(all + at * h.size, item, h.size);
}

/// Puts an item, which is not in the array, at `at` or below it, where the heap has a hole.
HEAP_INLINE void heap_sink(heap h, size_t at, const void *item) {
    char *all = h.items;
    for (size_t child; (child = 2 * at + 1) < h.count; at = child) {
        if (child + 1 < h.count && h.is_above(all + (child + 1) * h.size, all + child * h.size)) child++;
        if (!h.is_above(all + child * h.size, item)) break;
        memcpy(all + at * h.size, all + child * h.size, h.size);
    }
    memcpy(all + at * h.size, item, h.size);
}

/// Moves the top of a heap of at least one item to *top; count - 1 items remain.
HEAP_INLINE void heap_pop(heap h, void *top) {
    char *all = h.items;
    memcpy(top, all, h.size);
    h.count--;
    if (h.count > 0) heap_sink(h, 0, all + h.count * h.size);
}

/// Places that are sorted in place: of one array, or of arrays side by side. is_after: 1 if what is at place i comes
/// behind what is at k.
typedef struct heap_places {
    void *items;
    int (*is_after)(const void *items, size_t i, size_t k);
    void (*exchange)(void *items, size_t i, size_t k);
} heap_places;

HEAP_INLINE void heap_sift(const heap_places *p, size_t at, size_t count) {
    for (size_t child; (child = 2 * at + 1) < count; at = child) {
        if (child + 1 < count && p->is_after(p->items, child + 1, child)) child++;
        if (!p->is_after(p->items, child, at)) return;
        p->exchange(p->items, child, at);
    }
}

/// Sorts `count` places, without memory.
HEAP_INLINE void heap_sort(const heap_places *p, size_t count) {
    for (size_t i = count / 2; i-- > 0;) heap_sift(p, i, count);
    while (count > 1) {
        p->exchange(p->items, 0, --count);
        heap_sift(p, 0, count);
    }
}

#endif
