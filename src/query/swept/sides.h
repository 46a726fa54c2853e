// Directions along which the overlap of two round bodies is often the least.
#ifndef OVOID_QUERY_SWEPT_SIDES_H
#define OVOID_QUERY_SWEPT_SIDES_H

#include "query/swept/descend.h"

/// 1 if each core is a cylinder or a cone.
int cores_have_sides(const cores *p);

/// Of these the least overlap along the axes of discs, along the normals of sides, and where two sides cross, to
/// rounding: its value, and its unit direction.
double cores_try_sides(const cores *p, vec3 *n);

#endif
