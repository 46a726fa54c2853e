// Axis-aligned boxes. Comparisons only, so nothing is rounded but surfaces and distances.
#ifndef OVOID_LINEAR_BOX_H
#define OVOID_LINEAR_BOX_H

#include "linear/vec3.h"

typedef ovoid_box box;

/// The empty box: overlaps no box, and a join with it leaves the other box unchanged.
static inline box box_make_empty(void) {
    return (box){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
}
/// The box of count >= 1 points.
static inline box box_make_around(const double *xyz, uint32_t count) {
    vec3 low = vec3_at(xyz, 0), high = low;
    for (uint32_t i = 1; i < count; i++) {
        vec3 p = vec3_at(xyz, i);
        low = (vec3){min2(low.x, p.x), min2(low.y, p.y), min2(low.z, p.z)};
        high = (vec3){max2(high.x, p.x), max2(high.y, p.y), max2(high.z, p.z)};
    }
    return (box){low, high};
}
static inline int box_is_overlapping(const box *a, const box *b) {
    return (a->min.x <= b->max.x) & (b->min.x <= a->max.x) & (a->min.y <= b->max.y) & (b->min.y <= a->max.y) &
           (a->min.z <= b->max.z) & (b->min.z <= a->max.z);
}
static inline int box_is_same(const box *a, const box *b) {
    return a->min.x == b->min.x && a->min.y == b->min.y && a->min.z == b->min.z && a->max.x == b->max.x &&
           a->max.y == b->max.y && a->max.z == b->max.z;
}
static inline box box_join(const box *a, const box *b) {
    return (box){{min2(a->min.x, b->min.x), min2(a->min.y, b->min.y), min2(a->min.z, b->min.z)},
                 {max2(a->max.x, b->max.x), max2(a->max.y, b->max.y), max2(a->max.z, b->max.z)}};
}
/// The box with a point more.
static inline box box_add_point(const box *a, vec3 p) {
    const box at = {p, p};
    return box_join(a, &at);
}
/// Half the surface area of a box that is not empty.
static inline double box_compute_surface(const box *a) {
    double x = a->max.x - a->min.x, y = a->max.y - a->min.y, z = a->max.z - a->min.z;
    return x * y + y * z + z * x;
}
/// A lower bound of the distance of any two points of the boxes, rounding included: each difference and square is off
/// by at most 3 u of the result, the sum and the root by 3 u.
static inline double box_compute_distance(const box *a, const box *b) {
    double x = max2(max2(b->min.x - a->max.x, a->min.x - b->max.x), 0);
    double y = max2(max2(b->min.y - a->max.y, a->min.y - b->max.y), 0);
    double z = max2(max2(b->min.z - a->max.z, a->min.z - b->max.z), 0);
    return sqrt(x * x + y * y + z * z) * (1 - 0x1p-49);
}

#endif
