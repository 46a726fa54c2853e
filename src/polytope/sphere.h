// The smallest sphere around points.
#ifndef OVOID_POLYTOPE_SPHERE_H
#define OVOID_POLYTOPE_SPHERE_H

#include "linear/vec3.h"

/// A ball.
typedef struct sphere {
    vec3 center;
    double radius;
} sphere;

/// A sphere that encloses count >= 1 points, rounding included; its radius is the least possible one to about 1e-12 in
/// all but contrived cases, and never more than twice that. At most 100 passes over the points.
sphere sphere_compute_smallest(const double *xyz, uint32_t count);

/// An upper bound of |v - center| over the points, rounding included.
double sphere_compute_radius(const double *xyz, uint32_t count, vec3 center);

#endif
