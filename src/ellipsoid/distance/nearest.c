// The Euclidean nearest points of two ellipsoids, flat or not, with a proven lower bound.
//
// Problem. With Qa = Ea Ea', Qb = Eb Eb' and d = cb - ca: minimise |d - Ea p - Eb q| over |p| <= 1, |q| <= 1. The
// multipliers la, lb >= 0 of the two balls give w = M^-1 d, M = I + Qa/la + Qb/lb, p = Ea' w / la, q = Eb' w / lb; the
// dual function of (la, lb) is concave, and its maximum is where |p| = |q| = 1, or a multiplier is zero and its point
// interior (a disc's). These are two unknowns instead of a direction and two points, and flat bodies make the dual
// function no less smooth, as they do the support functions.
//
// Steps. Newton's method on 1/|p| = 1, 1/|q| = 1, which are close to linear in la, lb (as with one ball: J. J. More and
// D. C. Sorensen, Computing a trust region step, 1983); where the dual function does not rise, Newton's method on that
// function itself, shortened until it does. The start is on the ray of the pencil (pencil.h), along which the dual
// function rises from zero if and only if the ellipsoids are apart; so no step can fall back to zero.
//
// Rounding. First M is formed and factored. For thin bodies across the direction la or lb is small, the identity in M
// is lost and so are the digits of p. Then the search is run again with least squares (rows.h) on nine rows, once for w
// in the rows I, Ea'/sqrt(la), Eb'/sqrt(lb), once for p and q in the rows [Ea Eb] and the roots of the multipliers. The
// errors of least squares are small relative to each row: the answer is that of ellipsoids whose axes are off by
// roundings of their own lengths.
//
// Guarantee. Each round has a bracket: feasible points, and the support gap along w. It stops when that is narrower
// than 2^-46 of the pair's size, when it closes no more, or after 200 rounds. The best points and the best direction
// are returned; the lower bound is computed again with every rounding bounded (gap.h). Cost: 4 to 8 rounds, 1 to 2
// microseconds in all; 5 to 10 for flat bodies.
#include "base/environment.h"
#include "ellipsoid/distance/gap.h"
#include "ellipsoid/distance/pencil.h"
#include "ellipsoid/distance/root.h"
#include "ellipsoid/distance/rows.h"

enum { ROUNDS_PLAIN = 20, ROUNDS_CAREFUL = 180 };

/// The least factor by which a step may lower a multiplier.
#define LEAST_FACTOR 1e-3

/// The largest relative change of a multiplier in a step, so that one step leads from nearly zero to any size.
#define LARGEST_CHANGE 1e18

/// The width at which the bracket counts as closed, in units of the pair's size.
#define CLOSED 0x1p-46

/// The pair and the best bracket so far.
typedef struct search {
    const scaled_pair *pair;
    root3 a, b;
    int is_careful;
    double lower, upper;
    vec3 normal;               ///< of the best lower bound
    vec3 offset_a, difference; ///< of the best upper bound: the point of a from its centre, and from it to that of b
    vec3 p, q;                 ///< of the best upper bound: the points in the unit balls
    uint32_t rounds;
} search;

/// One pair of multipliers and what follows from it.
typedef struct multipliers {
    double la, lb;
    vec3 w, p, q;          ///< as above
    double ma, mb;         ///< |p|, |q|
    double dual;           ///< twice the dual function
    double aa, ab, ba, bb; ///< Newton's matrix for relative changes of la and lb
} multipliers;

