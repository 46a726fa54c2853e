// First and second derivatives of the largest gap of two ellipsoids' supports with respect to both poses.
//
// The gradient is that of the gap along the optimal n, held fixed (J. M. Danskin, The theory of max-min and its
// application to weapons allocation problems, 1967): n by translations, the points' torques by rotations. For the
// Hessian n moves: to second order, with u the tangent vector by which it does and a, b those by which the bodies turn
// away under it (a = wa x n), the gap is
//     max over u of  u.t - g u'u / 2 - (u - a)' A (u - a) / 2 - (u - b)' B (u - b) / 2  + terms without u,
// A and B the supports' second derivatives, t what translations and levers do across n. Three springs that meet in u:
// their elimination is written with determinants that are sums of positive terms (apart), so that a thin body, whose A
// is huge, cancels nothing. docs/smooth.md has the steps. Cost: 0.2 microseconds for all 144 numbers.
#include "smooth/smooth_state.h"

typedef struct mat2 {
    double xx, xy, yx, yy;
} mat2;

static mat2 mat2_from(const curvature *k, double scale) {
    return (mat2){k->xx * scale, k->xy * scale, k->xy * scale, k->yy * scale};
}
static mat2 mat2_mul(const mat2 *a, const mat2 *b) {
    return (mat2){a->xx * b->xx + a->xy * b->yx, a->xx * b->xy + a->xy * b->yy, a->yx * b->xx + a->yy * b->yx,
                  a->yx * b->xy + a->yy * b->yy};
}
static mat2 mat2_adjugate(const mat2 *a) { return (mat2){a->yy, -a->xy, -a->yx, a->xx}; }
// A matrix times a number.
typedef struct scaled2 {
    double by;
    const mat2 *m;
} scaled2;

static mat2 mat2_sum(scaled2 a, scaled2 b, scaled2 c) {
    return (mat2){
        (a.by * a.m->xx + b.by * b.m->xx) + c.by * c.m->xx, (a.by * a.m->xy + b.by * b.m->xy) + c.by * c.m->xy,
        (a.by * a.m->yx + b.by * b.m->yx) + c.by * c.m->yx, (a.by * a.m->yy + b.by * b.m->yy) + c.by * c.m->yy};
}

// The springs at the meeting point, eliminated: K = A + B + g.
typedef struct springs {
    mat2 inverse;      ///< K^-1
    mat2 by_a, by_b;   ///< K^-1 A, K^-1 B
    mat2 own_a, own_b; ///< A - A K^-1 A, B - B K^-1 B
    mat2 cross;        ///< A K^-1 B
    double least;      ///< the lesser eigenvalue of K
    double stiffest;   ///< the trace of own_a and own_b
} springs;

// A - A K^-1 A with rest = B + g: (det(rest) A + det(A) rest) / det(K).
static mat2 find_own(const curvature *a, const curvature *b, double g, double scale) {
    mat2 one = {1, 0, 0, 1}, ma = mat2_from(a, 1), mb = mat2_from(b, 1);
    double rest = b->det + g * ((b->xx + b->yy) + g);
    return mat2_sum((scaled2){rest * scale, &ma}, (scaled2){a->det * scale, &mb}, (scaled2){g * a->det * scale, &one});
}

static springs springs_make(const curvature *a, const curvature *b, double g) {
    curvature k = curvature_add(a, b, g);
    double scale = 1 / k.det;
    mat2 one = {1, 0, 0, 1}, ma = mat2_from(a, 1), mb = mat2_from(b, 1), mk = mat2_from(&k, scale);
    mat2 adj_a = mat2_adjugate(&ma), adj_b = mat2_adjugate(&mb);
    mat2 ba = mat2_mul(&adj_b, &ma), ab = mat2_mul(&adj_a, &mb), product = mat2_mul(&ma, &mb);
    springs s = {.inverse = mat2_adjugate(&mk), .least = curvature_compute_least(&k)};
    s.by_a = mat2_sum((scaled2){a->det * scale, &one}, (scaled2){scale, &ba}, (scaled2){g * scale, &ma});
    s.by_b = mat2_sum((scaled2){b->det * scale, &one}, (scaled2){scale, &ab}, (scaled2){g * scale, &mb});
    s.own_a = find_own(a, b, g, scale);
    s.own_b = find_own(b, a, g, scale);
    s.cross = mat2_sum((scaled2){a->det * scale, &mb}, (scaled2){b->det * scale, &ma}, (scaled2){g * scale, &product});
    s.stiffest = max2(fabs(s.own_a.xx + s.own_a.yy), fabs(s.own_b.xx + s.own_b.yy));
    return s;
}

static void put(double *to, vec3 v) { to[0] = v.x, to[1] = v.y, to[2] = v.z; }

// Two rows over the twelve numbers, which are zero but from `first` to `end`.
typedef struct rows2 {
    double (*row)[12];
    int first, end;
} rows2;

// Adds u' M v to the matrix.
static void add_form(double h[12][12], rows2 u, const mat2 *m, rows2 v) {
    for (int i = u.first; i < u.end; i++) {
        double x = u.row[0][i] * m->xx + u.row[1][i] * m->yx, y = u.row[0][i] * m->xy + u.row[1][i] * m->yy;
        for (int j = v.first; j < v.end; j++) h[i][j] += x * v.row[0][j] + y * v.row[1][j];
    }
}

