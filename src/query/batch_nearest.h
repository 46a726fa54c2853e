// Distances of small couples of a batch, sixteen at a time: GJK in single precision finds which corners the nearest
// points lie between (simd/float_gjk.h), and the answer is made and proven from these in doubles, eight at a time
// (simd/group_gjk.h). What floats leave open, or cannot find the corners of, is left to be queried alone.
#ifndef OVOID_QUERY_BATCH_NEAREST_H
#define OVOID_QUERY_BATCH_NEAREST_H

#include "query/batch_ends.h"

enum { NEAREST_GROUPS = FLOATS / PAIR8 };

/// The state of a batch: 33 KB.
typedef struct batch_nearest {
    // A search at work.
    float_gjk search;
    float_found own;
    pair8_floats numbers[NEAREST_GROUPS];
    // The groups.
    pair8 lanes[NEAREST_GROUPS + 1];
    lane_group groups[NEAREST_GROUPS];
    lane_group far; ///< the caller's, for couples that are not for floats
    const pair8_kernels *kernels;
    const group_search *task; ///< its goal is a distance without a cap
    /// Lane groups that the spheres have placed, and which of their lanes are asked for; those from `count` on are
    /// free.
    lane_group *at[NEAREST_GROUPS];
    unsigned some[NEAREST_GROUPS], count;
    unsigned near, inside;    ///< lanes that ended so,
    const float_found *found; ///< at these corners: those of `search` or, where it was of one couple at a time, `own`
} batch_nearest;

void batch_nearest_begin(batch_nearest *w, const group_search *task, const pair8_kernels *kernels);

/// Adds the lanes `some` of a group, which the state takes; *place becomes a free one. Their bodies are small
/// (small_fits), and no inner ellipsoid is tried. They may be answered or left open now, as may those that waited.
void batch_nearest_add(batch_nearest *w, lane_group **place, unsigned some);

/// Ends all that wait.
void batch_nearest_end(batch_nearest *w);

#endif
