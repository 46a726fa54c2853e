// The steps of making a shape, shared by the files of this floor.
#ifndef OVOID_SHAPE_CREATE_H
#define OVOID_SHAPE_CREATE_H

#include "ovoid/shape.h"
#include "polytope/hull.h"

/// The working memory on the stack: that of bodies of some 40 vertices; larger ones need the allocator.
enum { SHAPE_WORK_SIZE = 16 * 1024 };

/// The options with their defaults; NULL allowed. Errors: RADIUS, RANGE, ARGUMENT.
ovoid_code shape_options_make(const ovoid_shape_options *given, ovoid_shape_options *options, ovoid_error *error);

/// 1 if a tolerance of round bodies is a length >= 0, else an error.
int shape_tolerance_is_length(double tolerance, ovoid_error *error);

/// 1 if the allowance's axis is zero, or has length 1 and belongs to an `outside` above zero.
int allowance_is_normal(const ovoid_allowance *allowance);

/// How a block is made.
typedef struct block_making {
    const ovoid_allocator *allocator, *work; ///< of the block; of working memory
    uint32_t is_lean;                        ///< without a table of supports and a Gauss map
} block_making;

/// A block with everything that follows from the hull; radius, report and ellipsoids are not set. NULL with MEMORY.
ovoid_shape *shape_create_block(const hull *polytope, const block_making *how, ovoid_error *error);

/// 1 if the ellipsoid is proven to lie in the shape's hull; for a flat body, if it lies there to 1e-7 of its size.
int shape_is_inner(const ovoid_shape *shape, const ovoid_ellipsoid *ellipsoid);

/// Sets both ellipsoids and the values that queries read of them.
void shape_set_fits(ovoid_shape *shape, const ovoid_fit *outer, const ovoid_fit *inner);

/// The shape of a hull with its ellipsoids. work: for working memory. The options must be checked. NULL with MEMORY.
ovoid_shape *shape_create_from_hull(const hull *polytope, const ovoid_shape_options *options,
                                    const ovoid_allocator *work, ovoid_error *error);

/// ovoid_shape_create_from_points, for callers that have set up the floating-point environment.
ovoid_shape *shape_create_from_points(xyz_points given, const ovoid_shape_options *options, ovoid_error *error);

#endif
