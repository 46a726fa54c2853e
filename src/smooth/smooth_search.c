// The direction n of the largest gap of two ellipsoids' supports, g(n) = n.d - sqrt(n' Qa n) - sqrt(n' Qb n), |n| = 1.
//
// First the ellipsoids' own iteration, n <- (Qa/sa + Qb/sb + gI)^-1 d, twice; then Newton's method on the sphere: with
// w the vector between the two support points and S = Sa + Sb the second derivatives of the supports, the step is the
// tangent vector (S + gI)^-1 w. Where they are apart g is concave in all of space and S + gI positive; where they
// overlap the matrix is shifted until it is. A step that lowers the gap is halved. The state of largest gap is kept.
//
// Newton's method stalls where n is across a flat body (the support has a kink there). For bodies apart,
// ellipsoid/distance/nearest.c then solves the same problem by its multipliers, which has no kink. For bodies that
// overlap, any direction gives a true lower bound, and the residue shows in `across`. Cost: 4 to 8 evaluations of some
// 20 ns; flat bodies 5 to 10 microseconds.
#include "ellipsoid/distance/pencil.h"
#include "smooth/smooth_state.h"

enum { STEPS = 24, HALVINGS = 8 };

/// A shorter step is rounding.
#define STEP_MIN 0x1p-48

// Newton's step from the state, as a tangent vector. *growth: the next step over the square of this one, at most.
static vec3 find_step(const smooth_pair *pair, const smooth_state *state, double *growth) {
    tangents plane = tangents_make(state->n);
    curvature a = smooth_compute_curvature(&pair->a.root, &plane, state->p, state->sa);
    curvature b = smooth_compute_curvature(&pair->b.root, &plane, state->q, state->sb);
    curvature k = curvature_add(&a, &b, state->gap);
    // The matrix changes over angles of about its least eigenvalue and the spreads, in units of the size.
    *growth = ((k.xx + k.yy) / k.det + (1 / state->sa + 1 / state->sb)) * pair->size;
    if (state->gap < 0) {
        // Shifted where it is not positive, so that the step points up.
        double least = curvature_compute_least(&k),
               enough = 0.1 * ((k.xx + k.yy) - 2 * state->gap) + 0x1p-40 * pair->size;
        if (!(least > 0.1 * fabs(state->gap) || least > enough)) k = curvature_add(&a, &b, enough - least + state->gap);
    }
    double r0 = vec3_dot(plane.e0, state->across), r1 = vec3_dot(plane.e1, state->across);
    double d0 = (k.yy * r0 - k.xy * r1) / k.det, d1 = (k.xx * r1 - k.xy * r0) / k.det;
    return vec3_add_scaled(vec3_scale(plane.e0, d0), plane.e1, d1);
}

uint32_t smooth_climb(const smooth_pair *pair, vec3 n, smooth_state *best) {
    smooth_evaluate(pair, n, best);
    for (uint32_t step = 1; step <= STEPS; step++) {
        double growth;
        vec3 by = find_step(pair, best, &growth);
        double length = vec3_norm(by);
        if (!(length > STEP_MIN) || !isfinite(length)) return step;
        if (length > 1) by = vec3_scale(by, 1 / length);
        smooth_state next;
        int half = 0;
        for (; half < HALVINGS; half++, by = vec3_scale(by, 0.5)) {
            smooth_evaluate(pair, vec3_unit(vec3_add(best->n, by)), &next);
            if (next.gap >= best->gap - 0x1p-51 * pair->size) break;
        }
        if (half == HALVINGS) return step;
        // Near the end the gap no longer changes; the points decide whether to go on.
        if (length < 0x1p-24 && vec3_norm_squared(next.across) >= vec3_norm_squared(best->across)) return step;
        *best = next;
        if (half == 0 && growth > 0 && length * length * growth * growth < STEP_MIN) return step;
    }
    return STEPS;
}

// Two rounds of the ellipsoids' own iteration.
static vec3 find_start(const smooth_pair *pair) {
    vec3 n = vec3_unit(pair->d);
    if (!(vec3_norm_squared(n) > 0.5)) return (vec3){1, 0, 0};
    for (int round = 0; round < 2; round++) {
        smooth_state state;
        smooth_evaluate(pair, n, &state);
        double g = max2(state.gap, 0x1p-30 * pair->size);
        sym3 m = sym3_diagonal(g, g, g);
        for (int k = 0; k < 3; k++) {
            m = sym3_add(m, sym3_outer(pair->a.root.axis[k], 1 / max2(state.sa, 0x1p-30 * pair->size)));
            m = sym3_add(m, sym3_outer(pair->b.root.axis[k], 1 / max2(state.sb, 0x1p-30 * pair->size)));
        }
        ldl3 f;
        if (!ldl3_make(m, &f)) return n;
        vec3 next = vec3_unit(ldl3_solve(&f, pair->d));
        if (!(vec3_norm_squared(next) > 0.5)) return n;
        n = next;
    }
    return n;
}

