// The claims of a contact: its points, the polygon in which two facets overlap, seen along the normal, and the bracket
// of the area in contact. Facets are clipped, and the zone of contact of the bodies is made, in exact arithmetic; their
// areas and the separations at their corners are quotients, bracketed to 2^-200.
#include "parts.h"
#include "zone.h"

#include <math.h>
#include <stdlib.h>

enum { FACET_CORNERS = OVOID_MANIFOLD_CORNERS / 2 };

/// How many snaps a corner may be from where it is exactly: corners nearer than four are one.
#define APART 5

typedef struct context {
    pool *p;
    const judge_contact *k;
    posed s;
    view w;
    seen_body a, b;
    flat_polygon facet_a, facet_b; ///< the facets
    flat_polygon exact;            ///< their overlap
    flat_polygon given;            ///< the hull of the given corners
    flat_polygon zone;
    const seen_plane *plane_a, *plane_b; ///< of the facets
    uint32_t corners;                    ///< of both facets together, as they are listed
    ovoid_error *error;
} context;

// ---- what is seen ----

/// The square of a length across the normal, in the metric of the view.
static num square_of(const context *c, double length) {
    pool *p = c->p;
    num scaled = num_mul(p, number_from(p, length), c->w.k);
    return num_mul(p, num_mul(p, scaled, scaled), c->w.vv);
}

/// 1 if a point is farther than a length from a polygon.
static int is_farther(const context *c, const flat_polygon *g, const flat_point *at, double length) {
    const num measure[2] = {c->w.nn, square_of(c, length)};
    return flat_is_farther(c->p, g, at, measure);
}

/// The length across the normal that a number of the view is, in doubles.
static double to_length(const context *c, double seen) {
    return seen / (num_to_double(c->w.k) * sqrt(num_to_double(c->w.vv)));
}

/// The hull of a facet's vertices, and the plane of its largest triangle. 0: the feature is no facet, or one of too
/// many vertices.
typedef struct facet {
    const body *body;
    const seen_body *seen;
    uint32_t feature;
    uint32_t count; ///< of vertices
    const seen_plane *plane;
} facet;
static int make_facet(const context *c, facet *f, flat_polygon *out) {
    const ovoid_polytope *t = &f->body->polytope;
    flat_point points[FACET_CORNERS];
    uint32_t index[FACET_CORNERS], wanted = f->feature & ~OVOID_MANIFOLD_KIND;
    double most = 0;
    if ((f->feature & OVOID_MANIFOLD_KIND) != OVOID_MANIFOLD_FACET) return 0;
    for (uint32_t i = 0; i < 3 * t->triangle_count; i++) {
        if (t->triangle_facets[i / 3] != (t->rank == 2 ? 0 : wanted)) continue;
        uint32_t k = 0;
        while (k < f->count && index[k] != t->triangles[i]) k++;
        if (k == FACET_CORNERS) return 0;
        index[k] = t->triangles[i];
        points[k] = f->seen->vertices[index[k]].at;
        if (k == f->count) f->count++;
        const seen_plane *plane = f->seen->planes + i / 3;
        double size = hypot(hypot(plane->a.d, plane->b.d), plane->c.d);
        if (size > most) most = size, f->plane = plane;
    }
    if (f->count < 3) return 0;
    flat_make_hull(c->p, points, f->count, out);
    return out->count > 2;
}

/// By how much the height of a plane changes along a length across the normal, at most.
static double find_slope(const context *c, const seen_plane *w) {
    double x = w->a.d * sqrt(num_to_double(c->w.nn)), steep = hypot(x, w->b.d) / fabs(w->c.d);
    return steep * sqrt(num_to_double(c->w.vv)) / sqrt(num_to_double(c->w.nn));
}

/// The height of a plane at a point, times k |n|.
static num find_height(const context *c, const seen_plane *w, const flat_point *at) {
    pool *p = c->p;
    num over =
        num_sub(p, num_sub(p, num_mul(p, w->d.n, at->w.n), num_mul(p, w->a.n, at->x.n)), num_mul(p, w->b.n, at->y.n));
    num under = num_mul(p, w->c.n, at->w.n);
    if (num_sign(under) < 0) over = num_neg(p, over), under = num_neg(p, under);
    return num_quotient_below(p, over, under, 240);
}

/// The separation of the bodies at a point over both facets, radii taken off.
static double find_separation(const context *c, const flat_point *at) {
    size_t mark = pool_get_mark(c->p);
    num gap = num_sub(c->p, find_height(c, c->plane_b, at), find_height(c, c->plane_a, at));
    num scaled = num_quotient_below(c->p, gap, c->w.k, 120);
    double cores = num_to_double(scaled) / sqrt(num_to_double(c->w.nn));
    pool_release(c->p, mark);
    return cores - num_to_double(c->s.radii);
}

// ---- the points ----

