// An ellipsoid as three vectors E with Q = E E', { c + E p : |p| <= 1 }, and how far its support may be from that of Q.
//
// Errors, u = 2^-53, T the trace of Q. In doubles the factorisation belongs to Q + D with |D| <= 16 u T (N. J. Higham,
// Accuracy and stability of numerical algorithms, 2002, theorem 10.3). With r = 1 / |E^-1| the least radius from below,
// |sqrt(n'(Q + D)n) - sqrt(n'Qn)| <= 16 u T / r; used where T / r^2 is at most 1024, so that this is below 512 u sqrt
// T. Else in double-double: D is below 2^-94 T with the pivots dropped, which moves the root by 2^-47 sqrt T even where
// Q is singular; E rounded to doubles moves it by 3 u sqrt T.
//
// A flat shape's inner ellipsoid is proven nowhere, so it is proven here: that of a segment is made from its two end
// vertices, to rounding. Of a polygon the ellipse's two longest axes are taken, shrunk until they stay within every
// edge as seen along the polygon's normal; a point of that ellipse is then above or below a point of the body, by no
// more than the ellipse and the corners are off the plane. Cost: one pass over the corners.
#include "smooth/smooth.h"

#include "polytope/polygon.h"

static const double rounding = 0x1p-53;

static root3 root3_rotate(const root3 *e, const mat3 *r) {
    return (root3){{mat3_mul_vec3(*r, e->axis[0]), mat3_mul_vec3(*r, e->axis[1]), mat3_mul_vec3(*r, e->axis[2])}};
}

// The trace of (E E')^-1, rounded; infinity where E is singular.
static double compute_inverse_trace(const root3 *e) {
    vec3 c0 = vec3_cross(e->axis[1], e->axis[2]), c1 = vec3_cross(e->axis[2], e->axis[0]);
    vec3 c2 = vec3_cross(e->axis[0], e->axis[1]);
    double det = vec3_dot(e->axis[0], c0);
    double sum = (vec3_norm_squared(c0) + vec3_norm_squared(c1)) + vec3_norm_squared(c2);
    return det != 0 ? sum / (det * det) : INFINITY;
}

// By Cholesky without pivots, which is as good where E^-1 is not large; zero where a pivot is not positive.
static root3 make_plain_root(sym3 q) {
    root3 e = {{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
    double a = sqrt(q.xx), b = q.xy / a, c = q.xz / a, dd = q.yy - b * b, d = sqrt(dd), f = (q.yz - b * c) / d;
    double gg = (q.zz - c * c) - f * f;
    if (q.xx > 0 && dd > 0 && gg > 0) e = (root3){{{a, b, c}, {0, d, f}, {0, 0, sqrt(gg)}}};
    return e;
}

// The root of Q and its pad, in the units of Q.
static root3 make_root(sym3 q, double *pad) {
    double trace = sym3_trace(q);
    root3 e = make_plain_root(q);
    double inverse = compute_inverse_trace(&e);
    if (trace * inverse <= 1024) {
        *pad = 16 * rounding * trace * sqrt(inverse);
        return e;
    }
    *pad = 0x1p-45 * sqrt(trace);
    return root3_make(q, 1);
}

static smooth_body make_posed(const root3 *root, vec3 center, double pad, const mat3 *rotation, double unit) {
    return (smooth_body){root3_rotate(root, rotation), vec3_scale(mat3_mul_vec3(*rotation, center), 1 / unit), pad};
}

smooth_body smooth_body_make(const ovoid_ellipsoid *ellipsoid, const mat3 *rotation, double unit) {
    double pad;
    root3 root = make_root(sym3_scale(sym3_scale(ellipsoid->q, 1 / unit), 1 / unit), &pad);
    return make_posed(&root, ellipsoid->center, pad, rotation, unit);
}

static smooth_body make_segment(const ovoid_shape *shape, const mat3 *rotation, double unit) {
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    uint32_t index[2];
    polytope_get_ends(&p, index);
    vec3 end[2] = {vec3_at(p.vertices, index[0]), vec3_at(p.vertices, index[1])};
    root3 root = {{vec3_scale(vec3_sub(end[1], end[0]), 0.5 / unit), {0, 0, 0}, {0, 0, 0}}};
    return make_posed(&root, vec3_scale(vec3_add(end[0], end[1]), 0.5), 8 * rounding * shape->extent / unit, rotation,
                      unit);
}

// The factor by which an ellipse has to shrink about its centre to stay within the polygon's edges, as seen along
// `normal`; 0 where the centre is not on the same side of all.
static double find_shrink(const ovoid_polytope *p, vec3 normal, vec3 center, const root3 *root, double slack) {
    double shrink = 1, side = 0;
    for (uint32_t v = 0; v < p->vertex_count; v++) {
        uint32_t first = p->neighbor_starts[v];
        if (p->neighbor_starts[v + 1] < first + 2) continue;
        // The edge to the next corner.
        vec3 corner = vec3_at(p->vertices, v), edge = vec3_sub(vec3_at(p->vertices, p->neighbors[first + 1]), corner);
        vec3 m = vec3_unit(vec3_cross(edge, normal));
        double off = vec3_dot(m, vec3_sub(corner, center)), reach = vec3_norm(root3_map_transposed(root, m));
        if (side == 0) side = copysign(1, off);
        double room = side * off - slack;
        if (!(room > 0)) return 0;
        if (reach * shrink > room) shrink = room / reach;
    }
    return shrink;
}

static smooth_body make_ellipse(const ovoid_shape *shape, const mat3 *rotation, double unit) {
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    double pad, down = 1 / unit, slack = 64 * rounding * shape->extent;
    root3 root = make_root(sym3_scale(sym3_scale(shape->inner.q, down), down), &pad);
    root.axis[2] = (vec3){0, 0, 0};
    vec3 n = p.planes[0].normal, center = shape->inner.center;
    root3 large = root;
    for (int k = 0; k < 2; k++) large.axis[k] = vec3_scale(root.axis[k], unit);
    double shrink = find_shrink(&p, n, center, &large, slack), off = 0;
    if (!(shrink > 0)) center = shape->first;
    for (uint32_t v = 0; v < p.vertex_count; v++) {
        if (p.neighbor_starts[v + 1] == p.neighbor_starts[v]) continue;
        off = max2(off, fabs(vec3_dot(n, vec3_sub(vec3_at(p.vertices, v), center))));
    }
    off += vec3_norm(root3_map_transposed(&large, n)) + slack;
    for (int k = 0; k < 2; k++) root.axis[k] = vec3_scale(root.axis[k], shrink * (1 - 0x1p-48));
    return make_posed(&root, center, off * down, rotation, unit);
}

smooth_body smooth_body_make_inner(const ovoid_shape *shape, const mat3 *rotation, double unit) {
    static const root3 none = {{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
    if (shape->rank == 3) return smooth_body_make(&shape->inner, rotation, unit);
    if (shape->rank == 2) return make_ellipse(shape, rotation, unit);
    return shape->rank == 1 ? make_segment(shape, rotation, unit) : make_posed(&none, shape->first, 0, rotation, unit);
}
