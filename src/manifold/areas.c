// The whole polygon of a contact, and a bracket of its area.
//
// Contact is where the gap between the bodies along n is at most the margin m: { p across n : there are points of A and
// B over p whose heights differ by at most m }. Both are convex, so it is a convex region.
//
// Inner: the overlap of both patches, cut off where their planes are farther apart than m. Each point of it has a point
// of A and one of B.
//
// Outer: let a(p) >= be the height of a plane that is above A, b(p) that of one below B. A point of A over p that is in
// contact has its height z between b(p) - m and a(p). Each other plane w.x <= d of A then gives
//   w.p + w_n (b(p) - m) <= d  if w_n >= 0,   w.p + w_n a(p) <= d  if w_n < 0,
// a half-plane of p; of B the same with b(p) <= z <= a(p) + m. The planes used are those of the facets next to the
// patch; a and b are the patch's plane, or the plane across n at the support.
#include "base/environment.h"
#include "manifold/manifold.h"

enum { AREA_CORNERS = 2 * OVOID_MANIFOLD_CORNERS + 16 };

// A convex polygon that is cut by half-planes.
typedef struct region {
    uint32_t count;
    double x[AREA_CORNERS], y[AREA_CORNERS];
} region;

// The half-plane { p : x p.x + y p.y <= most }.
typedef struct half_plane {
    double x, y, most;
} half_plane;

// An affine function of p: at + x p.x + y p.y.
typedef struct affine {
    double at, x, y;
} affine;

// What a cut removes of a convex polygon is one run of its corners; a polygon that is full is left as it is, which is
// an outer polygon still.
static void cut(region *r, half_plane h) {
    region out = {0};
    if (r->count + 2 > AREA_CORNERS) return;
    for (uint32_t i = 0; i < r->count; i++) {
        uint32_t k = (i + 1) % r->count;
        double p = h.most - (h.x * r->x[i] + h.y * r->y[i]), q = h.most - (h.x * r->x[k] + h.y * r->y[k]);
        if (p >= 0) out.x[out.count] = r->x[i], out.y[out.count++] = r->y[i];
        if (!((p > 0 && q < 0) || (p < 0 && q > 0)) || out.count == AREA_CORNERS) continue;
        double t = p / (p - q);
        out.x[out.count] = r->x[i] + t * (r->x[k] - r->x[i]);
        out.y[out.count++] = r->y[i] + t * (r->y[k] - r->y[i]);
    }
    *r = out;
}

// The area, and by how much it changes if each corner is off by `off`.
typedef struct measured_area {
    double area, doubt;
} measured_area;
static measured_area measure(const region *r, double off) {
    double sum = 0, length = 0;
    for (uint32_t i = 0; i < r->count; i++) {
        uint32_t k = (i + 1) % r->count;
        sum += (r->x[i] - r->x[0]) * (r->y[k] - r->y[0]) - (r->y[i] - r->y[0]) * (r->x[k] - r->x[0]);
        length += fabs(r->x[k] - r->x[i]) + fabs(r->y[k] - r->y[i]);
    }
    return (measured_area){max2(sum, 0) / 2, (off + 64 * ROUNDING * length) * (length + 4 * off)};
}

static affine get_plane(const manifold_patch *p) {
    return (affine){p->at.z[0] - (p->slope_x * p->at.x[0] + p->slope_y * p->at.y[0]), p->slope_x, p->slope_y};
}

// ---- inner ----

static measured_area compute_inner(const manifold_state *s, double most, double pad) {
    region r = {.count = s->a.at.count > 2 && s->b.at.count > 2 ? s->a.at.count : 0};
    for (uint32_t i = 0; i < r.count; i++) r.x[i] = s->a.at.x[i], r.y[i] = s->a.at.y[i];
    for (uint32_t i = 0; i < s->b.at.count && r.count; i++) {
        double dx = s->b.at.x[i + 1] - s->b.at.x[i], dy = s->b.at.y[i + 1] - s->b.at.y[i];
        cut(&r, (half_plane){dy, -dx, dy * s->b.at.x[i] - dx * s->b.at.y[i]});
    }
    affine a = get_plane(&s->a), b = get_plane(&s->b);
    cut(&r, (half_plane){b.x - a.x, b.y - a.y, most - pad - (b.at - a.at)});
    return measure(&r, pad);
}

// ---- outer ----

// One body as the outer polygon sees it.
typedef struct outer_side {
    const manifold_frame *frame;
    const ovoid_shape *shape;
    int is_b;
    affine own;   ///< above all of A, below all of B
    affine other; ///< the same of the other body, moved by the margin
} outer_side;

// A plane above all of a body, in the frame: w.x <= most.
typedef struct body_plane {
    double x, y, n, most;
} body_plane;
static body_plane make_plane(const outer_side *o, vec3 w) {
    const manifold_frame *m = o->frame;
    simd_points points = shape_get_points(o->shape);
    double most = simd_find_support(&points, &w).value;
    if (!o->is_b) return (body_plane){vec3_dot(w, m->u), vec3_dot(w, m->v), vec3_dot(w, m->n), most};
    body_plane p = {vec3_dot(w, m->u_in_b), vec3_dot(w, m->v_in_b), vec3_dot(w, m->n_in_b), most};
    p.most += p.x * m->tu + p.y * m->tv + p.n * m->tn;
    return p;
}

