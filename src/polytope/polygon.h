// Flat bodies: the loop of corners of points that lie in a plane, or nearly so, and the ends of a segment.
#ifndef OVOID_POLYTOPE_POLYGON_H
#define OVOID_POLYTOPE_POLYGON_H

#include "ovoid/polytope.h"
#include "polytope/points.h"

/// The corners of the hull of the points in the projection along an axis (0 to 2), counter-clockwise from its positive
/// end, into loop (room for as many as there are points). By exact signs: points on edges are not corners. The loop
/// begins with its lowest index. Returns the number of corners; 0 if memory runs out. Cost: n log n.
uint32_t polygon_find_loop(const points *p, int axis, uint32_t *loop, const ovoid_allocator *allocator);

/// The ends of a polytope of rank 1, in the order of the vertices. They are the two that have a neighbor, each other; a
/// nearly straight body has vertices between them, at any place in the array.
static inline void polytope_get_ends(const ovoid_polytope *p, uint32_t end[2]) {
    end[0] = 0;
    while (p->neighbor_starts[end[0] + 1] == p->neighbor_starts[end[0]]) end[0]++;
    end[1] = p->neighbors[p->neighbor_starts[end[0]]];
}

#endif
