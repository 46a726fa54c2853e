// The maximum-volume inscribed ellipsoid { x + L u }:
//     maximise log det E  subject to  |E n_i| + n_i . x <= b_i
// over symmetric E and x, by sequential quadratic programming (R. B. Wilson, A simplicial algorithm for concave
// programming, 1963; S. P. Han, A globally convergent method for nonlinear programming, 1977). In each step the present
// ellipsoid is the unit ball, E = I + D, and x = p, both zero: the constraints are linearised to g' D g + g . p <= beta
// - 1, and the Lagrangian's second derivative, with multipliers y, is 2 |D|^2 - sum y (g' D g)^2; the centre has none,
// and gets a small one. The quadratic program in these nine unknowns is solved by its dual, in the multipliers y >= 0:
// a program of qp.h, whose unknowns are the few halfspaces that are touched. A step ends where the volume, after the
// ellipsoid is scaled to fit, no longer grows; so each ellipsoid is inside. The multipliers bound how much larger any
// other can be (certificate.c).
//
// With more than 64 halfspaces the steps work on a few of them, as cutting-plane methods do (J. E. Kelley, The
// cutting-plane method for solving convex programs, 1960): those that were touched, and from each cell of directions
// the one that the ellipsoid exceeds most. The result is not trusted: the caller proves what it returns.
#include "ellipsoid/inscribe.h"

#include "linear/both.h"

// Halfspaces at a time; cells of directions; steps; rounds; halfspaces to begin with; unknowns of D, and of D and p.
enum { WORKING = 64, CELLS = 24, STEPS = 40, ROUNDS = 40, FIRST = 6, FORM = 6, UNKNOWNS = 9 };

// The second derivative that the centre gets.
#define PROXIMAL 1e-3
#define ROOT_2 1.4142135623730951

// Normals and offsets, side by side. An odd number is made even by a plane at infinity.
typedef struct columns {
    double x[WORKING], y[WORKING], z[WORKING], offset[WORKING];
} columns;

typedef struct solver {
    const ovoid_plane *items[WORKING];
    uint32_t count;
    inscribed *s;
    double reach;                        // about the largest |u| of the body
    columns given, g;                    // the items; and where the ellipsoid is the unit ball
    sym3 second;                         // sum of y g g'
    double l[FORM][FORM], inverse[FORM]; // Cholesky of the second derivative in D
    double gradient[FORM];               // L^-1 of that of log det E
    double step[QP_WIDTH];               // D, its entries off the diagonal times the root of 2, and p
} solver;

static void gather(solver *w) {
    columns *c = &w->given;
    for (uint32_t i = 0; i < w->count + w->count % 2; i++) {
        const ovoid_plane *h = w->items[i < w->count ? i : 0];
        c->x[i] = h->normal.x, c->y[i] = h->normal.y, c->z[i] = h->normal.z;
        c->offset[i] = i < w->count ? h->offset : INFINITY;
    }
}

static vec3 get_normal(const solver *w, uint32_t i) { return (vec3){w->g.x[i], w->g.y[i], w->g.z[i]}; }

static both_vec3 load_normals(const columns *c, uint32_t i) {
    return (both_vec3){both_load(c->x + i), both_load(c->y + i), both_load(c->z + i)};
}

// l' n
static both_vec3 pull_back(lower3 l, both_vec3 n) {
    return (both_vec3){(both_set(l.xx) * n.x + both_set(l.yx) * n.y) + both_set(l.zx) * n.z,
                       both_set(l.yy) * n.y + both_set(l.zy) * n.z, both_set(l.zz) * n.z};
}

// Evaluates the halfspaces, and scales the ellipsoid until it meets the first. 0 if its centre is outside.
static int evaluate(solver *w) {
    inscribed *s = w->s;
    both_vec3 center = both_vec3_make(s->x, s->x);
    double least = INFINITY;
    for (uint32_t i = 0; i < w->count; i += 2) {
        both_vec3 n = load_normals(&w->given, i), g = pull_back(s->map, n);
        both square = both_vec3_dot(g, g), part = both_set(1) / both_make(sqrt(square[0]), sqrt(square[1]));
        both beta = (both_load(w->given.offset + i) - both_vec3_dot(n, center)) * part;
        both_store(w->g.x + i, g.x * part), both_store(w->g.y + i, g.y * part), both_store(w->g.z + i, g.z * part);
        both_store(w->g.offset + i, beta);
        if (!(beta[0] >= least)) least = beta[0];
        if (!(beta[1] >= least)) least = beta[1];
    }
    if (!(least > 0 && isfinite(least))) return 0;
    s->map = lower3_scale(s->map, least);
    for (uint32_t i = 0; i < w->count; i += 2)
        both_store(w->g.offset + i, both_load(w->g.offset + i) * both_set(1 / least));
    return 1;
}

