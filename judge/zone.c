// The zone of contact of two bodies along a normal. Over a point p across the normal let a(p) be the height of A's
// upper side, b(p) that of B's lower one. A's planes above it give a x + b y + c z <= d with c > 0, B's below it with c
// < 0; so b(p) - a(p) <= reach is one half-plane of p for each of the former and each of the latter, and the shadows of
// the bodies are the others. No other planes matter.
#include "zone.h"

#include "parts.h"

#include <math.h>
#include <stdlib.h>

/// As in flat.c.
#define SURE 1e-12

view view_make(const posed *s, nvec n) {
    pool *p = s->p;
    num zero = number_from_integer(p, 0), one = number_from_integer(p, 1);
    int is_x = fabs(num_to_double(n.x)) < 0.6;
    view w = {.p = p, .k = s->k, .n = n};
    w.u = nvec_cross(p, n, (nvec){is_x ? one : zero, is_x ? zero : one, zero});
    w.v = nvec_cross(p, n, w.u);
    w.nn = nvec_norm_squared(p, n);
    w.uu = nvec_norm_squared(p, w.u);
    w.vv = num_mul(p, w.nn, w.uu);
    return w;
}

flat_point view_see(const view *w, ovoid_vec3 point) {
    nvec x = nvec_scale(w->p, nvec_from(w->p, point), w->k);
    return flat_point_make(w->p, nvec_dot(w->p, w->u, x), nvec_dot(w->p, w->v, x));
}

// ---- bodies ----

static seen_plane plane_through(pool *p, const seen_vertex *const corner[3]) {
    nvec x[3];
    for (int i = 0; i < 3; i++) x[i] = (nvec){corner[i]->at.x.n, corner[i]->at.y.n, corner[i]->height.n};
    nvec w = nvec_cross(p, nvec_sub(p, x[1], x[0]), nvec_sub(p, x[2], x[0]));
    return (seen_plane){twin_make(w.x), twin_make(w.y), twin_make(w.z), twin_make(nvec_dot(p, w, x[0]))};
}

/// A flat body has one side: it is the one that faces the other body.
static seen_plane plane_face(pool *p, seen_plane w, int side) {
    if (num_sign(w.c.n) * side >= 0) return w;
    return (seen_plane){twin_make(num_neg(p, w.a.n)), twin_make(num_neg(p, w.b.n)), twin_make(num_neg(p, w.c.n)),
                        twin_make(num_neg(p, w.d.n))};
}

seen_body seen_body_make(const view *w, const body *b, num scale, int side) {
    const ovoid_polytope *t = &b->polytope;
    pool *p = w->p;
    seen_body out = {.count = t->vertex_count, .plane_count = t->triangle_count};
    out.vertices = judge_allocate(out.count, sizeof *out.vertices);
    out.planes = judge_allocate(out.plane_count + 1, sizeof *out.planes);
    for (uint32_t i = 0; i < out.count; i++) {
        nvec x = nvec_scale(p, body_vertex(p, b, i), scale);
        out.vertices[i] = (seen_vertex){flat_point_make(p, nvec_dot(p, w->u, x), nvec_dot(p, w->v, x)),
                                        twin_make(nvec_dot(p, w->n, x))};
    }
    for (uint32_t i = 0; i < out.plane_count; i++) {
        const uint32_t *v = t->triangles + 3 * (size_t)i;
        const seen_vertex *corners[3] = {out.vertices + v[0], out.vertices + v[1], out.vertices + v[2]};
        out.planes[i] = plane_through(p, corners);
        if (t->rank < 3) out.planes[i] = plane_face(p, out.planes[i], side);
    }
    return out;
}

void seen_body_free(seen_body *b) {
    free(b->vertices);
    free(b->planes);
}

