// The signed distance of two small bodies by brute force. Theorem. d = max over all unit n of the gap along n, min_B
// n.x - max_A n.x - radii, whether they are apart or overlap, and the maximum is reached at a direction of features. If
// they are apart, the nearest points lie in the relative interior of two faces, so n is a difference of vertices, or
// one made orthogonal to an edge, or a cross product of two edges of either body. If they overlap, n is a face's normal
// of the Minkowski difference, and its faces are spanned by two edges. All vertex pairs count as edges: more directions
// do no harm, since no gap exceeds d. If all edges are parallel and nothing separates, d = 0. Cost: (vertices)^5 in
// all, for small bodies only.
#include "parts.h"

#include <stdlib.h>

#define MOST_VERTICES 32
#define ROOT_BITS 200

typedef struct brute {
    pool *p;
    nvec a[MOST_VERTICES], b[MOST_VERTICES]; ///< world points times k
    uint32_t count_a, count_b;
    nvec *edges;
    uint32_t edge_count;
    slot gap, square; ///< the best so far: gap / sqrt(square), times k; square 0 before the first
} brute;

typedef struct range {
    num least, largest;
} range;

// The range of n.x over a set.
static range find_range(pool *p, const nvec *points, uint32_t count, nvec n) {
    num first = nvec_dot(p, n, points[0]);
    range r = {first, first};
    for (uint32_t i = 1; i < count; i++) {
        num value = nvec_dot(p, n, points[i]);
        if (num_compare(p, value, r.least) < 0) r.least = value;
        if (num_compare(p, value, r.largest) > 0) r.largest = value;
    }
    return r;
}

static void take_gap(brute *t, num gap, num square) {
    if (num_sign(t->square) != 0 && num_compare_roots(t->p, gap, t->square, t->gap, square) <= 0) return;
    slot_set(t->gap, gap);
    slot_set(t->square, square);
}

// Measures the gaps along n and -n.
static void try_direction(brute *t, nvec n) {
    if (nvec_is_zero(n)) return;
    num square = nvec_norm_squared(t->p, n);
    range a = find_range(t->p, t->a, t->count_a, n), b = find_range(t->p, t->b, t->count_b, n);
    take_gap(t, num_sub(t->p, b.least, a.largest), square);
    take_gap(t, num_sub(t->p, a.least, b.largest), square);
}

static void collect_edges(brute *t, const nvec *points, uint32_t count) {
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t j = i + 1; j < count; j++) t->edges[t->edge_count++] = nvec_sub(t->p, points[j], points[i]);
}

// All differences of vertices, and each made orthogonal to each edge at one of its ends.
static void try_vertices(brute *t) {
    pool *p = t->p;
    for (uint32_t i = 0; i < t->count_a; i++)
        for (uint32_t j = 0; j < t->count_b; j++)
            for (uint32_t e = 0; e <= t->edge_count; e++) {
                size_t mark = pool_get_mark(p);
                nvec d = nvec_sub(p, t->b[j], t->a[i]);
                if (e < t->edge_count) {
                    nvec edge = t->edges[e];
                    d = nvec_sub(p, nvec_scale(p, d, nvec_norm_squared(p, edge)),
                                 nvec_scale(p, edge, nvec_dot(p, d, edge)));
                }
                try_direction(t, d);
                pool_release(p, mark);
            }
}

static void try_edges(brute *t) {
    for (uint32_t e = 0; e < t->edge_count; e++)
        for (uint32_t f = e + 1; f < t->edge_count; f++) {
            size_t mark = pool_get_mark(t->p);
            try_direction(t, nvec_cross(t->p, t->edges[e], t->edges[f]));
            pool_release(t->p, mark);
        }
}

static int are_edges_parallel(const brute *t) {
    int parallel = 1;
    for (uint32_t e = 0; e < t->edge_count; e++)
        for (uint32_t f = e + 1; f < t->edge_count && parallel; f++) {
            size_t mark = pool_get_mark(t->p);
            parallel = nvec_is_zero(nvec_cross(t->p, t->edges[e], t->edges[f]));
            pool_release(t->p, mark);
        }
    return parallel;
}

// Reads gap / (k sqrt(square)) - radii as two neighbouring doubles, and its signs.
static judge_truth read_truth(const brute *t, const posed *s) {
    pool *p = t->p;
    num one = number_from_integer(p, 1), whole = num_mul(p, t->square, num_mul(p, s->k, s->k));
    judge_truth truth = {.core_sign = num_sign(t->gap)};
    truth.sign = num_compare_roots(p, t->gap, one, num_mul(p, s->radii, s->k), t->square);

    num below = number_from_integer(p, 0), above = below;
    if (truth.core_sign != 0) {
        num squared = num_mul(p, t->gap, t->gap), low = num_quotient_below(p, squared, whole, 2 * ROOT_BITS);
        // The quotient is exact, or less than one unit of its last place too low.
        int exact = num_compare(p, num_mul(p, low, whole), squared) == 0;
        num high = exact ? low : num_add(p, low, num_scaled(p, one, low->e));
        below = num_root_below(p, low, ROOT_BITS);
        above = num_root_above(p, high, ROOT_BITS);
    }
    int apart = truth.core_sign >= 0;
    if (truth.sign == 0) return truth; // low = high = 0
    truth.low = num_to_double_below(num_sub(p, apart ? below : num_neg(p, above), s->radii));
    truth.high = num_to_double_above(num_sub(p, apart ? above : num_neg(p, below), s->radii));
    return truth;
}

static void run(brute *t, const posed *s) {
    pool *p = t->p;
    for (uint32_t i = 0; i < t->count_a; i++) t->a[i] = nvec_scale(p, body_vertex(p, &s->a, i), s->b.n);
    for (uint32_t i = 0; i < t->count_b; i++) t->b[i] = nvec_scale(p, body_vertex(p, &s->b, i), s->a.n);
    t->gap = slot_make(p);
    t->square = slot_make(p);
    collect_edges(t, t->a, t->count_a);
    collect_edges(t, t->b, t->count_b);
    if (are_edges_parallel(t)) take_gap(t, number_from_integer(p, 0), number_from_integer(p, 1));
    try_vertices(t);
    try_edges(t);
}

ovoid_code judge_compute_truth(judge *context, const ovoid_pair *pair, judge_truth *truth, ovoid_error *error) {
    if (!judge_is_pose_valid(&pair->pose_a) || !judge_is_pose_valid(&pair->pose_b))
        return judge_reject(error, OVOID_ERROR_ARGUMENT, "a pose is none");
    size_t mark = pool_get_mark(context->p);
    posed s = posed_make(context->p, pair);
    brute t = {.p = context->p, .count_a = s.a.polytope.vertex_count, .count_b = s.b.polytope.vertex_count};
    ovoid_code code = OVOID_OK;
    if (t.count_a > MOST_VERTICES || t.count_b > MOST_VERTICES)
        code = judge_reject(error, OVOID_ERROR_LIMIT, "more than %d vertices", MOST_VERTICES);
    if (code == OVOID_OK) {
        t.edges = judge_allocate((size_t)MOST_VERTICES * MOST_VERTICES, sizeof *t.edges);
        run(&t, &s);
        *truth = read_truth(&t, &s);
        free(t.edges);
    }
    pool_release(context->p, mark);
    return code;
}
