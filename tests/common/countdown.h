// An allocator whose k-th allocation fails: for each k, a function must return MEMORY and hold nothing.
#ifndef OVOID_TESTS_COUNTDOWN_H
#define OVOID_TESTS_COUNTDOWN_H

#include "ovoid/base.h"

#include <stdlib.h>

/// How many more allocations succeed, and how many are held.
typedef struct countdown {
    long left, held;
} countdown;

static inline void *countdown_allocate(void *context, size_t size) {
    countdown *c = (countdown *)context;
    if (c->left-- <= 0) return NULL;
    c->held++;
    return aligned_alloc(64, (size + 63) / 64 * 64);
}

static inline void countdown_release(void *context, void *memory) {
    ((countdown *)context)->held--;
    free(memory);
}

/// The allocator of a countdown, which must outlive what it allocates.
static inline ovoid_allocator countdown_make_allocator(countdown *c) {
    ovoid_allocator allocator = {countdown_allocate, countdown_release, c};
    return allocator;
}

#endif
