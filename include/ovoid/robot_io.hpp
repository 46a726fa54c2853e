/**
 * @file robot_io.hpp
 * Robots from files, from C++: URDF and SRDF, scenes of obstacles, planning problems, trajectories. Links
 * libovoid_robot and libovoid_io. Files that cannot be read throw ovoid::error: its sentence is "path:line: what is
 * wrong", its place the line. The objects return views into themselves: C structs of <ovoid/robot_io.h>.
 */
#ifndef OVOID_ROBOT_IO_HPP
#define OVOID_ROBOT_IO_HPP

#include "ovoid/robot.hpp"
#include "ovoid/robot_io.h"

#include <string>

namespace ovoid {

/** How to read a robot. */
using robot_read_options = zeroed<ovoid_robot_read_options>;

/** A URDF, perhaps with an SRDF, owned: names, numbers and shapes. */
class robot_file : public detail::owner<detail::pointer<ovoid_robot_file>, ovoid_robot_file, ovoid_robot_file_destroy> {
  public:
    using owner::owner;
    /** Reads one; srdf: "" for none. Throws as ovoid_robot_file_read fails. */
    static robot_file read(const std::string &urdf, const std::string &srdf = "",
                           const ovoid_robot_read_options &how = robot_read_options()) {
        ovoid_error e;
        const char *second = srdf.empty() ? nullptr : srdf.c_str();
        return robot_file(detail::require(ovoid_robot_file_read(urdf.c_str(), second, &how, &e), e));
    }
    /** Reads texts; srdf: nullptr for none. Throws as ovoid_robot_file_read_text fails. */
    static robot_file read_text(const ovoid_robot_text &urdf, const ovoid_robot_text *srdf = nullptr,
                                const ovoid_robot_read_options &how = robot_read_options()) {
        ovoid_error e;
        return robot_file(detail::require(ovoid_robot_file_read_text(&urdf, srdf, &how, &e), e));
    }
    /** The argument of robot::create: a view. */
    ovoid_robot_description description() const noexcept { return ovoid_robot_file_get_description(get()); }
    /** The robot, which borrows the shapes of this file. Throws as ovoid_robot_create fails. */
    robot create_robot() const { return robot::create(description()); }
    /** Number of mesh files, each at one scale. */
    std::size_t mesh_count() const noexcept { return ovoid_robot_file_get_mesh_count(get()); }
    /** Mesh i < mesh_count. */
    ovoid_robot_mesh mesh(std::size_t i) const noexcept { return ovoid_robot_file_get_mesh(get(), i); }
    /** Number of kinds of elements that were not read. */
    std::size_t ignored_count() const noexcept { return ovoid_robot_file_get_ignored_count(get()); }
    /** Kind i < ignored_count. */
    ovoid_robot_ignored ignored(std::size_t i) const noexcept { return ovoid_robot_file_get_ignored(get(), i); }
    /** Mimics on fixed joints, which mean nothing. */
    std::size_t fixed_mimic_count() const noexcept { return ovoid_robot_file_get_fixed_mimic_count(get()); }
    /** Number of groups. */
    std::size_t group_count() const noexcept { return ovoid_robot_file_get_group_count(get()); }
    /** Group i < group_count. */
    ovoid_robot_group group(std::size_t i) const noexcept { return ovoid_robot_file_get_group(get(), i); }
    /** Number of end effectors. */
    std::size_t end_effector_count() const noexcept { return ovoid_robot_file_get_end_effector_count(get()); }
    /** End effector i < end_effector_count. */
    ovoid_robot_end_effector end_effector(std::size_t i) const noexcept {
        return ovoid_robot_file_get_end_effector(get(), i);
    }
    /** Number of named states. */
    std::size_t state_count() const noexcept { return ovoid_robot_file_get_state_count(get()); }
    /** State i < state_count. */
    ovoid_robot_state state(std::size_t i) const noexcept { return ovoid_robot_file_get_state(get(), i); }
    /** The spheres of the SRDF. */
    span<const ovoid_robot_link_sphere> spheres() const noexcept {
        std::size_t count;
        const ovoid_robot_link_sphere *items = ovoid_robot_file_get_spheres(get(), &count);
        return {items, count};
    }
    /** The passive joints. */
    span<const std::uint32_t> passive() const noexcept {
        std::size_t count;
        const std::uint32_t *items = ovoid_robot_file_get_passive(get(), &count);
        return {items, count};
    }
};

/** Obstacles of a scene, owned. */
class obstacles : public detail::owner<detail::pointer<ovoid_obstacles>, ovoid_obstacles, ovoid_obstacles_destroy> {
  public:
    using owner::owner;
    /** Reads a scene. Throws as ovoid_obstacles_read fails. */
    static obstacles read(const std::string &path, const ovoid_robot_read_options &how = robot_read_options()) {
        ovoid_error e;
        return obstacles(detail::require(ovoid_obstacles_read(path.c_str(), &how, &e), e));
    }
    /** The number of obstacles. */
    std::size_t size() const noexcept { return ovoid_obstacles_get_count(get()); }
    /** Obstacle i < size. */
    ovoid_obstacle operator[](std::size_t i) const noexcept { return ovoid_obstacles_get(get(), i); }
    /**
     * Puts the scene around the robot of a cell, which borrows the obstacles. Returns the place of each, in order.
     * Throws as ovoid_robot_cell_add_obstacles fails.
     */
    std::vector<ovoid_placed_obstacle> add_to(robot_cell &cell) const {
        std::vector<ovoid_placed_obstacle> placed(size());
        ovoid_error e;
        if (ovoid_robot_cell_add_obstacles(cell.get(), get(), placed.data(), &e) != OVOID_OK) detail::fail(e);
        return placed;
    }
};

/** A motion planning request of MoveIt, owned. */
class motion_request
    : public detail::owner<detail::pointer<ovoid_motion_request>, ovoid_motion_request, ovoid_motion_request_destroy> {
  public:
    using owner::owner;
    /** Reads one. Throws as ovoid_motion_request_read fails. */
    static motion_request read(const std::string &path, const ovoid_robot_read_options &how = robot_read_options()) {
        ovoid_error e;
        return motion_request(detail::require(ovoid_motion_request_read(path.c_str(), &how, &e), e));
    }
    /** Its group's name; "" if it has none. */
    const char *group() const noexcept { return ovoid_motion_request_get_group(get()); }
    /** The joint values at the start. */
    span<const ovoid_joint_position> start() const noexcept {
        std::size_t count;
        const ovoid_joint_position *items = ovoid_motion_request_get_start(get(), &count);
        return {items, count};
    }
    /** Number of goals. */
    std::size_t goal_count() const noexcept { return ovoid_motion_request_get_goal_count(get()); }
    /** The joint values at goal i < goal_count. */
    span<const ovoid_joint_position> goal(std::size_t i) const noexcept {
        std::size_t count;
        const ovoid_joint_position *items = ovoid_motion_request_get_goal(get(), i, &count);
        return {items, count};
    }
};

/** A trajectory of MoveIt or ROS, owned. */
class trajectory : public detail::owner<detail::pointer<ovoid_trajectory>, ovoid_trajectory, ovoid_trajectory_destroy> {
  public:
    using owner::owner;
    /** Reads one. Throws as ovoid_trajectory_read fails. */
    static trajectory read(const std::string &path, const ovoid_robot_read_options &how = robot_read_options()) {
        ovoid_error e;
        return trajectory(detail::require(ovoid_trajectory_read(path.c_str(), &how, &e), e));
    }
    /** The joints' numbers of trajectory_start. */
    span<const ovoid_joint_position> start() const noexcept {
        std::size_t count;
        const ovoid_joint_position *items = ovoid_trajectory_get_start(get(), &count);
        return {items, count};
    }
    /** Number of points. */
    std::size_t size() const noexcept { return ovoid_trajectory_get_count(get()); }
    /** The joints' numbers at point i < size. */
    span<const ovoid_joint_position> point(std::size_t i) const noexcept {
        std::size_t count;
        const ovoid_joint_position *items = ovoid_trajectory_get_point(get(), i, &count);
        return {items, count};
    }
    /** The time of point i < size in seconds; NaN where there are no times. */
    double time(std::size_t i) const noexcept { return ovoid_trajectory_get_time(get(), i); }
    /** The line of point i < size in the file. */
    std::int64_t line(std::size_t i) const noexcept { return ovoid_trajectory_get_line(get(), i); }
};

/** The planning problems of a folder, owned. */
class problems : public detail::owner<detail::pointer<ovoid_problems>, ovoid_problems, ovoid_problems_destroy> {
  public:
    using owner::owner;
    /** Finds them. Throws as ovoid_problems_find fails. */
    static problems find(const std::string &folder) {
        ovoid_error e;
        return problems(detail::require(ovoid_problems_find(folder.c_str(), &e), e));
    }
    /** The number of problems. */
    std::size_t size() const noexcept { return ovoid_problems_get_count(get()); }
    /** Problem i < size. */
    ovoid_problem operator[](std::size_t i) const noexcept { return ovoid_problems_get(get(), i); }
};

} // namespace ovoid

#endif
