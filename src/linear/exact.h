// Arithmetic beyond one double: error-free sums and products, double-double numbers, the exact sign of an orientation.
// T. J. Dekker, A floating-point technique for extending the available precision, 1971; J. R. Shewchuk, Adaptive
// precision floating-point arithmetic and fast robust geometric predicates, 1997.
#ifndef OVOID_LINEAR_EXACT_H
#define OVOID_LINEAR_EXACT_H

#include "linear/vec3.h"

/// high + low, exactly, with |low| <= ulp(high) / 2: about 106 bits.
typedef struct dd {
    double high, low;
} dd;

/// a + b = high + low exactly (Knuth), for any finite a, b without overflow.
static inline dd two_sum(double a, double b) {
    double s = a + b, v = s - a;
    return (dd){s, (a - (s - v)) + (b - v)};
}
/// a + b = high + low exactly (Dekker), where |a| >= |b|.
static inline dd quick_two_sum(double a, double b) {
    double s = a + b;
    return (dd){s, b - (s - a)};
}
/// a b = high + low exactly (Dekker), where |a|, |b| < 1e150 and the product is above 1e-290 or zero.
static inline dd two_product(double a, double b) {
    double p = a * b;
    double ta = 134217729.0 * a, tb = 134217729.0 * b;
    double ah = ta - (ta - a), al = a - ah, bh = tb - (tb - b), bl = b - bh;
    return (dd){p, al * bl - (((p - ah * bh) - al * bh) - ah * bl)};
}

/// Sum, difference, product and quotient: relative error at most 2^-102 (of |a| + |b| for sum and difference).
static inline dd dd_add(dd a, dd b) {
    dd s = two_sum(a.high, b.high), t = two_sum(a.low, b.low);
    s = quick_two_sum(s.high, s.low + t.high);
    return quick_two_sum(s.high, s.low + t.low);
}
static inline dd dd_neg(dd a) { return (dd){-a.high, -a.low}; }
static inline dd dd_sub(dd a, dd b) { return dd_add(a, dd_neg(b)); }
static inline dd dd_mul(dd a, dd b) {
    dd p = two_product(a.high, b.high);
    return quick_two_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
}
static inline dd dd_from(double a) { return (dd){a, 0}; }
static inline dd dd_div(dd a, dd b) {
    double q1 = a.high / b.high;
    dd r = dd_sub(a, dd_mul(b, dd_from(q1)));
    double q2 = r.high / b.high;
    r = dd_sub(r, dd_mul(b, dd_from(q2)));
    double q3 = r.high / b.high;
    dd q = quick_two_sum(q1, q2);
    return dd_add(q, dd_from(q3));
}

/// The exact sign (-1, 0, 1) of det(a - d, b - d, c - d): positive where d lies below the plane through a, b, c that
/// is seen counter-clockwise from above. Filtered twice, then expansions. Coordinates below 1e50 in size; differences
/// of products below 1e-280 count as zero.
int orient3d_sign(vec3 a, vec3 b, vec3 c, vec3 d);

#endif
