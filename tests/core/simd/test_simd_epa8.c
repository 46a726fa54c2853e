// The polytope that grows in lanes, from points or from a surface that was kept: every instruction set against the
// scalar twin, bit for bit; and what the surface claims. What is no closed surface around the origin must be refused.
// Truth: its edges are counted, each of them once and its reverse once; every face's plane, and all points below it,
// are measured here in long double; the support of the nearest face is looked for among all differences. Tolerance
// 1e-13 for bodies of size 1: a few hundred roundings.
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
    return (epa8_query){a, b, NULL, NULL, 1e-14, narrow, 1e-13, slack, 1e-28, most, NULL};
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

/// Every edge is met once and its reverse once; the table of edges knows the faces, unless they were kept and no point
/// was joined.
static void check_closed(const epa8 *o, int knows_edges) {
    int met[EPA8_POINTS][EPA8_POINTS] = {{0}};
    for (uint32_t f = 0; f < EPA8 * o->groups; f++)
        for (int e = 0; e < 3 && is_alive(o, f); e++) {
            uint32_t i = o->v[f][e], k = o->v[f][(e + 1) % 3];
            met[i][k]++;
            if (knows_edges) CHECK_EQ(o->left[i][k], f);
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

/// Planes, convexity unless the surface was kept, what is told of the origin.
static void check_faces(const epa8 *o, const epa8_query *q) {
    for (uint32_t f = 0; f < EPA8 * o->groups; f++) {
        if (!is_alive(o, f)) continue;
        CHECK_NEAR(
            (double)((real)o->n[0][f] * o->n[0][f] + (real)o->n[1][f] * o->n[1][f] + (real)o->n[2][f] * o->n[2][f]), 1,
            1e-14);
        for (int e = 0; e < 3; e++) CHECK_NEAR((double)along(o, f, o->v[f][e]), o->low[f], 1e-13);
        CHECK(is_plain(o, f));
        for (uint32_t i = 0; i < o->points && q->slack <= SLACK && !q->kept; i++)
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

// ---- surfaces that are kept

static long kept_ends[4];

/// The faces of a surface, as a cover has them.
typedef struct triangles {
    uint16_t v[EPA8_FACES][3];
    uint32_t count;
} triangles;

static triangles list_triangles(const epa8 *o) {
    triangles t = {.count = 0};
    for (uint32_t f = 0; f < EPA8 * o->groups; f++)
        if (is_alive(o, f)) {
            for (int k = 0; k < 3; k++) t.v[t.count][k] = o->v[f][k];
            t.count++;
        }
    return t;
}

static void start_kept(epa8 *o, const epa8 *from) {
    o->points = from->points;
    for (uint32_t i = 0; i < (from->points + EPA8 - 1) / EPA8 * EPA8; i++) {
        o->a[i] = i < from->points ? from->a[i] : 0;
        o->b[i] = i < from->points ? from->b[i] : 0;
    }
}

/// The same from every instruction set.
static epa8_end grow_kept(const epa8_query *q, const epa8 *from, epa8 *truth) {
    static epa8 other;
    start_kept(truth, from);
    epa8_end end = epa8_get(SIMD_SCALAR)(truth, q);
    for (int isa = SIMD_SCALAR + 1; isa <= SIMD_ISA_COUNT; isa++) {
        epa8_function *grow = isa == SIMD_ISA_COUNT ? epa8_grow : epa8_get((simd_isa)isa);
        if (!grow) continue;
        memset(&other, isa, sizeof other);
        start_kept(&other, from);
        CHECK_EQ(grow(&other, q), end);
        if (end != EPA8_FLAT) CHECK(is_same(truth, &other, end));
    }
    return end;
}

/// The support by a function, of bodies whose points are all in the frame of the first.
static simd_difference find_posed(const void *given, vec3 n) {
    const epa8_query *q = given;
    simd_difference d = simd_find_difference(&q->a, &q->b, vec3_neg(n));
    return d;
}

/// B in a frame of its own, and supports by a function: the bits of the bodies in one frame.
static void check_own(const epa8_query *q, const epa8 *from, bodies *of, uint64_t *s) {
    static epa8 truth, other;
    epa8_kept own = *q->kept;
    bodies posed = *of;
    for (int k = 0; k < 9; k++) own.rotation[k] = (k % 4 == 0) + random_uniform(s, -0.01, 0.01);
    for (int k = 0; k < 3; k++) own.translation[k] = random_uniform(s, -0.02, 0.02);
    simd_pose_points_scalar(&q->b, own.rotation, own.translation, (double *[]){posed.b[0], posed.b[1], posed.b[2]});
    epa8_query in_one = *q, in_two = *q;
    in_one.b = (simd_points){posed.b[0], posed.b[1], posed.b[2], q->b.padded_count};
    in_two.find = find_posed;
    in_two.bodies = &in_one;
    in_two.kept = &own;
    epa8_end end = grow_kept(&in_one, from, &truth);
    CHECK_EQ(grow_kept(&in_two, from, &other), end);
    if (end != EPA8_FLAT) CHECK(is_same(&truth, &other, end));
}

/// What is no closed surface of the points around the origin is refused.
static void check_refused(const epa8_query *q, const epa8 *from, const triangles *t, uint64_t *s) {
    static epa8 o;
    triangles altered = *t;
    epa8_kept kept = *q->kept;
    epa8_query query = *q;
    uint32_t i = (uint32_t)(random_next(s) % t->count), k = (uint32_t)(random_next(s) % 3);
    uint16_t(*v)[3] = altered.v, first = v[i][0];
    kept.triangles = (const uint16_t(*)[3])v;
    query.kept = &kept;
    switch (random_next(s) % 8) {
    case 0: memcpy(v[i], v[t->count - 1], sizeof v[i]), kept.faces--; break;
    case 1: memcpy(v[i], v[(i + 1) % t->count], sizeof v[i]); break;
    case 2: v[i][0] = v[i][1], v[i][1] = first; break;
    case 3: v[i][k] = (uint16_t)(from->points + random_next(s) % 3); break;
    case 4: v[i][k] = (uint16_t)(v[i][k] + 32 * (1 + random_next(s) % 2000)); break;
    case 5: v[i][k] = (uint16_t)((v[i][k] + 1 + random_next(s) % (from->points - 1)) % from->points); break;
    case 6:
        if (t->count > EPA8_POINTS) return;
        memcpy(v[t->count], v[0], t->count * sizeof v[0]), kept.faces *= 2;
        break;
    default:
        for (i = 0; i < t->count; i++) first = v[i][0], v[i][0] = v[i][1], v[i][1] = first;
    }
    CHECK_EQ(grow_kept(&query, from, &o), EPA8_FLAT);
}

/// A tetrahedron about the origin with a fifth point beside one of its edges, joined to the face there: a sliver,
/// unless it is far from the edge.
static epa8_end grow_with_point_beside(double far) {
    static epa8 from, truth;
    static const uint16_t faces[6][3] = {{1, 0, 4}, {2, 1, 4}, {0, 2, 4}, {3, 0, 1}, {3, 1, 2}, {3, 2, 0}};
    bodies of = {.count_a = 1, .count_b = 5};
    static const double corner[4][3] = {{1, 1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, 1}};
    double off[3], up[3];
    for (int k = 0; k < 3; k++) {
        double middle = (corner[0][k] + corner[1][k]) / 2;
        off[k] = middle + far * (corner[2][k] - middle), up[k] = 0.1 * far * -corner[3][k];
        for (int i = 0; i < 8; i++) of.b[k][i] = i < 4 ? corner[i][k] : off[k] + up[k];
    }
    epa8_kept kept = {.triangles = faces, .faces = 6};
    epa8_query q = {.a = {of.a[0], of.a[1], of.a[2], 8},
                    .b = {of.b[0], of.b[1], of.b[2], 8},
                    .claim = 1e-14,
                    .narrow = 1e-9,
                    .near = 1e-13,
                    .slack = SLACK,
                    .doubt = 1e-28,
                    .most = 1000,
                    .kept = &kept};
    from.points = 5;
    for (uint32_t i = 0; i < 5; i++) from.a[i] = 0, from.b[i] = i;
    return grow_kept(&q, &from, &truth);
}

static void check_slivers(void) {
    CHECK(grow_with_point_beside(0.3) != EPA8_FLAT);
    CHECK_EQ(grow_with_point_beside(1e-3), EPA8_FLAT);
}

/// The bodies move a little, and the growth goes on from the surface; far from the origin there is none.
static void check_kept(const epa8_query *from_points, const epa8 *from, bodies *of, uint64_t *s) {
    static epa8 truth;
    triangles t = list_triangles(from);
    if (t.count > 2 * EPA8_POINTS) return;
    epa8_query q = *from_points;
    epa8_kept kept = {.triangles = (const uint16_t(*)[3])t.v, .faces = t.count};
    q.kept = &kept;
    q.most = 1000;
    double step[3], far = random_next(s) % 4 ? 0.01 : 0.3;
    for (int k = 0; k < 3; k++) step[k] = random_uniform(s, -far, far);
    for (uint32_t i = 0; i < q.b.padded_count; i++)
        for (int k = 0; k < 3; k++) of->b[k][i] += step[k];
    epa8_end end = grow_kept(&q, from, &truth);
    kept_ends[end]++;
    check_refused(&q, from, &t, s);
    check_own(&q, from, of, s);
    if (end == EPA8_FLAT) return;
    check_closed(&truth, truth.supports > 1 || end == EPA8_LEFT);
    check_faces(&truth, &q);
    check_result(&truth, &q, of, end);

    for (uint32_t i = 0; i < q.b.padded_count; i++) of->b[0][i] += 5;
    CHECK_EQ(grow_kept(&q, from, &truth), EPA8_FLAT);
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
    check_closed(&truth, 1);
    check_faces(&truth, &q);
    check_result(&truth, &q, &of, end);
    if (seed % 10 == 0) check_steps(&q, again);
    if (truth.points > points_most) points_most = truth.points;
    if (end == EPA8_NARROW) check_kept(&q, &truth, &of, &s);
}

int main(void) {
    check_slivers();
    for (uint64_t seed = 1; seed <= 20000; seed++) check_query(seed);
    printf("narrow %ld, apart %ld, left %ld, flat %ld, at most %ld points\n", ends[EPA8_NARROW], ends[EPA8_APART],
           ends[EPA8_LEFT], ends[EPA8_FLAT], points_most);
    printf("kept: narrow %ld, apart %ld, left %ld, flat %ld\n", kept_ends[EPA8_NARROW], kept_ends[EPA8_APART],
           kept_ends[EPA8_LEFT], kept_ends[EPA8_FLAT]);
    for (int i = 0; i < 4; i++) CHECK(ends[i] > 50);
    CHECK(kept_ends[EPA8_NARROW] > 1000 && kept_ends[EPA8_LEFT] > 50 && kept_ends[EPA8_FLAT] > 50);
    CHECK_LE(24, points_most);
    return check_end();
}
