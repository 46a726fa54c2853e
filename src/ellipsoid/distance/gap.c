// A lower bound of the distance of two ellipsoids that holds in exact arithmetic: for a unit vector n no point of a and
// no point of b are nearer than
//     g(n) = n . (cb - ca) - sqrt(n' Qa n) - sqrt(n' Qb n).
//
// Rounding, u = 2^-53. Each coordinate of cb - ca has a relative error of u, the dot product three more roundings per
// term: the first term is off by at most 5 u sum |n_i d_i|. n' Q n in doubles is off by at most 7 u T, T = |n|' |Q|
// |n|. Where T <= 16 n' Q n that moves the root by less than 64 u of itself. Else (n across a thin ellipsoid) the form
// is evaluated again in double-double: 18 products and sums of relative error 2^-100 leave less than 2^-95 T, so that
// the root is off by less than 2^-47 sqrt(T) even where Q is singular. |n| is 1 to 4 u. Underflow stays below
// OVOID_LENGTH_MIN, which is subtracted.
#include "ellipsoid/distance/gap.h"

#include "linear/exact.h"

/// n' Q n in double-double.
static double quadratic_exact(sym3 q, vec3 n) {
    const double entry[6] = {q.xx, q.yy, q.zz, 2 * q.xy, 2 * q.xz, 2 * q.yz};
    const double left[6] = {n.x, n.y, n.z, n.x, n.x, n.y}, right[6] = {n.x, n.y, n.z, n.y, n.z, n.z};
    dd sum = {0, 0};
    for (int k = 0; k < 6; k++) sum = dd_add(sum, dd_mul(dd_from(entry[k]), two_product(left[k], right[k])));
    return sum.high;
}

/// Never less than sqrt(n' Q n).
static double spread_above(sym3 q, vec3 n) {
    vec3 m = vec3_abs(n);
    sym3 p = {fabs(q.xx), fabs(q.xy), fabs(q.xz), fabs(q.yy), fabs(q.yz), fabs(q.zz)};
    double form = sym3_quadratic(q, n), terms = sym3_quadratic(p, m);
    if (!(terms <= 16 * form)) {
        form = fmax(0, quadratic_exact(q, n)) + 0x1p-95 * terms;
        return sqrt(form) * (1 + 4 * ROUNDING);
    }
    return sqrt(form) * (1 + 64 * ROUNDING);
}

scaled_pair ellipsoids_make_scaled(const ovoid_ellipsoid *a, const ovoid_ellipsoid *b) {
    vec3 d = vec3_sub(b->center, a->center);
    double size = fmax(vec3_max_abs(d), sqrt(fmax(sym3_trace(a->q), sym3_trace(b->q))));
    int e = find_unit_exponent(size);
    double down = ldexp(1, -e);
    return (scaled_pair){vec3_scale(d, down), sym3_scale(sym3_scale(a->q, down), down),
                         sym3_scale(sym3_scale(b->q, down), down), ldexp(1, e)};
}

double ellipsoids_compute_gap(const ovoid_ellipsoid *a, const ovoid_ellipsoid *b, vec3 n) {
    if (!(vec3_norm_squared(n) > 0.5)) return -INFINITY;
    scaled_pair p = ellipsoids_make_scaled(a, b);
    double along = vec3_dot(n, p.d), sa = spread_above(p.qa, n), sb = spread_above(p.qb, n);
    double terms = (fabs(n.x * p.d.x) + fabs(n.y * p.d.y)) + fabs(n.z * p.d.z);
    // The last subtractions and the length of n: a few u of the largest quantity.
    double gap = ((along - sa) - sb) - 16 * ROUNDING * (terms + sa + sb);
    return gap * p.unit - OVOID_LENGTH_MIN;
}
