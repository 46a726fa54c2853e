// A pair of posed shapes in exact arithmetic. With a quaternion q, M = |q|^2 R(q) has entries of degree two in q, so
// the world point n x = n position + M (origin + vertex), n = |q|^2, needs no division. Lengths of A carry the factor
// n_a, those of B n_b, differences k = n_a n_b.
#ifndef OVOID_JUDGE_POSED_H
#define OVOID_JUDGE_POSED_H

#include "number.h"

#include "ovoid/query.h"

/// One body. All values exact.
typedef struct body {
    const ovoid_shape *shape; ///< NULL: a triangle of a solid
    ovoid_polytope polytope;
    nvec rows[3]; ///< of M
    num n;        ///< |q|^2 > 0
    nvec position, origin;
    num radius, outside, inside;
    num across; ///< the length by which the true body exceeds the shape across the axis; `outside` is zero then; zero:
                ///< there is no axis
    nvec axis;  ///< of any length, in the shape's axes
    ovoid_round_kind round; ///< the true body is one of these: then its own support is used
    num round_radius, half_length;
    ovoid_vec3 half_axes; ///< of an ellipsoid
    double extent;        ///< the largest |vertex|, in doubles
    double reach;         ///< about the largest |position| + |origin| + |vertex|, in doubles: the scale of rounding
} body;

typedef struct posed {
    pool *p;
    body a, b;
    num k;               ///< n_a n_b
    num radii;           ///< sum of the rounding radii
    num outside, inside; ///< sums of the allowances in all directions
    double allowed;      ///< the sum of `outside`, also across axes, and twice `inside`, in doubles
    double size;         ///< about the sum of both bodies' extents and the distance of their frames, in doubles
} posed;

/// One posed shape. The pose must have passed judge_is_pose_valid.
body body_make(pool *p, const ovoid_shape *shape, const ovoid_pose *pose);

/// The posed body of a polytope without a radius.
body body_make_hull(pool *p, const ovoid_polytope *polytope, const ovoid_pose *pose);

/// Two bodies as a pair.
posed posed_join(pool *p, body a, body b);

/// The pair in exact arithmetic. Both poses must have passed judge_is_pose_valid.
posed posed_make(pool *p, const ovoid_pair *pair);

/// 1 if finite, within OVOID_LENGTH_MAX, and the quaternion not zero.
int judge_is_pose_valid(const ovoid_pose *pose);

/// The largest |vertex|, in doubles.
double judge_find_extent(const ovoid_polytope *polytope);

/// M v and M' v.
nvec body_rotate(pool *p, const body *b, nvec v);
nvec body_rotate_back(pool *p, const body *b, nvec v);

/// n times the world point of a body-frame point, of a vertex.
nvec body_point(pool *p, const body *b, nvec local);
nvec body_vertex(pool *p, const body *b, uint32_t i);
/// 1 if a proof may name that vertex: of the polyhedron, or a point of a true body's rim or surface.
int body_has_vertex(const body *b, uint32_t i);

/// An upper bound of n `across` |direction x axis|: the length by which the true body exceeds the shape along the
/// direction if its allowance is along an axis, times n |direction|. 0 of true round bodies.
num body_find_across(pool *p, const body *b, nvec direction);

/// The largest (side 1) or smallest (side -1) n (direction . x) over the true round body; else over all vertices,
/// and the excess of the true body across its axis.
num body_support(pool *p, const body *b, nvec direction, int side);

/// A lower bound of the largest ball's radius about n times a world point in a true round body, times n; of a
/// point outside below zero, minus n times its distance, or less.
num body_find_room(pool *p, const body *b, nvec point);

/// k (x_b - x_a) for two points that carry n_a and n_b; for two vertices.
nvec posed_difference(const posed *s, nvec xa, nvec xb);
nvec posed_vertex_difference(const posed *s, uint32_t a, uint32_t b);

#endif
