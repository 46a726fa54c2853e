// The features of a contact: after a search those that make its normal, and of each body the facet that is clipped.
#include "manifold/manifold.h"

// The edges that go out of a vertex.
typedef struct edge_range {
    uint32_t first, end;
} edge_range;
static edge_range get_edges(const ovoid_shape *s, uint32_t vertex) {
    const uint32_t *starts = shape_neighbor_starts(s);
    return (edge_range){starts[vertex], starts[vertex + 1]};
}

// The facet that faces n most.
typedef struct facing {
    uint32_t facet; ///< or UINT32_MAX
    double cosine;
} facing;

// The facet that is kept has an advantage.
static double get_cosine(const ovoid_shape *s, uint32_t facet, const facet_choice *c) {
    double cosine = vec3_dot(shape_planes(s)[facet].normal, c->n);
    return c->has_kept && c->kept == (OVOID_MANIFOLD_FACET | facet) ? cosine + 1e-6 : cosine;
}

// Of a flat body: it has a facet on each side.
static facing find_side(const ovoid_shape *s, vec3 n) {
    double cosine = vec3_dot(shape_get_facet_normal(s, 0), n);
    return (facing){cosine < 0, fabs(cosine)};
}

// Of the facets around a vertex.
static facing find_facing(const ovoid_shape *s, uint32_t vertex, const facet_choice *c) {
    facing best = {UINT32_MAX, -2};
    if (s->rank < 3) return s->rank == 2 ? find_side(s, c->n) : best;
    edge_range r = get_edges(s, vertex);
    for (uint32_t i = r.first; i < r.end; i++) {
        uint32_t facet = shape_edge_facets(s)[i];
        double cosine = get_cosine(s, facet, c);
        if (cosine > best.cosine) best = (facing){facet, cosine};
    }
    return best;
}

// 1 if of two facets beside an edge the first one comes first around a vertex, too.
static int comes_first(const ovoid_shape *s, uint32_t vertex, uint32_t facet, uint32_t other) {
    uint32_t i = get_edges(s, vertex).first;
    while (shape_edge_facets(s)[i] != facet && shape_edge_facets(s)[i] != other) i++;
    return shape_edge_facets(s)[i] == facet;
}

// Of the two facets beside an edge; of two that face n alike, as of round bodies, the one that comes first around the
// edge's beginning. An edge inside of a facet is beside that facet alone.
static facing find_beside(const ovoid_shape *s, uint32_t edge, const facet_choice *c) {
    if (s->rank < 3) return s->rank == 2 ? find_side(s, c->n) : (facing){UINT32_MAX, -2};
    edge_ends e = shape_get_ends(s, edge);
    uint32_t left = shape_edge_facets(s)[edge], right = shape_edge_facets(s)[shape_find_edge(s, e.to, e.from)];
    facing a = {left, get_cosine(s, left, c)}, b = {right, get_cosine(s, right, c)};
    if (a.cosine != b.cosine) return a.cosine > b.cosine ? a : b;
    return comes_first(s, e.from, left, right) ? a : b;
}

// The sine of the angle between an edge and the plane across n.
static double get_slant(const ovoid_shape *s, uint32_t edge, vec3 n) {
    edge_ends e = shape_get_ends(s, edge);
    vec3 d = vec3_unit(vec3_sub(vec3_at(shape_vertices(s), e.to), vec3_at(shape_vertices(s), e.from)));
    return fabs(vec3_dot(d, n));
}

// 1 if no other facet around the extreme vertex can take the place of the kept one: it faces n so well that none is
// better by 1e-6.
static int is_kept_best(const ovoid_shape *s, const facet_choice *c) {
    uint32_t facet = feature_get_index(c->kept);
    if (!c->has_kept || s->rank < 2 || feature_get_kind(c->kept) != OVOID_MANIFOLD_FACET) return 0;
    if (facet >= shape_get_loop_count(s) || feature_get_kind(c->axis) == OVOID_MANIFOLD_EDGE) return 0;
    if (vec3_dot(shape_get_facet_normal(s, facet), c->n) < 1 - 1e-6) return 0;
    uint32_t end = shape_loop_starts(s)[facet + 1], i = shape_loop_starts(s)[facet];
    while (i < end && shape_loop_vertices(s)[i] != c->low) i++;
    return i < end;
}

