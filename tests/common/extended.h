// Points and directions in long double, for tests that compare rounded results with exact ones. Its 64 bits are 11 more
// than a double's: its rounding is below 2^-60 of the lengths, and a test subtracts that. If long double is double
// there is nothing to compare with: EXTENDED is 0 and the test says that it skips.
#ifndef OVOID_TESTS_EXTENDED_H
#define OVOID_TESTS_EXTENDED_H

#include <float.h>
#include <math.h>

#include "ovoid/linear.h"

#define EXTENDED (LDBL_MANT_DIG >= 64)
#define EXTENDED_ROUNDING 0x1p-60L

typedef struct extended3 {
    long double x, y, z;
} extended3;

static inline extended3 extended3_from(ovoid_vec3 v) { return (extended3){v.x, v.y, v.z}; }
static inline extended3 extended3_add(extended3 a, extended3 b) { return (extended3){a.x + b.x, a.y + b.y, a.z + b.z}; }
static inline extended3 extended3_sub(extended3 a, extended3 b) { return (extended3){a.x - b.x, a.y - b.y, a.z - b.z}; }
static inline extended3 extended3_scale(extended3 a, long double s) { return (extended3){a.x * s, a.y * s, a.z * s}; }
static inline extended3 extended3_cross(extended3 a, extended3 b) {
    return (extended3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static inline long double extended3_dot(extended3 a, extended3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline long double extended3_norm(extended3 a) { return sqrtl(extended3_dot(a, a)); }

/// The rotation of a quaternion of any norm: v + 2 (w (q x v) + q x (q x v)) / |q|^2.
static inline extended3 extended3_rotate(ovoid_quat q, extended3 v) {
    extended3 axis = {q.x, q.y, q.z}, across = extended3_cross(axis, v), twice = extended3_cross(axis, across);
    long double norm = (long double)q.w * q.w + extended3_dot(axis, axis);
    return extended3_add(v, extended3_scale(extended3_add(extended3_scale(across, q.w), twice), 2 / norm));
}
/// Turned about a unit axis: O. Rodrigues, 1840.
static inline extended3 extended3_turn(extended3 axis, long double angle, extended3 v) {
    extended3 across = extended3_cross(axis, v);
    long double s = sinl(angle), h = sinl(angle / 2);
    return extended3_add(
        v, extended3_add(extended3_scale(across, s), extended3_scale(extended3_cross(axis, across), 2 * h * h)));
}
static inline extended3 extended3_place(const ovoid_pose *pose, extended3 v) {
    return extended3_add(extended3_from(pose->position), extended3_rotate(pose->rotation, v));
}

#endif
