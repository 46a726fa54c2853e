/**
 * @file polytope.h
 * A polyhedron: vertices, faces, adjacency, planes, measures.
 */
#ifndef OVOID_POLYTOPE_H
#define OVOID_POLYTOPE_H

#include "ovoid/linear.h"

#ifdef __cplusplus
extern "C" {
#endif

/**
 * A plane { x : normal . x = offset } with a unit outward normal, rounded. It approximates a facet and is never used as
 * a proof.
 */
typedef struct ovoid_plane {
    ovoid_vec3 normal;
    double offset;
} ovoid_plane;

/**
 * A view of a convex polyhedron in its body frame; it owns nothing and lives as long as the shape it came from.
 *
 * The body frame is the user's local frame moved by `origin`: a user's vertex is origin + vertex, exactly. The origin
 * is zero unless the points lie far from their own frame's origin.
 *
 * rank 3: a solid; triangles form a closed surface, counter-clockwise from outside, exactly convex.
 * rank 2: a flat polygon; triangles are the fan of one side: corner 0, then 1 and 2 of the first, 2 of each next one.
 * rank 1: a segment. rank 0: one point. Both have no triangles and no planes.
 *
 * A body whose thickness is rounding (64 roundings of its largest coordinate) has a rank below 3 though its vertices
 * are not exactly coplanar. It keeps every extreme point, so some vertices may not be corners of the polygon or ends of
 * the segment; those have no neighbors. The body is always the convex hull of the vertices; planes describe it to
 * rounding.
 */
typedef struct ovoid_polytope {
    const double *vertices;          /**< xyz of vertex i at 3 i; finite */
    const uint32_t *triangles;       /**< three vertices of triangle t at 3 t */
    const uint32_t *triangle_facets; /**< the facet of triangle t */
    const ovoid_plane *planes;       /**< plane of facet f (rank 3), or of the polygon (rank 2, one facet) */
    const uint32_t *neighbor_starts; /**< vertex_count + 1 offsets into neighbors */
    const uint32_t *neighbors;       /**< of a vertex: by edges of triangles, ascending (rank 3); by the
                                          edges of the polygon, before and after (2); the other end (1) */
    ovoid_vec3 origin;               /**< of the body frame, in the user's local frame */
    uint32_t vertex_count;
    uint32_t triangle_count;
    uint32_t facet_count; /**< facets: triangles joined where flat to rounding */
    uint32_t rank;        /**< 0 point, 1 segment, 2 flat, 3 solid */
} ovoid_polytope;

/** What the constructor did with the given points. points = vertices + duplicates + interior. */
typedef struct ovoid_report {
    uint64_t points;     /**< points given */
    uint64_t vertices;   /**< vertices kept */
    uint64_t duplicates; /**< points dropped because an equal point (same three doubles) came before */
    uint64_t interior; /**< points dropped because exact arithmetic proves that they are in the hull of the vertices */
    uint64_t coplanar; /**< of the interior points, those exactly on a face */
    uint64_t faces;    /**< faces given, 0 for points only */
    uint32_t rank;     /**< 0 point, 1 segment, 2 flat, 3 solid */
} ovoid_report;

/** Measures of the polyhedron without its rounding radius; body frame, unit density. */
typedef struct ovoid_measures {
    double volume;       /**< 0 where rank < 3 */
    double area;         /**< surface; of a flat polygon both sides */
    ovoid_vec3 centroid; /**< of the volume; of area, length or point where rank < 3 */
    ovoid_sym3
        inertia;   /**< inertia tensor about the centroid; of area or length where rank < 3, one side of a polygon */
    ovoid_box box; /**< of the vertices */
    ovoid_vec3 sphere_center;
    double sphere_radius; /**< of a sphere that encloses every vertex, rounding included; near the smallest */
} ovoid_measures;

/** Measures of a polyhedron. Cost: linear in triangles and vertices. */
OVOID_API ovoid_measures ovoid_polytope_compute_measures(const ovoid_polytope *polytope);

#ifdef __cplusplus
}
#endif
#endif
