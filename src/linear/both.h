// Two numbers side by side, for arithmetic that is done on both at once; the bits are those of each alone.
#ifndef OVOID_LINEAR_BOTH_H
#define OVOID_LINEAR_BOTH_H

#include "linear/rotation.h"

#include <string.h>

typedef double both __attribute__((vector_size(16)));

static inline both both_make(double a, double b) { return (both){a, b}; }
/// x[0] and x[1], at any address.
static inline both both_load(const double *x) {
    both v;
    memcpy(&v, x, sizeof v);
    return v;
}
static inline void both_store(double *x, both v) { memcpy(x, &v, sizeof v); }
static inline both both_set(double x) { return both_make(x, x); }
typedef long long both_bits __attribute__((vector_size(16)));
static inline both both_abs(both v) { return (both)((both_bits)v & ~(both_bits)both_set(-0.0)); }
/// The lesser of each; b where one is NaN.
static inline both both_min(both a, both b) {
    both_bits is_less = a < b;
    return (both)((is_less & (both_bits)a) | (~is_less & (both_bits)b));
}

/// Two vectors, with the operations and the order of vec3.h.
typedef struct both_vec3 {
    both x, y, z;
} both_vec3;

static inline both_vec3 both_vec3_make(vec3 a, vec3 b) {
    return (both_vec3){both_make(a.x, b.x), both_make(a.y, b.y), both_make(a.z, b.z)};
}
/// One of the two.
static inline vec3 both_vec3_get(both_vec3 v, int which) { return (vec3){v.x[which], v.y[which], v.z[which]}; }
static inline both_vec3 both_vec3_sub(both_vec3 a, both_vec3 b) { return (both_vec3){a.x - b.x, a.y - b.y, a.z - b.z}; }
static inline both both_vec3_dot(both_vec3 a, both_vec3 b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }
static inline both_vec3 both_vec3_cross(both_vec3 a, both_vec3 b) {
    return (both_vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Two rotation matrices, row by row.
typedef struct both_mat3 {
    both r[9];
} both_mat3;

static inline both_mat3 both_mat3_make(mat3 a, mat3 b) {
    return (both_mat3){{both_make(a.r0.x, b.r0.x), both_make(a.r0.y, b.r0.y), both_make(a.r0.z, b.r0.z),
                        both_make(a.r1.x, b.r1.x), both_make(a.r1.y, b.r1.y), both_make(a.r1.z, b.r1.z),
                        both_make(a.r2.x, b.r2.x), both_make(a.r2.y, b.r2.y), both_make(a.r2.z, b.r2.z)}};
}
/// One of the two.
static inline mat3 both_mat3_get(const both_mat3 *m, int which) {
    const both *r = m->r;
    return (mat3){{r[0][which], r[1][which], r[2][which]},
                  {r[3][which], r[4][which], r[5][which]},
                  {r[6][which], r[7][which], r[8][which]}};
}
static inline both_vec3 both_mat3_mul_vec3(const both_mat3 *m, both_vec3 v) {
    const both *r = m->r;
    return (both_vec3){(r[0] * v.x + r[1] * v.y) + r[2] * v.z, (r[3] * v.x + r[4] * v.y) + r[5] * v.z,
                       (r[6] * v.x + r[7] * v.y) + r[8] * v.z};
}
static inline both_vec3 both_mat3_mul_transposed_vec3(const both_mat3 *m, both_vec3 v) {
    const both *r = m->r;
    return (both_vec3){(r[0] * v.x + r[3] * v.y) + r[6] * v.z, (r[1] * v.x + r[4] * v.y) + r[7] * v.z,
                       (r[2] * v.x + r[5] * v.y) + r[8] * v.z};
}

/// Both rotations, with the operations of quat_to_mat3. 0: a quaternion needs scaling, and nothing is set.
static inline int both_quat_to_mat3(ovoid_quat a, ovoid_quat b, both_mat3 *m) {
    both w = both_make(a.w, b.w), x = both_make(a.x, b.x), y = both_make(a.y, b.y), z = both_make(a.z, b.z);
    both ww = w * w, xx = x * x, yy = y * y, zz = z * z, norm = (ww + xx) + (yy + zz);
    if (!quat_is_plain(norm[0]) || !quat_is_plain(norm[1])) return 0;
    both one = both_make(1, 1), s = both_make(2, 2) / norm;
    both xy = x * y, xz = x * z, yz = y * z, wx = w * x, wy = w * y, wz = w * z;
    *m = (both_mat3){{one - s * (yy + zz), s * (xy - wz), s * (xz + wy), s * (xy + wz), one - s * (xx + zz),
                      s * (yz - wx), s * (xz - wy), s * (yz + wx), one - s * (xx + yy)}};
    return 1;
}

#endif
