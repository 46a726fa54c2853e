// GJK: E. G. Gilbert, D. W. Johnson, S. S. Keerthi, A fast procedure for computing the distance between complex objects
// in three-dimensional space, 1988. The simplex's nearest point bounds the distance from above, the gap along its
// direction from below; each step adds the vertex pair that the gap was measured at. On polytopes the steps are finite,
// and the stop is by the bracket, never by a tolerance on progress.
//
// A fast step costs two supports and one kernel without branches (simd/corner.h). The loop keeps what decides: a
// direction of any length and how far along it the nearest point lies. That point's weights are computed when the query
// seems answered, and the answer is taken from them alone. A run that ends without an answer is continued from its
// simplex by robust steps (simplex_reduce), which handle slivers and flat simplices.
#include "exact/gjk.h"

#include "base/compiler.h"
#include "exact/probe.h"
#include "simd/corner.h"

enum { IDLE_STEPS = 8 };

// The simplex of the fast run: corners in lanes, those whose bit in `valid` is set.
typedef struct gjk_state {
    corner_lanes at;
    uint32_t a[4], b[4];
    unsigned valid;
} gjk_state;

// The place of the nearest point: along n, of any length, at height / |n|.
typedef struct heading {
    vec3 n;
    double height, square;
} heading;

static int is_known(const simplex *points, const frame_support *p) {
    for (int i = 0; i < points->count; i++)
        if (points->p[i].a == p->a && points->p[i].b == p->b) return 1;
    return 0;
}

// Takes the simplex's nearest point as upper bound.
static void take_upper(search *s, const simplex *points) {
    double upper = s->upper;
    search_take_points(s, points);
    if (s->upper < upper) s->stage = OVOID_STAGE_GJK;
}

static void take_lower(search *s, double lower, vec3 n) {
    s->lower = lower;
    s->normal = n;
}

// The points of a tetrahedron's faces: where it is flat its volumes are noise, and so are the weights they give.
static void take_faces(search *s, const simplex *points) {
    for (int out = 0; out < 4; out++) {
        simplex face = {.count = 3};
        for (int i = 0, k = 0; i < 4; i++)
            if (i != out) face.p[k++] = points->p[i];
        (void)simplex_reduce(&face);
        search_take_points(s, &face);
    }
}

// Ends a run whose simplex holds the origin, to rounding.
static gjk_end end_inside(search *s, const simplex *points) {
    s->stage = OVOID_STAGE_GJK;
    evidence inside = evidence_make(points);
    if (points->count < 4 || !search_take_hull(s, &inside)) {
        search_take_points(s, points);
        if (points->count == 4) take_faces(s, points);
    }
    return search_is_done(s) ? GJK_ANSWERED : GJK_CONTACT;
}

// 1 if the bounds would answer the query, with an upper bound from the distance along the direction.
static int seems_done(const search *s, double distance) {
    const query_goal *goal = &s->goal;
    double upper = distance - s->frame->upper_radii + s->frame->claim;
    if (s->lower > goal->far || (upper < 0 && !goal->wants_depth)) return 1;
    return (upper <= goal->near && s->lower > 0) || (goal->wants_bracket && upper - s->lower <= goal->tolerance);
}

// 1 if the query is answered. Where the goal is a bracket it is taken along n, the witness points' own direction, so
// that points, normal and distance agree.
static int is_answered(search *s, const simplex *points, double lower, vec3 n) {
    take_upper(s, points);
    if (!search_is_done(s)) return 0;
    if (s->lower > s->goal.far || !s->goal.wants_bracket || s->upper <= s->goal.near) return 1;
    if (s->upper - lower > s->goal.tolerance) return 0;
    take_lower(s, lower, n);
    return 1;
}

// The robust step, and the first one from several points. 0 if the origin lies in the simplex.
static int reduce(simplex *points, heading *to) {
    vec3 n = simplex_reduce(points);
    *to = (heading){n, vec3_norm(simplex_compute_point(points)), vec3_norm_squared(n)};
    return to->square > 0;
}

// 1 if squares neither overflow nor lose digits.
static int is_in_range(double square) { return square > 1e-200 && square < 1e200; }

