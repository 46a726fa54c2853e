// Regular prisms and pyramids in closed form: the axis is z, the origin halfway up it.
//
// Such a body is recognised by its vertices alone, wherever it comes from: a ring of corners at height -half_length,
// counter-clockwise, then the same ring at +half_length, or the apex on the axis there. Its hull and measures are
// written down in place of being searched for, so they are the same in every way of making it, from a file too.
#ifndef OVOID_POLYTOPE_REGULAR_SOLID_H
#define OVOID_POLYTOPE_REGULAR_SOLID_H

#include "ovoid/polytope.h"

/// Regular solids have at most this many sides: their error bounds grow with the number.
enum { REGULAR_SIDES_MOST = 4096 };

typedef struct regular_solid {
    int is_prism;           ///< else a pyramid, whose apex is the last vertex
    uint32_t sides;         ///< corners of the ring
    double radius_squared;  ///< of corner 0 from the axis
    double apothem_squared; ///< of the middle of the first side from the axis
    double half_length;     ///< along z
} regular_solid;

/// How far a corner of the ring may be off its place in a regular polygon, relative to the radius; regular_solid.c has
/// the proof. Each of the two polygons, enlarged by 2.1 times this share, holds the other.
static inline double regular_solid_get_error(const regular_solid *s) { return s->sides * 0x1p-44; }

/// 1 if the vertices are those of such a body. Radius and half length are no less than 2^-18 of the larger of them,
/// which lies between 2^-200 and OVOID_LENGTH_MAX / 2. Cost: one test for most other bodies.
int regular_solid_find(const double *vertices, size_t count, regular_solid *solid);

/// The facets are the sides, side i from corner i to the next, then the lower end, then the upper end of a prism.
static inline uint32_t regular_solid_count_facets(const regular_solid *s) { return s->sides + 1 + s->is_prism; }
/// Euler's formula: 2 n - 4 triangles of n vertices.
static inline uint32_t regular_solid_count_triangles(const regular_solid *s) {
    return (s->is_prism ? 4 : 2) * (s->sides - 1);
}

/// The corner after corner i, and the corner above it; the corner above any corner of a pyramid is the apex.
static inline uint32_t regular_solid_get_next(const regular_solid *s, uint32_t i) {
    return i + 1 < s->sides ? i + 1 : 0;
}
static inline uint32_t regular_solid_get_above(const regular_solid *s, uint32_t i) {
    return s->is_prism ? s->sides + i : s->sides;
}

/// The triangles and the facet of each.
void regular_solid_fill_triangles(const regular_solid *solid, uint32_t *triangles, uint32_t *facets);
/// The neighbors of each vertex, ascending: room for one start more than there are vertices, and for three neighbors a
/// triangle.
void regular_solid_fill_neighbors(const regular_solid *solid, uint32_t *starts, uint32_t *neighbors);
/// The planes of the facets.
void regular_solid_fill_planes(const regular_solid *solid, const double *vertices, ovoid_plane *planes);

/// Everything but the box and the sphere's radius, which are the caller's.
ovoid_measures regular_solid_compute_measures(const regular_solid *solid, const double *vertices);

#endif
