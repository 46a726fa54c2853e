// Functions of poses for callers inside the library.
#ifndef OVOID_LINEAR_POSE_H
#define OVOID_LINEAR_POSE_H

#include "linear/rotation.h"

#include <math.h>

/// ovoid_pose_validate, for callers that have set up the floating-point environment.
ovoid_code pose_validate(const ovoid_pose *pose);

/// ovoid_pose_make_matrix, for callers that have set up the floating-point environment.
ovoid_code pose_make_matrix(const double *matrix, ovoid_vec3 position, ovoid_pose *pose, ovoid_error *error);

/// 1 for a position that pose_validate takes; NaN fails every comparison.
static inline int position_is_valid(ovoid_vec3 p) {
    return (fabs(p.x) <= OVOID_LENGTH_MAX) & (fabs(p.y) <= OVOID_LENGTH_MAX) & (fabs(p.z) <= OVOID_LENGTH_MAX);
}

/// 1 for a pose that is valid, whose quaternion needs no scaling: most poses.
static inline int pose_is_plain(const ovoid_pose *pose) {
    return position_is_valid(pose->position) & quat_is_plain(quat_norm_squared(pose->rotation));
}

/// ovoid_pose_compute_product, for callers that have set up the floating-point environment. With u = 2^-53: a component
/// of q p is a sum of four products, off by 4 u times the sum of their sizes, which is at most |q||p| (Cauchy,
/// Schwarz); so q p is off by 8 u |q||p|, and the rotation by 16 u. The position: R(q) is off by 36 u, its product with
/// a point by 6 u more, the sum by u of the result.
ovoid_pose pose_compute_product(const ovoid_pose *outer, const ovoid_pose *inner);

#endif
