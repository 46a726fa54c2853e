// Slabs around a body: its extent along x, y and z, the edges' and the corners' directions of a cube.
#include "robot/model/slabs.h"

#include "simd/robot/robot8.h"

#include <string.h>

#define UP (1 + 0x1p-40)

// The thirteen directions of a point.
static void find_along(vec3 v, double along[SLABS]) {
    const double all[SLABS] = {v.x,
                               v.y,
                               v.z,
                               v.x + v.y,
                               v.x - v.y,
                               v.x + v.z,
                               v.x - v.z,
                               v.y + v.z,
                               v.y - v.z,
                               v.x + v.y + v.z,
                               v.x + v.y - v.z,
                               v.x - v.y + v.z,
                               v.x - v.y - v.z};
    memcpy(along, all, sizeof all);
}

body_slabs slabs_find(const double *vertices, uint32_t count, double radius) {
    static const double norms[3] = {1, 1.4142135624, 1.7320508076}; // above 1, sqrt 2, sqrt 3
    double low[SLABS], high[SLABS], along[SLABS];
    for (uint32_t i = 0; i < count; i++) {
        find_along(vec3_at(vertices, i), along);
        for (int k = 0; k < SLABS; k++) {
            low[k] = i ? min2(low[k], along[k]) : along[k];
            high[k] = i ? max2(high[k], along[k]) : along[k];
        }
    }
    body_slabs slabs;
    for (int k = 0; k < SLABS; k++) {
        slabs.middle[k] = 0.5 * (low[k] + high[k]);
        slabs.half[k] = (0.5 * (high[k] - low[k]) + radius * norms[k < 3 ? 0 : k < 9 ? 1 : 2]) * UP;
    }
    return slabs;
}

body_slabs slabs_find_of_shape(const ovoid_shape *s) {
    double size = s->extent + vec3_norm(s->origin), from[SLABS];
    body_slabs slabs = slabs_find(shape_vertices(s), s->vertex_count, s->lower_radius + 4 * ROBOT8_SLACK * size);
    find_along(s->origin, from);
    for (int k = 0; k < SLABS; k++) slabs.middle[k] += from[k];
    return slabs;
}
