// The versions of a shape's file.
#ifndef OVOID_SHAPE_FILE_H
#define OVOID_SHAPE_FILE_H

#include "ovoid/shape.h"

/// The smallest number of vertices of solids, of no closed form, that are written with their triangles: smaller hulls
/// are found in the time of a proof.
enum { SHAPE_TRIANGLES_LEAST = 16 };

/// ovoid_shape_write in the given version: 1, of a shape without an allowance; 2, with one; 3, with triangles, of a
/// solid whose inner ellipsoid is more than a point; 4 and 5, as 2 and 3, of a shape whose allowance has an axis;
/// 6 and 7, as 4 and 5, of one whose true body is known; 8, as 2, of an ellipsoid; 9 to 16, as 1 to 8, with a checksum
/// by words.
size_t shape_write_version(const ovoid_shape *shape, uint32_t written, void *buffer, size_t capacity);

#endif
