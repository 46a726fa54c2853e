// Covers with memory, and covers that can be altered.
#ifndef OVOID_TESTS_COVERS_H
#define OVOID_TESTS_COVERS_H

#include "ovoid/query.h"

#include <string.h>

/// A cover with static memory, for covers of up to OVOID_COVER_POINTS points.
#define STATIC_COVER(name)                                                                                             \
    static uint64_t name##_memory[OVOID_COVER_SIZE / sizeof(uint64_t)];                                                \
    static ovoid_cover name = {.memory = name##_memory, .size = sizeof name##_memory}

/// The same on the stack.
#define LOCAL_COVER(name)                                                                                              \
    uint64_t name##_memory[OVOID_COVER_SIZE / sizeof(uint64_t)];                                                       \
    ovoid_cover name = {.memory = name##_memory, .size = sizeof name##_memory}

/// A cover whose arrays are its own.
typedef struct own_cover {
    ovoid_cover cover;
    uint32_t a[OVOID_COVER_POINTS], b[OVOID_COVER_POINTS];
    uint16_t triangles[2 * OVOID_COVER_POINTS][3];
} own_cover;

/// Makes the cover one of its own arrays, of so many points and triangles.
static inline void own_cover_set(own_cover *own, uint32_t point_count, uint32_t triangle_count) {
    own->cover = (ovoid_cover){.point_count = point_count,
                               .triangle_count = triangle_count,
                               .a = own->a,
                               .b = own->b,
                               .triangles = (const uint16_t(*)[3])own->triangles};
}

/// Copies a cover of up to OVOID_COVER_POINTS points.
static inline void own_cover_copy(own_cover *own, const ovoid_cover *from) {
    if (from->point_count) {
        memcpy(own->a, from->a, from->point_count * sizeof *own->a);
        memcpy(own->b, from->b, from->point_count * sizeof *own->b);
        memcpy(own->triangles, from->triangles, from->triangle_count * sizeof *own->triangles);
    }
    own_cover_set(own, from->point_count, from->triangle_count);
}

/// The same counts and arrays.
static inline int own_cover_is_same(const own_cover *own, const ovoid_cover *other) {
    const ovoid_cover *cover = &own->cover;
    return cover->point_count == other->point_count && cover->triangle_count == other->triangle_count &&
           memcmp(own->a, other->a, other->point_count * sizeof *own->a) == 0 &&
           memcmp(own->b, other->b, other->point_count * sizeof *own->b) == 0 &&
           memcmp(own->triangles, other->triangles, other->triangle_count * sizeof *own->triangles) == 0;
}

#endif
