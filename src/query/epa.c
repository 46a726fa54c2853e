// G. van den Bergen, Proximity queries and penetration depth computation on 3D game objects, 2001, with these changes:
// - The polytope is a convex hull that grows, wherever the origin is: a new point replaces the faces that it sees. So
//   exact touching, where the origin is on the boundary or just outside, needs no case of its own: the face of least
//   offset then gives a normal along which the gap is 0 to rounding.
// - Nothing is believed: the lower bound is the gap along a face's normal, by the supports; the upper bound is the
//   radius that the whole surface keeps from the origin, checked at the end as a proof (cover.c).
// Working memory is fixed, on the stack, about 80 KB. Cost: one support and a scan of the faces for each new point.
#include "query/epa.h"

#include "query/cover.h"
#include "query/expand.h"
#include "query/hull.h"

#include <string.h>

typedef expansion_face face;

static int has_point(const expansion *e, uint32_t a, uint32_t b) {
    for (uint32_t i = 0; i < e->points; i++)
        if (e->a[i] == a && e->b[i] == b) return 1;
    return 0;
}

// The farther support of +n and -n from the plane n.x = offset; its distance in *far.
static frame_support probe_both(search *s, vec3 n, double offset, double *far) {
    frame_support up = search_probe(s, vec3_neg(n)), down = search_probe(s, n);
    double high = vec3_dot(n, up.w) - offset, low = offset - vec3_dot(n, down.w);
    *far = fmax(high, low);
    return high >= low ? up : down;
}

static void push(expansion *e, frame_support w) { (void)expansion_add_point(e, w.w, w.a, w.b); }

// Four differences that span space; 0 if the difference body is flat, as far as doubles can tell.
static int find_tetrahedron(search *s, expansion *e) {
    static const vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    // The widest of three axes.
    double widest = -1;
    frame_support ends[2] = {{0}, {0}};
    for (int i = 0; i < 3; i++) {
        frame_support up = search_probe(s, vec3_neg(axes[i])), down = search_probe(s, axes[i]);
        double width = vec3_norm(vec3_sub(up.w, down.w));
        if (width > widest) widest = width, ends[0] = up, ends[1] = down;
    }
    if (!(widest > e->slack)) return 0;
    push(e, ends[0]);
    push(e, ends[1]);
    // The farthest from that line, in two directions across.
    vec3 e1 = vec3_unit(vec3_sub(e->w[1], e->w[0])), side[2];
    side[0] = vec3_orthogonal(e1);
    side[1] = vec3_cross(e1, side[0]);
    double far[2];
    frame_support t[2];
    for (int i = 0; i < 2; i++) t[i] = probe_both(s, side[i], vec3_dot(side[i], e->w[0]), &far[i]);
    int wide = far[0] >= far[1] ? 0 : 1;
    if (!(far[wide] > e->slack)) return 0;
    push(e, t[wide]);
    // The farthest from that plane.
    vec3 e2 = vec3_sub(e->w[2], e->w[0]);
    vec3 n = simplex_compute_normal(e1, e2);
    frame_support top = probe_both(s, n, vec3_dot(n, e->w[0]), &far[0]);
    if (!(far[0] > e->slack)) return 0;
    push(e, top);
    return 1;
}

// GJK's own tetrahedron if it has a volume to speak of, else one found afresh.
static int start(search *s, expansion *e, const simplex *from) {
    if (from->count == 4) {
        vec3 e1 = vec3_sub(from->p[1].w, from->p[0].w), e2 = vec3_sub(from->p[2].w, from->p[0].w);
        vec3 e3 = vec3_sub(from->p[3].w, from->p[0].w);
        double volume = fabs(vec3_dot(vec3_cross(e1, e2), e3));
        if (volume > 1e-6 * vec3_norm(e1) * vec3_norm(e2) * vec3_norm(e3)) {
            for (int i = 0; i < 4; i++) (void)expansion_add_point(e, from->p[i].w, from->p[i].a, from->p[i].b);
            return 1;
        }
    }
    return find_tetrahedron(s, e);
}

