// The kinematics of a robot in long double, written here without a quaternion (Rodrigues' formula): off by some 1e-18.
#ifndef OVOID_TESTS_EXACT_ROBOT_H
#define OVOID_TESTS_EXACT_ROBOT_H

#include "ovoid/robot.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { EXACT_LINKS = 128, EXACT_VARIABLES = 256 };
typedef long double real;
typedef struct exact_frame {
    real r[3][3], p[3];
} exact_frame;

// The rotation of a normalised quaternion.
static inline void exact_rotation(ovoid_quat q, real r[3][3]) {
    real w = q.w, x = q.x, y = q.y, z = q.z, s = 2 / (w * w + x * x + y * y + z * z);
    real m[3][3] = {{1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
                    {s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)},
                    {s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)}};
    memcpy(r, m, sizeof m);
}

static inline void multiply(real a[3][3], real b[3][3], real out[3][3]) {
    real m[3][3];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) m[i][k] = a[i][0] * b[0][k] + a[i][1] * b[1][k] + a[i][2] * b[2][k];
    memcpy(out, m, sizeof m);
}

static inline void unit_axis(ovoid_vec3 a, real n[3]) {
    real x = a.x, y = a.y, z = a.z, norm = sqrtl(x * x + y * y + z * z);
    n[0] = x / norm, n[1] = y / norm, n[2] = z / norm;
}

// Rodrigues: I + sin K + (1 - cos) K K.
static inline void axis_rotation(const real n[3], real angle, real r[3][3]) {
    real k[3][3] = {{0, -n[2], n[1]}, {n[2], 0, -n[0]}, {-n[1], n[0], 0}}, kk[3][3];
    multiply(k, k, kk);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) r[i][j] = (i == j) + sinl(angle) * k[i][j] + (1 - cosl(angle)) * kk[i][j];
}

// The x axis of the plane of a planar joint: as in the header for z and -z; else by the formula of its source.
static inline void plane_axes(const real n[3], real x[3], real y[3]) {
    real sign = n[2] < 0 ? -1 : 1, a = -1 / (sign + n[2]), b = n[0] * n[1] * a;
    x[0] = 1 + sign * n[0] * n[0] * a, x[1] = sign * b, x[2] = -sign * n[0];
    y[0] = b, y[1] = sign + n[1] * n[1] * a, y[2] = -n[1];
}

// The value of a joint of one variable.
static inline real find_value(const ovoid_robot_description *d, const ovoid_robot *r, uint32_t i, const real *q) {
    const ovoid_robot_joint *j = &d->joints[i];
    if (j->mimic == OVOID_ROBOT_NONE) return q[ovoid_robot_get_joint_variable(r, i)];
    return j->multiplier * find_value(d, r, j->mimic, q) + j->offset;
}

static inline void exact_joint(const ovoid_robot_description *d, const ovoid_robot *r, uint32_t i, const real *q,
                               exact_frame *local) {
    const ovoid_robot_joint *j = &d->joints[i];
    real n[3] = {0, 0, 1}, x[3], y[3], t[3] = {0, 0, 0}, spin[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, o[3][3];
    const real *v = q + (j->type == OVOID_JOINT_FIXED ? 0 : ovoid_robot_get_joint_variable(r, i));
    if (j->type != OVOID_JOINT_FIXED && j->type != OVOID_JOINT_FLOATING) unit_axis(j->axis, n);
    exact_rotation(j->origin.rotation, o);
    if (j->type == OVOID_JOINT_REVOLUTE || j->type == OVOID_JOINT_CONTINUOUS)
        axis_rotation(n, find_value(d, r, i, q), spin);
    if (j->type == OVOID_JOINT_PRISMATIC)
        for (int k = 0; k < 3; k++) t[k] = n[k] * find_value(d, r, i, q);
    if (j->type == OVOID_JOINT_PLANAR) {
        plane_axes(n, x, y);
        for (int k = 0; k < 3; k++) t[k] = v[0] * x[k] + v[1] * y[k];
        axis_rotation(n, v[2], spin);
    }
    if (j->type == OVOID_JOINT_FLOATING) {
        for (int k = 0; k < 3; k++) t[k] = v[k];
        exact_rotation((ovoid_quat){(double)v[3], (double)v[4], (double)v[5], (double)v[6]}, spin);
    }
    const double p[3] = {j->origin.position.x, j->origin.position.y, j->origin.position.z};
    for (int k = 0; k < 3; k++) local->p[k] = p[k] + o[k][0] * t[0] + o[k][1] * t[1] + o[k][2] * t[2];
    multiply(o, spin, local->r);
}

/// The frames of all links at a state. Joints of the robot may come in any order.
static inline void exact_poses_at(const ovoid_robot *r, const real *q, exact_frame *frames) {
    ovoid_robot_description d = ovoid_robot_get_description(r);
    exact_frame world = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}};
    unsigned char is_placed[EXACT_LINKS] = {0};
    frames[ovoid_robot_get_root(r)] = world;
    is_placed[ovoid_robot_get_root(r)] = 1;
    for (size_t left = d.joint_count, before = left + 1; left && left < before;) {
        before = left;
        for (uint32_t i = 0; i < d.joint_count; i++) {
            if (!is_placed[d.joints[i].parent] || is_placed[d.joints[i].child]) continue;
            const exact_frame *up = &frames[d.joints[i].parent];
            exact_frame local, f;
            exact_joint(&d, r, i, q, &local);
            multiply((real(*)[3])(uintptr_t)up->r, local.r, f.r);
            for (int k = 0; k < 3; k++)
                f.p[k] = up->p[k] + up->r[k][0] * local.p[0] + up->r[k][1] * local.p[1] + up->r[k][2] * local.p[2];
            frames[d.joints[i].child] = f;
            is_placed[d.joints[i].child] = 1;
            left--;
        }
    }
}

static inline void exact_poses(const ovoid_robot *r, const double *q, exact_frame *frames) {
    real exact[EXACT_VARIABLES];
    for (size_t i = 0; i < ovoid_robot_get_variable_count(r); i++) exact[i] = q[i];
    exact_poses_at(r, exact, frames);
}

#endif