// The gap that the multipliers show, and w->second.
static double compute_gap(solver *w) {
    const inscribed *s = w->s;
    vec3 first = {0, 0, 0};
    double sum = 0;
    w->second = (sym3){0, 0, 0, 0, 0, 0};
    for (int k = 0; k < s->count; k++) {
        vec3 g = get_normal(w, s->item[k]);
        w->second = sym3_add(w->second, sym3_outer(g, s->weight[k]));
        first = vec3_add_scaled(first, g, s->weight[k]);
        sum += s->weight[k] * w->g.offset[s->item[k]];
    }
    double third = (sum + vec3_norm(first) * w->reach) / 3, det = sym3_det(w->second);
    return s->count && det > 0 ? third * third * third / det - 1 : INFINITY;
}

// The gradient of a linearised constraint in the nine unknowns.
static void fill_gradient(vec3 g, double a[UNKNOWNS]) {
    a[0] = g.x * g.x, a[1] = ROOT_2 * g.x * g.y, a[2] = ROOT_2 * g.x * g.z;
    a[3] = g.y * g.y, a[4] = ROOT_2 * g.y * g.z, a[5] = g.z * g.z;
    a[6] = g.x, a[7] = g.y, a[8] = g.z;
}

// x = l^-1 x
static void solve_lower(const solver *w, double x[FORM]) {
    for (int i = 0; i < FORM; i++) {
        for (int k = 0; k < i; k++) x[i] -= w->l[i][k] * x[k];
        x[i] *= w->inverse[i];
    }
}

// x = l'^-1 x
static void solve_upper(const solver *w, double x[FORM]) {
    for (int i = FORM - 1; i >= 0; i--) {
        for (int k = i + 1; k < FORM; k++) x[i] -= w->l[k][i] * x[k];
        x[i] *= w->inverse[i];
    }
}

// The second derivative in D, factored. The multipliers are reduced so that the sum of y g g' is at most the identity,
// which leaves at least |D|^2 of it. Without any, about what is left at the end.
static int factor_second(solver *w) {
    const inscribed *s = w->s;
    sym3 p = w->second;
    double rows = max2((fabs(p.xx) + fabs(p.xy)) + fabs(p.xz),
                       max2((fabs(p.xy) + fabs(p.yy)) + fabs(p.yz), (fabs(p.xz) + fabs(p.yz)) + fabs(p.zz)));
    double part = 1 / max2(1, rows), (*l)[FORM] = w->l;
    for (int i = 0; i < FORM; i++)
        for (int j = 0; j < FORM; j++) l[i][j] = i == j ? (s->count ? 2 : 1.6) : 0;
    for (int k = 0; k < s->count; k++) {
        double a[UNKNOWNS];
        fill_gradient(get_normal(w, s->item[k]), a);
        // Two at a time: one entry beyond the diagonal is never read.
        for (int i = 0; i < FORM; i++)
            for (int j = 0; j <= i; j += 2)
                both_store(l[i] + j, both_load(l[i] + j) - both_set(s->weight[k] * part * a[i]) * both_load(a + j));
    }
    for (int j = 0; j < FORM; j++) {
        for (int k = 0; k < j; k++) l[j][j] -= l[j][k] * l[j][k];
        if (!(l[j][j] > 1e-9)) return 0;
        l[j][j] = sqrt(l[j][j]);
        w->inverse[j] = 1 / l[j][j];
        for (int i = j + 1; i < FORM; i++) {
            for (int k = 0; k < j; k++) l[i][j] -= l[i][k] * l[j][k];
            l[i][j] *= w->inverse[j];
        }
    }
    const double identity[FORM] = {1, 0, 0, 1, 0, 1};
    for (int i = 0; i < FORM; i++) w->gradient[i] = identity[i];
    solve_lower(w, w->gradient);
    return 1;
}

