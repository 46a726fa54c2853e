// Points of an ellipsoid that proofs name, and its support.
//
// They are those of the grid of ELLIPSOID_STEPS steps (polytope/ellipsoid_grid.h). A number is RIM_POINT + (i + steps)
// side + (j + steps) with |i|, |j| <= steps: where z = steps - |i| - |j| is not below zero the point is (i, j, z), else
// (steps - |j|, steps - |i|, z) with the signs of i and j (0 counts as positive). Neighbours are less than 1.1e-4 apart
// on the unit sphere, and so their hull is within 2e-9 a of the ellipsoid.
#ifndef OVOID_SHAPE_ELLIPSOID_H
#define OVOID_SHAPE_ELLIPSOID_H

#include "linear/vec3.h"
#include "shape/block.h"

#define ELLIPSOID_STEPS 23169
#define ELLIPSOID_SIDE (2 * ELLIPSOID_STEPS + 1)
/// How many points numbers name; those of the square's border have two numbers.
#define ELLIPSOID_POINTS ((uint32_t)ELLIPSOID_SIDE * ELLIPSOID_SIDE)

/// The support along n, of any length whose square is a normal number: the value is off by less than 4 u a |n|.
typedef struct ellipsoid_end {
    double value; ///< |m|
    vec3 m;       ///< n times the half axes: the point's place on the unit sphere, times `value`
} ellipsoid_end;
static inline ellipsoid_end ellipsoid_find_support(vec3 half, vec3 n) {
    vec3 m = {half.x * n.x, half.y * n.y, half.z * n.z};
    return (ellipsoid_end){vec3_norm(m), m};
}

/// The number of a point of the grid that is near the direction m on the unit sphere, of any length: less than 1e-4
/// from it.
uint32_t ellipsoid_find_number(vec3 m);

/// The point of a number, around the origin.
vec3 ellipsoid_compute_point(vec3 half, uint32_t number);

/// 1 if the shape is the polyhedron of an ellipsoid with these half axes, and so is its allowance.
int ellipsoid_is_held(const ovoid_shape *shape, vec3 half);

#endif
