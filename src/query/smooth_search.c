// The direction n of the largest gap of two ellipsoids' supports, g(n) = n.d - sqrt(n' Qa n) - sqrt(n' Qb n), |n| = 1.
//
// First the ellipsoids' own iteration, n <- (Qa/sa + Qb/sb + gI)^-1 d, twice; then Newton's method on the sphere: with
// w the vector between the two support points and S = Sa + Sb the second derivatives of the supports, the step is the
// tangent vector (S + gI)^-1 w. Where they are apart g is concave in all of space and S + gI positive; where they
// overlap the matrix is shifted until it is. A step that lowers the gap is halved. The state of largest gap is kept.
//
// Newton's method stalls where n is across a flat body (the support has a kink there). Apart, nearest.c then solves the
// same problem by its multipliers, which knows no kink. Overlapping, any direction gives a true lower bound, and what
// is missing of it shows in `across`. Cost: 4 to 8 evaluations of some 20 ns; flat bodies 5 to 10 microseconds.
#include "ellipsoid/pencil.h"
#include "query/smooth.h"

enum { STEPS = 24, HALVINGS = 8 };

/// A step this short is rounding.
#define STEP_MIN 0x1p-48

tangents tangents_make(vec3 n) {
    vec3 e0 = vec3_orthogonal(n);
    return (tangents){e0, vec3_cross(n, e0)};
}

static inline void set_points(const smooth_pair *pair, smooth_state *x) {
    x->xa = root3_map(&pair->a.root, x->p);
    x->xb = root3_map(&pair->b.root, x->q);
    x->w = vec3_sub(vec3_sub(pair->d, x->xa), x->xb);
    x->across = vec3_add_scaled(x->w, x->n, -vec3_dot(x->n, x->w));
}

static inline void evaluate(const smooth_pair *pair, vec3 n, smooth_state *x) {
    x->n = n;
    vec3 p = root3_map_transposed(&pair->a.root, n), q = root3_map_transposed(&pair->b.root, n);
    double sa = vec3_norm(p), sb = vec3_norm(q);
    x->gap = (vec3_dot(n, pair->d) - sa) - sb;
    x->sa = max2(sa, SMOOTH_SPREAD_MIN);
    x->sb = max2(sb, SMOOTH_SPREAD_MIN);
    x->p = vec3_scale(p, 1 / x->sa);
    x->q = vec3_scale(q, 1 / x->sb);
    set_points(pair, x);
}

void smooth_evaluate(const smooth_pair *pair, vec3 n, smooth_state *x) { evaluate(pair, n, x); }

// With F = E' [e0 e1], the matrix is F' (I - p p') F / s, and its determinant by the cross product c of F's columns
// ((p.c)^2 + (1 - p^2) c^2) / s^2: all sums of squares.
static inline curvature compute_curvature(const root3 *root, const tangents *plane, vec3 p, double spread) {
    vec3 f0 = root3_map_transposed(root, plane->e0), f1 = root3_map_transposed(root, plane->e1);
    vec3 c = vec3_cross(f0, f1);
    double pp = vec3_norm_squared(p), rest = max2(1 - pp, 0), along = vec3_dot(p, c), down = 1 / spread;
    if (rest < 0x1p-48) rest = 0;
    double t0 = vec3_dot(p, f0), t1 = vec3_dot(p, f1), share = pp > 0 ? 1 / pp : 0;
    vec3 g0 = vec3_add_scaled(f0, p, -t0 * share), g1 = vec3_add_scaled(f1, p, -t1 * share);
    rest *= share;
    return (curvature){.xx = (vec3_norm_squared(g0) + rest * t0 * t0) * down,
                       .xy = (vec3_dot(g0, g1) + rest * t0 * t1) * down,
                       .yy = (vec3_norm_squared(g1) + rest * t1 * t1) * down,
                       .det = ((along * along) + max2(1 - pp, 0) * vec3_norm_squared(c)) * down * down};
}

curvature smooth_compute_curvature(const root3 *root, const tangents *plane, vec3 p, double spread) {
    return compute_curvature(root, plane, p, spread);
}

curvature curvature_add(const curvature *a, const curvature *b, double gap) {
    curvature k = {(a->xx + b->xx) + gap, a->xy + b->xy, (a->yy + b->yy) + gap, 0};
    // det(A + B) = det A + det B + tr(adj A B).
    double mixed = (a->xx * b->yy + a->yy * b->xx) - 2 * (a->xy * b->xy);
    k.det = ((a->det + b->det) + max2(mixed, 0)) + gap * (gap + ((a->xx + b->xx) + (a->yy + b->yy)));
    return k;
}

// Of the eigenvalues the lesser one: by the determinant where it is positive.
double curvature_compute_least(const curvature *k) {
    double half = 0.5 * (k->xx + k->yy), off = 0.5 * (k->xx - k->yy);
    double root = sqrt(off * off + k->xy * k->xy), most = half + root;
    return most > 0 ? k->det / most : half - root;
}

