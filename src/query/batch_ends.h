// What small couples of a batch end with, lane by lane: whatever is wanted of it is written in its place.
#ifndef OVOID_QUERY_BATCH_ENDS_H
#define OVOID_QUERY_BATCH_ENDS_H

#include "query/answer.h"
#include "query/lane_group.h"
#include "simd/group_gjk.h"

/// What is done with a couple that does not end at nearest points. query, end: its answer; end NULL: it is unusual, and
/// has to be queried alone.
typedef struct small_owner {
    void (*finish)(void *self, size_t index, const placed_query *query, const small_end *end);
    void *self;
    int wants_evidence; ///< else `finish` reads of an end only what a verdict says and the proof's kind, and no frame
} small_owner;

/// What is asked of the couples.
typedef struct group_search {
    const query_goal *goal; ///< the tolerance is each couple's own
    const pair8_query *numbers;
    int is_along_n; ///< of the search in doubles: 1 to begin along the ellipsoids' direction, 0 for the line of centres
    small_owner owner; ///< its `finish` reads the query's frame only of an end without witness points
    const ovoid_batch *to;
} group_search;

/// The goal of a lane.
static inline query_goal group_get_goal(const group_search *task, const lane_group *e, unsigned k) {
    query_goal goal = *task->goal;
    goal.tolerance = e->lanes->tolerance.lane[k];
    return goal;
}
static inline void group_finish(const group_search *task, size_t index, const placed_query *query,
                                const small_end *end) {
    task->owner.finish(task->owner.self, index, query, end);
}

/// Lanes that ended at nearest points: bounds, points, the corners behind them.
typedef struct group_result {
    group_nearest nearest;
    uint32_t a[PAIR8][3], b[PAIR8][3]; ///< vertices; of corners that are none any
    uint32_t count[PAIR8];
    uint32_t steps[PAIR8]; ///< of the simplex
} group_result;

/// Writes what the lanes of a mask ended with. Those whose bounds do not answer the query are left to be queried alone.
void group_end_at_points(const group_search *task, const lane_group *e, unsigned lanes, const group_result *r);

#endif
