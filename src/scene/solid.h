// A solid as the broad phase sees it: a ball that holds it, the box of a pose.
#ifndef OVOID_SCENE_SOLID_H
#define OVOID_SCENE_SOLID_H

#include "linear/mat3.h"
#include "ovoid/world.h"
#include "scene/box.h"

/// The ball around r: no vertex is farther than reach from it, no point farther than reach + radius.
typedef struct solid_ball {
    vec3 local; ///< r in the user's local frame
    double reach, radius;
    double size; ///< bounds all lengths in the local frame
} solid_ball;

solid_ball solid_compute_ball(const ovoid_solid *solid);

/// r in the world, off by at most *blur.
vec3 solid_compute_center(const solid_ball *ball, const ovoid_pose *pose, double *blur);

/// A box that holds the body, rounding included.
box solid_compute_box(const ovoid_solid *solid, const solid_ball *ball);

#endif
