// Convex polygons: the loop of corners of points that lie in a plane, or nearly so.
#ifndef OVOID_POLYTOPE_POLYGON_H
#define OVOID_POLYTOPE_POLYGON_H

#include "polytope/points.h"

/// The corners of the hull of the points in the projection along an axis (0 to 2), counter-clockwise from its positive
/// end, into loop (room for as many as there are points). By exact signs: points on edges are not corners. The loop
/// begins with its lowest index. Returns the number of corners; 0 if memory runs out. Cost: n log n.
uint32_t polygon_find_loop(const points *p, int axis, uint32_t *loop, const ovoid_allocator *allocator);

#endif
