// The expanding polytope of G. van den Bergen, Proximity queries and penetration depth computation on 3D game objects,
// 2001, with these changes:
// - The polytope is a convex hull that grows, wherever the origin is: a new point replaces the faces visible from it.
//   So exact touching, where the origin is on the boundary or just outside, needs no case of its own: the face of least
//   offset then gives a normal along which the gap is 0 to rounding.
// - Nothing is taken on trust: the lower bound is the gap along a face's normal, by the supports; the upper bound is
//   the radius that the whole surface keeps from the origin, checked at the end as a proof (cover.c).
// - A depth's first points are joined in lanes (epa_lanes.c); this goes on from there where it must.
// Working memory is on the stack, about 80 KB; beyond 512 points the surface goes on in the cover's, if there is any.
// Cost: for each new point one support and a scan of the faces that may be the nearest; in the cover's memory no scan.
#include "exact/epa.h"

#include "base/compiler.h"
#include "exact/cover_memory.h"
#include "exact/epa_lanes.h"
#include "exact/expand.h"
#include "exact/hull_reduce.h"
#include "exact/probe.h"
#include "pair/cover.h"

#include <stddef.h>
#include <string.h>

typedef expansion_face face;

// A surface of few points leaves most of the faces' memory unused: the working memory of an overlap's proof is there,
// and the surface that grows in lanes.
typedef union growth_room {
    expansion_room all;
    struct {
        unsigned char used[offsetof(expansion_room, f) + 3 * HULL_POINTS_MAX * sizeof(face)];
        union {
            hull_memory reduced;
            epa8 lanes;
        };
    } few;
} growth_room;

typedef struct growth {
    growth_room room;
    search *s;
    double gap; ///< along the nearest face's normal, NAN until measured
    ovoid_cover *cover;
    expansion e;
    prober p;
    int is_grown;     ///< as near as is wanted
    int is_moved;     ///< the surface is in the cover's memory
    uint16_t nearest; ///< face
} growth;

static int has_point(const expansion *e, const frame_support *support) {
    return expansion_has_point(e, support->a, support->b);
}

static void push(expansion *e, frame_support w) { (void)expansion_add_point(e, w.w, w.a, w.b); }

// The farther support of +n and -n from the plane n.x = offset; its distance in *far.
static frame_support probe_both(const prober *p, vec3 n, double offset, double *far) {
    frame_support up = probe_find(p, n), down = probe_find(p, vec3_neg(n));
    double high = vec3_dot(n, up.w) - offset, low = offset - vec3_dot(n, down.w);
    *far = fmax(high, low);
    return high >= low ? up : down;
}

