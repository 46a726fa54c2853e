// The boundaries of facets of regular prisms and pyramids, in closed form.
#ifndef OVOID_SHAPE_REGULAR_LOOPS_H
#define OVOID_SHAPE_REGULAR_LOOPS_H

#include "polytope/regular_solid.h"

/// The tables of loops.h, and the adjacency that they follow from.
typedef struct regular_tables {
    const uint32_t *neighbor_starts, *neighbors;
    uint32_t *tails, *facets;                      ///< of directed edges
    uint32_t *starts, *loop_vertices, *loop_edges; ///< of loops
    uint32_t *room;                                ///< 3 numbers a side
} regular_tables;

/// Fills the tables with what loops_fill finds. Cost: linear.
void regular_loops_fill(const regular_solid *solid, const regular_tables *tables);

#endif