// Adds a halfspace to the dual program.
static void add_halfspace(const solver *w, qp *q, uint32_t i, double weight) {
    double *row = q->row[q->count], c = 1 - w->g.offset[i];
    fill_gradient(get_normal(w, i), row);
    solve_lower(w, row);
    for (int k = 0; k < FORM; k++) c += row[k] * w->gradient[k];
    for (int k = FORM; k < UNKNOWNS; k++) row[k] *= 1 / sqrt(PROXIMAL);
    row[QP_WIDTH - 1] = 0;
    q->item[q->count] = i;
    q->c[q->count] = c;
    qp_add(q, weight);
}

// The halfspaces to begin with: those of the last multipliers, or the nearest.
static void choose_first(const solver *w, qp *q) {
    for (int k = 0; k < w->s->count; k++) add_halfspace(w, q, w->s->item[k], w->s->weight[k]);
    if (q->count) return;
    uint32_t near[FIRST], count = 0;
    for (uint32_t i = 0; i < w->count; i++) {
        uint32_t k = count;
        if (k == FIRST && w->g.offset[i] >= w->g.offset[near[k - 1]]) continue;
        if (k == FIRST)
            k--;
        else
            count++;
        for (; k > 0 && w->g.offset[near[k - 1]] > w->g.offset[i]; k--) near[k] = near[k - 1];
        near[k] = i;
    }
    for (uint32_t k = 0; k < count; k++) add_halfspace(w, q, near[k], 3.0 / count);
}

// The step that belongs to the multipliers: H^-1 (gradient of log det E - sum y a).
static void compute_step(solver *w, const qp *q) {
    double *d = w->step;
    // The rows of the program are L^-1 a; the last entry is none.
    both sum[QP_WIDTH / 2];
    for (int i = 0; i < QP_WIDTH / 2; i++) sum[i] = 2 * i < FORM ? both_load(w->gradient + 2 * i) : both_make(0, 0);
    for (int k = 0; k < q->count; k++)
        for (int i = 0; i < QP_WIDTH / 2; i++) sum[i] -= both_load(q->row[k] + 2 * i) * both_make(q->x[k], q->x[k]);
    for (int i = 0; i < QP_WIDTH / 2; i++) both_store(d + 2 * i, sum[i]);
    solve_upper(w, d);
    for (int i = FORM; i < UNKNOWNS; i++) d[i] *= 1 / sqrt(PROXIMAL);
}

// The halfspace outside of the program whose linearised constraint the step violates most, if by more than `least`;
// else their number.
static uint32_t find_violated(const solver *w, const qp *q, double least) {
    const double *d = w->step;
    both xx = both_set(d[0]), xy = both_set(ROOT_2 * d[1]), xz = both_set(ROOT_2 * d[2]), yy = both_set(d[3]);
    both yz = both_set(ROOT_2 * d[4]), zz = both_set(d[5]), one = both_set(1);
    both px = both_set(d[6]), py = both_set(d[7]), pz = both_set(d[8]);
    uint32_t worst = w->count;
    for (uint32_t i = 0; i < w->count; i += 2) {
        both_vec3 g = load_normals(&w->g, i);
        both x = g.x * ((xx * g.x + xy * g.y) + (xz * g.z + px)), y = g.y * ((yy * g.y + yz * g.z) + py);
        both out = (x + y) + (g.z * (zz * g.z + pz) - (both_load(w->g.offset + i) - one));
        for (uint32_t k = 0; k < 2; k++)
            if (out[k] > least && !qp_has(q, i + k)) least = out[k], worst = i + k;
    }
    return worst;
}

// The step and its multipliers.
static void solve_model(solver *w, double least) {
    qp q;
    qp_clear(&q);
    choose_first(w, &q);
    qp_settle(&q);
    for (int add = 0; add < STEPS; add++) {
        compute_step(w, &q);
        uint32_t i = find_violated(w, &q, least);
        if (i == w->count || q.count == QP_SIZE) break;
        add_halfspace(w, &q, i, 0);
        qp_settle(&q);
    }
    // Without this the ridge moves the constraints by some 1e-8.
    if (least < 1e-10) {
        qp_refine(&q);
        compute_step(w, &q);
    }
    w->s->count = q.count;
    for (int k = 0; k < q.count; k++) w->s->item[k] = q.item[k], w->s->weight[k] = q.x[k];
}

