// Swept spheres without a closed form: GJK over supports of the true cores.
#ifndef OVOID_QUERY_SWEPT_SEARCH_H
#define OVOID_QUERY_SWEPT_SEARCH_H

#include "linear/nearest.h"
#include "ovoid/swept.h"

/// Two cores, of which B's centre is d from A's, and what a search for their nearest points is to find.
typedef struct swept_search {
    const ovoid_swept_sphere *a, *b;
    vec3 d;
    vec3 on_a;        ///< a point of A's core, from A's centre,
    vec3 start;       ///< and the difference of one of B's core and it
    vec3 first;       ///< the first direction, from A to B
    double beyond;    ///< a gap above this answers; INFINITY: none does
    double within;    ///< a distance below this answers; -INFINITY: none does
    double tolerance; ///< so does a gap that is less than this below the distance,
    double radii;     ///< where that is above `radii`; else less than `fine` below it
    double fine;
    double claim; ///< how far the origin has to be inside for an overlap
} swept_search;

/// What ended the search.
typedef enum swept_end {
    SWEPT_OPEN,    ///< rounding, or the number of steps: nothing is known
    SWEPT_BEYOND,  ///< a gap above `beyond`: gap and normal are set
    SWEPT_NEAREST, ///< the nearest points, or two that are nearer than `within`, and a gap that is no more
    SWEPT_INSIDE   ///< the cores have a common point, deeper than `claim`: point_a is set, the difference is zero
} swept_end;

/// Searches. Of *found the parameters are not set.
swept_end swept_find_nearest(const swept_search *query, nearest_pair *found);

#endif
