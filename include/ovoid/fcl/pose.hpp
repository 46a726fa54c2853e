/**
 * @file pose.hpp
 * FCL's transforms and motions as ovoid's, for <ovoid/fcl.hpp>.
 */
#ifndef OVOID_FCL_POSE_HPP
#define OVOID_FCL_POSE_HPP

#include "ovoid/fcl/print.hpp"
#include "ovoid/motion.h"
#include "ovoid/prepared.h"

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

inline double dot(const ovoid_vec3 &a, const ovoid_vec3 &b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
/// a + t b.
inline ovoid_vec3 add_scaled(const ovoid_vec3 &a, const ovoid_vec3 &b, double t) {
    return {a.x + t * b.x, a.y + t * b.y, a.z + t * b.z};
}

/// How far the columns of a transform may be from unit vectors at right angles: the sum of what their products are off.
constexpr double columns_rounding = 32 * 1.1102230246251565e-16;

/// Column k of a transform.
template <class S> OVOID_FCL_INLINE ovoid_vec3 get_column(const ::fcl::Transform3<S> &t, int k) {
    const auto &m = t.matrix();
    return {static_cast<double>(m.coeff(0, k)), static_cast<double>(m.coeff(1, k)), static_cast<double>(m.coeff(2, k))};
}

/// How far a column is from a unit vector, and the products of all three from those of a rotation.
OVOID_FCL_INLINE double off_unit(const ovoid_vec3 &v) { return std::fabs(dot(v, v) - 1); }
OVOID_FCL_INLINE double off_rotation(const ovoid_vec3 (&column)[3]) {
    return off_unit(column[0]) + off_unit(column[1]) + off_unit(column[2]) + std::fabs(dot(column[0], column[1])) +
           std::fabs(dot(column[1], column[2])) + std::fabs(dot(column[2], column[0]));
}
/// Makes columns those of a rotation that are off by less than a part in 1e14, as a matrix of a quaternion is at times:
/// no point of a body is moved by more than that part of its size. False of others.
OVOID_FCL_APART inline bool straighten(ovoid_vec3 (&column)[3]) {
    constexpr double most = 1e-14;
    if (!(off_rotation(column) <= most)) return false;
    const auto scale = [](const ovoid_vec3 &v) {
        const double part = 1 / std::sqrt(dot(v, v));
        return ovoid_vec3{part * v.x, part * v.y, part * v.z};
    };
    const ovoid_vec3 a = scale(column[0]), b = scale(add_scaled(column[1], a, -dot(a, column[1])));
    const ovoid_vec3 c = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    const double hand = dot(c, column[2]) < 0 ? -1 : 1;
    column[0] = a, column[1] = b;
    column[2] = {hand * c.x, hand * c.y, hand * c.z};
    return true;
}
/// Are the columns those of a rotation, to a few roundings?
template <class S> OVOID_FCL_INLINE bool is_rotation(const ::fcl::Transform3<S> &t) {
    return off_rotation({get_column<S>(t, 0), get_column<S>(t, 1), get_column<S>(t, 2)}) <= columns_rounding;
}

/// A vector turned by a transform.
template <class S> ovoid_vec3 turn(const ::fcl::Transform3<S> &t, const ovoid_vec3 &v) {
    const auto row = [&](int i) {
        const auto m = [&](int k) { return static_cast<double>(t.matrix().coeff(i, k)); };
        return m(0) * v.x + m(1) * v.y + m(2) * v.z;
    };
    return {row(0), row(1), row(2)};
}
inline double sum_abs(const ovoid_vec3 &v) { return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z); }

/// Prepares a shape, or no shape, at a transform; false if that is no rigid motion, or not finite.
template <class S> bool place(const ovoid_shape *shape, const ::fcl::Transform3<S> &t, ovoid_prepared_shape &to) {
    const auto m = [&t](int i, int k) { return static_cast<double>(t.matrix().coeff(i, k)); };
    const double rows[9] = {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)};
    return ovoid_prepared_shape_make_matrix(shape, rows, to_vec3<S>(t.translation()), &to) == OVOID_OK;
}
/// A shape that looks the same from all sides: the rotation is not read.
template <class S>
bool place_sphere(const ovoid_shape *shape, const ::fcl::Transform3<S> &t, ovoid_prepared_shape &to) {
    return ovoid_prepared_shape_make_matrix(shape, nullptr, to_vec3<S>(t.translation()), &to) == OVOID_OK;
}

/// The pose of a transform; false if it is no rigid motion, or not finite.
template <class S> bool to_pose(const ::fcl::Transform3<S> &t, ovoid_pose &pose) {
    ovoid_prepared_shape placed;
    if (!place<S>(nullptr, t, placed)) return false;
    pose = placed.body.pose;
    return true;
}

/// Is the position of a transform finite, and within ovoid's range?
template <class S> bool is_in_range(const ::fcl::Transform3<S> &t) {
    const auto is_in = [&t](int i) {
        return std::fabs(static_cast<double>(t.matrix().coeff(i, 3))) <= OVOID_LENGTH_MAX;
    };
    return is_in(0) && is_in(1) && is_in(2);
}
/// Is a transform a rigid motion in that range? Most are seen to be by the columns' lengths and their cross product,
/// which costs less than a pose.
template <class S> bool is_rigid(const ::fcl::Transform3<S> &t) {
    const auto m = [&t](int i, int k) { return static_cast<double>(t.matrix().coeff(i, k)); };
    const auto dot = [&m](int i, int k) { return m(0, i) * m(0, k) + m(1, i) * m(1, k) + m(2, i) * m(2, k); };
    const auto cross = [&m](int i, int k) { return m(i, 0) * m(k, 1) - m(k, 0) * m(i, 1); };
    const double columns = std::fabs(dot(0, 0) - 1) + std::fabs(dot(1, 1) - 1) + std::fabs(dot(0, 1));
    const double hand =
        std::fabs(cross(1, 2) - m(0, 2)) + std::fabs(cross(2, 0) - m(1, 2)) + std::fabs(cross(0, 1) - m(2, 2));
    ovoid_pose unused;
    return columns + hand <= 1e-14 ? is_in_range<S>(t) : to_pose<S>(t, unused);
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
