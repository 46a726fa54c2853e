// GJK of a true ellipsoid's core. A ball of the ellipsoid's least radius of curvature r, a^2 / c for the half axes a <=
// b
// <= c, rolls freely inside it, so that the ellipsoid is a core enlarged by that ball (W. Blaschke, Kreis und Kugel,
// 1916): the core reaches h(n) - r along n, and its point there is the ellipsoid's, moved r inward. Bodies that overlap
// by less than their cores' radii have cores that are apart, and GJK finds the nearest points of these as of capsules.
// There are no corners here whose number a proof could hold: each point is a place, and the nearest points are the
// centres of a proof by balls (pair/balls.h).
//
// The cores decide nothing: gaps are measured along normals that this finds, and balls about centres that this finds.
#include "exact/cores.h"

#include "pair/balls.h"
#include "pair/stages.h"
#include "simd/corner.h"

enum { CORES_STEPS = 64 };

// A part of the least radius of curvature, so that the ball's multiplier (balls.c) is below the least square.
#define CORE_PART (1 - 0x1p-6)

// What the cores' points are: in the bodies' own frames, of polyhedra with their vertices.
typedef struct core_points {
    vec3 a, b;
    uint32_t vertex_a, vertex_b;
} core_points;

typedef struct cores {
    search *s;
    double radius_a, radius_b;
    simplex points; ///< of differences of the cores; their numbers are places in `all`
    core_points all[CORES_STEPS + 1];
    uint32_t count;
    int is_weighted; ///< the weights are those of the points
} cores;

static double find_radius(const ovoid_shape *s) {
    if (!shape_is_ellipsoid(s)) return 0;
    vec3 a = s->round.half_axes;
    double least = min2(a.x, min2(a.y, a.z));
    return CORE_PART * (least * (least / vec3_max_abs(a)));
}

// A body's support along the unit n, and its core's point.
static double find_end(const ovoid_shape *s, double radius, vec3 n, vec3 *point, uint32_t *vertex) {
    *vertex = 0;
    if (shape_is_ellipsoid(s)) {
        vec3 a = s->round.half_axes;
        ellipsoid_end end = ellipsoid_find_support(a, n);
        vec3 on = {a.x * (end.m.x / end.value), a.y * (end.m.y / end.value), a.z * (end.m.z / end.value)};
        *point = vec3_sub(vec3_add_scaled(on, n, -radius), s->origin);
        return end.value - vec3_dot(n, s->origin);
    }
    true_end end = round_find_end(s, n);
    *point = end.point;
    if (!shape_is_round(s)) *vertex = end.vertex;
    return end.value;
}

// Measures the gap along the unit n and returns it, with the cores' points as a new entry.
static double probe(cores *c, vec3 n) {
    const pair_frame *f = c->s->frame;
    core_points *to = &c->all[c->count++];
    double a = find_end(f->a, c->radius_a, n, &to->a, &to->vertex_a);
    vec3 in_b = vec3_neg(mat3_mul_transposed_vec3(f->rotation, n));
    double b = find_end(f->b, c->radius_b, in_b, &to->b, &to->vertex_b);
    double gap = (vec3_dot(n, f->translation) - b) - a;
    search_take_gap(c->s, n, gap);
    return gap;
}

static void push(cores *c) {
    uint32_t i = c->count - 1;
    vec3 w = vec3_sub(frame_b(c->s->frame, c->all[i].b), c->all[i].a);
    c->points.p[c->points.count++] = (difference){w, i, i};
}

// The step to the newest point by the kernel of gjk.c. 0 where it leaves that to the robust one.
static int step(cores *c, vec3 *n, double *distance) {
    simplex *points = &c->points;
    int last = points->count - 1, kept = 0;
    if (last < 1) return 0;
    corner_lanes old;
    for (int i = 0; i < 4; i++) {
        vec3 w = points->p[i < last ? i : 0].w;
        old.x[i] = w.x, old.y[i] = w.y, old.z[i] = w.z;
    }
    difference newest = points->p[last];
    corner_step next = simd_step_from_corner(&old, (1u << last) - 1, &newest.w);
    if (next.is_inside || next.is_sliver || !(next.square > 1e-200 && next.square < 1e200)) return 0;
    for (int i = 0; i < last; i++)
        if (next.kept >> i & 1) points->p[kept++] = points->p[i];
    points->p[kept++] = newest;
    points->count = kept;
    *n = vec3_scale((vec3){next.x, next.y, next.z}, 1 / sqrt(next.square));
    *distance = vec3_dot(*n, newest.w);
    return 1;
}

