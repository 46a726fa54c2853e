// Pairs of ellipsoids whose distance is known by construction, for the tests of proximity.
#ifndef OVOID_TESTS_PAIRS_H
#define OVOID_TESTS_PAIRS_H

#include "check.h"
#include "linear/exact.h"
#include "linear/mat3.h"
#include "linear/rotation.h"
#include "ovoid/ellipsoid.h"

/// The kinds of a test's ellipsoids.
typedef enum kind { KIND_ROUND, KIND_PLAIN, KIND_THIN, KIND_EXTREME, KIND_FLAT, KIND_COUNT } kind;
static const char *const kind_names[KIND_COUNT] = {"spheres", "1:5", "1:1000", "1:1e5", "flat, segments, points"};

static inline double kind_radius(kind k, uint64_t *s) {
    switch (k) {
    case KIND_ROUND: return 1;
    case KIND_PLAIN: return exp(-random_uniform(s, 0, log(5)));
    case KIND_THIN: return exp(-random_uniform(s, 0, log(1e3)));
    case KIND_EXTREME: return exp(-random_uniform(s, 0, log(1e5)));
    default: return random_next(s) & 1 ? 0 : random_uniform(s, 0.2, 1);
    }
}

static inline mat3 random_rotation(uint64_t *s) {
    return quat_to_mat3((ovoid_quat){random_normal(s), random_normal(s), random_normal(s), random_normal(s)});
}
static inline vec3 random_unit(uint64_t *s) {
    return vec3_unit((vec3){random_normal(s), random_normal(s), random_normal(s)});
}

static inline ovoid_ellipsoid make_ellipsoid(kind k, vec3 center, uint64_t *s) {
    double x = kind_radius(k, s), y = kind_radius(k, s), z = kind_radius(k, s);
    return (ovoid_ellipsoid){center, sym3_rotate(sym3_diagonal(x * x, y * y, z * z), random_rotation(s))};
}

/// The point of the ellipsoid farthest along n; the centre if n is perpendicular to a flat one (to rounding).
static inline vec3 support_point(const ovoid_ellipsoid *e, vec3 n) {
    double form = sym3_quadratic(e->q, n);
    if (!(form > 1e-15 * sym3_trace(e->q))) return e->center;
    return vec3_add_scaled(e->center, sym3_mul_vec3(e->q, n), 1 / sqrt(form));
}

/// Moves b so that the support points of a along n and of b along -n differ by gap n. For gap >= 0 that is the nearest
/// pair and gap the distance, since both points satisfy the conditions of Karush, Kuhn and Tucker; for gap < 0 the two
/// overlap, at least as deep as where the points between those two are in both.
static inline void place(const ovoid_ellipsoid *a, ovoid_ellipsoid *b, vec3 n, double gap) {
    vec3 x = support_point(a, n), y = support_point(b, vec3_neg(n));
    b->center = vec3_add(b->center, vec3_sub(vec3_add_scaled(x, n, gap), y));
}

static inline ovoid_ellipsoid scale_ellipsoid(ovoid_ellipsoid e, double scale) {
    return (ovoid_ellipsoid){vec3_scale(e.center, scale), sym3_scale(e.q, scale * scale)};
}

/// (x - c)' Q^-1 (x - c), by cofactors in double-double: off by less than 1e-20 of itself for the tests' plain kinds.
static inline double membership(const ovoid_ellipsoid *e, vec3 x) {
    const dd m[3][3] = {{dd_from(e->q.xx), dd_from(e->q.xy), dd_from(e->q.xz)},
                        {dd_from(e->q.xy), dd_from(e->q.yy), dd_from(e->q.yz)},
                        {dd_from(e->q.xz), dd_from(e->q.yz), dd_from(e->q.zz)}};
    dd cofactor[3][3], det = {0, 0}, sum = {0, 0};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            int r = (i + 1) % 3, t = (i + 2) % 3, c = (j + 1) % 3, u = (j + 2) % 3;
            cofactor[i][j] = dd_sub(dd_mul(m[r][c], m[t][u]), dd_mul(m[r][u], m[t][c]));
        }
    for (int j = 0; j < 3; j++) det = dd_add(det, dd_mul(m[0][j], cofactor[0][j]));
    const dd y[3] = {two_sum(x.x, -e->center.x), two_sum(x.y, -e->center.y), two_sum(x.z, -e->center.z)};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) sum = dd_add(sum, dd_mul(dd_mul(y[i], y[j]), cofactor[i][j]));
    return dd_div(sum, det).high;
}

static inline double size_of(const ovoid_ellipsoid *a, const ovoid_ellipsoid *b) {
    return vec3_norm(vec3_sub(b->center, a->center)) + sqrt(sym3_trace(a->q)) + sqrt(sym3_trace(b->q));
}

#endif
