// Binary heaps (J. W. J. Williams, Algorithm 232: heapsort, 1964) over the items of an array that the caller owns. The
// functions are inlined into their callers, where size and order are constants, so the comparison is not a call.
#ifndef OVOID_TOOLS_HEAP_H
#define OVOID_TOOLS_HEAP_H

#include <stddef.h>
#include <string.h>

/// 1 if *a belongs above *b.
typedef int heap_order(const void *a, const void *b);

#define HEAP_INLINE static inline __attribute__((always_inline))

/// Adds an item to a heap of `count`; there must be room for it.
HEAP_INLINE void heap_push(void *items, size_t count, size_t size, const void *item, heap_order *is_above) {
    char *all = items;
    size_t at = count;
    for (size_t parent; at > 0 && is_above(item, all + (parent = (at - 1) / 2) * size); at = parent)
        memcpy(all + at * size, all + parent * size, size);
    memcpy(all + at * size, item, size);
}

/// Puts an item, which is not in the array, at `at` or below it, where the heap of `count` has a hole.
HEAP_INLINE void heap_sink(void *items, size_t count, size_t size, size_t at, const void *item, heap_order *is_above) {
    char *all = items;
    for (size_t child; (child = 2 * at + 1) < count; at = child) {
        if (child + 1 < count && is_above(all + (child + 1) * size, all + child * size)) child++;
        if (!is_above(all + child * size, item)) break;
        memcpy(all + at * size, all + child * size, size);
    }
    memcpy(all + at * size, item, size);
}

/// Moves the top of a heap of `count`, at least one, to *top; count - 1 items remain.
HEAP_INLINE void heap_pop(void *items, size_t count, size_t size, void *top, heap_order *is_above) {
    char *all = items;
    memcpy(top, all, size);
    if (count > 1) heap_sink(items, count - 1, size, 0, all + (count - 1) * size, is_above);
}

#endif
