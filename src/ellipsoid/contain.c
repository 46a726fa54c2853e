// Proofs that an ellipsoid encloses a polytope, or lies inside one.
//
// Outside: with the proven factor W of Q (factor.h), (v - c)' Q^-1 (v - c) <= |W (v - c)|^2 / (1 - defect). Each term
// is computed in doubles and enlarged by a bound of its rounding, about 2^-50 times the ratio of the longest to the
// shortest axis.
//
// Inside: let E be the ellipsoid, S the closed surface of the triangles.
// (1) E meets no triangle: each triangle has a direction n with n . v > h(n) for its three vertices v. Any n proves it,
// so the plane of its facet, rounded, is as good as an exact normal, and a sliver whose own normal is noise does no
// harm. n . (v - c) is bounded from below in doubles, n' Q n from above in double-double.
// (2) S winds around the centre: the signed crossings of a ray from it do not sum to zero; exact orientations count
// them.
// Where S is known to be the boundary of the hull, a point of E that lies in the hull, such as the mean of all
// vertices, stands in for (2). The winding number is constant on a connected set that does not meet S, so it is nonzero
// on all of E. Outside of the hull of the vertices it is zero, as S can be contracted to a point within the hull. Hence
// E lies in the hull. Whether S is convex to the last bit, or how facets were merged, does not matter.
#include "ellipsoid/contain.h"

#include "ellipsoid/closed_fit.h"
#include "ellipsoid/factor.h"
#include "linear/both.h"
#include "polytope/facets.h"
#include "polytope/winding.h"

// |t| for a sum t of up to three terms of the given sum of sizes, enlarged by its rounding. Each term is rounded 5
// times at most: difference, product, two sums; 7 roundings cover the sums' own, and 2^-500 any underflow.
static double enlarge(double t, double size) { return fabs(t) + 7 * ROUNDING * size + 0x1p-500; }

// |W d|^2 from above for a factor of three axes.
static double bound_solid(const factor *f, vec3 d) {
    d = (vec3){d.x * f->scale[0], d.y * f->scale[1], d.z * f->scale[2]};
    double x = f->w[0][0] * d.x, yx = f->w[1][0] * d.x, yy = f->w[1][1] * d.y;
    double zx = f->w[2][0] * d.x, zy = f->w[2][1] * d.y, zz = f->w[2][2] * d.z;
    x = enlarge(x, fabs(x));
    double y = enlarge(yx + yy, fabs(yx) + fabs(yy)), z = enlarge((zx + zy) + zz, (fabs(zx) + fabs(zy)) + fabs(zz));
    return (x * x + y * y) + z * z;
}

// The same for a flat or narrow ellipsoid. Along an axis where Q is zero the vertices must have exactly the centre's
// coordinate; else the bound is infinite.
static double bound_flat(const factor *f, vec3 difference) {
    const double along[3] = {difference.x, difference.y, difference.z};
    double d[3], sum = 0;
    for (int i = 0, k = 0; i < 3; i++) {
        if (k < f->count && f->axis[k] == i)
            d[k] = along[i] * f->scale[k], k++;
        else if (along[i] != 0)
            return INFINITY;
    }
    for (int i = 0; i < f->count; i++) {
        double t = 0, size = 0;
        for (int j = 0; j <= i; j++) {
            t += f->w[i][j] * d[j];
            size += fabs(f->w[i][j] * d[j]);
        }
        t = enlarge(t, size);
        sum += t * t;
    }
    return sum;
}

double factor_compute_enclosing_bound(const factor *f, const ovoid_polytope *polytope, vec3 center) {
    double bound = 0;
    for (uint32_t v = 0; v < polytope->vertex_count; v++) {
        vec3 d = vec3_sub(vec3_at(polytope->vertices, v), center);
        double sum = f->count == 3 ? bound_solid(f, d) : bound_flat(f, d);
        if (isnan(sum)) return INFINITY;
        bound = max2(bound, sum);
    }
    return bound * ((1 + 16 * ROUNDING) / (1 - f->defect));
}

// The computed mean of n vertices is off by (n + 2) u of the largest coordinate along each axis.
int factor_holds_mean(const factor *f, const ovoid_polytope *polytope, vec3 center) {
    vec3 sum = {0, 0, 0};
    double extent = 0, square = 0, n = polytope->vertex_count;
    for (uint32_t v = 0; v < polytope->vertex_count; v++) {
        vec3 x = vec3_at(polytope->vertices, v);
        sum = vec3_add(sum, x);
        extent = max2(extent, vec3_max_abs(x));
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j <= i; j++) square += f->w[i][j] * f->w[i][j];
    double off = 2 * (n + 2) * ROUNDING * extent * sqrt(square);
    return f->count == 3 && sqrt(bound_solid(f, vec3_sub(vec3_scale(sum, 1 / n), center))) + off <= 0.9;
}

