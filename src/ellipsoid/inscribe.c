// The maximum-volume inscribed ellipsoid { x + E u }, E symmetric positive definite:
//     maximise log det E  subject to  |E n_i| + n_i . x <= b_i.
// Primal-dual interior point on the conditions
//     E^-1 = sym sum y_i w_i n_i',  w_i = E n_i / |E n_i|,   sum y_i n_i = 0,   |E n_i| + n_i . x + z_i = b_i,   y_i
//     z_i = mu
// as in Y. Zhang and L. Gao, On numerical solution of the maximum volume ellipsoid problem, 2003. They solve a system
// as large as the number of constraints; here the multipliers are eliminated, which leaves the nine unknowns of E and
// x, so that an iteration is linear in the constraints. Predictor and corrector as in S. Mehrotra, On the
// implementation of a primal-dual interior point method, 1992. The constraints' convexity makes the system positive
// definite. The result is not trusted: the caller proves what it returns.
#include "ellipsoid/inscribe.h"

// Unknowns: xx xy xz yy yz zz of E, then x.
enum { UNKNOWNS = 9 };

typedef struct newton {
    double h[UNKNOWNS][UNKNOWNS]; // lower triangle; after factoring, Cholesky's
    double gradient[UNKNOWNS];    // of log det E
} newton;

typedef struct step {
    sym3 e;
    vec3 x;
} step;

// Computes |E n|, its direction, and the residual of the slack.
static void evaluate(constraint *c, const inscribed *s) {
    vec3 p = sym3_mul_vec3(s->e, c->n);
    c->h = vec3_norm(p);
    c->w = vec3_scale(p, 1 / c->h);
    c->miss = (c->b - vec3_dot(c->n, s->x)) - c->h - c->z;
}

// The gradient of |E n| + n . x in the nine unknowns.
static void get_gradient(const constraint *c, double g[UNKNOWNS]) {
    const vec3 *n = &c->n, *w = &c->w;
    g[0] = n->x * w->x;
    g[1] = n->y * w->x + n->x * w->y;
    g[2] = n->z * w->x + n->x * w->z;
    g[3] = n->y * w->y;
    g[4] = n->z * w->y + n->y * w->z;
    g[5] = n->z * w->z;
    g[6] = n->x;
    g[7] = n->y;
    g[8] = n->z;
}

// Adds the form tr(D c D) in changes D of E: for c = sum (y / h) n n' that is sum (y / h) |D n|^2.
static void add_curvature(newton *m, sym3 c) {
    m->h[0][0] += c.xx;
    m->h[1][0] += c.xy;
    m->h[2][0] += c.xz;
    m->h[1][1] += c.xx + c.yy;
    m->h[2][1] += c.yz;
    m->h[3][1] += c.xy;
    m->h[4][1] += c.xz;
    m->h[2][2] += c.xx + c.zz;
    m->h[4][2] += c.xy;
    m->h[5][2] += c.xz;
    m->h[3][3] += c.yy;
    m->h[4][3] += c.yz;
    m->h[4][4] += c.yy + c.zz;
    m->h[5][4] += c.yz;
    m->h[5][5] += c.zz;
}

// The second derivative of -log det E, tr(X D X D) with X = E^-1, and the gradient of log det E.
static void add_barrier(newton *m, sym3 e) {
    sym3 x = sym3_inverse(e);
    const double full[3][3] = {{x.xx, x.xy, x.xz}, {x.xy, x.yy, x.yz}, {x.xz, x.yz, x.zz}};
    const int at[6][2] = {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}};
    for (int k = 0; k < 6; k++) {
        int i = at[k][0], j = at[k][1];
        m->gradient[k] = (i == j ? 1 : 2) * full[i][j];
        for (int l = 0; l <= k; l++) {
            int p = at[l][0], q = at[l][1];
            double sum = full[i][p] * full[j][q] + full[i][q] * full[j][p];
            m->h[k][l] += (i == j ? 0.5 : 1) * (p == q ? 0.5 : 1) * 2 * sum;
        }
    }
}

// The system of the Newton step, factored; 0 if it is not positive definite in doubles.
static int prepare(newton *m, constraint_set set, const inscribed *s) {
    *m = (newton){0};
    sym3 curvature = {0, 0, 0, 0, 0, 0};
    for (uint32_t i = 0; i < set.count; i++) {
        constraint *c = &set.items[i];
        evaluate(c, s);
        double g[UNKNOWNS], bend = c->y / c->h, stiff = c->y / c->z;
        get_gradient(c, g);
        curvature = sym3_add(curvature, sym3_outer(c->n, bend));
        for (int k = 0; k < UNKNOWNS; k++) {
            double scaled = g[k] * (k < 6 ? stiff - bend : stiff);
            for (int l = 0; l <= k && l < 6; l++) m->h[k][l] += scaled * g[l];
            for (int l = 6; l <= k; l++) m->h[k][l] += scaled * g[l];
        }
    }
    add_curvature(m, curvature);
    add_barrier(m, s->e);
    for (int j = 0; j < UNKNOWNS; j++)
        for (int i = j; i < UNKNOWNS; i++) {
            double sum = m->h[i][j];
            for (int k = 0; k < j; k++) sum -= m->h[i][k] * m->h[j][k];
            if (i == j && !(sum > 0)) return 0;
            m->h[i][j] = i == j ? sqrt(sum) : sum / m->h[j][j];
        }
    return 1;
}

