// Few of many points that still strictly contain the origin: from the surface of EPA to the proof of an overlap.
#ifndef OVOID_EXACT_HULL_REDUCE_H
#define OVOID_EXACT_HULL_REDUCE_H

#include "exact/expand.h"

enum { HULL_POINTS_MAX = 32 };
EXPANSION_ROOM(hull_room, HULL_POINTS_MAX, 3 * HULL_POINTS_MAX);

/// What hull_find_reduced works in, 8 KB.
typedef struct hull_memory {
    expansion hull;
    hull_room room;
    vec3 left[HULL_POINTS_MAX];
} hull_memory;

/// Points whose hull is to contain the origin.
typedef struct hull_points {
    const vec3 *w;
    int count;
    double error; ///< of each coordinate
    double slack; ///< how far above a face a point must be to count as outside (expand.h)
} hull_points;

/// Chooses 4 to 6 of the points (at most HULL_POINTS_MAX) for hull_compute_depth (pair/hull.h), in its order, into
/// kept. Returns their number; 0 if the points are not proven to contain the origin, or no such choice is found. Drops
/// points one after another as long as the origin stays inside the hull of the rest; what cannot be reduced has at most
/// six (Steinitz 1913), and six only as three opposite pairs. Cost: at most a hull for each point.
int hull_find_reduced(hull_memory *memory, const hull_points *points, int kept[6]);

#endif
