/**
 * @file ompl.hpp
 * Proven planning in OMPL, the Open Motion Planning Library (1.5 and later): a state space of a robot's joints, a state
 * validity checker and a motion validator. A motion that the validator accepts is proven free at all times in between,
 * not only at samples of it. Links libovoid_robot and ompl. Two lines of a planning program change:
 *
 *     auto space = std::make_shared<ovoid::robot_space>(robot, start);
 *     ompl::geometric::SimpleSetup setup(space);
 *     ovoid::set_cell(*setup.getSpaceInformation(), cell);
 *
 * The robot and the cell are borrowed, and must not change while a planner runs. Every call takes a checker of its own
 * from a pool, so OMPL's parallel planners are safe. If ovoid refuses an argument, ovoid::error is thrown.
 */
#ifndef OVOID_OMPL_HPP
#define OVOID_OMPL_HPP

#include "ovoid/robot.hpp"

#include <ompl/base/MotionValidator.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateValidityChecker.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/PathGeometric.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace ovoid {

namespace detail {

inline constexpr double half_turn = 3.14159265358979323846;

/// The angle that differs by whole turns and is within half a turn of 0.
inline double wrap_angle(double angle) { return std::remainder(angle, 2 * half_turn); }

/// Draws states; angles that turn without end may be drawn beyond half a turn.
class robot_sampler : public ::ompl::base::RealVectorStateSampler {
  public:
    robot_sampler(const ::ompl::base::StateSpace *space, const std::vector<bool> &turning)
        : RealVectorStateSampler(space), turning_(&turning) {}
    void sampleUniformNear(::ompl::base::State *to, const ::ompl::base::State *near, double distance) override {
        const std::vector<double> middle = copy(near);
        RealVectorStateSampler::sampleUniformNear(to, near, distance);
        turn(to, middle, [&](double from) { return rng_.uniformReal(from - distance, from + distance); });
    }
    void sampleGaussian(::ompl::base::State *to, const ::ompl::base::State *mean, double deviation) override {
        const std::vector<double> middle = copy(mean);
        RealVectorStateSampler::sampleGaussian(to, mean, deviation);
        turn(to, middle, [&](double from) { return rng_.gaussian(from, deviation); });
    }

  private:
    using state = ::ompl::base::RealVectorStateSpace::StateType;
    std::vector<double> copy(const ::ompl::base::State *from) const {
        const double *values = from->as<state>()->values;
        return {values, values + turning_->size()};
    }
    template <class Draw> void turn(::ompl::base::State *to, const std::vector<double> &middle, Draw draw) {
        for (std::size_t i = 0; i < middle.size(); i++)
            if ((*turning_)[i]) to->as<state>()->values[i] = wrap_angle(draw(middle[i]));
    }
    const std::vector<bool> *turning_;
};

} // namespace detail

/**
 * The states of a robot that a planner moves through: some of its variables, within their limits; all others stay
 * fixed. The distance is the Euclidean norm of the differences, radians and metres alike. An angle without limits turns
 * the shorter way round, and -pi and pi are one. An exception is an angle that other joints mimic: a whole turn of it
 * is not a whole turn of theirs, so it goes from -pi to pi.
 */
class robot_space : public ::ompl::base::RealVectorStateSpace {
  public:
    /** A state of this space: one number for each variable that moves. */
    using state = ::ompl::base::RealVectorStateSpace::StateType;

