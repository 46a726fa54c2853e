// The polytope that grows in lanes: every instruction set against the scalar twin, bit for bit; and what the surface
// claims. Truth: its edges are counted, each of them once and its reverse once; every face's plane, and all points
// below it, are measured here in long double; the support of the nearest face is looked for among all differences.
// Tolerance 1e-13 for bodies of size 1: a few hundred roundings.
#include "simd/epa8.h"

#include "check.h"

typedef long double real;

enum { MOST = 64 };
#define SLACK 4e-15

typedef struct point3 {
    real x, y, z;
} point3;

/// Two bodies in one frame.
typedef struct bodies {
    double a[3][MOST], b[3][MOST];
    uint32_t count_a, count_b;
} bodies;

static long ends[4], points_most;

/// Points on an ellipsoid about a centre, or the corners of a grid, where differences lie on common planes.
static void make_body(double x[3][MOST], uint32_t count, uint64_t *s, const double center[3]) {
    int is_grid = random_next(s) % 4 == 0;
    double extent[3];
    for (int k = 0; k < 3; k++) extent[k] = random_next(s) % 8 == 0 ? 0.02 : random_uniform(s, 0.3, 1);
    for (uint32_t i = 0; i < count; i++) {
        double p[3], square = 0;
        for (int k = 0; k < 3; k++) {
            p[k] = is_grid ? (double)(random_next(s) % 3) - 1 : random_normal(s);
            square += p[k] * p[k];
        }
        for (int k = 0; k < 3; k++) x[k][i] = center[k] + extent[k] * (is_grid ? p[k] : p[k] / sqrt(square));
    }
    for (uint32_t i = count; i < (count + 7) / 8 * 8; i++)
        for (int k = 0; k < 3; k++) x[k][i] = x[k][0];
}

static epa8_query make_query(bodies *o, uint64_t *s) {
    double zero[3] = {0, 0, 0}, offset[3];
    double far = random_next(s) % 4 == 0 ? 1.5 : 0.4;
    for (int k = 0; k < 3; k++) offset[k] = random_uniform(s, -far, far);
    o->count_a = 4 + (uint32_t)(random_next(s) % (MOST - 3));
    o->count_b = 4 + (uint32_t)(random_next(s) % (random_next(s) % 2 ? 12 : MOST - 3));
    make_body(o->a, o->count_a, s, zero);
    make_body(o->b, o->count_b, s, offset);
    simd_points a = {o->a[0], o->a[1], o->a[2], (o->count_a + 7) / 8 * 8};
    simd_points b = {o->b[0], o->b[1], o->b[2], (o->count_b + 7) / 8 * 8};
    double narrow = random_next(s) % 4 == 0 ? 1e-15 : 1e-9;
    // With much slack the faces that a point sees need not be connected, nor have one simple rim.
    double slack = random_next(s) % 4 == 0 ? random_uniform(s, 0.01, 0.1) : SLACK;
    uint32_t most = random_next(s) % 8 == 0 ? 1 + (uint32_t)(random_next(s) % 6) : 1000;
    return (epa8_query){a, b, NULL, NULL, 1e-14, narrow, 1e-13, slack, 1e-28, most};
}

/// One difference to begin with, or two.
static void start(epa8 *o, const epa8_query *q, uint64_t *s) {
    o->points = 1 + (uint32_t)(random_next(s) % 2);
    for (uint32_t i = 0; i < o->points; i++) {
        uint32_t a = i, b = (uint32_t)(random_next(s) % 3);
        o->a[i] = a, o->b[i] = b;
        o->w[0][i] = q->b.x[b] - q->a.x[a], o->w[1][i] = q->b.y[b] - q->a.y[a], o->w[2][i] = q->b.z[b] - q->a.z[a];
    }
}

static int is_alive(const epa8 *o, uint32_t f) { return (int)(o->alive[f / 64] >> f % 64 & 1); }