/// The usual evaluation: M is formed and factored.
static int evaluate_plain(const search *s, multipliers *m) {
    sym3 g = sym3_add(sym3_scale(s->pair->qa, 1 / m->la), sym3_scale(s->pair->qb, 1 / m->lb));
    ldl3 f;
    if (!ldl3_make(sym3_add(g, sym3_diagonal(1, 1, 1)), &f)) return 0;
    m->w = ldl3_solve(&f, s->pair->d);
    vec3 xa = vec3_scale(sym3_mul_vec3(s->pair->qa, m->w), 1 / m->la);
    vec3 xb = vec3_scale(sym3_mul_vec3(s->pair->qb, m->w), 1 / m->lb);
    m->p = vec3_scale(root3_map_transposed(&s->a, m->w), 1 / m->la);
    m->q = vec3_scale(root3_map_transposed(&s->b, m->w), 1 / m->lb);
    double pp = vec3_norm_squared(m->p), qq = vec3_norm_squared(m->q);
    vec3 ta = ldl3_solve(&f, xa), tb = ldl3_solve(&f, xb);
    double ka = 1 / (m->la * pp), kb = 1 / (m->lb * qq), cross = vec3_dot(xa, tb);
    m->aa = 1 - ka * vec3_dot(xa, ta);
    m->ab = -ka * cross;
    m->ba = -kb * cross;
    m->bb = 1 - kb * vec3_dot(xb, tb);
    return 1;
}

static void fill_dual_rows(double rows[3][ROWS_WIDTH], const root3 *e, double l) {
    double scale = 1 / sqrt(l);
    for (int k = 0; k < 3; k++) {
        rows[k][0] = e->axis[k].x * scale;
        rows[k][1] = e->axis[k].y * scale;
        rows[k][2] = e->axis[k].z * scale;
    }
}

/// The evaluation by least squares, for thin bodies. The matrix N = [Ea Eb]'[Ea Eb] + diag(la, lb) = R' R of p and q
/// gives Newton's matrix without cancellation, since d|p|^2 / dla = -2 [p; 0]' N^-1 [p; 0].
static void evaluate_careful(const search *s, multipliers *m) {
    double dual[9][ROWS_WIDTH] = {{1, 0, 0, s->pair->d.x}, {0, 1, 0, s->pair->d.y}, {0, 0, 1, s->pair->d.z}};
    fill_dual_rows(dual + 3, &s->a, m->la);
    fill_dual_rows(dual + 6, &s->b, m->lb);
    rows_factor f;
    double z[6];
    rows_factor_make(dual, 3, &f);
    rows_solve(&f, z);
    m->w = (vec3){z[0], z[1], z[2]};

    double primal[9][ROWS_WIDTH] = {{0}};
    for (int k = 0; k < 3; k++) {
        const vec3 *a = &s->a.axis[k], *b = &s->b.axis[k];
        primal[0][k] = a->x, primal[1][k] = a->y, primal[2][k] = a->z;
        primal[0][k + 3] = b->x, primal[1][k + 3] = b->y, primal[2][k + 3] = b->z;
        primal[3 + k][k] = sqrt(m->la);
        primal[6 + k][k + 3] = sqrt(m->lb);
    }
    primal[0][6] = s->pair->d.x, primal[1][6] = s->pair->d.y, primal[2][6] = s->pair->d.z;
    rows_factor_make(primal, 6, &f);
    rows_solve(&f, z);
    m->p = (vec3){z[0], z[1], z[2]};
    m->q = (vec3){z[3], z[4], z[5]};

    const double only_p[6] = {z[0], z[1], z[2], 0, 0, 0}, only_q[6] = {0, 0, 0, z[3], z[4], z[5]};
    double yp[6], yq[6];
    rows_solve_transposed(&f, only_p, yp);
    rows_solve_transposed(&f, only_q, yq);
    double pp = 0, pq = 0, qq = 0;
    for (int k = 0; k < 6; k++) {
        pp += yp[k] * yp[k];
        pq += yp[k] * yq[k];
        qq += yq[k] * yq[k];
    }
    // If p or q is zero, the body is a point, and nothing depends on its multiplier.
    double ma = vec3_norm_squared(m->p), mb = vec3_norm_squared(m->q);
    m->aa = ma > 0 ? m->la * pp / ma : 1;
    m->ab = ma > 0 ? m->lb * pq / ma : 0;
    m->ba = mb > 0 ? m->la * pq / mb : 0;
    m->bb = mb > 0 ? m->lb * qq / mb : 1;
}

/// A multiplier below this changes no bound.
static double least_multiplier(const search *s) { return 1e-15 * fmax(s->lower, CLOSED); }

