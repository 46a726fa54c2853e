// The pencil of two ellipsoids: one number decides whether they share a point. See pencil.c.
#ifndef OVOID_ELLIPSOID_DISTANCE_PENCIL_H
#define OVOID_ELLIPSOID_DISTANCE_PENCIL_H

#include "linear/mat3.h"

/// Q = L D L' without pivots, D given by its reciprocals; unit lower L.
typedef struct ldl3 {
    double l10, l20, l21, r0, r1, r2;
} ldl3;

/// Factors Q; 0 if it is not positive definite in doubles.
int ldl3_make(sym3 q, ldl3 *f);
vec3 ldl3_solve(const ldl3 *f, vec3 b);

/// The state at which the search stopped.
typedef struct pencil {
    double s;      ///< in (0, 1)
    vec3 v;        ///< G(s) v = d
    double ma, mb; ///< squared norms of the point of s in a and in b
    enum pencil_state {
        PENCIL_APART,   ///< F(s) > 1 in doubles: the ellipsoids share no point
        PENCIL_COMMON,  ///< ma, mb < 1 in doubles: the point of s is in both
        PENCIL_TOUCHING ///< at the maximum, or G is singular (then v is zero), and neither of the two
    } state;
} pencil;

/// Searches for the maximum of F until the state is decided. d = cb - ca; no fourth power of a length may over- or
/// underflow. At most 20 evaluations.
pencil pencil_search(sym3 qa, sym3 qb, vec3 d);

#endif