    /**
     * fixed: a whole state, with the values of the variables that stay fixed. moving: the variables that the planner
     * moves, each once; empty: all variables whose limits leave room. slack: how far variables may be outside their
     * limits. Throws ARGUMENT (fixed does not have one number for each variable of the robot; a floating joint is to
     * move), INDEX, RANGE (a length without limits is to move).
     */
    robot_space(const ovoid::robot &r, span<const double> fixed, span<const std::uint32_t> moving = {},
                double slack = 0)
        : RealVectorStateSpace(0), robot_(&r), fixed_(fixed.begin(), fixed.end()),
          moving_(moving.begin(), moving.end()) {
        setName("robot" + getName());
        if (fixed.size() != r.variable_count())
            detail::fail(OVOID_ERROR_ARGUMENT, "a state has as many numbers as variables");
        for (std::uint32_t i = 0; moving.empty() && i < fixed.size(); i++)
            if (r.variable(i).lower < r.variable(i).upper) moving_.push_back(i);
        bool has_turns = false;
        for (const std::uint32_t variable : moving_) has_turns = add_variable(variable, slack) || has_turns;
        // Planners that sample an ellipsoid of R^n must not take this space for R^n.
        if (has_turns) type_ = ::ompl::base::STATE_SPACE_UNKNOWN;
    }

    /** The robot. */
    const ovoid::robot &robot() const noexcept { return *robot_; }
    /** The variables that move, in the order of a state's numbers. */
    span<const std::uint32_t> moving() const noexcept { return {moving_.data(), moving_.size()}; }
    /** True if number i turns without end. */
    bool is_turning(std::size_t i) const noexcept { return turning_[i]; }

    /** Writes the whole state of the robot to q: one number for each variable. */
    void write_state(const ::ompl::base::State *from, double *q) const {
        std::copy(fixed_.begin(), fixed_.end(), q);
        const double *values = from->as<state>()->values;
        for (std::size_t i = 0; i < moving_.size(); i++) q[moving_[i]] = values[i];
    }
    /** Reads a state of this space from a whole state of the robot; angles without limits are brought to -pi to pi. */
    void read_state(span<const double> q, ::ompl::base::State *to) const {
        if (q.size() != fixed_.size()) detail::fail(OVOID_ERROR_ARGUMENT, "a state has as many numbers as variables");
        double *values = to->as<state>()->values;
        for (std::size_t i = 0; i < moving_.size(); i++) values[i] = turning_[i] ? wrap(q[moving_[i]]) : q[moving_[i]];
    }
    /**
     * Writes the two whole states of a motion, one after the other. From the first to the second each variable goes in
     * a straight line as this space moves it, so angles of the second may be beyond pi. q: twice as many numbers as the
     * robot has variables.
     */
    void write_motion(const ::ompl::base::State *from, const ::ompl::base::State *to, double *q) const {
        write_state(from, q);
        write_state(to, q + fixed_.size());
        unwind(q, q + fixed_.size());
    }
    /**
     * The whole states of a path, one after another, for robot_checker::find_hit. Between two states each variable goes
     * in a straight line as this space moves it. begin: the first state as it was given, or empty; angles continue from
     * there.
     */
    std::vector<double> make_states(const ::ompl::geometric::PathGeometric &path, span<const double> begin = {}) const {
        const std::size_t n = fixed_.size();
        std::vector<double> q(path.getStateCount() * n);
        for (std::size_t i = 0; i < path.getStateCount(); i++) {
            write_state(path.getState(static_cast<unsigned>(i)), q.data() + i * n);
            if (i)
                unwind(q.data() + (i - 1) * n, q.data() + i * n);
            else if (begin.size() == n)
                std::copy(begin.begin(), begin.end(), q.begin());
        }
        return q;
    }

