// The memory of manifolds. Workers allocate their rooms themselves, so these are counted apart.
#include "world/manifold_list.h"

#include <string.h>

int manifolds_create(ovoid_world *w) {
    if (w->manifolds) return 1;
    manifolds *m = world_allocate(w, 1, sizeof *m);
    if (!m) return 0;
    memset(m, 0, sizeof *m);
    m->rooms = world_allocate(w, w->threads, sizeof *m->rooms);
    if (!m->rooms) {
        world_release(w, m, 1, sizeof *m);
        return 0;
    }
    memset(m->rooms, 0, w->threads * sizeof *m->rooms);
    w->manifolds = m;
    return 1;
}

static void release(const ovoid_world *w, const manifold_list *list) {
    allocator_release(&w->allocator, list->items);
    allocator_release(&w->allocator, list->parts);
    allocator_release(&w->allocator, list->points);
}

void manifolds_destroy(ovoid_world *w) {
    manifolds *m = w->manifolds;
    if (!m) return;
    for (uint32_t i = 0; i < w->threads; i++) release(w, &m->rooms[i].list);
    release(w, &m->last);
    release(w, &m->next);
    allocator_release(&w->allocator, m->rooms);
    allocator_release(&w->allocator, m->chunks);
    allocator_release(&w->allocator, m->ended);
    allocator_release(&w->allocator, m);
}

size_t manifolds_get_memory(const ovoid_world *w) {
    const manifolds *m = w->manifolds;
    size_t sum = 0;
    for (uint32_t i = 0; m && i < w->threads; i++) {
        const manifold_list *list = &m->rooms[i].list;
        sum += list->capacity * sizeof *list->items + list->part_capacity * sizeof *list->parts +
               list->point_capacity * sizeof *list->points;
    }
    return sum;
}

enum { FIRST_CAPACITY = 64 };

// Room for one more item; 0 if there is none.
static int grow(const ovoid_world *w, void **items, size_t *capacity, size_t count, size_t size) {
    if (count < *capacity) return 1;
    size_t room = *capacity ? 2 * *capacity : FIRST_CAPACITY;
    void *larger = allocator_allocate(&w->allocator, room, size);
    if (!larger) return 0;
    if (count) memcpy(larger, *items, count * size);
    allocator_release(&w->allocator, *items);
    *items = larger;
    *capacity = room;
    return 1;
}

void manifold_room_add(const ovoid_world *w, manifold_room *room, const ovoid_world_manifold *item) {
    manifold_list *list = &room->list;
    if (grow(w, (void **)&list->items, &list->capacity, list->count, sizeof *item))
        list->items[list->count++] = *item;
    else
        room->failed = 1;
}

void manifold_room_add_part(const ovoid_world *w, manifold_room *room, const ovoid_body_manifold *part,
                            const ovoid_manifold_points *points) {
    manifold_list *list = &room->list;
    if (!grow(w, (void **)&list->parts, &list->part_capacity, list->part_count, sizeof *part) ||
        !grow(w, (void **)&list->points, &list->point_capacity, list->part_count, sizeof *points)) {
        room->failed = 1;
        return;
    }
    list->parts[list->part_count] = *part;
    list->points[list->part_count++] = *points;
}
