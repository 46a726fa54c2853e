// The design by exchanges of weight.
//
// In k dimensions let c and S be the weighted mean and covariance of the points, and v(x) = 1 + (x - c)' S^-1 (x - c)
// the variance of x: m = k + 1 is its weighted mean. The weights are optimal if and only if no point's variance
// exceeds m (Kiefer and Wolfowitz 1960). A step moves weight from a point of small variance that carries some to one of
// large variance, by the best amount: with weight t moved from l to h the determinant of the moment matrix changes by
// the factor 1 + t (v_h - v_l) - t^2 (v_h v_l - v_hl^2). Away steps: M. J. Todd and E. A. Yildirim, On Khachiyan's
// algorithm for the computation of minimum-volume enclosing ellipsoids, 2007; exchanges of pairs: D. Boehning, A
// vertex-exchange-method in D-optimal design theory, 1986. They converge linearly: S. D. Ahipasaoglu, P. Sun, M. J.
// Todd, Linear convergence of a modified Frank-Wolfe algorithm for computing minimum-volume enclosing ellipsoids, 2008.
//
// If exchanges converge slowly, since the optimum is flat in the weights, the weight is moved to ten points of the same
// covariance, and Newton steps on the weighted points follow.
//
// The steps work on a few points at a time. Then all points are evaluated, the worst of each cell of directions join,
// and points that cannot carry weight at the optimum are dropped for good: R. Harman and L. Pronzato, Improvements on
// removing nonoptimal support points in D-optimum design algorithms, 2007. Start: P. Kumar and E. A. Yildirim,
// Minimum-volume enclosing ellipsoids and core sets, 2005.
// Cost: about ten evaluations of all points, and some hundred steps of the cost of a few dozen points each; at most 200
// and 600 000.
// and 600 000.
#include "ellipsoid/design.h"

#include "ellipsoid/certificate.h"

// The largest number of weights for Newton steps.
enum { POLISHED = 32 };

// The points with the smallest and the largest n . x.
static void find_extremes(const ovoid_polytope *p, vec3 n, uint32_t extreme[2]) {
    double low = INFINITY, high = -INFINITY;
    for (uint32_t i = 0; i < p->vertex_count; i++) {
        double x = vec3_dot(n, vec3_at(p->vertices, i));
        if (x < low) low = x, extreme[0] = i;
        if (x > high) high = x, extreme[1] = i;
    }
}

// b minus its part along the unit vector a, subtracted twice, so that rounding leaves nothing of it.
static vec3 reject(vec3 b, vec3 a) {
    b = vec3_add_scaled(b, a, -vec3_dot(a, b));
    return vec3_add_scaled(b, a, -vec3_dot(a, b));
}

// The unit direction from the line through `origin` along a to the vertex that is farthest from it.
static vec3 find_across(const ovoid_polytope *p, vec3 origin, vec3 a) {
    vec3 best = {0, 0, 0};
    double most = 0;
    for (uint32_t i = 0; i < p->vertex_count; i++) {
        vec3 d = reject(vec3_sub(vec3_at(p->vertices, i), origin), a);
        double size = vec3_max_abs(d);
        if (size > most) most = size, best = d;
    }
    return most > 0 ? vec3_unit(reject(vec3_unit(best), a)) : vec3_orthogonal(a);
}

// Half of the extent of the vertices along a (1 if there is none), and the middle.
static double measure(const ovoid_polytope *p, vec3 origin, vec3 a, double *middle) {
    double low = INFINITY, high = -INFINITY;
    for (uint32_t i = 0; i < p->vertex_count; i++) {
        double x = vec3_dot(a, vec3_sub(vec3_at(p->vertices, i), origin));
        low = fmin(low, x);
        high = fmax(high, x);
    }
    *middle = low + (high - low) / 2;
    return high > low ? (high - low) / 2 : 1;
}