    /** Turns angles back to -pi to pi, and clamps the others to their limits. */
    void enforceBounds(::ompl::base::State *of) const override {
        double *values = of->as<state>()->values;
        for (std::size_t i = 0; i < moving_.size(); i++)
            if (turning_[i]) values[i] = wrap(values[i]);
        RealVectorStateSpace::enforceBounds(of);
    }
    /** The Euclidean norm of the differences; angles the shorter way round. */
    double distance(const ::ompl::base::State *a, const ::ompl::base::State *b) const override {
        double sum = 0;
        for (std::size_t i = 0; i < moving_.size(); i++) {
            const double d = difference(a, b, i);
            sum += d * d;
        }
        return std::sqrt(sum);
    }
    /** True if all numbers are equal; -pi and pi are equal. */
    bool equalStates(const ::ompl::base::State *a, const ::ompl::base::State *b) const override {
        for (std::size_t i = 0; i < moving_.size(); i++)
            if (!(std::fabs(difference(a, b, i)) <= 2 * std::numeric_limits<double>::epsilon())) return false;
        return true;
    }
    /** The state at t from 0 to 1 between two states; `at` may be one of them. */
    void interpolate(const ::ompl::base::State *from, const ::ompl::base::State *to, double t,
                     ::ompl::base::State *at) const override {
        const double *a = from->as<state>()->values, *b = to->as<state>()->values;
        double *values = at->as<state>()->values;
        for (std::size_t i = 0; i < moving_.size(); i++) {
            const double end = b[i], moved = a[i] + t * difference(from, to, i);
            values[i] = t == 1 ? end : turning_[i] ? wrap(moved) : moved;
        }
    }
    /**
     * Samples uniformly within the bounds; near a state, without regard to the bounds of angles that turn without end.
     */
    ::ompl::base::StateSamplerPtr allocDefaultStateSampler() const override {
        return std::make_shared<detail::robot_sampler>(this, turning_);
    }

  private:
    static constexpr double pi = detail::half_turn;
    static double wrap(double angle) { return detail::wrap_angle(angle); }

    /// The difference from a to b in number i.
    double difference(const ::ompl::base::State *a, const ::ompl::base::State *b, std::size_t i) const {
        const double d = b->as<state>()->values[i] - a->as<state>()->values[i];
        return turning_[i] ? wrap(d) : d;
    }
    /// Adds whole turns to the second of two whole states until each angle goes the shorter way round from the first.
    void unwind(const double *from, double *to) const {
        for (std::size_t i = 0; i < moving_.size(); i++)
            if (turning_[i]) to[moving_[i]] += 2 * pi * std::rint((from[moving_[i]] - to[moving_[i]]) / (2 * pi));
    }
    bool is_followed(std::uint32_t joint) const {
        const ovoid_robot_description d = robot_->description();
        for (std::size_t j = 0; j < d.joint_count; j++)
            if (d.joints[j].mimic == joint) return true;
        return false;
    }
    /// Adds a variable as the next number of a state; true if it turns without end.
    bool add_variable(std::uint32_t variable, double slack) {
        if (variable >= fixed_.size()) detail::fail(OVOID_ERROR_INDEX, "the robot has no such variable");
        const ovoid_robot_variable v = robot_->variable(variable);
        const ovoid_robot_joint joint = robot_->description().joints[v.joint];
        if (joint.type == OVOID_JOINT_FLOATING)
            detail::fail(OVOID_ERROR_ARGUMENT, "a floating joint cannot be planned: let its variables stand still");
        const bool is_angle =
            joint.type == OVOID_JOINT_CONTINUOUS || (joint.type == OVOID_JOINT_PLANAR && v.component == 2);
        const bool has_limits = std::isfinite(v.lower) && std::isfinite(v.upper);
        if (!is_angle && !has_limits)
            detail::fail(OVOID_ERROR_RANGE, "a variable without limits cannot be planned: let it stand still");
        turning_.push_back(is_angle && !has_limits && !is_followed(v.joint));
        const double lower = has_limits ? v.lower - slack : -pi, upper = has_limits ? v.upper + slack : pi;
        addDimension(joint.name, lower, upper);
        return turning_.back();
    }

    const ovoid::robot *robot_;
    std::vector<double> fixed_;
    std::vector<std::uint32_t> moving_;
    std::vector<bool> turning_;
};

