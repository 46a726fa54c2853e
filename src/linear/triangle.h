// Triangles in space.
#ifndef OVOID_LINEAR_TRIANGLE_H
#define OVOID_LINEAR_TRIANGLE_H

#include "linear/vec3.h"

/// A point of the triangle near to x, the nearest one except for triangles of nearly no area; on the triangle to 8 u.
vec3 triangle_find_nearest(const vec3 corner[3], vec3 x);

#endif
