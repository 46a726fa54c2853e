// The convex hull of distinct points as a triangulated surface, without rounding.
#ifndef OVOID_POLYTOPE_QUICKHULL_H
#define OVOID_POLYTOPE_QUICKHULL_H

#include "linear/box.h"
#include "polytope/points.h"

/// The position of a point relative to the hull.
enum { POINT_INSIDE = 0, POINT_ON_FACE = 1, POINT_EXTREME = 2 };

/// The edges of a closed surface whose points are all corners, in both directions, by the points they begin at.
typedef struct surface_edges {
    uint32_t *starts;    ///< those from v are starts[v] to starts[v + 1]; one more than there are points
    uint32_t *neighbors; ///< the ends of the edges, of one point ascending
    uint32_t *corners;   ///< at 3 t + i the edge from corner i of triangle t to the next
} surface_edges;

/// The hull. Members marked (rank 3) are empty for lower ranks.
typedef struct surface {
    uint32_t rank;       ///< dimension of the hull, exactly: 0 to 3
    uint32_t corner[4];  ///< rank + 1 points that span it, the first two far apart; of rank 1 its ends
    uint8_t *state;      ///< where each point lies (rank 3)
    uint32_t *triangles; ///< three points each, counter-clockwise from outside (rank 3)
    uint32_t *across;    ///< at 3 t + i the edge back of that from corner i to i + 1 of t: 4 times its triangle + its
                         ///< number there, 0 to 2 (rank 3)
    vec3 *areas;         ///< of the triangles, twice; NULL until surface_compute_areas (polytope/facets.h)
    surface_edges edges; ///< NULL until surface_find_edges (polytope/facets.h)
    uint32_t triangle_count; ///< 2 corners - 4 (rank 3); the corners are the extreme points if no point is on a face
} surface;

/// The hull of at least one point. Errors: MEMORY, HULL; then *s needs no destroying. Cost: n log n for points in
/// random order, as for quickhull.
ovoid_code quickhull_create(const points *p, const ovoid_allocator *allocator, surface *s, ovoid_error *error);
/// Up to this number of points quickhull_create adds one after another (incremental.c).
enum { INCREMENTAL_MOST = 128 };
/// The surface of at most INCREMENTAL_MOST points whose rank, 3, and first simplex it has. Errors: MEMORY, HULL; what
/// the surface has then must be destroyed. Cost: the square of the number of points.
ovoid_code incremental_find(const points *p, const ovoid_allocator *allocator, surface *s);
/// Sets the rank and the corners of the surface, as quickhull_create does, and nothing else. Cost: linear.
void simplex_find(const points *p, surface *s);

/// The surface of the tetrahedron that four points span, with the members of `surface`.
typedef struct simplex {
    uint32_t triangles[4][3], across[4][3];
} simplex;
simplex simplex_make(const double *grid, const uint32_t corner[4]);

/// The triangle beyond edge k of a triangle.
static inline uint32_t surface_get_across(const surface *s, uint32_t triangle, uint32_t k) {
    return s->across[3 * (size_t)triangle + k] / 4;
}

/// The corner beyond edge k of a triangle, in the triangle across.
static inline uint32_t surface_get_beyond(const surface *s, uint32_t triangle, uint32_t k) {
    uint32_t side = s->across[3 * (size_t)triangle + k], back = side % 4;
    return s->triangles[3 * (size_t)(side / 4) + (back ? back - 1 : 2)];
}

/// The error of (a - c) x (b - c) . (q - c) in doubles is at most this for any points of the box.
double quickhull_bound_heights(const box *b);

void surface_destroy(surface *s, const ovoid_allocator *allocator);

/// The exact sign of the area of a, b, c as seen along an axis (0 to 2): positive where they turn counter-clockwise as
/// seen from the axis' positive end.
int orient2d_sign(vec3 a, vec3 b, vec3 c, int axis);

#endif
