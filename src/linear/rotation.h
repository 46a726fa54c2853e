// The rotation matrix of a quaternion of any norm but zero.
#ifndef OVOID_LINEAR_ROTATION_H
#define OVOID_LINEAR_ROTATION_H

#include "linear/mat3.h"

/// q scaled by a power of two so that its largest component lies in [1/2, 1): exact (but for subnormal leftovers,
/// below 2^-1022 of the norm), and no square can under- or overflow. q must be finite and not zero.
static inline ovoid_quat quat_scaled(ovoid_quat q) {
    double m = max2(max2(fabs(q.w), fabs(q.x)), max2(fabs(q.y), fabs(q.z)));
    int e;
    (void)frexp(m, &e);
    if (e == 0) return q;
    return (ovoid_quat){ldexp(q.w, -e), ldexp(q.x, -e), ldexp(q.y, -e), ldexp(q.z, -e)};
}

/// |q|^2, and whether it shows that q needs no scaling: the products of its components are then those of the scaled
/// quaternion times a power of two, unless they are below 2^-900.
static inline double quat_norm_squared(ovoid_quat q) { return (q.w * q.w + q.x * q.x) + (q.y * q.y + q.z * q.z); }
static inline int quat_is_plain(double norm_squared) { return norm_squared > 0x1p-60 && norm_squared < 0x1p60; }

/// R(q)/|q|^2. Each entry has at most 12 roundings of quantities below 1 after the division: absolute error at most
/// 12 u per entry, u = 2^-53, hence at most 36 u in the operator norm.
static inline mat3 quat_to_mat3(ovoid_quat q) {
    if (!quat_is_plain(quat_norm_squared(q))) q = quat_scaled(q);
    double ww = q.w * q.w, xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z;
    double s = 2 / ((ww + xx) + (yy + zz));
    double xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z, wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
    return (mat3){{1 - s * (yy + zz), s * (xy - wz), s * (xz + wy)},
                  {s * (xy + wz), 1 - s * (xx + zz), s * (yz - wx)},
                  {s * (xz - wy), s * (yz + wx), 1 - s * (xx + yy)}};
}

#endif
