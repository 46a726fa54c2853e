/**
 * @file robot.hpp
 * Robots from C++: owners of robots, cells, checkers and collision matrices; audits and covers by spheres. Links
 * libovoid_robot. Descriptions, answers, pairs and spheres are the C structs of <ovoid/robot.h> and the other robot
 * headers. Errors of the C library throw ovoid::error.
 */
#ifndef OVOID_ROBOT_HPP
#define OVOID_ROBOT_HPP

#include "ovoid/ovoid.hpp"
#include "ovoid/robot.h"
#include "ovoid/robot_compare.h"
#include "ovoid/robot_matrix.h"
#include "ovoid/robot_path.h"
#include "ovoid/robot_spheres.h"

#include <vector>

namespace ovoid {

/** Options of a robot. */
using robot_options = zeroed<ovoid_robot_options>;
/** How a state is checked. */
using robot_query_options = zeroed<ovoid_robot_query_options>;
/** How a motion is checked. */
using robot_path_options = zeroed<ovoid_robot_path_options>;
/** The answer to a state. */
using robot_answer = ovoid_robot_answer;

/** Near pairs of a state, nearest first, with their gradients. */
struct robot_nears {
    /** The pairs. */
    std::vector<ovoid_robot_near> items;
    /** d(distance)/d(variables) of item i from i * variable count on. */
    std::vector<double> gradients;
};

/** A robot with an owner. Its shapes must outlive it, unless it owns them. */
class robot : public detail::owner<detail::pointer<ovoid_robot>, ovoid_robot, ovoid_robot_destroy> {
  public:
    using owner::owner;
    /** From a description. Throws as ovoid_robot_create fails. */
    static robot create(const ovoid_robot_description &d, const ovoid_robot_options &o = robot_options()) {
        ovoid_error e;
        return robot(detail::require(ovoid_robot_create(&d, &o, &e), e));
    }
    /** The description as compiled: a view. */
    ovoid_robot_description description() const noexcept { return ovoid_robot_get_description(get()); }
    /** Number of links. */
    std::size_t link_count() const noexcept { return description().link_count; }
    /** The link of that name, or OVOID_ROBOT_NONE. */
    std::uint32_t find_link(const char *name) const noexcept { return ovoid_robot_find_link(get(), name); }
    /** The joint of that name, or OVOID_ROBOT_NONE. */
    std::uint32_t find_joint(const char *name) const noexcept { return ovoid_robot_find_joint(get(), name); }
    /** The link that is not the child of a joint. */
    std::uint32_t root() const noexcept { return ovoid_robot_get_root(get()); }
    /** The joint above a link; OVOID_ROBOT_NONE for the root. */
    std::uint32_t parent_joint(std::uint32_t link) const noexcept { return ovoid_robot_get_parent_joint(get(), link); }
    /** The number of variables of a state. */
    std::size_t variable_count() const noexcept { return ovoid_robot_get_variable_count(get()); }
    /** Variable i of a state. */
    ovoid_robot_variable variable(std::size_t i) const noexcept { return ovoid_robot_get_variable(get(), i); }
    /** The first variable that moves a joint. */
    std::uint32_t joint_variable(std::uint32_t joint) const noexcept {
        return ovoid_robot_get_joint_variable(get(), joint);
    }
    /** True where only fixed joints are between two links. */
    bool is_rigid_pair(std::uint32_t a, std::uint32_t b) const noexcept {
        return ovoid_robot_is_rigid_pair(get(), a, b) != 0;
    }
    /**
     * The poses of all links; errors: receives the bounds of their errors, or nullptr. Throws as
     * ovoid_robot_compute_poses fails.
     */
    std::vector<ovoid_pose> compute_poses(span<const double> q,
                                          std::vector<ovoid_robot_pose_error> *errors = nullptr) const {
        std::vector<ovoid_pose> poses(link_count());
        if (q.size() != variable_count())
            detail::fail(OVOID_ERROR_ARGUMENT, "a state has as many numbers as variables");
        if (errors) errors->resize(link_count());
        ovoid_error e;
        detail::require(ovoid_robot_compute_poses(get(), q.data(), poses.data(), &e), e);
        if (errors) ovoid_robot_compute_pose_errors(get(), q.data(), poses.data(), errors->data());
        return poses;
    }
    /** The poses of many states, one after another. */
    std::vector<ovoid_pose> compute_poses_batch(span<const double> q) const {
        const std::size_t count = variable_count() ? q.size() / variable_count() : 0;
        std::vector<ovoid_pose> poses(count * link_count());
        ovoid_error e;
        const ovoid_robot_pose_batch batch = {q.data(), count, poses.data()};
        detail::require(ovoid_robot_compute_poses_batch(get(), &batch, &e), e);
        return poses;
    }
    /** Throws RANGE or NOT_FINITE if a variable is outside its limits by more than slack. */
    void validate_limits(span<const double> q, double slack = 0) const {
        ovoid_error e;
        detail::require(ovoid_robot_validate_limits(get(), q.data(), slack, &e), e);
    }
};

/** A robot among obstacles, with an owner. Borrows the robot and the bodies' shapes. */
class robot_cell : public detail::owner<detail::pointer<ovoid_robot_cell>, ovoid_robot_cell, ovoid_robot_cell_destroy> {
  public:
    using owner::owner;
    /** Without obstacles. Throws MEMORY, LIMIT. */
    static robot_cell create(const robot &r) {
        ovoid_error e;
        return robot_cell(detail::require(ovoid_robot_cell_create(r.get(), nullptr, &e), e));
    }
    /** Adds an obstacle. Throws as ovoid_robot_cell_add fails. */
    id add(const body &b) {
        ovoid_error e;
        const id made = ovoid_robot_cell_add(get(), &b, &e);
        if (made == 0) detail::fail(e);
        return made;
    }
    /** Attaches a body to a link. Throws as ovoid_robot_cell_attach fails. */
    id attach(std::uint32_t link, const body &b, span<const std::uint32_t> touching = {}) {
        ovoid_error e;
        const ovoid_robot_attachment held = {link, b, touching.data(), touching.size()};
        const id made = ovoid_robot_cell_attach(get(), &held, &e);
        if (made == 0) detail::fail(e);
        return made;
    }
    /** Removes an obstacle or an attached body. Throws INDEX. */
    void remove(id b) { call(ovoid_robot_cell_remove, b); }
    /** Moves an obstacle or an attached body. Throws INDEX and the errors of the pose. */
    void move(id b, const pose &to) { call(ovoid_robot_cell_move, b, &to); }
    /** Allows two links to touch, or queries them again. Throws INDEX, ARGUMENT, MEMORY. */
    void set_allowed(std::uint32_t a, std::uint32_t b, bool allowed) {
        call(allowed ? ovoid_robot_cell_add_allowed : ovoid_robot_cell_remove_allowed, a, b);
    }
    /** Allows a body and a link to touch, or queries them again. Throws INDEX, MEMORY. */
    void set_body_allowed(id b, std::uint32_t link, bool allowed) {
        call(allowed ? ovoid_robot_cell_add_body_allowed : ovoid_robot_cell_remove_body_allowed, b, link);
    }
    /** Enlarges a link against obstacles. Throws INDEX, RADIUS. */
    void set_padding(std::uint32_t link, double padding) { call(ovoid_robot_cell_set_padding, link, padding); }
    /** Whether a pair of links is not queried. */
    bool is_allowed(std::uint32_t a, std::uint32_t b) const noexcept {
        return ovoid_robot_cell_is_allowed(get(), a, b) != 0;
    }
    /** Whether a body and a link are not queried. */
    bool is_body_allowed(id b, std::uint32_t link) const noexcept {
        return ovoid_robot_cell_is_body_allowed(get(), b, link) != 0;
    }
    /** By how much a link is enlarged against obstacles. */
    double padding(std::uint32_t link) const noexcept { return ovoid_robot_cell_get_padding(get(), link); }

