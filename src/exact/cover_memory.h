// The memory of a cover: what a search shows in it, and where the search goes on that fills its own memory.
#ifndef OVOID_EXACT_COVER_MEMORY_H
#define OVOID_EXACT_COVER_MEMORY_H

#include "exact/expand.h"

/// The arrays of a cover of as many points as the search's own memory has, at the beginning of a cover's memory.
typedef struct cover_arrays {
    uint32_t a[OVOID_COVER_POINTS], b[OVOID_COVER_POINTS];
    uint16_t triangles[2 * OVOID_COVER_POINTS][3];
} cover_arrays;

/// The memory of a small cover, of a surface that grew in lanes: what the next depth starts from.
typedef struct small_cover {
    uint32_t a[EPA8_POINTS], b[EPA8_POINTS];
    uint16_t triangles[2 * EPA8_POINTS][3];
} small_cover;

/// Bytes of memory for covers of so many points; 0: too many.
size_t cover_get_memory_size(uint32_t point_count);

/// 1 if the cover has memory of at least OVOID_COVER_SIZE bytes.
int cover_has_memory(const ovoid_cover *cover);

/// The options' iterations, of which 0 leaves the choice: as many as a surface in the cover's memory may need.
uint32_t cover_get_iterations(const ovoid_cover *cover, uint32_t given);

/// Shows nothing any more. cover may be NULL.
static inline void cover_clear(ovoid_cover *cover) {
    if (cover) cover->point_count = cover->triangle_count = 0;
}

/// The arrays in the cover's memory, to be filled.
cover_arrays *cover_get_arrays(const ovoid_cover *cover);

/// Shows what the arrays hold.
void cover_show_arrays(ovoid_cover *cover, uint32_t point_count, uint32_t triangle_count);

/// The room for a surface of more points, and how many (0: none). What the cover shows now stays as it is.
void *cover_find_room(const ovoid_cover *cover, uint32_t *points);

/// Shows a surface in that room, of so many triangles. They are moved to the end of the memory, so that another surface
/// has room while this one is shown; its points stay readable until then.
void cover_show_surface(ovoid_cover *cover, const expansion *surface, uint32_t triangle_count);

#endif
