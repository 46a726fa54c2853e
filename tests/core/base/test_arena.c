// A buffer as an allocator. Truth: places within the buffer, and the count of blocks that another allocator holds.
#include "base/allocator.h"
#include "base/arena.h"
#include "check.h"
#include "countdown.h"

#include <string.h>

enum { SIZE = 1024 };

static int is_within(const char *buffer, const void *memory) {
    return (const char *)memory >= buffer && (const char *)memory < buffer + SIZE;
}

int main(void) {
    _Alignas(64) char buffer[SIZE];
    countdown c = {3, 0};
    ovoid_allocator beyond = countdown_make_allocator(&c);
    arena a;
    ovoid_allocator use = arena_make(&a, &beyond, buffer, SIZE);
    // Blocks follow one another at multiples of 64, and none overlaps the next.
    char *first = allocator_allocate(&use, 1, 1), *second = allocator_allocate(&use, 65, 1);
    CHECK(first == buffer && second == buffer + 64);
    memset(second, 7, 65);
    char *third = allocator_allocate(&use, 0, 8);
    CHECK(third == buffer + 192);
    // The last block returns, the others do not.
    allocator_release(&use, third);
    third = allocator_allocate(&use, 100, 1);
    CHECK(third == buffer + 192);
    allocator_release(&use, second);
    char *fourth = allocator_allocate(&use, 1, 1);
    CHECK(fourth == buffer + 320);
    // Exactly the rest fits; what does not fit is the other allocator's, and returns to it.
    char *rest = allocator_allocate(&use, SIZE - 384, 1);
    CHECK(rest == buffer + 384);
    char *outside = allocator_allocate(&use, 1, 1);
    CHECK(outside && !is_within(buffer, outside));
    CHECK_EQ(c.held, 1);
    allocator_release(&use, outside);
    CHECK_EQ(c.held, 0);
    allocator_release(&use, rest);
    outside = allocator_allocate(&use, SIZE - 383, 1);
    CHECK(outside && !is_within(buffer, outside));
    allocator_release(&use, outside);
    // The other allocator's refusal is passed on.
    while (c.left > 0) allocator_release(&use, allocator_allocate(&use, SIZE, 1));
    CHECK(!allocator_allocate(&use, SIZE, 1));
    return check_end();
}
