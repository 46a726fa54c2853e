/**
 * @file solid.h
 * Solids of triangles, convex or not. Queries about them are in <ovoid/body.h>.
 * A solid is immutable: any number of bodies and threads share it.
 */
#ifndef OVOID_SOLID_H
#define OVOID_SOLID_H

#include "ovoid/shape.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The largest number of triangles of a solid. */
#define OVOID_SOLID_TRIANGLES_MAX ((size_t)1 << 26)

/** Triangles and their points, borrowed. */
typedef struct ovoid_triangles {
    const double *xyz; /**< xyz of point i at 3 i */
    size_t point_count;
    const uint32_t *indices; /**< three points of triangle t at 3 t, counter-clockwise from outside */
    size_t count;            /**< of triangles */
} ovoid_triangles;

/**
 * Triangles and a tree of boxes over them, in one block of memory.
 *
 * The triangles are closed if their edges cancel: each piece of a line occurs as often in one direction as in the
 * other, exactly. Equal points count as one, an edge may be matched by several shorter edges that make it up, and the
 * edges of a triangle without area do not count. If the triangles are closed, the body is the set of all points of them
 * and all points around which they wind; their orientation does not matter, and duplicates do not either. If they are
 * not closed, the body is the surface itself, which has no inside.
 */
typedef struct ovoid_solid ovoid_solid;

/** Facts about the triangles. */
typedef struct ovoid_solid_report {
    uint64_t points;          /**< points that triangles use; equal ones count once */
    uint64_t triangles;       /**< as given */
    uint64_t components;      /**< sets of triangles that share points */
    uint64_t edges_unmatched; /**< edges, or pieces of them, that do not occur as often in each direction; 0: the
                                 surface is closed */
    uint64_t edges_crowded;   /**< edges of more than two triangles */
    uint64_t degenerate; /**< triangles without area, as far as pairs of doubles can tell: two equal corners, or three
                            on a line */
    uint64_t duplicates; /**< triangles with the three points of an earlier one, in any order */
    int is_closed;       /**< 1: a solid; 0: a surface */
    double volume;       /**< signed: below 0 if the solid is inside out; rounded; 0 if it is not closed */
    int is_flat; /**< 1: closed, but encloses no more than rounding may have left: its mean thickness, twice the volume
                    over the area, is below 2^-39 of its size. A sheet with two sides */
    double area; /**< rounded */
    ovoid_box box; /**< of the points; solid's frame */
} ovoid_solid_report;

/** Options of a solid; all zero, or NULL, is the default. */
typedef struct ovoid_solid_options {
    const ovoid_allocator *allocator; /**< NULL: malloc and free; copied. Working memory comes from it too, and is freed
                                         before the call returns */
} ovoid_solid_options;

/**
 * A solid of one triangle or more, which are copied. Every triangle is kept, also one without area. Returns NULL with
 * *error filled (may be NULL): ARGUMENT, EMPTY, LIMIT, NOT_FINITE (place: the point), RANGE, INDEX (place: the
 * triangle), MEMORY. The caller destroys it. Cost: n log n.
 */
OVOID_API ovoid_solid *ovoid_solid_create_from_triangles(const ovoid_triangles *triangles,
                                                         const ovoid_solid_options *options, ovoid_error *error);
/** Frees it; NULL is allowed. No query may be using it. */
OVOID_API void ovoid_solid_destroy(ovoid_solid *solid);

/** Facts about the triangles. */
OVOID_API ovoid_solid_report ovoid_solid_get_report(const ovoid_solid *solid);
/** The points: xyz of point i at 3 i, report.points of them. A view into the solid. */
OVOID_API const double *ovoid_solid_get_points(const ovoid_solid *solid);
/** The points of triangle i < report.triangles, in their given order. */
OVOID_API void ovoid_solid_get_triangle(const ovoid_solid *solid, size_t i, uint32_t points[3]);
/** The triangles in the order of the tree. Exclusions name ranges of this array. A view into the solid. */
OVOID_API const uint32_t *ovoid_solid_get_order(const ovoid_solid *solid);
/** Size of the block in bytes. */
OVOID_API size_t ovoid_solid_get_size(const ovoid_solid *solid);

