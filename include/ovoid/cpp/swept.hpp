/**
 * @file swept.hpp
 * Swept spheres: bodies that are numbers alone, without a shape (<ovoid/swept.h>). Queries never throw.
 */
#ifndef OVOID_CPP_SWEPT_HPP
#define OVOID_CPP_SWEPT_HPP

#include "ovoid/cpp/query.hpp"
#include "ovoid/swept.h"

#include <cstdint>

namespace ovoid {

/** A ball swept over a core, at a pose whose axes are the core's; half lengths and radii are those of the shapes. */
struct swept_sphere : ovoid_swept_sphere {
    /** From the C struct. */
    template <class T, std::enable_if_t<std::is_same<T, ovoid_swept_sphere>::value, int> = 0>
    swept_sphere(const T &from) noexcept : ovoid_swept_sphere(from) {}
    /** A sphere. */
    static swept_sphere sphere(double radius, const vec3 &center = {}) noexcept {
        return swept_sphere(OVOID_SWEPT_POINT, radius, {}, pose(center));
    }
    /** A capsule along the pose's z axis. */
    static swept_sphere capsule(double radius, double half_length, const pose &at = {}) noexcept {
        return swept_sphere(OVOID_SWEPT_SEGMENT, radius, {half_length, 0, 0}, at);
    }
    /** A box, rounded by a radius. */
    static swept_sphere box(const vec3 &half_sizes, const pose &at = {}, double radius = 0) noexcept {
        return swept_sphere(OVOID_SWEPT_BOX, radius, half_sizes, at);
    }
    /** A cylinder around the pose's z axis. */
    static swept_sphere cylinder(double radius, double half_length, const pose &at = {}) noexcept {
        return swept_sphere(OVOID_SWEPT_CYLINDER, 0, {half_length, radius, 0}, at);
    }
    /** A cone around the pose's z axis, its apex at half_length along it. */
    static swept_sphere cone(double radius, double half_length, const pose &at = {}) noexcept {
        return swept_sphere(OVOID_SWEPT_CONE, 0, {half_length, radius, 0}, at);
    }
    /** An ellipsoid with half axes along those of the pose. */
    static swept_sphere ellipsoid(const vec3 &half_axes, const pose &at = {}) noexcept {
        return swept_sphere(OVOID_SWEPT_ELLIPSOID, 0, half_axes, at);
    }
    /** The hull of points, x, y and z of each, borrowed, and rounded by a radius. middle: one of the hull's points. */
    static swept_sphere hull(const double *xyz, std::uint32_t count_, const vec3 &middle, const pose &at = {},
                             double radius = 0) noexcept {
        swept_sphere made(OVOID_SWEPT_POINTS, radius, middle, at);
        made.points = xyz;
        made.count = count_;
        return made;
    }

  private:
    swept_sphere(ovoid_swept_core core_, double radius_, const vec3 &half_, const pose &at) noexcept
        : ovoid_swept_sphere{at.position, radius_, core_, {half_.x, half_.y, half_.z}, {}, nullptr, 0, nullptr} {
        double m[9];
        ovoid_pose_compute_matrix(&at, m);
        for (int k = 0; k < 3; k++) axis[k] = {m[k], m[3 + k], m[6 + k]};
        const bool is_around_axis =
            core_ == OVOID_SWEPT_SEGMENT || core_ == OVOID_SWEPT_CYLINDER || core_ == OVOID_SWEPT_CONE;
        if (is_around_axis) axis[0] = axis[2];
    }
};

/** Do the bodies have a common point? Undecided where rounding leaves it open. */
inline verdict collide(const ovoid_swept_sphere &a, const ovoid_swept_sphere &b) noexcept {
    return ovoid_swept_collide({&a, &b});
}
/** The distance; of an overlap the sign, with two points of a common part. to: written unless undecided. */
inline verdict distance(const ovoid_swept_sphere &a, const ovoid_swept_sphere &b,
                        ovoid_witness *to = nullptr) noexcept {
    return ovoid_swept_distance({&a, &b}, to);
}
/** The signed distance. to: written unless undecided. */
inline verdict depth(const ovoid_swept_sphere &a, const ovoid_swept_sphere &b, ovoid_witness *to = nullptr) noexcept {
    return ovoid_swept_depth({&a, &b}, to);
}
/** The depth of an overlap; of bodies that are apart the sign alone, without a witness. */
inline verdict contact_depth(const ovoid_swept_sphere &a, const ovoid_swept_sphere &b,
                             ovoid_witness *to = nullptr) noexcept {
    return ovoid_swept_contact({&a, &b}, to);
}

} // namespace ovoid

#endif
