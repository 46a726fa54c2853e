// Bounding volumes as first stages, each alone, for comparison: sphere, oriented box, outer ellipsoid.
#ifndef OVOID_BENCH_PAIRS_BOUNDS_H
#define OVOID_BENCH_PAIRS_BOUNDS_H

#include <ovoid/ovoid.h>

/// The volumes of a body in its local frame.
typedef struct volumes {
    ovoid_vec3 sphere_center;
    double sphere_radius;
    ovoid_vec3 box_center, half;
    double axes[9]; ///< the box's axes are the columns
    ovoid_ellipsoid outer;
} volumes;

/// The box has the axes of the outer ellipsoid or those of the frame, whichever makes it smaller.
volumes volumes_make(const ovoid_shape *shape);

/// Two bodies under their poses: volumes of both and the rotations as matrices, as a user would keep them.
typedef struct bounded {
    const volumes *a, *b;
    double turn_a[9], turn_b[9]; ///< by rows
    ovoid_vec3 at_a, at_b;
} bounded;

/// Lower bounds of the distance; above 0 only if the bodies are apart. Plain doubles, without proof.
typedef double (*bound)(const bounded *pair);

double bound_by_sphere(const bounded *pair);
/// S. Gottschalk, M. C. Lin, D. Manocha, OBBTree, 1996: the 15 axes; the largest gap along one of them.
double bound_by_box(const bounded *pair);
/// The gap of the outer ellipsoids along n, by two rounds of n <- (QA/sA + QB/sB)^-1 d.
double bound_by_ellipsoid(const bounded *pair);

#endif