// The search by multipliers, for flat bodies that are apart. 1 if its state is better.
static int search_by_multipliers(const smooth_pair *pair, smooth_state *state, uint32_t *steps) {
    root3_nearest found;
    if (!roots_find_nearest(&pair->a.root, &pair->b.root, pair->d, &found)) return 0;
    *steps += found.rounds;
    smooth_state y;
    smooth_evaluate(pair, found.normal, &y);
    // A point inside the unit ball belongs to a body that n is across.
    y.p = vec3_norm_squared(found.p) > 1 - 0x1p-40 ? vec3_unit(found.p) : found.p;
    y.q = vec3_norm_squared(found.q) > 1 - 0x1p-40 ? vec3_unit(found.q) : found.q;
    smooth_set_points(pair, &y);
    if (!(vec3_norm_squared(y.across) < vec3_norm_squared(state->across)) || y.gap < state->gap - 0x1p-40 * pair->size)
        return 0;
    *state = y;
    return 1;
}

static double clamp(double t) { return max2(-1, min2(t, 1)); }

// Two segments or points, apart: the nearest points by clamping (C. Ericson, Real-time collision detection, 2005). 1 if
// both bodies are such.
static int search_segments(const smooth_pair *pair, smooth_state *state) {
    const vec3 *ea = pair->a.root.axis, *eb = pair->b.root.axis;
    double rest =
        (vec3_norm_squared(ea[1]) + vec3_norm_squared(ea[2])) + (vec3_norm_squared(eb[1]) + vec3_norm_squared(eb[2]));
    if (rest > 0) return 0;
    double aa = vec3_norm_squared(ea[0]), bb = vec3_norm_squared(eb[0]), ab = vec3_dot(ea[0], eb[0]);
    double ad = vec3_dot(ea[0], pair->d), bd = vec3_dot(eb[0], pair->d),
           det = vec3_norm_squared(vec3_cross(ea[0], eb[0]));
    // Points s of a, -t of b: s aa + t ab = ad, s ab + t bb = bd where neither is at an end.
    double s = det > 0 ? clamp((ad * bb - bd * ab) / det) : aa > 0 ? clamp(ad / aa) : 0;
    double t = bb > 0 ? (bd - s * ab) / bb : 0;
    if (fabs(t) > 1) {
        t = clamp(t);
        if (aa > 0) s = clamp((ad - t * ab) / aa);
    }
    vec3 w = vec3_sub(vec3_add_scaled(pair->d, ea[0], -s), vec3_scale(eb[0], t)), n = vec3_unit(w);
    if (!(vec3_norm_squared(n) > 0.5)) return 0;
    smooth_evaluate(pair, n, state);
    state->p = (vec3){s, 0, 0};
    state->q = (vec3){t, 0, 0};
    smooth_set_points(pair, state);
    return state->gap > 0;
}

void smooth_search(const smooth_pair *pair, smooth_state *state, double *upper, uint32_t *steps) {
    double good = 0x1p-44 * pair->size;
    if (search_segments(pair, state) && vec3_norm(state->across) <= good) {
        *upper = vec3_norm(state->w) + pair->claim;
        return;
    }
    *steps += smooth_climb(pair, find_start(pair), state);
    int is_done = vec3_norm(state->across) <= good;
    if (!is_done && search_by_multipliers(pair, state, steps)) is_done = state->gap > 0;
    *upper = vec3_norm(state->w) + pair->claim;
    if (state->gap > 0 && is_done) return;
    // Overlapping or nearly so: another direction may be better.
    double bound = smooth_compute_bound(pair, state);
    if (state->gap < 0 && bound == INFINITY) {
        vec3 n;
        double grown = smooth_grow(pair, &n, steps);
        smooth_state y;
        *steps += smooth_climb(pair, n, &y);
        if (y.gap > state->gap) *state = y;
        bound = min2(grown, smooth_compute_bound(pair, state));
    }
    *upper = min2(vec3_norm(state->w) + pair->claim, bound);
}
