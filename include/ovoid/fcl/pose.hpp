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

/// The most by which the columns of a matrix, summed, may differ from orthonormal right-handed ones; others take the
/// longer way of ovoid_pose_make_matrix, which finds the nearest rotation and refuses what is none.
constexpr double rotation_tolerance = 1e-14;

/// A quaternion q of a rotation matrix m, of no particular length: a row of 4 q q', whose entries are sums of those of
/// m (S. W. Shepperd, Quaternion from rotation matrix, 1978). That of q.w is exact enough where the turn is below 138
/// degrees; otherwise the row is that with the largest entry on the diagonal.
template <class M> ovoid_quat make_quat(const M &m) {
    const double x = m(0, 0), y = m(1, 1), z = m(2, 2), trace = x + y + z;
    const double wx = m(2, 1) - m(1, 2), wy = m(0, 2) - m(2, 0), wz = m(1, 0) - m(0, 1);
    if (trace > -0.5) return {1 + trace, wx, wy, wz};
    const double xy = m(1, 0) + m(0, 1), xz = m(0, 2) + m(2, 0), yz = m(2, 1) + m(1, 2);
    if (x >= y && x >= z) return {wx, 1 + x - y - z, xy, xz};
    if (y >= z) return {wy, xy, 1 - x + y - z, yz};
    return {wz, xz, yz, 1 - x - y + z};
}

/// Is m a rotation: two unit columns at right angles, and the third their cross product? Of NaN it is not.
template <class M> bool is_rotation(const M &m) {
    const auto dot = [&](int i, int k) { return m(0, i) * m(0, k) + m(1, i) * m(1, k) + m(2, i) * m(2, k); };
    const auto cross = [&](int i, int k) { return m(i, 0) * m(k, 1) - m(k, 0) * m(i, 1); };
    const double length = std::fabs(dot(0, 0) - 1) + std::fabs(dot(1, 1) - 1);
    const double angle = std::fabs(dot(0, 1)) + std::fabs(cross(1, 2) - m(0, 2));
    const double hand = std::fabs(cross(2, 0) - m(1, 2)) + std::fabs(cross(0, 1) - m(2, 2));
    return length + angle + hand <= rotation_tolerance;
}

inline bool is_position(const ovoid_vec3 &p) {
    return std::fabs(p.x) <= OVOID_LENGTH_MAX && std::fabs(p.y) <= OVOID_LENGTH_MAX &&
           std::fabs(p.z) <= OVOID_LENGTH_MAX;
}

/// The pose of a transform; false if it is no rigid motion, or not finite.
template <class S> bool to_pose(const ::fcl::Transform3<S> &t, ovoid_pose &pose) {
    // Entries as doubles, without a copy of the matrix.
    const auto m = [&t](int i, int k) { return static_cast<double>(t.matrix().coeff(i, k)); };
    pose = {{m(0, 3), m(1, 3), m(2, 3)}, make_quat(m)};
    if (is_rotation(m) && is_position(pose.position)) return true;
    double rows[9];
    for (int i = 0; i < 9; i++) rows[i] = m(i / 3, i % 3);
    return ovoid_pose_make_matrix(rows, pose.position, &pose, nullptr) == OVOID_OK;
}

/// The pose of a geometry. A sphere looks the same from all sides, so its rotation is not read.
template <class S>
bool to_pose(const ::fcl::CollisionGeometry<S> *of, const ::fcl::Transform3<S> &t, ovoid_pose &pose) {
    if (of->getNodeType() != ::fcl::GEOM_SPHERE) return to_pose<S>(t, pose);
    pose = {to_vec3<S>(t.translation()), {1, 0, 0, 0}};
    return is_position(pose.position);
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
