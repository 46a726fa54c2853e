// The root of an ellipsoid's matrix: three vectors E with Q = E E', so that the body is { center + E p : |p| <= 1 }.
#ifndef OVOID_ELLIPSOID_DISTANCE_ROOT_H
#define OVOID_ELLIPSOID_DISTANCE_ROOT_H

#include "linear/mat3.h"

/// Three vectors whose outer products sum to Q: the columns of E.
typedef struct root3 {
    vec3 axis[3];
} root3;

/// Q = E E' by Cholesky with diagonal pivots, in doubles or in double-double (doubles lose the thin axis of a thin
/// body). Pivots that are rounding errors of the largest are taken for zero.
root3 root3_make(sym3 q, int is_exact);

/// E p
static inline vec3 root3_map(const root3 *e, vec3 p) {
    return vec3_add_scaled(vec3_add_scaled(vec3_scale(e->axis[0], p.x), e->axis[1], p.y), e->axis[2], p.z);
}
/// E' n
static inline vec3 root3_map_transposed(const root3 *e, vec3 n) {
    return (vec3){vec3_dot(e->axis[0], n), vec3_dot(e->axis[1], n), vec3_dot(e->axis[2], n)};
}

/// The nearest points E_a p and d + E_b q of two bodies around 0 and d.
typedef struct root3_nearest {
    vec3 normal; ///< unit, from a to b
    vec3 p, q;   ///< |p|, |q| <= 1
    uint32_t rounds;
} root3_nearest;

/// Nearest points from the roots themselves, so that flat bodies stay flat; lengths must be about one. 0 if the bodies
/// are not apart. Defined in nearest.c.
int roots_find_nearest(const root3 *a, const root3 *b, vec3 d, root3_nearest *found);

#endif
