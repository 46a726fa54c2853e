// The maximum-volume ellipsoid in an intersection of halfspaces, by a primal-dual interior-point method.
#ifndef OVOID_ELLIPSOID_INSCRIBE_H
#define OVOID_ELLIPSOID_INSCRIBE_H

#include "linear/mat3.h"

/// n . x <= b for a unit normal n, with the state of the method.
typedef struct constraint {
    vec3 n;
    double b;
    double y, z;   ///< multiplier and slack
    vec3 w;        ///< E n / |E n|
    double h;      ///< |E n|
    double miss;   ///< b - n . x - h - z, the residual
    double dy, dz; ///< the step of y and z
} constraint;

typedef struct constraint_set {
    constraint *items;
    uint32_t count;
} constraint_set;

/// The ellipsoid { x + E u : |u| <= 1 }.
typedef struct inscribed {
    sym3 e;
    vec3 x;
    double gap; ///< sum of y z: about the relative gap of the volume
    uint32_t iterations;
} inscribed;

/// The constraints must bound a body that contains the origin (all b > 0) and is of about the size of the unit ball,
/// neither thin nor long. Stops at that gap, or if there is no progress. Cost: 10 to 30 iterations, each linear in the
/// constraints.
inscribed inscribe_solve(constraint_set set, double gap);

#endif
