// The design by Newton steps on its weights.
//
// In k dimensions let c and S be the weighted mean and covariance of the points, v_ij = 1 + (x_i - c)' S^-1 (x_j - c),
// and v_i = v_ii the variance of x_i: m = k + 1 is its weighted mean. The weights are optimal if and only if no point's
// variance exceeds m (J. Kiefer and J. Wolfowitz, The equivalence of two extremum problems, 1960). The logarithm of the
// determinant has the gradient v_i - m and the second derivatives -v_ij^2, so that its quadratic model at the weights w
// is, without a constant, sum (2 v_i - m) z_i - 1/2 sum v_ij^2 z_i z_j, over z >= 0. Where c = 0 and S is the identity,
// v_ij^2 = (1 + x_i . x_j)^2 is the inner product of vectors of ten entries: a program of qp.h, whose solution needs at
// most ten points (C. Caratheodory 1907). A step is that solution, or so much of it that the determinant grows.
//
// The steps work on a core set (P. Kumar and E. A. Yildirim, Minimum-volume enclosing ellipsoids and core sets, 2005):
// at first the point farthest out in each of 24 cells of directions, where the covariance of all points is a ball. Then
// all points are evaluated, the points with weight stay, and the worst point of each cell joins, until none is left.
#include "ellipsoid/design.h"

#include "ellipsoid/qp.h"
#include "ellipsoid/root.h"
#include "linear/both.h"

// Cells of directions; steps on one core set; rounds over all points.
enum { CELLS = 24, STEPS = 40, ROUNDS = 40, SUPPORT = 10 };

// Coordinates side by side. Behind an odd number of points stands one of weight zero.
typedef struct columns {
    double x[DESIGN_SUPPORT], y[DESIGN_SUPPORT], z[DESIGN_SUPPORT];
} columns;

static void set_column(columns *c, uint32_t i, vec3 v) { c->x[i] = v.x, c->y[i] = v.y, c->z[i] = v.z; }
static vec3 get_column(const columns *c, uint32_t i) { return (vec3){c->x[i], c->y[i], c->z[i]}; }
static both_vec3 load_columns(const columns *c, uint32_t i) {
    return (both_vec3){both_load(c->x + i), both_load(c->y + i), both_load(c->z + i)};
}
static void store_columns(columns *c, uint32_t i, both_vec3 v) {
    both_store(c->x + i, v.x), both_store(c->y + i, v.y), both_store(c->z + i, v.z);
}

// The points that the steps work on.
typedef struct core {
    double m; // rank + 1
    vec3 mean;
    sym3 covariance; // with ones on the diagonal beyond the rank
    lower3 inverse;  // of its root
    double excess;   // largest variance over m, less 1
    uint32_t count;
    uint32_t point[DESIGN_SUPPORT];
    double weight[DESIGN_SUPPORT];
    columns y; // coordinates
    columns u; // coordinates where mean and covariance are 0 and 1
    double variance[DESIGN_SUPPORT];
} core;

// One of 24 cells of directions: the signs, and the coordinate that is largest.
static int find_cell(vec3 y) { return vec3_find_largest(vec3_abs(y)) * 8 + (y.x < 0) + 2 * (y.y < 0) + 4 * (y.z < 0); }

// ---- Newton steps on the core set

static double add_both(both v) { return v[0] + v[1]; }

// weight: also one of zero behind an odd number.
static sym3 compute_covariance(const core *c, const double *weight, vec3 *mean) {
    both none = {0, 0}, total = none, xx = none, xy = none, xz = none, yy = none, yz = none, zz = none;
    both_vec3 sum = {none, none, none};
    for (uint32_t i = 0; i < c->count; i += 2) {
        both_vec3 y = load_columns(&c->y, i);
        both w = both_load(weight + i);
        total += w;
        sum = (both_vec3){sum.x + w * y.x, sum.y + w * y.y, sum.z + w * y.z};
    }
    double part = 1 / add_both(total);
    *mean = (vec3){add_both(sum.x) * part, add_both(sum.y) * part, add_both(sum.z) * part};
    for (uint32_t i = 0; i < c->count; i += 2) {
        both_vec3 d = both_vec3_sub(load_columns(&c->y, i), both_vec3_make(*mean, *mean));
        both w = both_load(weight + i), x = w * d.x, y = w * d.y;
        xx += x * d.x, xy += x * d.y, xz += x * d.z, yy += y * d.y, yz += y * d.z, zz += w * d.z * d.z;
    }
    sym3 s = {add_both(xx), add_both(xy), add_both(xz), add_both(yy), add_both(yz), add_both(zz)};
    return sym3_add(sym3_scale(s, part), sym3_diagonal(0, c->m < 3, c->m < 4));
}

