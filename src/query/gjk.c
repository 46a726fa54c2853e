// E. G. Gilbert, D. W. Johnson, S. S. Keerthi, A fast procedure for computing the distance between complex objects in
// three-dimensional space, 1988. The simplex's nearest point bounds the distance from above, the gap along its
// direction from below; each step adds the vertex pair that the gap was measured at. On polytopes the steps are finite,
// and the stop is by the bracket, never by a tolerance on progress.
//
// A fast step costs two supports and one kernel without branches (simd/corner.h). The loop keeps what decides: a
// direction of any length and how far along it the nearest point lies. That point's weights are computed when the
// question seems answered, and the answer is taken from them alone. A run that would end without an answer is done
// again from its simplex by robust steps (simplex_reduce), which know slivers and flat simplices.
#include "query/gjk.h"

#include "query/probe.h"
#include "simd/corner.h"

// The simplex of the fast run: corners in lanes, those of `valid` are meant.
typedef struct walk {
    corner_lanes at;
    uint32_t a[4], b[4];
    unsigned valid;
} walk;

// Where the nearest point lies: along n, of any length, at height / |n|.
typedef struct heading {
    vec3 n;
    double height, square;
} heading;

static int is_known(const simplex *x, const frame_support *p) {
    for (int i = 0; i < x->count; i++)
        if (x->p[i].a == p->a && x->p[i].b == p->b) return 1;
    return 0;
}

// Takes the simplex's nearest point as upper bound.
static void take_upper(search *s, const simplex *x) {
    double upper = s->upper;
    search_take_points(s, x);
    if (s->upper < upper) s->stage = OVOID_STAGE_GJK;
}

static void take_lower(search *s, double lower, vec3 n) {
    s->lower = lower;
    s->normal = n;
}

// The points of a tetrahedron's faces: where it is flat its volumes are noise, and so are the weights they give.
static void take_faces(search *s, const simplex *x) {
    for (int out = 0; out < 4; out++) {
        simplex face = {.count = 3};
        for (int i = 0, k = 0; i < 4; i++)
            if (i != out) face.p[k++] = x->p[i];
        (void)simplex_reduce(&face);
        search_take_points(s, &face);
    }
}

// The origin lies in the simplex, as far as doubles can tell.
static gjk_end end_inside(search *s, const simplex *x) {
    s->stage = OVOID_STAGE_GJK;
    evidence inside = evidence_make(x);
    if (x->count < 4 || !search_take_hull(s, &inside)) {
        search_take_points(s, x);
        if (x->count == 4) take_faces(s, x);
    }
    return search_is_done(s) ? GJK_ANSWERED : GJK_CONTACT;
}

// 1 if the bounds would answer the question, with an upper bound from the distance along the direction.
static int seems_done(const search *s, double distance) {
    const question *ask = &s->ask;
    double upper = distance - s->frame->radii + s->frame->claim;
    if (s->lower > ask->far || (upper < 0 && !ask->wants_depth)) return 1;
    return (upper <= ask->near && s->lower > 0) || (ask->wants_bracket && upper - s->lower <= ask->tolerance);
}

// Answered with the direction at hand: a bracket that is asked for is taken along the witness points' own direction,
// so that points, normal and distance agree.
static int is_answered(search *s, const simplex *x, double lower, vec3 n) {
    take_upper(s, x);
    if (!search_is_done(s)) return 0;
    if (s->lower > s->ask.far || !s->ask.wants_bracket || s->upper <= s->ask.near) return 1;
    if (s->upper - lower > s->ask.tolerance) return 0;
    take_lower(s, lower, n);
    return 1;
}

// The robust step, and the first one from several points. 0 if the origin lies in the simplex.
static int reduce(simplex *x, heading *to) {
    vec3 n = simplex_reduce(x);
    *to = (heading){n, vec3_norm(simplex_compute_point(x)), vec3_norm_squared(n)};
    return to->square > 0;
}

// Squares neither overflow nor lose digits.
static int is_in_range(double square) { return square > 1e-200 && square < 1e200; }

