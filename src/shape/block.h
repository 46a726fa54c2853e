// The block of memory of a shape: a header, then arrays at offsets from the block's start, each aligned to 64 bytes. A
// copy is a memcpy; the block holds no pointers but those of the allocator. All lengths in the body frame.
#ifndef OVOID_SHAPE_BLOCK_H
#define OVOID_SHAPE_BLOCK_H

#include "ovoid/shape.h"
#include "polytope/closed_form.h"
#include "shape/parallelepiped.h"
#include "shape/support_table.h"

struct hull; // polytope/hull.h

/// Bytes from the block's start to an array.
typedef struct block_offsets {
    uint64_t x, y, z;         ///< vertices as structure of arrays, padded_count doubles each; padding repeats vertex 0
    uint64_t gauss;           ///< gauss_map (gauss_map.h); none for bodies of many vertices, and lean ones
    uint64_t vertices;        ///< xyz, 3 vertex_count doubles
    uint64_t planes;          ///< ovoid_plane, facet_count
    uint64_t triangles;       ///< uint32, 3 triangle_count
    uint64_t triangle_facets; ///< uint32, triangle_count
    uint64_t neighbor_starts; ///< uint32, vertex_count + 1
    uint64_t neighbors;       ///< uint32, neighbor_count
    uint64_t cells;           ///< simd_cell, of the table of supports; none for bodies of few vertices
    // The boundaries of facets (loops.h), all uint32.
    uint64_t edge_tails, edge_facets;   ///< neighbor_count each
    uint64_t loop_starts;               ///< loop_count + 1
    uint64_t loop_vertices, loop_edges; ///< neighbor_count + 1 each; 0 beyond the last loop
    uint64_t size;                      ///< of the whole block
} block_offsets;

/// What decides the layout.
typedef struct block_counts {
    uint32_t vertices, triangles, facets, neighbors, cells;
    uint32_t is_lean; ///< made by OVOID_INNER_LEAN: there is no table of supports and no Gauss map
} block_counts;

/// The inner ellipsoid as queries use it: |W (x - c)| (1 + 1e-7) is at least the norm in which it is the unit ball.
typedef struct shape_inner {
    double w[6];  ///< W, lower triangular, by rows
    double least; ///< a lower bound of its least radius; 0 if it is too flat for doubles: W must not be used
    double reach; ///< an upper bound of its largest radius
} shape_inner;

/// Bits of has_allowance.
enum { ALLOWANCE_ANY = 1, ALLOWANCE_AXIS = 2 };

struct ovoid_shape {
    // Read by the first rejections: one cache line, and the beginning of the next.
    double radius;     ///< rounding radius
    double extent;     ///< no vertex is farther than this from the body frame's origin, rounding included
    ovoid_vec3 center; ///< of the enclosing sphere of radius reach, body frame
    double reach;      ///< no vertex is farther than this from `center`, rounding included
    uint32_t vertex_count, padded_count;
    uint16_t rank;
    uint16_t is_plain;      ///< no radius, no allowance, no origin
    uint16_t has_origin;    ///< origin is not zero
    uint16_t has_allowance; ///< ALLOWANCE_ANY if there is one, and ALLOWANCE_AXIS if it is along an axis
    ovoid_vec3 first;       ///< vertex 0
    // With the allowance, rounded outward; without one they are radius, radius and extent.
    double lower_radius; ///< radius + outside: a lower bound of the distance is reduced by it
    double
        upper_radius; ///< radius - inside: an upper bound is reduced by it; inside is at most 2 (extent + lower_radius)
    double span;      ///< extent + 2 inside: with lower_radius an upper bound of all lengths that a bound is made of
    block_offsets at;
    ovoid_allowance allowance;
    support_table support; ///< the table of supports; k = 0: none
    // Read by the cheap stages.
    ovoid_ellipsoid outer, inner;
    shape_inner inside;
    ovoid_vec3 origin; ///< of the body frame, in the user's local frame
    parallelepiped box;
    // The rest.
    block_counts counts;
    ovoid_fit outer_fit, inner_fit;
    ovoid_report report;
    ovoid_measures measures;
    ovoid_round round; ///< of a kind only where nothing but it is within the allowance
    ovoid_allocator allocator;
};