// The point where mean and covariance are 0 and 1.
static both_vec3 map_two(const core *c, both_vec3 y) {
    lower3 l = c->inverse;
    both_vec3 d = both_vec3_sub(y, both_vec3_make(c->mean, c->mean));
    return (both_vec3){both_set(l.xx) * d.x, both_set(l.yx) * d.x + both_set(l.yy) * d.y,
                       (both_set(l.zx) * d.x + both_set(l.zy) * d.y) + both_set(l.zz) * d.z};
}

// Evaluates all points of the core set. 0 if the covariance has no root.
static int evaluate(core *c) {
    lower3 root;
    if (!lower3_make_root(c->covariance, &root)) return 0;
    c->inverse = lower3_inverse(root);
    double top = 0;
    for (uint32_t i = 0; i < c->count; i += 2) {
        both_vec3 u = map_two(c, load_columns(&c->y, i));
        both variance = both_set(1) + both_vec3_dot(u, u);
        store_columns(&c->u, i, u);
        both_store(c->variance + i, variance);
        top = max2(top, i + 1 < c->count ? max2(variance[0], variance[1]) : variance[0]);
    }
    c->excess = top / c->m - 1;
    return 1;
}

static void add_point(qp *q, const core *c, uint32_t i, double weight) {
    const double r = 1.4142135623730951;
    vec3 u = get_column(&c->u, i);
    const double row[QP_WIDTH] = {u.x * u.x, r * u.x * u.y, r * u.x * u.z, u.y * u.y, r * u.y * u.z,
                                  u.z * u.z, r * u.x,       r * u.y,       r * u.z,   1};
    for (int k = 0; k < QP_WIDTH; k++) q->row[q->count][k] = row[k];
    q->item[q->count] = i;
    q->c[q->count] = 2 * c->variance[i] - c->m;
    qp_add(q, weight);
}

// The points to begin with: those with weight, or the farthest if these are too many.
static void choose_support(const core *c, qp *q) {
    uint32_t weighted = 0, far[SUPPORT], count = 0;
    for (uint32_t i = 0; i < c->count; i++) weighted += c->weight[i] > 0;
    for (uint32_t i = 0; i < c->count && weighted <= SUPPORT; i++)
        if (c->weight[i] > 0) add_point(q, c, i, c->weight[i]);
    if (q->count) return;
    for (uint32_t i = 0; i < c->count; i++) {
        uint32_t k = count;
        if (k == SUPPORT && c->variance[i] <= c->variance[far[k - 1]]) continue;
        if (k == SUPPORT)
            k--;
        else
            count++;
        for (; k > 0 && c->variance[far[k - 1]] < c->variance[i]; k--) far[k] = far[k - 1];
        far[k] = i;
    }
    for (uint32_t k = 0; k < count; k++) add_point(q, c, far[k], 1.0 / count);
}

// The point outside of the program along which the model grows most, if by more than `least`; else the number of
// points.
static uint32_t find_steepest(const core *c, const qp *q, double least) {
    const double r = 1.4142135623730951;
    double s[QP_WIDTH] = {0};
    for (int i = 0; i < q->count; i++)
        for (int k = 0; k < QP_WIDTH; k++) s[k] += q->x[i] * q->row[i][k];
    uint32_t steepest = c->count;
    both xx = both_set(s[0]), xy = both_set(r * s[1]), xz = both_set(r * s[2]), yy = both_set(s[3]);
    both yz = both_set(r * s[4]), zz = both_set(s[5]), px = both_set(r * s[6]), py = both_set(r * s[7]);
    both pz = both_set(r * s[8]), rest = both_set(c->m + s[9]);
    for (uint32_t i = 0; i < c->count; i += 2) {
        both_vec3 u = load_columns(&c->u, i);
        both x = u.x * ((xx * u.x + xy * u.y) + (xz * u.z + px)), y = u.y * ((yy * u.y + yz * u.z) + py);
        both slope = both_set(2) * both_load(c->variance + i) - (((x + y) + u.z * (zz * u.z + pz)) + rest);
        for (uint32_t k = 0; k < 2 && i + k < c->count; k++)
            if (slope[k] > least && !qp_has(q, i + k)) least = slope[k], steepest = i + k;
    }
    return steepest;
}

