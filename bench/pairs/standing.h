// The number of cells in which ovoid is the fastest, and the others.
#ifndef OVOID_BENCH_PAIRS_STANDING_H
#define OVOID_BENCH_PAIRS_STANDING_H

#include "pairs/cells.h"

/// Prints, for each kind of query, in how many cells it is faster than all peers and than those that are right, and in
/// how many it reaches the goal; then the cells in which a peer is faster.
void standing_print(const cells *all);

#endif
