// <ovoid/ompl.hpp>: the space against angles in closed form; states and motions against the checker asked directly, and
// against states sampled a hundred times as densely; planned paths against proofs that are verified without a search. A
// sheet of a millimetre, which OMPL's own samples jump over, is met.
#include "check.h"

#include <ovoid/ompl.hpp>

#include <ompl/base/DiscreteMotionValidator.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/pRRT.h>
#include <ompl/util/Console.h>

#include <thread>

namespace ob = ompl::base;
namespace og = ompl::geometric;

static const double pi = 3.14159265358979323846;

/// An arm of two beams that turns in the plane: the first joint without limits, the second one within 2.6.
struct arm {
    ovoid::shape beam = ovoid::shape::box({0.2, 0.03, 0.03}), sheet = ovoid::shape::box({0.2, 0.0005, 0.3});
    ovoid::robot robot;
    ovoid::robot_cell cell;

    explicit arm(double follower = 0) {
        const ovoid_robot_link links[] = {{"base"}, {"upper"}, {"fore"}, {"flag"}};
        ovoid_robot_joint joints[3] = {};
        const auto at = [](double x) { return ovoid::pose({x, 0, 0}); };
        joints[0] = {"shoulder", OVOID_JOINT_CONTINUOUS, 0, 1, at(0), {0, 0, 1}, 0, 0, 1, OVOID_ROBOT_NONE, 0, 0};
        joints[1] = {"elbow", OVOID_JOINT_REVOLUTE, 1, 2, at(0.5), {0, 0, 1}, -2.6, 2.6, 1, OVOID_ROBOT_NONE, 0, 0};
        joints[2] = {"flag", OVOID_JOINT_CONTINUOUS, 0, 3, at(9), {0, 0, 1}, 0, 0, 1, 0, follower, 0};
        ovoid_robot_element elements[2] = {};
        for (int i = 0; i < 2; i++) elements[i] = {std::uint32_t(1 + i), nullptr, beam.get(), at(0.25), nullptr};
        ovoid_robot_description d = {};
        d.links = links, d.joints = joints, d.elements = elements;
        d.link_count = follower != 0 ? 4 : 3, d.joint_count = follower != 0 ? 3 : 2, d.element_count = 2;
        robot = ovoid::robot::create(d);
        cell = ovoid::robot_cell::create(robot);
        cell.set_allowed(1, 2, true);
        cell.add({sheet, ovoid::pose({0, 0.6, 0})});
    }
};

static og::SimpleSetup make_setup(const arm &of, double margin = 0) {
    static const std::vector<double> rest(2);
    og::SimpleSetup setup(std::make_shared<ovoid::robot_space>(of.robot, ovoid::span<const double>(rest.data(), 2)));
    ovoid::robot_query_options how;
    how.margin = margin;
    ovoid::set_cell(*setup.getSpaceInformation(), of.cell, how);
    setup.getSpaceInformation()->setup();
    return setup;
}

/// A state by its two angles.
struct angles : ob::ScopedState<ovoid::robot_space> {
    angles(const ob::StateSpacePtr &space, double a, double b) : ScopedState(space) {
        get()->values[0] = a;
        get()->values[1] = b;
    }
};

