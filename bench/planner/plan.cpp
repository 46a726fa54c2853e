// One plan: the problem, the validators of the contestants, the judgement of the path.
#include "planner/planner.h"

#include <ompl/geometric/PathSimplifier.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>

#include <ctime>

namespace ob = ompl::base;
namespace og = ompl::geometric;

namespace planner {

namespace {

/// Processor time of this thread.
double get_seconds() {
    timespec now;
    (void)clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

/// States of a peer, placed by ovoid's kinematics.
class sampled_checker : public ob::StateValidityChecker {
  public:
    sampled_checker(ob::SpaceInformation *planner, const problem &of, const robot_peer *peer, void *self)
        : StateValidityChecker(planner), space_(&ovoid::detail::robot_space_of(*planner)), of_(&of), peer_(peer),
          self_(self), q_(of.start.size()), links_(of.robot.link_count()) {}
    bool isValid(const ob::State *state) const override {
        space_->write_state(state, q_.data());
        return space_->satisfiesBounds(state) &&
               (peer_->has_kinematics ||
                ovoid_robot_compute_poses(of_->robot.get(), q_.data(), links_.data(), nullptr) == OVOID_OK) &&
               !peer_->is_hit(self_, q_.data(), links_.data());
    }

  private:
    const ovoid::robot_space *space_;
    const problem *of_;
    const robot_peer *peer_;
    void *self_;
    mutable std::vector<double> q_;
    mutable std::vector<ovoid_pose> links_;
};

/// Motions of a peer that looks at a whole edge by its own way; its resolution is its own.
class edge_validator : public ob::MotionValidator {
  public:
    edge_validator(ob::SpaceInformation *planner, const problem &of, const robot_peer *peer, void *self)
        : MotionValidator(planner), space_(&ovoid::detail::robot_space_of(*planner)), peer_(peer), self_(self),
          q_(2 * of.start.size()) {}
    bool checkMotion(const ob::State *from, const ob::State *to) const override {
        space_->write_motion(from, to, q_.data());
        const unsigned states = space_->validSegmentCount(from, to) + 1;
        return !peer_->is_edge_hit(self_, q_.data(), q_.data() + q_.size() / 2, states);
    }
    bool checkMotion(const ob::State *from, const ob::State *to, std::pair<ob::State *, double> &last) const override {
        const bool is_free = checkMotion(from, to);
        if (!is_free) last.second = 0;
        if (!is_free && last.first) space_->copyState(last.first, from);
        return is_free;
    }

  private:
    const ovoid::robot_space *space_;
    const robot_peer *peer_;
    void *self_;
    mutable std::vector<double> q_;
};

/// ovoid's motions; keeps both states of every motion that it accepts.
class recording_validator : public ob::MotionValidator {
  public:
    recording_validator(const ob::SpaceInformationPtr &planner, std::vector<double> &into)
        : MotionValidator(planner), space_(&ovoid::detail::robot_space_of(*planner)),
          within_(planner->getMotionValidator()), into_(&into) {}
    bool checkMotion(const ob::State *from, const ob::State *to) const override {
        return keep(from, to, within_->checkMotion(from, to));
    }
    bool checkMotion(const ob::State *from, const ob::State *to, std::pair<ob::State *, double> &last) const override {
        return keep(from, to, within_->checkMotion(from, to, last));
    }

  private:
    bool keep(const ob::State *from, const ob::State *to, bool is_free) const {
        const std::size_t held = into_->size(), more = 2 * space_->robot().variable_count();
        if (!is_free) return false;
        into_->resize(held + more);
        space_->write_motion(from, to, into_->data() + held);
        return true;
    }
    const ovoid::robot_space *space_;
    ob::MotionValidatorPtr within_;
    std::vector<double> *into_;
};

/// Of the limits: URDFs and requests have few digits.
const double slack = 1e-6;

ovoid::robot_query_options make_options() {
    ovoid::robot_query_options how;
    how.limit_slack = slack;
    return how;
}

/// The depth that the path reaches, proven, at states a two hundredth of a segment apart.
double find_depth(ovoid::robot_checker &checker, const std::vector<double> &states, std::size_t n) {
    double deepest = 0;
    std::vector<double> q(n);
    for (std::size_t i = 0; i + 1 < states.size() / n; i++)
        for (int k = 0; k <= 200; k++) {
            for (std::size_t j = 0; j < n; j++)
                q[j] = states[i * n + j] + k / 200.0 * (states[(i + 1) * n + j] - states[i * n + j]);
            if (checker.collide({q.data(), n}, make_options()).status != OVOID_ROBOT_HIT) continue;
            const auto near = checker.find_nearest({q.data(), n}, make_options());
            if (!near.items.empty()) deepest = std::max(deepest, -near.items[0].upper);
        }
    return deepest;
}

/// Does a state hit that OMPL's discrete motion validator would look at along this path? It need not have: shortening
/// keeps parts of motions, whose samples are elsewhere, without another look.
bool is_sample_hit(ovoid::robot_checker &checker, const ovoid::robot_space &space, const og::PathGeometric &path) {
    std::vector<double> q(space.robot().variable_count());
    ob::ScopedState<ovoid::robot_space> at(path.getSpaceInformation());
    for (unsigned i = 0; i + 1 < path.getStateCount(); i++) {
        const unsigned parts = std::max(1u, space.validSegmentCount(path.getState(i), path.getState(i + 1)));
        for (unsigned k = 0; k <= parts; k++) {
            space.interpolate(path.getState(i), path.getState(i + 1), double(k) / parts, at.get());
            space.write_state(at.get(), q.data());
            if (checker.collide({q.data(), q.size()}, make_options()).status == OVOID_ROBOT_HIT) return true;
        }
    }
    return false;
}

void judge(const problem &of, const ovoid::robot_space &space, const og::PathGeometric &path, outcome &into) {
    const std::size_t n = of.start.size();
    const std::vector<double> states = space.make_states(path, {of.start.data(), n});
    auto checker = ovoid::robot_checker::create(of.cell);
    ovoid::robot_path_options how;
    how.query = make_options();
    const auto found = checker.find_hit({states.data(), states.size()}, states.size() / n, how);
    into.end = found.status == OVOID_ROBOT_FREE ? path_end::proven : path_end::open;
    if (found.status != OVOID_ROBOT_HIT) return;
    into.end = is_sample_hit(checker, space, path) ? path_end::hit_at_sample : path_end::hit_between;
    into.depth = find_depth(checker, states, n);
}

ob::PlannerPtr make_planner(const settings &how, const ob::SpaceInformationPtr &space) {
    if (how.is_bit_star) return std::make_shared<og::BITstar>(space);
    return std::make_shared<og::RRTConnect>(space);
}

/// Until the first path: BIT* would go on to shorten it until the time is up. The clock is read every 16th time, as
/// that is a call of the system.
bool solve(og::SimpleSetup &setup, double seconds) {
    const auto &definition = setup.getProblemDefinition();
    const double end = get_seconds() + seconds;
    unsigned asked = 0;
    const ob::PlannerTerminationCondition is_late([&] { return asked++ % 16 == 15 && get_seconds() > end; });
    (void)setup.solve(ob::plannerOrTerminationCondition(is_late, ob::exactSolnPlannerTerminationCondition(definition)));
    return definition->hasExactSolution();
}

/// What checks states and motions.
void set_validators(const ob::SpaceInformationPtr &planner, const problem &of, const contestant &who, void *self) {
    if (!who.peer) {
        ovoid::set_cell(*planner, of.cell, make_options());
        return;
    }
    planner->setStateValidityChecker(std::make_shared<sampled_checker>(planner.get(), of, who.peer, self));
    planner->setStateValidityCheckingResolution(who.resolution);
    if (who.peer->is_edge_hit && who.peer->has_kinematics)
        planner->setMotionValidator(std::make_shared<edge_validator>(planner.get(), of, who.peer, self));
}

void set_positions(const ovoid::robot &robot, const ovoid_joint_position *items, std::size_t count,
                   std::vector<double> &state) {
    for (std::size_t i = 0; i < count; i++) {
        const std::uint32_t joint = robot.find_joint(items[i].joint);
        if (joint != OVOID_ROBOT_NONE && robot.joint_variable(joint) != OVOID_ROBOT_NONE)
            state[robot.joint_variable(joint)] = items[i].position;
    }
}

} // namespace

bool plan(const problem &of, const contestant &who, const settings &how, outcome &into, std::vector<double> *edges) {
    const ovoid::span<const double> start(of.start.data(), of.start.size()), goal(of.goal.data(), of.goal.size());
    ompl::RNG::setSeed(into.seed);
    const auto space = std::make_shared<ovoid::robot_space>(
        of.robot, start, ovoid::span<const std::uint32_t>(of.moving.data(), of.moving.size()), slack);
    og::SimpleSetup setup(space);
    const auto planner = setup.getSpaceInformation();
    void *self = who.peer ? who.peer->create(&of.scene.what) : nullptr;
    if (who.peer && !self) return false;
    set_validators(planner, of, who, self);
    if (edges) planner->setMotionValidator(std::make_shared<recording_validator>(planner, *edges));
    ob::ScopedState<ovoid::robot_space> from(space), to(space);
    space->read_state(start, from.get());
    space->read_state(goal, to.get());
    setup.setStartAndGoalStates(from, to);
    setup.setPlanner(make_planner(how, planner));
    setup.setup();
    if (!planner->isValid(from.get()) || !planner->isValid(to.get())) {
        // OMPL would sleep until the goal changes.
        into.end = path_end::refused;
        if (who.peer) who.peer->destroy(self);
        return true;
    }
    const double begun = get_seconds();
    const bool is_solved = solve(setup, how.seconds);
    into.planned = get_seconds() - begun;
    if (is_solved) {
        const double found = get_seconds();
        og::PathSimplifier(planner, setup.getGoal()).simplifyMax(setup.getSolutionPath());
        into.shortened = get_seconds() - found;
        judge(of, *space, setup.getSolutionPath(), into);
    }
    if (who.peer) who.peer->destroy(self);
    return true;
}

bool problem_open(problem &of, machine *m, unsigned index) {
    of.index = index;
    if (!robots_scene_create(&of.scene, m, index)) return false;
    of.robot = ovoid::robot(m->robot);
    of.cell = ovoid::robot_cell(of.scene.cell);
    ovoid_error error;
    ovoid_motion_request *request =
        ovoid_motion_request_read(ovoid_problems_get(m->problems, index).request, nullptr, &error);
    if (!request || ovoid_motion_request_get_goal_count(request) < 1) {
        ovoid_motion_request_destroy(request);
        return false;
    }
    std::size_t count;
    of.start.assign(of.robot.variable_count(), 0);
    const ovoid_joint_position *items = ovoid_motion_request_get_start(request, &count);
    set_positions(of.robot, items, count, of.start);
    of.goal = of.start;
    items = ovoid_motion_request_get_goal(request, 0, &count);
    set_positions(of.robot, items, count, of.goal);
    for (std::size_t i = 0; i < count; i++)
        of.moving.push_back(of.robot.joint_variable(of.robot.find_joint(items[i].joint)));
    ovoid_motion_request_destroy(request);
    auto checker = ovoid::robot_checker::create(of.cell);
    for (const auto *end : {&of.start, &of.goal})
        if (checker.collide({end->data(), end->size()}, make_options()).status != OVOID_ROBOT_FREE) return false;
    return true;
}

void problem_close(problem &of, machine *m) {
    (void)of.cell.release();
    (void)of.robot.release();
    robots_scene_destroy(&of.scene, m);
}

} // namespace planner
