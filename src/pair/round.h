// Supports of the true bodies of shapes that know their round form: cylinders, cones and ellipsoids.
//
// Along a unit n, with n_z along the axis and n_r = |n x axis|, a cylinder of radius R and half length h reaches
// h |n_z| + R n_r from its centre, a cone max(h n_z, R n_r - h n_z). With u = 2^-53 either is off by less than
// 12 u (h + R), beside what n itself is off by, of which frame.h speaks: no point of the round body is farther from the
// origin of its frame than the vertices of its polyhedron. An ellipsoid reaches |m| from its centre, m the normal times
// the half axes, off by less than 4 u of the largest. So ROUND_CLAIM and ROUND_CHECK are added to the frame's.
//
// A search of true bodies is that of polyhedra with 2^30 corners on each rim, 2^31 on an ellipsoid (shape/rim.h): its
// points, hulls and covers are of corners that are within `inside` of the body, and its gaps are those of the body
// itself.
#ifndef OVOID_PAIR_ROUND_H
#define OVOID_PAIR_ROUND_H

#include "pair/frame.h"

#define ROUND_CLAIM (64 * 0x1p-53)
#define ROUND_CHECK (32 * 0x1p-53)

static inline int frame_has_round(const pair_frame *f) { return shape_is_round(f->a) | shape_is_round(f->b); }
static inline int frame_has_ellipsoid(const pair_frame *f) {
    return shape_is_ellipsoid(f->a) | shape_is_ellipsoid(f->b);
}

/// Sets the frame's lengths to those of true bodies, whose supports are then found and whose allowances are gone.
void frame_make_true(pair_frame *frame);

/// The support of a round body along n, of any length, and the vertex nearest to its point (shape/rim.h); in the body
/// frame.
typedef struct round_end {
    double value;
    uint32_t vertex;
} round_end;
round_end round_find_support(const ovoid_shape *shape, vec3 n);

/// The support along n of a true body or a polyhedron, in the body frame, with its point and vertex.
typedef struct true_end {
    double value;
    vec3 point;
    uint32_t vertex;
} true_end;
true_end round_find_end(const ovoid_shape *shape, vec3 n);

/// frame_find_support of true bodies.
frame_support round_find_ends(const pair_frame *frame, vec3 n);

/// What a lower bound along n loses to radii and allowances if it is by the gap of true bodies where these are known.
/// error: as in block.h.
double round_compute_radii(const pair_frame *f, vec3 n, double error);

/// frame_measure_gap with the supports of true bodies where these are known.
double round_measure_gap(const pair_frame *f, vec3 n);

#endif