static multipliers evaluate(const search *s, double la, double lb) {
    double least = least_multiplier(s);
    multipliers m = {.la = fmax(la, least), .lb = fmax(lb, least)};
    if (s->is_careful)
        evaluate_careful(s, &m);
    else if (!evaluate_plain(s, &m))
        m.dual = NAN;
    m.ma = vec3_norm(m.p);
    m.mb = vec3_norm(m.q);
    m.dual += (vec3_norm_squared(m.w) + m.la * (m.ma * m.ma - 1)) + m.lb * (m.mb * m.mb - 1);
    return m;
}

/// The gap of the supports along a unit vector, rounded.
static double support_gap(const search *s, vec3 n) {
    return (vec3_dot(n, s->pair->d) - vec3_norm(root3_map_transposed(&s->a, n))) -
           vec3_norm(root3_map_transposed(&s->b, n));
}

/// Keeps the bracket of the multipliers if it is better; 1 if it was.
static int take_bracket(search *s, const multipliers *m) {
    int is_better = 0;
    vec3 n = vec3_unit(m->w);
    double lower = support_gap(s, n);
    if (lower > s->lower) {
        s->lower = lower;
        s->normal = n;
        is_better = 1;
    }
    vec3 p = vec3_scale(m->p, 1 / fmax(1, m->ma)), q = vec3_scale(m->q, 1 / fmax(1, m->mb));
    vec3 x = root3_map(&s->a, p), y = root3_map(&s->b, q);
    vec3 difference = vec3_sub(vec3_sub(s->pair->d, x), y);
    double upper = vec3_norm(difference);
    if (upper < s->upper) {
        s->upper = upper;
        s->offset_a = x;
        s->difference = difference;
        s->p = p;
        s->q = q;
        is_better = 1;
    }
    return is_better;
}

/// A number for each multiplier.
typedef struct change {
    double a, b;
} change;

/// The change of one multiplier if that of the other is given.
static double solve_one(double own, double cross, double right, double other, double least) {
    double e = (right - cross * other) / own;
    return own > 0 && isfinite(e) ? fmin(fmax(e, least), LARGEST_CHANGE) : 0;
}

/// The quadratic function that Newton's step maximises.
static double model_value(const multipliers *m, change right, change e) {
    double wa = m->la * m->ma * m->ma, wb = m->lb * m->mb * m->mb;
    return wa * e.a * (right.a - 0.5 * (m->aa * e.a + m->ab * e.b)) +
           wb * e.b * (right.b - 0.5 * (m->ba * e.a + m->bb * e.b));
}

/// The relative changes for a right-hand side. None leads below the least multiplier, or below LEAST_FACTOR of the
/// present one.
static change find_change(const search *s, const multipliers *m, change right) {
    double least = least_multiplier(s);
    double least_a = fmin(fmax(LEAST_FACTOR, least / m->la), 1) - 1;
    double least_b = fmin(fmax(LEAST_FACTOR, least / m->lb), 1) - 1;
    double det = m->aa * m->bb - m->ab * m->ba;
    change e = {(right.a * m->bb - right.b * m->ab) / det, (right.b * m->aa - right.a * m->ba) / det};
    if (!(det > 0) || !isfinite(e.a) || !isfinite(e.b))
        return (change){fmin(fmax(right.a, least_a), LARGEST_CHANGE), fmin(fmax(right.b, least_b), LARGEST_CHANGE)};
    if (e.a >= least_a && e.b >= least_b) return e;
    // The maximum of the quadratic within these limits is on one of the two.
    change on_a = {least_a, solve_one(m->bb, m->ba, right.b, least_a, least_b)};
    change on_b = {solve_one(m->aa, m->ab, right.a, least_b, least_a), least_b};
    if (!(e.a < least_a)) return on_b;
    return e.b < least_b && model_value(m, right, on_a) < model_value(m, right, on_b) ? on_b : on_a;
}

