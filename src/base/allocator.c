// The default allocator, and memory through any.
#if defined(__linux__)
#define _DEFAULT_SOURCE // madvise
#endif
#include "base/allocator.h"

#include <stdlib.h>
#if defined(_WIN32)
#include <malloc.h>
#endif
#if defined(__linux__)
#include <sys/mman.h>
#endif

// Large arrays of which scattered parts are read begin at a large page, and Linux is asked to use such pages for them:
// else most of these reads wait for the address of their page too. A refusal changes nothing. What is behind the last
// whole page is not touched, and so takes no memory.
#if defined(__linux__)
enum { LARGE_PAGE = 1 << 21 };

static void *allocate_array(size_t size) {
    size_t large = size / LARGE_PAGE * LARGE_PAGE;
    if (!large || size > SIZE_MAX - LARGE_PAGE) return aligned_alloc(64, size);
    void *memory = aligned_alloc(LARGE_PAGE, (size + LARGE_PAGE - 1) / LARGE_PAGE * LARGE_PAGE);
    if (memory) (void)madvise(memory, large, MADV_HUGEPAGE);
    return memory;
}
#elif !defined(_WIN32)
static void *allocate_array(size_t size) { return aligned_alloc(64, size); }
#endif

// Windows has an aligned_alloc of its own name, whose memory is not for free().
static void *allocate_aligned(void *context, size_t size) {
    (void)context;
    if (size > SIZE_MAX - 63) return NULL;
#if defined(_WIN32)
    return _aligned_malloc((size + 63) / 64 * 64, 64);
#else
    return allocate_array((size + 63) / 64 * 64);
#endif
}

static void release_aligned(void *context, void *memory) {
    (void)context;
#if defined(_WIN32)
    _aligned_free(memory);
#else
    free(memory);
#endif
}

ovoid_allocator allocator_make(const ovoid_allocator *given) {
    return given ? *given : (ovoid_allocator){allocate_aligned, release_aligned, NULL};
}

void *allocator_allocate(const ovoid_allocator *allocator, size_t count, size_t size) {
    if (size && count > SIZE_MAX / 2 / size) return NULL;
    size_t bytes = count * size;
    return allocator->allocate(allocator->context, bytes ? bytes : 1);
}

void allocator_release(const ovoid_allocator *allocator, void *memory) {
    if (memory) allocator->release(allocator->context, memory);
}