// The corners of a face as evidence, weighted to the point nearest to the target; *distance: how near.
static evidence face_evidence(const expansion *e, const face *f, vec3 target, double *distance) {
    // In a unit of the face's size, so that no product of four lengths underflows.
    int exponent;
    (void)frexp(vec3_max_abs(e->w[f->v[0]]), &exponent);
    double unit = ldexp(1, -exponent);
    simplex x = {.count = 3};
    for (int i = 0; i < 3; i++)
        x.p[i] = (difference){vec3_scale(vec3_sub(e->w[f->v[i]], target), unit), e->a[f->v[i]], e->b[f->v[i]]};
    (void)simplex_reduce(&x);
    *distance = vec3_norm(simplex_compute_point(&x)) / unit;
    return evidence_make(&x);
}

// The witness of the depth: the surface's point nearest to the foot of the origin on the nearest face's plane. That
// face may be one of several triangles of a facet, or of a small body's facet on a large one, so all about as near are
// tried.
static evidence find_witness(const search *s, const expansion *e, const face *nearest) {
    vec3 foot = vec3_scale(nearest->n, nearest->low);
    double least;
    evidence best = face_evidence(e, nearest, foot, &least);
    for (uint32_t i = 0; i < e->faces && least > s->frame->claim; i++) {
        const face *f = &e->f[i];
        if (!f->alive || f->low > nearest->low + s->ask.tolerance) continue;
        double distance;
        evidence x = face_evidence(e, f, foot, &distance);
        if (distance < least) least = distance, best = x;
    }
    return best;
}

// The radius that the surface keeps from the origin, as surface_compute_depth finds it, from what is known of the faces.
// A face that is no sliver has its plane's distance to 503 u s, so that only slivers and those about as near as the
// nearest are measured again. 0 where a face may not be outward: then the whole surface has to be looked at.
static double measure_faces(const search *s, const expansion *e, uint16_t nearest) {
    double doubt = 1100 * 0x1p-53 * s->frame->size, depth = e->f[nearest].low + doubt;
    for (uint32_t i = 0; i < e->faces; i++) {
        const face *f = &e->f[i];
        if (!f->alive) continue;
        if (!f->outward) return 0;
        vec3 n;
        if (f->low < e->f[nearest].low + 2 * doubt)
            depth =
                fmin(depth, triangle_compute_clearance(e->w[f->v[0]], e->w[f->v[1]], e->w[f->v[2]], depth, &n));
    }
    return depth - s->frame->claim;
}

// The upper bound that the surface proves, with its witness.
static void take_cover(search *s, const expansion *e, uint16_t nearest, ovoid_cover *cover) {
    uint16_t triangles[EXPANSION_FACES][3];
    surface all = {e->w, (const uint16_t(*)[3])triangles, e->points, 0};
    double depth = measure_faces(s, e, nearest);
    if (cover || !(depth > 0)) all.triangle_count = expansion_pack(e, triangles);
    if (!(depth > 0)) depth = surface_compute_depth(&all, s->frame->claim);
    double upper = -depth - s->frame->radii;
    if (!(depth > 0) || !(upper < s->upper || upper - s->lower <= s->ask.tolerance)) return;
    s->upper = upper;
    s->stage = OVOID_STAGE_EPA;
    s->kind = OVOID_PROOF_COVER;
    s->witness = find_witness(s, e, &e->f[nearest]);
    if (!cover) return;
    cover->point_count = e->points;
    cover->triangle_count = all.triangle_count;
    memcpy(cover->a, e->a, e->points * sizeof *e->a);
    memcpy(cover->b, e->b, e->points * sizeof *e->b);
    memcpy(cover->triangles, triangles, all.triangle_count * sizeof *triangles);
}

// A tetrahedron that strictly contains the origin: point 0 and a face.
static int take_tetrahedron(search *s, const expansion *e) {
    for (uint32_t i = 0; i < e->faces; i++) {
        const face *f = &e->f[i];
        if (!f->alive || f->v[0] == 0 || f->v[1] == 0 || f->v[2] == 0) continue;
        evidence x = {.count = 4, .p = {{e->w[0], e->a[0], e->b[0]}}};
        for (int k = 0; k < 3; k++) x.p[k + 1] = (difference){e->w[f->v[k]], e->a[f->v[k]], e->b[f->v[k]]};
        if (!search_take_hull(s, &x)) continue;
        evidence_set_weights(&s->witness);
        return 1;
    }
    return 0;
}

