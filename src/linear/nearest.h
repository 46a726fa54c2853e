// The nearest points of two cores, each a point, a segment or a box, in closed form: the set of all c + sum t_i g_i,
// |t_i| <= 1, of zero, one or three half axes g_i at right angles, in the world's axes. At most one of them is a box.
#ifndef OVOID_LINEAR_NEAREST_H
#define OVOID_LINEAR_NEAREST_H

#include "linear/vec3.h"

/// A core around its middle.
typedef struct nearest_core {
    uint32_t dimension; ///< 0: a point, 1: a segment, 3: a box
    const vec3 *axis;   ///< that many half axes
} nearest_core;

/// The nearest points: their parameters, A's point from the middle of A, the points' difference, B's minus A's, the
/// unit normal from A to B and the gap of the cores along it. Parameters beyond a core's dimension are not set.
typedef struct nearest_pair {
    double a[3], b[3];
    double gap;
    vec3 point_a, difference, normal;
} nearest_pair;

/// Two points d apart, A's to B's: their distance, the unit normal, and the gap along it. Any normal is as good as
/// another where they are one.
typedef struct nearest_points {
    vec3 normal;
    double gap, distance;
} nearest_points;
static inline nearest_points nearest_find_points(vec3 d) {
    double square = vec3_norm_squared(d), distance = sqrt(square);
    vec3 n = square > 1e-250 && square < 1e250 ? vec3_scale(d, 1 / distance) : vec3_unit(d);
    if (!(vec3_max_abs(n) > 0)) n = (vec3){1, 0, 0};
    return (nearest_points){n, vec3_dot(n, d), distance};
}

/// The nearest points of two cores whose middles are d apart, A's to B's.
void nearest_find(const nearest_core *a, const nearest_core *b, vec3 d, nearest_pair *out);

/// 1 if radii of that sum go from two points, that far apart, to the points of the rounded bodies along the points'
/// difference; 0: along the normal. Along the difference, of an angle e with the normal, the bodies' points are off
/// d normal by |distance - radii| e, along the normal by distance e. A short difference may have any direction.
static inline int nearest_takes_difference(double distance, double radii) { return distance > 0.5 * radii; }

/// The direction along which the radii of the cores go.
static inline vec3 nearest_find_direction(const nearest_pair *found, double distance, double radii) {
    return nearest_takes_difference(distance, radii) ? vec3_scale(found->difference, 1 / distance) : found->normal;
}

#endif
