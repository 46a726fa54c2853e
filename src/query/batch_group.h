// Couples of small bodies in a batch, a lane group at a time: GJK from the spheres or the ellipsoids to the answer
// without leaving the lanes (simd/group_gjk.h).
#ifndef OVOID_QUERY_BATCH_GROUP_H
#define OVOID_QUERY_BATCH_GROUP_H

#include "query/batch_ends.h"

/// Searches the lanes `some` of a group e that the spheres have placed, or the ellipsoids too. The bodies are small,
/// and no inner ellipsoid is tried.
void group_search_run(const group_search *task, const lane_group *e, unsigned some);

#endif
