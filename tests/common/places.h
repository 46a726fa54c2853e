// Random places and turns of bodies. Each number is a statement, since C leaves open in which order an initializer's
// are made.
#ifndef OVOID_TESTS_PLACES_H
#define OVOID_TESTS_PLACES_H

#include "check.h"
#include "ovoid/shape.h"

/// Four normal numbers: a rotation of no preferred axis.
static inline ovoid_quat random_quat(uint64_t *s) {
    double w = random_normal(s), x = random_normal(s), y = random_normal(s), z = random_normal(s);
    return (ovoid_quat){w, x, y, z};
}
/// Of a cube of the half side `reach`.
static inline ovoid_vec3 random_vec3(uint64_t *s, double reach) {
    double x = random_uniform(s, -reach, reach), y = random_uniform(s, -reach, reach),
           z = random_uniform(s, -reach, reach);
    return (ovoid_vec3){x, y, z};
}

#endif
