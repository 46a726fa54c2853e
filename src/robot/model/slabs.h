// The slabs of a body: how far it reaches along thirteen directions.
#ifndef OVOID_ROBOT_MODEL_SLABS_H
#define OVOID_ROBOT_MODEL_SLABS_H

#include "linear/vec3.h"
#include "shape/block.h"
#include "simd/robot/cover8.h"

/// Of vertices, xyz, and a radius around them. Cost: one pass.
body_slabs slabs_find(const double *vertices, uint32_t count, double radius);
/// Of a shape in its user's frame, its radius, its allowance and rounding counted.
body_slabs slabs_find_of_shape(const ovoid_shape *shape);

#endif