uint32_t facet_choose(const ovoid_shape *s, const facet_choice *c) {
    uint32_t index = feature_get_index(c->axis);
    if (feature_get_kind(c->axis) == OVOID_MANIFOLD_FACET && s->rank >= 2) return c->axis;
    if (is_kept_best(s, c)) return c->kept;
    int is_edge = feature_get_kind(c->axis) == OVOID_MANIFOLD_EDGE;
    if (s->rank == 1) is_edge = 1, index = shape_loop_edges(s)[0];
    facing best = is_edge ? find_beside(s, index, c) : find_facing(s, c->low, c);
    if (best.facet != UINT32_MAX && best.cosine >= c->least) return OVOID_MANIFOLD_FACET | best.facet;
    if (is_edge && get_slant(s, index, c->n) <= sqrt(1 - c->least * c->least)) return OVOID_MANIFOLD_EDGE | index;
    return OVOID_MANIFOLD_VERTEX | c->low;
}

// ---- after a search ----

// The candidates of one body: the facet that faces n most, and the edge most across it.
typedef struct side {
    const ovoid_shape *shape;
    vec3 n;         ///< toward the other body, in the body's axes
    uint32_t low;   ///< the vertex that is extreme along n
    uint32_t facet; ///< a feature, or UINT32_MAX
    double cosine;  ///< of the facet
    uint32_t edge;  ///< a feature, or UINT32_MAX
} side;

// Of several edges the one whose other end is lowest under the vertex.
uint32_t shape_find_low_edge(const ovoid_shape *s, vec3 n, uint32_t low, double within) {
    edge_range r = get_edges(s, low);
    const double *x = shape_vertices(s);
    double top = vec3_dot(vec3_at(x, low), n), least = within;
    uint32_t found = UINT32_MAX;
    for (uint32_t i = r.first; i < r.end; i++) {
        uint32_t to = shape_neighbors(s)[i];
        double under = top - vec3_dot(vec3_at(x, to), n);
        if (!(under <= least)) continue;
        uint32_t reverse = shape_find_edge(s, to, low);
        if (s->rank >= 2 && shape_edge_facets(s)[i] == shape_edge_facets(s)[reverse]) continue;
        least = under;
        found = OVOID_MANIFOLD_EDGE | (low < to ? i : reverse);
    }
    return found;
}

static side make_side(const ovoid_shape *shape, vec3 n, uint32_t low) {
    side s = {shape, n, low, UINT32_MAX, -2, UINT32_MAX};
    facing best = find_facing(shape, low, &(facet_choice){.n = n});
    if (best.facet != UINT32_MAX) s.facet = OVOID_MANIFOLD_FACET | best.facet, s.cosine = best.cosine;
    return s;
}

// The gap along the normal of the axis, if it is not below the least.
static int take(const pair_frame *f, const manifold_axis *axis, double least, gap_along *along) {
    vec3 n = along->n;
    if (!axis_compute_normal(f, axis, &n)) return 0;
    gap_along found = gap_measure_along(f, n);
    if (!(found.gap >= least)) return 0;
    *along = found;
    return 1;
}

#define NEARLY_FLAT (1 - 1e-9)

manifold_axis axis_choose(const pair_frame *f, double tolerance, gap_along *along) {
    double least = along->gap - tolerance, within = 1e-8 * f->size;
    side a = make_side(f->a, along->n, along->low_a), b;
    manifold_axis axis = {OVOID_MANIFOLD_FACE_A, a.facet, along->low_b};
    if (a.cosine >= NEARLY_FLAT && take(f, &axis, least, along)) return axis;
    b = make_side(f->b, vec3_neg(along->n_in_b), along->low_b);
    axis = (manifold_axis){OVOID_MANIFOLD_FACE_B, a.low, b.facet};
    if (b.cosine >= NEARLY_FLAT && take(f, &axis, least, along)) return axis;
    a.edge = shape_find_low_edge(a.shape, a.n, a.low, within);
    b.edge = shape_find_low_edge(b.shape, b.n, b.low, within);
    axis = (manifold_axis){OVOID_MANIFOLD_EDGES, a.edge, b.edge};
    if (a.edge != UINT32_MAX && b.edge != UINT32_MAX && take(f, &axis, least, along)) return axis;
    axis = (manifold_axis){OVOID_MANIFOLD_FREE, a.edge, b.low};
    if (a.edge != UINT32_MAX && take(f, &axis, least, along)) return axis;
    axis = (manifold_axis){OVOID_MANIFOLD_FREE, a.low, b.edge};
    if (b.edge != UINT32_MAX && take(f, &axis, least, along)) return axis;
    axis = (manifold_axis){OVOID_MANIFOLD_FREE, a.low, b.low};
    if (take(f, &axis, least, along)) return axis;
    *along = gap_measure_along(f, along->n);
    return (manifold_axis){OVOID_MANIFOLD_FREE, OVOID_MANIFOLD_DIRECTION, OVOID_MANIFOLD_DIRECTION};
}
