// The world's memory: allocations are counted, and arrays at least double when they grow.
#include "world/manifold_list.h"

#include <string.h>

void *world_allocate(ovoid_world *w, size_t count, size_t size) {
    void *memory = allocator_allocate(&w->allocator, count, size);
    if (memory) w->memory += count * size;
    return memory;
}

void world_release(ovoid_world *w, void *memory, size_t count, size_t size) {
    if (!memory) return;
    allocator_release(&w->allocator, memory);
    w->memory -= count * size;
}

int world_reserve(ovoid_world *w, void **items, size_t *capacity, size_t used, size_t count, size_t size) {
    if (count <= *capacity) return 1;
    size_t room = count > 2 * *capacity ? count : 2 * *capacity;
    if (room < 16) room = 16;
    void *larger = world_allocate(w, room, size);
    if (!larger) return 0;
    if (used) memcpy(larger, *items, used * size);
    world_release(w, *items, *capacity, size);
    *items = larger;
    *capacity = room;
    return 1;
}

size_t world_get_memory(const ovoid_world *w) {
    size_t sum = w->memory + manifolds_get_memory(w);
    for (uint32_t i = 0; i < w->threads; i++) sum += w->gathered[i].capacity * sizeof *w->gathered[i].keys;
    return sum;
}
