// A shape in single precision, for the lanes of simd/float_gjk.h: ellipsoids, and columns of vertices, around the
// centre of the enclosing sphere. Shapes of at most FLOAT_GJK_POINTS vertices have them.
#ifndef OVOID_SHAPE_FLOATS_H
#define OVOID_SHAPE_FLOATS_H

#include "shape/block.h"
#include "simd/float_gjk.h"

static inline int shape_has_floats(const ovoid_shape *s) { return s->vertex_count <= FLOAT_GJK_POINTS; }
static inline const float_shape *shape_get_floats(const ovoid_shape *s) {
    return (const float_shape *)((const char *)s + s->at.floats);
}
static inline const float *shape_get_float_columns(const ovoid_shape *s) {
    return (const float *)(shape_get_floats(s) + 1);
}

/// Bytes of the array, of a shape with so many vertices.
uint64_t shape_floats_get_size(uint32_t vertex_count);

/// Writes the vertices, of a block with its sphere; the ellipsoids, of one that has these too.
void shape_floats_fill_vertices(ovoid_shape *shape);
void shape_floats_fill_ellipsoids(ovoid_shape *shape);

#endif
