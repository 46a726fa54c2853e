// The points of a body, prepared for its hull: validated, moved to the body frame, each kept once.
#ifndef OVOID_POLYTOPE_POINTS_H
#define OVOID_POLYTOPE_POINTS_H

#include "linear/vec3.h"

/// The largest number of points of a body: the working memory is below 150 bytes a point and 600 a vertex.
#define POINTS_MAX ((size_t)1 << 24)

/// The distinct points of a body.
typedef struct points {
    double *grid;     ///< xyz in units of the grid: only for exact signs and the search for them
    uint32_t *source; ///< the index at which each point was first given, ascending
    uint32_t count;
    uint64_t duplicates; ///< points that equal an earlier one
    vec3 origin;         ///< of the body frame; given - origin is exact for every point
    double factor[2];    ///< from lengths to units of the grid, a power of two in two factors
} points;

/// Fills *p. Errors: EMPTY, LIMIT, NOT_FINITE and RANGE (place: the point), MEMORY; *p needs no destroying then.
/// Cost: linear.
ovoid_code points_create(xyz_points given, const ovoid_allocator *allocator, points *p, ovoid_error *error);
/// points_create for points that are known to be distinct.
ovoid_code points_create_distinct(xyz_points given, const ovoid_allocator *allocator, points *p, ovoid_error *error);
/// A point of the body frame in units of the grid.
vec3 points_to_grid(const points *p, vec3 v);
void points_destroy(points *p, const ovoid_allocator *allocator);

/// The first point that equals each one, 0 and -0 being equal; count at most POINTS_MAX. 0 if memory runs out.
int points_find_first(const double *xyz, size_t count, const ovoid_allocator *allocator, uint32_t *first);

/// Drops the points where keep is zero.
void points_keep(points *p, const uint8_t *keep);

#endif
