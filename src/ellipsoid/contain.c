// Proofs of containment.
//
// Outside: with the proven factor W of Q (factor.h), (v - c)' Q^-1 (v - c) <= |W (v - c)|^2 / (1 - defect). Each term
// is computed in doubles and enlarged by a bound of its rounding. The price is about 2^-50 times the ratio of the
// longest to the shortest axis.
//
// Inside: let E be the ellipsoid, S the closed surface of the triangles.
// (1) E meets no triangle: each triangle has a direction n with n . v > h(n) for its three vertices v. Any n will do,
//     so the plane of its facet, rounded, is as good as an exact normal, and a sliver whose own normal is noise does no
//     harm. n . (v - c) is bounded from below in doubles, n' Q n from above in double-double.
// (2) S winds around the centre: the signed crossings of a ray from it do not sum to zero; exact orientations count
//     them.
// The winding number is constant on a connected set that misses S, so it is not zero on all of E; outside of the hull
// of the vertices it is zero, as S can be contracted to a point within the hull. Hence E lies in the hull. Whether S is
// convex to the last bit, or how facets were merged, does not matter.
#include "ellipsoid/contain.h"

#include "ellipsoid/factor.h"
#include "polytope/facets.h"

double ellipsoid_compute_enclosing_bound(const ovoid_polytope *polytope, const ovoid_ellipsoid *ellipsoid) {
    factor f;
    if (!factor_make(ellipsoid->q, &f)) return INFINITY;
    const double center[3] = {ellipsoid->center.x, ellipsoid->center.y, ellipsoid->center.z};
    double bound = 0;
    for (uint32_t v = 0; v < polytope->vertex_count; v++) {
        const double *p = polytope->vertices + 3 * (size_t)v;
        // Along an axis where Q is zero the vertices must have exactly the centre's coordinate.
        double d[3], sum = 0;
        for (int i = 0, k = 0; i < 3; i++) {
            if (k < f.count && f.axis[k] == i)
                d[k] = (p[i] - center[i]) * f.scale[k], k++;
            else if (p[i] != center[i])
                return INFINITY;
        }
        // Each of up to three terms is rounded 5 times at most: difference, product, two sums; 7 roundings cover the
        // sums' own, and 2^-500 any underflow.
        for (int i = 0; i < f.count; i++) {
            double t = 0, size = 0;
            for (int j = 0; j <= i; j++) {
                t += f.w[i][j] * d[j];
                size += fabs(f.w[i][j] * d[j]);
            }
            t = fabs(t) + 7 * ROUNDING * size + 0x1p-500;
            sum += t * t;
        }
        if (isnan(sum)) return INFINITY;
        bound = fmax(bound, sum);
    }
    return bound * ((1 + 16 * ROUNDING) / (1 - f.defect));
}

int ellipsoid_is_enclosing(const ovoid_polytope *polytope, const ovoid_ellipsoid *ellipsoid) {
    return vec3_is_finite(ellipsoid->center) && ellipsoid_compute_enclosing_bound(polytope, ellipsoid) <= 1;
}

// Q and lengths in a unit of their own, a power of two.
typedef struct scaled {
    sym3dd q;
    vec3 center;
    double unit; // lengths are multiplied by it
} scaled;

static scaled scale(const ovoid_ellipsoid *ellipsoid) {
    const sym3 *q = &ellipsoid->q;
    double unit = ldexp(1, -find_unit_exponent(sqrt(fmax(q->xx, fmax(q->yy, q->zz)))));
    return (scaled){sym3dd_from(sym3_scale(sym3_scale(*q, unit), unit)), ellipsoid->center, unit};
}

// An upper bound of sqrt(n' Q n). 6 + 3 products and 8 sums in double-double: within 2^-97 of the sum of sizes. The
// entries of Q are below 1 in size after scaling, and those below 2^-1022 may have been rounded: 2^-900 covers them.
static double bound_reach(const scaled *s, vec3 direction) {
    const double n[3] = {direction.x, direction.y, direction.z};
    dd sum = dd_from(0);
    double size = 0;
    for (int i = 0; i < 3; i++)
        for (int j = i; j < 3; j++) {
            dd term = dd_mul(two_product(i == j ? n[i] : 2 * n[i], n[j]), s->q.m[i][j]);
            sum = dd_add(sum, term);
            size += fabs(term.high);
        }
    return sqrt(fmax(sum.high, 0) + 0x1p-96 * size + 0x1p-900) * (1 + 4 * ROUNDING);
}

// The largest factor proven along n: the least of n . (v - c) over the triangle, less its rounding (difference,
// product, two sums: 4 roundings a term, 6 with the bound's own), over the reach.
static double bound_factor(const scaled *s, const vec3 corner[3], vec3 n, double reach) {
    double least = INFINITY;
    for (int i = 0; i < 3; i++) {
        vec3 d = vec3_scale(vec3_sub(corner[i], s->center), s->unit);
        double size = (fabs(n.x * d.x) + fabs(n.y * d.y)) + fabs(n.z * d.z);
        double value = vec3_dot(n, d) - 6 * ROUNDING * size - 0x1p-900;
        if (!(value >= least)) least = value;
    }
    return least / reach * (1 - 4 * ROUNDING);
}