// The first direction. 0 if the origin lies in the simplex.
static int start(simplex *points, heading *to) {
    vec3 w = points->p[0].w;
    double square = vec3_norm_squared(w);
    if (points->count > 1 || !is_in_range(square)) return reduce(points, to);
    points->weight[0] = 1;
    *to = (heading){w, square, square};
    return 1;
}

static vec3 get_corner(const gjk_state *k, int i) { return (vec3){k->at.x[i], k->at.y[i], k->at.z[i]}; }

static void set_corner(gjk_state *k, int i, const difference *p) {
    k->at.x[i] = p->w.x;
    k->at.y[i] = p->w.y;
    k->at.z[i] = p->w.z;
    k->a[i] = p->a;
    k->b[i] = p->b;
}

static void state_make(gjk_state *k, const simplex *points) {
    for (int i = 0; i < 4; i++) set_corner(k, i, &points->p[i < points->count ? i : 0]);
    k->valid = (1u << points->count) - 1;
}

// The corners of the state as a simplex.
static void state_get_simplex(const gjk_state *k, simplex *points) {
    points->count = 0;
    for (int i = 0; i < 4; i++)
        if (k->valid >> i & 1) points->p[points->count++] = (difference){get_corner(k, i), k->a[i], k->b[i]};
}

static int is_corner(const gjk_state *k, const frame_support *p) {
    int known = 0;
    for (int i = 0; i < 3; i++) known |= (k->a[i] == p->a) & (k->b[i] == p->b) & (int)(k->valid >> i);
    return known & 1;
}

typedef enum step_result { STEP_ON, STEP_INSIDE, STEP_STALLED } step_result;

// The heading along a sliver's normal, orthogonal to its edges to rounding.
static heading clean(const gjk_state *k, unsigned kept, vec3 a) {
    int i = (int)compiler_count_low_zeros(kept), j = 31 - (int)compiler_count_high_zeros(kept);
    vec3 n = simplex_compute_normal(vec3_sub(get_corner(k, i), a), vec3_sub(get_corner(k, j), a));
    double height = vec3_dot(n, a);
    return (heading){height < 0 ? vec3_neg(n) : n, fabs(height), vec3_norm_squared(n)};
}

// The fast step to the new corner. Where it makes no progress, all four corners are kept.
static step_result take_step(gjk_state *k, const frame_support *p, double distance, heading *to) {
    corner_step next = simd_step_from_corner(&k->at, k->valid, &p->w);
    vec3 n = {next.x, next.y, next.z};
    *to = next.is_sliver ? clean(k, next.kept, p->w) : (heading){n, vec3_dot(n, p->w), next.square};
    int gains = to->height * to->height < distance * distance * to->square && is_in_range(to->square);
    step_result state = next.is_inside ? STEP_INSIDE : gains ? STEP_ON : STEP_STALLED;
    unsigned kept = state == STEP_ON ? next.kept : k->valid;
    int place = (int)compiler_count_low_zeros(~kept);
    set_corner(k, place, &(difference){p->w, p->a, p->b});
    k->valid = kept | 1u << place;
    return state;
}

// Takes the gap along the heading as lower bound if it is the best; *n: the unit vector.
static double take_gap(search *s, const heading *to, double scale, double gap, vec3 *n) {
    double lower = gap * scale - s->frame->lower_radii - s->frame->claim;
    *n = vec3_scale(to->n, scale);
    if (lower > s->lower) {
        take_lower(s, lower, *n);
        s->stage = OVOID_STAGE_GJK;
    }
    return lower;
}

