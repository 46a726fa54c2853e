// The ends of a segment.
#ifndef OVOID_POLYTOPE_SEGMENT_H
#define OVOID_POLYTOPE_SEGMENT_H

#include "ovoid/polytope.h"

/// The ends of a polytope of rank 1, in the order of the vertices. They are the two that have a neighbor, each other; a
/// nearly straight body has vertices between them, at any place in the array.
static inline void polytope_get_ends(const ovoid_polytope *p, uint32_t end[2]) {
    end[0] = 0;
    while (p->neighbor_starts[end[0] + 1] == p->neighbor_starts[end[0]]) end[0]++;
    end[1] = p->neighbors[p->neighbor_starts[end[0]]];
}

#endif
