// Unit quaternions, and their matrices by rows for peers that use those.
#ifndef OVOID_BENCH_COMMON_ROTATION_H
#define OVOID_BENCH_COMMON_ROTATION_H

#include <math.h>
#include <ovoid/linear.h>

/// The rotation q followed by p; a unit quaternion again.
static inline ovoid_quat rotation_multiply(ovoid_quat p, ovoid_quat q) {
    ovoid_quat r = {p.w * q.w - p.x * q.x - p.y * q.y - p.z * q.z, p.w * q.x + p.x * q.w + p.y * q.z - p.z * q.y,
                    p.w * q.y - p.x * q.z + p.y * q.w + p.z * q.x, p.w * q.z + p.x * q.y - p.y * q.x + p.z * q.w};
    double norm = sqrt(r.w * r.w + r.x * r.x + r.y * r.y + r.z * r.z);
    ovoid_quat unit = {r.w / norm, r.x / norm, r.y / norm, r.z / norm};
    return unit;
}

/// By an angle around a unit axis.
static inline ovoid_quat rotation_make_turn(ovoid_vec3 axis, double angle) {
    double half = angle / 2;
    ovoid_quat q = {cos(half), axis.x * sin(half), axis.y * sin(half), axis.z * sin(half)};
    return q;
}

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