// The step toward y z = center, minus the products dy dz of the predictor if `correct` is set.
static step solve(const newton *m, constraint_set set, double center, int correct) {
    double r[UNKNOWNS];
    for (int k = 0; k < UNKNOWNS; k++) r[k] = m->gradient[k];
    for (uint32_t i = 0; i < set.count; i++) {
        const constraint *c = &set.items[i];
        double g[UNKNOWNS], goal = center - (correct ? c->dy * c->dz : 0), q = (goal - c->y * c->miss) / c->z;
        get_gradient(c, g);
        for (int k = 0; k < UNKNOWNS; k++) r[k] -= g[k] * q;
    }
    for (int i = 0; i < UNKNOWNS; i++) {
        for (int k = 0; k < i; k++) r[i] -= m->h[i][k] * r[k];
        r[i] /= m->h[i][i];
    }
    for (int i = UNKNOWNS - 1; i >= 0; i--) {
        for (int k = i + 1; k < UNKNOWNS; k++) r[i] -= m->h[k][i] * r[k];
        r[i] /= m->h[i][i];
    }
    return (step){{r[0], r[1], r[2], r[3], r[4], r[5]}, {r[6], r[7], r[8]}};
}

// Computes the step of multipliers and slacks; returns the largest share of it, at most 1, that keeps them positive.
static double spread(constraint_set set, const step *d, double center, int correct) {
    double part = 1;
    for (uint32_t i = 0; i < set.count; i++) {
        constraint *c = &set.items[i];
        double goal = center - (correct ? c->dy * c->dz : 0);
        c->dz = c->miss - vec3_dot(c->w, sym3_mul_vec3(d->e, c->n)) - vec3_dot(c->n, d->x);
        c->dy = (goal - c->y * c->dz) / c->z - c->y;
        if (part * c->dz < -c->z) part = -c->z / c->dz;
        if (part * c->dy < -c->y) part = -c->y / c->dy;
    }
    return part;
}

// The sum of y z after that share of the step.
static double compute_gap(constraint_set set, double part) {
    double sum = 0;
    for (uint32_t i = 0; i < set.count; i++) {
        const constraint *c = &set.items[i];
        sum += (c->y + part * c->dy) * (c->z + part * c->dz);
    }
    return sum;
}

static int is_positive(sym3 e) {
    vec3 x;
    return sym3_solve(e, (vec3){0, 0, 0}, &x);
}

// Takes that share of the step; slacks are made exact again if that does not reduce them by much. 0 if only a tiny
// share leaves E positive definite.
static int move(inscribed *s, constraint_set set, const step *d, double part) {
    // E must stay positive definite, with a margin.
    sym3 e;
    do {
        e = sym3_add(s->e, sym3_scale(d->e, part));
        part *= 0.7;
    } while (part > 1e-10 && !is_positive(sym3_add(e, sym3_scale(s->e, -0.02))));
    part /= 0.7;
    if (!(part > 1e-9)) return 0;
    s->e = e;
    s->x = vec3_add_scaled(s->x, d->x, part);
    for (uint32_t i = 0; i < set.count; i++) {
        constraint *c = &set.items[i];
        c->y += part * c->dy;
        c->z += part * c->dz;
        c->dy = c->dz = 0;
        evaluate(c, s);
        if (c->miss > -0.5 * c->z) c->z += c->miss;
    }
    return 1;
}

// A small ball, slacks to match, and multipliers in proportion to their inverses: sum y |E n| = 3 at the optimum.
static inscribed start(constraint_set set) {
    double least = INFINITY, sum = 0;
    for (uint32_t i = 0; i < set.count; i++) least = fmin(least, set.items[i].b);
    double r = 0.7 * least;
    for (uint32_t i = 0; i < set.count; i++) {
        set.items[i].z = set.items[i].b - r;
        sum += 1 / set.items[i].z;
    }
    for (uint32_t i = 0; i < set.count; i++) {
        set.items[i].y = 3 / (r * sum * set.items[i].z);
        set.items[i].dy = set.items[i].dz = 0;
    }
    return (inscribed){.e = sym3_diagonal(r, r, r)};
}

inscribed inscribe_solve(constraint_set set, double gap) {
    inscribed s = start(set);
    s.gap = compute_gap(set, 0);
    while (s.iterations < 80 && s.gap > gap) {
        newton m;
        if (!prepare(&m, set, &s)) break;
        // Predictor: the length of its step decides how much centring is needed.
        step d = solve(&m, set, 0, 0);
        double part = spread(set, &d, 0, 0);
        double share = compute_gap(set, part) / s.gap;
        double center = share * share * share * s.gap / set.count;
        // Corrector.
        d = solve(&m, set, center, 1);
        part = spread(set, &d, center, 1);
        if (!move(&s, set, &d, fmin(1, 0.95 * part))) break;
        s.iterations++;
        s.gap = compute_gap(set, 0);
        if (!isfinite(s.gap)) break;
    }
    return s;
}