static inline const double *shape_x(const ovoid_shape *s) { return (const double *)((const char *)s + s->at.x); }
static inline const double *shape_y(const ovoid_shape *s) { return (const double *)((const char *)s + s->at.y); }
static inline const double *shape_z(const ovoid_shape *s) { return (const double *)((const char *)s + s->at.z); }
static inline const double *shape_vertices(const ovoid_shape *s) {
    return (const double *)((const char *)s + s->at.vertices);
}
static inline const simd_cell *shape_cells(const ovoid_shape *s) {
    return (const simd_cell *)((const char *)s + s->at.cells);
}

/// A shape's vertices as the kernels read them, in its body frame.
static inline simd_points shape_get_points(const ovoid_shape *s) {
    return (simd_points){shape_x(s), shape_y(s), shape_z(s), s->padded_count};
}

/// The vertex extreme along n: the lowest index among equal values.
simd_extreme shape_find_extreme(const ovoid_shape *shape, ovoid_vec3 n);

/// The layout of a block with these counts. All counts are 32-bit, so no sum overflows 64 bits.
block_offsets block_compute_offsets(block_counts counts);

/// A block with room for the counts, cleared except for its arrays, with counts, layout and allocator set. NULL with
/// *error filled.
ovoid_shape *block_create(block_counts counts, const ovoid_allocator *given, ovoid_error *error);

/// Copies the hull's arrays into the block, and computes everything that follows from the vertices: structure of
/// arrays, padding, sphere, extent, measures. The hull must have the block's counts. room: loops_get_room numbers.
void block_fill(ovoid_shape *shape, const struct hull *polytope, uint32_t *room);

/// Sets the radius and the allowance of a block that has been filled, and everything that follows from them. Nothing
/// else is then known about the true body.
void block_set_radius(ovoid_shape *shape, double radius, ovoid_allowance allowance);

/// 1 for a true cylinder, cone or ellipsoid; for the last.
static inline int shape_is_round(const ovoid_shape *s) { return s->round.kind != OVOID_ROUND_NONE; }
static inline int shape_is_ellipsoid(const ovoid_shape *s) { return s->round.kind == OVOID_ROUND_ELLIPSOID; }

/// The largest width that the allowance adds to a bracket.
static inline double shape_get_width(const ovoid_shape *s) { return s->lower_radius - s->upper_radius; }

/// The largest error of a unit direction in a shape's axes, computed from one in the world: at most 36 u for each
/// rotation, 82 u for that of B in the frame of A, and 20 u for products, for the direction's length and for the axis'.
/// Twice that for a claim, whose direction is transformed to the world and back before it is measured again.
#define AXIS_CHECK (256 * 0x1p-53)
#define AXIS_CLAIM (512 * 0x1p-53)

static inline int shape_has_axis(const ovoid_shape *s) { return s->has_allowance >= ALLOWANCE_AXIS; }

/// How far the true body exceeds the shape along the unit direction n, given in the shape's axes with an error of
/// `error`, if the allowance is along an axis; else 0. One rounding of the result is not included.
static inline double shape_compute_across(const ovoid_shape *s, ovoid_vec3 n, double error) {
    return shape_has_axis(s) ? s->allowance.outside * (vec3_norm(vec3_cross(n, s->allowance.axis)) + error) : 0;
}

/// The amount by which a lower bound along n is reduced: lower_radius, or less if the allowance is along an axis.
/// Rounded up.
double shape_compute_lower_radius(const ovoid_shape *shape, ovoid_vec3 n, double error);

/// lower_radius minus shape_compute_lower_radius. Rounded down, except for what `error` has room for.
static inline double shape_compute_gain(const ovoid_shape *s, ovoid_vec3 n, double error) {
    return shape_has_axis(s) ? s->lower_radius - shape_compute_lower_radius(s, n, error) : 0;
}

#endif