// Adds the second derivative by a rotation w about the position alone, -y.(w x (w x n)) / 2 with y the arm from the
// position to the point (of B its opposite): the block (y.n) I - (y n' + n y') / 2.
static void add_turning(double h[12][12], int at, vec3 y, vec3 n) {
    const double yy[3] = {y.x, y.y, y.z}, nn[3] = {n.x, n.y, n.z}, along = vec3_dot(y, n);
    for (int i = 0; i < 3; i++) {
        h[at + i][at + i] += along;
        for (int j = 0; j < 3; j++) h[at + i][at + j] -= 0.5 * (yy[i] * nn[j] + nn[i] * yy[j]);
    }
}

static void fill_hessian(const springs *s, const tangents *plane, vec3 n, const vec3 lever[2], double h[12][12]) {
    // Rows over the twelve numbers: t of the two tangents, a and b.
    double t[2][12] = {{0}}, a[2][12] = {{0}}, b[2][12] = {{0}};
    const vec3 e[2] = {plane->e0, plane->e1};
    for (int k = 0; k < 2; k++) {
        put(t[k], vec3_neg(e[k]));
        put(t[k] + 3, vec3_cross(e[k], lever[0]));
        put(t[k] + 6, e[k]);
        put(t[k] + 9, vec3_cross(lever[1], e[k]));
        vec3 turn = k ? vec3_neg(e[0]) : e[1];
        put(a[k] + 3, turn);
        put(b[k] + 9, turn);
    }
    mat2 own_a = {-0.5 * s->own_a.xx, -0.5 * s->own_a.xy, -0.5 * s->own_a.yx, -0.5 * s->own_a.yy};
    mat2 own_b = {-0.5 * s->own_b.xx, -0.5 * s->own_b.xy, -0.5 * s->own_b.yx, -0.5 * s->own_b.yy};
    mat2 half = {0.5 * s->inverse.xx, 0.5 * s->inverse.xy, 0.5 * s->inverse.yx, 0.5 * s->inverse.yy};
    double g[12][12] = {{0}};
    const rows2 across = {t, 0, 12}, turns_a = {a, 3, 6}, turns_b = {b, 9, 12};
    add_form(g, across, &half, across);
    add_form(g, across, &s->by_a, turns_a);
    add_form(g, across, &s->by_b, turns_b);
    add_form(g, turns_a, &s->cross, turns_b);
    add_form(g, turns_a, &own_a, turns_a);
    add_form(g, turns_b, &own_b, turns_b);
    for (int i = 0; i < 12; i++)
        for (int j = 0; j < 12; j++) h[i][j] = g[i][j] + g[j][i];
    add_turning(h, 3, lever[0], n);
    add_turning(h, 9, vec3_neg(lever[1]), n);
}

// From units of the pair's size to the caller's: each translation takes one length out, each rotation none.
static void unscale(double h[12][12], double unit) {
    double down = 1 / unit;
    for (int i = 0; i < 12; i++) {
        double moved = i % 6 < 3 ? down : 1, turned = i % 6 < 3 ? 1 : unit;
        for (int j = 0; j < 12; j++) h[i][j] *= j % 6 < 3 ? moved : turned;
    }
}

void smooth_derive(const smooth_pair *pair, const smooth_state *state, const vec3 levers[2], int order,
                   ovoid_smooth_value *out) {
    tangents plane = tangents_make(state->n);
    curvature a = smooth_compute_curvature(&pair->a.root, &plane, state->p, state->sa);
    curvature b = smooth_compute_curvature(&pair->b.root, &plane, state->q, state->sb);
    springs s = springs_make(&a, &b, state->gap);
    out->condition = max2(1, max2(pair->size / s.least, s.stiffest / pair->size));
    if (!(s.least > 0) || !(out->condition < INFINITY)) out->condition = INFINITY;
    out->is_smooth = out->condition < 0x1p50 && vec3_norm(state->across) <= 0x1p-30 * pair->size;
    if (order < 1) return;

    // A residue of w across n is rounding times A and B: the points move to where it vanishes, each by its share.
    vec3 lever[2] = {levers[0], levers[1]};
    if (out->is_smooth) {
        double r0 = vec3_dot(plane.e0, state->across), r1 = vec3_dot(plane.e1, state->across);
        mat2 sa = s.by_a, sb = s.by_b; // transposed: A K^-1, B K^-1
        lever[0] = vec3_add_scaled(lever[0], plane.e0, sa.xx * r0 + sa.yx * r1);
        lever[0] = vec3_add_scaled(lever[0], plane.e1, sa.xy * r0 + sa.yy * r1);
        lever[1] = vec3_add_scaled(lever[1], plane.e0, -(sb.xx * r0 + sb.yx * r1));
        lever[1] = vec3_add_scaled(lever[1], plane.e1, -(sb.xy * r0 + sb.yy * r1));
    }
    put(out->gradient, vec3_neg(state->n));
    put(out->gradient + 3, vec3_scale(vec3_cross(state->n, lever[0]), pair->unit));
    put(out->gradient + 6, state->n);
    put(out->gradient + 9, vec3_scale(vec3_cross(lever[1], state->n), pair->unit));
    if (order < 2 || !out->is_smooth) return;
    fill_hessian(&s, &plane, state->n, lever, out->hessian);
    unscale(out->hessian, pair->unit);
}
