// A point, or a ball, as a shape without an allocation: for rays, and for the balls around what moves.
#ifndef OVOID_SHAPE_POINT_H
#define OVOID_SHAPE_POINT_H

#include "shape/block.h"

#include <string.h>

/// All arrays of the shape are these zeros. It must not be moved once made.
typedef struct point_shape {
    ovoid_shape shape;
    _Alignas(64) double zeros[8];
} point_shape;

/// A point at the origin with that rounding radius.
static inline void point_make(point_shape *p, double radius) {
    memset(p, 0, sizeof *p);
    block_set_radius(&p->shape, radius, (ovoid_allowance){0});
    p->shape.vertex_count = p->shape.counts.vertices = 1;
    p->shape.padded_count = 8;
    p->shape.at.x = p->shape.at.y = p->shape.at.z = p->shape.at.vertices = offsetof(point_shape, zeros);
    p->shape.at.size = sizeof *p;
}

#endif