namespace detail {

/// The robot_space of a planner; fails if the planner has another kind of space.
inline const robot_space &robot_space_of(const ::ompl::base::SpaceInformation &planner) {
    const auto *space = dynamic_cast<const robot_space *>(planner.getStateSpace().get());
    if (!space) fail(OVOID_ERROR_ARGUMENT, "the planner's state space is no ovoid::robot_space");
    return *space;
}

/// A checker with room for the two states of a motion.
struct robot_worker {
    robot_checker checker;
    std::vector<double> states;
};

/// The checkers of a cell: as many as the calls that ran at one time. Safe from several threads.
class robot_workers {
  public:
    robot_workers(const robot_space &space, const robot_cell &cell)
        : cell_(&cell), variables_(space.robot().variable_count()) {}
    /// Takes a checker that no other call uses.
    std::unique_ptr<robot_worker> take() {
        {
            const std::lock_guard<std::mutex> lock(mutex_);
            if (!idle_.empty()) {
                auto taken = std::move(idle_.back());
                idle_.pop_back();
                return taken;
            }
        }
        return std::unique_ptr<robot_worker>(
            new robot_worker{robot_checker::create(*cell_), std::vector<double>(2 * variables_)});
    }
    /// Gives a checker back, and counts one more in *counter under the same lock, unless it is nullptr.
    void give(std::unique_ptr<robot_worker> worker, unsigned *counter = nullptr) {
        const std::lock_guard<std::mutex> lock(mutex_);
        idle_.push_back(std::move(worker));
        if (counter) ++*counter;
    }

  private:
    const robot_cell *cell_;
    std::size_t variables_;
    std::mutex mutex_;
    std::vector<std::unique_ptr<robot_worker>> idle_;
};

} // namespace detail

/**
 * Is a state proven free? A state that cannot be decided counts as a hit, and so do all states of a cell in which no
 * pair is queried. Safe from several threads. Throws MEMORY, ARGUMENT (options).
 */
class robot_state_checker : public ::ompl::base::StateValidityChecker {
  public:
    /** For a planner whose space is a robot_space that lives as long as this; borrows the cell. */
    robot_state_checker(::ompl::base::SpaceInformation *planner, const robot_cell &cell,
                        const ovoid_robot_query_options &how = robot_query_options())
        : StateValidityChecker(planner), space_(&detail::robot_space_of(*planner)), how_(how), workers_(*space_, cell) {
        specs_.clearanceComputationType = ::ompl::base::StateValidityCheckerSpecs::BOUNDED_APPROXIMATE;
    }
    /** True if all pairs are proven farther apart than the margin. */
    bool isValid(const ::ompl::base::State *state) const override {
        auto worker = workers_.take();
        space_->write_state(state, worker->states.data());
        const bool is_free = worker->checker.collide(view(*worker), how_).status == OVOID_ROBOT_FREE;
        workers_.give(std::move(worker));
        return is_free;
    }
    /**
     * A proven lower bound of the distance of the nearest pair, minus the margin; negative if that pair is nearer than
     * the margin. Infinity if no pair is queried; minus infinity for a state outside the limits.
     */
    double clearance(const ::ompl::base::State *state) const override {
        auto worker = workers_.take();
        space_->write_state(state, worker->states.data());
        ovoid_robot_query_options all = how_;
        all.margin = std::numeric_limits<double>::infinity();
        double lower = -all.margin;
        try {
            const robot_nears found = worker->checker.find_nearest(view(*worker), all);
            lower = found.items.empty() ? all.margin : found.items[0].lower - how_.margin;
        } catch (const error &e) {
            if (e.code() == OVOID_ERROR_MEMORY || e.code() == OVOID_ERROR_ARGUMENT) throw;
        }
        workers_.give(std::move(worker));
        return lower;
    }

  private:
    span<const double> view(const detail::robot_worker &worker) const {
        return {worker.states.data(), worker.states.size() / 2};
    }
    const robot_space *space_;
    ovoid_robot_query_options how_;
    mutable detail::robot_workers workers_;
};

