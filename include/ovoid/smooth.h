/**
 * @file smooth.h
 * A smooth bracket of the signed distance, from the ellipsoids, with derivatives; the gradient of the exact distance.
 *
 * Derivatives are with respect to twelve numbers, at zero: 0-2 the translation of A (world), 3-5 the rotation vector of
 * A (world axes, about the point pose_a.position), 6-8 and 9-11 those of B. They are the derivatives of the value at
 * the poses (position + t, exp(w) rotation). The second derivatives are those of this function of twelve numbers, so
 * they are symmetric.
 */
#ifndef OVOID_SMOOTH_H
#define OVOID_SMOOTH_H

#include "ovoid/query.h"

#ifdef __cplusplus
extern "C" {
#endif

/** One end of the smooth bracket: the signed distance of two ellipsoids, less the rounding radii. */
typedef struct ovoid_smooth_value {
    double value; /**< proven: value <= d for outer, d <= value for inner. Rounding included */
    double error; /**< the signed distance of the ellipsoids themselves is within this of value, proven; infinity for
                     inner ellipsoids that overlap if no depth is proven */
    double condition;    /**< >= 1: the factor by which rounding errors grow in the gradient (in the Hessian about its
                            square); infinity if there is no derivative */
    uint32_t is_smooth;  /**< 0: not known to be differentiable here; the gradient is one of several */
    uint32_t iterations; /**< of all searches */
    ovoid_vec3 point_a, point_b; /**< world; the points of the ellipsoids behind value, without the radii */
    ovoid_vec3 normal;           /**< unit, world, from A to B */
    double gradient[12];         /**< zero if `order` is below 1 */
    double hessian[12][12];      /**< zero if `order` is below 2; symmetric */
} ovoid_smooth_value;

/** outer.value <= d <= inner.value. */
typedef struct ovoid_smooth {
    ovoid_limit limit; /**< NONE; SHAPE_A, SHAPE_B, POSE_A, POSE_B: refused, -infinity and infinity, the rest zero;
                            OPTIONS: the order is refused, in the same form */
    ovoid_smooth_value outer, inner;
} ovoid_smooth;

/**
 * The signed distances of the outer and of the inner ellipsoids: the maximum over unit n of the gap of their supports
 * along n, which is minus the depth for an overlap. order: 0 values, 1 also gradients, 2 also Hessians. Flat inner
 * ellipsoids are ellipses, segments, points. Cost: O(1), but linear in the corners of a flat polygon. docs/smooth.md
 * has the derivation. Bounded work, no allocation; stack as in <ovoid/query.h>.
 */
OVOID_API ovoid_smooth ovoid_pair_compute_smooth(const ovoid_pair *pair, int order);

/** The gradient of the exact signed distance (of the true bodies), as far as an answer proves it. */
typedef struct ovoid_gradient {
    double gradient[12];      /**< by translations (0-2, 6-8) and rotations (3-5, 9-11); zero of a refused answer */
    uint32_t has_translation; /**< 1: proven that the derivative by translations exists, and is this one to `turn` */
    uint32_t has_rotation;    /**< 1: proven that the derivative by rotations exists too, and is this one to `turn` and
                                 `slide` */
    double turn; /**< radians: the exact normal is within this angle of the one used, proven; pi if nothing is proven */
    double slope;  /**< 0 to 1: a lower bound of how fast the bodies recede from each other if both witness points move
                      along them, rise over run; 0: parallel faces or edges, the witness points are not unique */
    double slide;  /**< the exact witness points are within this length of those used, to first order; infinity if slope
                      is 0 */
    double margin; /**< of a depth: every other separating translation is longer by at least this, proven; 0 if that is
                      not proven. Infinity if the bodies without their radii are apart */
} ovoid_gradient;

/**
 * The gradient of the exact signed distance from an answer of ovoid_distance or ovoid_depth and its pair. cover: the
 * one that ovoid_depth gave, or NULL; without it no derivative of a depth is proven. Nothing is proven if the hulls,
 * without radii, touch to rounding. Parts that are not proven are filled in too: one of several gradients, or an
 * inexact one. For shapes with an allowance the gradient is that of the true bodies. Cylinders and cones
 * (ovoid_shape_create_cylinder, ovoid_shape_create_cone) that are apart are known in closed form, so their own gradient
 * is found; for other shapes with an allowance only the derivative by translations is proven, to the `turn` that the
 * width of their bracket implies. Cost: the edges at the witness points, and the cover's triangles; 0.1 to some
 * microseconds.
 */
OVOID_API ovoid_gradient ovoid_answer_compute_gradient(const ovoid_pair *pair, const ovoid_answer *answer,
                                                       const ovoid_cover *cover);

#ifdef __cplusplus
}
#endif
#endif
