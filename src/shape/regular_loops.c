// Which facet is to the left of an edge follows from the two corners; a loop begins at its lowest vertex.
#include "shape/regular_loops.h"

// The edges on boundaries, as seen from their lower ends: along the lower ring, along the upper one, and up from each
// corner.
typedef struct edges {
    uint32_t *lower, *upper, *rising;
} edges;

static uint32_t get_before(const regular_solid *s, uint32_t i) { return i > 0 ? i - 1 : s->sides - 1; }

// The edges from corner i of the lower ring: within the end, the side on the left of the one to the next corner; then
// upward, the side before on the left of the one straight up.
static void fill_lower(const regular_solid *s, const regular_tables *t, const edges *e, uint32_t i) {
    uint32_t n = s->sides, at = t->neighbor_starts[i], end = t->neighbor_starts[i + 1];
    uint32_t next = regular_solid_get_next(s, i), above = regular_solid_get_above(s, i);
    for (; t->neighbors[at] < n; at++) {
        uint32_t to = t->neighbors[at];
        t->tails[at] = i;
        t->facets[at] = to == next ? i : n;
        if (to == i + 1) e->lower[i] = at;
        if (i == 0 && to == n - 1) e->lower[to] = at;
    }
    for (; at < end; at++) {
        int is_straight = t->neighbors[at] == above;
        t->tails[at] = i;
        t->facets[at] = is_straight ? get_before(s, i) : i;
        if (is_straight) e->rising[i] = at;
    }
}

// The edges from the corner of the upper ring over corner i: downward, with the number of the corner below on the left;
// then within the end, the side before on the left of the one to the corner before.
static void fill_upper(const regular_solid *s, const regular_tables *t, const edges *e, uint32_t i) {
    uint32_t n = s->sides, at = t->neighbor_starts[n + i], end = t->neighbor_starts[n + i + 1];
    uint32_t before = get_before(s, i);
    for (; t->neighbors[at] < n; at++) t->tails[at] = n + i, t->facets[at] = t->neighbors[at];
    for (; at < end; at++) {
        uint32_t to = t->neighbors[at] - n;
        t->tails[at] = n + i;
        t->facets[at] = to == before ? before : n + 1;
        if (to == i + 1) e->upper[i] = at;
        if (i == 0 && to == n - 1) e->upper[to] = at;
    }
}

static void fill_edges(const regular_solid *s, const regular_tables *t, const edges *e) {
    uint32_t n = s->sides;
    for (uint32_t i = 0; i < n; i++) fill_lower(s, t, e, i);
    for (uint32_t i = 0; i < n && s->is_prism; i++) fill_upper(s, t, e, i);
    // The apex: side i is on the left of the edge to corner i.
    uint32_t at = t->neighbor_starts[n];
    for (uint32_t i = 0; i < n && !s->is_prism; i++) t->tails[at + i] = n, t->facets[at + i] = i;
}

typedef struct corner {
    uint32_t vertex, edge; // and the edge to the next corner
} corner;

static uint32_t put_corner(const regular_tables *t, uint32_t at, corner c) {
    t->loop_vertices[at] = c.vertex;
    t->loop_edges[at] = c.edge;
    return at + 1;
}

// Side i from corner i; the last one from corner 0.
static uint32_t fill_side(const regular_solid *s, const regular_tables *t, const edges *e, uint32_t i) {
    uint32_t next = regular_solid_get_next(s, i), at = t->starts[i], is_last = next == 0;
    corner first = {i, e->lower[i]};
    if (!is_last) at = put_corner(t, at, first);
    at = put_corner(t, at, (corner){next, e->rising[next]});
    if (s->is_prism) at = put_corner(t, at, (corner){s->sides + next, e->upper[i]});
    at = put_corner(t, at, (corner){regular_solid_get_above(s, i), e->rising[i]});
    return is_last ? put_corner(t, at, first) : at;
}

void regular_loops_fill(const regular_solid *s, const regular_tables *t) {
    uint32_t n = s->sides, at = 0;
    const edges e = {t->room, t->room + n, t->room + 2 * (size_t)n};
    fill_edges(s, t, &e);
    for (uint32_t i = 0; i < n; i++) {
        t->starts[i] = at;
        at = fill_side(s, t, &e, i);
    }
    // The lower end is seen from below, so that its corners descend.
    t->starts[n] = at;
    at = put_corner(t, at, (corner){0, e.lower[n - 1]});
    for (uint32_t i = n - 1; i > 0; i--) at = put_corner(t, at, (corner){i, e.lower[i - 1]});
    t->starts[n + 1] = at;
    if (!s->is_prism) return;
    for (uint32_t i = 0; i < n; i++) at = put_corner(t, at, (corner){n + i, e.upper[i]});
    t->starts[n + 2] = at;
}
