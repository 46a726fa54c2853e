// Vectors by value: the arithmetic every floor above uses. Plain operations in a fixed order, so that results are the
// same bits with every compiler (contraction is off).
#ifndef OVOID_LINEAR_VEC3_H
#define OVOID_LINEAR_VEC3_H

#include "base/arithmetic.h"
#include "ovoid/linear.h"

#include <math.h>

typedef ovoid_vec3 vec3;

/// Points, x, y and z of each one after another.
typedef struct xyz_points {
    const double *xyz;
    size_t count;
} xyz_points;

/// The unit roundoff u of doubles, 2^-53.
#define ROUNDING 0x1p-53

/// The larger and the smaller of two numbers; b where one of them is NaN. One instruction, where fmax is a call.
static inline double max2(double a, double b) { return a > b ? a : b; }
static inline double min2(double a, double b) { return a < b ? a : b; }

static inline vec3 vec3_make(double x, double y, double z) { return (vec3){x, y, z}; }
static inline vec3 vec3_at(const double *xyz, size_t i) { return (vec3){xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]}; }
/// Coordinate 0, 1 or 2.
static inline double vec3_get(vec3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }
static inline vec3 vec3_add(vec3 a, vec3 b) { return (vec3){a.x + b.x, a.y + b.y, a.z + b.z}; }
static inline vec3 vec3_sub(vec3 a, vec3 b) { return (vec3){a.x - b.x, a.y - b.y, a.z - b.z}; }
static inline vec3 vec3_neg(vec3 a) { return (vec3){-a.x, -a.y, -a.z}; }
/// a with zeros that are positive.
static inline vec3 vec3_clear_signs(vec3 a) { return (vec3){a.x + 0.0, a.y + 0.0, a.z + 0.0}; }
static inline vec3 vec3_scale(vec3 a, double s) { return (vec3){a.x * s, a.y * s, a.z * s}; }
/// a + s b
static inline vec3 vec3_add_scaled(vec3 a, vec3 b, double s) {
    return (vec3){a.x + b.x * s, a.y + b.y * s, a.z + b.z * s};
}
static inline double vec3_dot(vec3 a, vec3 b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }
static inline vec3 vec3_cross(vec3 a, vec3 b) {
    return (vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static inline double vec3_norm_squared(vec3 a) { return vec3_dot(a, a); }
static inline double vec3_norm(vec3 a) { return sqrt(vec3_dot(a, a)); }
static inline int vec3_is_finite(vec3 a) { return isfinite(a.x) && isfinite(a.y) && isfinite(a.z); }
static inline vec3 vec3_abs(vec3 a) { return (vec3){fabs(a.x), fabs(a.y), fabs(a.z)}; }
static inline double vec3_max_abs(vec3 a) { return max2(fabs(a.x), max2(fabs(a.y), fabs(a.z))); }
/// The coordinate that is largest, the first one of several. Without a branch, since it mostly follows no pattern.
static inline int vec3_find_largest(vec3 a) {
    int is_x = (a.x >= a.y) & (a.x >= a.z);
    return !is_x * (2 - (a.y >= a.z));
}

/// The unit vector along a; a zero vector stays zero. Scaled first where a square could under- or overflow.
static inline vec3 vec3_unit(vec3 a) {
    double square = vec3_norm_squared(a);
    if (square > 1e-250 && square < 1e250) return vec3_scale(a, 1 / sqrt(square));
    double m = vec3_max_abs(a);
    if (!(m > 0)) return (vec3){0, 0, 0};
    a = (vec3){a.x / m, a.y / m, a.z / m};
    return vec3_scale(a, 1 / vec3_norm(a));
}

/// The exponent e for which 2^-e brings lengths of that size to about 1; at least -1000, so that neither the power nor
/// its reciprocal overflows.
static inline int find_unit_exponent(double size) {
    int e;
    (void)frexp(size, &e);
    return e < -1000 ? -1000 : e;
}

/// A unit vector orthogonal to the unit vector a.
static inline vec3 vec3_orthogonal(vec3 a) {
    double x = fabs(a.x), y = fabs(a.y), z = fabs(a.z);
    vec3 axis = x <= y && x <= z ? (vec3){1, 0, 0} : y <= z ? (vec3){0, 1, 0} : (vec3){0, 0, 1};
    return vec3_unit(vec3_cross(a, axis));
}

#endif