/// 1 if all that is of use is the same bits.
static int is_same(const epa8 *x, const epa8 *y, epa8_end end) {
    if (x->points != y->points) return 0;
    size_t doubles = x->points * sizeof(double), words = x->points * sizeof(uint32_t);
    for (int k = 0; k < 3; k++)
        if (memcmp(x->w[k], y->w[k], doubles) != 0) return 0;
    if (memcmp(x->a, y->a, words) != 0 || memcmp(x->b, y->b, words) != 0) return 0;
    if (end == EPA8_FLAT) return 1;
    if (memcmp(x->alive, y->alive, sizeof x->alive) != 0 || memcmp(x->inward, y->inward, sizeof x->inward) != 0)
        return 0;
    if (x->groups != y->groups || x->supports != y->supports || x->nearest != y->nearest) return 0;
    for (uint32_t f = 0; f < EPA8 * x->groups; f++) {
        if (!is_alive(x, f)) continue;
        if (memcmp(x->v[f], y->v[f], 3) != 0 || memcmp(&x->low[f], &y->low[f], sizeof(double)) != 0) return 0;
        for (int k = 0; k < 3; k++)
            if (memcmp(&x->n[k][f], &y->n[k][f], sizeof(double)) != 0) return 0;
    }
    if (memcmp(&x->best_gap, &y->best_gap, sizeof(double) + sizeof x->best_n) != 0) return 0;
    return end != EPA8_NARROW ||
           (memcmp(&x->gap, &y->gap, sizeof x->gap) == 0 && memcmp(x->near, y->near, sizeof x->near) == 0);
}

static real along(const epa8 *o, uint32_t f, uint32_t point) {
    return (real)o->n[0][f] * o->w[0][point] + (real)o->n[1][f] * o->w[1][point] + (real)o->n[2][f] * o->w[2][point];
}

/// Every edge is met once and its reverse once; the table of edges knows the faces.
static void check_closed(const epa8 *o) {
    int met[EPA8_POINTS][EPA8_POINTS] = {{0}};
    for (uint32_t f = 0; f < EPA8 * o->groups; f++)
        for (int e = 0; e < 3 && is_alive(o, f); e++) {
            uint32_t i = o->v[f][e], k = o->v[f][(e + 1) % 3];
            met[i][k]++;
            CHECK_EQ(o->left[i][k], f);
        }
    for (uint32_t i = 0; i < o->points; i++)
        for (uint32_t k = 0; k < o->points; k++) CHECK(met[i][k] == met[k][i] && met[i][k] <= 1);
}

static point3 get_edge(const epa8 *o, uint32_t from, uint32_t to) {
    return (point3){(real)o->w[0][to] - o->w[0][from], (real)o->w[1][to] - o->w[1][from],
                    (real)o->w[2][to] - o->w[2][from]};
}

