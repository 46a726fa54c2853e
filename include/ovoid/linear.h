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
 * The position and rotation of a body: world = position + R(rotation) local. R is the rotation of the normalised
 * quaternion, R(q)/|q|^2, which is rational in q: a posed shape is an exact mathematical object, whatever the norm of
 * q.
 *
 * A pose of zeros is not valid: its quaternion is zero, and every function that takes it refuses it (POSE_A, POSE_B,
 * ROTATION). So cleared memory never passes for a pose; for a body that is neither rotated nor moved, use
 * ovoid_pose_make_identity(). There is one exception: ovoid_moving_shape.part of zeros means no part.
 */
typedef struct ovoid_pose {
    ovoid_vec3 position;
    ovoid_quat rotation;
} ovoid_pose;

/** A symmetric 3x3 matrix. */
typedef struct ovoid_sym3 {
    double xx, xy, xz, yy, yz, zz;
} ovoid_sym3;

/** An axis-aligned box: the points with min <= x <= max in each coordinate. */
typedef struct ovoid_box {
    ovoid_vec3 min, max;
} ovoid_box;

/** The pose at the origin, not rotated. */
OVOID_API ovoid_pose ovoid_pose_make_identity(void);

/**
 * The pose of URDF's xyz and rpy: fixed-axis roll, pitch, yaw in radians (R = Rz(yaw) Ry(pitch) Rx(roll)).
 */
OVOID_API ovoid_pose ovoid_pose_make_rpy(ovoid_vec3 xyz, ovoid_vec3 rpy);

/**
 * The largest difference between an entry of M'M and of the identity for which a matrix M counts as a rotation:
 * products of rotations in single precision and matrices written with six digits pass, a scale of 1.001 does not.
 */
#define OVOID_ROTATION_TOLERANCE 1e-5

/**
 * The pose of a 3x3 rotation matrix, entry (row, column) at matrix[3 row + column], and a position: world = position +
 * matrix local. Transpose a matrix that is stored by columns (Eigen, glm, OpenGL) first; otherwise it means the inverse
 * rotation, which cannot be detected. The rotation is the one nearest to the matrix (in the Frobenius norm), off by at
 * most 24 u in operator norm, u = 2^-53; the quaternion is unit to 4 u, w >= 0. Errors, with a sentence in *error (may
 * be NULL) and *pose unchanged: NOT_FINITE (place: the entry; -1: the position), ROTATION (M'M is further from the
 * identity than OVOID_ROTATION_TOLERANCE, or M is a reflection), RANGE (the position), ARGUMENT (NULL).
 */
OVOID_API ovoid_code ovoid_pose_make_matrix(const double matrix[9], ovoid_vec3 position, ovoid_pose *pose,
                                            ovoid_error *error);

/**
 * The pose of a 4x4 homogeneous matrix, entry (row, column) at matrix[4 row + column]; otherwise as
 * ovoid_pose_make_matrix. The last row must be exactly 0 0 0 1 (else ROTATION), so a matrix that is stored by columns
 * is refused unless its position is zero.
 */
OVOID_API ovoid_code ovoid_pose_make_transform(const double matrix[16], ovoid_pose *pose, ovoid_error *error);

/**
 * The pose at a position, rotated by an angle in radians about an axis of any length but zero, counter-clockwise as
 * seen from the axis' tip. The rotation is off by at most 16 u in operator norm, u = 2^-53, if the sine and the cosine
 * are within an ulp. Errors, with *pose unchanged: NOT_FINITE, ROTATION (an axis of zero), RANGE (the position),
 * ARGUMENT (NULL).
 */
OVOID_API ovoid_code ovoid_pose_make_axis_angle(ovoid_vec3 position, ovoid_vec3 axis, double angle, ovoid_pose *pose);

/**
 * The rotation matrix of a pose, entry (row, column) at matrix[3 row + column]; each is off by at most 12 u, u = 2^-53.
 * The pose must not be one that ovoid_pose_validate refuses.
 */
OVOID_API void ovoid_pose_compute_matrix(const ovoid_pose *pose, double matrix[9]);

/**
 * The 4x4 homogeneous matrix of a pose, entry (row, column) at matrix[4 row + column], last row 0 0 0 1; errors as in
 * ovoid_pose_compute_matrix.
 */
OVOID_API void ovoid_pose_compute_transform(const ovoid_pose *pose, double matrix[16]);

/** The local point in the world frame, rounded: error at most 64 ulp of |position| + |point|. */
OVOID_API ovoid_vec3 ovoid_pose_compute_point(const ovoid_pose *pose, ovoid_vec3 local);

/** The world point in the local frame; the inverse of ovoid_pose_compute_point, with the same error bound. */
OVOID_API ovoid_vec3 ovoid_pose_compute_local_point(const ovoid_pose *pose, ovoid_vec3 world);

/**
 * The pose of a part of a body: the part is posed by `inner` in the body, the body by `outer`. Its points are, to
 * rounding, those of inner moved by outer. This product defines where a part of a body is; it has the same bits
 * everywhere. Its rotation is that of the exact product to 16 u in operator norm, u = 2^-53; its position is off by at
 * most 46 u |inner.position| + 2 u |outer.position|. Neither pose may be one that ovoid_pose_validate refuses.
 */
OVOID_API ovoid_pose ovoid_pose_compute_product(const ovoid_pose *outer, const ovoid_pose *inner);

/** The inverse pose: its rotation is exact, its position off by at most 45 u |position|, u = 2^-53. */
OVOID_API ovoid_pose ovoid_pose_compute_inverse(const ovoid_pose *pose);

/** OVOID_OK, or what is wrong with the pose: NOT_FINITE, RANGE, ROTATION. */
OVOID_API ovoid_code ovoid_pose_validate(const ovoid_pose *pose);

#ifdef __cplusplus
}
#endif
#endif
