// The weights of the point that two overlapping bodies have in common: of the origin in the hull of a few differences.
#ifndef OVOID_PAIR_HULL_WEIGHTS_H
#define OVOID_PAIR_HULL_WEIGHTS_H

#include "linear/dd3.h"

enum { HULL_CORNERS_MAX = 6 };

/// How far the weighted corners are from the origin.
static inline double hull_measure_weights(const vec3 *w, int count, const double *weight) {
    vec3 sum = vec3_scale(w[0], weight[0]);
    for (int i = 1; i < count; i++) sum = vec3_add_scaled(sum, w[i], weight[i]);
    return vec3_norm(sum);
}

/// Sets weights >= 0, whose sum is one to rounding, of 4 to 6 corners whose hull holds the origin: their weighted sum
/// is the origin to a few roundings of the corners' size, however thin the hull is. At most four are not zero: those of
/// a tetrahedron that holds the origin. Corners on one plane keep the weights that they have. The corners' size is
/// about 1.
void hull_set_weights(const dd3 *w, int count, double *weight);

/// hull_set_weights of corners in doubles, of any size.
void hull_set_weights_of_doubles(const vec3 *w, int count, double *weight);

#endif
