// Of how many cells ovoid is the fastest, and where it is not.
#ifndef OVOID_BENCH_PAIRS_STANDING_H
#define OVOID_BENCH_PAIRS_STANDING_H

#include "pairs/cells.h"

/// Prints, for each way of asking, in how many cells it is ahead of all peers and of the right ones, and how many times
/// it is as fast as the goal wants; then the cells in which a peer is ahead.
void standing_print(const cells *all);

#endif
