// Boxes in closed form: centre at the origin, edges along the axes, corners in the order of ovoid_shape_create_box.
//
// Such a box is recognised by its vertices alone, wherever it comes from. Its hull, measures and ellipsoids are written
// down in place of being searched for, so they are the same in every way of making it, from a file too.
#ifndef OVOID_POLYTOPE_CENTERED_BOX_H
#define OVOID_POLYTOPE_CENTERED_BOX_H

#include "ovoid/polytope.h"

enum { BOX_VERTICES = 8, BOX_TRIANGLES = 12, BOX_FACETS = 6, BOX_NEIGHBORS = 36 };

/// Coordinate k of vertex i is half[k] where bit k of i is set, else -half[k].
extern const uint32_t centered_box_triangles[3 * BOX_TRIANGLES];
extern const uint32_t centered_box_triangle_facets[BOX_TRIANGLES];
extern const uint32_t centered_box_neighbor_starts[BOX_VERTICES + 1];
extern const uint32_t centered_box_neighbors[BOX_NEIGHBORS];

/// 1 and the half sizes if the vertices are those of such a box, exactly, and the box is not thin: no half size is
/// below 2^-18 of the largest, which lies between 2^-200 and OVOID_LENGTH_MAX. Cost: one test for most other bodies.
int centered_box_find(const double *vertices, size_t count, ovoid_vec3 *half);

/// The planes of the facets.
void centered_box_fill_planes(ovoid_vec3 half, ovoid_plane planes[BOX_FACETS]);

/// Everything but the sphere's radius, whose rounding is the caller's.
ovoid_measures centered_box_compute_measures(ovoid_vec3 half);

#endif
