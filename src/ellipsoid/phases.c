// The three phases from the outer ellipsoid to an enclosed one: shrink, stretch, enlarge each radius.
// W.-K. Su, J.-S. Liu, I-F. Chen, Enhancing Collision Detection Method Based on Enclosed Ellipsoid by Facial Areas
// Splitting, section 2.3, steps (b), (c) and (d). Each phase is a bisection against the facets' planes, 2^-40 fine;
// then the result is shrunk by what its proof needs (shrink_to_fit.c). The paper writes M = Q^-1; here its formulas
// stand in Q, and no square root is needed. A phase never returns less than it was given: if there is no room, it
// returns its input. A flat body is treated within its plane, against its edges, and a segment against its ends;
// nothing is proven of these. Cost: 40 to 250 evaluations of all facets a phase.
#include "base/environment.h"
#include "ellipsoid/contain.h"
#include "ellipsoid/halfspaces.h"
#include "ellipsoid/shrink_to_fit.h"

// A family of ellipsoids that grow with t.
typedef struct family {
    ovoid_ellipsoid (*make)(const void *context, double t);
    const void *context;
} family;

static int is_inside(const halfspaces *w, const ovoid_ellipsoid *e) {
    for (uint32_t i = 0; i < w->count; i++) {
        ovoid_plane plane = halfspaces_get(w, i);
        if (!(ellipsoid_compute_support(e, plane.normal) <= plane.offset)) return 0;
    }
    return 1;
}

// The largest t of a range whose ellipsoid is inside, by bisection; the lower end is assumed to be inside.
static double bisect(const halfspaces *w, family f, const double range[2], uint32_t *iterations) {
    double low = range[0], high = range[1];
    ovoid_ellipsoid e = f.make(f.context, high);
    if (is_inside(w, &e)) return high;
    for (int i = 0; i < 40; i++, (*iterations)++) {
        double middle = low + (high - low) / 2;
        e = f.make(f.context, middle);
        if (is_inside(w, &e))
            low = middle;
        else
            high = middle;
    }
    return low;
}

// The proven result; or the input if that is proven too, and larger.
static ovoid_fit finish(const halfspaces *w, const ovoid_ellipsoid *e, const ovoid_ellipsoid *input) {
    sym3dd q = sym3dd_from(e->q);
    uint32_t rank = w->polytope->rank;
    ovoid_fit fit = {.ellipsoid = ellipsoid_shrink_to_fit(w->polytope, e->center, &q), .gap = NAN, .converged = 1};
    fit.volume = ellipsoid_compute_measure(&fit.ellipsoid, rank);
    double before = input ? ellipsoid_compute_measure(input, rank) : 0;
    if (input && before >= fit.volume && (rank < 3 || ellipsoid_is_enclosed(w->polytope, input)))
        fit.ellipsoid = *input, fit.volume = before;
    return fit;
}

static ovoid_ellipsoid make_scaled(const void *context, double t) {
    const ovoid_ellipsoid *e = context;
    return (ovoid_ellipsoid){e->center, sym3_scale(e->q, t * t)};
}

static ovoid_fit compute_shrunk(const ovoid_polytope *polytope, const ovoid_ellipsoid *outer) {
    halfspaces w = halfspaces_make(polytope);
    uint32_t iterations = 0;
    // With a quarter of its radii the outer ellipsoid is inside: John's theorem promises a third.
    double t = bisect(&w, (family){make_scaled, outer}, (double[2]){0.25, 1}, &iterations);
    ovoid_ellipsoid e = make_scaled(outer, t);
    ovoid_fit fit = finish(&w, &e, NULL);
    fit.iterations = iterations;
    return fit;
}

ovoid_fit ovoid_ellipsoid_compute_shrunk(const ovoid_polytope *polytope, const ovoid_ellipsoid *outer) {
    ENVIRONMENT_RETURN(ovoid_fit, outer, compute_shrunk(polytope, outer));
}

// The mean of a facet's vertices. Each vertex is the start of one edge of the facet. A diagonal between two triangles
// of the facet is not an edge, as the lists of neighbours show.
static vec3 compute_facet_mean(const ovoid_polytope *p, uint32_t facet) {
    vec3 sum = {0, 0, 0};
    double count = 0;
    for (uint32_t t = 0; t < p->triangle_count; t++)
        for (uint32_t k = 0; p->triangle_facets[t] == facet && k < 3; k++) {
            uint32_t a = p->triangles[3 * (size_t)t + k], b = p->triangles[3 * (size_t)t + (k + 1) % 3], at;
            for (at = p->neighbor_starts[a]; at < p->neighbor_starts[a + 1] && p->neighbors[at] != b;) at++;
            if (at == p->neighbor_starts[a + 1]) continue;
            sum = vec3_add(sum, vec3_at(p->vertices, a));
            count++;
        }
    return count > 0 ? vec3_scale(sum, 1 / count) : vec3_at(p->vertices, 0);
}

// The mean of the vertices of a facet, an edge or an end.
static vec3 compute_halfspace_mean(const halfspaces *w, uint32_t halfspace) {
    const ovoid_polytope *p = w->polytope;
    if (p->rank == 3) return compute_facet_mean(p, halfspace);
    uint32_t corner[2];
    halfspaces_get_edge(w, halfspace, corner);
    vec3 a = vec3_at(p->vertices, corner[0]), b = vec3_at(p->vertices, corner[1]);
    return p->rank == 1 ? a : vec3_scale(vec3_add(a, b), 0.5);
}

