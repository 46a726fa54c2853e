/**
 * @file linear.h
 * Small values passed by value: vector, quaternion, pose, symmetric matrix.
 */
#ifndef OVOID_LINEAR_H
#define OVOID_LINEAR_H

#include "ovoid/base.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A vector or point; the unit of length is the caller's and is the same everywhere. */
typedef struct ovoid_vec3 {
    double x, y, z;
} ovoid_vec3;

/** A quaternion w + xi + yj + zk of any norm but zero. */
typedef struct ovoid_quat {
    double w, x, y, z;
} ovoid_quat;

/**
 * Where a body is: world = position + R(rotation) local. The rotation meant is that of the normalised quaternion,
 * R(q)/|q|^2, which is rational in q: a posed shape is an exact mathematical object, whatever the norm of q.
 */
typedef struct ovoid_pose {
    ovoid_vec3 position;
    ovoid_quat rotation;
} ovoid_pose;

/** A symmetric 3x3 matrix. */
typedef struct ovoid_sym3 {
    double xx, xy, xz, yy, yz, zz;
} ovoid_sym3;

/** The pose at the origin, not rotated. */
OVOID_API ovoid_pose ovoid_pose_make_identity(void);

/**
 * The pose of URDF's xyz and rpy: fixed-axis roll, pitch, yaw in radians (R = Rz(yaw) Ry(pitch) Rx(roll)).
 */
OVOID_API ovoid_pose ovoid_pose_make_rpy(ovoid_vec3 xyz, ovoid_vec3 rpy);

/** The local point in the world frame, rounded: error at most 64 ulp of |position| + |point|. */
OVOID_API ovoid_vec3 ovoid_pose_compute_point(const ovoid_pose *pose, ovoid_vec3 local);

/** The world point in the local frame; the inverse of ovoid_pose_compute_point, rounded likewise. */
OVOID_API ovoid_vec3 ovoid_pose_compute_local_point(const ovoid_pose *pose, ovoid_vec3 world);

/**
 * The pose of what is posed by `inner` in a body that is posed by `outer`: its points are, to rounding, those of inner
 * moved by outer. The result is the definition of where a part of a body is: the same bits everywhere. Its rotation is
 * that of the exact product to 16 u in operator norm, u = 2^-53; its position is off by at most 46 u |inner.position| +
 * 2 u |outer.position|. Neither pose may be one that ovoid_pose_compute_check refuses.
 */
OVOID_API ovoid_pose ovoid_pose_compute_product(const ovoid_pose *outer, const ovoid_pose *inner);

/** The pose that undoes it: its rotation exactly, its position is off by at most 45 u |position|, u = 2^-53. */
OVOID_API ovoid_pose ovoid_pose_compute_inverse(const ovoid_pose *pose);

/** OVOID_OK, or what is wrong with the pose: NOT_FINITE, RANGE, ROTATION. */
OVOID_API ovoid_code ovoid_pose_compute_check(const ovoid_pose *pose);

#ifdef __cplusplus
}
#endif
#endif