/**
 * How often a closed solid winds around a point of its frame, exactly: 0 outside, 1 inside a solid with outward
 * orientation, -1 inside one that is inside out. Returns 1 if *winding is written; 0 if the solid is not closed, the
 * point is on its surface (to within the underflow of exact signs) or not finite. Points with coordinates above
 * OVOID_LENGTH_MAX count as outside. Cost: the boxes along a ray.
 */
OVOID_API int ovoid_solid_compute_winding(const ovoid_solid *solid, ovoid_vec3 point, int64_t *winding);

/** How the body of triangles differs from the convex hull of their points. */
typedef struct ovoid_hull_match {
    int is_closed;            /**< as in a solid's report */
    uint64_t edges_unmatched; /**< as in a solid's report */
    int is_hull;              /**< 1: the hull, with `allowance`, may replace the body that the triangles enclose */
    double allowance; /**< 0 if the hull is that body. Else the body lies in the hull, and contains a convex body whose
                         supports are nowhere lower than the hull's by more than this: as the `inside` of the hull's
                         allowance it keeps every bracket true for the body, depths included */
} ovoid_hull_match;

/**
 * Is the body of these triangles the convex hull of their points, exactly or nearly? hull: made of the same points.
 * Exactly means that the triangles are closed, wind around the hull's centroid, and each of them with area lies in a
 * plane that the hull does not cross, by exact signs. Nearly means that each lies so little below a plane like that
 * that the allowance is at most a millionth of the diagonal of the hull's box plus four ten millionths of its largest
 * coordinate (a few roundings to single precision, as in STL files), and at most a ten thousandth of the diagonal. A
 * hull of rank below 3 encloses nothing, so the answer is no. Errors: those of ovoid_solid_create_from_triangles,
 * ARGUMENT (no hull). Cost: linear, except for the matching of open edges; mostly less if the triangles are not the
 * hull.
 */
OVOID_API ovoid_code ovoid_triangles_compute_hull_match(const ovoid_triangles *triangles, const ovoid_shape *hull,
                                                        ovoid_hull_match *match, ovoid_error *error);

/**
 * An upper bound of how much farther a solid is than its hull from any other body: with *gap = g, d(hull, B) <=
 * d(solid, B) <= d(hull, B) + g for every B, depths included. So hulls that are deeper than g in each other prove an
 * overlap of the solids. g is 0 if the solid is its hull by exact signs. g is infinity if no copy of the hull, scaled
 * about its centroid by at least one half, is proven to lie inside the solid, and for every surface. hull: of all
 * points of the solid; if it has a radius, an allowance or a rank below 3, g is infinity. Errors: MEMORY (of the
 * solid's allocator). Cost: that of ovoid_triangles_compute_hull_match.
 */
OVOID_API ovoid_code ovoid_solid_compute_hull_gap(const ovoid_solid *solid, const ovoid_shape *hull, double *gap,
                                                  ovoid_error *error);

/** The pairs of triangles of a surface that cross, touch or are folded onto each other. */
typedef struct ovoid_solid_crossings {
    uint64_t pairs;                  /**< number of pairs of triangles */
    int is_complete;                 /**< 0: there may be more, as the search stopped at the wanted number */
    uint32_t triangle_a, triangle_b; /**< the first pair found, in the order of the tree; 0 if there is none */
} ovoid_solid_crossings;

/**
 * Finds the pairs of triangles with a common point that is not a corner or an edge of both, by exact signs: triangles
 * that cross, touch or are folded onto each other. Triangles without area, and triangles with the three corners of
 * another one, are not counted. Stops at `most` pairs. Cost: for each triangle the triangles whose boxes meet its box,
 * some microseconds.
 */
OVOID_API ovoid_solid_crossings ovoid_solid_compute_crossings(const ovoid_solid *solid, uint64_t most);

#ifdef __cplusplus
}
#endif
#endif