vec3 triangle_compute_normal(const vec3 corner[3]) { return vec3_unit(compute_area(corner[0], corner[1], corner[2])); }

double ellipsoid_compute_clear_bound(const ovoid_polytope *polytope, const ovoid_ellipsoid *ellipsoid) {
    scaled s = scale(ellipsoid);
    double bound = INFINITY, reach = 0;
    vec3 n = {0, 0, 0};
    for (uint32_t t = 0; t < polytope->triangle_count; t++) {
        const uint32_t *index = polytope->triangles + 3 * (size_t)t;
        vec3 corner[3];
        for (int i = 0; i < 3; i++) corner[i] = vec3_at(polytope->vertices, index[i]);
        // The facet's plane; triangles of a facet mostly follow one another.
        if (t == 0 || polytope->triangle_facets[t] != polytope->triangle_facets[t - 1]) {
            n = polytope->planes[polytope->triangle_facets[t]].normal;
            reach = bound_reach(&s, n);
        }
        double clear = bound_factor(&s, corner, n, reach);
        if (clear >= bound) continue;
        // Where this triangle limits the factor, its own normal may give a larger one.
        vec3 own = triangle_compute_normal(corner);
        clear = fmax(clear, bound_factor(&s, corner, own, bound_reach(&s, own)));
        if (!(clear >= bound)) bound = clear;
        if (isnan(bound)) return -INFINITY;
    }
    return polytope->triangle_count ? bound : -INFINITY;
}

// The signed crossing of the ray from c through q with a triangle: 1, 0 or -1, or 2 where the ray meets its border.
static int count_crossing(vec3 c, vec3 q, const vec3 corner[3]) {
    int s0 = orient3d_sign(c, q, corner[0], corner[1]), s1 = orient3d_sign(c, q, corner[1], corner[2]);
    if (s0 * s1 < 0) return 0;
    int s2 = orient3d_sign(c, q, corner[2], corner[0]);
    if (s0 * s2 < 0 || s1 * s2 < 0) return 0;
    if (s0 == 0 || s1 == 0 || s2 == 0) return 2;
    // The line crosses; the triangle lies ahead of c if its plane separates c from the line's far end.
    int side = orient3d_sign(corner[0], corner[1], corner[2], c);
    return side == 0 ? 2 : side == -s0 ? side : 0;
}

int polytope_is_winding(const ovoid_polytope *polytope, ovoid_vec3 point) {
    // In units of the body: the orientations underflow for bodies below 1e-90.
    double unit = ldexp(1, -find_unit_exponent(compute_extent(polytope->vertices, polytope->vertex_count)));
    vec3 c = vec3_scale(point, unit);
    // Rays through points inside a triangle, at weights of no symmetry; another one where a ray meets an edge.
    for (uint32_t attempt = 0; attempt < 8 && polytope->triangle_count > 0; attempt++) {
        const uint32_t *aim = polytope->triangles + 3 * (size_t)(polytope->triangle_count * (uint64_t)attempt / 8);
        double wa = 0.371 + 0.02 * attempt, wb = 0.297 - 0.013 * attempt, wc = 1 - wa - wb;
        vec3 q = vec3_scale(vec3_at(polytope->vertices, aim[0]), wa);
        q = vec3_add_scaled(q, vec3_at(polytope->vertices, aim[1]), wb);
        q = vec3_scale(vec3_add_scaled(q, vec3_at(polytope->vertices, aim[2]), wc), unit);
        int64_t winding = 0;
        int met = 0;
        for (uint32_t t = 0; t < polytope->triangle_count && !met; t++) {
            vec3 corner[3];
            for (int i = 0; i < 3; i++)
                corner[i] = vec3_scale(vec3_at(polytope->vertices, polytope->triangles[3 * (size_t)t + i]), unit);
            int crossing = count_crossing(c, q, corner);
            met = crossing == 2;
            winding += met ? 0 : crossing;
        }
        if (!met) return winding != 0;
    }
    return 0;
}

int ellipsoid_is_enclosed(const ovoid_polytope *polytope, const ovoid_ellipsoid *ellipsoid) {
    factor f;
    if (polytope->rank < 3 || !vec3_is_finite(ellipsoid->center) || !factor_make(ellipsoid->q, &f)) return 0;
    if (f.count == 0) {
        for (uint32_t v = 0; v < polytope->vertex_count; v++) {
            vec3 d = vec3_sub(vec3_at(polytope->vertices, v), ellipsoid->center);
            if (d.x == 0 && d.y == 0 && d.z == 0) return 1;
        }
        return 0;
    }
    return f.count == 3 && ellipsoid_compute_clear_bound(polytope, ellipsoid) >= 1 &&
           polytope_is_winding(polytope, ellipsoid->center);
}