// The height that a point in contact has at the least if w_n >= 0, at the most if it is below.
static void cut_by_plane(region *r, const outer_side *o, uint32_t facet, double pad) {
    body_plane w = make_plane(o, shape_get_facet_normal(o->shape, facet));
    int is_own = o->is_b ? w.n >= 0 : w.n < 0;
    affine z = is_own ? o->own : o->other;
    cut(r, (half_plane){w.x + w.n * z.x, w.y + w.n * z.y, w.most + pad - w.n * z.at});
}

// The facets on both sides of the edges of the patch, and all around its vertex if it has no edge.
static void cut_by_patch(region *r, const outer_side *o, const manifold_patch *p, double pad) {
    const uint32_t *facets = shape_edge_facets(o->shape), *starts = shape_neighbor_starts(o->shape);
    if (o->shape->rank < 2) return;
    for (uint32_t i = 0; i < patch_get_edge_count(p); i++) {
        edge_ends e = shape_get_ends(o->shape, p->edges[i]);
        cut_by_plane(r, o, facets[p->edges[i]], pad);
        cut_by_plane(r, o, facets[shape_find_edge(o->shape, e.to, e.from)], pad);
    }
    if (p->at.count > 1) return;
    uint32_t v = p->at.vertices[0], end = starts[v + 1];
    for (uint32_t i = starts[v]; i < end && i < starts[v] + PATCH_CORNERS; i++) cut_by_plane(r, o, facets[i], pad);
}

// The square around a body's sphere, seen along n.
static region make_square(const manifold_frame *m) {
    const ovoid_shape *a = m->pair->a;
    double x = vec3_dot(m->u, a->center), y = vec3_dot(m->v, a->center), r = a->reach + m->pair->claim;
    return (region){4, {x - r, x + r, x + r, x - r}, {y - r, y - r, y + r, y + r}};
}

static measured_area compute_outer(const manifold_state *s, double most, double pad) {
    const manifold_frame *m = &s->frame;
    const ovoid_shape *shape_a = m->pair->a, *shape_b = m->pair->b;
    affine top = {vec3_dot(m->n, frame_vertex_a(m->pair, m->low_a)), 0, 0}, low = {top.at + m->gap, 0, 0};
    affine a = s->a.at.count > 2 ? get_plane(&s->a) : top, b = s->b.at.count > 2 ? get_plane(&s->b) : low;
    outer_side of_a = {m, shape_a, 0, a, b}, of_b = {m, shape_b, 1, b, a};
    of_a.other.at -= most;
    of_b.other.at += most;
    region r = make_square(m);
    cut(&r, (half_plane){b.x - a.x, b.y - a.y, most + pad - (b.at - a.at)});
    cut_by_patch(&r, &of_a, &s->a, pad);
    cut_by_patch(&r, &of_b, &s->b, pad);
    return measure(&r, pad);
}

// ---- the whole polygon ----

static void write_corners(const manifold_state *s, int is_exchanged, ovoid_manifold_polygon *out) {
    corner_placing placing = corner_placing_make(s);
    out->count = s->polygon.count;
    for (uint32_t i = 0; i < out->count; i++) {
        const manifold_corner *c = s->polygon.corners + (is_exchanged ? out->count - 1 - i : i);
        out->points[i] = corner_placing_get_point(&placing, c);
        if (is_exchanged) point_exchange(out->points + i);
        out->grown = max2(out->grown, manifold_compute_excess(s, c));
    }
    out->grown += manifold_compute_world_rounding(s) + manifold_compute_rounding(s);
}

static ovoid_code compute(const ovoid_pair *pair, const ovoid_manifold *given, const ovoid_manifold_options *options,
                          ovoid_manifold_polygon *out) {
    ordered_pair o = ordered_pair_make(pair, given);
    pair_frame f;
    manifold_state s;
    manifold_terms t;
    out->count = 0;
    out->grown = out->inner = out->outer = 0;
    if (frame_make(&o.pair, &f) != OVOID_LIMIT_NONE || !manifold_terms_make(options, &f, &t))
        return OVOID_ERROR_ARGUMENT;
    if (!manifold_open(&f, &o.manifold, &s)) return OVOID_ERROR_ARGUMENT;
    manifold_axis axis = {o.manifold.axis, o.manifold.feature_a, o.manifold.feature_b};
    manifold_clip(&t, &axis, &o.manifold, &s);
    double most = t.margin + f.a->radius + f.b->radius, pad = 2 * manifold_compute_rounding(&s);
    measured_area inner = compute_inner(&s, most, pad), outer = compute_outer(&s, most, pad);
    out->inner = max2(inner.area - inner.doubt, 0);
    out->outer = outer.area + outer.doubt;
    write_corners(&s, o.is_exchanged, out);
    return OVOID_OK;
}

ovoid_code ovoid_manifold_compute_polygon(const ovoid_pair *pair, const ovoid_manifold *manifold,
                                          const ovoid_manifold_options *options, ovoid_manifold_polygon *polygon) {
    ENVIRONMENT_RETURN(ovoid_code, pair, compute(pair, manifold, options, polygon));
}