static real dot(point3 a, point3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// The sine between a face's edges is above 0.01.
static int is_plain(const epa8 *o, uint32_t f) {
    point3 u = get_edge(o, o->v[f][0], o->v[f][1]), v = get_edge(o, o->v[f][0], o->v[f][2]);
    return dot(u, u) * dot(v, v) * (1 - 0.999e-4L) > dot(u, v) * dot(u, v);
}

/// Planes, convexity, what is told of the origin.
static void check_faces(const epa8 *o, const epa8_query *q) {
    for (uint32_t f = 0; f < EPA8 * o->groups; f++) {
        if (!is_alive(o, f)) continue;
        CHECK_NEAR(
            (double)((real)o->n[0][f] * o->n[0][f] + (real)o->n[1][f] * o->n[1][f] + (real)o->n[2][f] * o->n[2][f]), 1,
            1e-14);
        for (int e = 0; e < 3; e++) CHECK_NEAR((double)along(o, f, o->v[f][e]), o->low[f], 1e-13);
        CHECK(is_plain(o, f));
        for (uint32_t i = 0; i < o->points && q->slack <= SLACK; i++)
            CHECK_LE((double)along(o, f, i), o->low[f] + 1e-12);
        if (!(o->low[f] > 0)) CHECK(o->inward[f / 64] >> f % 64 & 1);
    }
    CHECK((o->inward[0] & ~o->alive[0]) == 0 && (o->inward[1] & ~o->alive[1]) == 0);
}

/// The farthest difference along n.
static double find_farthest(const bodies *o, vec3 n) {
    real high = -INFINITY, low = INFINITY;
    for (uint32_t i = 0; i < o->count_b; i++)
        high = fmaxl(high, (real)n.x * o->b[0][i] + (real)n.y * o->b[1][i] + (real)n.z * o->b[2][i]);
    for (uint32_t i = 0; i < o->count_a; i++)
        low = fminl(low, (real)n.x * o->a[0][i] + (real)n.y * o->a[1][i] + (real)n.z * o->a[2][i]);
    return (double)(high - low);
}

static void check_result(const epa8 *o, const epa8_query *q, const bodies *of, epa8_end end) {
    CHECK_NEAR(-find_farthest(of, o->best_n), o->best_gap, 1e-13);
    if (end == EPA8_APART) CHECK(o->best_gap > q->claim);
    if (end != EPA8_NARROW) return;
    uint32_t f = o->nearest;
    vec3 n = {o->n[0][f], o->n[1][f], o->n[2][f]};
    CHECK(is_alive(o, f));
    CHECK_NEAR(-find_farthest(of, n), o->gap, 1e-13);
    CHECK_LE(-o->gap, o->low[f] + q->narrow);
    for (uint32_t i = 0; i < EPA8 * o->groups; i++) {
        if (!is_alive(o, i)) continue;
        CHECK_LE(o->low[f], o->low[i]);
        CHECK_EQ(o->near[i / 64] >> i % 64 & 1, o->low[i] <= o->low[f] + q->near);
    }
}

/// The greatest gap of more supports is no less.
static void check_steps(const epa8_query *q, uint64_t s) {
    static epa8 o;
    double best = -INFINITY;
    for (uint32_t most = 1; most < 8; most++) {
        epa8_query few = *q;
        uint64_t again = s;
        few.most = most;
        start(&o, &few, &again);
        if (epa8_grow(&o, &few) == EPA8_FLAT) return;
        CHECK_LE(best, o.best_gap);
        CHECK_LE(o.supports, most);
        best = o.best_gap;
    }
}

static void check_query(uint64_t seed) {
    static epa8 truth, other;
    bodies of;
    uint64_t s = check_seed = seed, again;
    epa8_query q = make_query(&of, &s);
    again = s;
    start(&truth, &q, &s);
    epa8_end end = epa8_get(SIMD_SCALAR)(&truth, &q);
    ends[end]++;
    for (int isa = SIMD_SCALAR; isa <= SIMD_ISA_COUNT; isa++) {
        epa8_function *grow = isa == SIMD_ISA_COUNT ? epa8_grow : epa8_get((simd_isa)isa);
        if (!grow) continue;
        memset(&other, isa, sizeof other);
        s = again;
        start(&other, &q, &s);
        CHECK_EQ(grow(&other, &q), end);
        if (!CHECK(is_same(&truth, &other, end))) printf("  %d of %d\n", isa, (int)end);
    }
    if (end == EPA8_FLAT) return;
    check_closed(&truth);
    check_faces(&truth, &q);
    check_result(&truth, &q, &of, end);
    if (seed % 10 == 0) check_steps(&q, again);
    if (truth.points > points_most) points_most = truth.points;
}

int main(void) {
    for (uint64_t seed = 1; seed <= 20000; seed++) check_query(seed);
    printf("narrow %ld, apart %ld, left %ld, flat %ld, at most %ld points\n", ends[EPA8_NARROW], ends[EPA8_APART],
           ends[EPA8_LEFT], ends[EPA8_FLAT], points_most);
    for (int i = 0; i < 4; i++) CHECK(ends[i] > 50);
    CHECK_LE(24, points_most);
    return check_end();
}
