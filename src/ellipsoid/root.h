// Lower triangular 3x3 matrices: roots L of a symmetric matrix L L' (A.-L. Cholesky, 1910), by value.
#ifndef OVOID_ELLIPSOID_ROOT_H
#define OVOID_ELLIPSOID_ROOT_H

#include "linear/mat3.h"

/// A lower triangular matrix; its entries by rows.
typedef struct lower3 {
    double xx, yx, yy, zx, zy, zz;
} lower3;

/// The root of s. 0 if a pivot is below 1e-12 of its diagonal entry: then doubles lose the thin axis.
static inline int lower3_make_root(sym3 s, lower3 *l) {
    if (!(s.xx > 0)) return 0;
    l->xx = sqrt(s.xx), l->yx = s.xy / l->xx, l->zx = s.xz / l->xx;
    double d = s.yy - l->yx * l->yx;
    if (!(d > 1e-12 * s.yy)) return 0;
    l->yy = sqrt(d), l->zy = (s.yz - l->zx * l->yx) / l->yy;
    d = (s.zz - l->zx * l->zx) - l->zy * l->zy;
    if (!(d > 1e-12 * s.zz)) return 0;
    l->zz = sqrt(d);
    return isfinite(l->xx * l->yy * l->zz);
}

static inline lower3 lower3_inverse(lower3 l) {
    lower3 i = {.xx = 1 / l.xx, .yy = 1 / l.yy, .zz = 1 / l.zz};
    i.yx = -l.yx * i.xx * i.yy;
    i.zy = -l.zy * i.yy * i.zz;
    i.zx = -(l.zx * i.xx + l.zy * i.yx) * i.zz;
    return i;
}

static inline lower3 lower3_scale(lower3 l, double s) {
    return (lower3){l.xx * s, l.yx * s, l.yy * s, l.zx * s, l.zy * s, l.zz * s};
}

static inline lower3 lower3_mul(lower3 a, lower3 b) {
    return (lower3){a.xx * b.xx,
                    a.yx * b.xx + a.yy * b.yx,
                    a.yy * b.yy,
                    (a.zx * b.xx + a.zy * b.yx) + a.zz * b.zx,
                    a.zy * b.yy + a.zz * b.zy,
                    a.zz * b.zz};
}

static inline vec3 lower3_mul_vec3(lower3 l, vec3 v) {
    return (vec3){l.xx * v.x, l.yx * v.x + l.yy * v.y, (l.zx * v.x + l.zy * v.y) + l.zz * v.z};
}
/// l' v
static inline vec3 lower3_mul_transposed_vec3(lower3 l, vec3 v) {
    return (vec3){(l.xx * v.x + l.yx * v.y) + l.zx * v.z, l.yy * v.y + l.zy * v.z, l.zz * v.z};
}
/// l l'
static inline sym3 lower3_square(lower3 l) {
    return (sym3){l.xx * l.xx,
                  l.xx * l.yx,
                  l.xx * l.zx,
                  l.yx * l.yx + l.yy * l.yy,
                  l.yx * l.zx + l.yy * l.zy,
                  (l.zx * l.zx + l.zy * l.zy) + l.zz * l.zz};
}
static inline mat3 lower3_to_mat3(lower3 l) { return (mat3){{l.xx, 0, 0}, {l.yx, l.yy, 0}, {l.zx, l.zy, l.zz}}; }

#endif
