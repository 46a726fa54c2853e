// Bounds of a body for the broad phase: a sphere that contains it in any pose, and the box of one pose.
#ifndef OVOID_WORLD_BODY_BOUNDS_H
#define OVOID_WORLD_BODY_BOUNDS_H

#include "linear/box.h"
#include "linear/mat3.h"
#include "ovoid/world.h"

/// The enclosing sphere with centre r: no vertex is farther than reach from r, no point farther than reach + radius.
typedef struct body_sphere {
    vec3 local; ///< r in the body's local frame
    double reach, radius;
    double size; ///< bounds all lengths in the local frame
} body_sphere;

body_sphere body_compute_sphere(const ovoid_body *body);

// u = 2^-53. R(q) is off by 36 u, a product with it by 6 u more, the sum by u of itself: 43 u |local| + u |r|, and
// local itself, a sum, by u. The largest coordinate times sqrt 3 bounds a length: 64 u 2 (max|p| + max|local|) is above
// it.
#define BODY_CENTER_ERROR (128 * 0x1p-53)

/// The centre r in the world, off by at most *center_error.
vec3 body_compute_center(const body_sphere *ball, const ovoid_pose *pose, double *center_error);

/// A box that contains the body, rounding included.
box body_compute_box(const ovoid_body *body, const body_sphere *ball);

/// Bounds of a body by its pose alone, without reading vertices.
typedef struct body_outline {
    vec3 at;      ///< the centre r in the world, rounded
    double reach; ///< no point of the body is farther than this from `at`, rounding included
    box bounds;   ///< contains the body, rounding included
    int is_tight; ///< the bounds are those of body_compute_box
} body_outline;

/// The body's sphere, and the box around its own box, rotated, no larger than the sphere's.
body_outline body_compute_outline(const ovoid_body *body, const body_sphere *ball);

#endif
