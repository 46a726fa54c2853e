// The matrix of a unit quaternion, by rows, for peers that take matrices.
#ifndef OVOID_BENCH_ROTATION_H
#define OVOID_BENCH_ROTATION_H

#include <ovoid/linear.h>

typedef struct rotation {
    double m[9];
} rotation;

static inline rotation rotation_make(ovoid_quat q) {
    rotation r = {{1 - 2 * (q.y * q.y + q.z * q.z), 2 * (q.x * q.y - q.w * q.z), 2 * (q.x * q.z + q.w * q.y),
                   2 * (q.x * q.y + q.w * q.z), 1 - 2 * (q.x * q.x + q.z * q.z), 2 * (q.y * q.z - q.w * q.x),
                   2 * (q.x * q.z - q.w * q.y), 2 * (q.y * q.z + q.w * q.x), 1 - 2 * (q.x * q.x + q.y * q.y)}};
    return r;
}

static inline ovoid_vec3 rotation_apply(const rotation *r, ovoid_vec3 v) {
    ovoid_vec3 out = {r->m[0] * v.x + r->m[1] * v.y + r->m[2] * v.z, r->m[3] * v.x + r->m[4] * v.y + r->m[5] * v.z,
                      r->m[6] * v.x + r->m[7] * v.y + r->m[8] * v.z};
    return out;
}

static inline ovoid_vec3 rotation_undo(const rotation *r, ovoid_vec3 v) {
    ovoid_vec3 out = {r->m[0] * v.x + r->m[3] * v.y + r->m[6] * v.z, r->m[1] * v.x + r->m[4] * v.y + r->m[7] * v.z,
                      r->m[2] * v.x + r->m[5] * v.y + r->m[8] * v.z};
    return out;
}

#endif
