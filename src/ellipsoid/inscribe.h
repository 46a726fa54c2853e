// The maximum-volume ellipsoid in an intersection of halfspaces, by sequential quadratic programming.
#ifndef OVOID_ELLIPSOID_INSCRIBE_H
#define OVOID_ELLIPSOID_INSCRIBE_H

#include "ellipsoid/qp.h"
#include "ellipsoid/root.h"
#include "ovoid/polytope.h"

/// Halfspaces n . x <= b, unit normals n.
typedef struct halfspace_set {
    const ovoid_plane *items;
    uint32_t count;
} halfspace_set;

/// The ellipsoid { x + L u : |u| <= 1 }, and the halfspaces that confine it.
typedef struct inscribed {
    lower3 map; ///< L
    vec3 x;
    double gap; ///< about the relative gap of the volume
    uint32_t iterations;
    int count;
    uint32_t item[QP_SIZE]; ///< halfspaces with a weight, by index
    double weight[QP_SIZE]; ///< of sum about 3: where the ellipsoid is the unit ball, their u u' sum to the identity
} inscribed;

/// The halfspaces must bound a body that contains the origin (all b > 0) and is of about the size of the unit ball,
/// neither thin nor long. Stops at that gap, or if there is no progress. The ellipsoid is in all halfspaces, up to
/// rounding. Cost: some five steps on up to 64 halfspaces, and as many passes over all.
inscribed inscribe_solve(halfspace_set set, double gap);

#endif
