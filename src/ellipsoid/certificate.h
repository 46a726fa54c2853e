// An upper bound of how much larger an inscribed ellipsoid could be; it holds for any multipliers.
#ifndef OVOID_ELLIPSOID_CERTIFICATE_H
#define OVOID_ELLIPSOID_CERTIFICATE_H

#include "linear/mat3.h"
#include "ovoid/polytope.h"

/// The largest number of directions of the bound.
#define CERTIFICATE_SIZE 11

/// Directions with weights: in the space where the given ellipsoid is the unit ball, unit normals u of halfspaces at
/// distance d from its centre. Weights for which u u' sums to the identity and u to zero are optimal (John 1948).
typedef struct certificate {
    int count;
    uint32_t halfspace[CERTIFICATE_SIZE]; ///< its index, as given by the caller
    double weight[CERTIFICATE_SIZE];
    double moment[CERTIFICATE_SIZE][10]; ///< u u', u, d
} certificate;

/// Adds a halfspace. If there would be too many, weight is moved among them, with all sums of weight times moment
/// unchanged, until one has no weight and is dropped (C. Caratheodory, 1907).
void certificate_add(certificate *c, uint32_t halfspace, double weight, vec3 u, double d);

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

/// An upper bound of the volume of any ellipsoid in the body, relative to the given one. directions[i]: of halfspace i
/// of the certificate, in the body's frame. Any directions give a true bound, good directions a good bound. Cost:
/// linear in the vertices.
double certificate_compute_bound(const certificate *c, const inscribed_body *body, const vec3 *directions);

#endif
