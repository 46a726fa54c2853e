// The least overlap of a hull whose faces are known and an ellipsoid, shown cell by cell of the hull's Gauss map.
#ifndef OVOID_QUERY_SWEPT_HULL_CELLS_H
#define OVOID_QUERY_SWEPT_HULL_CELLS_H

#include "query/swept/hull_map.h"

/// A hull beside an ellipsoid, in the hull's frame.
typedef struct hull_cells {
    hull_map hull;
    vec3 center; ///< the ellipsoid's
    ellipsoid_form form;
    double doubt;
} hull_cells;

/// 1 if one core is a hull with a shape that has a Gauss map (shape/gauss_map.h), the other one an ellipsoid.
int cores_have_hull_cells(const cores *p);

/// Sets the cells of such cores. *n: in the world, that of all facets' normals along which the overlap is the least.
/// Returns that; INFINITY if rounding leaves too much open.
double hull_cells_make(const cores *p, hull_cells *to, vec3 *n);

/// 1 if the overlap along that normal is a local minimum, which is set, with the piece of the ellipsoid.
int hull_cells_find_facet(const hull_cells *c, const cores *p, least_overlap *at);

/// Is a local minimum the least overlap of all? No overlap is less than `wanted` by more than the doubt, beside 100 u
/// of the size. 0: that is not shown; *less: in the world, a unit direction with less overlap, or none.
int hull_cells_hold(const hull_cells *c, const cores *p, const least_overlap *at, double wanted, vec3 *less);

#endif
