// Random shapes and motions for the tests of impacts, from operations that IEEE 754 rounds correctly: the same on every
// machine.
#ifndef OVOID_TESTS_MOVING_H
#define OVOID_TESTS_MOVING_H

#include "bits.h"

/// The rotation of bodies: none, a little, some turns, hundreds of turns.
static const double moving_spins[4] = {0, 0.5, 12, 1500};

typedef struct moving_case {
    ovoid_shape *shapes[2];
    ovoid_moving_shape a, b;
    double times[4];
    ovoid_pose poses[2][4];
    double spin; ///< the larger of both
    double size; ///< a length about as large as the bodies
} moving_case;

/// A random pose. Each call is a statement, since C leaves open in which order the calls of an expression are made.
static inline ovoid_pose moving_make_pose(uint64_t *s, double scale) {
    ovoid_vec3 position = bits_vec3(s, scale);
    ovoid_quat rotation = bits_quat(s);
    return (ovoid_pose){position, rotation};
}

static inline ovoid_vec3 moving_scaled(ovoid_vec3 v, double s) { return (ovoid_vec3){v.x * s, v.y * s, v.z * s}; }

/// One body's motion, from near `at`, within 2 sizes of the bodies.
static inline void moving_set_motion(moving_case *c, int which, ovoid_vec3 at, uint64_t *s) {
    ovoid_moving_shape *m = which ? &c->b : &c->a;
    ovoid_pose start = {at, bits_quat(s)}, end = moving_make_pose(s, 3 * c->size);
    ovoid_vec3 linear = bits_vec3(s, 4 * c->size), pivot = bits_vec3(s, c->size);
    double spin = moving_spins[random_next(s) % 4];
    switch (random_next(s) % 4) {
    case 0: m->motion = ovoid_motion_make_still(start); break;
    case 1: m->motion = ovoid_motion_make_poses(start, end, 1); break;
    case 2:
        for (int i = 0; i < 4; i++) c->poses[which][i] = moving_make_pose(s, 3 * c->size);
        m->motion = ovoid_motion_make_path(c->times, c->poses[which], 4);
        break;
    default:
        m->motion = ovoid_motion_make_velocity(start, linear, bits_vec3(s, spin), 1);
        if (random_next(s) % 2) m->motion.pivot = pivot;
        c->spin = fmax(c->spin, spin);
    }
    if (random_next(s) % 4 == 0) m->part = moving_make_pose(s, c->size);
}

/// A pair of bodies that move from time 0 to 1.
static inline void moving_make(moving_case *c, uint64_t seed) {
    uint64_t s = seed * 77;
    memset(c, 0, sizeof *c);
    for (int i = 0; i < 4; i++) c->times[i] = i / 3.0;
    bits_family f = (bits_family)(seed % BITS_FAMILIES);
    if (f == BITS_FAR) f = BITS_NEEDLE;
    c->size = bits_scale(f);
    for (int i = 0; i < 2; i++) c->shapes[i] = bits_make_shape(f, &s);
    c->a.shape = c->shapes[0];
    c->b.shape = c->shapes[1];
    moving_set_motion(c, 0, bits_vec3(&s, 0.5 * c->size), &s);
    moving_set_motion(c, 1, bits_vec3(&s, 4 * c->size), &s);
}

static inline void moving_destroy(moving_case *c) {
    ovoid_shape_destroy(c->shapes[0]);
    ovoid_shape_destroy(c->shapes[1]);
}

static inline ovoid_pair moving_get_pair(const ovoid_moving_shape *a, const ovoid_moving_shape *b, double time) {
    return (ovoid_pair){a->shape, b->shape, ovoid_moving_shape_compute_pose(a, time),
                        ovoid_moving_shape_compute_pose(b, time)};
}

#endif
