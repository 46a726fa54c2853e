// A shape in single precision, for the lanes of simd/float_gjk.h: ellipsoids and, of shapes of at most
// FLOAT_COLUMN_POINTS vertices, columns of these, around the centre of the enclosing sphere. They stand behind the
// header of each block, where they are found without reading it.
#ifndef OVOID_SHAPE_FLOATS_H
#define OVOID_SHAPE_FLOATS_H

#include "shape/block.h"
#include "simd/float_gjk.h"

/// Where they begin.
enum { SHAPE_FLOATS = (sizeof(ovoid_shape) + 63) / 64 * 64 };

/// 1 if there are columns of the vertices.
static inline int shape_has_columns(const ovoid_shape *s) { return s->vertex_count <= FLOAT_COLUMN_POINTS; }
static inline const float_shape *shape_get_floats(const ovoid_shape *s) {
    return (const float_shape *)((const char *)s + SHAPE_FLOATS);
}
static inline const float *shape_get_float_columns(const ovoid_shape *s) {
    return (const float *)(shape_get_floats(s) + 1);
}

/// Bytes of all that, in whole cache lines, of a shape with so many vertices.
uint64_t shape_floats_get_size(uint32_t vertex_count);

/// Writes the vertices, of a block with its sphere; the ellipsoids, of one that has these too.
void shape_floats_fill_vertices(ovoid_shape *shape);
void shape_floats_fill_ellipsoids(ovoid_shape *shape);

#endif
