// Two ellipsoids in the world's axes, relative to the body frame of A, in units of a power of two near the pair's size.
// docs/smooth.md derives the formulas.
#ifndef OVOID_SMOOTH_SMOOTH_H
#define OVOID_SMOOTH_SMOOTH_H

#include "ellipsoid/distance/root.h"
#include "ovoid/smooth.h"
#include "pair/frame.h"

/// The least value of the root of n' Q n, in units of the pair's size, so that nothing is divided by zero where n is
/// across a flat ellipsoid. The product of four inverses does not overflow.
#define SMOOTH_SPREAD_MIN 0x1p-100

/// One ellipsoid: { center + root p : |p| <= 1 }.
typedef struct smooth_body {
    root3 root;
    vec3 center; ///< from the body frame's origin
    double pad;  ///< no support of the exact ellipsoid is farther than this from that of center and root
} smooth_body;

/// Two ellipsoids.
typedef struct smooth_pair {
    smooth_body a, b;
    vec3 d; ///< from the centre of A to that of B
    double unit;
    double size;  ///< bounds every length
    double claim; ///< what rounding can hide, pads included
} smooth_pair;

/// A unit direction n, and the supports of both ellipsoids along it.
typedef struct smooth_state {
    vec3 n;
    vec3 p, q;     ///< |p|, |q| <= 1: the support points are root_a p and d - root_b q, from the centre of A
    double sa, sb; ///< sqrt(n' Q n)
    vec3 xa, xb;   ///< root_a p, root_b q
    vec3 w;        ///< between the support points: d - xa - xb
    double gap;    ///< n.d - sa - sb: the gap of the supports
    vec3 across;   ///< w less gap n: zero at the optimum
} smooth_state;

/// The root of an ellipsoid, in world axes. smooth_body.c
smooth_body smooth_body_make(const ovoid_ellipsoid *ellipsoid, const mat3 *rotation, double unit);
/// The root of a shape's inner ellipsoid; of a flat shape an ellipse, a segment or a point that lies in it, to the pad.
smooth_body smooth_body_make_inner(const ovoid_shape *shape, const mat3 *rotation, double unit);

/// Climbs from the direction n to a maximum of the gap by Newton's method; returns the number of steps. smooth_search.c
uint32_t smooth_climb(const smooth_pair *pair, vec3 n, smooth_state *best);
/// The direction of the largest gap, and a proven upper bound of the largest gap (scaled, claim included). *steps is
/// raised by the number of steps.
void smooth_search(const smooth_pair *pair, smooth_state *state, double *upper, uint32_t *steps);

/// An upper bound of the largest gap where it is negative, by one enclosed ellipsoid through the state; or by a hull
/// that grows, which leaves the direction of the largest gap found in *n. infinity where there is none. smooth_depth.c
double smooth_compute_bound(const smooth_pair *pair, const smooth_state *state);
double smooth_grow(const smooth_pair *pair, vec3 *n, uint32_t *steps);

/// The derivatives at the state, to the order given (0: none). levers: from the poses' positions to the two points.
/// smooth_hessian.c
void smooth_derive(const smooth_pair *pair, const smooth_state *state, const vec3 levers[2], int order,
                   ovoid_smooth_value *out);

#endif