/// 1 if `next` is no worse: the dual function rose, up to its rounding; or near the end, where its change is all
/// rounding, the points came nearer to their surfaces.
static int is_better(const multipliers *next, const multipliers *m) {
    double noise = 0x1p-46 * ((vec3_norm_squared(m->w) + m->la * (m->ma * m->ma + 1)) + m->lb * (m->mb * m->mb + 1));
    double before = fabs(m->ma - 1) + fabs(m->mb - 1), after = fabs(next->ma - 1) + fabs(next->mb - 1);
    return next->dual > m->dual - noise || (before < 1e-3 && 2 * after < before);
}

/// One step that raises the dual function.
static multipliers step(const search *s, const multipliers *m) {
    change e = find_change(s, m, (change){m->ma - 1, m->mb - 1});
    multipliers next = evaluate(s, m->la * (1 + e.a), m->lb * (1 + e.b));
    if (is_better(&next, m)) return next;

    // Newton's step for the dual function itself, which raises it, and fractions of this step.
    e = find_change(s, m, (change){0.5 - 0.5 / (m->ma * m->ma), 0.5 - 0.5 / (m->mb * m->mb)});
    for (int part = 0; part < 12; part++, e.a *= 0.25, e.b *= 0.25) {
        next = evaluate(s, m->la * (1 + e.a), m->lb * (1 + e.b));
        if (is_better(&next, m)) break;
    }
    return next;
}

/// If the pencil gives no answer in doubles (flat pairs): the ratio at which the dual function rises from zero, by
/// bisection of |p| - |q|, which falls as the ratio grows.
static double find_ratio(const search *s, double scale) {
    double low = 0, high = 1;
    for (int round = 0; round < 50; round++) {
        double ratio = 0.5 * (low + high);
        multipliers m = evaluate(s, scale / (1 - ratio), scale / ratio);
        if (m.dual > 0) return ratio;
        if (m.ma > m.mb)
            low = ratio;
        else
            high = ratio;
    }
    return 0.5 * (low + high);
}

/// Multipliers where the dual function is positive, if there are any.
static multipliers find_start(const search *s) {
    // On the ray of the pencil: 1/(1 - s) : 1/s, and w near the separating direction's gap.
    pencil p = {.state = PENCIL_TOUCHING};
    if (!s->is_careful) p = pencil_search(s->pair->qa, s->pair->qb, s->pair->d);
    double small = 1e-16, length = vec3_norm(p.v);
    if (p.state != PENCIL_APART) {
        p.s = find_ratio(s, small);
        multipliers m = evaluate(s, small / (1 - p.s), small / p.s);
        if (!(m.dual > 0)) return m;
        p.v = vec3_scale(m.w, 1 / small);
        length = vec3_norm(p.v);
    }
    double scale = fmax(support_gap(s, vec3_scale(p.v, 1 / length)) / length, small);
    multipliers m = evaluate(s, scale / (1 - p.s), scale / p.s);
    for (int k = 0; k < 30 && !(m.dual > 0); k++) {
        scale *= 0.25;
        m = evaluate(s, scale / (1 - p.s), scale / p.s);
    }
    return m;
}

static int is_closed(const search *s) { return s->upper - s->lower <= CLOSED || s->upper <= CLOSED; }

/// Up to `rounds` rounds from the multipliers *m, which are the last ones afterwards.
static void search_run(search *s, multipliers *m, uint32_t rounds) {
    for (int idle = 0; rounds-- > 0 && idle < 40; idle++) {
        s->rounds++;
        if (take_bracket(s, m)) idle = 0;
        if (is_closed(s)) return;
        *m = step(s, m);
    }
}

/// The result for ellipsoids that share a point. No direction separates them, so any will do: that of the centres is
/// taken.
static ovoid_nearest make_overlapping(const ovoid_ellipsoid *a, const ovoid_ellipsoid *b, vec3 point) {
    ovoid_nearest r = {.point_a = point, .point_b = point, .overlap = 1};
    r.normal = vec3_unit(vec3_sub(b->center, a->center));
    if (!(vec3_norm_squared(r.normal) > 0)) r.normal = (vec3){1, 0, 0};
    r.lower = fmin(ellipsoids_compute_gap(a, b, r.normal), 0);
    return r;
}

