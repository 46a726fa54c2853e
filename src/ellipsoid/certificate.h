// An upper bound of how much larger an inscribed ellipsoid could be; it holds for any multipliers.
#ifndef OVOID_ELLIPSOID_CERTIFICATE_H
#define OVOID_ELLIPSOID_CERTIFICATE_H

#include "ellipsoid/qp.h"
#include "ellipsoid/root.h"
#include "ovoid/polytope.h"

/// Directions with weights, in the body's frame: good ones are normals of the halfspaces that an ellipsoid touches. In
/// the space where it is the unit ball their unit normals u, weighted, are optimal if u u' sums to the identity and u
/// to zero (John 1948).
typedef struct certificate {
    int count;
    vec3 direction[QP_SIZE];
    double weight[QP_SIZE];
} certificate;

/// The body of the bound: the vertices, moved by -height to height along `normal`, and the ellipsoid { center + map u :
/// |u| <= 1 } in it.
typedef struct inscribed_body {
    const double *vertices;
    uint32_t vertex_count;
    vec3 normal;
    double height;
    vec3 center;
    mat3 map;
    double reach; ///< the whole body has |u| <= reach
} inscribed_body;

/// An upper bound of the volume of any ellipsoid in the body, relative to the given one. Any directions give a true
/// bound, good directions a good bound. Cost: linear in the vertices.
double certificate_compute_bound(const certificate *c, const inscribed_body *body);

/// The same in doubles, for a solid, the ellipsoid { center + map u } of a lower triangular map, and no reach; INFINITY
/// where doubles do not suffice, as for a thin ellipsoid or bad weights.
double certificate_compute_bound_quickly(const certificate *c, const ovoid_polytope *polytope, vec3 center, lower3 map);

#endif
