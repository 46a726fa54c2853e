// 3x3 matrices, general and symmetric, by value.
#ifndef OVOID_LINEAR_MAT3_H
#define OVOID_LINEAR_MAT3_H

#include "linear/vec3.h"

typedef ovoid_sym3 sym3;

/// Rows.
typedef struct mat3 {
    vec3 r0, r1, r2;
} mat3;

static inline vec3 mat3_mul_vec3(mat3 m, vec3 v) {
    return (vec3){vec3_dot(m.r0, v), vec3_dot(m.r1, v), vec3_dot(m.r2, v)};
}
/// m' v
static inline vec3 mat3_mul_transposed_vec3(mat3 m, vec3 v) {
    return (vec3){(m.r0.x * v.x + m.r1.x * v.y) + m.r2.x * v.z, (m.r0.y * v.x + m.r1.y * v.y) + m.r2.y * v.z,
                  (m.r0.z * v.x + m.r1.z * v.y) + m.r2.z * v.z};
}
static inline mat3 mat3_transpose(mat3 m) {
    return (mat3){{m.r0.x, m.r1.x, m.r2.x}, {m.r0.y, m.r1.y, m.r2.y}, {m.r0.z, m.r1.z, m.r2.z}};
}
static inline mat3 mat3_mul(mat3 a, mat3 b) {
    return (mat3){mat3_mul_transposed_vec3(b, a.r0), mat3_mul_transposed_vec3(b, a.r1),
                  mat3_mul_transposed_vec3(b, a.r2)};
}
/// a' b
static inline mat3 mat3_mul_transposed(mat3 a, mat3 b) { return mat3_mul(mat3_transpose(a), b); }

static inline vec3 sym3_mul_vec3(sym3 s, vec3 v) {
    return (vec3){(s.xx * v.x + s.xy * v.y) + s.xz * v.z, (s.xy * v.x + s.yy * v.y) + s.yz * v.z,
                  (s.xz * v.x + s.yz * v.y) + s.zz * v.z};
}
/// v' S v
static inline double sym3_quadratic(sym3 s, vec3 v) { return vec3_dot(v, sym3_mul_vec3(s, v)); }
static inline sym3 sym3_add(sym3 a, sym3 b) {
    return (sym3){a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yy + b.yy, a.yz + b.yz, a.zz + b.zz};
}
static inline sym3 sym3_scale(sym3 a, double s) {
    return (sym3){a.xx * s, a.xy * s, a.xz * s, a.yy * s, a.yz * s, a.zz * s};
}
/// s v v'
static inline sym3 sym3_outer(vec3 v, double s) {
    return (sym3){s * v.x * v.x, s * v.x * v.y, s * v.x * v.z, s * v.y * v.y, s * v.y * v.z, s * v.z * v.z};
}
static inline sym3 sym3_diagonal(double x, double y, double z) { return (sym3){x, 0, 0, y, 0, z}; }
static inline double sym3_trace(sym3 s) { return s.xx + s.yy + s.zz; }
static inline double sym3_det(sym3 s) {
    return s.xx * (s.yy * s.zz - s.yz * s.yz) - s.xy * (s.xy * s.zz - s.yz * s.xz) + s.xz * (s.xy * s.yz - s.yy * s.xz);
}
/// R S R'
static inline sym3 sym3_rotate(sym3 s, mat3 r) {
    vec3 a = sym3_mul_vec3(s, r.r0), b = sym3_mul_vec3(s, r.r1), c = sym3_mul_vec3(s, r.r2);
    return (sym3){vec3_dot(r.r0, a), vec3_dot(r.r1, a), vec3_dot(r.r2, a),
                  vec3_dot(r.r1, b), vec3_dot(r.r2, b), vec3_dot(r.r2, c)};
}

/// The adjugate: the cofactors.
static inline sym3 sym3_adjugate(sym3 s) {
    return (sym3){s.yy * s.zz - s.yz * s.yz, s.xz * s.yz - s.xy * s.zz, s.xy * s.yz - s.xz * s.yy,
                  s.xx * s.zz - s.xz * s.xz, s.xy * s.xz - s.xx * s.yz, s.xx * s.yy - s.xy * s.xy};
}

/// The inverse by cofactors; for well-scaled positive definite matrices.
static inline sym3 sym3_inverse(sym3 s) {
    sym3 c = sym3_adjugate(s);
    double det = (s.xx * c.xx + s.xy * c.xy) + s.xz * c.xz;
    return sym3_scale(c, 1 / det);
}

/// Eigenvalues in ascending order and their unit eigenvectors (a right-handed basis, as rows of v).
typedef struct eigen3 {
    double value[3];
    mat3 v;
} eigen3;

/// Eigenvalues by cyclic Jacobi rotations (C. G. J. Jacobi, 1846): exact to rounding, at most 30 sweeps.
eigen3 sym3_compute_eigen(sym3 s);

/// V' diag(value) V for the rows v of the basis.
static inline sym3 sym3_from_eigen(const double value[3], mat3 v) {
    return sym3_add(sym3_add(sym3_outer(v.r0, value[0]), sym3_outer(v.r1, value[1])), sym3_outer(v.r2, value[2]));
}

/// Solves S x = b for positive definite S by Cholesky (no pivots); 0 if S is not positive definite in doubles.
static inline int sym3_solve(sym3 s, vec3 b, vec3 *x) {
    double l00 = s.xx;
    if (!(l00 > 0)) return 0;
    double l10 = s.xy / l00, l20 = s.xz / l00;
    double d1 = s.yy - l10 * s.xy;
    if (!(d1 > 0)) return 0;
    double e = s.yz - l10 * s.xz, l21 = e / d1;
    double d2 = s.zz - l20 * s.xz - l21 * e;
    if (!(d2 > 0)) return 0;
    double y0 = b.x, y1 = b.y - l10 * y0, y2 = b.z - l20 * y0 - l21 * y1;
    x->z = y2 / d2;
    x->y = y1 / d1 - l21 * x->z;
    x->x = y0 / l00 - l10 * x->y - l20 * x->z;
    return 1;
}

#endif