static void test_space() {
    const arm one;
    auto setup = make_setup(one);
    const auto &space = setup.getStateSpace();
    const angles a(space, 3, 1), b(space, -3, -1);
    CHECK_NEAR(space->distance(a.get(), b.get()), std::hypot(2 * pi - 6, 2), 1e-12);
    angles middle(space, 0, 0);
    space->interpolate(a.get(), b.get(), 0.5, middle.get());
    CHECK_NEAR(std::fabs(middle[0]), pi, 1e-12);
    CHECK_NEAR(middle[1], 0, 1e-12);
    space->interpolate(a.get(), b.get(), 0.9, middle.get());
    CHECK_NEAR(middle[0], -3 - 0.1 * (2 * pi - 6), 1e-12);
    CHECK(space->equalStates(angles(space, pi, 1).get(), angles(space, -pi, 1).get()));
    CHECK(!space->equalStates(angles(space, pi, 1).get(), angles(space, -pi, 1.5).get()));
    angles far(space, 7, 9);
    space->enforceBounds(far.get());
    CHECK_NEAR(far[0], 7 - 2 * pi, 1e-12);
    CHECK_EQ(far[1], 2.6);
    CHECK(space->satisfiesBounds(far.get()) && !space->satisfiesBounds(angles(space, 0, 2.7).get()));
    // As the checker takes them: the second is reached the shorter way round.
    double q[4];
    space->as<ovoid::robot_space>()->write_motion(a.get(), b.get(), q);
    CHECK_NEAR(q[2], 2 * pi - 3, 1e-12);
    CHECK(q[0] == 3 && q[1] == 1 && q[3] == -1);
    const double turned[2] = {3 + 4 * pi, 1};
    og::PathGeometric path(setup.getSpaceInformation());
    for (const auto *state : {a.get(), b.get(), a.get()}) path.append(state);
    const auto states = space->as<ovoid::robot_space>()->make_states(path, {turned, 2});
    CHECK_NEAR(states[0], 3 + 4 * pi, 0);
    CHECK_NEAR(states[2], 6 * pi - 3, 1e-12);
    CHECK_NEAR(states[4], 3 + 4 * pi, 1e-12);
    space->sanityChecks(1e-9, 1e-9, ~0u);
}

static void test_samples() {
    const arm one;
    auto setup = make_setup(one);
    const auto &space = setup.getStateSpace();
    auto sampler = space->allocStateSampler();
    angles drawn(space, 0, 0);
    const angles edge(space, 3.1, 2.5);
    int beyond = 0, outside = 0, far = 0;
    for (int i = 0; i < 1000; i++) {
        if (i % 2)
            sampler->sampleUniformNear(drawn.get(), edge.get(), 0.2);
        else
            sampler->sampleGaussian(drawn.get(), edge.get(), 0.2);
        beyond += drawn[0] < 0;
        outside += !space->satisfiesBounds(drawn.get());
        far += space->distance(drawn.get(), edge.get()) > 1.5;
    }
    CHECK(beyond > 300 && beyond < 700);
    CHECK_EQ(outside, 0);
    CHECK_EQ(far, 0);
}

/// The code with which a space is refused, or OVOID_OK.
static ovoid_code refuse(const arm &of, std::size_t numbers, std::uint32_t variable) {
    const std::vector<double> rest(numbers);
    try {
        (void)ovoid::robot_space(of.robot, {rest.data(), numbers}, {&variable, 1});
    } catch (const ovoid::error &e) {
        return e.code();
    }
    return OVOID_OK;
}

static void test_parts() {
    const arm one, followed(0.5);
    CHECK_EQ(refuse(one, 2, 1), OVOID_OK);
    CHECK_EQ(refuse(one, 3, 1), OVOID_ERROR_ARGUMENT);
    CHECK_EQ(refuse(one, 2, 2), OVOID_ERROR_INDEX);
    const double rest[2] = {0.5, 0.25};
    const std::uint32_t elbow = 1;
    const ovoid::robot_space part(one.robot, {rest, 2}, {&elbow, 1}, 0.01);
    CHECK_EQ(part.getDimension(), 1u);
    CHECK(part.getBounds().high[0] == 2.61 && !part.is_turning(0) && part.getDimensionName(0) == "elbow");
    // A joint that another one follows by half its angle has no period of a turn.
    const ovoid::robot_space half(followed.robot, {rest, 2});
    CHECK(!half.is_turning(0) && ovoid::robot_space(one.robot, {rest, 2}).is_turning(0));
    int thrown = 0;
    og::SimpleSetup other(std::make_shared<ob::RealVectorStateSpace>(2));
    try {
        ovoid::set_cell(*other.getSpaceInformation(), one.cell);
    } catch (const ovoid::error &e) {
        thrown += e.code() == OVOID_ERROR_ARGUMENT;
    }
    CHECK_EQ(thrown, 1);
}