/**
 * Is a motion proven free at all times? A motion that cannot be decided counts as a hit. Both ends are checked, also
 * the one that OMPL takes for valid. Safe from several threads; OMPL's counters of motions count all of them. Throws
 * MEMORY, ARGUMENT (options). Cost: docs/robot-path.md.
 */
class robot_motion_validator : public ::ompl::base::MotionValidator {
  public:
    /** For a planner whose space is a robot_space that lives as long as this; borrows the cell. */
    robot_motion_validator(::ompl::base::SpaceInformation *planner, const robot_cell &cell,
                           const ovoid_robot_query_options &how = robot_query_options())
        : MotionValidator(planner), space_(&detail::robot_space_of(*planner)), workers_(*space_, cell) {
        path_.query = how;
    }
    /** True if the motion is proven free. The first hit ends the search. */
    bool checkMotion(const ::ompl::base::State *from, const ::ompl::base::State *to) const override {
        auto worker = workers_.take();
        ovoid_robot_path_options any = path_;
        any.any_hit = 1;
        const bool is_free = find(*worker, from, to, any).status == OVOID_ROBOT_FREE;
        workers_.give(std::move(worker), is_free ? &valid_ : &invalid_);
        return is_free;
    }
    /**
     * As above. If the motion is not free, it is proven free up to the time `last.second`, which is free_until of
     * ovoid_robot_path_find_hit minus 2^-20, and `last.first`, unless it is nullptr, becomes the state at this time,
     * which is free. If there is no such time, they become the first state and 0.
     */
    bool checkMotion(const ::ompl::base::State *from, const ::ompl::base::State *to,
                     std::pair<::ompl::base::State *, double> &last) const override {
        auto worker = workers_.take();
        const ovoid_robot_path_answer found = find(*worker, from, to, path_);
        const bool is_free = found.status == OVOID_ROBOT_FREE;
        if (!is_free) set_last(*worker, from, to, found.free_until, last);
        workers_.give(std::move(worker), is_free ? &valid_ : &invalid_);
        return is_free;
    }

  private:
    ovoid_robot_path_answer find(detail::robot_worker &worker, const ::ompl::base::State *from,
                                 const ::ompl::base::State *to, const ovoid_robot_path_options &how) const {
        space_->write_motion(from, to, worker.states.data());
        return worker.checker.find_hit({worker.states.data(), worker.states.size()}, 2, how);
    }
    /// Goes back from free_until until the state is free in spite of its rounding. last.first may be one of the ends.
    void set_last(detail::robot_worker &worker, const ::ompl::base::State *from, const ::ompl::base::State *to,
                  double free_until, std::pair<::ompl::base::State *, double> &last) const {
        static constexpr double shortest = 1.0 / (1 << 20);
        ::ompl::base::State *at = space_->allocState();
        double t = free_until - shortest;
        for (; t > shortest; t /= 2) {
            space_->interpolate(from, to, t, at);
            space_->write_state(at, worker.states.data());
            const span<const double> q(worker.states.data(), worker.states.size() / 2);
            if (worker.checker.collide(q, path_.query).status == OVOID_ROBOT_FREE) break;
        }
        last.second = t > shortest ? t : 0;
        if (last.first) space_->copyState(last.first, last.second > 0 ? at : from);
        space_->freeState(at);
    }
    const robot_space *space_;
    ovoid_robot_path_options path_ = robot_path_options();
    mutable detail::robot_workers workers_;
};

/**
 * Makes a planner, whose state space is a robot_space, check states and motions in a cell, which is borrowed. how:
 * margin, slack of the limits, which pairs. Throws ARGUMENT.
 */
inline void set_cell(::ompl::base::SpaceInformation &planner, const robot_cell &cell,
                     const ovoid_robot_query_options &how = robot_query_options()) {
    planner.setStateValidityChecker(std::make_shared<robot_state_checker>(&planner, cell, how));
    planner.setMotionValidator(std::make_shared<robot_motion_validator>(&planner, cell, how));
}

} // namespace ovoid

#endif
