// From the beginning of the memory, aligned: the arrays of a small cover; the room of a surface (expand.h); and at the
// end, where the cover shown is one of that room, its arrays: points of A, points of B, triangles.
#include "exact/cover_memory.h"

#include <string.h>

// Beside the arrays there is room for aligning both ends.
enum { ALIGNMENT = 8 };
_Static_assert(sizeof(cover_arrays) + 64 == OVOID_COVER_SIZE, "the least memory holds the arrays");

size_t cover_get_memory_size(uint32_t point_count) {
    if (point_count > OVOID_COVER_POINTS_MAX) return 0;
    return OVOID_COVER_SIZE + (point_count > OVOID_COVER_POINTS ? expansion_get_room_size(point_count) : 0);
}

int cover_has_memory(const ovoid_cover *cover) { return cover->memory && cover->size >= OVOID_COVER_SIZE; }

cover_arrays *cover_get_arrays(const ovoid_cover *cover) {
    uintptr_t off = (uintptr_t)cover->memory % ALIGNMENT;
    return (cover_arrays *)(void *)((char *)cover->memory + (off ? ALIGNMENT - off : 0));
}

void cover_show_arrays(ovoid_cover *cover, uint32_t point_count, uint32_t triangle_count) {
    const cover_arrays *arrays = cover_get_arrays(cover);
    cover->point_count = point_count;
    cover->triangle_count = triangle_count;
    cover->a = arrays->a;
    cover->b = arrays->b;
    cover->triangles = arrays->triangles;
}

// The end of the memory as far as it is used, aligned.
static char *get_end(const ovoid_cover *cover) {
    size_t size = cover->size < cover_get_memory_size(OVOID_COVER_POINTS_MAX)
                      ? cover->size
                      : cover_get_memory_size(OVOID_COVER_POINTS_MAX);
    char *start = (char *)cover_get_arrays(cover);
    size_t left = size - (size_t)(start - (char *)cover->memory);
    return start + left / ALIGNMENT * ALIGNMENT;
}

void *cover_find_room(const ovoid_cover *cover, uint32_t *points) {
    *points = 0;
    if (cover->size < OVOID_COVER_SIZE) return NULL;
    cover_arrays *arrays = cover_get_arrays(cover);
    char *room = (char *)(arrays + 1), *end = get_end(cover);
    uintptr_t shown = (uintptr_t)cover->a;
    if (cover->point_count && shown >= (uintptr_t)room && shown < (uintptr_t)end)
        end = room + (shown - (uintptr_t)room);
    *points = (uint32_t)((size_t)(end - room) / expansion_get_room_size(1));
    return room;
}

uint32_t cover_get_iterations(const ovoid_cover *cover, uint32_t given) {
    uint32_t points = 0;
    if (given || !cover || !cover_has_memory(cover)) return given;
    (void)cover_find_room(&(ovoid_cover){.memory = cover->memory, .size = cover->size}, &points);
    return points > OVOID_COVER_POINTS ? 2 * points : 0;
}

// A surface has at most two triangles a point, so its arrays take 20 bytes of the 150 that a point has in its room, and
// none of them is moved onto one that is still to be moved.
void cover_show_surface(ovoid_cover *cover, const expansion *surface, uint32_t triangle_count) {
    size_t indices = surface->points * sizeof *surface->a, triangles = triangle_count * sizeof *surface->triangles;
    char *end = get_end(cover), *to_triangles = end - (triangles + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT,
         *to_b = to_triangles - indices, *to_a = to_b - indices;
    memmove(to_triangles, surface->triangles, triangles);
    memmove(to_b, surface->b, indices);
    memmove(to_a, surface->a, indices);
    cover->point_count = surface->points;
    cover->triangle_count = triangle_count;
    cover->a = (const uint32_t *)(void *)to_a;
    cover->b = (const uint32_t *)(void *)to_b;
    cover->triangles = (const uint16_t(*)[3])(void *)to_triangles;
}