// c' = c + beta d, d = s - c, and M'^(1/2) = (I + (alpha - 1) a a') M^(1/2) with a = M^(1/2) d / m, m = |M^(1/2) d|,
// alpha = 1 / (1 + beta m). Inverted: Q' = Q + (2 beta / m + beta^2) d d'.
typedef struct stretch {
    ovoid_ellipsoid base;
    vec3 d;
    double m;
} stretch;

static ovoid_ellipsoid make_stretched(const void *context, double beta) {
    const stretch *s = context;
    return (ovoid_ellipsoid){vec3_add_scaled(s->base.center, s->d, beta),
                             sym3_add(s->base.q, sym3_outer(s->d, 2 * beta / s->m + beta * beta))};
}

// |M^(1/2) d| in the eigen-axes along which the body has extent.
static double compute_gauge(sym3 q, vec3 d, uint32_t rank) {
    eigen3 e = sym3_compute_eigen(q);
    const vec3 axis[3] = {e.v.r0, e.v.r1, e.v.r2};
    double sum = 0;
    for (uint32_t i = 3 - rank; i < 3; i++) sum += vec3_dot(axis[i], d) / e.value[i] * vec3_dot(axis[i], d);
    return sqrt(sum);
}

static ovoid_fit compute_stretched(const ovoid_polytope *polytope, const ovoid_ellipsoid *shrunk) {
    halfspaces w = halfspaces_make(polytope);
    // The facet farthest from the centre; the first one if several are.
    uint32_t facet = 0, iterations = 0;
    double farthest = -INFINITY;
    for (uint32_t i = 0; i < w.count; i++) {
        ovoid_plane plane = halfspaces_get(&w, i);
        double distance = plane.offset - vec3_dot(plane.normal, shrunk->center);
        if (distance > farthest) farthest = distance, facet = i;
    }
    // s = c + l (s_m - c) / |s_m - c|.
    stretch s = {*shrunk, {0, 0, 0}, 0};
    if (w.count > 0) s.d = vec3_scale(vec3_unit(vec3_sub(compute_halfspace_mean(&w, facet), s.base.center)), farthest);
    s.m = compute_gauge(shrunk->q, s.d, polytope->rank);
    double beta = 0;
    ovoid_ellipsoid e = *shrunk;
    if (s.m > 0 && isfinite(s.m)) {
        beta = bisect(&w, (family){make_stretched, &s}, (double[2]){0, 1}, &iterations);
        e = make_stretched(&s, beta);
    }
    ovoid_fit fit = finish(&w, &e, shrunk);
    int stuck = fit.ellipsoid.center.x == shrunk->center.x && fit.ellipsoid.center.y == shrunk->center.y &&
                fit.ellipsoid.center.z == shrunk->center.z;
    fit.beta = stuck ? 0 : beta;
    fit.facet = facet;
    fit.iterations = iterations;
    return fit;
}

ovoid_fit ovoid_ellipsoid_compute_stretched(const ovoid_polytope *polytope, const ovoid_ellipsoid *shrunk) {
    ENVIRONMENT_RETURN(ovoid_fit, shrunk, compute_stretched(polytope, shrunk));
}

typedef struct enlargement {
    ovoid_ellipsoid base;
    vec3 axis;
    double value; // the square of the radius that is being enlarged
} enlargement;

static ovoid_ellipsoid make_enlarged(const void *context, double radius) {
    const enlargement *g = context;
    return (ovoid_ellipsoid){g->base.center, sym3_add(g->base.q, sym3_outer(g->axis, radius * radius - g->value))};
}

static ovoid_fit compute_enlarged(const ovoid_polytope *polytope, const ovoid_ellipsoid *stretched) {
    halfspaces w = halfspaces_make(polytope);
    eigen3 axes = sym3_compute_eigen(stretched->q);
    const vec3 axis[3] = {axes.v.r0, axes.v.r1, axes.v.r2};
    ovoid_ellipsoid e = *stretched;
    uint32_t iterations = 0;
    // Shortest radius first; radii across a flat body are not changed.
    for (uint32_t i = 3 - polytope->rank; i < 3; i++) {
        enlargement g = {e, axis[i], axes.value[i]};
        double range[2] = {sqrt(fmax(g.value, 0)), sqrt(fmax(g.value, 0))};
        if (!(range[0] > 0)) continue;
        // Double the radius until the ellipsoid no longer fits.
        do {
            range[1] *= 2;
            e = make_enlarged(&g, range[1]);
            iterations++;
        } while (is_inside(&w, &e) && iterations < 1000);
        e = make_enlarged(&g, bisect(&w, (family){make_enlarged, &g}, range, &iterations));
    }
    ovoid_fit fit = finish(&w, &e, stretched);
    fit.iterations = iterations;
    return fit;
}

ovoid_fit ovoid_ellipsoid_compute_enlarged(const ovoid_polytope *polytope, const ovoid_ellipsoid *stretched) {
    ENVIRONMENT_RETURN(ovoid_fit, stretched, compute_enlarged(polytope, stretched));
}
