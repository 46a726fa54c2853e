// Distances from the origin for the tests, computed plainly, without the library's searches.
#ifndef OVOID_TESTS_DISTANCES_H
#define OVOID_TESTS_DISTANCES_H

#include "linear/vec3.h"

static inline double segment_distance(vec3 a, vec3 b) {
    vec3 e = vec3_sub(b, a);
    double l = vec3_norm_squared(e), t = l > 0 ? fmin(fmax(-vec3_dot(a, e) / l, 0), 1) : 0;
    return vec3_norm(vec3_add_scaled(a, e, t));
}

static inline double triangle_distance(vec3 a, vec3 b, vec3 c) {
    vec3 n = vec3_cross(vec3_sub(b, a), vec3_sub(c, a));
    double u = vec3_dot(n, vec3_cross(b, c)), v = vec3_dot(n, vec3_cross(c, a)), w = vec3_dot(n, vec3_cross(a, b));
    double edges = fmin(segment_distance(a, b), fmin(segment_distance(b, c), segment_distance(c, a)));
    return u > 0 && v > 0 && w > 0 ? fmin(edges, fabs(vec3_dot(n, a)) / vec3_norm(n)) : edges;
}

#endif
