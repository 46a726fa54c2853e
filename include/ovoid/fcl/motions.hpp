/**
 * @file motions.hpp
 * FCL's motions from time 0 to 1 as ovoid's, for <ovoid/fcl.hpp>: translations, interpolations (the origin moves along
 * a line, the body turns about one axis) and screws. Splines are left to FCL.
 */
#ifndef OVOID_FCL_MOTIONS_HPP
#define OVOID_FCL_MOTIONS_HPP

#include "ovoid/fcl/pose.hpp"

namespace ovoid {
namespace fcl {
namespace detail {

inline ovoid_vec3 from_vector(const Eigen::Vector3d &v) { return {v[0], v[1], v[2]}; }

/// A screw motion: the body turns about an axis that no point of it leaves, and moves along it.
inline ovoid_motion make_screw(const ovoid_pose &start, const ovoid_pose &end) {
    const auto quat = [](const ovoid_quat &q) { return Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized(); };
    const auto vec = [](const ovoid_vec3 &v) { return Eigen::Vector3d(v.x, v.y, v.z); };
    const Eigen::Quaterniond from = quat(start.rotation);
    const Eigen::AngleAxisd turn(quat(end.rotation) * from.conjugate());
    const Eigen::Vector3d way = vec(end.position) - vec(start.position);
    // Too small a turn has its axis too far away.
    if (!(turn.angle() >= 1e-10)) return ovoid_motion_make_poses(start, end, 1);
    const Eigen::Vector3d axis = turn.axis();
    const Eigen::Vector3d to_axis = (way - axis * axis.dot(way) + axis.cross(way) / std::tan(turn.angle() / 2)) / 2;
    ovoid_motion motion =
        ovoid_motion_make_velocity(start, from_vector(axis * axis.dot(way)), from_vector(axis * turn.angle()), 1);
    motion.pivot = from_vector(from.conjugate() * to_axis);
    return motion;
}

/// The motion of this kind from one transform to another; false if FCL has to answer.
template <class S>
bool make_motion(::fcl::CCDMotionType kind, const ::fcl::Transform3<S> &begin, const ::fcl::Transform3<S> &end,
                 ovoid_motion &motion) {
    ovoid_pose start, stop;
    if (!to_pose<S>(begin, start) || !to_pose<S>(end, stop)) return false;
    switch (kind) {
    case ::fcl::CCDM_TRANS: motion = ovoid_motion_make_poses(start, {stop.position, start.rotation}, 1); return true;
    case ::fcl::CCDM_LINEAR: motion = ovoid_motion_make_poses(start, stop, 1); return true;
    case ::fcl::CCDM_SCREW: motion = make_screw(start, stop); return true;
    default: return false;
    }
}

/// The motion of an object of FCL's classes; false if it is none of the three.
template <class S> bool make_motion(const ::fcl::MotionBase<S> *from, ovoid_motion &motion) {
    ::fcl::CCDMotionType kind = ::fcl::CCDM_SPLINE;
    if (dynamic_cast<const ::fcl::TranslationMotion<S> *>(from)) kind = ::fcl::CCDM_TRANS;
    if (dynamic_cast<const ::fcl::InterpMotion<S> *>(from)) kind = ::fcl::CCDM_LINEAR;
    if (dynamic_cast<const ::fcl::ScrewMotion<S> *>(from)) kind = ::fcl::CCDM_SCREW;
    if (kind == ::fcl::CCDM_SPLINE) return false;
    ::fcl::Transform3<S> begin, end;
    from->integrate(0);
    from->getCurrentTransform(begin);
    from->integrate(1);
    from->getCurrentTransform(end);
    return make_motion<S>(kind, begin, end, motion);
}

} // namespace detail
} // namespace fcl
} // namespace ovoid

#endif
