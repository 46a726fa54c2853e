// Running out of memory. GMP can only end the program then, so the judge does the same, through one function that the
// program may set.
#include "judge.h"
#include "number.h"

#include <stdlib.h>

static void (*end_program)(void) = abort;

void *judge_allocate(size_t count, size_t size) {
    void *made = calloc(count ? count : 1, size);
    if (made) return made;
    end_program();
    abort();
}

static void *allocate(size_t size) { return judge_allocate(1, size); }

static void *reallocate(void *old, size_t old_size, size_t size) {
    (void)old_size;
    void *made = realloc(old, size);
    if (made) return made;
    end_program();
    abort();
}

static void release(void *old, size_t size) {
    (void)size;
    free(old);
}

void judge_set_out_of_memory(void (*handler)(void)) {
    end_program = handler ? handler : abort;
    mp_set_memory_functions(allocate, reallocate, release);
}
