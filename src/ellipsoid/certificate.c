// The dual bound of the maximum-volume inscribed ellipsoid.
//
// Let g_i be any directions, b_i the support of the body along them less that of the centre c, M the map of the given
// ellipsoid, h_i = |M' g_i|, u_i = M' g_i / h_i. Any ellipsoid in the body is { c + M (p + G v) : |v| <= 1 } with G
// symmetric positive semidefinite, and b_i / h_i >= u_i . p + |G u_i| >= u_i . p + u_i' G u_i. With weights l_i
// >= 0, P = sum l_i u_i u_i', r = sum l_i u_i: tr(G P) <= sum l_i b_i / h_i - r . p <= B = sum l_i b_i / h_i + |r|
// reach, and 3 det(G P)^(1/3) <= tr(G P). So det G <= (B / 3)^3 / det P, which is 1 at the optimum. The b_i and h_i are
// computed in double-double, or in doubles with a bound of their rounding (docs/error-analysis.md).
#include "ellipsoid/certificate.h"

#include "linear/exact.h"

static dd dd_dot(vec3 a, const dd b[3]) {
    return dd_add(dd_add(dd_mul(dd_from(a.x), b[0]), dd_mul(dd_from(a.y), b[1])), dd_mul(dd_from(a.z), b[2]));
}

// The support of the body along g less that of the centre.
static double compute_support(const inscribed_body *body, vec3 g) {
    double top = -INFINITY;
    for (uint32_t v = 0; v < body->vertex_count; v++) {
        vec3 x = vec3_at(body->vertices, v);
        const dd d[3] = {two_sum(x.x, -body->center.x), two_sum(x.y, -body->center.y), two_sum(x.z, -body->center.z)};
        top = fmax(top, dd_dot(g, d).high);
    }
    return top + body->height * fabs(vec3_dot(g, body->normal));
}

// M' g, in double-double and then rounded.
static vec3 compute_pullback(const mat3 *m, vec3 g) {
    const dd d[3] = {dd_from(g.x), dd_from(g.y), dd_from(g.z)};
    mat3 t = mat3_transpose(*m);
    return (vec3){dd_dot(t.r0, d).high, dd_dot(t.r1, d).high, dd_dot(t.r2, d).high};
}

double certificate_compute_bound(const certificate *c, const inscribed_body *body) {
    sym3 p = {0, 0, 0, 0, 0, 0};
    vec3 r = {0, 0, 0};
    double sum = 0;
    for (int i = 0; i < c->count; i++) {
        vec3 pulled = compute_pullback(&body->map, c->direction[i]);
        double h = vec3_norm(pulled);
        if (!(h > 0)) continue;
        vec3 u = vec3_scale(pulled, 1 / h);
        p = sym3_add(p, sym3_outer(u, c->weight[i]));
        r = vec3_add_scaled(r, u, c->weight[i]);
        sum += c->weight[i] * compute_support(body, c->direction[i]) / h;
    }
    double third = (sum + vec3_norm(r) * body->reach) / 3, det = sym3_det(p);
    // The sums of up to 12 terms are true to 1e-14.
    return det > 0 ? third * third * third / det * (1 + 1e-13) : INFINITY;
}

// ---- in doubles

// Upper bounds of the supports along the directions less that of the centre, in one pass; returns one of |M^-1 (v - c)|
// over the vertices. A height is rounded 4 times a term, of size |n| sqrt(3) |v - c|_max: 16 roundings cover it.
static double compute_supports(const certificate *c, const ovoid_polytope *p, vec3 center, lower3 inverse,
                               double top[QP_SIZE]) {
    double x[QP_SIZE] = {0}, y[QP_SIZE] = {0}, z[QP_SIZE] = {0}, size = 0, reach = 0;
    for (int i = 0; i < QP_SIZE; i++) top[i] = -INFINITY;
    for (int i = 0; i < c->count; i++) x[i] = c->direction[i].x, y[i] = c->direction[i].y, z[i] = c->direction[i].z;
    for (uint32_t v = 0; v < p->vertex_count; v++) {
        vec3 d = vec3_sub(vec3_at(p->vertices, v), center);
        for (int i = 0; i < QP_SIZE; i++) {
            double height = (x[i] * d.x + y[i] * d.y) + z[i] * d.z;
            top[i] = height > top[i] ? height : top[i];
        }
        size = max2(size, vec3_max_abs(d));
        reach = max2(reach, vec3_norm_squared(lower3_mul_vec3(inverse, d)));
    }
    for (int i = 0; i < c->count; i++) top[i] += 16 * ROUNDING * size * vec3_norm(c->direction[i]);
    return sqrt(reach);
}

static double compute_size(lower3 l) {
    return sqrt(((l.xx * l.xx + l.yx * l.yx) + l.yy * l.yy) + ((l.zx * l.zx + l.zy * l.zy) + l.zz * l.zz));
}

double certificate_compute_bound_quickly(const certificate *c, const ovoid_polytope *polytope, vec3 center,
                                         lower3 map) {
    lower3 inverse = lower3_inverse(map);
    double top[QP_SIZE], total = 0, sum = 0, error = 8 * ROUNDING * compute_size(map) * compute_size(inverse);
    if (!(error < 1e-9)) return INFINITY;
    double reach = 1.01 * compute_supports(c, polytope, center, inverse, top);
    sym3 p = {0, 0, 0, 0, 0, 0};
    vec3 r = {0, 0, 0};
    for (int i = 0; i < c->count; i++) {
        // u and h with a relative error of at most `error`.
        vec3 pulled = lower3_mul_transposed_vec3(map, c->direction[i]);
        double h = vec3_norm(pulled);
        if (!(h > 0)) return INFINITY;
        vec3 u = vec3_scale(pulled, 1 / h);
        p = sym3_add(p, sym3_outer(u, c->weight[i]));
        r = vec3_add_scaled(r, u, c->weight[i]);
        sum += c->weight[i] * (top[i] / h);
        total += c->weight[i];
    }
    // The least eigenvalue of P is at least 1/2 by its rows, so that its determinant is true to 32 total error.
    double least = min2(p.xx - fabs(p.xy) - fabs(p.xz), p.yy - fabs(p.xy) - fabs(p.yz));
    if (!(min2(least, p.zz - fabs(p.xz) - fabs(p.yz)) >= 0.5 && total < 4)) return INFINITY;
    double third = (sum * (1 + 2 * error) + (vec3_norm(r) + total * error) * reach) / 3;
    return third * third * third / (sym3_det(p) * (1 - 32 * total * error));
}
