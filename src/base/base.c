// Version, names of codes, errors, the default allocator, the assert hook.
#include "base/allocator.h"
#include "base/error.h"

#include <fenv.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#if defined(_WIN32)
#include <malloc.h>
#endif

#define TEXT_OF(x) #x
#define TEXT(x) TEXT_OF(x)

const char *ovoid_get_version(void) {
    return TEXT(OVOID_VERSION_MAJOR) "." TEXT(OVOID_VERSION_MINOR) "." TEXT(OVOID_VERSION_PATCH);
}

const char *ovoid_code_get_name(ovoid_code code) {
    switch (code) {
    case OVOID_OK: return "ok";
    case OVOID_ERROR_MEMORY: return "out of memory";
    case OVOID_ERROR_ARGUMENT: return "bad argument";
    case OVOID_ERROR_NOT_FINITE: return "not finite";
    case OVOID_ERROR_EMPTY: return "empty";
    case OVOID_ERROR_RANGE: return "out of range";
    case OVOID_ERROR_RADIUS: return "bad radius";
    case OVOID_ERROR_ROTATION: return "not a rotation";
    case OVOID_ERROR_INDEX: return "bad index";
    case OVOID_ERROR_NOT_CONVEX: return "not convex";
    case OVOID_ERROR_HULL: return "hull failed";
    case OVOID_ERROR_FORMAT: return "bad format";
    case OVOID_ERROR_FILE: return "file error";
    case OVOID_ERROR_LIMIT: return "limit exceeded";
    case OVOID_ERROR_PROOF: return "proof does not hold";
    }
    return "unknown code";
}

void error_write(ovoid_error *error, ovoid_code code, int64_t place, const char *format, ...) {
    if (!error) return;
    error->code = code;
    error->place = place;
    // Some C libraries print numbers by long doubles, which raise flags of the x87's own.
    fenv_t before;
    (void)fegetenv(&before);
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(error->message, sizeof error->message, format, arguments);
    va_end(arguments);
    (void)fesetenv(&before);
}

// Windows has an aligned_alloc of its own name, whose memory is not for free().
static void *allocate_aligned(void *context, size_t size) {
    (void)context;
    if (size > SIZE_MAX - 63) return NULL;
#if defined(_WIN32)
    return _aligned_malloc((size + 63) / 64 * 64, 64);
#else
    return aligned_alloc(64, (size + 63) / 64 * 64);
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
    if (size && count > SIZE_MAX / size) return NULL;
    size_t bytes = count * size;
    return allocator->allocate(allocator->context, bytes ? bytes : 1);
}

void allocator_release(const ovoid_allocator *allocator, void *memory) {
    if (memory) allocator->release(allocator->context, memory);
}

static ovoid_assert_hook assert_hook;

void ovoid_set_assert_hook(ovoid_assert_hook hook) { assert_hook = hook; }

void assert_fail(const char *expression, const char *file, int line) {
    if (assert_hook) assert_hook(expression, file, line);
    abort();
}
