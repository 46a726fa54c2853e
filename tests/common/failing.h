// Allocations that fail: the linker replaces the functions of the C library by these (--wrap), in the programs that
// tests/CMakeLists.txt names, and the k-th allocation of an operation fails, for every k.
#ifndef OVOID_TESTS_FAILING_H
#define OVOID_TESTS_FAILING_H

#include "check.h"

#include "ovoid/base.h"

static long countdown; // allocations until one fails; 0: none fails
static long failures;

static int must_fail(void) {
    if (countdown == 0 || --countdown > 0) return 0;
    failures++;
    return 1;
}

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *memory, size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *memory, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);

void *__wrap_malloc(size_t size) { return must_fail() ? NULL : __real_malloc(size); }
void *__wrap_calloc(size_t count, size_t size) { return must_fail() ? NULL : __real_calloc(count, size); }
void *__wrap_realloc(void *memory, size_t size) { return must_fail() ? NULL : __real_realloc(memory, size); }
void *__wrap_aligned_alloc(size_t alignment, size_t size) {
    return must_fail() ? NULL : __real_aligned_alloc(alignment, size);
}

/// Runs with the first, second, ... allocation failing, until none fails. is_lax: for jansson's reader only requires
/// that the text is refused, or that the missing memory had no effect: it reports missing memory as a shorter text or a
/// syntax error.
static inline void check_operation(const char *name, int is_lax, int (*run)(ovoid_error *error)) {
    ovoid_error error = {OVOID_OK, -1, ""};
    countdown = 0;
    if (!CHECK(run(&error))) printf("  %s: %s\n", name, error.message);
    for (long k = 1; k < 100000; k++) {
        error = (ovoid_error){OVOID_OK, -1, ""};
        failures = 0;
        countdown = k;
        int succeeded = run(&error);
        countdown = 0;
        if (!failures) {
            CHECK(succeeded && k > 1);
            return;
        }
        int is_said = is_lax ? succeeded || error.code != OVOID_OK : !succeeded && error.code == OVOID_ERROR_MEMORY;
        if (!CHECK(is_said && (succeeded || error.message[0]))) {
            printf("  %s, allocation %ld: code %d, \"%s\"\n", name, k, (int)error.code, error.message);
            return;
        }
    }
    CHECK(0 && "an end");
}

#endif
