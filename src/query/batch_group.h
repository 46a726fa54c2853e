// Couples of small bodies in a batch, a lane group at a time: GJK from the spheres or the ellipsoids to the answer
// without leaving the lanes (simd/group_gjk.h).
#ifndef OVOID_QUERY_BATCH_GROUP_H
#define OVOID_QUERY_BATCH_GROUP_H

#include "query/answer.h"
#include "query/lane_group.h"

/// What is done with a couple that ends. query, end: its answer; end NULL: it is unusual, and has to be queried alone.
typedef struct small_owner {
    void (*finish)(void *self, size_t index, const placed_query *query, const small_end *end);
    void *self;
    int wants_evidence; ///< else `finish` reads of an end only what a verdict says and the proof's kind, and no frame
} small_owner;

/// What is asked of the couples.
typedef struct group_search {
    const query_goal *goal; ///< the tolerance is each couple's own
    const pair8_query *numbers;
    int is_along_n;    ///< 1 to begin along the ellipsoids' direction, 0 for the line of centres
    small_owner owner; ///< its `finish` reads the query's frame only of an end without witness points
    int wants_corners; ///< proofs or answers are wanted, which `finish` writes
    /// The batch's, or NULL: written here where no proof is wanted and the lanes have all that is.
    ovoid_verdict *verdicts;
    ovoid_witness *witnesses;
} group_search;

/// Searches the lanes `some` of a group e that the spheres have placed, or the ellipsoids too. The bodies are small,
/// and no inner ellipsoid is tried.
void group_search_run(const group_search *task, const lane_group *e, unsigned some);

#endif
