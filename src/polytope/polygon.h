// Convex polygons: the loop of points that lie in a plane, or nearly so.
#ifndef OVOID_POLYTOPE_POLYGON_H
#define OVOID_POLYTOPE_POLYGON_H

#include "base/allocator.h"
#include "linear/vec3.h"

/// The corners of the hull of the points as seen along an axis (0 to 2), counter-clockwise from its positive end, into
/// loop (room for count); exactly, points on edges are no corners. The loop begins with its lowest index. Returns how
/// many there are; 0 where there is no memory. Cost: n log n.
uint32_t polygon_find_loop(const double *grid, uint32_t count, int axis, uint32_t *loop,
                           const ovoid_allocator *allocator);

#endif
