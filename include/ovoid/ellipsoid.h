/**
 * @file ellipsoid.h
 * Ellipsoids around and inside a polyhedron, and proximity of ellipsoids. All in the polyhedron's body frame.
 */
#ifndef OVOID_ELLIPSOID_H
#define OVOID_ELLIPSOID_H

#include "ovoid/polytope.h"

#ifdef __cplusplus
extern "C" {
#endif

/**
 * The ellipsoid { center + x : x' Q^-1 x <= 1 } with Q symmetric, positive semidefinite; a singular Q is a flat
 * ellipsoid. Its support is h(n) = n . center + sqrt(n' Q n).
 */
typedef struct ovoid_ellipsoid {
    ovoid_vec3 center;
    ovoid_sym3 q;
} ovoid_ellipsoid;

/**
 * The result of an offline step.
 *
 * The following is proven for the returned doubles. Outer, any rank: Q - (v - center)(v - center)' is positive
 * semidefinite for every vertex v, hence h(n) >= n . v in every direction n, whether Q is singular or not. The
 * ellipsoid of a flat body gets the thickness that this needs: none if the body lies in a coordinate plane or along an
 * axis, else about 1e-8 of its size, since Q is stored in six doubles. Inner and phases, rank 3: the ellipsoid lies in
 * the convex hull of the vertices and Q is positive definite; only for a body thinner than a few roundings Q is zero,
 * with a vertex as center. Rank below 3: the ellipse in the polygon's plane or the segment itself, for information and
 * drawing, without a proof, as the rounded center may miss the plane.
 */
typedef struct ovoid_fit {
    ovoid_ellipsoid ellipsoid;
    double volume;       /**< of the ellipsoid; area or length by the body's rank */
    double gap;          /**< proven relative gap of that volume to the optimum, infinity where none is; NaN for the
                              phases, which have none; flat bodies: true up to their deviation from the plane */
    uint32_t iterations; /**< of the solver or bisection */
    uint32_t converged;  /**< 1 if the requested gap was reached; the proof above holds in either case */
    double beta;         /**< phase 2 only: the final beta, 0 where the stretch is stuck */
    uint32_t facet;      /**< phase 2 only: the farthest facet that s was taken from (flat: edge or end) */
} ovoid_fit;

/** Options of the ellipsoids of smallest and of largest volume; all zero, or NULL, is the default. */
typedef struct ovoid_ellipsoid_options {
    double gap;                       /**< relative volume gap to reach; 0 means 1e-6 */
    const ovoid_allocator *allocator; /**< of the working memory; NULL: malloc and free */
} ovoid_ellipsoid_options;

/**
 * The Loewner-John ellipsoid: the smallest volume that encloses every vertex, proven to enclose after rounding.
 * L. Khachiyan, Rounding of polytopes in the real number model of computation, 1996; P. Kumar and E. A. Yildirim,
 * Minimum-volume enclosing ellipsoids and core sets, 2005 (start); M. J. Todd and E. A. Yildirim, On Khachiyan's
 * algorithm for the computation of minimum-volume enclosing ellipsoids, 2007 (away steps).
 * Errors: ARGUMENT, MEMORY. Cost: linear in the vertices per iteration.
 */
OVOID_API ovoid_code ovoid_ellipsoid_compute_outer(const ovoid_polytope *polytope,
                                                   const ovoid_ellipsoid_options *options, ovoid_fit *fit,
                                                   ovoid_error *error);

/**
 * Phase 1 of the paper: shrink the outer ellipsoid isotropically, by bisection from a quarter of its radii, until it
 * touches the first facet. W.-K. Su, J.-S. Liu, I-F. Chen, Enhancing Collision Detection Method Based on Enclosed
 * Ellipsoid by Facial Areas Splitting. Proven inside the polyhedron after rounding. Allocates nothing.
 */
OVOID_API ovoid_fit ovoid_ellipsoid_compute_shrunk(const ovoid_polytope *polytope, const ovoid_ellipsoid *outer);

/** Phase 2 of the paper: move the centre toward the farthest facet and stretch in that direction, by bisection. */
OVOID_API ovoid_fit ovoid_ellipsoid_compute_stretched(const ovoid_polytope *polytope, const ovoid_ellipsoid *shrunk);

/** Phase 3 of the paper: enlarge each radius, one after another, in the ellipsoid's own axes. */
OVOID_API ovoid_fit ovoid_ellipsoid_compute_enlarged(const ovoid_polytope *polytope, const ovoid_ellipsoid *stretched);

/**
 * The maximum-volume inscribed ellipsoid, proven inside after rounding.
 * L. G. Khachiyan and M. J. Todd, On the complexity of approximating the maximal inscribed ellipsoid for a polytope,
 * 1993; Y. Zhang and L. Gao, On numerical solution of the maximum volume ellipsoid problem, 2003.
 * Errors: ARGUMENT, MEMORY.
 */
OVOID_API ovoid_code ovoid_ellipsoid_compute_inner(const ovoid_polytope *polytope,
                                                   const ovoid_ellipsoid_options *options, ovoid_fit *fit,
                                                   ovoid_error *error);

/** Radii in descending order; zero where the ellipsoid is flat. Relative error 2^-50 times longest over shortest. */
OVOID_API ovoid_vec3 ovoid_ellipsoid_compute_radii(const ovoid_ellipsoid *ellipsoid);

/** Volume, 4/3 pi sqrt(det Q). */
OVOID_API double ovoid_ellipsoid_compute_volume(const ovoid_ellipsoid *ellipsoid);

/** The ellipsoid under a pose: R Q R' and the moved centre. Rounded; not proven to contain anything. */
OVOID_API ovoid_ellipsoid ovoid_ellipsoid_compute_posed(const ovoid_ellipsoid *ellipsoid, const ovoid_pose *pose);

/** Nearest points of two ellipsoids, or of a point and one. Their numbers must be finite: this is not checked. */
typedef struct ovoid_nearest {
    ovoid_vec3 point_a, point_b;
    ovoid_vec3 normal; /**< unit, from a to b; if they are apart, the direction of the largest gap */
    double distance;   /**< |point_b - point_a|; 0 where they overlap */
    double lower;      /**< proven: the gap of the two supports along normal; negative where they overlap */
    uint32_t iterations;
    uint32_t overlap; /**< 1: they share a point (point_a = point_b is one) */
} ovoid_nearest;

/** The point of the ellipsoid nearest to a point (the point itself if it is inside); point_b is the given point. */
OVOID_API ovoid_nearest ovoid_ellipsoid_compute_nearest_to_point(const ovoid_ellipsoid *ellipsoid, ovoid_vec3 point);

/**
 * The paper's X* and Y*: a is mapped to the unit sphere; then the point of the mapped b nearest to the sphere's centre,
 * and the sphere's point on the same line, are mapped back. They give a good direction, but are not the Euclidean
 * closest points: `distance` is only an upper bound. Q of a must be positive definite, else the Euclidean result is
 * returned.
 */
OVOID_API ovoid_nearest ovoid_ellipsoid_compute_nearest_by_sphere(const ovoid_ellipsoid *a, const ovoid_ellipsoid *b);

/**
 * The Euclidean closest points of two ellipsoids, flat or not, to about 1e-12 of their size (if rounding made a flat Q
 * slightly indefinite, only to the root of that defect). D. Eberly, Distance from a point to an ellipse, an ellipsoid,
 * or a hyperellipsoid, 2013, for one body; docs/ellipsoid-proximity.md for two. At most 200 iterations.
 */
OVOID_API ovoid_nearest ovoid_ellipsoid_compute_nearest(const ovoid_ellipsoid *a, const ovoid_ellipsoid *b);

/**
 * 1 if the ellipsoids are proven to share a point: *point (if not NULL) lies strictly inside both, rounding included;
 * for a flat ellipsoid it is the centre. 0 if they are apart or nothing is proven. J. W. Perram and M. S. Wertheim,
 * Statistical mechanics of hard ellipsoids I: overlap algorithm and the contact function, 1985.
 */
OVOID_API int ovoid_ellipsoid_is_overlapping(const ovoid_ellipsoid *a, const ovoid_ellipsoid *b, ovoid_vec3 *point);

#ifdef __cplusplus
}
#endif
#endif