frame frame_compute(const ovoid_polytope *p, uint32_t rank) {
    frame f = {.rank = rank};
    const double *vertices = p->vertices;
    // The longest extent along a coordinate gives the first axis.
    double most = -1;
    for (int i = 0; i < 3; i++) {
        uint32_t extreme[2] = {0, 0};
        vec3 n = {i == 0, i == 1, i == 2};
        find_extremes(p, n, extreme);
        double size = vec3_dot(n, vec3_sub(vec3_at(vertices, extreme[1]), vec3_at(vertices, extreme[0])));
        if (size > most) most = size, f.extreme[0] = extreme[0], f.extreme[1] = extreme[1];
    }
    vec3 end = vec3_at(vertices, f.extreme[0]), along = vec3_unit(vec3_sub(vec3_at(vertices, f.extreme[1]), end));
    // Across it, toward the farthest vertex; then across both differences found.
    vec3 across = find_across(p, end, along), normal = vec3_cross(along, across);
    if (rank >= 2) {
        find_extremes(p, across, f.extreme + 2);
        vec3 second = vec3_sub(vec3_at(vertices, f.extreme[3]), vec3_at(vertices, f.extreme[2]));
        normal = vec3_unit(reject(vec3_cross(along, vec3_unit(reject(second, along))), along));
    }
    if (rank >= 3) find_extremes(p, normal, f.extreme + 4);
    f.axes = (mat3){along, vec3_cross(normal, along), normal};
    // The box.
    vec3 middle = {0, 0, 0};
    f.half.x = f.half.y = f.half.z = measure(p, end, f.axes.r0, &middle.x);
    if (rank >= 2) f.half.y = measure(p, end, f.axes.r1, &middle.y);
    if (rank >= 3) f.half.z = measure(p, end, f.axes.r2, &middle.z);
    f.origin = vec3_add(end, mat3_mul_transposed_vec3(f.axes, middle));
    return f;
}

vec3 frame_compute_local(const frame *f, vec3 x) {
    vec3 y = mat3_mul_vec3(f->axes, vec3_sub(x, f->origin));
    return (vec3){y.x / f->half.x, f->rank >= 2 ? y.y / f->half.y : 0, f->rank >= 3 ? y.z / f->half.z : 0};
}

static double compute_variance(const design *d, vec3 y) { return 1 + sym3_quadratic(d->inverse, vec3_sub(y, d->mean)); }

// Mean and inverse covariance of the weighted points; 0 if the covariance is not positive definite in doubles.
static int evaluate(design *d) {
    double total = 0;
    vec3 mean = {0, 0, 0};
    for (uint32_t i = 0; i < d->count; i++) {
        total += d->weight[i];
        mean = vec3_add_scaled(mean, vec3_at(d->local, d->point[i]), d->weight[i]);
    }
    mean = vec3_scale(mean, 1 / total);
    sym3 s = sym3_diagonal(0, d->rank < 2, d->rank < 3);
    for (uint32_t i = 0; i < d->count; i++)
        s = sym3_add(s, sym3_outer(vec3_sub(vec3_at(d->local, d->point[i]), mean), d->weight[i] / total));
    vec3 x;
    if (!sym3_solve(s, (vec3){1, 1, 1}, &x) || !(sym3_det(s) > 1e-30)) return 0;
    d->mean = mean;
    d->inverse = sym3_inverse(s);
    for (uint32_t i = 0; i < d->count; i++) d->variance[i] = compute_variance(d, vec3_at(d->local, d->point[i]));
    return 1;
}

// Moves weight from the weighted point of least variance to the point of largest variance. 0, without a move, if the
// largest excess is small enough.
static int exchange(design *d, double excess) {
    uint32_t low = 0, high = 0;
    for (uint32_t i = 0; i < d->count; i++) {
        if (d->variance[i] > d->variance[high]) high = i;
        if (d->weight[i] > 0 && (d->weight[low] == 0 || d->variance[i] < d->variance[low])) low = i;
    }
    double h = d->variance[high], l = d->variance[low];
    if (h <= (d->rank + 1) * (1 + excess)) return 0;
    vec3 a = vec3_sub(vec3_at(d->local, d->point[high]), d->mean);
    vec3 b = vec3_sub(vec3_at(d->local, d->point[low]), d->mean);
    double both = 1 + vec3_dot(a, sym3_mul_vec3(d->inverse, b)), curve = 2 * (h * l - both * both);
    double step = h - l < curve * d->weight[low] ? (h - l) / curve : d->weight[low];
    d->weight[high] += step;
    d->weight[low] = step < d->weight[low] ? d->weight[low] - step : 0;
    d->steps++;
    return 1;
}