// The second and third corner at once. From one corner w, met along n, GJK would probe along w itself, which near
// contact is almost orthogonal to n: it meets a corner far away on the other side. The corners around the nearest point
// are met along n tilted by the angle that separates neighbours of a round body with as many corners; two of them, to
// either side of w's offset from n, make a triangle with w that the origin often projects into.
static step_result seed_triangle(search *s, const prober *by, gjk_state *k, heading *to) {
    const pair_frame *f = s->frame;
    vec3 n = s->normal, w = to->n;
    double h = vec3_dot(w, n), tilt = 1.5 / sqrt((double)f->a->vertex_count + (double)f->b->vertex_count);
    vec3 off = vec3_add_scaled(w, n, -h);
    double length = vec3_norm(off);
    // Far apart, or where w itself is tilted less, it is the better direction.
    if (!(length > tilt * fmax(h, 0)) || 4 * h > f->a->reach + f->b->reach || s->goal.iterations < s->iterations + 3)
        return STEP_ON;
    vec3 u = vec3_add_scaled(n, off, tilt / length), v = vec3_scale(vec3_cross(n, off), tilt / length), unit;
    heading side[2] = {{vec3_add(u, v), 0, 0}, {vec3_sub(u, v), 0, 0}};
    frame_support p[2] = {probe_measure(by, side[0].n), probe_measure(by, side[1].n)};
    step_result state = STEP_ON;
    for (int i = 0; i < 2; i++) {
        side[i].square = vec3_norm_squared(side[i].n);
        s->iterations++;
        (void)take_gap(s, &side[i], 1 / sqrt(side[i].square), p[i].gap, &unit);
        // A corner that is not beyond the nearest point so far is of no use.
        if (state == STEP_ON && vec3_dot(to->n, p[i].w) < to->height)
            state = take_step(k, &p[i], to->height / sqrt(to->square), to);
    }
    return state;
}

static gjk_end run_fast(search *s, const prober *by, simplex *points) {
    heading to;
    gjk_state k;
    vec3 n;
    if (!start(points, &to)) return end_inside(s, points);
    state_make(&k, points);
    // An earlier proof's single corner comes without the direction it was met along.
    step_result state = points->count == 1 && s->lower > -INFINITY ? seed_triangle(s, by, &k, &to) : STEP_ON;
    if (s->lower > s->goal.far) {
        take_upper(s, points);
        return GJK_ANSWERED;
    }
    double least = INFINITY;
    for (int idle = 0; state == STEP_ON && s->iterations < s->goal.iterations; s->iterations++) {
        double scale = 1 / sqrt(to.square), distance = to.height * scale;
        if (distance <= s->frame->claim) break;
        // Near the nearest point, steps that gain by rounding alone may go around in a circle.
        if (!(distance < least) && ++idle > IDLE_STEPS) break;
        least = min2(least, distance);
        // The lower bound: the gap along the direction to the nearest point.
        frame_support p = probe_measure(by, to.n);
        double lower = take_gap(s, &to, scale, p.gap, &n);
        if (seems_done(s, distance)) {
            state_get_simplex(&k, points);
            simplex_compute_weights(points);
            if (is_answered(s, points, lower, n)) return GJK_ANSWERED;
        }
        if (is_corner(&k, &p)) break;
        // The upper bound: the nearest point of the simplex with the new corner.
        state = take_step(&k, &p, distance, &to);
    }
    state_get_simplex(&k, points);
    if (state == STEP_INSIDE) {
        simplex_compute_inside_weights(points);
        return end_inside(s, points);
    }
    return GJK_STALLED;
}

static gjk_end run_robust(search *s, const prober *by, simplex *points) {
    double last = INFINITY;
    heading to;
    vec3 n;
    if (!reduce(points, &to)) return end_inside(s, points);
    for (; s->iterations < s->goal.iterations; s->iterations++) {
        double distance = to.height;
        if (distance <= s->frame->claim) return GJK_CONTACT;
        if (!(distance < last)) return GJK_STALLED;
        last = distance;
        frame_support p = probe_measure(by, to.n);
        double lower = take_gap(s, &to, 1, p.gap, &n);
        if (seems_done(s, distance) && is_answered(s, points, lower, n)) return GJK_ANSWERED;
        if (is_known(points, &p)) return GJK_STALLED;
        points->p[points->count++] = (difference){p.w, p.a, p.b};
        if (!reduce(points, &to)) return end_inside(s, points);
    }
    return GJK_ITERATIONS;
}

gjk_end gjk_run(search *s, simplex *points) {
    prober by;
    prober_make(&by, s, 0);
    gjk_end end = run_fast(s, &by, points);
    if (end != GJK_ANSWERED && s->kind != OVOID_PROOF_HULL) end = run_robust(s, &by, points);
    if (end == GJK_ANSWERED) return end;
    take_upper(s, points);
    return search_is_done(s) ? GJK_ANSWERED : end;
}