/// The plane's d, moved out until no vertex is outside.
static num find_support(pool *p, const seen_body *b, const seen_plane *w) {
    num most = w->d.n;
    for (uint32_t i = 0; i < b->count; i++) {
        const seen_vertex *v = b->vertices + i;
        double x = w->a.d * v->at.x.d, y = w->b.d * v->at.y.d, z = w->c.d * v->height.d;
        if (x + y + z - w->d.d < -SURE * (fabs(x) + fabs(y) + fabs(z) + fabs(w->d.d))) continue;
        num at = num_add(p, num_add(p, num_mul(p, w->a.n, v->at.x.n), num_mul(p, w->b.n, v->at.y.n)),
                         num_mul(p, w->c.n, v->height.n));
        if (num_compare(p, at, most) > 0) most = at;
    }
    return most;
}

// ---- the zone ----

static void make_shadow(pool *p, const seen_body *b, flat_polygon *out) {
    flat_point *points = judge_allocate(b->count, sizeof *points);
    for (uint32_t i = 0; i < b->count; i++) points[i] = b->vertices[i].at;
    flat_make_hull(p, points, b->count, out);
    free(points);
}

/// 1 if doubles show that the half-plane of two planes holds the polygon.
static int is_held(const seen_plane *i, const seen_plane *j, double reach, const flat_polygon *g) {
    double xi = j->c.d * i->a.d, xj = i->c.d * j->a.d, yi = j->c.d * i->b.d, yj = i->c.d * j->b.d;
    double di = j->c.d * i->d.d, dj = i->c.d * j->d.d, dr = reach * (i->c.d * j->c.d);
    for (uint32_t q = 0; q < g->count; q++) {
        double x = g->corners[q].x.d / g->corners[q].w.d, y = g->corners[q].y.d / g->corners[q].w.d;
        double sum = (xi - xj) * x + (yi - yj) * y + (dj - di - dr);
        double all = (fabs(xi) + fabs(xj)) * fabs(x) + (fabs(yi) + fabs(yj)) * fabs(y) + fabs(di) + fabs(dj) + fabs(dr);
        if (!(sum > SURE * all)) return 0;
    }
    return 1;
}

/// The half-plane in which B's plane j is above A's plane i by at most the reach.
static flat_line make_line(const view *w, const zone_terms *t, const seen_plane *i, const seen_plane *j) {
    pool *p = w->p;
    num di = t->is_outer ? find_support(p, t->a, i) : i->d.n, dj = t->is_outer ? find_support(p, t->b, j) : j->d.n;
    num a = num_sub(p, num_mul(p, j->c.n, i->a.n), num_mul(p, i->c.n, j->a.n));
    num b = num_sub(p, num_mul(p, j->c.n, i->b.n), num_mul(p, i->c.n, j->b.n));
    num c = num_sub(p, num_mul(p, i->c.n, dj), num_mul(p, j->c.n, di));
    c = num_sub(p, c, num_mul(p, t->reach, num_mul(p, i->c.n, j->c.n)));
    return (flat_line){twin_make(a), twin_make(b), twin_make(c)};
}

int zone_make(const view *w, const zone_terms *t, flat_polygon *out) {
    static flat_polygon other;
    double reach = num_to_double(t->reach);
    int is_whole = 1;
    make_shadow(w->p, t->a, out);
    make_shadow(w->p, t->b, &other);
    if (other.count < 3) out->count = 0;
    for (uint32_t i = 0; i < other.count; i++) is_whole &= flat_cut(w->p, &other.lines[i], out);
    for (uint32_t i = 0; i < t->a->plane_count; i++) {
        if (num_sign(t->a->planes[i].c.n) <= 0) continue;
        for (uint32_t j = 0; j < t->b->plane_count; j++) {
            const seen_plane *above = t->a->planes + i, *below = t->b->planes + j;
            if (num_sign(below->c.n) >= 0 || is_held(above, below, reach, out)) continue;
            flat_line line = make_line(w, t, above, below);
            is_whole &= flat_cut(w->p, &line, out);
        }
    }
    return is_whole;
}