// Evidence of an overlap from the surface: a tetrahedron, or where the origin is on a line of two corners, up to six.
static int take_hull(search *s, const expansion *e) {
    int taken = take_tetrahedron(s, e), kept[OVOID_PROOF_PAIRS];
    if (!taken && e->points <= HULL_POINTS_MAX) {
        evidence x = {.count = hull_find_few(e->w, (int)e->points, s->frame->claim, e->slack, kept)};
        for (int i = 0; i < x.count; i++) x.p[i] = (difference){e->w[kept[i]], e->a[kept[i]], e->b[kept[i]]};
        evidence_set_weights(&x);
        taken = x.count > 0 && search_take_hull(s, &x);
    }
    if (taken) s->stage = OVOID_STAGE_EPA;
    return taken;
}

// The bracket as it would be if the surface were proven now, with the nearest face's own gap: so that the normal is
// that of the witness points.
static int is_narrow(const search *s, double low, double high) {
    double claim = s->frame->claim;
    return low > claim && high - low + 2 * claim <= s->ask.tolerance;
}

// The nearest face's own normal as lower bound, where that costs no more than the tolerance: witness and normal agree.
static void agree(search *s, const expansion *e, uint16_t nearest) {
    vec3 n = vec3_neg(e->f[nearest].n);
    double lower = frame_find_support(s->frame, n).gap - s->frame->radii - s->frame->claim;
    if (s->upper - lower > fmax(s->ask.tolerance, s->upper - s->lower)) return;
    s->lower = lower;
    s->normal = n;
}

// Ends the run: proves what the surface shows.
static void finish(search *s, const expansion *e, uint16_t nearest, ovoid_cover *cover) {
    if (e->f[nearest].low > s->frame->claim && !search_is_done(s)) {
        if (s->ask.wants_depth)
            take_cover(s, e, nearest, cover);
        else
            (void)take_hull(s, e);
    }
    if (s->kind == OVOID_PROOF_COVER) agree(s, e, nearest);
    if (!search_is_done(s) && s->limit == OVOID_LIMIT_NONE) s->limit = OVOID_LIMIT_PRECISION;
}

// A face whose support is a corner already is a sliver with an uncertain plane: the triangle itself is farther from the
// origin than its plane. 0 if that is not so.
static int measure_sliver(const expansion *e, face *f) {
    vec3 n;
    double clearance = triangle_compute_clearance(e->w[f->v[0]], e->w[f->v[1]], e->w[f->v[2]], INFINITY, &n);
    if (!(clearance > f->low)) return 0;
    f->low = clearance;
    return 1;
}

// One step: the support of the nearest face. 0 when there is nothing to gain or a limit is met, -1 if the surface is
// spoilt.
static int grow(search *s, expansion *e, uint16_t nearest) {
    double lower = s->lower;
    frame_support x = search_probe(s, vec3_neg(e->f[nearest].n));
    if (s->lower > lower) s->stage = OVOID_STAGE_EPA;
    double high = vec3_dot(e->f[nearest].n, x.w);
    e->bound = -(s->lower + s->frame->radii);
    if (s->ask.wants_depth && is_narrow(s, e->f[nearest].low, high)) return 0;
    if (high - e->f[nearest].low <= e->slack) return 0;
    if (has_point(e, x.a, x.b)) return measure_sliver(e, &e->f[nearest]);
    if (e->points == EXPANSION_POINTS) {
        s->limit = OVOID_LIMIT_CAPACITY;
        return 0;
    }
    if (expansion_join(e, nearest, expansion_add_point(e, x.w, x.a, x.b))) return 1;
    s->limit = OVOID_LIMIT_PRECISION;
    return -1;
}

void epa_run(search *s, const simplex *from, ovoid_cover *cover) {
    expansion e;
    expansion_clear(&e, 16 * 0x1p-53 * s->frame->size);
    e.doubt = triangle_compute_doubt(s->frame->size, s->frame->claim);
    if (!start(s, &e, from)) {
        if (!search_is_done(s)) s->limit = OVOID_LIMIT_PRECISION;
        return;
    }
    expansion_make_tetrahedron(&e);
    uint16_t nearest = expansion_find_nearest(&e);
    uint32_t steps = 0;
    for (; steps < s->ask.iterations; steps++, s->iterations++) {
        int grown = grow(s, &e, nearest);
        if (grown < 0) return;
        if (!grown || search_is_done(s)) break;
        nearest = expansion_find_nearest(&e);
        if (!s->ask.wants_depth && e.f[nearest].low > 2 * s->frame->claim && take_hull(s, &e)) break;
    }
    if (steps == s->ask.iterations) s->limit = OVOID_LIMIT_ITERATIONS;
    finish(s, &e, nearest, cover);
}
