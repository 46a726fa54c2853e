// The facial areas of a hull's triangles.
#ifndef OVOID_CLI_PAGE_AREAS_H
#define OVOID_CLI_PAGE_AREAS_H

#include <ovoid/ovoid.h>

/// The octants of a shape: their centre in the body frame, and Q^-1/2 up to a positive factor, row by row.
typedef struct page_areas {
    ovoid_vec3 center;
    double root[9];
    int is_there; ///< 0: the shape is flat
} page_areas;

/// The octants of the inner ellipsoid.
page_areas page_areas_make(const ovoid_shape *shape);

/// The octant of a point of the body frame: bit i is set where coordinate i of Q^-1/2 (x - centre) is below 0. 0 for a
/// shape without octants.
unsigned page_areas_get_octant(const page_areas *areas, ovoid_vec3 point);

#endif
