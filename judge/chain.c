// Whether triangles are closed. Edges with the same two ends cancel first. For the other edges, for each point and each
// line through it, count how many edges on the line leave the point, minus how many arrive. The number of times that
// the line is covered changes by these counts along it, so nothing is left of the chain if and only if all counts are
// 0. Triangles without area add nothing, and a corner on a neighbor's edge takes nothing away. Exact numbers
// throughout.
#include "parts.h"

#include <stdlib.h>

/// An edge as one of its points sees it.
typedef struct chain_end {
    uint32_t point, other;
    long leaving;
} chain_end;

static int compare_edges(const void *a, const void *b) {
    const uint64_t *x = a, *y = b;
    return x[0] != y[0] ? (x[0] < y[0] ? -1 : 1) : x[1] < y[1] ? -1 : x[1] > y[1];
}

static int compare_ends(const void *a, const void *b) {
    const chain_end *x = a, *y = b;
    return x->point < y->point ? -1 : x->point > y->point;
}

/// The ends of edges that do not cancel with equal ones; returns their number. Freed by the caller.
static size_t list_ends(const uint32_t *corners, size_t triangles, chain_end **ends) {
    uint64_t(*edges)[2] = judge_allocate(3 * triangles + 1, sizeof *edges);
    size_t count = 0, left = 0;
    for (size_t i = 0; i < 3 * triangles; i++) {
        uint64_t a = corners[i], b = corners[i % 3 == 2 ? i - 2 : i + 1];
        if (a == b) continue;
        edges[count][0] = a < b ? a << 32 | b : b << 32 | a;
        edges[count++][1] = a < b;
    }
    qsort(edges, count, sizeof *edges, compare_edges);
    *ends = judge_allocate(2 * count + 1, sizeof **ends);
    for (size_t i = 0, end; i < count; i = end) {
        long net = 0;
        for (end = i; end < count && edges[end][0] == edges[i][0]; end++) net += edges[end][1] ? 1 : -1;
        uint32_t low = (uint32_t)(edges[i][0] >> 32), high = (uint32_t)edges[i][0];
        if (net) (*ends)[left++] = (chain_end){low, high, net}, (*ends)[left++] = (chain_end){high, low, -net};
    }
    free(edges);
    qsort(*ends, left, sizeof **ends, compare_ends);
    return left;
}

static nvec get_edge(pool *p, const double *points, const chain_end *e) {
    const double *a = points + 3 * (size_t)e->point, *b = points + 3 * (size_t)e->other;
    return nvec_sub(p, nvec_from(p, (ovoid_vec3){b[0], b[1], b[2]}), nvec_from(p, (ovoid_vec3){a[0], a[1], a[2]}));
}

/// 1 if on each line through one point as many edges leave as arrive.
static int is_point_closed(pool *p, const double *points, chain_end *ends, size_t count) {
    for (size_t i = 0; i < count; i++) {
        long sum = ends[i].leaving;
        size_t mark = pool_get_mark(p);
        nvec line = get_edge(p, points, &ends[i]);
        for (size_t j = i + 1; j < count && ends[i].leaving; j++) {
            if (!ends[j].leaving || !nvec_is_zero(nvec_cross(p, line, get_edge(p, points, &ends[j])))) continue;
            sum += ends[j].leaving;
            ends[j].leaving = 0;
        }
        pool_release(p, mark);
        if (sum) return 0;
    }
    return 1;
}

int judge_is_chain_closed(pool *p, const double *points, const uint32_t *corners, size_t triangles) {
    chain_end *ends;
    size_t count = list_ends(corners, triangles, &ends);
    int closed = 1;
    for (size_t i = 0, end; i < count && closed; i = end) {
        for (end = i; end < count && ends[end].point == ends[i].point; end++) continue;
        closed = is_point_closed(p, points, ends + i, end - i);
    }
    free(ends);
    return closed;
}