// The first direction. 0 if the origin lies in the simplex.
static int start(simplex *x, heading *to) {
    vec3 w = x->p[0].w;
    double square = vec3_norm_squared(w);
    if (x->count > 1 || !is_in_range(square)) return reduce(x, to);
    x->weight[0] = 1;
    *to = (heading){w, square, square};
    return 1;
}

static vec3 walk_get(const walk *k, int i) { return (vec3){k->at.x[i], k->at.y[i], k->at.z[i]}; }

static void walk_set(walk *k, int i, const difference *p) {
    k->at.x[i] = p->w.x;
    k->at.y[i] = p->w.y;
    k->at.z[i] = p->w.z;
    k->a[i] = p->a;
    k->b[i] = p->b;
}

static void walk_make(walk *k, const simplex *x) {
    for (int i = 0; i < 4; i++) walk_set(k, i, &x->p[i < x->count ? i : 0]);
    k->valid = (1u << x->count) - 1;
}

// The corners of the walk as a simplex.
static void walk_end(const walk *k, simplex *x) {
    x->count = 0;
    for (int i = 0; i < 4; i++)
        if (k->valid >> i & 1) x->p[x->count++] = (difference){walk_get(k, i), k->a[i], k->b[i]};
}

static int walk_is_known(const walk *k, const frame_support *p) {
    int known = 0;
    for (int i = 0; i < 3; i++) known |= (k->a[i] == p->a) & (k->b[i] == p->b) & (int)(k->valid >> i);
    return known & 1;
}

typedef enum walk_state { WALK_ON, WALK_INSIDE, WALK_STALLED } walk_state;

// The normal of a face that is a sliver, cleaned of what rounding left along its edges.
static heading clean(const walk *k, unsigned kept, vec3 a) {
    int i = __builtin_ctz(kept), j = 31 - __builtin_clz(kept);
    vec3 n = simplex_compute_normal(vec3_sub(walk_get(k, i), a), vec3_sub(walk_get(k, j), a));
    double height = vec3_dot(n, a);
    return (heading){height < 0 ? vec3_neg(n) : n, fabs(height), vec3_norm_squared(n)};
}

// The fast step to the new corner. Where it is no step on, all four corners are kept.
static walk_state walk_step(walk *k, const frame_support *p, double distance, heading *to) {
    corner_step next = simd_step_from_corner(&k->at, k->valid, p->w.x, p->w.y, p->w.z);
    vec3 n = {next.x, next.y, next.z};
    *to = next.is_sliver ? clean(k, next.kept, p->w) : (heading){n, vec3_dot(n, p->w), vec3_norm_squared(n)};
    int gains = to->height * to->height < distance * distance * to->square && is_in_range(to->square);
    walk_state state = next.is_inside ? WALK_INSIDE : gains ? WALK_ON : WALK_STALLED;
    unsigned kept = state == WALK_ON ? next.kept : k->valid;
    int place = __builtin_ctz(~kept);
    walk_set(k, place, &(difference){p->w, p->a, p->b});
    k->valid = kept | 1u << place;
    return state;
}

// Takes the gap along the heading as lower bound if it is the best; *n: the unit vector.
static double take_gap(search *s, const heading *to, double scale, double gap, vec3 *n) {
    double lower = gap * scale - s->frame->radii - s->frame->claim;
    *n = vec3_scale(to->n, scale);
    if (lower > s->lower) {
        take_lower(s, lower, *n);
        s->stage = OVOID_STAGE_GJK;
    }
    return lower;
}

