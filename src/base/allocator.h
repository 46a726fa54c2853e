// Memory from the caller's allocator, or from malloc if none is given.
#ifndef OVOID_BASE_ALLOCATOR_H
#define OVOID_BASE_ALLOCATOR_H

#include "ovoid/base.h"

/// The allocator given, or the default one for NULL.
ovoid_allocator allocator_make(const ovoid_allocator *given);

/// Room for count items of size bytes, 64-byte aligned, not cleared; NULL if there is none or the product overflows.
void *allocator_allocate(const ovoid_allocator *allocator, size_t count, size_t size);

/// Releases what allocator_allocate returned; NULL is allowed.
void allocator_release(const ovoid_allocator *allocator, void *memory);

#endif