static void test_states() {
    const arm one;
    const double margin = 0.02;
    auto setup = make_setup(one, margin);
    auto checker = ovoid::robot_checker::create(one.cell);
    ovoid::robot_query_options how, all;
    how.margin = margin;
    all.margin = HUGE_VAL;
    auto sampler = setup.getStateSpace()->allocStateSampler();
    angles drawn(setup.getStateSpace(), 0, 0);
    int frees = 0;
    for (int i = 0; i < 500; i++) {
        sampler->sampleUniform(drawn.get());
        const double q[2] = {drawn[0], drawn[1]};
        const bool is_free = checker.collide({q, 2}, how).status == OVOID_ROBOT_FREE;
        const double clearance = setup.getStateValidityChecker()->clearance(drawn.get());
        const auto nearest = checker.find_nearest({q, 2}, all);
        CHECK_EQ(setup.getStateValidityChecker()->isValid(drawn.get()), is_free);
        CHECK(clearance <= nearest.items[0].upper - margin && clearance >= nearest.items[0].lower - margin - 1e-9);
        CHECK_EQ(clearance > 0, is_free);
        frees += is_free;
    }
    CHECK(frees > 100 && frees < 490);
    CHECK(setup.getStateValidityChecker()->clearance(angles(setup.getStateSpace(), 0, 3).get()) == -HUGE_VAL);
    CHECK(!setup.getStateValidityChecker()->isValid(angles(setup.getStateSpace(), 0, 3).get()));
}

/// The last state of a motion, written over one of its ends; and samples up to it, all of which must be free.
static void check_last(const og::SimpleSetup &setup, const ob::State *from, const ob::State *to) {
    const auto &space = setup.getStateSpace();
    const auto &validity = *setup.getStateValidityChecker();
    ob::State *at = space->cloneState(to), *sample = space->allocState(), *expected = space->allocState();
    std::pair<ob::State *, double> last(at, -1);
    if (setup.getSpaceInformation()->getMotionValidator()->checkMotion(from, at, last)) {
        CHECK_EQ(last.second, -1.0);
    } else {
        space->interpolate(from, to, last.second, expected);
        CHECK(last.second >= 0 && last.second < 1 && space->equalStates(at, expected));
        CHECK(last.second == 0 || validity.isValid(at));
        for (int i = 0; i < 1000; i++) {
            space->interpolate(from, to, last.second * i / 1000, sample);
            CHECK(last.second == 0 || validity.isValid(sample));
        }
        // What ends it is right behind.
        space->interpolate(from, to, last.second + 1e-5, sample);
        CHECK(last.second == 0 || !validity.isValid(sample));
    }
    for (ob::State *state : {at, sample, expected}) space->freeState(state);
}

static void test_motions() {
    const arm one;
    auto setup = make_setup(one);
    const auto planner = setup.getSpaceInformation();
    const auto &space = setup.getStateSpace();
    auto sampler = space->allocStateSampler();
    ob::State *from = space->allocState(), *to = space->allocState(), *sample = space->allocState();
    int frees = 0;
    planner->getMotionValidator()->resetMotionCounter();
    for (int i = 0; i < 200; i++) {
        do sampler->sampleUniform(from);
        while (!planner->isValid(from));
        sampler->sampleUniformNear(to, from, 1.5);
        const bool is_free = planner->checkMotion(from, to);
        frees += is_free;
        CHECK_EQ(is_free, planner->checkMotion(to, from));
        bool is_sampled_free = true;
        for (int k = 0; k <= 10000 && is_sampled_free; k++) {
            space->interpolate(from, to, k / 1e4, sample);
            is_sampled_free = planner->isValid(sample);
        }
        CHECK_EQ(is_free, is_sampled_free);
        check_last(setup, from, to);
    }
    CHECK(frees > 40 && frees < 190);
    CHECK_EQ(planner->getMotionValidator()->getCheckedMotionCount(), 600u);
    CHECK_EQ(planner->getMotionValidator()->getValidMotionCount(), 3 * unsigned(frees));
    for (ob::State *state : {from, to, sample}) space->freeState(state);
}

