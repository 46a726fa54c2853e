/**
 * @file motion.hpp
 * Bodies that move: motions, times of impact, smallest distances, casts and rays, swept boxes. Searches never throw.
 */
#ifndef OVOID_CPP_MOTION_HPP
#define OVOID_CPP_MOTION_HPP

#include "ovoid/body_impact.h"
#include "ovoid/cpp/body.hpp"
#include "ovoid/motion.h"

namespace ovoid {

/** An axis-aligned box. */
using box = ovoid_box;
/** A step of a proof. */
using step = ovoid_step;
/** A group of steps. */
using step_group = ovoid_step_group;
/** When two moving shapes come within a margin of each other. */
using impact = ovoid_impact;
/** The first time at which two moving bodies come within a margin of each other. */
using body_impact = ovoid_body_impact;
/** The smallest distance of two moving shapes. */
using approach = ovoid_approach;
/** Where a ray hits a shape. */
using ray_hit = ovoid_ray_hit;

/** A motion: an exact mathematical object. */
struct motion : ovoid_motion {
    /** Stands still at a pose. */
    motion(const pose &at = {}) noexcept : ovoid_motion(ovoid_motion_make_still(at)) {}
    /** From the C struct. */
    template <class T, std::enable_if_t<std::is_same<T, ovoid_motion>::value, int> = 0>
    motion(const T &from) noexcept : ovoid_motion(from) {}
    /** Stands still at a pose. */
    static motion still(const pose &at) noexcept { return ovoid_motion_make_still(at); }
    /** Constant velocities (world frame, radians), turning about the origin of the body's local frame. */
    static motion velocity(const pose &from, const vec3 &linear_, const vec3 &angular_, double duration_) noexcept {
        return ovoid_motion_make_velocity(from, linear_, angular_, duration_);
    }
    /** From one pose to another. */
    static motion between(const pose &from, const pose &to_, double duration_) noexcept {
        return ovoid_motion_make_poses(from, to_, duration_);
    }
    /** Through poses at times: contiguous containers, borrowed. Throws ARGUMENT if they differ in length. */
    template <class Times, class Poses> static motion path(const Times &at, const Poses &through) {
        const auto t = detail::items_of<double>(at);
        const auto p = detail::items_of<ovoid_pose>(through);
        if (t.size() != p.size()) detail::fail(OVOID_ERROR_ARGUMENT, "a path needs as many times as poses");
        return ovoid_motion_make_path(t.data(), p.data(), t.size());
    }
    /**
     * Throws the error of the motion, if there is one: NOT_FINITE, ROTATION, RANGE, ARGUMENT (place: of a path, the
     * pose).
     */
    void validate() const {
        ovoid_error e;
        detail::require(ovoid_motion_validate(this, &e), e);
    }
    /** The pose at a time; the motion must be valid. */
    pose at(double time) const noexcept { return ovoid_motion_compute_pose(this, time); }
};

/** A shape that moves, borrowed. */
struct moving_shape : ovoid_moving_shape {
    /** A shape and its motion. */
    moving_shape(shape_view s, const ovoid::motion &m) noexcept : ovoid_moving_shape{s.get(), m, {}} {}
    /** A shape that is fixed to the moving frame, at a pose. */
    moving_shape(shape_view s, const ovoid::motion &m, const pose &fixed) noexcept
        : ovoid_moving_shape{s.get(), m, fixed} {}
    /** From the C struct. */
    template <class T, std::enable_if_t<std::is_same<T, ovoid_moving_shape>::value, int> = 0>
    moving_shape(const T &from) noexcept : ovoid_moving_shape(from) {}
    /** Its pose at a time. */
    pose at(double time) const noexcept { return ovoid_moving_shape_compute_pose(this, time); }
    /** A box that holds it at all times of [begin, end]. */
    ovoid_box swept(double begin, double end) const noexcept {
        return ovoid_moving_shape_compute_box(this, begin, end);
    }
};

/** A shape, compound or solid that moves, borrowed. */
struct moving_body : ovoid_moving_body {
    /** A shape and its motion. */
    moving_body(shape_view s, const ovoid::motion &m) noexcept : ovoid_moving_body{s.get(), nullptr, m, nullptr} {}
    /** A compound and its motion. */
    moving_body(compound_view c, const ovoid::motion &m) noexcept : ovoid_moving_body{nullptr, c.get(), m, nullptr} {}
    /** A solid and its motion. */
    moving_body(solid_view s, const ovoid::motion &m) noexcept : ovoid_moving_body{nullptr, nullptr, m, s.get()} {}
    /** From the C struct. */
    template <class T, std::enable_if_t<std::is_same<T, ovoid_moving_body>::value, int> = 0>
    moving_body(const T &from) noexcept : ovoid_moving_body(from) {}
    /** Part i, as a moving shape. */
    moving_shape part(std::size_t i) const noexcept { return ovoid_moving_body_get_part(this, i); }
    /** A box that holds it at all times of [begin, end]. */
    ovoid_box swept(double begin, double end) const noexcept { return ovoid_moving_body_compute_box(this, begin, end); }
};

/** Options of queries about motions; the arrays that receive a proof are the caller's. */
struct motion_options : zeroed<ovoid_motion_options> {
    using zeroed::zeroed;
    /** Writes the proof's steps into a contiguous container, as many as it has room for. */
    template <class Steps> motion_options &with_steps(Steps &into) noexcept {
        return steps = std::data(into), capacity = std::size(into), *this;
    }
    /** For compounds: writes the steps' groups into a contiguous container. */
    template <class Groups> motion_options &with_groups(Groups &into) noexcept {
        return groups = std::data(into), group_capacity = std::size(into), *this;
    }
};

/** When do two moving shapes first come within margin (>= 0) of each other? */
inline impact find_impact(const moving_shape &a, const moving_shape &b, double margin = 0,
                          const ovoid_motion_options &o = motion_options()) noexcept {
    const ovoid_moving_pair both = {a, b, margin};
    return ovoid_impact_find(&both, &o);
}
/** When do two moving bodies first come within margin (>= 0) of each other? Each may be a solid. */
inline body_impact find_impact(const moving_body &a, const moving_body &b, double margin = 0,
                               const ovoid_motion_options &o = motion_options()) noexcept {
    const ovoid_moving_body_pair both = {a, b, margin};
    return ovoid_body_impact_find(&both, &o);
}
/**
 * Throws PROOF (place: the step) if an impact does not follow from its steps: all step_count of them. asked: the
 * options of the query; nullptr as in ovoid_impact_verify.
 */
template <class Steps>
void verify(const moving_shape &a, const moving_shape &b, double margin, const ovoid_impact &found, const Steps &steps,
            const ovoid_motion_options *asked = nullptr) {
    ovoid_error e;
    if (std::size(steps) < found.step_count)
        detail::fail(OVOID_ERROR_ARGUMENT, "the proof has more steps than were kept");
    const ovoid_moving_pair both = {a, b, margin};
    const ovoid_motion_basis basis = {asked, std::data(steps), nullptr};
    detail::require(ovoid_impact_verify(&both, &found, &basis, &e), e);
}
/** Throws PROOF (place: the group) if an impact of bodies does not follow from its steps and groups. */
template <class Steps, class Groups>
void verify(const moving_body &a, const moving_body &b, double margin, const ovoid_body_impact &found,
            const Steps &steps, const Groups &groups, const ovoid_motion_options *asked = nullptr) {
    ovoid_error e;
    if (std::size(steps) < found.impact.step_count || std::size(groups) < found.group_count)
        detail::fail(OVOID_ERROR_ARGUMENT, "the proof has more steps or groups than were kept");
    const ovoid_moving_body_pair both = {a, b, margin};
    const ovoid_motion_basis basis = {asked, std::data(steps), std::data(groups)};
    detail::require(ovoid_body_impact_verify(&both, &found, &basis, &e), e);
}

/** The first time at which b, moved along displacement without rotation, is within margin of a. */
inline impact cast_shape(const pair &p, const vec3 &displacement, double margin = 0,
                         const ovoid_motion_options &o = motion_options()) noexcept {
    return ovoid_shape_cast(&p, displacement, margin, &o);
}

/** A ray, thick if its radius is above 0. */
struct ray : ovoid_ray {
    /** From origin along direction (any length but zero), for length directions. */
    ray(const vec3 &origin_, const vec3 &direction_, double length_ = std::numeric_limits<double>::infinity(),
        double radius_ = 0) noexcept
        : ovoid_ray{origin_, direction_, length_, radius_} {}
    /** From the C struct. */
    template <class T, std::enable_if_t<std::is_same<T, ovoid_ray>::value, int> = 0>
    ray(const T &from) noexcept : ovoid_ray(from) {}
};
/** Where a ray first hits a posed shape. */
inline ray_hit cast_ray(const posed_shape &target, const ray &r) noexcept { return ovoid_shape_cast_ray(&target, &r); }

/** The smallest distance of two moving shapes over a time, and when. */
inline approach find_approach(const moving_shape &a, const moving_shape &b,
                              const ovoid_motion_options &o = motion_options()) noexcept {
    const ovoid_moving_pair both = {a, b, 0};
    return ovoid_approach_find(&both, &o);
}
/** Throws PROOF if an approach does not follow from its steps: all step_count of them. */
template <class Steps>
void verify(const moving_shape &a, const moving_shape &b, const ovoid_approach &found, const Steps &steps,
            const ovoid_motion_options *asked = nullptr) {
    ovoid_error e;
    if (std::size(steps) < found.step_count)
        detail::fail(OVOID_ERROR_ARGUMENT, "the proof has more steps than were kept");
    const ovoid_moving_pair both = {a, b, 0};
    const ovoid_motion_basis basis = {asked, std::data(steps), nullptr};
    detail::require(ovoid_approach_verify(&both, &found, &basis, &e), e);
}

/** The word for results, for example "hit". */
inline const char *name(ovoid_impact_status status) noexcept { return ovoid_impact_status_get_name(status); }

} // namespace ovoid

#endif