double ellipsoid_compute_enclosing_bound(const ovoid_polytope *polytope, const ovoid_ellipsoid *ellipsoid) {
    factor f;
    return factor_make(ellipsoid->q, &f) ? factor_compute_enclosing_bound(&f, polytope, ellipsoid->center) : INFINITY;
}

int ellipsoid_is_enclosing(const ovoid_polytope *polytope, const ovoid_ellipsoid *ellipsoid) {
    if (!vec3_is_finite(ellipsoid->center)) return 0;
    factor f;
    double size;
    // Mostly a factor in doubles proves it.
    return (factor_make_quickly(ellipsoid->q, &f, &size) &&
            factor_compute_enclosing_bound(&f, polytope, ellipsoid->center) <= 1) ||
           ellipsoid_compute_enclosing_bound(polytope, ellipsoid) <= 1;
}

// Q and lengths in a unit near their size, a power of two.
typedef struct scaled {
    sym3dd q;
    vec3 center;
    double unit;   // lengths are multiplied by it
    vec3 farthest; // the largest |v - c| along each axis, in that unit
} scaled;

static scaled scale(const ovoid_polytope *polytope, const ovoid_ellipsoid *ellipsoid) {
    const sym3 *q = &ellipsoid->q;
    vec3 far = {0, 0, 0};
    for (uint32_t v = 0; v < polytope->vertex_count; v++) {
        vec3 d = vec3_sub(vec3_at(polytope->vertices, v), ellipsoid->center);
        far = (vec3){max2(fabs(d.x), far.x), max2(fabs(d.y), far.y), max2(fabs(d.z), far.z)};
    }
    double unit = ldexp(1, -find_unit_exponent(sqrt(fmax(q->xx, fmax(q->yy, q->zz)))));
    sym3dd scaled_q = sym3dd_from(sym3_scale(sym3_scale(*q, unit), unit));
    return (scaled){scaled_q, ellipsoid->center, unit, vec3_scale(far, unit)};
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

// The least of n . (v - c) over the triangle, less its rounding: difference, product, two sums, 4 roundings a term; 6
// with the bound's own.
static double bound_least(const scaled *s, const vec3 corner[3], vec3 n) {
    double least = INFINITY;
    for (int i = 0; i < 3; i++) {
        vec3 d = vec3_scale(vec3_sub(corner[i], s->center), s->unit);
        double size = (fabs(n.x * d.x) + fabs(n.y * d.y)) + fabs(n.z * d.z);
        double value = vec3_dot(n, d) - 6 * ROUNDING * size - 0x1p-900;
        if (!(value >= least)) least = value;
    }
    return least;
}

// The largest factor proven along n.
static double bound_factor(const scaled *s, const vec3 corner[3], vec3 n) {
    return bound_least(s, corner, n) / bound_reach(s, n) * (1 - 4 * ROUNDING);
}

vec3 triangle_compute_normal(const vec3 corner[3]) { return vec3_unit(compute_area(corner[0], corner[1], corner[2])); }

// ---- two triangles side by side, in doubles

// The planes' normals and the corners of a triangle and the next one.
typedef struct two_triangles {
    both_vec3 normal, corner[3];
} two_triangles;

static two_triangles get_two(const ovoid_polytope *p, uint32_t t) {
    uint32_t next = t + 1 < p->triangle_count ? t + 1 : t;
    const uint32_t *a = p->triangles + 3 * (size_t)t, *b = p->triangles + 3 * (size_t)next;
    two_triangles two;
    two.normal = both_vec3_make(p->planes[p->triangle_facets[t]].normal, p->planes[p->triangle_facets[next]].normal);
    for (int i = 0; i < 3; i++) two.corner[i] = both_vec3_make(vec3_at(p->vertices, a[i]), vec3_at(p->vertices, b[i]));
    return two;
}

// An upper bound of the square of bound_reach in doubles: products and sums are within 10 roundings of the sum of
// sizes; 40 roundings exceed that, the rounding of bound_reach, and a rounding of each entry of Q.
static both bound_reach_roughly(const scaled *s, both_vec3 n) {
    both x = both_set(2) * n.x, y = both_set(2) * n.y;
    both xx = n.x * n.x * both_set(s->q.m[0][0].high), yy = n.y * n.y * both_set(s->q.m[1][1].high);
    both zz = n.z * n.z * both_set(s->q.m[2][2].high), xy = x * n.y * both_set(s->q.m[0][1].high);
    both xz = x * n.z * both_set(s->q.m[0][2].high), yz = y * n.z * both_set(s->q.m[1][2].high);
    both size = ((both_abs(xx) + both_abs(yy)) + both_abs(zz)) + ((both_abs(xy) + both_abs(xz)) + both_abs(yz));
    both sum = ((xx + yy) + zz) + ((xy + xz) + yz);
    return both_make(max2(sum[0], 0), max2(sum[1], 0)) + both_set(40 * ROUNDING) * size + both_set(0x1p-899);
}

// A lower bound of n . (v - c) over the corners. Difference, product, two sums: 4 roundings a term, of which none
// exceeds that of `farthest`; 6 with the bound's own.
static both bound_least_roughly(const scaled *s, const two_triangles *two) {
    both_vec3 n = two->normal, center = both_vec3_make(s->center, s->center);
    both unit = both_set(s->unit), height[3];
    for (int i = 0; i < 3; i++) {
        both_vec3 d = both_vec3_sub(two->corner[i], center);
        height[i] = both_vec3_dot(n, (both_vec3){d.x * unit, d.y * unit, d.z * unit});
    }
    both size = both_abs(n.x) * both_set(s->farthest.x) + both_abs(n.y) * both_set(s->farthest.y);
    size += both_abs(n.z) * both_set(s->farthest.z);
    return both_min(height[0], both_min(height[1], height[2])) - both_set(6 * ROUNDING) * size - both_set(0x1p-900);
}

// ---- all triangles

// The factor of a triangle that may limit it: along the plane of its facet, or, if that is below `bound`, along its own
// normal, which may give a larger one. which: of the two.
static double bound_triangle(const scaled *s, const two_triangles *two, int which, double bound) {
    vec3 n = both_vec3_get(two->normal, which), corner[3];
    for (int i = 0; i < 3; i++) corner[i] = both_vec3_get(two->corner[i], which);
    double clear = bound_factor(s, corner, n);
    return clear >= bound ? clear : fmax(clear, bound_factor(s, corner, triangle_compute_normal(corner)));
}

// How a bound over all triangles is computed.
typedef struct bounding {
    int is_rough; // by rough bounds alone
    double most;  // a larger bound is not needed
} bounding;

// The bound over all triangles. Most do not limit it, as rough bounds along the planes of their facets show.
static double compute_clear_bound(const ovoid_polytope *polytope, const ovoid_ellipsoid *ellipsoid, bounding how) {
    scaled s = scale(polytope, ellipsoid);
    double bound = how.most;
    for (uint32_t t = 0; t < polytope->triangle_count; t += 2) {
        two_triangles two = get_two(polytope, t);
        both lows = bound_least_roughly(&s, &two), reaches = bound_reach_roughly(&s, two.normal);
        for (int k = 0; k < 2; k++) {
            double least = lows[k], reach = reaches[k];
            // Squares save a root and a division; an infinite bound is never reached.
            if (least > 0 && least * least * (1 - 8 * ROUNDING) >= bound * bound * reach) continue;
            double clear = how.is_rough ? least / sqrt(reach) * (1 - 8 * ROUNDING) : bound_triangle(&s, &two, k, bound);
            if (!(clear >= bound)) bound = clear;
            if (isnan(bound)) return -INFINITY;
        }
    }
    return polytope->triangle_count ? bound : -INFINITY;
}

double ellipsoid_compute_clear_bound(const ovoid_polytope *polytope, const ovoid_ellipsoid *ellipsoid) {
    return compute_clear_bound(polytope, ellipsoid, (bounding){.most = INFINITY});
}

double ellipsoid_compute_clear_bound_roughly(const ovoid_polytope *polytope, const ovoid_ellipsoid *ellipsoid) {
    return compute_clear_bound(polytope, ellipsoid, (bounding){1, INFINITY});
}

int ellipsoid_is_clear(const ovoid_polytope *polytope, const ovoid_ellipsoid *ellipsoid) {
    factor f;
    double size;
    if (polytope->rank < 3 || !vec3_is_finite(ellipsoid->center)) return 0;
    if (!factor_make_quickly(ellipsoid->q, &f, &size) && !factor_make(ellipsoid->q, &f)) return 0;
    return f.count == 3 && compute_clear_bound(polytope, ellipsoid, (bounding){.most = 1}) >= 1;
}

int ellipsoid_is_vertex(const ovoid_polytope *polytope, const ovoid_ellipsoid *ellipsoid) {
    const sym3 *q = &ellipsoid->q;
    if (q->xx != 0 || q->xy != 0 || q->xz != 0 || q->yy != 0 || q->yz != 0 || q->zz != 0) return 0;
    for (uint32_t v = 0; v < polytope->vertex_count; v++)
        if (vec3_max_abs(vec3_sub(vec3_at(polytope->vertices, v), ellipsoid->center)) == 0) return 1;
    return 0;
}

int ellipsoid_is_enclosed(const ovoid_polytope *polytope, const ovoid_ellipsoid *ellipsoid) {
    if (polytope->rank < 3 || !vec3_is_finite(ellipsoid->center)) return 0;
    closed_form form = closed_form_find(polytope->vertices, polytope->vertex_count);
    return closed_fit_is_enclosed(&form, ellipsoid) || ellipsoid_is_vertex(polytope, ellipsoid) ||
           (ellipsoid_is_clear(polytope, ellipsoid) && polytope_compute_winding(polytope, ellipsoid->center) != 0);
}