// The Newton step of the weights that are not zero, for the logarithm of the determinant: its second derivative is
// minus the squares of v_ij, its first v_i. A trace of the identity is added, since more than (k + 1)(k + 2) / 2
// weights are not unique.
static int compute_newton_step(const design *d, const uint32_t *index, uint32_t n, double step[POLISHED]) {
    double a[POLISHED][POLISHED], p[POLISHED], q[POLISHED], sum_p = 0, sum_q = 0;
    for (uint32_t i = 0; i < n; i++) {
        vec3 x = vec3_sub(vec3_at(d->local, d->point[index[i]]), d->mean), hx = sym3_mul_vec3(d->inverse, x);
        for (uint32_t j = 0; j <= i; j++) {
            double v = 1 + vec3_dot(hx, vec3_sub(vec3_at(d->local, d->point[index[j]]), d->mean));
            a[i][j] = v * v;
        }
        a[i][i] *= 1 + 1e-12;
        p[i] = d->variance[index[i]], q[i] = 1;
    }
    // Cholesky, and both right sides forward, then back.
    for (uint32_t i = 0; i < n; i++) {
        for (uint32_t j = 0; j <= i; j++) {
            for (uint32_t k = 0; k < j; k++) a[i][j] -= a[i][k] * a[j][k];
            if (i == j && !(a[i][i] > 0)) return 0;
            a[i][j] = i == j ? sqrt(a[i][i]) : a[i][j] / a[j][j];
        }
        for (uint32_t k = 0; k < i; k++) p[i] -= a[i][k] * p[k], q[i] -= a[i][k] * q[k];
        p[i] /= a[i][i], q[i] /= a[i][i];
    }
    for (uint32_t i = n; i-- > 0;) {
        for (uint32_t k = i + 1; k < n; k++) p[i] -= a[k][i] * p[k], q[i] -= a[k][i] * q[k];
        p[i] /= a[i][i], q[i] /= a[i][i];
        sum_p += p[i], sum_q += q[i];
    }
    // The step leaves the sum of the weights unchanged.
    for (uint32_t i = 0; i < n; i++) step[i] = p[i] - sum_p / sum_q * q[i];
    return 1;
}

// Moves weight among the points, with mean and covariance unchanged, until at most ten carry any; ten are enough (C.
// Caratheodory 1907). Otherwise exchanges spread the weight over ever more points if many are nearly as far out.
static void reduce(design *d) {
    certificate c = {0};
    for (uint32_t i = 0; i < d->count; i++)
        if (d->weight[i] > 0) certificate_add(&c, i, d->weight[i], vec3_at(d->local, d->point[i]), 1);
    for (uint32_t i = 0; i < d->count; i++) d->weight[i] = 0;
    for (int i = 0; i < c.count; i++) d->weight[c.halfspace[i]] = c.weight[i];
}

static uint32_t count_weighted(const design *d) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < d->count; i++) count += d->weight[i] > 0;
    return count;
}

// Newton steps on the weights that are not zero, as long as the determinant grows; if a weight would turn negative the
// step ends at zero. For optima so flat in the weights that exchanges are slow.
static int polish(design *d, double excess) {
    for (int iteration = 0; iteration < 20; iteration++) {
        uint32_t index[POLISHED], n = 0, gone = UINT32_MAX;
        double step[POLISHED], before[POLISHED], top = 0, part = 1, content = sym3_det(d->inverse);
        for (uint32_t i = 0; i < d->count; i++) {
            if (!(d->weight[i] > 0)) continue;
            if (n == POLISHED) return 1;
            before[n] = d->weight[i];
            index[n++] = i;
            top = fmax(top, d->variance[i]);
        }
        if (top <= (d->rank + 1) * (1 + excess) || !compute_newton_step(d, index, n, step)) return 1;
        for (uint32_t i = 0; i < n; i++)
            if (part * step[i] < -before[i]) part = -before[i] / step[i], gone = index[i];
        for (uint32_t i = 0; i < n; i++) d->weight[index[i]] = fmax(before[i] + part * step[i], 0);
        if (gone != UINT32_MAX) d->weight[gone] = 0;
        d->steps++;
        if (evaluate(d) && sym3_det(d->inverse) <= content) continue;
        for (uint32_t i = 0; i < n; i++) d->weight[index[i]] = before[i];
        return evaluate(d);
    }
    return 1;
}

// Steps among the design's points until their excess is small; then drops those without weight.
static int settle(design *d, double excess) {
    int defined = evaluate(d);
    for (int i = 1; i < 3000 && defined && exchange(d, excess); i++) {
        defined = evaluate(d);
        if (i % (i < 100 ? 100 : 20) || !defined) continue;
        if (count_weighted(d) > POLISHED) reduce(d), defined = evaluate(d);
        if (defined) defined = polish(d, 0.5 * excess);
    }
    uint32_t count = 0;
    for (uint32_t i = 0; i < d->count; i++)
        if (d->weight[i] > 0) d->point[count] = d->point[i], d->weight[count++] = d->weight[i];
    d->count = count;
    return defined;
}

// One of 24 cells of directions: the signs, and the coordinate that is largest.
static int find_cell(vec3 y) {
    double x = fabs(y.x), a = fabs(y.y), z = fabs(y.z);
    int axis = x >= a && x >= z ? 0 : a >= z ? 1 : 2;
    return axis * 8 + (y.x < 0) + 2 * (y.y < 0) + 4 * (y.z < 0);
}

static int is_weighted(const design *d, uint32_t point) {
    for (uint32_t i = 0; i < d->count; i++)
        if (d->point[i] == point) return 1;
    return 0;
}

