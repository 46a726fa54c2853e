// Whether two ellipsoids share a point. The pencil (pencil.c) decides in doubles. "Apart" needs no proof here, since 0
// also means "not known". "Share a point" is proven: the rounded point itself lies strictly inside both.
//
// With the rounded v and s, the exact points xa = ca + (1 - s) Qa v and xb = cb - s Qb v have the exact norms ma, mb of
// the pencil. The returned point differs from them by roundings and by the residual of the solve, all of which is
// computed and bounded; a point off by e has a norm higher by at most e / r, where r^2 is a lower bound of the least
// eigenvalue. So ellipsoids too thin for doubles (radii 1 : 1e-7) get 0, and for a flat ellipsoid only the centre,
// which is exact, can be proven to be in another. Cost: 15 ns for most pairs apart, about 100 ns for a proof.
#include "base/environment.h"
#include "ellipsoid/distance/gap.h"
#include "ellipsoid/distance/pencil.h"

/// A lower bound of the least eigenvalue of Q, rounding included; not positive if none is certain. The trace of Q^-1 =
/// L'^-1 D^-1 L^-1 bounds its largest eigenvalue; the computed factor belongs to a matrix off by less than 16 u trace.
static double least_eigenvalue_below(sym3 q) {
    ldl3 f;
    if (!ldl3_make(q, &f)) return 0;
    double m20 = f.l10 * f.l21 - f.l20;
    double inverse_trace = ((1 + f.l10 * f.l10) + m20 * m20) * f.r0 + (1 + f.l21 * f.l21) * f.r1 + f.r2;
    return (1 - 64 * ROUNDING) / inverse_trace - 16 * ROUNDING * sym3_trace(q);
}

static double norm_1(vec3 v) { return (fabs(v.x) + fabs(v.y)) + fabs(v.z); }

/// 1 if the point x is proven strictly inside the ellipsoid (c, Q), where x = c + t Q v up to `off` (a length), which
/// makes (x - c)' Q^-1 (x - c) = t^2 v' Q v; the three-term sums of Q v and v' Q v are off by less than 16 u in all.
static int is_inside(const ovoid_ellipsoid *e, vec3 v, double t, double off) {
    vec3 c = e->center;
    sym3 q = e->q;
    double least = least_eigenvalue_below(q);
    if (!(least > 0)) return 0;
    double length = norm_1(v) * fabs(t), trace = sym3_trace(q);
    double m = t * t * sym3_quadratic(q, v) + 32 * ROUNDING * trace * length * length;
    double slip = off + 32 * ROUNDING * (norm_1(c) + trace * length);
    return sqrt(fmax(m, 0)) + slip / sqrt(least) <= 1 - 1e-12;
}

/// 1 if the point of the pencil, in *x, is proven inside both.
static int is_common(const ovoid_ellipsoid *a, const ovoid_ellipsoid *b, const pencil *p, vec3 *x) {
    *x = vec3_add_scaled(a->center, sym3_mul_vec3(a->q, p->v), 1 - p->s);
    vec3 same = vec3_add_scaled(b->center, sym3_mul_vec3(b->q, p->v), -p->s);
    double mine = 4 * ROUNDING * norm_1(*x), off = norm_1(vec3_sub(*x, same)) + mine;
    return is_inside(a, p->v, 1 - p->s, mine) && is_inside(b, p->v, -p->s, off);
}

/// 1 if the centre of b, which is exactly a point of b, is proven inside a.
static int is_center_inside(const ovoid_ellipsoid *a, const ovoid_ellipsoid *b) {
    ldl3 f;
    if (!ldl3_make(a->q, &f)) return 0;
    vec3 d = vec3_sub(b->center, a->center), v = ldl3_solve(&f, d);
    double off = norm_1(vec3_sub(sym3_mul_vec3(a->q, v), d)) + 4 * ROUNDING * norm_1(d);
    ovoid_ellipsoid around_zero = {{0, 0, 0}, a->q};
    return is_inside(&around_zero, v, 1, off);
}

/// ellipsoids_are_overlapping for lengths whose fourth powers neither over- nor underflow.
static int is_overlapping(const ovoid_ellipsoid *a, const ovoid_ellipsoid *b, vec3 *x) {
    // Apart along the line of centres?
    vec3 d = vec3_sub(b->center, a->center);
    if (vec3_norm_squared(d) > sym3_spread(a->q, d) + sym3_spread(b->q, d)) return 0;

    pencil p = pencil_search(a->q, b->q, d);
    if (p.state == PENCIL_APART) return 0;
    if (p.state == PENCIL_COMMON && is_common(a, b, &p, x)) return 1;
    *x = b->center;
    if (is_center_inside(a, b)) return 1;
    *x = a->center;
    return is_center_inside(b, a);
}

int ellipsoids_are_overlapping(const ovoid_ellipsoid *a, const ovoid_ellipsoid *b, ovoid_vec3 *point) {
    vec3 x, d = vec3_sub(b->center, a->center);
    double trace = sym3_trace(a->q) + sym3_trace(b->q), size = fmax(vec3_norm_squared(d), trace);
    int known;
    if (size > 1e-60 && size < 1e60) {
        known = is_overlapping(a, b, &x);
    } else {
        // For sizes far from one: computed in units of a power of two near the pair's size, which changes no digit.
        scaled_pair p = ellipsoids_make_scaled(a, b);
        ovoid_ellipsoid near_a = {vec3_scale(a->center, 1 / p.unit), p.qa};
        ovoid_ellipsoid near_b = {vec3_scale(b->center, 1 / p.unit), p.qb};
        known = is_overlapping(&near_a, &near_b, &x);
        x = vec3_scale(x, p.unit);
    }
    if (known && point) *point = x;
    return known;
}

int ovoid_ellipsoid_is_overlapping(const ovoid_ellipsoid *a, const ovoid_ellipsoid *b, ovoid_vec3 *point) {
    ENVIRONMENT_RETURN(int, a, ellipsoids_are_overlapping(a, b, point));
}