/// A beam that sweeps across the sheet between two samples of OMPL's.
static void test_between_samples() {
    const arm one;
    auto setup = make_setup(one);
    const auto planner = setup.getSpaceInformation();
    const angles from(setup.getStateSpace(), 2.1, 0), to(setup.getStateSpace(), 1, 0);
    planner->setStateValidityCheckingResolution(0.9);
    setup.getStateSpace()->setup();
    CHECK(planner->isValid(from.get()) && planner->isValid(to.get()));
    const ob::DiscreteMotionValidator sampled(planner);
    CHECK(sampled.checkMotion(from.get(), to.get()));
    CHECK(!planner->checkMotion(from.get(), to.get()));
}

/// Plans from one side of the sheet to the other; the path is proven, and the proof verified.
static void check_plan(const arm &of, const ob::PlannerPtr &planner, og::SimpleSetup &setup) {
    const auto &space = *setup.getStateSpace()->as<ovoid::robot_space>();
    const double begin[2] = {2.3 + 2 * pi, 0.2}, end[2] = {0.8, -0.2};
    ob::ScopedState<ovoid::robot_space> start(setup.getStateSpace()), goal(setup.getStateSpace());
    space.read_state({begin, 2}, start.get());
    space.read_state({end, 2}, goal.get());
    setup.setStartAndGoalStates(start, goal);
    setup.setPlanner(planner);
    CHECK(setup.solve(20.0) == ob::PlannerStatus::EXACT_SOLUTION);
    setup.simplifySolution();
    const auto states = space.make_states(setup.getSolutionPath(), {begin, 2});
    auto checker = ovoid::robot_checker::create(of.cell);
    std::vector<ovoid_robot_step> steps(10000);
    ovoid::robot_path_options how;
    how.steps = steps.data();
    how.capacity = steps.size();
    const ovoid::span<const double> view(states.data(), states.size());
    const auto found = checker.find_hit(view, states.size() / 2, how);
    CHECK_EQ(found.status, OVOID_ROBOT_FREE);
    ovoid::verify_robot_path(of.cell, view, states.size() / 2, how, found, {steps.data(), found.step_count});
    CHECK(states[0] == begin[0] && states[1] == begin[1]);
    CHECK_NEAR(std::remainder(states[states.size() - 2] - end[0], 2 * pi), 0, 1e-12);
}

static void test_plans() {
    const arm one;
    auto setup = make_setup(one);
    check_plan(one, std::make_shared<og::RRTConnect>(setup.getSpaceInformation()), setup);
    auto parallel = make_setup(one);
    const auto threads = std::make_shared<og::pRRT>(parallel.getSpaceInformation());
    threads->setThreadCount(4);
    check_plan(one, threads, parallel);
}

/// Many threads ask one validator; each gets what one alone gets.
static void test_threads() {
    const arm one;
    auto setup = make_setup(one);
    const auto planner = setup.getSpaceInformation();
    const auto &space = setup.getStateSpace();
    auto sampler = space->allocStateSampler();
    std::vector<ob::State *> states(200);
    for (auto &state : states) sampler->sampleUniform(state = space->allocState());
    std::vector<char> alone;
    for (std::size_t i = 0; i + 1 < states.size(); i++) alone.push_back(planner->checkMotion(states[i], states[i + 1]));
    planner->getMotionValidator()->resetMotionCounter();
    std::vector<std::vector<char>> together(4);
    std::vector<std::thread> threads;
    for (auto &answers : together)
        threads.emplace_back([&] {
            for (std::size_t i = 0; i + 1 < states.size(); i++)
                answers.push_back(planner->checkMotion(states[i], states[i + 1]));
        });
    for (auto &thread : threads) thread.join();
    for (const auto &answers : together) CHECK(answers == alone);
    CHECK_EQ(planner->getMotionValidator()->getCheckedMotionCount(), 4 * unsigned(alone.size()));
    for (auto *state : states) space->freeState(state);
}

int main() {
    ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
    ompl::RNG::setSeed(7);
    test_space();
    test_samples();
    test_parts();
    test_states();
    test_motions();
    test_between_samples();
    test_plans();
    test_threads();
    return check_end();
}