// The weights that maximise the model, to about `least` in its slopes.
static void solve_model(const core *c, double least, double *weight) {
    qp q;
    qp_clear(&q);
    choose_support(c, &q);
    qp_settle(&q);
    for (int add = 0; add < 30 && q.count < QP_SIZE; add++) {
        uint32_t i = find_steepest(c, &q, least);
        if (i == c->count) break;
        add_point(&q, c, i, 0);
        qp_settle(&q);
    }
    if (least < 1e-10) qp_refine(&q);
    for (uint32_t i = 0; i < c->count; i++) weight[i] = 0;
    for (int k = 0; k < q.count; k++) weight[q.item[k]] = q.x[k];
}

// Moves the weights toward others, by the first of 1, 1/2, 1/4, ... of the way with which the determinant grows. Near
// the optimum the growth is below rounding, and a full step is taken.
static int move_weights(core *c, const double *goal) {
    double before = sym3_det(c->covariance) * (c->excess < 1e-5 ? 1 - 1e-13 : 1), next[DESIGN_SUPPORT + 1], part = 1;
    for (int trial = 0; trial < 8; trial++, part *= 0.5) {
        double total = 0;
        vec3 mean;
        next[c->count] = 0;
        for (uint32_t i = 0; i < c->count; i++) {
            next[i] = trial ? c->weight[i] + part * (goal[i] - c->weight[i]) : goal[i];
            total += next[i];
        }
        sym3 s = compute_covariance(c, next, &mean);
        if (!(sym3_det(s) > before)) continue;
        for (uint32_t i = 0; i < c->count; i++) c->weight[i] = next[i] / total;
        c->mean = mean;
        c->covariance = s;
        return 1;
    }
    return 0;
}

// Newton steps until the excess is small or there is no progress. 0 if the covariance has no root.
static int settle(core *c, double excess, uint32_t *steps) {
    double goal[DESIGN_SUPPORT];
    if (c->count % 2) {
        set_column(&c->y, c->count, get_column(&c->y, 0));
        c->weight[c->count] = 0;
    }
    c->covariance = compute_covariance(c, c->weight, &c->mean);
    for (int step = 0; step < STEPS; step++) {
        if (!evaluate(c)) return 0;
        if (c->excess <= excess) return 1;
        solve_model(c, 0.02 * c->excess + 0.01 * excess, goal);
        (*steps)++;
        if (!move_weights(c, goal)) return 1;
    }
    return evaluate(c);
}

// ---- all points

// Maps the points so that their covariance is a ball. 0 if it has no root; the mean is moved to 0 in any case.
static int whiten(design *d) {
    double part = 1.0 / d->point_count;
    vec3 mean = {0, 0, 0};
    sym3 s = sym3_diagonal(0, d->rank < 2, d->rank < 3);
    lower3 root;
    for (uint32_t i = 0; i < d->point_count; i++) mean = vec3_add(mean, vec3_at(d->local, i));
    mean = vec3_scale(mean, part);
    for (uint32_t i = 0; i < d->point_count; i++)
        s = sym3_add(s, sym3_outer(vec3_sub(vec3_at(d->local, i), mean), part));
    int solid = lower3_make_root(s, &root);
    lower3 inverse = solid ? lower3_inverse(root) : (lower3){1, 0, 1, 0, 0, 1};
    for (uint32_t i = 0; i < d->point_count; i++) {
        vec3 y = lower3_mul_vec3(inverse, vec3_sub(vec3_at(d->local, i), mean));
        d->local[3 * (size_t)i] = y.x, d->local[3 * (size_t)i + 1] = y.y, d->local[3 * (size_t)i + 2] = y.z;
    }
    return solid;
}