static ovoid_code verify_points(const context *c) {
    const ovoid_manifold_polygon *g = c->k->polygon;
    pool *p = c->p;
    num grown = number_from(p, g->grown), radii[2] = {c->s.a.radius, c->s.b.radius};
    for (uint32_t i = 0; i < g->count; i++) {
        const ovoid_manifold_point *x = g->points + i;
        size_t mark = pool_get_mark(p);
        nvec a = nvec_from(p, x->point_a), b = nvec_from(p, x->point_b);
        if (!body_holds(p, &c->s.a, a, num_add(p, radii[0], grown)))
            return judge_reject(c->error, OVOID_ERROR_PROOF, "corner %u: point_a is not in A grown by %.3g", i,
                                g->grown);
        if (!body_holds(p, &c->s.b, b, num_add(p, radii[1], grown)))
            return judge_reject(c->error, OVOID_ERROR_PROOF, "corner %u: point_b is not in B grown by %.3g", i,
                                g->grown);
        nvec off = nvec_sub(p, nvec_sub(p, b, a), nvec_scale(p, c->w.n, number_from(p, x->separation)));
        int is_off = num_compare(p, nvec_norm_squared(p, off), num_mul(p, grown, grown)) > 0;
        pool_release(p, mark);
        if (is_off) return judge_reject(c->error, OVOID_ERROR_PROOF, "corner %u: the points are off the normal", i);
        int is_nearest = (x->id & OVOID_MANIFOLD_KIND) == OVOID_MANIFOLD_ID_NEAREST;
        if (!is_nearest && !(x->separation <= c->k->margin + c->s.allowed + g->grown))
            return judge_reject(c->error, OVOID_ERROR_PROOF, "corner %u is farther than the margin", i);
    }
    return OVOID_OK;
}

// ---- the polygon ----

/// The corners that are given are in each facet, to the snap.
static ovoid_code verify_given(const context *c) {
    const ovoid_manifold_polygon *g = c->k->polygon;
    for (uint32_t i = 0; i < g->count; i++) {
        size_t mark = pool_get_mark(c->p);
        flat_point at = view_see(&c->w, g->points[i].point_a);
        double room = c->k->snap + g->grown;
        int is_out = is_farther(c, &c->facet_a, &at, room) || is_farther(c, &c->facet_b, &at, room);
        pool_release(c->p, mark);
        if (is_out) return judge_reject(c->error, OVOID_ERROR_PROOF, "corner %u is outside of a facet", i);
    }
    return OVOID_OK;
}

/// The least distance that decides which corners there are, in doubles: of a corner from a line of the other facet.
static double find_nearest(const context *c, const flat_polygon *corners, const flat_polygon *lines) {
    double nearest = INFINITY, metric = num_to_double(c->w.nn);
    for (uint32_t i = 0; i < corners->count; i++)
        for (uint32_t k = 0; k < lines->count; k++) {
            const flat_line *l = lines->lines + k;
            const flat_point *x = corners->corners + i;
            if (lines == corners && (k == i || (k + 1) % corners->count == i)) continue;
            double side = l->a.d * (x->x.d / x->w.d) + l->b.d * (x->y.d / x->w.d) + l->c.d;
            nearest = fmin(nearest, fabs(side) * sqrt(metric) / sqrt(l->a.d * l->a.d + metric * l->b.d * l->b.d));
        }
    return to_length(c, nearest);
}

/// The least distance between corners of the overlap, in doubles.
static double find_closest(const context *c) {
    double closest = INFINITY;
    for (uint32_t i = 0; i < c->exact.count; i++) {
        const flat_point *x = c->exact.corners + i, *y = c->exact.corners + (i + 1) % c->exact.count;
        double dx = x->x.d / x->w.d - y->x.d / y->w.d, dy = x->y.d / x->w.d - y->y.d / y->w.d;
        closest = fmin(closest, sqrt(num_to_double(c->w.nn) * dx * dx + dy * dy));
    }
    return to_length(c, closest);
}

// The corners of the overlap within the margin are at most some snaps away from the polygon that is given; where none
// of them, and nothing that decides about them, is in doubt, there are as many as are given. `doubt`: by how much the
// separation at a corner may differ from that at the corner which stands for it.
static ovoid_code verify_exact(const context *c) {
    const ovoid_manifold_polygon *g = c->k->polygon;
    double room = APART * c->k->snap + g->grown;
    double doubt = room * (find_slope(c, c->plane_a) + find_slope(c, c->plane_b)) + g->grown;
    int is_clear = c->corners == c->facet_a.count + c->facet_b.count && find_closest(c) > room &&
                   fmin(find_nearest(c, &c->facet_a, &c->facet_b), find_nearest(c, &c->facet_b, &c->facet_a)) > room &&
                   fmin(find_nearest(c, &c->facet_a, &c->facet_a), find_nearest(c, &c->facet_b, &c->facet_b)) > room;
    uint32_t wanted = 0;
    for (uint32_t i = 0; i < c->exact.count; i++) {
        double separation = find_separation(c, &c->exact.corners[i]);
        is_clear &= fabs(separation - c->k->margin) > doubt;
        wanted += separation <= c->k->margin;
        if (separation > c->k->margin - doubt || !is_farther(c, &c->given, &c->exact.corners[i], room)) continue;
        return judge_reject(c->error, OVOID_ERROR_PROOF, "corner %u of the exact polygon is missing", i);
    }
    if (is_clear && wanted && wanted != g->count)
        return judge_reject(c->error, OVOID_ERROR_PROOF, "%u corners; the exact polygon has %u", g->count, wanted);
    return OVOID_OK;
}