// Newton's step from the state, as a tangent vector, and how large the step after it may be against its square.
static vec3 find_step(const smooth_pair *pair, const smooth_state *x, double *growth) {
    tangents plane = tangents_make(x->n);
    curvature a = compute_curvature(&pair->a.root, &plane, x->p, x->sa);
    curvature b = compute_curvature(&pair->b.root, &plane, x->q, x->sb);
    curvature k = curvature_add(&a, &b, x->gap);
    // The matrix changes over angles of about its least eigenvalue and the spreads, in units of the size.
    *growth = ((k.xx + k.yy) / k.det + (1 / x->sa + 1 / x->sb)) * pair->size;
    if (x->gap < 0) {
        // Shifted where it is not positive, so that the step points up.
        double least = curvature_compute_least(&k), enough = 0.1 * ((k.xx + k.yy) - 2 * x->gap) + 0x1p-40 * pair->size;
        if (!(least > 0.1 * fabs(x->gap) || least > enough)) k = curvature_add(&a, &b, enough - least + x->gap);
    }
    double r0 = vec3_dot(plane.e0, x->across), r1 = vec3_dot(plane.e1, x->across);
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
            evaluate(pair, vec3_unit(vec3_add(best->n, by)), &next);
            if (next.gap >= best->gap - 0x1p-51 * pair->size) break;
        }
        if (half == HALVINGS) return step;
        // Near the end, where the gap says nothing any more, the points do.
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
        smooth_state x;
        evaluate(pair, n, &x);
        double g = max2(x.gap, 0x1p-30 * pair->size);
        sym3 m = sym3_diagonal(g, g, g);
        for (int k = 0; k < 3; k++) {
            m = sym3_add(m, sym3_outer(pair->a.root.axis[k], 1 / max2(x.sa, 0x1p-30 * pair->size)));
            m = sym3_add(m, sym3_outer(pair->b.root.axis[k], 1 / max2(x.sb, 0x1p-30 * pair->size)));
        }
        ldl3 f;
        if (!ldl3_make(m, &f)) return n;
        vec3 next = vec3_unit(ldl3_solve(&f, pair->d));
        if (!(vec3_norm_squared(next) > 0.5)) return n;
        n = next;
    }
    return n;
}

// By the multipliers: for flat bodies that are apart. 1 if that is better.
static int search_by_multipliers(const smooth_pair *pair, smooth_state *x, uint32_t *steps) {
    root3_nearest found;
    if (!roots_find_nearest(&pair->a.root, &pair->b.root, pair->d, &found)) return 0;
    *steps += found.rounds;
    smooth_state y;
    smooth_evaluate(pair, found.normal, &y);
    // Points that are inside the unit ball belong to bodies that n is across.
    y.p = vec3_norm_squared(found.p) > 1 - 0x1p-20 ? vec3_unit(found.p) : found.p;
    y.q = vec3_norm_squared(found.q) > 1 - 0x1p-20 ? vec3_unit(found.q) : found.q;
    set_points(pair, &y);
    if (!(vec3_norm_squared(y.across) < vec3_norm_squared(x->across)) || y.gap < x->gap - 0x1p-40 * pair->size)
        return 0;
    *x = y;
    return 1;
}

static double clamp(double t) { return max2(-1, min2(t, 1)); }

// Two segments or points, apart: the nearest points by clamping (C. Ericson, Real-time collision detection, 2005). 1 if
// that is what they are.
static int search_segments(const smooth_pair *pair, smooth_state *x) {
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
    evaluate(pair, n, x);
    x->p = (vec3){s, 0, 0};
    x->q = (vec3){t, 0, 0};
    set_points(pair, x);
    return x->gap > 0;
}

void smooth_search(const smooth_pair *pair, smooth_state *x, double *upper, uint32_t *steps) {
    double good = 0x1p-44 * pair->size;
    if (search_segments(pair, x) && vec3_norm(x->across) <= good) {
        *upper = vec3_norm(x->w) + pair->claim;
        return;
    }
    *steps += smooth_climb(pair, find_start(pair), x);
    int is_done = vec3_norm(x->across) <= good;
    if (!is_done && search_by_multipliers(pair, x, steps)) is_done = x->gap > 0;
    *upper = vec3_norm(x->w) + pair->claim;
    if (x->gap > 0 && is_done) return;
    // Overlapping, or nearly: is there no better direction?
    double bound = smooth_compute_bound(pair, x);
    if (x->gap < 0 && bound == INFINITY) {
        vec3 n;
        double grown = smooth_grow(pair, &n, steps);
        smooth_state y;
        *steps += smooth_climb(pair, n, &y);
        if (y.gap > x->gap) *x = y;
        bound = min2(grown, smooth_compute_bound(pair, x));
    }
    *upper = min2(vec3_norm(x->w) + pair->claim, bound);
}
