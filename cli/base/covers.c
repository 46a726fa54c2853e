#include "base/covers.h"

#include <stdlib.h>
#include <string.h>

int cover_take_memory(ovoid_cover *cover) {
    if (cover->memory) return 1;
    size_t size = ovoid_cover_get_size(OVOID_COVER_POINTS_MAX);
    cover->memory = malloc(size);
    cover->size = cover->memory ? size : 0;
    return cover->memory != NULL;
}

ovoid_cover *cover_copy(const ovoid_cover *from) {
    if (!from || !from->point_count) return NULL;
    size_t indices = from->point_count * sizeof *from->a, triangles = from->triangle_count * sizeof *from->triangles;
    ovoid_cover *copy = malloc(sizeof *copy + 2 * indices + triangles);
    if (!copy) return NULL;
    char *a = (char *)(copy + 1), *b = a + indices, *last = b + indices;
    memcpy(a, from->a, indices);
    memcpy(b, from->b, indices);
    memcpy(last, from->triangles, triangles);
    *copy = (ovoid_cover){.point_count = from->point_count,
                          .triangle_count = from->triangle_count,
                          .a = (const uint32_t *)(void *)a,
                          .b = (const uint32_t *)(void *)b,
                          .triangles = (const uint16_t(*)[3])(void *)last};
    return copy;
}