// The square of the factor by which { p + (I + D) u } must be scaled to fit.
static double compute_fit(const solver *w, sym3 e, vec3 p) {
    both_vec3 at = both_vec3_make(p, p);
    both xx = both_set(e.xx), xy = both_set(e.xy), xz = both_set(e.xz), yy = both_set(e.yy), yz = both_set(e.yz);
    both zz = both_set(e.zz);
    double least = INFINITY;
    for (uint32_t i = 0; i < w->count; i += 2) {
        both_vec3 g = load_normals(&w->g, i);
        both_vec3 u = {(xx * g.x + xy * g.y) + xz * g.z, (xy * g.x + yy * g.y) + yz * g.z,
                       (xz * g.x + yz * g.y) + zz * g.z};
        both room = both_load(w->g.offset + i) - both_vec3_dot(g, at), square = both_vec3_dot(u, u), all = room * room;
        for (int k = 0; k < 2; k++) {
            if (!(room[k] > 0)) return 0;
            if (all[k] < least * square[k]) least = all[k] / square[k];
        }
    }
    return least;
}

// Takes the first of 1, 1/2, 1/4, ... of the step with which the volume grows; near the optimum the growth is below
// rounding. 0 if there is none.
static int move(solver *w) {
    const double *d = w->step;
    double part = 1;
    for (int trial = 0; trial < 12; trial++, part *= 0.5) {
        sym3 e = {1 + part * d[0], part * d[1] / ROOT_2, part * d[2] / ROOT_2,
                  1 + part * d[3], part * d[4] / ROOT_2, 1 + part * d[5]};
        vec3 p = {part * d[6], part * d[7], part * d[8]};
        double det = sym3_det(e);
        if (!(det > 0 && e.xx > 0 && e.xx * e.yy > e.xy * e.xy)) continue;
        double fit = compute_fit(w, e, p);
        if (!(det * fit * sqrt(fit) > (w->s->gap < 1e-5 ? 1 - 1e-12 : 1))) continue;
        // L (I + D) as a lower triangular matrix times a rotation.
        sym3 squared = {(e.xx * e.xx + e.xy * e.xy) + e.xz * e.xz, (e.xx * e.xy + e.xy * e.yy) + e.xz * e.yz,
                        (e.xx * e.xz + e.xy * e.yz) + e.xz * e.zz, (e.xy * e.xy + e.yy * e.yy) + e.yz * e.yz,
                        (e.xy * e.xz + e.yy * e.yz) + e.yz * e.zz, (e.xz * e.xz + e.yz * e.yz) + e.zz * e.zz};
        lower3 root;
        if (!lower3_make_root(squared, &root)) return 0;
        w->s->x = vec3_add(w->s->x, lower3_mul_vec3(w->s->map, p));
        w->s->map = lower3_mul(w->s->map, root);
        return 1;
    }
    return 0;
}

// Steps on the solver's halfspaces until the gap is small, or there is no progress. 0 if the centre is outside.
static int settle(solver *w, double gap) {
    inscribed *s = w->s;
    gather(w);
    for (int step = 0; step < STEPS; step++) {
        if (!evaluate(w)) return 0;
        s->gap = compute_gap(w);
        if (s->gap <= gap || !factor_second(w)) return 1;
        solve_model(w, max2(1e-3 * gap, 1e-14));
        s->iterations++;
        // The new multipliers may show that the present ellipsoid is good enough.
        s->gap = min2(s->gap, compute_gap(w));
        if (s->gap <= gap || !move(w)) return 1;
    }
    return evaluate(w);
}

// ---- many halfspaces

// One of 24 cells of directions: the coordinate that is largest and its sign, and the signs of the others over it.
static int find_cell(vec3 n) {
    int axis = vec3_find_largest(vec3_abs(n));
    const double of[5] = {n.x, n.y, n.z, n.x, n.y}, *most = of + axis;
    return axis * 8 + (most[0] < 0) * 4 + (most[1] * most[0] > 0) + 2 * (most[2] * most[0] > 0);
}

