// Vectors, rotations and roots in double-double arithmetic (exact.h), by value. E = 2^-102 bounds the relative error of
// each operation on numbers; of vectors, the error of a sum of products is relative to the sum of their sizes. The
// caller keeps sizes where no product of interest is below 1e-270 (two_product).
#ifndef OVOID_LINEAR_DD3_H
#define OVOID_LINEAR_DD3_H

#include "linear/exact.h"
#include "linear/rotation.h"

typedef struct dd3 {
    dd x, y, z;
} dd3;

/// Rows.
typedef struct dd33 {
    dd3 r0, r1, r2;
} dd33;

static inline int dd_is_less(dd a, dd b) { return a.high < b.high || (a.high <= b.high && a.low < b.low); }
/// a s for s a power of two: exact.
static inline dd dd_scale(dd a, double s) { return (dd){a.high * s, a.low * s}; }
static inline dd dd_mul_double(dd a, double b) {
    dd p = two_product(a.high, b);
    return quick_two_sum(p.high, p.low + a.low * b);
}
/// The root of a number >= 0 (of a negative one 0), by one step of Newton from the double root. Products above 1e-270.
static inline dd dd_sqrt(dd a) {
    if (!(a.high > 0)) return (dd){0, 0};
    double r = sqrt(a.high);
    dd square = two_product(r, r);
    double rest = ((a.high - square.high) - square.low) + a.low;
    return quick_two_sum(r, rest / (2 * r));
}
/// The largest double that is not above a; the least double that is not below a.
static inline double dd_round_down(dd a) { return a.low < 0 ? nextafter(a.high, -INFINITY) : a.high; }
static inline double dd_round_up(dd a) { return a.low > 0 ? nextafter(a.high, INFINITY) : a.high; }

static inline dd3 dd3_from(vec3 a) { return (dd3){dd_from(a.x), dd_from(a.y), dd_from(a.z)}; }
/// high + low, normalised.
static inline dd3 dd3_make(vec3 high, vec3 low) {
    return (dd3){two_sum(high.x, low.x), two_sum(high.y, low.y), two_sum(high.z, low.z)};
}
static inline vec3 dd3_high(dd3 a) { return (vec3){a.x.high, a.y.high, a.z.high}; }
static inline vec3 dd3_low(dd3 a) { return (vec3){a.x.low, a.y.low, a.z.low}; }
static inline dd3 dd3_add(dd3 a, dd3 b) { return (dd3){dd_add(a.x, b.x), dd_add(a.y, b.y), dd_add(a.z, b.z)}; }
static inline dd3 dd3_neg(dd3 a) { return (dd3){dd_neg(a.x), dd_neg(a.y), dd_neg(a.z)}; }
static inline dd3 dd3_sub(dd3 a, dd3 b) { return dd3_add(a, dd3_neg(b)); }
static inline dd3 dd3_mul(dd3 a, dd s) { return (dd3){dd_mul(a.x, s), dd_mul(a.y, s), dd_mul(a.z, s)}; }
static inline dd3 dd3_mul_double(dd3 a, double s) {
    return (dd3){dd_mul_double(a.x, s), dd_mul_double(a.y, s), dd_mul_double(a.z, s)};
}
/// a + s b
static inline dd3 dd3_add_scaled(dd3 a, dd3 b, dd s) { return dd3_add(a, dd3_mul(b, s)); }
static inline dd dd3_dot(dd3 a, dd3 b) { return dd_add(dd_add(dd_mul(a.x, b.x), dd_mul(a.y, b.y)), dd_mul(a.z, b.z)); }
static inline dd dd3_dot_vec3(dd3 a, vec3 b) {
    return dd_add(dd_add(dd_mul_double(a.x, b.x), dd_mul_double(a.y, b.y)), dd_mul_double(a.z, b.z));
}
static inline dd3 dd3_cross(dd3 a, dd3 b) {
    return (dd3){dd_sub(dd_mul(a.y, b.z), dd_mul(a.z, b.y)), dd_sub(dd_mul(a.z, b.x), dd_mul(a.x, b.z)),
                 dd_sub(dd_mul(a.x, b.y), dd_mul(a.y, b.x))};
}
/// |a|, whatever its size: the squares are formed in a unit near it.
static inline dd dd3_norm(dd3 a) {
    double most = vec3_max_abs(dd3_high(a));
    if (!(most > 0)) return (dd){0, 0};
    int exponent;
    (void)frexp(most, &exponent);
    double unit = ldexp(1, -exponent);
    dd3 b = {dd_scale(a.x, unit), dd_scale(a.y, unit), dd_scale(a.z, unit)};
    return dd_scale(dd_sqrt(dd3_dot(b, b)), 1 / unit);
}
/// The unit vector along a; a zero vector stays zero.
static inline dd3 dd3_unit(dd3 a) {
    dd norm = dd3_norm(a);
    if (!(norm.high > 0)) return (dd3){{0, 0}, {0, 0}, {0, 0}};
    return (dd3){dd_div(a.x, norm), dd_div(a.y, norm), dd_div(a.z, norm)};
}

/// m v for a vector of doubles, m' v for one of double-doubles.
static inline dd3 dd33_mul_vec3(const dd33 *m, vec3 v) {
    return (dd3){dd3_dot_vec3(m->r0, v), dd3_dot_vec3(m->r1, v), dd3_dot_vec3(m->r2, v)};
}
static inline dd3 dd33_mul_transposed(const dd33 *m, dd3 v) {
    return dd3_add(dd3_add(dd3_mul(m->r0, v.x), dd3_mul(m->r1, v.y)), dd3_mul(m->r2, v.z));
}

/// R(q)/|q|^2: entries off by 15 E on the diagonal, 6 E beside it; in the operator norm by 32 E.
static inline dd33 dd33_from_quat(ovoid_quat q) {
    q = quat_scaled(q);
    dd ww = two_product(q.w, q.w), xx = two_product(q.x, q.x), yy = two_product(q.y, q.y), zz = two_product(q.z, q.z);
    dd xy = two_product(q.x, q.y), xz = two_product(q.x, q.z), yz = two_product(q.y, q.z);
    dd wx = two_product(q.w, q.x), wy = two_product(q.w, q.y), wz = two_product(q.w, q.z);
    dd s = dd_div(dd_from(2), dd_add(dd_add(ww, xx), dd_add(yy, zz))), one = dd_from(1);
    return (dd33){{dd_sub(one, dd_mul(s, dd_add(yy, zz))), dd_mul(s, dd_sub(xy, wz)), dd_mul(s, dd_add(xz, wy))},
                  {dd_mul(s, dd_add(xy, wz)), dd_sub(one, dd_mul(s, dd_add(xx, zz))), dd_mul(s, dd_sub(yz, wx))},
                  {dd_mul(s, dd_sub(xz, wy)), dd_mul(s, dd_add(yz, wx)), dd_sub(one, dd_mul(s, dd_add(xx, yy)))}};
}

#endif
