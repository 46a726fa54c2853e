// Distances of small bodies in a batch, a lane group at a time: GJK from the spheres to the points without leaving the
// lanes (simd/group_gjk.h).
#ifndef OVOID_QUERY_BATCH_GROUP_H
#define OVOID_QUERY_BATCH_GROUP_H

#include "query/batch_small.h"
#include "query/lane_group.h"

/// What is asked of the couples, and what is done with one that ends.
typedef struct group_search {
    const query_goal *goal; ///< a distance without a cap; the tolerance is each couple's own
    const pair8_query *numbers;
    small_owner owner; ///< its `finish` reads the query's frame only of an end without witness points
    int wants_corners; ///< proofs or answers are wanted, which `finish` writes
    /// The batch's, or NULL: written here where no proof is wanted and a couple ends at its nearest points.
    ovoid_verdict *verdicts;
    ovoid_witness *witnesses;
} group_search;

/// Searches the lanes `some` of a group e that the spheres have placed. The bodies are small, and the inner ellipsoids
/// are not tried.
void group_search_run(const group_search *task, const lane_group *e, unsigned some);

#endif
