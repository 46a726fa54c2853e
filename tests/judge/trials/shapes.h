// The bodies of the trials: random ones of every kind of trouble, by a generator whose state the caller holds, so that
// a seed makes the same body again.
#ifndef OVOID_TRIALS_SHAPES_H
#define OVOID_TRIALS_SHAPES_H

#include "ovoid/ovoid.h"

/// The seed of the present trial, for messages. One for each thread.
extern _Thread_local uint64_t trial_seed;

/// Random numbers, on top of check.h's.
double log_uniform(uint64_t *r, double low, double high);
ovoid_vec3 random_vec3(uint64_t *r, double deviation);
ovoid_quat random_quat(uint64_t *r);
/// 4 to most, as likely between 4 and 8 as between 32 and 64.
size_t random_count(uint64_t *r, double most);

/// The shape of these points. A shape that cannot be made ends the program, with the points printed: none of the
/// trials' inputs may be refused.
ovoid_shape *make_points(const double *xyz, size_t count, double radius);
/// count points on an ellipsoid of these half axes around center, one time in three filling it.
ovoid_shape *make_hull(uint64_t *r, size_t count, ovoid_vec3 axes, ovoid_vec3 center, double radius);
/// 4 to most points, axes 1:1 to 1:4.
ovoid_shape *make_random_hull(uint64_t *r, double most, double scale);
/// 4 to most points, axes 1:1 to 1:1000.
ovoid_shape *make_long_hull(uint64_t *r, double most);
ovoid_shape *make_needle(uint64_t *r);
ovoid_shape *make_slab(uint64_t *r);
/// A polygon in a coordinate plane (exactly flat), or in any plane (flat to rounding).
ovoid_shape *make_flat(uint64_t *r, double radius);
ovoid_shape *make_segment(uint64_t *r, double radius);
ovoid_shape *make_point(uint64_t *r, double radius);
ovoid_shape *make_box(double x, double y, double z, double radius);
/// Points of a coarse grid moved by rounding-sized steps: near-coplanar faces, near-duplicates, exact duplicates.
ovoid_shape *make_grid(uint64_t *r);
/// A body of few planes with many points on each, moved off them by 1e-17 to 1e-6: faces that are nearly one.
ovoid_shape *make_near_coplanar(uint64_t *r);
/// 4 to 8 of the 27 points of {0, 1, 2}^3: bodies that share corners, edges and planes, exactly.
ovoid_shape *make_lattice(uint64_t *r);
/// With a rounding radius.
ovoid_shape *make_round(uint64_t *r);
ovoid_shape *make_prism(uint64_t *r);
/// One of all these kinds.
ovoid_shape *make_any(uint64_t *r);

#endif
