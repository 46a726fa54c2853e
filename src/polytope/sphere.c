// The smallest enclosing sphere is that of at most four of the points. Each step adds the point farthest outside the
// sphere of the present few, and the smallest sphere of those at most five points gives the next few; the radius grows
// with every step, until no point is outside. E. Welzl, Smallest enclosing disks (balls and ellipsoids), 1991 (the
// principle); B. Gaertner, Fast and robust smallest enclosing balls, 1999 (the farthest point as the next one).
// Rounding may end the search early; the radius is then computed from the centre and all points and rounded up, so the
// sphere encloses the points whatever the search did.
#include "polytope/sphere.h"

#include "linear/box.h"
#include "linear/mat3.h"

// Points in units of the cloud's size, about its middle.
typedef struct cloud {
    const double *xyz;
    uint32_t count;
    vec3 middle;
    double unit, inverse; // a power of two, and its inverse
} cloud;

static vec3 get_point(const cloud *c, uint32_t i) {
    return vec3_scale(vec3_sub(vec3_at(c->xyz, i), c->middle), c->inverse);
}

static cloud make_cloud(const double *xyz, uint32_t count) {
    box b = box_make_around(xyz, count);
    double unit = ldexp(1, find_unit_exponent(vec3_max_abs(vec3_sub(b.max, b.min))));
    return (cloud){xyz, count, vec3_add(vec3_scale(b.min, 0.5), vec3_scale(b.max, 0.5)), unit, 1 / unit};
}

// The sphere through k <= 4 points, with its centre in their span; 0 if there is none in doubles. *is_least: the centre
// is in their hull, so that no smaller sphere holds them.
static int make_through(const vec3 *p, int k, sphere *s, int *is_least) {
    vec3 e[3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    for (int i = 1; i < k; i++) e[i - 1] = vec3_sub(p[i], p[0]);
    // With c = p0 + sum of x_i e_i: e_i . (c - p0) = |e_i|^2 / 2. Missing edges give the rows of the unit matrix.
    sym3 gram = {k > 1 ? vec3_dot(e[0], e[0]) : 1, vec3_dot(e[0], e[1]), vec3_dot(e[0], e[2]),
                 k > 2 ? vec3_dot(e[1], e[1]) : 1, vec3_dot(e[1], e[2]), k > 3 ? vec3_dot(e[2], e[2]) : 1};
    vec3 half = {vec3_dot(e[0], e[0]) / 2, vec3_dot(e[1], e[1]) / 2, vec3_dot(e[2], e[2]) / 2}, x;
    if (!sym3_solve(gram, half, &x)) return 0;
    vec3 d = vec3_add_scaled(vec3_add_scaled(vec3_scale(e[0], x.x), e[1], x.y), e[2], x.z);
    *s = (sphere){vec3_add(p[0], d), vec3_norm(d)};
    *is_least = min2(x.x, min2(x.y, x.z)) >= 0 && (x.x + x.y) + x.z <= 1;
    return vec3_is_finite(s->center);
}

// The smallest sphere of n <= 5 points that goes through the last one; the points on it become the first ones. Returns
// their number, 0 if rounding leaves none. Mostly all points are on it, so the largest sets are tried first.
static int find_smallest(vec3 *p, int n, sphere *best) {
    int best_set = 0, is_least = 0;
    for (int set = (1 << (n - 1)) - 1; set >= 0 && !(best_set && is_least); set--) {
        vec3 on[5] = {p[n - 1]};
        int k = 1;
        for (int i = 0; i < n - 1; i++)
            if (set >> i & 1) on[k++] = p[i];
        sphere s;
        int could_be;
        if (k > 4 || !make_through(on, k, &s, &could_be) || (best_set && s.radius >= best->radius)) continue;
        int holds = 1;
        for (int i = 0; i < n; i++) holds &= vec3_norm(vec3_sub(p[i], s.center)) <= s.radius * (1 + 1e-12);
        if (holds) *best = s, best_set = set | 1 << (n - 1), is_least = could_be;
    }
    int k = 0;
    for (int i = 0; i < n && best_set; i++)
        if (best_set >> i & 1) p[k++] = p[i];
    return k;
}

sphere sphere_compute_smallest(const double *xyz, uint32_t count) {
    cloud c = make_cloud(xyz, count);
    vec3 few[5] = {get_point(&c, 0)};
    sphere s = {few[0], 0};
    for (int pass = 0, n = 1; pass < 100 && n; pass++) {
        double farthest = 0;
        for (uint32_t i = 0; i < count; i++) {
            double d = vec3_norm_squared(vec3_sub(get_point(&c, i), s.center));
            if (d > farthest) farthest = d, few[n] = get_point(&c, i);
        }
        if (sqrt(farthest) <= s.radius * (1 + 1e-12)) break;
        sphere next = s;
        n = find_smallest(few, n + 1, &next);
        if (!(next.radius > s.radius)) break;
        s = next;
    }
    vec3 center = vec3_add(c.middle, vec3_scale(s.center, c.unit));
    return (sphere){center, sphere_compute_radius(xyz, count, center)};
}

double sphere_compute_radius(const double *xyz, uint32_t count, vec3 center) {
    double size = 0, farthest = 0;
    for (uint32_t i = 0; i < count; i++) size = max2(size, vec3_max_abs(vec3_sub(vec3_at(xyz, i), center)));
    if (size == 0) return 0;
    double unit = ldexp(1, find_unit_exponent(size)), inverse = 1 / unit;
    for (uint32_t i = 0; i < count; i++)
        farthest = max2(farthest, vec3_norm_squared(vec3_scale(vec3_sub(vec3_at(xyz, i), center), inverse)));
    // Differences, squares and sums are within 5 roundings of the square, so 2.5 of the root; its own rounding and
    // those of this line make 6. What underflows is below the last term.
    return sqrt(farthest) * (1 + 8 * 0x1p-53) * unit + 0x1p-1074;
}
