// The boundaries of a shape's facets, which contacts clip: for each facet its corners in order, counter-clockwise from
// outside, with the edges between them. A flat polygon has two facets, its sides. A segment counts as one facet of two
// corners, a point as one of one.
//
// An edge is named by its place in the list of neighbors: that of its end with the higher index in the list of the
// other. Each place is a directed edge, from the vertex of the list to the neighbor.
#ifndef OVOID_SHAPE_LOOPS_H
#define OVOID_SHAPE_LOOPS_H

#include "shape/block.h"

static inline const uint32_t *shape_neighbor_starts(const ovoid_shape *s) {
    return (const uint32_t *)((const char *)s + s->at.neighbor_starts);
}
static inline const uint32_t *shape_neighbors(const ovoid_shape *s) {
    return (const uint32_t *)((const char *)s + s->at.neighbors);
}
static inline const ovoid_plane *shape_planes(const ovoid_shape *s) {
    return (const ovoid_plane *)((const char *)s + s->at.planes);
}
/// The vertex at which a directed edge begins.
static inline const uint32_t *shape_edge_tails(const ovoid_shape *s) {
    return (const uint32_t *)((const char *)s + s->at.edge_tails);
}
/// The facet to the left of a directed edge, seen from outside.
static inline const uint32_t *shape_edge_facets(const ovoid_shape *s) {
    return (const uint32_t *)((const char *)s + s->at.edge_facets);
}
/// loop_count + 1 offsets into the two lists below.
static inline const uint32_t *shape_loop_starts(const ovoid_shape *s) {
    return (const uint32_t *)((const char *)s + s->at.loop_starts);
}
static inline const uint32_t *shape_loop_vertices(const ovoid_shape *s) {
    return (const uint32_t *)((const char *)s + s->at.loop_vertices);
}
/// The edge from a corner to the next.
static inline const uint32_t *shape_loop_edges(const ovoid_shape *s) {
    return (const uint32_t *)((const char *)s + s->at.loop_edges);
}

/// The number of loops of a body of that rank and number of facets.
static inline uint32_t loops_get_count(uint32_t rank, uint32_t facet_count) {
    return rank == 3 ? facet_count : rank == 2 ? 2 : 1;
}
static inline uint32_t shape_get_loop_count(const ovoid_shape *s) { return loops_get_count(s->rank, s->counts.facets); }

/// The outward normal of a facet of a solid or a flat polygon.
static inline ovoid_vec3 shape_get_facet_normal(const ovoid_shape *s, uint32_t facet) {
    if (s->rank == 2 && facet == 1) return vec3_neg(shape_planes(s)[0].normal);
    return shape_planes(s)[facet].normal;
}

/// The directed edge from one vertex to a neighbor of it; UINT32_MAX if they are not joined. Neighbors ascend, but for
/// the two of a polygon's corner.
static inline uint32_t shape_find_edge(const ovoid_shape *s, uint32_t from, uint32_t to) {
    const uint32_t *starts = shape_neighbor_starts(s), *neighbors = shape_neighbors(s);
    uint32_t low = starts[from], end = starts[from + 1];
    for (uint32_t high = end; high - low > 8;) {
        uint32_t middle = low + (high - low) / 2;
        if (neighbors[middle] <= to)
            low = middle;
        else
            high = middle;
        end = high;
    }
    for (uint32_t i = low; i < end; i++)
        if (neighbors[i] == to) return i;
    return UINT32_MAX;
}

/// The numbers that loops_fill works with.
size_t loops_get_room(block_counts counts);

/// Fills the tables of a block whose polytope is there, that of the hull. Cost: linear.
void loops_fill(ovoid_shape *shape, const struct hull *polytope, uint32_t *room);

#endif
