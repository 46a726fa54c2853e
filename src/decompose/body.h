// A solid and its parts for the searches: all in units of a power of two near their size, so that no product of lengths
// under- or overflows.
//
// With u = 2^-53, coordinates of solid and parts are at most 1 in that unit, and exact (except for underflow, which is
// negligible). A corner of a cell is off by at most 4 u at each of at most CELL_DEPTH cuts, 800 u; a vertex of a part,
// the sum of its origin and its place, by u; the corners of the first cells, middles of vertices, by 70 u; gaps and
// distances measured here by less than 32 u. Bounds are moved outward by twice the sum of these.
#ifndef OVOID_DECOMPOSE_BODY_H
#define OVOID_DECOMPOSE_BODY_H

#include "decompose/tetrahedra.h"
#include "linear/triangle.h"
#include "solid/solid.h"

#define BODY_PAD (2048 * ROUNDING)

/// A convex part.
typedef struct body_part {
    const ovoid_shape *shape;
    double radius; ///< of rounding
    box bounds;    ///< radius included
} body_part;

typedef struct body {
    const ovoid_solid *solid;
    body_part *parts;
    uint32_t part_count;
    double unit;        ///< a length of the user times this is a length in the unit of this file
    double inverse;     ///< 1 / unit
    double pad;         ///< the bound of rounding, in that unit
    double diagonal;    ///< of the solid's box, in that unit
    ovoid_shape *point; ///< the origin
    ovoid_allocator memory;
    double tolerance; ///< of probes
} body;

/// Fills in the defaults of options and validates them. Errors: ARGUMENT.
ovoid_code body_validate_options(const ovoid_decomposition_options *given, ovoid_decomposition_options *options,
                                 ovoid_error *error);
/// Opens a body with the solid alone, which must be closed. The caller closes the body. Errors: ARGUMENT, MEMORY.
ovoid_code body_open(body *b, const ovoid_solid *solid, const ovoid_decomposition_options *options, ovoid_error *error);
/// Validates the parts. Errors: ARGUMENT, EMPTY, LIMIT.
ovoid_code body_validate_parts(const ovoid_decomposition *d, ovoid_error *error);
/// Opens a body with the parts of a decomposition. Errors: those of body_open, EMPTY, LIMIT.
ovoid_code body_open_parts(body *b, const ovoid_decomposition *d, const ovoid_decomposition_options *options,
                           ovoid_error *error);
void body_close(body *b);

/// A bracket of the distance of x from a part, 0 inside, in the body's unit; if it is proven farther than `cap`, the
/// upper end is infinite. normal: from the part toward x, if x is outside.
typedef struct part_distance {
    double lower, upper;
    vec3 normal;
    vec3 nearest;
} part_distance;
part_distance body_probe_part(const body *b, uint32_t part, vec3 x, double cap);

/// An upper bound of the length by which the part reaches beyond x along the unit vector n.
double body_find_depth(const body *b, uint32_t part, vec3 x, vec3 n);

// ---- the solid's surface

/// A triangle, by its place.
static inline void body_get_triangle(const body *b, uint32_t place, vec3 corner[3]) {
    for (int i = 0; i < 3; i++) corner[i] = vec3_scale(solid_get_corner(b->solid, place, i), b->inverse);
}
/// A triangle about as near to x as any; *distance: of x from it, to 16 u.
uint32_t body_find_triangle(const body *b, vec3 x, uint32_t hint, double *distance);
/// The places of all triangles that are within the pad of the cell, and perhaps some that are not. Returns their
/// number; room + 1 if there are more than room.
uint32_t body_list_crossing(const body *b, const cell *c, uint32_t *places, uint32_t room);
/// 0 if no triangle crosses the cell; else *place, which is tried first, is the place of one that does.
int body_is_crossed(const body *b, const cell *c, uint32_t *place);
/// 1 inside the solid, 0 outside, -1 on its surface.
int body_find_inside(const body *b, vec3 x);
/// A lower bound of the distance of x from the solid, 0 if x may be inside.
double body_find_outside(const body *b, vec3 x);

#endif