/// The sign of an area less a number of the view that is twice an area.
static int compare_area(const context *c, double area, num twice) {
    pool *p = c->p;
    num scale = num_scaled(p, num_mul(p, num_mul(p, c->w.k, c->w.k), c->w.uu), 1);
    return num_compare_roots(p, num_mul(p, number_from(p, area), scale), c->w.nn, twice, number_from_integer(p, 1));
}

static ovoid_code verify_facets(context *c) {
    const ovoid_manifold *m = c->k->manifold;
    facet a = {.body = &c->s.a, .seen = &c->a, .feature = m->facet_a},
          b = {.body = &c->s.b, .seen = &c->b, .feature = m->facet_b};
    if (!make_facet(c, &a, &c->facet_a) || !make_facet(c, &b, &c->facet_b)) return OVOID_OK;
    c->plane_a = a.plane;
    c->plane_b = b.plane;
    c->corners = a.count + b.count;
    ovoid_code code = verify_given(c);
    if (code != OVOID_OK) return code;
    c->exact = c->facet_a;
    for (uint32_t i = 0; i < c->facet_b.count; i++)
        if (!flat_cut(c->p, &c->facet_b.lines[i], &c->exact)) return OVOID_OK;
    if (c->exact.count < 3) return OVOID_OK;
    num_bracket area = flat_find_area(c->p, &c->exact);
    if (compare_area(c, c->k->polygon->inner, area.above) > 0)
        return judge_reject(c->error, OVOID_ERROR_PROOF, "the inner area is more than that of the facets' overlap");
    return verify_exact(c);
}

// ---- the area ----

static ovoid_code verify_areas(context *c) {
    const ovoid_manifold_polygon *g = c->k->polygon;
    pool *p = c->p;
    num length = num_mul(p, num_add(p, number_from(p, c->k->margin), c->s.radii), c->w.k);
    num roots[2] = {num_root_below(p, c->w.nn, 200), num_root_above(p, c->w.nn, 200)};
    for (int is_outer = 0; is_outer < 2; is_outer++) {
        const zone_terms terms = {&c->a, &c->b, num_mul(p, length, roots[is_outer]), is_outer};
        if (!zone_make(&c->w, &terms, &c->zone)) return OVOID_OK;
        num_bracket area = flat_find_area(p, &c->zone);
        if (is_outer && compare_area(c, g->inner, area.above) > 0)
            return judge_reject(c->error, OVOID_ERROR_PROOF, "the inner area is more than that in contact");
        if (!is_outer && compare_area(c, g->outer, area.below) < 0)
            return judge_reject(c->error, OVOID_ERROR_PROOF, "the outer area is less than that in contact");
    }
    return OVOID_OK;
}

static ovoid_code verify_polygon(context *c) {
    const ovoid_manifold_polygon *g = c->k->polygon;
    flat_point corners[OVOID_MANIFOLD_CORNERS];
    c->a = seen_body_make(&c->w, &c->s.a, c->s.b.n, 1);
    c->b = seen_body_make(&c->w, &c->s.b, c->s.a.n, -1);
    for (uint32_t i = 0; i < g->count; i++) corners[i] = view_see(&c->w, g->points[i].point_a);
    flat_make_hull(c->p, corners, g->count, &c->given);
    ovoid_code code = verify_facets(c);
    if (code == OVOID_OK) code = verify_areas(c);
    seen_body_free(&c->a);
    seen_body_free(&c->b);
    return code;
}

ovoid_code judge_verify_contact(judge *j, const ovoid_pair *pair, const judge_contact *k, ovoid_error *error) {
    const ovoid_manifold *m = k->manifold;
    if (!judge_is_pose_valid(&pair->pose_a) || !judge_is_pose_valid(&pair->pose_b) || !is_finite(m->normal))
        return judge_reject(error, OVOID_ERROR_NOT_FINITE, "a pose or the normal is not finite");
    size_t mark = pool_get_mark(j->p);
    context *c = judge_allocate(1, sizeof *c);
    c->p = j->p;
    c->k = k;
    c->error = error;
    c->s = posed_make(j->p, pair);
    nvec n = nvec_from(j->p, m->normal);
    ovoid_proof proof = {.normal = m->normal};
    num core = num_add(j->p, num_add(j->p, number_from(j->p, m->lower), c->s.radii), c->s.outside);
    claim lower = {j, &c->s, &proof, core, error};
    ovoid_code code = judge_verify_lower(&lower);
    if (code == OVOID_OK && k->polygon->count) {
        c->w = view_make(&c->s, n);
        code = verify_points(c);
        if (code == OVOID_OK) code = verify_polygon(c);
    }
    free(c);
    pool_release(j->p, mark);
    return code;
}