// The unit direction of the simplex's nearest point and its distance; the simplex is reduced to the face that holds it.
static vec3 reduce(cores *c, double *distance) {
    vec3 n;
    c->is_weighted = !step(c, &n, distance);
    if (!c->is_weighted) return n;
    n = simplex_reduce(&c->points);
    *distance = vec3_norm(simplex_compute_point(&c->points));
    return n;
}

static vec3 find_first_normal(const search *s) {
    if (s->lower > -INFINITY) return s->normal;
    const pair_frame *f = s->frame;
    const ovoid_ellipsoid *a = &f->a->outer, *b = &f->b->outer;
    double gap;
    return ellipsoids_find_direction(a->q, sym3_rotate(b->q, f->rotation), vec3_sub(frame_b(f, b->center), a->center),
                                     &gap);
}

// The balls about the cores' nearest points as upper bound.
static void take_balls(cores *c) {
    search *s = c->s;
    const pair_frame *f = s->frame;
    if (!c->is_weighted) simplex_compute_weights(&c->points);
    ovoid_proof p = {.kind = OVOID_PROOF_BALLS, .count = (uint32_t)c->points.count};
    evidence found = {.count = c->points.count};
    double sum = 0;
    for (int i = 0; i < c->points.count; i++) sum += c->points.weight[i];
    for (int i = 0; i < c->points.count; i++) {
        const core_points *of = &c->all[c->points.p[i].a];
        double weight = c->points.weight[i] / sum;
        p.inner_a = vec3_add_scaled(p.inner_a, of->a, weight);
        p.inner_b = vec3_add_scaled(p.inner_b, of->b, weight);
        found.p[i].a = p.a[i] = of->vertex_a;
        found.p[i].b = p.b[i] = of->vertex_b;
        found.weight[i] = p.weight_a[i] = p.weight_b[i] = weight;
    }
    if (shape_is_round(f->a) && shape_is_round(f->b)) p.count = 0, found.count = 0;
    double upper = balls_compute_upper(f, &p, f->claim + BALLS_CLAIM * f->size);
    if (!(upper < s->upper)) return;
    s->upper = upper;
    s->kind = OVOID_PROOF_BALLS;
    s->witness = found;
    s->inner_a = p.inner_a;
    s->inner_b = p.inner_b;
    s->stage = OVOID_STAGE_GJK;
}

// 1 if bounds would answer the query, that from above by the cores' distance.
static int seems_done(const cores *c, double distance) {
    const search *s = c->s;
    const query_goal *goal = &s->goal;
    double error = s->frame->claim + BALLS_CLAIM * s->frame->size;
    double upper = distance - (c->radius_a + c->radius_b) - balls_compute_radii(s->frame) + error;
    if (s->lower > goal->far || (upper < 0 && !goal->wants_depth)) return 1;
    return (upper <= goal->near && s->lower > 0) || upper - s->lower <= goal->tolerance;
}

// 1 if the balls answer the query; the lower bound is then taken along the line of their centres, where that is enough,
// so that points, normal and distance agree.
static int is_answered(cores *c, vec3 n, double gap) {
    search *s = c->s;
    take_balls(c);
    if (!search_is_done(s)) return 0;
    double lower = gap - s->frame->lower_radii - s->frame->claim;
    if (s->goal.wants_bracket && s->upper - lower <= s->goal.tolerance) s->lower = lower, s->normal = n;
    return 1;
}

int cores_run(search *s) {
    // The places, most of the struct, are not set: nothing reads past their count.
    cores c;
    c.s = s;
    c.radius_a = find_radius(s->frame->a);
    c.radius_b = find_radius(s->frame->b);
    c.points.count = 0;
    c.count = 0;
    double least = INFINITY, best = -INFINITY;
    (void)probe(&c, find_first_normal(s));
    push(&c);
    while (c.count <= CORES_STEPS && s->iterations < s->goal.iterations) {
        double distance;
        vec3 n = reduce(&c, &distance);
        // The cores overlap: of a yes or no the balls about a common point tell.
        if (!(vec3_norm_squared(n) > 0.5)) break;
        double gap = probe(&c, n);
        s->iterations++;
        if (seems_done(&c, distance) && is_answered(&c, n, gap)) return 1;
        if (!(distance < least || gap > best)) break;
        least = min2(least, distance);
        best = max2(best, gap);
        push(&c);
    }
    (void)simplex_reduce(&c.points);
    c.is_weighted = 1;
    take_balls(&c);
    return search_is_done(s);
}
