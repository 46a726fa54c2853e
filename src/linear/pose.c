// Poses: transforming points, and validation. From matrices: pose_matrix.c.
#include "linear/pose.h"

#include "base/environment.h"
#include "linear/rotation.h"

ovoid_pose ovoid_pose_make_identity(void) { return (ovoid_pose){{0, 0, 0}, {1, 0, 0, 0}}; }

static ovoid_pose make_rpy(ovoid_vec3 xyz, ovoid_vec3 rpy) {
    // q = q_z(yaw) q_y(pitch) q_x(roll) with half angles.
    double cr = cos(rpy.x / 2), sr = sin(rpy.x / 2), cp = cos(rpy.y / 2), sp = sin(rpy.y / 2);
    double cy = cos(rpy.z / 2), sy = sin(rpy.z / 2);
    return (ovoid_pose){xyz,
                        {cr * cp * cy + sr * sp * sy, sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy,
                         cr * cp * sy - sr * sp * cy}};
}

ovoid_pose ovoid_pose_make_rpy(ovoid_vec3 xyz, ovoid_vec3 rpy) {
    ENVIRONMENT_RETURN(ovoid_pose, rpy, make_rpy(xyz, rpy));
}

static vec3 compute_point(const ovoid_pose *pose, vec3 local) {
    return vec3_add(pose->position, mat3_mul_vec3(quat_to_mat3(pose->rotation), local));
}

ovoid_vec3 ovoid_pose_compute_point(const ovoid_pose *pose, ovoid_vec3 local) {
    ENVIRONMENT_RETURN(vec3, local, compute_point(pose, local));
}

static vec3 compute_local_point(const ovoid_pose *pose, vec3 world) {
    return mat3_mul_transposed_vec3(quat_to_mat3(pose->rotation), vec3_sub(world, pose->position));
}

ovoid_vec3 ovoid_pose_compute_local_point(const ovoid_pose *pose, ovoid_vec3 world) {
    ENVIRONMENT_RETURN(vec3, world, compute_local_point(pose, world));
}

ovoid_code pose_validate(const ovoid_pose *pose) {
    ovoid_quat q = pose->rotation;
    if (!vec3_is_finite(pose->position)) return OVOID_ERROR_NOT_FINITE;
    if (!isfinite(q.w) || !isfinite(q.x) || !isfinite(q.y) || !isfinite(q.z)) return OVOID_ERROR_NOT_FINITE;
    if (vec3_max_abs(pose->position) > OVOID_LENGTH_MAX) return OVOID_ERROR_RANGE;
    if (q.w == 0 && q.x == 0 && q.y == 0 && q.z == 0) return OVOID_ERROR_ROTATION;
    return OVOID_OK;
}

ovoid_code ovoid_pose_validate(const ovoid_pose *pose) { ENVIRONMENT_RETURN(ovoid_code, pose, pose_validate(pose)); }

ovoid_pose pose_compute_product(const ovoid_pose *outer, const ovoid_pose *inner) {
    ovoid_quat a = outer->rotation, b = inner->rotation;
    if (!quat_is_plain(quat_norm_squared(a))) a = quat_scaled(a);
    if (!quat_is_plain(quat_norm_squared(b))) b = quat_scaled(b);
    ovoid_quat q = {
        (a.w * b.w - a.x * b.x) - (a.y * b.y + a.z * b.z), (a.w * b.x + a.x * b.w) + (a.y * b.z - a.z * b.y),
        (a.w * b.y - a.x * b.z) + (a.y * b.w + a.z * b.x), (a.w * b.z + a.x * b.y) + (a.z * b.w - a.y * b.x)};
    return (ovoid_pose){compute_point(outer, inner->position), q};
}

ovoid_pose ovoid_pose_compute_product(const ovoid_pose *outer, const ovoid_pose *inner) {
    ENVIRONMENT_RETURN(ovoid_pose, outer, pose_compute_product(outer, inner));
}

static ovoid_pose compute_inverse(const ovoid_pose *pose) {
    ovoid_quat q = pose->rotation;
    return (ovoid_pose){mat3_mul_transposed_vec3(quat_to_mat3(q), vec3_neg(pose->position)), {q.w, -q.x, -q.y, -q.z}};
}

ovoid_pose ovoid_pose_compute_inverse(const ovoid_pose *pose) {
    ENVIRONMENT_RETURN(ovoid_pose, pose, compute_inverse(pose));
}
