// The least overlap of an ellipsoid and a body with an axis, a box or another ellipsoid, shown cell by cell of the
// directions.
#ifndef OVOID_QUERY_SWEPT_ELLIPSOID_CELLS_H
#define OVOID_QUERY_SWEPT_ELLIPSOID_CELLS_H

#include "query/swept/descend.h"

/// A point, or a direction: along the first axis, across it, and how far that is.
typedef struct beside_first {
    double along, across[2], off;
} beside_first;

/// A local minimum: the reverse of its direction, and the least cosine of an angle to that in which no overlap is less.
typedef struct known_minimum {
    beside_first back;
    double cosine;
} known_minimum;

enum { KNOWN_MINIMA = 4 };

/// A body beside an ellipsoid, in axes of its own: of a segment, a cylinder and a cone the first one is theirs, and the
/// second one is towards the ellipsoid; a box has three. Two ellipsoids are a point beside their difference body, with
/// the first axis towards the second one.
typedef struct ellipsoid_cells {
    const ovoid_swept_sphere *body, *ellipsoid;
    int is_b; ///< the body is B
    vec3 axis[3];
    double height, radius; ///< half of the former; 0 of what has none
    double sine, cosine;   ///< of the normals of a cone's side: along the axis, and across it; 0 and 1 of others
    vec3 center;           ///< the ellipsoid's, from that of the body
    uint32_t ellipsoids;   ///< those of which the rest is set
    ellipsoid_form form[2];
    double least_square[2]; ///< of the least half axes
    double size, doubt;
    int minima; ///< those that are known
    known_minimum minimum[KNOWN_MINIMA];
} ellipsoid_cells;

/// 1 if one core is an ellipsoid, and the other one a segment, a cylinder, a cone, a box or an ellipsoid.
int cores_have_ellipsoid_cells(const cores *p);

/// Sets the cells of such cores. *n: in the world, a direction from A to B, which may be near a local minimum. Returns
/// the overlap along it; INFINITY if rounding leaves too much open.
double ellipsoid_cells_make(const cores *p, ellipsoid_cells *to, vec3 *n);

/// Adds a local minimum to those that are known. 1: no overlap is less than `wanted`, which is no more than what was
/// wanted before, by more than the doubt, beside 100 u of the size. 0: that is not shown; *less: in the world, a unit
/// direction with less overlap, or near a minimum that is about as low, or none.
int ellipsoid_cells_hold(ellipsoid_cells *c, const least_overlap *at, double wanted, vec3 *less);

#endif