  private:
    template <class Function, class... Arguments> void call(Function function, Arguments... arguments) {
        ovoid_error e;
        detail::require(function(get(), arguments..., &e), e);
    }
};

/** What one thread needs to query states of a cell, with an owner. Borrows the cell. */
class robot_checker
    : public detail::owner<detail::pointer<ovoid_robot_checker>, ovoid_robot_checker, ovoid_robot_checker_destroy> {
  public:
    using owner::owner;
    /** Of a cell. Throws MEMORY. */
    static robot_checker create(const robot_cell &c) {
        ovoid_error e;
        return robot_checker(detail::require(ovoid_robot_checker_create(c.get(), nullptr, &e), e));
    }
    /** Forgets the last state. */
    void reset() noexcept { ovoid_robot_checker_reset(get()); }
    /** Is a state free? Throws ARGUMENT, MEMORY. */
    robot_answer collide(span<const double> q, const ovoid_robot_query_options &o = robot_query_options()) {
        robot_answer found;
        const ovoid_robot_query query = {q.data(), &o};
        call(ovoid_robot_collide, &query, &found);
        return found;
    }
    /** Many states, one after another; count: how many. Throws ARGUMENT, MEMORY. */
    std::vector<robot_answer> collide_batch(span<const double> q, std::size_t count,
                                            const ovoid_robot_query_options &o = robot_query_options()) {
        std::vector<robot_answer> answers(count);
        const ovoid_robot_batch batch = {q.data(), count, &o, answers.data()};
        ovoid_robot_checker *self = get();
        ovoid_error e;
        detail::require(ovoid_robot_collide_batch(&self, 1, &batch, &e), e);
        return answers;
    }
    /**
     * Is a path of `count` states free for all times in between? The options say whether steps are written. Throws
     * ARGUMENT, MEMORY.
     */
    ovoid_robot_path_answer find_hit(span<const double> states, std::size_t count,
                                     const ovoid_robot_path_options &o = robot_path_options()) {
        const ovoid_robot_path path = {states.data(), count};
        ovoid_robot_path_answer found;
        const ovoid_robot_path_query query = {&path, &o};
        call(ovoid_robot_path_find_hit, &query, &found);
        return found;
    }
    /**
     * Many edges, each from a state to the next, two states after another; count: of edges. Throws ARGUMENT (also: the
     * options have room for steps), MEMORY.
     */
    std::vector<ovoid_robot_path_answer> find_hit_batch(span<const double> states, std::size_t count,
                                                        const ovoid_robot_path_options &o = robot_path_options()) {
        std::vector<ovoid_robot_path_answer> answers(count);
        const ovoid_robot_edge_batch batch = {states.data(), count, &o, answers.data()};
        ovoid_robot_checker *self = get();
        ovoid_error e;
        detail::require(ovoid_robot_path_find_hit_batch(&self, 1, &batch, &e), e);
        return answers;
    }
    /** The smallest clearance of a path of `count` states, as a bracket. Throws ARGUMENT, MEMORY. */
    ovoid_robot_clearance compute_clearance(span<const double> states, std::size_t count,
                                            const ovoid_robot_path_options &o = robot_path_options()) {
        const ovoid_robot_path path = {states.data(), count};
        ovoid_robot_clearance found;
        const ovoid_robot_path_query query = {&path, &o};
        call(ovoid_robot_path_compute_clearance, &query, &found);
        return found;
    }
    /** All near pairs with gradients by `variables` numbers. Throws as ovoid_robot_find_near fails. */
    robot_nears find_near(span<const double> q, const ovoid_robot_query_options &o, int without_depths = 0) {
        const ovoid_robot_query query = {q.data(), &o};
        robot_nears found;
        ovoid_robot_nears nears = {nullptr, nullptr, 0, 0, without_depths};
        call(ovoid_robot_find_near, &query, &nears);
        while (nears.count > nears.capacity) {
            found.items.resize(nears.count);
            found.gradients.resize(nears.count * q.size());
            nears = {found.items.data(), found.gradients.data(), nears.count, 0, without_depths};
            call(ovoid_robot_find_near, &query, &nears);
        }
        return found;
    }
    /** The nearest pair, or none. Throws as ovoid_robot_find_nearest fails. */
    robot_nears find_nearest(span<const double> q, const ovoid_robot_query_options &o) {
        robot_nears found;
        found.items.resize(1);
        found.gradients.resize(q.size());
        ovoid_robot_nears nears = {found.items.data(), found.gradients.data(), 1, 0, 0};
        const ovoid_robot_query query = {q.data(), &o};
        call(ovoid_robot_find_nearest, &query, &nears);
        found.items.resize(nears.count);
        found.gradients.resize(nears.count * q.size());
        return found;
    }

  private:
    template <class Function, class... Arguments> void call(Function function, Arguments... arguments) {
        ovoid_error e;
        detail::require(function(get(), arguments..., &e), e);
    }
};

/** Throws PROOF, with a sentence, if the steps do not prove the answer. */
inline void verify_robot_path(const robot_cell &cell, span<const double> states, std::size_t count,
                              const ovoid_robot_path_options &o, const ovoid_robot_path_answer &found,
                              span<const ovoid_robot_step> steps) {
    const ovoid_robot_path path = {states.data(), count};
    ovoid_error e;
    const ovoid_robot_path_basis basis = {{&path, &o}, steps.data()};
    detail::require(ovoid_robot_path_verify(cell.get(), &found, &basis, &e), e);
}
/** The number of pairs of a cell. */
inline std::size_t pair_count(const robot_cell &cell) noexcept { return ovoid_robot_cell_get_pair_count(cell.get()); }
/** The two sides of a pair. Throws INDEX. */
inline std::pair<ovoid_robot_side, ovoid_robot_side> pair_sides(const robot_cell &cell, std::size_t pair) {
    std::pair<ovoid_robot_side, ovoid_robot_side> found;
    ovoid_error e;
    ovoid_robot_sides sides;
    detail::require(ovoid_robot_cell_get_pair(cell.get(), pair, &sides, &e), e);
    found = {sides.a, sides.b};
    return found;
}

// ---- the collision matrix

/** How a matrix is made. */
using robot_matrix_options = zeroed<ovoid_robot_matrix_options>;

/** Which pairs of a robot's links can touch, with an owner. The robot is read only while the matrix is created. */
class robot_matrix
    : public detail::owner<detail::pointer<ovoid_robot_matrix>, ovoid_robot_matrix, ovoid_robot_matrix_destroy> {
  public:
    using owner::owner;
    /** Of a robot. Throws MEMORY, LIMIT. */
    static robot_matrix create(const robot &r, const ovoid_robot_matrix_options &o = robot_matrix_options()) {
        ovoid_error e;
        return robot_matrix(detail::require(ovoid_robot_matrix_create(r.get(), &o, &e), e));
    }
    /** Number of pairs. */
    std::size_t size() const noexcept { return ovoid_robot_matrix_get_count(get()); }
    /** Pair i < size: its states are views. */
    ovoid_robot_matrix_pair operator[](std::size_t i) const noexcept { return ovoid_robot_matrix_get_pair(get(), i); }
    /** The pair of two links, or nullptr: one of them has no element, or both are the same link. */
    const ovoid_robot_matrix_pair *find(std::uint32_t a, std::uint32_t b) const noexcept {
        return ovoid_robot_matrix_find_pair(get(), a, b);
    }
};

/** Why a pair may be left out, in MoveIt's words, or nullptr. */
inline const char *reason(const ovoid_robot_matrix_pair &pair, bool with_sampled = false) noexcept {
    return ovoid_robot_matrix_pair_get_reason(&pair, with_sampled ? 1 : 0);
}
/** "never", "sometimes" and so on. */
inline const char *name(ovoid_robot_touch touch) noexcept { return ovoid_robot_touch_get_name(touch); }

// ---- spheres

/** Options of an audit. */
using robot_audit_options = zeroed<ovoid_robot_audit_options>;
/** Options of a cover. */
using robot_cover_options = zeroed<ovoid_robot_cover_options>;

/** What is proven about spheres and a link. Throws as ovoid_robot_compute_sphere_audit fails. */
inline ovoid_robot_sphere_audit compute_sphere_audit(const robot &r, std::uint32_t link,
                                                     span<const ovoid_robot_sphere> spheres,
                                                     const ovoid_robot_audit_options &o = robot_audit_options()) {
    ovoid_robot_sphere_audit found;
    ovoid_error e;
    const ovoid_robot_sphere_model model = {r.get(), link, spheres.data(), spheres.size()};
    detail::require(ovoid_robot_compute_sphere_audit(&model, &o, &found, &e), e);
    return found;
}
/** Spheres that are proven to cover a link: `most`, or with o.excess as few as are found; depth: receives the bracket
 * of their audit, or nullptr. Throws as ovoid_robot_compute_sphere_cover fails. */
inline std::vector<ovoid_robot_sphere> compute_sphere_cover(const robot &r, std::uint32_t link, std::size_t most,
                                                            const ovoid_robot_cover_options &o = robot_cover_options(),
                                                            ovoid_robot_bracket *depth = nullptr) {
    std::vector<ovoid_robot_sphere> found(most);
    ovoid_error e;
    ovoid_robot_sphere_cover covering = {link, found.data(), most, 0, {0, 0}};
    detail::require(ovoid_robot_compute_sphere_cover(r.get(), &o, &covering, &e), e);
    if (depth) *depth = covering.depth;
    found.resize(covering.count);
    return found;
}
/** The robot with spheres in the place of its elements. Throws as ovoid_robot_create_from_spheres fails. */
inline robot create_from_spheres(const robot &r, span<const ovoid_robot_link_sphere> spheres) {
    ovoid_error e;
    const ovoid_robot_link_spheres all = {spheres.data(), spheres.size()};
    return robot(detail::require(ovoid_robot_create_from_spheres(r.get(), &all, nullptr, &e), e));
}
/** Adds states, `count` of them, to a comparison of a robot with its model; agreements: receives one a state, or
 * nullptr. Throws ARGUMENT, MEMORY. */
inline void compare_states(robot_checker &of_robot, robot_checker &of_model, span<const double> q, std::size_t count,
                           ovoid_robot_comparison &sum, const ovoid_robot_query_options &o = robot_query_options(),
                           std::vector<ovoid_robot_agreement> *agreements = nullptr) {
    if (agreements) agreements->resize(count);
    const ovoid_robot_comparison_batch batch = {
        of_robot.get(), of_model.get(), q.data(), count, &o, agreements ? agreements->data() : nullptr};
    ovoid_error e;
    detail::require(ovoid_robot_compare_states(&batch, &sum, &e), e);
}
/** "missed", "invented" and so on. */
inline const char *name(ovoid_robot_agreement agreement) noexcept { return ovoid_robot_agreement_get_name(agreement); }

/** The name of a type of joint, as URDF has it. */
inline const char *name(ovoid_joint_type type) noexcept { return ovoid_joint_type_get_name(type); }
/** How many variables a joint of a type has. */
inline std::uint32_t variable_count(ovoid_joint_type type) noexcept {
    return ovoid_joint_type_get_variable_count(type);
}

} // namespace ovoid

#endif