static ovoid_nearest make_answer(const ovoid_ellipsoid *a, const ovoid_ellipsoid *b, const search *s) {
    ovoid_nearest r = {.normal = s->normal, .iterations = s->rounds};
    r.point_a = vec3_add_scaled(a->center, s->offset_a, s->pair->unit);
    r.point_b = vec3_add_scaled(r.point_a, s->difference, s->pair->unit);
    r.distance = vec3_norm(vec3_sub(r.point_b, r.point_a));
    r.lower = fmin(ellipsoids_compute_gap(a, b, r.normal), r.distance);
    return r;
}

static ovoid_nearest compute_nearest(const ovoid_ellipsoid *a, const ovoid_ellipsoid *b) {
    vec3 common;
    if (ellipsoids_are_overlapping(a, b, &common)) return make_overlapping(a, b, common);

    scaled_pair p = ellipsoids_make_scaled(a, b);
    search s = {.pair = &p, .a = root3_make(p.qa, 0), .b = root3_make(p.qb, 0), .normal = {1, 0, 0}};
    s.lower = -INFINITY;
    s.upper = INFINITY;
    multipliers m = find_start(&s);
    search_run(&s, &m, ROUNDS_PLAIN);
    ovoid_nearest r = make_answer(a, b, &s);
    if (r.distance - r.lower <= 4 * CLOSED * p.unit) return r;

    // Search again by least squares.
    search t = {.pair = &p, .a = root3_make(p.qa, 1), .b = root3_make(p.qb, 1), .normal = s.normal};
    t.is_careful = 1;
    t.lower = -INFINITY;
    t.upper = INFINITY;
    t.rounds = s.rounds;
    m = evaluate(&t, m.la, m.lb);
    if (!(m.dual > 0)) m = find_start(&t);
    search_run(&t, &m, ROUNDS_CAREFUL);
    return make_answer(a, b, &t);
}

/// How far the multipliers are from those of the nearest points: their points should be on their surfaces, or inside
/// with a multiplier of zero.
static double compute_residue(const multipliers *m) {
    double a = m->ma > 1 ? m->ma - 1 : (1 - m->ma) * fmin(m->la, 1);
    double b = m->mb > 1 ? m->mb - 1 : (1 - m->mb) * fmin(m->lb, 1);
    return a + b;
}

/// The bracket closes with the square of the direction's error. The residue falls in proportion to this error, so
/// Newton's steps go on while it falls. For any multipliers w = d - Ea p - Eb q, so w is the direction between the
/// points.
static void polish(search *s, multipliers *m) {
    for (int round = 0; round < ROUNDS_PLAIN; round++) {
        change e = find_change(s, m, (change){m->ma - 1, m->mb - 1});
        multipliers next = evaluate(s, m->la * (1 + e.a), m->lb * (1 + e.b));
        if (!(compute_residue(&next) < compute_residue(m))) return;
        *m = next;
        s->rounds++;
    }
}

int roots_find_nearest(const root3 *a, const root3 *b, vec3 d, root3_nearest *found) {
    scaled_pair pair = {.d = d, .unit = 1};
    search s = {.pair = &pair, .a = *a, .b = *b, .normal = {1, 0, 0}, .is_careful = 1};
    s.lower = -INFINITY;
    s.upper = INFINITY;
    multipliers m = find_start(&s);
    if (!(m.dual > 0)) return 0;
    search_run(&s, &m, ROUNDS_CAREFUL);
    polish(&s, &m);
    *found = (root3_nearest){vec3_unit(m.w), vec3_scale(m.p, 1 / fmax(1, m.ma)), vec3_scale(m.q, 1 / fmax(1, m.mb)),
                             s.rounds};
    return s.lower > 0;
}

ovoid_nearest ovoid_ellipsoid_compute_nearest(const ovoid_ellipsoid *a, const ovoid_ellipsoid *b) {
    ENVIRONMENT_RETURN(ovoid_nearest, a, compute_nearest(a, b));
}