// The candidate of largest variance in each cell; returns the largest of all. worst is -infinity in cells without any.
static double find_worst(const design *d, double worst[24], uint32_t which[24]) {
    double top = 0;
    for (int cell = 0; cell < 24; cell++) worst[cell] = -INFINITY;
    for (uint32_t i = 0; i < d->candidate_count; i++) {
        vec3 y = vec3_at(d->local, d->candidate[i]);
        double v = compute_variance(d, y);
        int cell = find_cell(vec3_sub(y, d->mean));
        if (v > worst[cell]) worst[cell] = v, which[cell] = d->candidate[i];
        top = fmax(top, v);
    }
    return top;
}

// Evaluates all candidates, drops those that cannot matter, and adds the worst of each cell. 0 if none was added.
static int scan(design *d) {
    double m = d->rank + 1, worst[24];
    uint32_t which[24];
    double top = find_worst(d, worst, which);
    d->excess = top / m - 1;
    // Every point that carries weight at the optimum has at least this variance (Harman and Pronzato).
    double e = fmax(top - m, 0), least = m * (1 + e / 2 - sqrt(e * (4 + e - 4 / m)) / 2) - 1e-9;
    uint32_t kept = 0;
    for (uint32_t i = 0; i < d->candidate_count; i++)
        if (compute_variance(d, vec3_at(d->local, d->candidate[i])) >= least) d->candidate[kept++] = d->candidate[i];
    d->candidate_count = kept;
    int added = 0;
    for (int cell = 0; cell < 24; cell++) {
        if (worst[cell] <= m || d->count == DESIGN_SUPPORT || is_weighted(d, which[cell])) continue;
        d->point[d->count] = which[cell];
        d->weight[d->count++] = 0;
        added = 1;
    }
    return added;
}

static void add_weight(design *d, uint32_t point, double weight) {
    if (is_weighted(d, point)) return;
    d->point[d->count] = point;
    d->weight[d->count++] = weight;
}

// Adds for each cell the point farthest out in the space where `near` is a ball, if it is within a tenth of the
// farthest of all: most points that carry weight at the optimum are among these.
static void add_near(design *d, const frame *f) {
    const vec3 part = {1 / f->half.x, 1 / f->half.y, 1 / f->half.z};
    mat3 map = {vec3_scale(f->axes.r0, part.x), vec3_scale(f->axes.r1, part.y), vec3_scale(f->axes.r2, part.z)};
    sym3 q = sym3_rotate(d->near->q, map);
    vec3 x;
    if (f->rank < 3 || !sym3_solve(q, (vec3){1, 1, 1}, &x)) return;
    d->inverse = sym3_inverse(q);
    d->mean = mat3_mul_vec3(map, vec3_sub(d->near->center, f->origin));
    double worst[24], top;
    uint32_t which[24], count = 0;
    top = find_worst(d, worst, which);
    for (int cell = 0; cell < 24; cell++) count += worst[cell] > 0.9 * top;
    for (int cell = 0; cell < 24; cell++)
        if (worst[cell] > 0.9 * top) add_weight(d, which[cell], 0.9 / count);
}

void design_solve(design *d, const frame *f, const ovoid_polytope *polytope, double excess) {
    d->rank = f->rank;
    d->candidate_count = polytope->vertex_count;
    for (uint32_t i = 0; i < polytope->vertex_count; i++) {
        vec3 y = frame_compute_local(f, vec3_at(polytope->vertices, i));
        d->candidate[i] = i;
        d->local[3 * (size_t)i] = y.x, d->local[3 * (size_t)i + 1] = y.y, d->local[3 * (size_t)i + 2] = y.z;
    }
    if (d->near) add_near(d, f);
    // Extreme points make the covariance definite, whatever the other points are.
    double share = d->count ? 0.1 / (2 * d->rank) : 1.0 / (2 * d->rank);
    for (uint32_t i = 0; i < 2 * d->rank; i++) add_weight(d, f->extreme[i], share);
    // Below this, coordinates along thin axes may be noise.
    double longest = vec3_max_abs(f->half), shortest = fmin(f->half.x, fmin(f->half.y, f->half.z));
    double noise = 32 * 0x1p-53 * (longest + vec3_max_abs(f->origin)) / shortest;
    // The weights of the design's points converge further than those of all points; three rounds without progress end
    // the search.
    d->excess = INFINITY;
    for (int round = 0, stalls = 0; round < 200 && stalls < 3; round++) {
        double before = d->excess;
        if (!settle(d, fmax(fmin(0.1 * before, 1e-2), 0.5 * excess))) return;
        int added = scan(d);
        if (d->excess <= excess || (d->excess <= noise && d->excess > 0.5 * before)) return;
        stalls = added || d->excess < 0.99 * before ? 0 : stalls + 1;
    }
}
