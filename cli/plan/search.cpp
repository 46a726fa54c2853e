// RRTConnect: J. J. Kuffner, S. M. LaValle, RRT-Connect: an efficient approach to single-query path planning, 2000.
// BiEST: D. Hsu, J.-C. Latombe, R. Motwani, Path planning in expansive configuration spaces, 1999. Both are OMPL's;
// each of their motions is proven by ovoid. BIT* is not among them: in OMPL 1.5 one seed gives several paths.
#include "plan/search.h"

#include <ovoid/ompl.hpp>

#include <ompl/base/goals/GoalStates.h>
#include <ompl/geometric/PathSimplifier.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/est/BiEST.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>

namespace ob = ompl::base;
namespace og = ompl::geometric;

namespace {

/// The owners of C++ around what the tool owns: they let go of it at the end.
struct borrowed {
    ovoid::robot robot;
    ovoid::robot_cell cell;
    explicit borrowed(const search_problem &p) : robot(p.robot), cell(p.cell) {}
    borrowed(const borrowed &) = delete;
    borrowed &operator=(const borrowed &) = delete;
    ~borrowed() {
        (void)cell.release();
        (void)robot.release();
    }
};

double get_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

ob::PlannerPtr make_planner(search_planner which, const ob::SpaceInformationPtr &space) {
    if (which == SEARCH_BI_EST) return std::make_shared<og::BiEST>(space);
    return std::make_shared<og::RRTConnect>(space);
}

void set_ends(og::SimpleSetup &setup, const ovoid::robot_space &space, const search_problem &p) {
    const std::size_t n = space.robot().variable_count();
    ob::ScopedState<ovoid::robot_space> state(setup.getStateSpace());
    space.read_state({p.start, n}, state.get());
    setup.setStartState(state);
    const auto goals = std::make_shared<ob::GoalStates>(setup.getSpaceInformation());
    for (std::size_t i = 0; i < p.goal_count; i++) {
        space.read_state({p.goals + i * n, n}, state.get());
        goals->addState(state.get());
    }
    setup.setGoal(goals);
}

/// True as soon as the watch ends the search.
ob::PlannerTerminationCondition make_end(const ovoid_watch &watch) {
    if (!watch.is_stopped) return ob::plannerNonTerminatingCondition();
    return ob::PlannerTerminationCondition([&watch] { return watch.is_stopped(watch.context) != 0; });
}

/// Ends with the first path, whatever else the planner would go on for.
bool solve(og::SimpleSetup &setup, double seconds, const ob::PlannerTerminationCondition &end) {
    const auto &definition = setup.getProblemDefinition();
    const auto until = ob::plannerOrTerminationCondition(ob::timedPlannerTerminationCondition(seconds),
                                                         ob::exactSolnPlannerTerminationCondition(definition));
    (void)setup.solve(ob::plannerOrTerminationCondition(until, end));
    return definition->hasExactSolution();
}

/// The states in memory that the caller frees.
void take_states(const std::vector<double> &states, std::size_t count, search_result &into) {
    into.q = static_cast<double *>(std::malloc(states.size() * sizeof(double)));
    if (!into.q) throw std::bad_alloc();
    std::copy(states.begin(), states.end(), into.q);
    into.count = count;
}

void search(const search_problem &p, search_result &found) {
    const borrowed from(p);
    const std::size_t n = from.robot.variable_count();
    const auto space = std::make_shared<ovoid::robot_space>(from.robot, ovoid::span<const double>(p.start, n),
                                                            ovoid::span<const std::uint32_t>(p.moving, p.moving_count),
                                                            p.query.limit_slack);
    og::SimpleSetup setup(space);
    ovoid::set_cell(*setup.getSpaceInformation(), from.cell, p.query);
    set_ends(setup, *space, p);
    setup.setPlanner(make_planner(p.planner, setup.getSpaceInformation()));
    const double begun = get_seconds();
    const auto end = make_end(p.watch);
    const bool is_found = solve(setup, p.seconds, end) && !end;
    found.planned = get_seconds() - begun;
    if (is_found) {
        og::PathGeometric &path = setup.getSolutionPath();
        found.raw_length = path.length();
        if (!p.is_raw) og::PathSimplifier(setup.getSpaceInformation(), setup.getGoal()).simplify(path, end);
        found.shortened = get_seconds() - begun - found.planned;
        found.length = path.length();
        take_states(space->make_states(path, {p.start, n}), path.getStateCount(), found);
    }
    found.motions = setup.getSpaceInformation()->getMotionValidator()->getCheckedMotionCount();
}

} // namespace

search_result search_path(const search_problem *problem) {
    search_result found = {};
    try {
        ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
        ompl::RNG::setSeed(problem->seed);
        search(*problem, found);
    } catch (const std::exception &e) {
        std::snprintf(found.why, sizeof found.why, "%s", e.what());
    }
    return found;
}