// The second and third corner at once. From one corner w, met along n, GJK would look along w itself, which near
// contact is all but across n: it meets a corner far away on the other side. The corners around the nearest point are
// met along n tilted by the angle that separates neighbours of a round body with as many corners; two of them, to the
// sides of the way that w is off, make a triangle with w that the origin often projects into.
static walk_state fan(search *s, const prober *by, walk *k, heading *to) {
    const pair_frame *f = s->frame;
    vec3 n = s->normal, w = to->n;
    double h = vec3_dot(w, n), tilt = 1.5 / sqrt((double)f->a->vertex_count + (double)f->b->vertex_count);
    vec3 off = vec3_add_scaled(w, n, -h);
    double length = vec3_norm(off);
    // Far apart, or where w itself is tilted less, it is the better direction.
    if (!(length > tilt * fmax(h, 0)) || 4 * h > f->a->reach + f->b->reach || s->ask.iterations < s->iterations + 3)
        return WALK_ON;
    vec3 u = vec3_add_scaled(n, off, tilt / length), v = vec3_scale(vec3_cross(n, off), tilt / length), unit;
    heading side[2] = {{vec3_add(u, v), 0, 0}, {vec3_sub(u, v), 0, 0}};
    frame_support p[2] = {probe_measure(by, side[0].n), probe_measure(by, side[1].n)};
    walk_state state = WALK_ON;
    for (int i = 0; i < 2; i++) {
        side[i].square = vec3_norm_squared(side[i].n);
        s->iterations++;
        (void)take_gap(s, &side[i], 1 / sqrt(side[i].square), p[i].gap, &unit);
        // Beyond the nearest point so far? Else it is no corner of use.
        if (state == WALK_ON && vec3_dot(to->n, p[i].w) < to->height)
            state = walk_step(k, &p[i], to->height / sqrt(to->square), to);
    }
    return state;
}

static gjk_end run_fast(search *s, const prober *by, simplex *x) {
    heading to;
    walk k;
    vec3 n;
    if (!start(x, &to)) return end_inside(s, x);
    walk_make(&k, x);
    // An earlier proof's single corner comes without the direction it was met along.
    walk_state state = x->count == 1 && s->lower > -INFINITY ? fan(s, by, &k, &to) : WALK_ON;
    if (s->lower > s->ask.far) {
        take_upper(s, x);
        return GJK_ANSWERED;
    }
    for (; state == WALK_ON && s->iterations < s->ask.iterations; s->iterations++) {
        double scale = 1 / sqrt(to.square), distance = to.height * scale;
        if (distance <= s->frame->claim) break;
        // From below: the gap along the direction to the nearest point.
        frame_support p = probe_measure(by, to.n);
        double lower = take_gap(s, &to, scale, p.gap, &n);
        if (seems_done(s, distance)) {
            walk_end(&k, x);
            simplex_compute_weights(x);
            if (is_answered(s, x, lower, n)) return GJK_ANSWERED;
        }
        if (walk_is_known(&k, &p)) break;
        // From above: the nearest point of the simplex with the new corner.
        state = walk_step(&k, &p, distance, &to);
    }
    walk_end(&k, x);
    if (state == WALK_INSIDE) {
        simplex_compute_inside_weights(x);
        return end_inside(s, x);
    }
    return GJK_STALLED;
}

static gjk_end run_robust(search *s, const prober *by, simplex *x) {
    double last = INFINITY;
    heading to;
    vec3 n;
    if (!reduce(x, &to)) return end_inside(s, x);
    for (; s->iterations < s->ask.iterations; s->iterations++) {
        double distance = to.height;
        if (distance <= s->frame->claim) return GJK_CONTACT;
        if (!(distance < last)) return GJK_STALLED;
        last = distance;
        frame_support p = probe_measure(by, to.n);
        double lower = take_gap(s, &to, 1, p.gap, &n);
        if (seems_done(s, distance) && is_answered(s, x, lower, n)) return GJK_ANSWERED;
        if (is_known(x, &p)) return GJK_STALLED;
        x->p[x->count++] = (difference){p.w, p.a, p.b};
        if (!reduce(x, &to)) return end_inside(s, x);
    }
    return GJK_ITERATIONS;
}

gjk_end gjk_run(search *s, simplex *x) {
    prober by;
    prober_make(&by, s, 0);
    gjk_end end = run_fast(s, &by, x);
    if (end != GJK_ANSWERED && s->kind != OVOID_PROOF_HULL) end = run_robust(s, &by, x);
    if (end == GJK_ANSWERED) return end;
    take_upper(s, x);
    return search_is_done(s) ? GJK_ANSWERED : end;
}