// The least room of all halfspaces, in units of the ellipsoid's reach; from each cell the halfspace of least room below
// `most`: -1 if there is none.
static double find_tightest(halfspace_set set, const inscribed *s, double most, int64_t which[CELLS]) {
    double tightest = INFINITY, worst[CELLS];
    both_vec3 center = both_vec3_make(s->x, s->x);
    for (int cell = 0; cell < CELLS; cell++) worst[cell] = most, which[cell] = -1;
    for (uint32_t i = 0; i < set.count; i += 2) {
        uint32_t pair = set.count - i < 2 ? 1 : 2;
        const ovoid_plane *h = &set.items[i], *next = h + (pair - 1);
        both_vec3 n = both_vec3_make(h->normal, next->normal), g = pull_back(s->map, n);
        both room = both_make(h->offset, next->offset) - both_vec3_dot(n, center), square = both_vec3_dot(g, g);
        for (uint32_t k = 0; k < pair; k++) {
            double beta = room[k] / sqrt(square[k]);
            if (!(beta >= tightest)) tightest = beta;
            if (!(beta < most)) continue;
            int cell = find_cell(h[k].normal);
            if (beta < worst[cell]) worst[cell] = beta, which[cell] = i + k;
        }
    }
    return tightest;
}

// Keeps the halfspaces that were touched, and adds the chosen ones.
static void choose_working(halfspace_set set, solver *w, const int64_t which[CELLS]) {
    const ovoid_plane *kept[QP_SIZE];
    uint32_t before = (uint32_t)w->s->count;
    for (uint32_t k = 0; k < before; k++) kept[k] = w->items[w->s->item[k]], w->s->item[k] = k;
    for (uint32_t k = 0; k < before; k++) w->items[k] = kept[k];
    w->count = before;
    for (int cell = 0; cell < CELLS; cell++) {
        const ovoid_plane *h = which[cell] >= 0 ? set.items + which[cell] : NULL;
        for (uint32_t k = 0; k < before && h; k++)
            if (w->items[k] == h) h = NULL;
        if (h) w->items[w->count++] = h;
    }
}

static double compute_content(const inscribed *s) { return s->map.xx * s->map.yy * s->map.zz; }

// Rounds of steps on the working set and a pass over all halfspaces, from an ellipsoid inside. An ellipsoid whose
// centre is outside of a halfspace is given up for the last one that was inside.
static void solve_many(halfspace_set set, solver *w, double gap) {
    inscribed *s = w->s, inside = *s;
    double goal = max2(1e-2, gap), slack = 0.1 * gap;
    int64_t which[CELLS];
    (void)find_tightest(set, s, INFINITY, which);
    for (int round = 0; round < ROUNDS; round++) {
        choose_working(set, w, which);
        if (!settle(w, goal)) break;
        double tightest = find_tightest(set, s, 1 - slack, which), fit = min2(tightest, 1);
        if (fit > 0 && compute_content(s) * (fit * fit * fit) >= compute_content(&inside)) {
            inside = *s;
            inside.map = lower3_scale(s->map, fit);
        }
        int is_inside = tightest >= 1 - slack;
        if (goal <= gap && is_inside) break;
        goal = is_inside ? gap : max2(min2(goal, 0.1 * (1 - tightest)), gap);
        if (!(tightest > 0)) s->map = inside.map, s->x = inside.x;
    }
    s->map = inside.map, s->x = inside.x;
    for (int k = 0; k < s->count; k++) s->item[k] = (uint32_t)(w->items[s->item[k]] - set.items);
}

inscribed inscribe_solve(halfspace_set set, double gap) {
    double least = INFINITY;
    for (uint32_t i = 0; i < set.count; i++) least = min2(least, set.items[i].offset);
    inscribed s = {.map = {least, 0, least, 0, 0, least}, .gap = INFINITY};
    // From the ball the body reaches about twice the whole unit.
    solver w;
    w.s = &s, w.count = 0, w.reach = 2.2 / least;
    if (set.count > WORKING)
        solve_many(set, &w, gap);
    else {
        for (uint32_t i = 0; i < set.count; i++) w.items[w.count++] = set.items + i;
        (void)settle(&w, gap);
    }
    return s;
}
