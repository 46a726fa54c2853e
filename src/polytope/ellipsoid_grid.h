// Polyhedra inscribed in ellipsoids in closed form: the axes are x, y and z, the origin is the centre.
//
// A grid of n steps has the points (x, y, z) of integers with |x| + |y| + |z| = n, brought to the unit sphere and
// scaled by the half axes: those of an octahedron's faces, each divided into n^2 triangles. In doubles they are a (x /
// l) with l = sqrt(x x + y y + z z), within 4 u a of the ellipsoid for the largest half axis a, u = 2^-53. Such a body
// is recognised by its vertices alone. They are in rings from the upper tip down; ring k has the height z = n - k and 4
// m vertices, m = min(k, 2 n - k), counter-clockwise from x = m, y = 0; a tip is one vertex.
#ifndef OVOID_POLYTOPE_ELLIPSOID_GRID_H
#define OVOID_POLYTOPE_ELLIPSOID_GRID_H

#include "ovoid/polytope.h"

enum { GRID_STEPS_LEAST = 2, GRID_STEPS_MOST = 64 };

/// The least half axis of such a body, as a part of the largest, and the largest one's least length: squares and their
/// quotients stay normal numbers.
#define GRID_FLATTEST 0x1p-20
#define GRID_LEAST 0x1p-200

typedef struct ellipsoid_grid {
    ovoid_vec3 half; ///< axes
    uint32_t steps;
    double
        ball; ///< in units of the half axes the polyhedron holds the ball of this radius, but for 16 n u, and no larger
} ellipsoid_grid;

/// The point of the grid with |x| + |y| + |z| = its steps.
ovoid_vec3 ellipsoid_grid_get_point(ovoid_vec3 half, int x, int y, int z);

/// 1 if half axes and n steps are those of such a body. Cost: linear in a sixth of the vertices.
int ellipsoid_grid_make(ovoid_vec3 half, uint32_t n, ellipsoid_grid *grid);

static inline uint32_t ellipsoid_grid_count_vertices(uint32_t steps) { return 4 * steps * steps + 2; }
static inline uint32_t ellipsoid_grid_count_triangles(uint32_t steps) { return 8 * steps * steps; }

/// 1 if the vertices are those of such a body. Cost: one test for most other bodies.
int ellipsoid_grid_find(const double *vertices, size_t count, ellipsoid_grid *grid);

/// Its parts, each triangle a facet, as in regular_solid.h. Any half axes have vertices.
void ellipsoid_grid_fill_vertices(ovoid_vec3 half, uint32_t n, double *xyz);
void ellipsoid_grid_fill_triangles(const ellipsoid_grid *grid, uint32_t *triangles, uint32_t *facets);
void ellipsoid_grid_fill_planes(const ellipsoid_grid *grid, const uint32_t *triangles, const double *vertices,
                                ovoid_plane *planes);

/// Everything but the box and the sphere's radius, which are the caller's.
ovoid_measures ellipsoid_grid_compute_measures(const ellipsoid_grid *grid);

#endif
