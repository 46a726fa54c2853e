// The points of a contact, and the polygon in which two facets overlap, seen along the contact's normal: clipped in
// exact arithmetic. A corner of one facet is a corner of the overlap if it is on the inner side of every edge of the
// other; a point where two edges cross is one too; there are no others. Which corners there are is decided by signs of
// determinants; where they are is then a quotient, in doubles.
#include "parts.h"

#include <math.h>
#include <stdlib.h>

enum { EDGES = OVOID_MANIFOLD_CORNERS / 2, CORNERS = 4 * OVOID_MANIFOLD_CORNERS };

// A facet's boundary: directed edges with the facet to their left, seen from the tip of the normal. Points carry k.
typedef struct outline {
    uint32_t count;
    nvec from[EDGES], to[EDGES];
} outline;

typedef struct place {
    double x, y, z;
} place;

// The exact overlap.
typedef struct overlap {
    uint32_t count;
    place corners[CORNERS]; ///< world
    double nearest;         ///< of all distances between a corner and an edge's line that decided something, the least
} overlap;

typedef struct context {
    pool *p;
    posed s;
    nvec n; ///< the normal
    double n_length;
    outline a, b;
    overlap exact;
} context;

// ---- outlines ----

static int has_edge(const uint32_t (*edges)[2], uint32_t count, uint32_t from, uint32_t to) {
    for (uint32_t i = 0; i < count; i++)
        if (edges[i][0] == from && edges[i][1] == to) return 1;
    return 0;
}

// The directed edges of a facet's triangles without those that are there both ways. 0: it has too many edges.
static int list_edges(const ovoid_polytope *t, uint32_t facet, uint32_t (*out)[2], uint32_t *count) {
    uint32_t all[3 * EDGES][2], found = 0;
    for (uint32_t i = 0; i < 3 * t->triangle_count; i++) {
        if (t->triangle_facets[i / 3] != (t->rank == 2 ? 0 : facet)) continue;
        if (found == 3 * EDGES) return 0;
        all[found][0] = t->triangles[i];
        all[found++][1] = t->triangles[i % 3 == 2 ? i - 2 : i + 1];
    }
    *count = 0;
    for (uint32_t i = 0; i < found; i++) {
        if (has_edge((const uint32_t(*)[2])all, found, all[i][1], all[i][0])) continue;
        if (*count == EDGES) return 0;
        out[*count][0] = all[i][0];
        out[(*count)++][1] = all[i][1];
    }
    return *count >= 3;
}

static int make_outline(context *c, const body *b, num scale, uint32_t feature, int is_b, outline *o) {
    uint32_t edges[EDGES][2];
    uint32_t facet = feature & ~OVOID_MANIFOLD_KIND;
    if ((feature & OVOID_MANIFOLD_KIND) != OVOID_MANIFOLD_FACET) return 0;
    if (!list_edges(&b->polytope, facet, edges, &o->count)) return 0;
    int is_turned = is_b != (b->polytope.rank == 2 && facet == 1);
    for (uint32_t i = 0; i < o->count; i++) {
        o->from[i] = nvec_scale(c->p, body_vertex(c->p, b, edges[i][is_turned]), scale);
        o->to[i] = nvec_scale(c->p, body_vertex(c->p, b, edges[i][!is_turned]), scale);
    }
    return 1;
}

// ---- exact clipping ----

static place place_of(const context *c, nvec x) {
    double k = num_to_double(c->s.k);
    return (place){num_to_double(x.x) / k, num_to_double(x.y) / k, num_to_double(x.z) / k};
}

// The determinant whose sign says on which side of an edge a point is, seen along the normal; its distance is noted.
static num find_side(context *c, const outline *o, uint32_t i, nvec x) {
    pool *p = c->p;
    nvec edge = nvec_sub(p, o->to[i], o->from[i]);
    nvec across = nvec_cross(p, c->n, edge);
    num side = nvec_dot(p, across, nvec_sub(p, x, o->from[i]));
    double length = sqrt(num_to_double(nvec_norm_squared(p, across))) * num_to_double(c->s.k);
    if (length > 0) c->exact.nearest = fmin(c->exact.nearest, fabs(num_to_double(side)) / length);
    return side;
}

static void add_corner(context *c, place at) {
    if (c->exact.count < CORNERS) c->exact.corners[c->exact.count++] = at;
}

static void add_inside(context *c, const outline *own, const outline *other) {
    for (uint32_t i = 0; i < own->count; i++) {
        int is_inside = 1;
        for (uint32_t k = 0; k < other->count && is_inside; k++)
            is_inside = num_sign(find_side(c, other, k, own->from[i])) >= 0;
        if (is_inside) add_corner(c, place_of(c, own->from[i]));
    }
}

