// From points to a polytope that owns its arrays.
#ifndef OVOID_POLYTOPE_HULL_H
#define OVOID_POLYTOPE_HULL_H

#include "ovoid/polytope.h"

/// A hull. The arrays belong to it; they are those of ovoid_polytope.
typedef struct hull {
    double *vertices;
    uint32_t *triangles, *triangle_facets, *neighbor_starts, *neighbors;
    ovoid_plane *planes;
    ovoid_report report;
    ovoid_vec3 origin;
    uint32_t vertex_count, triangle_count, facet_count, rank;
} hull;

/// The convex hull of the points: exactly its extreme points, in the order given, in the body frame. All but the report
/// and the origin depends on these vertices alone: the hull of a hull's vertices is that hull, bit for bit.
/// Errors: EMPTY, LIMIT, NOT_FINITE and RANGE (place: the point), MEMORY, HULL; *h needs no destroying then.
/// Cost: n log n for points as they come.
ovoid_code hull_create(const double *xyz, size_t count, const ovoid_allocator *allocator, hull *h, ovoid_error *error);
void hull_destroy(hull *h, const ovoid_allocator *allocator);

/// A view of the hull.
ovoid_polytope hull_get_polytope(const hull *h);

#endif