// Four differences that span space; 0 if the difference body is flat, to rounding.
static int find_tetrahedron(const prober *p, expansion *e) {
    static const vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    e->points = 0;
    // The widest of three axes.
    double widest = -1;
    frame_support ends[2] = {{0}, {0}};
    for (int i = 0; i < 3; i++) {
        frame_support up = probe_find(p, axes[i]), down = probe_find(p, vec3_neg(axes[i]));
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
    for (int i = 0; i < 2; i++) t[i] = probe_both(p, side[i], vec3_dot(side[i], e->w[0]), &far[i]);
    int wide = far[0] >= far[1] ? 0 : 1;
    if (!(far[wide] > e->slack)) return 0;
    push(e, t[wide]);
    // The farthest from that plane.
    vec3 e2 = vec3_sub(e->w[2], e->w[0]);
    vec3 n = simplex_compute_normal(e1, e2);
    frame_support top = probe_both(p, n, vec3_dot(n, e->w[0]), &far[0]);
    if (!(far[0] > e->slack)) return 0;
    push(e, top);
    return 1;
}

// 1 if the first four points have a volume well above rounding.
static int is_solid(const expansion *e) {
    vec3 e1 = vec3_sub(e->w[1], e->w[0]), e2 = vec3_sub(e->w[2], e->w[0]), e3 = vec3_sub(e->w[3], e->w[0]);
    double volume = vec3_dot(vec3_cross(e1, e2), e3);
    double edges = vec3_norm_squared(e1) * vec3_norm_squared(e2) * vec3_norm_squared(e3);
    return volume * volume > 1e-12 * edges;
}

// Completes the differences to a tetrahedron by supports toward the origin, as GJK would. 0 where that gives no solid
// one.
static int complete(const prober *p, expansion *e) {
    while (e->points < 4) {
        vec3 w = e->w[0], e1 = vec3_sub(e->w[1], w), n;
        if (e->points == 1) {
            n = w;
        } else if (e->points == 2) {
            double l = vec3_norm_squared(e1);
            n = l > 0 ? vec3_add_scaled(w, e1, -vec3_dot(w, e1) / l) : w;
        } else {
            n = vec3_cross(e1, vec3_sub(e->w[2], w));
            if (vec3_dot(n, w) < 0) n = vec3_neg(n);
        }
        frame_support support = probe_find(p, vec3_neg(vec3_unit(n)));
        if (has_point(e, &support)) return 0;
        push(e, support);
    }
    return is_solid(e);
}

// The first difference: the support along the line of centres.
static void probe_center(const prober *p, simplex *points) {
    const pair_frame *f = p->s->frame;
    vec3 d = vec3_sub(f->a->center, frame_b(f, f->b->center));
    frame_support w = probe_find(p, vec3_norm_squared(d) > 0 ? vec3_unit(d) : (vec3){1, 0, 0});
    points->p[0] = (difference){w.w, w.a, w.b};
    points->weight[0] = 1;
    points->count = 1;
}

static int is_apart(const search *s) { return s->lower + s->frame->lower_radii > 0; }

// The differences at hand made a tetrahedron, else one found afresh. 0 where there is none, or none is needed.
COMPILER_NOINLINE static int start(const prober *p, expansion *e, simplex *points, int is_first) {
    for (int i = 0; i < points->count; i++)
        (void)expansion_add_point(e, points->p[i].w, points->p[i].a, points->p[i].b);
    return (complete(p, e) || find_tetrahedron(p, e)) && !(is_first && is_apart(p->s));
}

// The corners of a face as evidence, weighted to the point nearest to the target; *distance: how near.
static evidence face_evidence(const expansion *e, const face *f, vec3 target, double *distance) {
    // The unit is the face's size, so that no product of four lengths underflows.
    double unit = ldexp(1, -find_unit_exponent(vec3_max_abs(e->w[f->v[0]])));
    simplex points = {.count = 3};
    for (int i = 0; i < 3; i++)
        points.p[i] = (difference){vec3_scale(vec3_sub(e->w[f->v[i]], target), unit), e->a[f->v[i]], e->b[f->v[i]]};
    (void)simplex_reduce(&points);
    *distance = vec3_norm(simplex_compute_point(&points)) / unit;
    return evidence_make(&points);
}

// The foot of the origin on the nearest face's plane as evidence, if it lies in the face f.
static int find_foot(const growth *g, const face *f, evidence *found) {
    const expansion *e = &g->e;
    const face *nearest = &e->f[g->nearest];
    difference corner[3];
    for (int i = 0; i < 3; i++) corner[i] = (difference){e->w[f->v[i]], e->a[f->v[i]], e->b[f->v[i]]};
    return epa_find_foot(g->s, corner, nearest->n, nearest->low, found);
}

// The surface's point nearest to the target, of the face `first` and those whose planes are no farther than `most`.
static evidence find_near(const growth *g, const face *first, vec3 target, double most) {
    const expansion *e = &g->e;
    double least;
    evidence best = face_evidence(e, first, target, &least);
    for (uint32_t i = 0; i < e->faces && least > g->s->frame->claim; i++) {
        const face *f = &e->f[i];
        if (!f->alive || f->low > most) continue;
        double distance;
        evidence found = face_evidence(e, f, target, &distance);
        if (distance < least) least = distance, best = found;
    }
    return best;
}

// The witness of the depth: the surface's point nearest to the foot of the origin on the nearest face's plane. That
// face may be one of several triangles of a facet, or of a small body's facet on a large one, so all about as near are
// tried.
static evidence find_witness(const growth *g) {
    const expansion *e = &g->e;
    const face *nearest = &e->f[g->nearest];
    double same = nearest->low + 2 * epa_get_face_doubt(g->s);
    evidence foot;
    if (find_foot(g, nearest, &foot)) return foot;
    for (uint32_t i = 0; i < e->faces; i++)
        if (e->f[i].alive && e->f[i].low <= same && find_foot(g, &e->f[i], &foot)) return foot;
    return find_near(g, nearest, vec3_scale(nearest->n, nearest->low),
                     nearest->low + (g->s->goal.tolerance - g->s->goal.allowance));
}

// The surface's point on the ray from the origin along the unit direction n. It is no nearer than the radius that the
// surface keeps, and no farther than the supports along n: of a bracket [lower, upper] whose lower bound is the gap
// along -n, it realises a depth.
static evidence find_exit(const growth *g, vec3 n, double *distance) {
    const expansion *e = &g->e;
    const face *exit = &e->f[g->nearest];
    *distance = INFINITY;
    for (uint32_t i = 0; i < e->faces; i++) {
        const face *f = &e->f[i];
        double rate = vec3_dot(f->n, n);
        if (!f->alive || !(rate > 0) || !(f->low < *distance * rate)) continue;
        *distance = f->low / rate;
        exit = f;
    }
    return find_near(g, exit, vec3_scale(n, *distance), INFINITY);
}

static double measure_face(const expansion *e, const face *f) {
    double a = vec3_dot(f->n, e->w[f->v[0]]), b = vec3_dot(f->n, e->w[f->v[1]]), c = vec3_dot(f->n, e->w[f->v[2]]);
    return min2(a, min2(b, c));
}

// The radius that the surface keeps from the origin, as triangle_compute_clearance finds it: the normal of a face that
// is outward (and so no sliver) was computed in the same operations, and n.w differs by less than 1100 u s between its
// corners, which matters for the nearest only. Slivers, of which curved bodies have many, are measured one by one. 0
// where a face may not be outward; the surface must then be measured (surface_compute_depth).
static double measure_faces(const search *s, const expansion *e) {
    double doubt = epa_get_face_doubt(s), least = INFINITY, slivers = INFINITY;
    for (uint32_t i = 0; i < e->faces; i++) {
        const face *f = &e->f[i];
        if (f->alive && f->outward) least = min2(least, f->low);
    }
    for (uint32_t i = 0; i < e->faces; i++) {
        const face *f = &e->f[i];
        if (!f->alive || f->outward) continue;
        vec3 a = e->w[f->v[0]], b = e->w[f->v[1]], c = e->w[f->v[2]], n;
        if (!s->frame->is_true || !triangle_is_outward(a, b, c, e->doubt)) return 0;
        slivers = min2(slivers, triangle_compute_clearance(a, b, c, least, &n));
    }
    double depth = min2(least + doubt, slivers);
    for (uint32_t i = 0; i < e->faces; i++) {
        const face *f = &e->f[i];
        if (f->alive && f->low <= least + 2 * doubt) depth = min2(depth, measure_face(e, f));
    }
    return depth - s->frame->claim;
}

// The upper bound that the surface proves, with its witness.
static void take_cover(growth *g) {
    search *s = g->s;
    expansion *e = &g->e;
    ovoid_cover *cover = g->cover;
    surface all = surface_make(e->w, e->points, (const uint16_t(*)[3])e->triangles, 0);
    double depth = measure_faces(s, e);
    if (cover || !(depth > 0)) all.triangle_count = expansion_pack(e);
    if (!(depth > 0)) depth = surface_compute_depth(&all, s->frame->claim);
    double upper = -depth - s->frame->upper_radii;
    if (!(depth > 0) || !(upper < s->upper || upper - s->lower <= s->goal.tolerance)) return;
    s->upper = upper;
    s->stage = OVOID_STAGE_EPA;
    s->kind = OVOID_PROOF_COVER;
    s->witness = find_witness(g);
    if (!search_wants_cover(s, cover, s->upper)) return;
    if (g->is_moved) {
        cover_show_surface(cover, e, all.triangle_count);
        return;
    }
    cover_arrays *to = cover_get_arrays(cover);
    memcpy(to->a, e->a, e->points * sizeof *e->a);
    memcpy(to->b, e->b, e->points * sizeof *e->b);
    memcpy(to->triangles, e->triangles, all.triangle_count * sizeof *e->triangles);
    cover_show_arrays(cover, e->points, all.triangle_count);
}

// A tetrahedron that strictly contains the origin: point 0 and a face.
static int take_tetrahedron(search *s, const expansion *e) {
    int taken = 0;
    for (uint32_t i = 0; i < e->faces; i++) {
        const face *f = &e->f[i];
        if (!f->alive || f->v[0] == 0 || f->v[1] == 0 || f->v[2] == 0) continue;
        evidence found = {.count = 4, .p = {{e->w[0], e->a[0], e->b[0]}}};
        for (int k = 0; k < 3; k++) found.p[k + 1] = (difference){e->w[f->v[k]], e->a[f->v[k]], e->b[f->v[k]]};
        if (!search_take_hull(s, &found)) continue;
        taken = 1;
        if (search_is_done(s)) return 1;
    }
    return taken;
}

// Evidence of an overlap from the surface: a tetrahedron, or where the origin is on a line of two corners, up to six.
static int take_hull(growth *g) {
    search *s = g->s;
    const expansion *e = &g->e;
    int taken = take_tetrahedron(s, e), kept[OVOID_PROOF_PAIRS];
    if (!(taken && search_is_done(s)) && e->points <= HULL_POINTS_MAX && e->faces <= 3 * HULL_POINTS_MAX) {
        const hull_points points = {e->w, (int)e->points, s->frame->claim, e->slack};
        evidence found = {.count = hull_find_reduced(&g->room.few.reduced, &points, kept)};
        for (int i = 0; i < found.count; i++) found.p[i] = (difference){e->w[kept[i]], e->a[kept[i]], e->b[kept[i]]};
        if (found.count > 0) taken |= search_take_hull(s, &found);
    }
    if (taken) s->stage = OVOID_STAGE_EPA;
    return taken;
}

// The bracket as it would be if the surface were proven now, with the nearest face's own gap: so that the normal is
// that of the witness points.
static int is_narrow(const search *s, double low, double high) {
    double claim = s->frame->claim;
    return low > claim && high - low + 2 * claim <= s->goal.tolerance - s->goal.allowance;
}

// Makes witness and normal agree: takes the nearest face's own normal for the lower bound, where that costs no more
// than the tolerance, else the witness along the normal that there is, as where a limit ended the search.
static void agree(const growth *g) {
    search *s = g->s;
    vec3 n = vec3_neg(g->e.f[g->nearest].n);
    double gap = isnan(g->gap) ? frame_find_support(s->frame, n).gap : g->gap;
    double lower = gap - s->frame->lower_radii - s->frame->claim;
    if (s->upper - lower > fmax(s->goal.tolerance, s->upper - s->lower)) {
        // The surface of a second run may keep less from the origin than that of the first, which was taken.
        double distance;
        evidence exit = find_exit(g, vec3_neg(s->normal), &distance);
        if (-distance - s->frame->upper_radii <= s->upper) s->witness = exit;
        return;
    }
    s->lower = lower;
    s->normal = n;
}

// Ends the run: proves what the surface shows.
COMPILER_NOINLINE static void finish(growth *g) {
    search *s = g->s;
    if (g->e.f[g->nearest].low > s->frame->claim && !search_is_done(s)) {
        if (s->goal.wants_depth)
            take_cover(g);
        else
            (void)take_hull(g);
    }
    if (s->kind == OVOID_PROOF_COVER) agree(g);
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

// Goes on in the cover's memory, if that has more room.
static int move(growth *g) {
    uint32_t points;
    if (!g->cover || g->is_moved) return 0;
    void *room = cover_find_room(g->cover, &points);
    if (points <= EXPANSION_POINTS) return 0;
    expansion_move(&g->e, room, points);
    return g->is_moved = 1;
}

static int join(growth *g, const frame_support *support) {
    expansion *e = &g->e;
    if (expansion_join(e, g->nearest, expansion_add_point(e, support->w, support->a, support->b))) return 1;
    e->points--;
    return 0;
}

// One step: the support of the nearest face. 0 when there is nothing to gain or a limit is met, -1 if rounding keeps it
// from being joined.
static int grow(growth *g) {
    search *s = g->s;
    expansion *e = &g->e;
    face *f = &e->f[g->nearest];
    double lower = s->lower;
    frame_support support = probe_find(&g->p, f->n);
    double high = vec3_dot(f->n, support.w);
    g->gap = support.gap;
    if (s->lower > lower) s->stage = OVOID_STAGE_EPA;
    e->bound = -(s->lower + s->frame->lower_radii);
    if (s->goal.wants_depth && is_narrow(s, f->low, high)) return 0;
    if (high - f->low <= e->slack) return 0;
    if (high - f->low < 1e-3 * s->frame->size && has_point(e, &support)) return measure_sliver(e, f);
    if (e->points == e->most_points && !move(g)) {
        s->limit = OVOID_LIMIT_CAPACITY;
        return 0;
    }
    if (join(g, &support)) return 1;
    // The last points may want more faces at once than there is room for.
    return e->points > EXPANSION_POINTS / 2 && move(g) && join(g, &support) ? 1 : -1;
}

static void find_next(growth *g) {
    g->nearest = expansion_find_nearest(&g->e);
    g->gap = NAN;
}

// Grows in lanes. 1 if that answered the query; else the surface, if there is one, is to be continued.
static int grow_in_lanes(growth *g, const simplex *points) {
    epa8 *lanes = &g->room.few.lanes;
    epa8_end end = epa_lanes_grow(lanes, &g->p, points);
    if (end == EPA8_FLAT) return 0;
    if (end == EPA8_NARROW && epa_lanes_take_depth(g->s, lanes, g->cover)) return 1;
    g->nearest = expansion_take(&g->e, lanes);
    g->gap = end == EPA8_NARROW ? lanes->gap : NAN;
    g->is_grown = end == EPA8_NARROW;
    return 0;
}

// Leaves the nearest face as the simplex for the next method.
static void leave(growth *g, simplex *points) {
    const face *f = &g->e.f[g->nearest];
    points->count = 3;
    for (int i = 0; i < 3; i++) points->p[i] = (difference){g->e.w[f->v[i]], g->e.a[f->v[i]], g->e.b[f->v[i]]};
}

// 1 where a proven overlap of the shapes ends the run: where it is one of the bodies too, that is, or no allowance asks
// for more.
static int is_shown(const search *s) { return !(s->goal.allowance > 0) || search_is_done(s); }

// The first surface: in lanes, or a tetrahedron. 0 where there is none, or the query is answered.
static int begin(growth *g, simplex *points, int is_first) {
    search *s = g->s;
    if (points->count == 0) probe_center(&g->p, points);
    if (is_first && is_apart(s)) return 0;
    if (is_first && s->goal.wants_depth && epa_lanes_serve(s)) {
        if (grow_in_lanes(g, points)) return 0;
        if (g->e.points) {
            if (!g->is_grown) find_next(g);
            return 1;
        }
    }
    if (!start(&g->p, &g->e, points, is_first)) return 0;
    expansion_make_tetrahedron(&g->e);
    find_next(g);
    return 1;
}

int epa_run(search *s, simplex *points, int is_first, ovoid_cover *cover) {
    growth g;
    g.s = s;
    g.cover = cover;
    g.is_grown = g.is_moved = 0;
    expansion_room_give(&g.room.all, &g.e);
    prober_make(&g.p, s, 1);
    expansion_clear(&g.e, epa_get_slack(s));
    g.e.doubt = epa_get_doubt(s);
    uint32_t before = s->iterations;
    if (!begin(&g, points, is_first)) return search_is_done(s);
    for (; !g.is_grown; s->iterations++) {
        if (s->iterations - before >= s->goal.iterations) {
            s->limit = OVOID_LIMIT_ITERATIONS;
            break;
        }
        if (is_first && is_apart(s)) break;
        int grown = grow(&g);
        if (grown < 0 && !s->goal.wants_depth) return 0;
        if (grown <= 0 || search_is_done(s)) break;
        find_next(&g);
        if (!s->goal.wants_depth && g.e.f[g.nearest].low > 2 * s->frame->claim && take_hull(&g) && is_shown(s)) break;
    }
    finish(&g);
    if (search_is_done(s) || s->limit != OVOID_LIMIT_NONE) return 1;
    leave(&g, points);
    return 0;
}
