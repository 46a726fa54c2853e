// A buffer as an allocator.
#include "base/arena.h"

#include "base/allocator.h"

#include <stdint.h>

static void *allocate(void *context, size_t size) {
    arena *a = context;
    if (size > (size_t)(a->end - a->next)) return a->beyond.allocate(a->beyond.context, size);
    a->last = a->next;
    a->next += (size + 63) / 64 * 64;
    return a->last;
}

static void release(void *context, void *memory) {
    arena *a = context;
    char *given = memory;
    if ((uintptr_t)given < (uintptr_t)a->begin || (uintptr_t)given >= (uintptr_t)a->end)
        a->beyond.release(a->beyond.context, memory);
    else if (given == a->last)
        a->next = given, a->last = NULL;
}

ovoid_allocator arena_make(arena *a, const ovoid_allocator *beyond, void *buffer, size_t size) {
    *a = (arena){*beyond, buffer, (char *)buffer + size, buffer, NULL};
    return (ovoid_allocator){allocate, release, a};
}
