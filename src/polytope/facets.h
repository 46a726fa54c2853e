// What a triangulated hull is seen as: facets with a plane each, and which vertices are joined.
#ifndef OVOID_POLYTOPE_FACETS_H
#define OVOID_POLYTOPE_FACETS_H

#include "base/allocator.h"
#include "ovoid/polytope.h"
#include "polytope/quickhull.h"

/// Vertices nearer to a plane than this times the largest coordinate of the body frame lie on it, as far as facets and
/// the rank are concerned: 64 roundings, what points on a common plane are off by after a rotation or two.
#define FACET_FLATNESS (64 * 0x1p-53)

/// Twice the area of a triangle as a vector, through double-double: in doubles the normal of a thin triangle is off by
/// a rounding over its least angle.
vec3 compute_area(vec3 a, vec3 b, vec3 c);

/// The direction in which the hull is thinnest, if it is thin: unit, and the thickness along it.
typedef struct thickness {
    vec3 normal;
    double width;
} thickness;
/// Cost: linear. Lengths in units of the grid.
thickness surface_compute_thickness(const surface *s, const double *grid, uint32_t count);

/// The largest coordinate in size.
double compute_extent(const double *xyz, uint32_t count);

/// Joins triangles to facets: from the largest triangle not yet taken, over edges, all whose corners lie on its plane
/// to within FACET_FLATNESS. facet_of: of each triangle; *planes: one a facet, allocated, offset of the vertices'
/// frame. Returns the number of facets, 0 where there is no memory. Cost: n log n.
uint32_t facets_create(const surface *s, const double *grid, const double *vertices, uint32_t count, uint32_t *facet_of,
                       ovoid_plane **planes, const ovoid_allocator *allocator);

/// Who is joined to whom by an edge of a triangle: neighbors of v from starts[v] to starts[v + 1], ascending. Room for
/// count + 1 and 3 triangle_count. Returns 0 where there is no memory. Cost: linear.
int neighbors_compute(const surface *s, uint32_t count, uint32_t *starts, uint32_t *neighbors,
                      const ovoid_allocator *allocator);

#endif
