// The supports of two ellipsoids along a direction, with their second derivatives: shared by the search and the
// Hessian.
#ifndef OVOID_SMOOTH_SMOOTH_STATE_H
#define OVOID_SMOOTH_SMOOTH_STATE_H

#include "smooth/smooth.h"

/// A symmetric 2x2 matrix with its determinant, which is found without cancellation.
typedef struct curvature {
    double xx, xy, yy, det;
} curvature;

/// The tangent plane at n, right-handed: e0 x e1 = n.
typedef struct tangents {
    vec3 e0, e1;
} tangents;

static inline tangents tangents_make(vec3 n) {
    vec3 e0 = vec3_orthogonal(n);
    return (tangents){e0, vec3_cross(n, e0)};
}

/// Fills in xa, xb, w and across from n, p and q.
static inline void smooth_set_points(const smooth_pair *pair, smooth_state *state) {
    state->xa = root3_map(&pair->a.root, state->p);
    state->xb = root3_map(&pair->b.root, state->q);
    state->w = vec3_sub(vec3_sub(pair->d, state->xa), state->xb);
    state->across = vec3_add_scaled(state->w, state->n, -vec3_dot(state->n, state->w));
}

/// Fills the state of the unit direction n.
static inline void smooth_evaluate(const smooth_pair *pair, vec3 n, smooth_state *state) {
    state->n = n;
    vec3 p = root3_map_transposed(&pair->a.root, n), q = root3_map_transposed(&pair->b.root, n);
    double sa = vec3_norm(p), sb = vec3_norm(q);
    state->gap = (vec3_dot(n, pair->d) - sa) - sb;
    state->sa = max2(sa, SMOOTH_SPREAD_MIN);
    state->sb = max2(sb, SMOOTH_SPREAD_MIN);
    state->p = vec3_scale(p, 1 / state->sa);
    state->q = vec3_scale(q, 1 / state->sb);
    smooth_set_points(pair, state);
}

/// The second derivative of the support of a body in its tangent plane, at the point p of the unit ball.
// With F = E' [e0 e1], the matrix is F' (I - p p') F / s, and its determinant by the cross product c of F's columns
// ((p.c)^2 + (1 - p^2) c^2) / s^2: all sums of squares.
static inline curvature smooth_compute_curvature(const root3 *root, const tangents *plane, vec3 p, double spread) {
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

/// The sum a + b + gap I, with its determinant.
static inline curvature curvature_add(const curvature *a, const curvature *b, double gap) {
    curvature k = {(a->xx + b->xx) + gap, a->xy + b->xy, (a->yy + b->yy) + gap, 0};
    // det(A + B) = det A + det B + tr(adj A B).
    double mixed = (a->xx * b->yy + a->yy * b->xx) - 2 * (a->xy * b->xy);
    k.det = ((a->det + b->det) + max2(mixed, 0)) + gap * (gap + ((a->xx + b->xx) + (a->yy + b->yy)));
    return k;
}

/// The lesser eigenvalue, by the determinant where it is positive.
static inline double curvature_compute_least(const curvature *k) {
    double half = 0.5 * (k->xx + k->yy), off = 0.5 * (k->xx - k->yy);
    double root = sqrt(off * off + k->xy * k->xy), most = half + root;
    return most > 0 ? k->det / most : half - root;
}

#endif
