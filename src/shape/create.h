// Making shapes; shared by the files of this floor.
#ifndef OVOID_SHAPE_CREATE_H
#define OVOID_SHAPE_CREATE_H

#include "ovoid/shape.h"
#include "polytope/hull.h"

/// The options with their defaults; NULL allowed. Errors: RADIUS, RANGE, ARGUMENT.
ovoid_code shape_options_make(const ovoid_shape_options *given, ovoid_shape_options *options, ovoid_error *error);

/// A block with all that follows from the hull, but radius, report and ellipsoids. NULL with MEMORY.
ovoid_shape *shape_create_block(const hull *h, const ovoid_allocator *allocator, ovoid_error *error);

/// 1 if the ellipsoid is proven to lie in the shape's hull; of flat bodies, if it does to 1e-7 of their size.
int shape_is_inner(const ovoid_shape *shape, const ovoid_ellipsoid *ellipsoid);

void shape_set_fits(ovoid_shape *shape, const ovoid_fit *outer, const ovoid_fit *inner);

/// The shape of a hull with its ellipsoids. The options are checked already. near: a shape whose ellipsoids the new
/// ones are looked for from, or NULL. NULL with MEMORY.
ovoid_shape *shape_create_from_hull(const hull *h, const ovoid_shape_options *options, const ovoid_shape *near,
                                    ovoid_error *error);

/// As ovoid_shape_create_from_points, in the environment at hand, from a shape near by or NULL.
ovoid_shape *shape_create_from_points(const double *xyz, size_t count, const ovoid_shape_options *options,
                                      const ovoid_shape *near, ovoid_error *error);

#endif
