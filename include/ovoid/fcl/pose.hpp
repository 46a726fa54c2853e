/**
 * @file pose.hpp
 * FCL's transforms and motions as ovoid's, for <ovoid/fcl.hpp>.
 */
#ifndef OVOID_FCL_POSE_HPP
#define OVOID_FCL_POSE_HPP

#include "ovoid/motion.h"

#include <fcl/fcl.h>

#include <algorithm>
#include <cmath>

namespace ovoid {
namespace fcl {
namespace detail {

template <class S> ovoid_vec3 to_vec3(const ::fcl::Vector3<S> &v) {
    return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}
template <class S>::fcl::Vector3<S> from_vec3(const ovoid_vec3 &v) {
    return {static_cast<S>(v.x), static_cast<S>(v.y), static_cast<S>(v.z)};
}

/// The most by which the entries of a matrix, summed, may differ from those of its quaternion; others take the longer
/// way of ovoid_pose_make_matrix, which finds the nearest rotation and refuses what is none.
constexpr double rotation_tolerance = 1e-14;

/// The quaternion whose largest part is at i, of a rotation matrix m: S. W. Shepperd, Quaternion from rotation matrix,
/// 1978.
template <class M> ovoid_quat make_quat(const M &m) {
    const double x = m(0, 0), y = m(1, 1), z = m(2, 2), trace = x + y + z;
    if (trace > 0) {
        const double root = std::sqrt(trace + 1), part = 0.5 / root;
        return {root / 2, (m(2, 1) - m(1, 2)) * part, (m(0, 2) - m(2, 0)) * part, (m(1, 0) - m(0, 1)) * part};
    }
    const int i = x >= y ? (x >= z ? 0 : 2) : (y >= z ? 1 : 2), j = (i + 1) % 3, k = (i + 2) % 3;
    const double root = std::sqrt(1 + m(i, i) - m(j, j) - m(k, k)), part = 0.5 / root;
    double v[3];
    v[i] = root / 2, v[j] = (m(j, i) + m(i, j)) * part, v[k] = (m(k, i) + m(i, k)) * part;
    return {(m(k, j) - m(j, k)) * part, v[0], v[1], v[2]};
}

/// Is m the matrix of a quaternion, by the sum of the entries' differences? Of NaN it is not.
template <class M> bool is_matrix_of(const ovoid_quat &q, const M &m) {
    const double xx = 2 * q.x * q.x, yy = 2 * q.y * q.y, zz = 2 * q.z * q.z;
    const double xy = 2 * q.x * q.y, xz = 2 * q.x * q.z, yz = 2 * q.y * q.z;
    const double wx = 2 * q.w * q.x, wy = 2 * q.w * q.y, wz = 2 * q.w * q.z;
    double off = std::fabs(1 - yy - zz - m(0, 0)) + std::fabs(1 - xx - zz - m(1, 1)) + std::fabs(1 - xx - yy - m(2, 2));
    off += std::fabs(xy - wz - m(0, 1)) + std::fabs(xy + wz - m(1, 0)) + std::fabs(xz + wy - m(0, 2));
    off += std::fabs(xz - wy - m(2, 0)) + std::fabs(yz - wx - m(1, 2)) + std::fabs(yz + wx - m(2, 1));
    return off <= rotation_tolerance;
}

/// The pose of a transform; false if it is no rigid motion, or not finite.
template <class S> bool to_pose(const ::fcl::Transform3<S> &t, ovoid_pose &pose) {
    const auto m = t.linear().template cast<double>().eval();
    const ovoid_vec3 position = {static_cast<double>(t.translation()[0]), static_cast<double>(t.translation()[1]),
                                 static_cast<double>(t.translation()[2])};
    pose = {position, make_quat(m)};
    const double far = std::max(std::fabs(position.x), std::max(std::fabs(position.y), std::fabs(position.z)));
    const double sum = position.x + position.y + position.z; // NaN and infinity go on in it
    if (is_matrix_of(pose.rotation, m) && far <= OVOID_LENGTH_MAX && sum - sum == 0) return true;
    double rows[9];
    for (int i = 0; i < 9; i++) rows[i] = m(i / 3, i % 3);
    return ovoid_pose_make_matrix(rows, position, &pose, nullptr) == OVOID_OK;
}

/// The transform of a pose.
template <class S>::fcl::Transform3<S> from_pose(const ovoid_pose &pose) {
    double rows[9];
    ovoid_pose_compute_matrix(&pose, rows);
    ::fcl::Transform3<S> t = ::fcl::Transform3<S>::Identity();
    for (int i = 0; i < 9; i++) t.linear()(i / 3, i % 3) = static_cast<S>(rows[i]);
    t.translation() = from_vec3<S>(pose.position);
    return t;
}

} // namespace detail
} // namespace fcl
} // namespace ovoid

#endif