static void add_crossings(context *c) {
    for (uint32_t i = 0; i < c->a.count; i++)
        for (uint32_t k = 0; k < c->b.count; k++) {
            size_t mark = pool_get_mark(c->p);
            num p = find_side(c, &c->a, i, c->b.from[k]), q = find_side(c, &c->a, i, c->b.to[k]);
            num r = find_side(c, &c->b, k, c->a.from[i]), s = find_side(c, &c->b, k, c->a.to[i]);
            if (num_sign(p) * num_sign(q) < 0 && num_sign(r) * num_sign(s) < 0) {
                double t = num_to_double(p) / num_to_double(num_sub(c->p, p, q));
                place from = place_of(c, c->b.from[k]), to = place_of(c, c->b.to[k]);
                add_corner(c, (place){from.x + t * (to.x - from.x), from.y + t * (to.y - from.y),
                                      from.z + t * (to.z - from.z)});
            }
            pool_release(c->p, mark);
        }
}

// ---- the overlap in doubles, seen along the normal ----

typedef struct flat {
    double x, y;
} flat;

// Two directions across the normal.
typedef struct across {
    place u, v;
} across;

static double dot(place a, place b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static place cross(place a, place b) {
    return (place){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static place unit(place a) {
    double l = sqrt(dot(a, a));
    return (place){a.x / l, a.y / l, a.z / l};
}
static across make_across(place n) {
    place axis = fabs(n.x) < 0.6 ? (place){1, 0, 0} : (place){0, 1, 0};
    place u = unit(cross(n, axis));
    return (across){u, cross(unit(n), u)};
}
static flat see(const across *a, place x) { return (flat){dot(a->u, x), dot(a->v, x)}; }

static flat middle;
static int compare_turns(const void *p, const void *q) {
    const flat *a = p, *b = q;
    double s = atan2(a->y - middle.y, a->x - middle.x), t = atan2(b->y - middle.y, b->x - middle.x);
    return (s > t) - (s < t);
}
static void sort_corners(flat *x, uint32_t count) {
    middle = (flat){0, 0};
    for (uint32_t i = 0; i < count; i++) middle.x += x[i].x / count, middle.y += x[i].y / count;
    qsort(x, count, sizeof *x, compare_turns);
}
static double find_area(const flat *x, uint32_t count) {
    double sum = 0;
    for (uint32_t i = 1; i + 1 < count; i++)
        sum += (x[i].x - x[0].x) * (x[i + 1].y - x[0].y) - (x[i].y - x[0].y) * (x[i + 1].x - x[0].x);
    return sum / 2;
}
// The distance of a point from a convex polygon whose corners are in order; 0 inside.
static double find_distance(const flat *x, uint32_t count, flat p) {
    double nearest = INFINITY;
    int is_inside = count > 2;
    for (uint32_t i = 0; i < count; i++) {
        flat a = x[i], b = x[(i + 1) % count];
        double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
        double t = square > 0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / square : 0;
        t = t < 0 ? 0 : t > 1 ? 1 : t;
        nearest = fmin(nearest, hypot(a.x + t * dx - p.x, a.y + t * dy - p.y));
        is_inside &= dx * (p.y - a.y) - dy * (p.x - a.x) >= 0;
    }
    return is_inside ? 0 : nearest;
}

// ---- the claims ----

static ovoid_code verify_points(context *c, const judge_contact *k, ovoid_error *error) {
    const ovoid_manifold_polygon *g = k->polygon;
    num grown = number_from(c->p, g->grown);
    for (uint32_t i = 0; i < g->count; i++) {
        const ovoid_manifold_point *x = g->points + i;
        size_t mark = pool_get_mark(c->p);
        nvec a = nvec_from(c->p, x->point_a), b = nvec_from(c->p, x->point_b);
        if (!body_holds(c->p, &c->s.a, a, num_add(c->p, c->s.a.radius, grown)))
            return judge_reject(error, OVOID_ERROR_PROOF, "corner %u: point_a is not in A grown by %.3g", i, g->grown);
        if (!body_holds(c->p, &c->s.b, b, num_add(c->p, c->s.b.radius, grown)))
            return judge_reject(error, OVOID_ERROR_PROOF, "corner %u: point_b is not in B grown by %.3g", i, g->grown);
        nvec off = nvec_sub(c->p, nvec_sub(c->p, b, a), nvec_scale(c->p, c->n, number_from(c->p, x->separation)));
        double found = sqrt(num_to_double(nvec_norm_squared(c->p, off)));
        pool_release(c->p, mark);
        if (!(found <= g->grown))
            return judge_reject(error, OVOID_ERROR_PROOF, "corner %u: the points are off the normal by %.3g", i, found);
    }
    return OVOID_OK;
}

static double find_distance_from(const context *c, const outline *o, const across *a, flat p) {
    flat x[EDGES];
    for (uint32_t i = 0; i < o->count; i++) x[i] = see(a, place_of(c, o->from[i]));
    sort_corners(x, o->count);
    return find_distance(x, o->count, p);
}

// Corners within the margin that are exact must be there, and what is there must be in each of both facets, to the
// snap: where edges are nearly parallel, the overlap itself may begin much farther away than the snap.
static ovoid_code compare_polygons(context *c, const judge_contact *k, flat *exact, const across *a,
                                   ovoid_error *error) {
    const ovoid_manifold_polygon *g = k->polygon;
    flat given[OVOID_MANIFOLD_CORNERS];
    int is_cut = 0;
    for (uint32_t i = 0; i < g->count; i++)
        given[i] = see(a, (place){g->points[i].point_a.x, g->points[i].point_a.y, g->points[i].point_a.z});
    for (uint32_t i = 0; i < g->count; i++) {
        double off = fmax(find_distance_from(c, &c->a, a, given[i]), find_distance_from(c, &c->b, a, given[i]));
        if (!(off <= k->snap + g->grown))
            return judge_reject(error, OVOID_ERROR_PROOF, "corner %u is outside of a facet by %.3g", i, off);
    }
    // Where corners are left out, as farther apart than the margin, the polygon is smaller than the overlap.
    for (uint32_t i = 0; i < c->exact.count; i++) {
        double nearest = INFINITY;
        for (uint32_t j = 0; j < g->count; j++)
            nearest = fmin(nearest, hypot(given[j].x - exact[i].x, given[j].y - exact[i].y));
        is_cut |= nearest > 5 * k->snap + g->grown;
    }
    if (is_cut && isinf(k->margin))
        return judge_reject(error, OVOID_ERROR_PROOF, "a corner of the exact polygon is missing");
    double area = find_area(exact, c->exact.count), doubt = 1e-13 * (1 + area);
    if (!(g->inner <= area + doubt))
        return judge_reject(error, OVOID_ERROR_PROOF, "inner area %.17g; the overlap has %.17g", g->inner, area);
    if (!is_cut && !(g->outer >= area - doubt))
        return judge_reject(error, OVOID_ERROR_PROOF, "outer area %.17g; the overlap has %.17g", g->outer, area);
    double nearest = c->exact.nearest;
    for (uint32_t i = 0; i < c->exact.count; i++) {
        flat next = exact[(i + 1) % c->exact.count];
        nearest = fmin(nearest, hypot(next.x - exact[i].x, next.y - exact[i].y));
    }
    if (!is_cut && nearest > 5 * k->snap && g->count != c->exact.count)
        return judge_reject(error, OVOID_ERROR_PROOF, "%u corners; the exact polygon has %u", g->count, c->exact.count);
    return OVOID_OK;
}

static ovoid_code verify_polygon(context *c, const judge_contact *k, ovoid_error *error) {
    flat exact[CORNERS];
    ovoid_vec3 n = k->manifold->normal;
    if (!make_outline(c, &c->s.a, c->s.b.n, k->manifold->facet_a, 0, &c->a)) return OVOID_OK;
    if (!make_outline(c, &c->s.b, c->s.a.n, k->manifold->facet_b, 1, &c->b)) return OVOID_OK;
    c->exact.count = 0;
    c->exact.nearest = INFINITY;
    add_inside(c, &c->a, &c->b);
    add_inside(c, &c->b, &c->a);
    add_crossings(c);
    if (c->exact.count < 3) return OVOID_OK;
    across a = make_across((place){n.x, n.y, n.z});
    for (uint32_t i = 0; i < c->exact.count; i++) exact[i] = see(&a, c->exact.corners[i]);
    sort_corners(exact, c->exact.count);
    return compare_polygons(c, k, exact, &a, error);
}

ovoid_code judge_verify_contact(judge *j, const ovoid_pair *pair, const judge_contact *k, ovoid_error *error) {
    const ovoid_manifold *m = k->manifold;
    if (!judge_is_pose_valid(&pair->pose_a) || !judge_is_pose_valid(&pair->pose_b) || !is_finite(m->normal))
        return judge_reject(error, OVOID_ERROR_NOT_FINITE, "a pose or the normal is not finite");
    size_t mark = pool_get_mark(j->p);
    context *c = judge_allocate(1, sizeof *c);
    c->p = j->p;
    c->s = posed_make(j->p, pair);
    c->n = nvec_from(j->p, m->normal);
    ovoid_proof proof = {.normal = m->normal};
    num core = num_add(j->p, num_add(j->p, number_from(j->p, m->lower), c->s.radii), c->s.outside);
    claim lower = {j, &c->s, &proof, core, error};
    ovoid_code code = judge_verify_lower(&lower);
    if (code == OVOID_OK) code = verify_points(c, k, error);
    if (code == OVOID_OK) code = verify_polygon(c, k, error);
    free(c);
    pool_release(j->p, mark);
    return code;
}