static void take_point(core *c, const design *d, uint32_t point) {
    c->point[c->count] = point;
    set_column(&c->y, c->count, vec3_at(d->local, point));
    c->weight[c->count++] = 0;
}

// The first core set, with equal weights: all points if they are few, else the farthest of each cell.
static void choose_core(core *c, const design *d) {
    double far[CELLS] = {0};
    uint32_t which[CELLS] = {0};
    for (uint32_t i = 0; i < d->point_count && d->point_count > CELLS; i++) {
        vec3 y = vec3_at(d->local, i);
        double size = vec3_norm_squared(y);
        int cell = find_cell(y);
        if (size > far[cell]) far[cell] = size, which[cell] = i;
    }
    for (uint32_t i = 0; i < d->point_count && d->point_count <= CELLS; i++) take_point(c, d, i);
    for (int cell = 0; cell < CELLS; cell++)
        if (far[cell] > 0) take_point(c, d, which[cell]);
    if (c->count == 0) take_point(c, d, 0);
    for (uint32_t i = 0; i < c->count; i++) c->weight[i] = 1.0 / c->count;
}

// Evaluates all points and adds the worst of each cell that exceeds the optimum by more than `least`. Returns the
// excess of the worst; *added: how many joined.
static double scan(core *c, const design *d, double least, uint32_t *added) {
    double worst[CELLS], top = 0;
    uint32_t which[CELLS] = {0}, kept = 0;
    for (int cell = 0; cell < CELLS; cell++) worst[cell] = c->m * (1 + least);
    for (uint32_t i = 0; i < d->point_count; i += 2) {
        uint32_t pair = d->point_count - i < 2 ? 1 : 2;
        both_vec3 u = map_two(c, both_vec3_make(vec3_at(d->local, i), vec3_at(d->local, i + pair - 1)));
        both variance = both_set(1) + both_vec3_dot(u, u);
        for (uint32_t k = 0; k < pair; k++) {
            top = max2(top, variance[k]);
            if (!(variance[k] > c->m)) continue;
            int cell = find_cell(both_vec3_get(u, (int)k));
            if (variance[k] > worst[cell]) worst[cell] = variance[k], which[cell] = i + k;
        }
    }
    for (uint32_t i = 0; i < c->count; i++) {
        if (!(c->weight[i] > 0)) continue;
        set_column(&c->y, kept, get_column(&c->y, i));
        c->point[kept] = c->point[i], c->weight[kept++] = c->weight[i];
    }
    c->count = kept;
    for (int cell = 0; cell < CELLS && c->count < DESIGN_SUPPORT; cell++) {
        int known = !(worst[cell] > c->m * (1 + least));
        for (uint32_t i = 0; i < kept && !known; i++) known = c->point[i] == which[cell];
        if (!known) take_point(c, d, which[cell]);
    }
    *added = c->count - kept;
    return top / c->m - 1;
}

// Rounds of steps on the core set and a scan of all points.
static int solve(core *c, design *d, double excess) {
    if (d->point_count <= CELLS) return settle(c, excess, &d->steps);
    double goal = 1e-2;
    for (int round = 0; round < ROUNDS; round++) {
        uint32_t added;
        if (!settle(c, max2(goal, 0.5 * excess), &d->steps)) return 0;
        double left = scan(c, d, 0.5 * excess, &added);
        if (left <= excess || (!added && goal <= 0.5 * excess)) break;
        goal = min2(goal, 0.02 * left);
    }
    return 1;
}

int design_solve(design *d, double excess) {
    int solid = whiten(d);
    core c;
    c.m = d->rank + 1.0, c.count = 0;
    choose_core(&c, d);
    solid = solid && solve(&c, d, excess);
    d->count = 0;
    for (uint32_t i = 0; i < c.count; i++) {
        if (!(c.weight[i] > 0)) continue;
        d->point[d->count] = c.point[i];
        d->weight[d->count++] = c.weight[i];
    }
    return solid;
}
