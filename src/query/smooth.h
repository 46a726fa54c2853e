// Two ellipsoids as their signed distance sees them: in the world's axes, in units of a power of two near the pair's
// size, seen from the body frame of A. docs/smooth.md derives what is used here.
#ifndef OVOID_QUERY_SMOOTH_H
#define OVOID_QUERY_SMOOTH_H

#include "ellipsoid/root.h"
#include "ovoid/smooth.h"
#include "query/frame.h"

/// What the root of n' Q n is taken for at least, in units of the pair's size: so that nothing is divided by zero where
/// n is across a flat ellipsoid. Four of them multiplied are no overflow.
#define SMOOTH_SPREAD_MIN 0x1p-100

/// One ellipsoid: { center + root p : |p| <= 1 }.
typedef struct smooth_body {
    root3 root;
    vec3 center; ///< from the body frame's origin
    double pad;  ///< no support of the ellipsoid meant is farther than this from that of center and root
} smooth_body;

/// The pair.
typedef struct smooth_pair {
    smooth_body a, b;
    vec3 d; ///< between the centres
    double unit;
    double size;  ///< bounds every length
    double claim; ///< what rounding can hide, pads included
} smooth_pair;

/// A unit direction and what the two ellipsoids are along it.
typedef struct smooth_state {
    vec3 n;
    vec3 p, q;     ///< |p|, |q| <= 1: the points are root_a p and d - root_b q
    double sa, sb; ///< sqrt(n' Q n)
    vec3 xa, xb;   ///< root_a p, root_b q
    vec3 w;        ///< between the points: d - xa - xb
    double gap;    ///< n.d - sa - sb: of the supports
    vec3 across;   ///< w less gap n: zero at the optimum
} smooth_state;

/// A symmetric 2x2 matrix with its determinant, which is known without cancellation.
typedef struct curvature {
    double xx, xy, yy, det;
} curvature;

/// The tangent plane at n, right-handed: e0 x e1 = n.
typedef struct tangents {
    vec3 e0, e1;
} tangents;

/// The root of an ellipsoid given by q, in world axes. smooth_body.c
smooth_body smooth_body_make(const ovoid_ellipsoid *ellipsoid, const mat3 *rotation, double unit);
/// Likewise of a shape's inner ellipsoid; of a flat shape an ellipse, a segment or a point that lies in it, to the pad.
smooth_body smooth_body_make_inner(const ovoid_shape *shape, const mat3 *rotation, double unit);

/// The state of the unit direction n.
void smooth_evaluate(const smooth_pair *pair, vec3 n, smooth_state *x);
/// The second derivative of the support of a body in its tangent plane; by the point p of the unit ball.
curvature smooth_compute_curvature(const root3 *root, const tangents *plane, vec3 p, double spread);
tangents tangents_make(vec3 n);
/// a + b + gap, with its determinant.
curvature curvature_add(const curvature *a, const curvature *b, double gap);
double curvature_compute_least(const curvature *k);

/// From a direction up the gap of the supports, by Newton's method; steps taken. smooth_search.c
uint32_t smooth_climb(const smooth_pair *pair, vec3 n, smooth_state *best);
/// The direction of the largest gap, and a proven upper bound of the largest gap (scaled, claim included). *steps
/// counts.
void smooth_search(const smooth_pair *pair, smooth_state *x, double *upper, uint32_t *steps);

/// An upper bound of the largest gap where it is negative; infinity where there is none. By one enclosed ellipsoid
/// through the state, or by a hull that grows: then *n is the direction of the largest gap found. smooth_depth.c
double smooth_compute_bound(const smooth_pair *pair, const smooth_state *x);
double smooth_grow(const smooth_pair *pair, vec3 *n, uint32_t *steps);

/// The derivatives at the state. levers: from the poses' positions to the two points. smooth_hessian.c
void smooth_derive(const smooth_pair *pair, const smooth_state *x, const vec3 levers[2], int order,
                   ovoid_smooth_value *out);

#endif
