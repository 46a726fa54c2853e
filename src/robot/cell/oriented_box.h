// Boxes with rotations around items and parts: a few axes often part two whose spheres overlap.
//
// The axes of both boxes' faces and the line of their centres (S. Gottschalk, M. C. Lin, D. Manocha, OBBTree, 1996,
// without the products of edges, which seldom part what these do not). The gap along any unit direction is a lower
// bound of the distance. Rotations are off by some 50 u, so an axis is a unit vector and a projection right to 256 u of
// the lengths at hand, which the test adds to the reach.
#ifndef OVOID_ROBOT_CELL_ORIENTED_BOX_H
#define OVOID_ROBOT_CELL_ORIENTED_BOX_H

#include "linear/mat3.h"

#define BOX_SLACK 0x1p-45

typedef struct oriented_box {
    mat3 rotation; ///< to the world; its columns are the box' axes
    vec3 center, half;
    double radius; ///< what the body stands out of the box, and what rounding may add
} oriented_box;

static inline double vec3_sum_abs(vec3 v) { return (fabs(v.x) + fabs(v.y)) + fabs(v.z); }

/// The largest gap along the axes of both boxes' faces, rounded, without radii; *axis: which, 0 to 2 A's, 3 to 5 B's.
static inline double oriented_boxes_find_gap(const oriented_box *a, const oriented_box *b, vec3 in_a, vec3 in_b,
                                             int *axis) {
    mat3 m = mat3_mul_transposed(a->rotation, b->rotation); // rows: axes of A in B's frame
    vec3 r0 = vec3_abs(m.r0), r1 = vec3_abs(m.r1), r2 = vec3_abs(m.r2), h = a->half, k = b->half;
    const double gaps[6] = {in_a.x - h.x - vec3_dot(r0, k),
                            in_a.y - h.y - vec3_dot(r1, k),
                            in_a.z - h.z - vec3_dot(r2, k),
                            in_b.x - k.x - ((h.x * r0.x + h.y * r1.x) + h.z * r2.x),
                            in_b.y - k.y - ((h.x * r0.y + h.y * r1.y) + h.z * r2.y),
                            in_b.z - k.z - ((h.x * r0.z + h.y * r1.z) + h.z * r2.z)};
    *axis = 0;
    for (int i = 1; i < 6; i++) *axis = gaps[i] > gaps[*axis] ? i : *axis;
    return gaps[*axis];
}

static inline vec3 oriented_box_get_axis(const oriented_box *a, int i) {
    const mat3 *r = &a->rotation;
    return i == 0   ? (vec3){r->r0.x, r->r1.x, r->r2.x}
           : i == 1 ? (vec3){r->r0.y, r->r1.y, r->r2.y}
                    : (vec3){r->r0.z, r->r1.z, r->r2.z};
}

/// What parts two boxes best: 1 where they are proven farther apart than the margin. Else *normal is the unit direction
/// of the axes and the line of centres along which they are farthest apart, from A to B.
static inline int oriented_boxes_part(const oriented_box *a, const oriented_box *b, double margin, vec3 *normal) {
    vec3 d = vec3_sub(b->center, a->center);
    double size = (vec3_sum_abs(a->center) + vec3_sum_abs(b->center)) + (vec3_sum_abs(a->half) + vec3_sum_abs(b->half));
    double reach = ((a->radius + b->radius) + margin) + BOX_SLACK * size;
    vec3 in_a = vec3_abs(mat3_mul_transposed_vec3(a->rotation, d)),
         in_b = vec3_abs(mat3_mul_transposed_vec3(b->rotation, d));
    int axis;
    double most = oriented_boxes_find_gap(a, b, in_a, in_b, &axis);
    if (most > reach) return 1;
    // Along the line of centres, times its length.
    double square = vec3_norm_squared(d), along = square - vec3_dot(a->half, in_a) - vec3_dot(b->half, in_b);
    if (along > 0 && along * along * (1 - 0x1p-40) > reach * reach * square) return 1;
    vec3 n = axis < 3 ? oriented_box_get_axis(a, axis) : oriented_box_get_axis(b, axis - 3);
    *normal = vec3_dot(n, d) < 0 ? vec3_neg(n) : n;
    double length = sqrt(square);
    if (along > most * length) *normal = vec3_scale(d, 1 / length);
    return 0;
}

/// 1 where two boxes are proven farther apart than the margin.
static inline int oriented_boxes_are_far(const oriented_box *a, const oriented_box *b, double margin) {
    vec3 normal;
    return oriented_boxes_part(a, b, margin, &normal);
}

/// A lower bound of the signed distance of what two boxes hold: the largest gap along the axes of their faces.
static inline double oriented_boxes_compute_lower(const oriented_box *a, const oriented_box *b) {
    vec3 d = vec3_sub(b->center, a->center);
    vec3 in_a = vec3_abs(mat3_mul_transposed_vec3(a->rotation, d)),
         in_b = vec3_abs(mat3_mul_transposed_vec3(b->rotation, d));
    double size = (vec3_sum_abs(a->center) + vec3_sum_abs(b->center)) + (vec3_sum_abs(a->half) + vec3_sum_abs(b->half));
    int axis;
    double most = oriented_boxes_find_gap(a, b, in_a, in_b, &axis), radii = a->radius + b->radius;
    return most - radii - BOX_SLACK * (size + radii);
}

/// The gap along a unit direction, rounded.
static inline double oriented_boxes_measure_gap(const oriented_box *a, const oriented_box *b, vec3 n) {
    vec3 in_a = vec3_abs(mat3_mul_transposed_vec3(a->rotation, n)),
         in_b = vec3_abs(mat3_mul_transposed_vec3(b->rotation, n));
    double apart = vec3_dot(n, vec3_sub(b->center, a->center));
    return apart - vec3_dot(a->half, in_a) - vec3_dot(b->half, in_b) - (a->radius + b->radius);
}

#endif
