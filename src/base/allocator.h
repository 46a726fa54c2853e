// Memory from the caller's allocator, or from malloc if none is given.
#ifndef OVOID_BASE_ALLOCATOR_H
#define OVOID_BASE_ALLOCATOR_H

#include "ovoid/base.h"

/// The allocator given, or the default one for NULL.
ovoid_allocator allocator_make(const ovoid_allocator *given);

/// Room for count items of size bytes, 64-byte aligned, not cleared; NULL if there is none or the product is above half
/// of SIZE_MAX.
void *allocator_allocate(const ovoid_allocator *allocator, size_t count, size_t size);

/// The next 64-byte boundary after an array of a block that begins at one; SIZE_MAX where the sizes are above half of
/// it: that stays so, and nothing of that size is allocated.
static inline size_t allocator_end_array(size_t begin, size_t count, size_t size) {
    if (begin > SIZE_MAX / 2 || count > (SIZE_MAX / 2 - begin) / size) return SIZE_MAX;
    return (begin + count * size + 63) / 64 * 64;
}

/// Releases what allocator_allocate returned; NULL is allowed.
void allocator_release(const ovoid_allocator *allocator, void *memory);

#endif
