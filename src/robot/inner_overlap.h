// Whether the ellipsoids inside two bodies prove that these overlap, before anything exact is asked.
//
// The point x where the sum of both squared norms is least, (Pa + Pb) (x - ca) = Pb (cb - ca), is well inside both
// wherever they overlap much. Its norms are measured as shape/block.h has them, with what rounding does to its place
// added, so that it is a point of both bodies whatever x is; the ball of radius (1 - norm) least around it is in each.
#ifndef OVOID_ROBOT_INNER_OVERLAP_H
#define OVOID_ROBOT_INNER_OVERLAP_H

#include "robot/cell.h"

/// A body in the world.
typedef struct inner_body {
    const ovoid_shape *shape;
    const mat3 *rotation;
    vec3 center; ///< of the ellipsoid
    double size; ///< the lengths that it is made of, summed
    sym3 form;   ///< W' W
} inner_body;

/// 1 if the ellipsoids can overlap: forms are not read.
static inline int inner_bodies_are_near(const inner_body *a, const inner_body *b) {
    const shape_inner *in_a = &a->shape->inside, *in_b = &b->shape->inside;
    double reach = in_a->reach + in_b->reach;
    return in_a->least > 0 && in_b->least > 0 && vec3_norm_squared(vec3_sub(b->center, a->center)) < reach * reach;
}

/// An upper bound of the norm of the point that is y from the ellipsoid's centre, both rounded by up to `error`.
static inline double inner_body_measure(const inner_body *b, vec3 y, double error) {
    const double *w = b->shape->inside.w;
    vec3 own = mat3_mul_transposed_vec3(*b->rotation, y);
    vec3 wy = {w[0] * own.x, w[1] * own.x + w[2] * own.y, (w[3] * own.x + w[4] * own.y) + w[5] * own.z};
    return vec3_norm(wy) * (1 + 1e-6) + error / b->shape->inside.least;
}

/// An upper bound, below zero, of the signed distance of near bodies as they are posed; 0 where none is proven.
static inline double inner_bodies_compute_upper(const inner_body *a, const inner_body *b) {
    const shape_inner *in_a = &a->shape->inside, *in_b = &b->shape->inside;
    vec3 d = vec3_sub(b->center, a->center);
    double error = CELL_SLACK * ((a->size + b->size) + (in_a->reach + in_b->reach));
    vec3 from_a = sym3_mul_vec3(sym3_inverse(sym3_add(a->form, b->form)), sym3_mul_vec3(b->form, d));
    double of_a = inner_body_measure(a, from_a, error), of_b = inner_body_measure(b, vec3_sub(from_a, d), error);
    if (!(of_a < 1 - 1e-5) || !(of_b < 1 - 1e-5)) return 0;
    double ball = 0.999 * ((1 - of_a) * in_a->least + (1 - of_b) * in_b->least);
    return -ball - (a->shape->upper_radius + b->shape->upper_radius);
}

#endif
