// Working memory from a buffer of the caller's, and beyond it from another allocator.
#ifndef OVOID_BASE_ARENA_H
#define OVOID_BASE_ARENA_H

#include "ovoid/base.h"

/// A buffer that is handed out from its start, on one thread. What is released last returns to it at once, the rest
/// with the buffer.
typedef struct arena {
    ovoid_allocator beyond; ///< for what the buffer has no room for
    char *begin, *end;      ///< the buffer; begin is aligned to 64
    char *next;             ///< the first byte that is free
    char *last;             ///< what was handed out last; NULL: not known
} arena;

/// The arena's allocator, which borrows the arena. size: a multiple of 64. What is allocated through it must be
/// released through it before the buffer ends, as it may be memory of the other allocator.
ovoid_allocator arena_make(arena *a, const ovoid_allocator *beyond, void *buffer, size_t size);

#endif
