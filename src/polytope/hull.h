// From points to a polytope that owns its arrays.
#ifndef OVOID_POLYTOPE_HULL_H
#define OVOID_POLYTOPE_HULL_H

#include "linear/vec3.h"
#include "ovoid/polytope.h"
#include "polytope/closed_form.h"

/// A hull. The arrays belong to it; they are those of ovoid_polytope.
typedef struct hull {
    double *vertices;
    uint32_t *triangles, *triangle_facets, *neighbor_starts, *neighbors;
    uint32_t *corner_edges; ///< at 3 t + i the edge from corner i of triangle t, as its place in the list of neighbors;
                            ///< NULL for a flat body, a box and a regular solid
    ovoid_plane *planes;
    ovoid_report report;
    ovoid_vec3 origin;
    uint32_t vertex_count, triangle_count, facet_count, rank;
    closed_form form; ///< if the arrays are those of a closed form
} hull;

/// The convex hull of the points: exactly its extreme points, in their given order, in the body frame. Everything but
/// the report and the origin depends on these vertices alone: the hull of a hull's vertices is that hull, bit for bit.
/// Errors: EMPTY, LIMIT, NOT_FINITE and RANGE (place: the point), MEMORY, HULL; then *polytope needs no destroying.
/// Cost: n log n for points in random order.
ovoid_code hull_create(xyz_points given, const ovoid_allocator *allocator, hull *polytope, ovoid_error *error);

/// A surface that is claimed to be the hull of points of full dimension, each of them extreme.
typedef struct surface_claim {
    const double *xyz; ///< the points
    size_t count;
    const uint32_t *triangles; ///< three points each, counter-clockwise from outside
    uint32_t triangle_count;
    vec3 inside; ///< a point of the interior
} surface_claim;

/// Why a claim does not hold.
typedef struct surface_flaw {
    const char *what;
    uint32_t index; ///< of the triangle, or of the vertex
    int is_vertex;
} surface_flaw;

/// The hull of vertices whose surface is claimed: the claim is proven, then facets, planes and adjacency are computed
/// from it. With the triangles of hull_create and its vertices the result is that hull, bit for bit, at a fraction of
/// the cost; with other valid triangles it is the same body with those triangles. A rank below 3, to rounding, is no
/// error; the triangles are then not those of the claim. Errors: MEMORY; HULL, with *flaw filled. Then *polytope needs
/// no destroying. Cost: linear.
ovoid_code hull_create_proven(const surface_claim *claim, const ovoid_allocator *allocator, hull *polytope,
                              surface_flaw *flaw);
void hull_destroy(hull *polytope, const ovoid_allocator *allocator);

/// A view of the hull.
ovoid_polytope hull_get_polytope(const hull *polytope);

#endif
