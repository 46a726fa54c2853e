// Directions and rotations at random.
#ifndef OVOID_BENCH_COMMON_RANDOM_H
#define OVOID_BENCH_COMMON_RANDOM_H

#include "tools/random.h"

#include <math.h>
#include <ovoid/linear.h>

static inline ovoid_vec3 random_unit(uint64_t *state) {
    for (;;) {
        ovoid_vec3 p = {random_uniform(state, -1, 1), random_uniform(state, -1, 1), random_uniform(state, -1, 1)};
        double squared = p.x * p.x + p.y * p.y + p.z * p.z, norm = sqrt(squared);
        if (squared <= 1 && squared > 0.01) return (ovoid_vec3){p.x / norm, p.y / norm, p.z / norm};
    }
}

/// Uniform over the rotations: a unit vector of four dimensions.
static inline ovoid_quat random_rotation(uint64_t *state) {
    for (;;) {
        ovoid_quat q = {random_uniform(state, -1, 1), random_uniform(state, -1, 1), random_uniform(state, -1, 1),
                        random_uniform(state, -1, 1)};
        double squared = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z, norm = sqrt(squared);
        if (squared <= 1 && squared > 0.01) return (ovoid_quat){q.w / norm, q.x / norm, q.y / norm, q.z / norm};
    }
}

#endif
