// Facets of a triangulated hull, each with a plane, and the adjacency of its vertices.
#ifndef OVOID_POLYTOPE_FACETS_H
#define OVOID_POLYTOPE_FACETS_H

#include "ovoid/polytope.h"
#include "polytope/quickhull.h"

/// Vertices nearer to a plane than this times the largest coordinate of the body frame count as on it, for facets and
/// for the rank: 64 roundings, the error of points on a common plane after a rotation or two.
#define FACET_FLATNESS (64 * 0x1p-53)

/// Twice the area of a triangle as a vector, through double-double (simd/areas.h).
vec3 compute_area(vec3 a, vec3 b, vec3 c);

/// Fills s->areas: twice the area of each triangle. 0 if memory runs out. Cost: linear.
int surface_compute_areas(surface *s, const double *grid, const ovoid_allocator *allocator);

/// How thick a hull is.
typedef struct thickness {
    vec3 normal;  ///< unit; of a thin hull the direction in which it is thinnest
    double width; ///< along the normal, in units of the grid
} thickness;
/// The thickness of the hull of count points; the areas must be there. Cost: linear.
thickness surface_compute_thickness(const surface *s, const double *grid, uint32_t count);

/// The largest absolute value of a coordinate of count points.
double compute_extent(const double *xyz, uint32_t count);

/// The facets of a surface.
typedef struct facets {
    const double *vertices; ///< given: what the planes are of
    uint32_t *of;           ///< the facet of each triangle; room is given
    ovoid_plane *planes;    ///< one a facet, allocated
    uint32_t count;
} facets;

/// Joins triangles to facets: from the largest triangle not yet taken, over edges, all whose corners lie on its plane
/// to within FACET_FLATNESS. p: the vertices as points. The areas must be computed. 0 if memory runs out. Cost: linear.
int facets_create(const surface *s, const points *p, facets *f, const ovoid_allocator *allocator);

/// Fills s->edges for a surface of count points from its triangles alone, which need not be those of a hull. 0 if
/// memory runs out. Cost: linear.
int surface_find_edges(surface *s, uint32_t count, const ovoid_allocator *allocator);

#endif
