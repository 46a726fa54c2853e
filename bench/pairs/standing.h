// Where ovoid stands: how many times as fast as the fastest peer it is, and in how many cells it is ahead.
#ifndef OVOID_BENCH_PAIRS_STANDING_H
#define OVOID_BENCH_PAIRS_STANDING_H

#include "pairs/cells.h"

/// The three kinds of queries: of a pair, of prepared shapes, in batches.
typedef enum way { WAY_PAIR, WAY_PREPARED, WAY_BATCH, WAY_COUNT } way;

/// The time of the fastest peer relative to ovoid's, the faster of its cold and warm start; right: of the peers with at
/// most 1 % wrong answers. 0 if one of the two was not measured.
double standing_get_lead(const cells *all, const cell *c, way how, int right);

/// The goal for that ratio: in batches ten, five for distances; else four in motion, two for distances, three.
double standing_get_goal(const cell *c, way how);

typedef struct standing {
    uint32_t cells; ///< with a time of ovoid and of a peer
    uint32_t ahead; ///< of them, those in which ovoid is faster
    uint32_t goal;  ///< of them, those that reach the goal
} standing;

standing standing_count(const cells *all, way how, int right);

/// Prints the leads by workload, question and vertices; for each kind of query the numbers of cells against all peers
/// and against those that are right; then the cells in which a peer is faster.
void standing_print(const cells *all);

#endif
