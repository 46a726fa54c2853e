// bench_planner: planners of OMPL on the planning problems of MotionBenchMaker, with ovoid's proofs and with states
// sampled by FCL as MoveIt drives it, by the same seeds. Every path is then proven or refuted by ovoid. Paths that a
// sampling peer calls free and that hit are counted in two groups: a state that the peer looked at hits, or only states
// between them do.
#include <ovoid/ompl.hpp>

extern "C" {
#include "common/build.h"
#include "robots/robots.h"
}

#include <ompl/geometric/PathSimplifier.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>

#include <chrono>
#include <cstring>
#include <string>

namespace ob = ompl::base;
namespace og = ompl::geometric;

namespace {

const char help[] =
    "bench_planner [OPTION...]: OMPL's planners with ovoid's proven motions beside FCL's samples, on "
    "MotionBenchMaker's problems\n"
    "\n"
    "  --smoke          one problem of each robot: does it run\n"
    "  --scenes N       most problems of a robot, spread over all (20)\n"
    "  --seeds N        seeds of each problem (1)\n"
    "  --seconds S      most time of a plan (10)\n"
    "  --planner NAME   RRTConnect, or BITstar, which ends with its first path (RRTConnect)\n"
    "  --robot TEXT     only robots whose name holds TEXT: panda, fetch\n"
    "  --peer FILE      a module with one more peer (bench/peers/robot_peer.h), at 0.5 %; may be repeated\n"
    "  --alone          without FCL\n"
    "  --data FOLDER    where robots/ is (OVOID_DATA, else ../shared/data)\n"
    "  --help           this\n";

struct settings {
    unsigned scenes = 20, seeds = 1;
    double seconds = 10;
    const char *only = "", *data = nullptr;
    bool is_bit_star = false, is_alone = false;
    robots_field modules = {};
};

double get_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The validator: ovoid, or a peer at states that are this share of the space's extent apart.
struct contestant {
    std::string name;
    const robot_peer *peer;
    double resolution;
};

/// The measurements of a contestant.
struct results {
    std::vector<double> planned, shortened;
    unsigned solved = 0, proven = 0, hit_at_samples = 0, hit_between = 0, open = 0;
    double deepest = 0;
};

/// One problem: its scene, its ends, the variables that move.
struct problem {
    robots_scene scene;
    ovoid::robot robot;
    ovoid::robot_cell cell;
    std::vector<double> start, goal;
    std::vector<std::uint32_t> moving;
};

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

/// Does a state hit that OMPL's discrete motion validator looks at along this path?
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

void judge(const problem &of, const ovoid::robot_space &space, const og::PathGeometric &path, results &into) {
    const std::size_t n = of.start.size();
    const std::vector<double> states = space.make_states(path, {of.start.data(), n});
    auto checker = ovoid::robot_checker::create(of.cell);
    ovoid::robot_path_options how;
    how.query = make_options();
    const auto found = checker.find_hit({states.data(), states.size()}, states.size() / n, how);
    into.proven += found.status == OVOID_ROBOT_FREE;
    into.open += found.status != OVOID_ROBOT_FREE && found.status != OVOID_ROBOT_HIT;
    if (found.status != OVOID_ROBOT_HIT) return;
    (is_sample_hit(checker, space, path) ? into.hit_at_samples : into.hit_between)++;
    into.deepest = std::max(into.deepest, find_depth(checker, states, n));
}

ob::PlannerPtr make_planner(const settings &how, const ob::SpaceInformationPtr &space) {
    if (how.is_bit_star) return std::make_shared<og::BITstar>(space);
    return std::make_shared<og::RRTConnect>(space);
}

/// Until the first path: BIT* would go on to shorten it until the time is up.
bool solve(og::SimpleSetup &setup, double seconds) {
    const auto &definition = setup.getProblemDefinition();
    (void)setup.solve(ob::plannerOrTerminationCondition(ob::timedPlannerTerminationCondition(seconds),
                                                        ob::exactSolnPlannerTerminationCondition(definition)));
    return definition->hasExactSolution();
}

void plan(const problem &of, const contestant &who, unsigned seed, const settings &how, results &into) {
    const ovoid::span<const double> start(of.start.data(), of.start.size()), goal(of.goal.data(), of.goal.size());
    ompl::RNG::setSeed(seed);
    const auto space = std::make_shared<ovoid::robot_space>(
        of.robot, start, ovoid::span<const std::uint32_t>(of.moving.data(), of.moving.size()), slack);
    og::SimpleSetup setup(space);
    const auto planner = setup.getSpaceInformation();
    void *self = who.peer ? who.peer->create(&of.scene.what) : nullptr;
    if (who.peer && !self) return; // it does not know the robot
    if (who.peer) {
        planner->setStateValidityChecker(std::make_shared<sampled_checker>(planner.get(), of, who.peer, self));
        planner->setStateValidityCheckingResolution(who.resolution);
        if (who.peer->is_edge_hit && who.peer->has_kinematics)
            planner->setMotionValidator(std::make_shared<edge_validator>(planner.get(), of, who.peer, self));
    } else {
        ovoid::set_cell(*planner, of.cell, make_options());
    }
    ob::ScopedState<ovoid::robot_space> from(space), to(space);
    space->read_state(start, from.get());
    space->read_state(goal, to.get());
    setup.setStartAndGoalStates(from, to);
    setup.setPlanner(make_planner(how, planner));
    setup.setup();
    const double begun = get_seconds();
    const bool is_solved = solve(setup, how.seconds);
    into.planned.push_back(get_seconds() - begun);
    if (is_solved) {
        const double found = get_seconds();
        og::PathSimplifier(planner, setup.getGoal()).simplifyMax(setup.getSolutionPath());
        into.shortened.push_back(get_seconds() - found);
        into.solved++;
        judge(of, *space, setup.getSolutionPath(), into);
    }
    if (who.peer) who.peer->destroy(self);
}

// ---- problems

void set_positions(const ovoid::robot &robot, const ovoid_joint_position *items, std::size_t count,
                   std::vector<double> &state) {
    for (std::size_t i = 0; i < count; i++) {
        const std::uint32_t joint = robot.find_joint(items[i].joint);
        if (joint != OVOID_ROBOT_NONE && robot.joint_variable(joint) != OVOID_ROBOT_NONE)
            state[robot.joint_variable(joint)] = items[i].position;
    }
}

/// 0: it cannot be read, or does not have exactly one goal, or an end hits.
bool open_problem(problem &of, machine *m, unsigned index) {
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

void close_problem(problem &of, machine *m) {
    (void)of.cell.release();
    (void)of.robot.release();
    robots_scene_destroy(&of.scene, m);
}

// ---- the table

double get_median(std::vector<double> of) {
    if (of.empty()) return NAN;
    std::sort(of.begin(), of.end());
    return of[of.size() / 2];
}

double get_sum(const std::vector<double> &of) {
    double sum = 0;
    for (const double x : of) sum += x;
    return sum;
}

/// 0: one of ovoid's own paths is not proven.
bool report(const char *robot, const std::vector<contestant> &who, const std::vector<results> &all) {
    std::printf("\n| %s | plans | solved | ms to plan, median | s to plan, all | ms to shorten, median | proven free | "
                "hits at a sample | hits between samples | open | deepest, mm |\n"
                "|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n",
                robot);
    for (std::size_t i = 0; i < who.size(); i++) {
        const results &r = all[i];
        if (r.planned.empty()) continue;
        std::printf("| %s | %zu | %u | %.2f | %.3f | %.2f | %u | %u | %u | %u | %.2f |\n", who[i].name.c_str(),
                    r.planned.size(), r.solved, 1e3 * get_median(r.planned), get_sum(r.planned),
                    1e3 * get_median(r.shortened), r.proven, r.hit_at_samples, r.hit_between, r.open, 1e3 * r.deepest);
    }
    return all[0].proven == all[0].solved;
}

bool run_robot(const machine_files &files, const std::vector<contestant> &who, const settings &how) {
    machine m;
    if (!machine_read(&m, how.data, &files)) return true;
    const unsigned scenes = machine_count_scenes(&m), count = std::min(scenes, how.scenes);
    unsigned left_out = 0;
    std::vector<results> all(who.size());
    for (unsigned i = 0; i < count; i++) {
        problem of;
        if (open_problem(of, &m, unsigned(std::uint64_t(i) * scenes / count))) {
            for (unsigned seed = 1; seed <= how.seeds; seed++)
                for (std::size_t k = 0; k < who.size(); k++) {
                    const std::size_t turn = (k + i) % who.size();
                    plan(of, who[turn], seed, how, all[turn]);
                }
        } else {
            left_out++;
        }
        close_problem(of, &m);
    }
    const bool is_good = report(m.name, who, all);
    std::printf("%u of %u problems, %u of them left out: an end hits, or there is no goal\n", count, scenes, left_out);
    machine_destroy(&m);
    return is_good;
}

bool read_options(int count, char **words, settings &how) {
    for (int i = 1; i < count; i++) {
        const char *value = i + 1 < count ? words[i + 1] : nullptr;
        if (std::strcmp(words[i], "--smoke") == 0) {
            how.scenes = 1;
            continue;
        }
        if (std::strcmp(words[i], "--alone") == 0) {
            how.is_alone = true;
            continue;
        }
        if (!value) return false;
        if (std::strcmp(words[i], "--scenes") == 0)
            how.scenes = unsigned(std::strtoul(value, nullptr, 10));
        else if (std::strcmp(words[i], "--seeds") == 0)
            how.seeds = unsigned(std::strtoul(value, nullptr, 10));
        else if (std::strcmp(words[i], "--seconds") == 0)
            how.seconds = std::strtod(value, nullptr);
        else if (std::strcmp(words[i], "--robot") == 0)
            how.only = value;
        else if (std::strcmp(words[i], "--data") == 0)
            how.data = value;
        else if (std::strcmp(words[i], "--peer") == 0 && robots_field_load(&how.modules, value))
            ;
        else if (std::strcmp(words[i], "--planner") == 0 && std::strcmp(value, "RRTConnect") == 0)
            how.is_bit_star = false;
        else if (std::strcmp(words[i], "--planner") == 0 && std::strcmp(value, "BITstar") == 0)
            how.is_bit_star = true;
        else
            return false;
        i++;
    }
    return how.scenes > 0 && how.seeds > 0 && how.seconds > 0;
}

} // namespace

int main(int count, char **words) {
    static const machine_files files[] = {
        {"panda", "panda_mbm/panda.urdf", "panda_mbm/panda.srdf", "panda/mbm_problems.tar.bz2"},
        {"fetch", "fetch_mbm/fetch.urdf", "fetch_mbm/fetch.srdf", "fetch_mbm/problems.tar.bz2"},
    };
    settings how;
    how.data = std::getenv("OVOID_DATA") ? std::getenv("OVOID_DATA") : "../shared/data";
    if (count == 2 && std::strcmp(words[1], "--help") == 0) return std::fputs(help, stdout), 0;
    if (!read_options(count, words, how)) return std::fputs(help, stderr), 2;
    ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
    (void)std::setvbuf(stdout, nullptr, _IOLBF, 0);
    // Hulls as ovoid has them; FCL's second contestant.
    const robot_peer *convex = bench_get_robot_peers()[1];
    std::vector<contestant> who = {{"ovoid, proven", nullptr, 0}};
    if (!how.is_alone)
        for (const auto &[name, part] : {std::pair{"FCL convex, 1 %", 0.01}, {"FCL convex, 0.5 %", 0.005}})
            who.push_back({name, convex, part});
    for (std::uint32_t i = 0; i < how.modules.count; i++)
        who.push_back({how.modules.peers[i]->name, how.modules.peers[i], 0.005});
    std::printf("%s, OMPL; %s\n", how.is_bit_star ? "BITstar" : "RRTConnect", get_build());
    bool is_good = true;
    for (const auto &robot : files)
        if (std::strstr(robot.name, how.only)) is_good = run_robot(robot, who, how) && is_good;
    return is_good ? 0 : 1;
}
