// Two numbers side by side, for arithmetic that is done on both at once; the bits are those of each alone.
#ifndef OVOID_LINEAR_BOTH_H
#define OVOID_LINEAR_BOTH_H

#include "linear/vec3.h"

typedef double both __attribute__((vector_size(16)));

static inline both both_make(double a, double b) { return (both){a, b}; }

/// Two vectors, with the operations and the order of vec3.h.
typedef struct both_vec3 {
    both x, y, z;
} both_vec3;

static inline both_vec3 both_vec3_make(vec3 a, vec3 b) {
    return (both_vec3){both_make(a.x, b.x), both_make(a.y, b.y), both_make(a.z, b.z)};
}
static inline both_vec3 both_vec3_sub(both_vec3 a, both_vec3 b) { return (both_vec3){a.x - b.x, a.y - b.y, a.z - b.z}; }
static inline both both_vec3_dot(both_vec3 a, both_vec3 b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }
static inline both_vec3 both_vec3_cross(both_vec3 a, both_vec3 b) {
    return (both_vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

#endif
