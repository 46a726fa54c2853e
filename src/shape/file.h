// The versions of a shape's file.
#ifndef OVOID_SHAPE_FILE_H
#define OVOID_SHAPE_FILE_H

#include "ovoid/shape.h"

/// Solids of at least so many vertices are written with their triangles: below, a hull is found in half a millisecond.
enum { SHAPE_TRIANGLES_LEAST = 512 };

/// ovoid_shape_write in the version given: 1, of a shape without an allowance; 2, of one with it; 3, with triangles, of
/// a solid whose inner ellipsoid is more than a point; 4 and 5, as 2 and 3, of one whose allowance has an axis.
size_t shape_write_version(const ovoid_shape *shape, uint32_t version, void *buffer, size_t capacity);

#endif
