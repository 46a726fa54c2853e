/**
 * @file swept.h
 * Swept spheres: a ball swept over a point, a segment, a box, a cylinder, a cone, an ellipsoid or the hull of points,
 * given by numbers alone. Spheres, capsules and boxes with or without a radius are such bodies (E. Larsen, S.
 * Gottschalk, M. C. Lin, D. Manocha, Fast proximity queries with swept sphere volumes, 1999). Nothing is created or
 * prepared for them: for hosts that hold their own geometries and ask each pair once, as a broad phase does.
 *
 * The queries have no proof. Pairs of a point, and of a segment with a segment or a box, are closed forms; of others
 * the cores' nearest points are searched, and where they overlap the shortest translation that parts them. Where the
 * verdict is undecided, the same bodies as shapes (<ovoid/shape.h>) have an answer with its proof by <ovoid/query.h>.
 */
#ifndef OVOID_SWEPT_H
#define OVOID_SWEPT_H

#include "ovoid/query.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What the ball is swept over. */
typedef enum ovoid_swept_core {
    OVOID_SWEPT_POINT = 0,
    OVOID_SWEPT_SEGMENT = 1,   /**< along axis[0], half[0] to either side */
    OVOID_SWEPT_CYLINDER = 2,  /**< around axis[0], half[0] to either side, of the radius half[1] */
    OVOID_SWEPT_BOX = 3,       /**< half[k] to either side along each axis[k] */
    OVOID_SWEPT_CONE = 4,      /**< around axis[0]: the apex is half[0] along it, the base of radius half[1] opposite */
    OVOID_SWEPT_ELLIPSOID = 5, /**< half[k] to either side along each axis[k] */
    OVOID_SWEPT_POINTS = 6     /**< the hull of `points`; half: one of its points, as theirs are, about in the middle */
} ovoid_swept_core;

/** A body: all points within `radius` of its core. World axes, one unit of length. What a core does not name is not
 * read. */
typedef struct ovoid_swept_sphere {
    ovoid_vec3 center;
    double radius; /**< >= 0 */
    ovoid_swept_core core;
    double half[3];       /**< lengths, > 0 */
    ovoid_vec3 axis[3];   /**< unit, and at right angles: their products are off by 2^-48 together */
    const double *points; /**< borrowed: x, y and z of each, along the axes from the center; finite */
    uint32_t count;       /**< of the points, >= 1; each query reads all of them 5 to 15 times */
    /** Of points: NULL, or what ovoid_shape_create_from_points made of them, borrowed; that they are the same is not
     * checked, and a depth is of neither body where they are not. Of a solid of up to 32 points
     * its faces show the depth in a cylinder, a cone or an ellipsoid in half of the time, and leave less undecided,
     * unless the shape is lean. */
    const ovoid_shape *shape;
} ovoid_swept_sphere;

/** Two of them, borrowed. */
typedef struct ovoid_swept_pair {
    const ovoid_swept_sphere *a, *b;
} ovoid_swept_pair;

/**
 * Do the bodies have a common point? SEPARATED and OVERLAPPING are true whatever was rounded, with a bracket of the
 * signed distance around which no more is known than its sign. Undecided: a sign that rounding leaves open; numbers
 * that are not finite, a radius or a half length below 0, sizes and distances that are together not between 1e-50 and
 * 1e50. Axes are not looked at where spheres around the bodies are apart. Cost: 10 to 60 ns in closed form, of a search
 * 40 to 200 ns.
 */
OVOID_API ovoid_verdict ovoid_swept_collide(ovoid_swept_pair pair);

/**
 * The signed distance, as ovoid_depth has it, to a part in 1e12 of the sizes, with its points and normal; where it is
 * searched and the bodies are apart, to a part in 1e9. Undecided: of cores that overlap, a point on one's surface, in
 * an ellipsoid, or near the axis of a cylinder or a cone, to a part in 1e6 of the size, two that cross in a plane, and
 * up to a tenth of others, most where many translations are as short; numbers as above. witness: written unless
 * undecided; may be NULL. Cost: 10 to 60 ns, of a search 150 to 800 ns, of cores that overlap 0.3 to 10 us, few 40 us.
 */
OVOID_API ovoid_verdict ovoid_swept_depth(ovoid_swept_pair pair, ovoid_witness *witness);

/** ovoid_swept_depth, but of bodies that overlap the sign alone is sought, with two points of a common part and any
 * unit normal. */
OVOID_API ovoid_verdict ovoid_swept_distance(ovoid_swept_pair pair, ovoid_witness *witness);

/** ovoid_swept_depth, but of bodies that are apart the sign alone is sought, and no witness is written. */
OVOID_API ovoid_verdict ovoid_swept_contact(ovoid_swept_pair pair, ovoid_witness *witness);

#ifdef __cplusplus
}
#endif
#endif
