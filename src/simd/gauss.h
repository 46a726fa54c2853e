// The planes of the difference of two small polyhedra, by their Gauss maps: the one that the origin is the least below.
//
// The Gauss map of a polyhedron divides the sphere of directions into the cells of its vertices: a cell holds the
// directions in which its vertex is the farthest. Its corners are the normals of the facets around the vertex, its
// sides arcs, one for each edge. Facets of a sum of two polyhedra look along the normals of facets of either, and where
// an arc of one crosses an arc of the other (D. Gregorius, The separating axis test between convex polyhedra, 2013).
// exact/gauss says what that proves and what rounding does to it.
//
// Most arcs need no crossing: h, the height along a direction, is at least the value of any point of the sum, and over
// an arc the value of a point, where it is positive, is least at an end. A few points far apart and a ball inside show
// of nine arcs in ten that no height above them is the least. Facets are tried first by ellipsoids inside.
#ifndef OVOID_SIMD_GAUSS_H
#define OVOID_SIMD_GAUSS_H

#include "simd/support.h"

enum {
    GAUSS_POINTS = 32,
    GAUSS_FACETS = 64, ///< of a bounded polyhedron of so many vertices at most 60
    GAUSS_ARCS = 96,   ///< and at most 90 edges
    GAUSS_ROW = 32,    ///< the lists of arcs are padded to a multiple of this
    GAUSS_WIDE = 7
};

/// A polyhedron's Gauss map, in its body frame; its facets and lists follow it in memory.
typedef struct gauss_map {
    uint32_t facets, arcs;    ///< 0: none
    uint32_t row;             ///< bytes of a list
    double bulge;             ///< no vertex is farther above a facet's plane, by its `low`
    double spread;            ///< a unit vector of a cell is a sum of its corners of at most that weight
    uint8_t wide[GAUSS_WIDE]; ///< vertices far apart
} gauss_map;

/// Where a facet's first number is. Groups of 8 facets follow one another, each as four short columns, so that a pass
/// reads one stream.
static inline uint32_t gauss_get_place(uint32_t facet) { return facet / 8 * 32 + facet % 8; }

/// x, y, z of a facet's unit normal, and the least n.v of the facet's corners v, each 8 numbers behind the last one.
/// Padded to a multiple of 8 by facets of zero normals at infinity.
static inline const double *gauss_get_facet(const gauss_map *map, uint32_t facet) {
    return (const double *)(map + 1) + gauss_get_place(facet);
}
/// A facet's normal, and the least n.v.
static inline vec3 gauss_map_get_normal(const gauss_map *map, uint32_t facet) {
    const double *x = gauss_get_facet(map, facet);
    return (vec3){x[0], x[8], x[16]};
}
static inline double gauss_map_get_low(const gauss_map *map, uint32_t facet) { return gauss_get_facet(map, facet)[24]; }
/// Four lists of an arc's two facets, and of the two vertices of its edge, readable to a multiple of GAUSS_ROW.
static inline const uint8_t *gauss_get_list(const gauss_map *map, uint32_t k) {
    return (const uint8_t *)((const double *)(map + 1) + 4 * simd_get_padded(map->facets)) + (size_t)k * map->row;
}

/// A body: its map and vertices, and an ellipsoid and a ball inside it, all in its body frame.
typedef struct gauss_side {
    const gauss_map *map;
    simd_points points;
    vec3 center;
    double q[6];   ///< xx, xy, xz, yy, yz, zz; the ellipsoid's support is n.center + sqrt(n'Qn)
    double ball;   ///< its radius, around the same centre
    double shrink; ///< what rounding adds to the ellipsoid's support
} gauss_side;

/// A body that is a box, in the body frame of the other one.
typedef struct gauss_box {
    int side; ///< 1: it is A, 2: it is B; 0: neither body is a box, and nothing else is read
    vec3 center;
    mat3 axes; ///< rows: unit vectors at right angles, to rounding
    double half[3];
} gauss_box;

/// What is asked: the difference B - A in the frame of A.
typedef struct gauss_query {
    gauss_side a, b;
    gauss_box box;
    mat3 rotation; ///< of B
    vec3 translation;
    double claim; ///< a height that is not above this is not looked for
    double size;  ///< a vertex of the difference is no longer
} gauss_query;

/// Whose plane it is.
typedef enum gauss_kind { GAUSS_FACET_A, GAUSS_FACET_B, GAUSS_CROSSING } gauss_kind;

typedef struct gauss_plane {
    double height; ///< of the plane above the origin
    vec3 n;        ///< outward from the difference; unit, to rounding
    gauss_kind kind;
    uint32_t a, b; ///< facet or arc, of the bodies whose it is
} gauss_plane;

/// The kernel of one instruction set; the same bits from each. Heights along crossings are lowered by their rounding. 0
/// where the least height is not above the claim.
typedef int gauss_function(const gauss_query *query, gauss_plane *out);

/// Runs the kernel of the widest instruction set of this machine. Cost: a pass over facets and arcs.
int gauss_find_plane(const gauss_query *query, gauss_plane *out);

/// The kernel of one instruction set, for tests; NULL where this machine or build lacks it.
gauss_function *gauss_get(simd_isa isa);

#endif
