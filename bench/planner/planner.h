// bench_planner: planners of OMPL on the planning problems of MotionBenchMaker, with ovoid's proofs and with states
// sampled by peers, by the same seeds. Every path is then proven or refuted by ovoid. Paths that a sampling peer calls
// free and that hit are counted in two groups: a state hits at which OMPL would sample the final path, or only states
// between these do. Times are processor time of the thread, so that other work on the machine disturbs them less.
#ifndef OVOID_BENCH_PLANNER_PLANNER_H
#define OVOID_BENCH_PLANNER_PLANNER_H

#include <ovoid/ompl.hpp>

extern "C" {
#include "robots/robots.h"
}

#include <string>
#include <vector>

namespace planner {

struct settings {
    unsigned scenes = 20, seeds = 1;
    double seconds = 10;
    const char *only = "", *data = nullptr, *csv = nullptr, *svg = nullptr, *edges = nullptr;
    bool is_bit_star = false, is_alone = false;
    robots_field modules = {};
};

/// The validator: ovoid, or a peer at states that are this share of the space's extent apart.
struct contestant {
    std::string name;
    const robot_peer *peer;
    double resolution;
};

/// The verdict on a path. refused: the contestant calls the start or the goal, which are proven free, a hit.
enum class path_end { refused, unsolved, proven, hit_at_sample, hit_between, open };

/// One plan of one contestant. Times in seconds; depth in metres: the deepest proven overlap of the path.
struct outcome {
    unsigned problem, seed;
    path_end end = path_end::unsolved;
    double planned = 0, shortened = 0, depth = 0;
};

/// The plans of a contestant with one robot.
using outcomes = std::vector<outcome>;

/// One problem: its scene, its ends, the variables that move.
struct problem {
    unsigned index = 0;
    robots_scene scene;
    ovoid::robot robot;
    ovoid::robot_cell cell;
    std::vector<double> start, goal;
    std::vector<std::uint32_t> moving;
};

/// 0: it cannot be read, or does not have a goal by joints, or an end hits. Closed in either case.
bool problem_open(problem &of, machine *m, unsigned index);
void problem_close(problem &of, machine *m);

/// Plans, shortens and judges; false: the contestant does not know the robot. edges, unless nullptr, receives both
/// states of every motion that ovoid accepted, one after another.
bool plan(const problem &of, const contestant &who, const settings &how, outcome &into,
          std::vector<double> *edges = nullptr);

/// The results of a robot.
struct sheet {
    std::string robot;
    std::vector<outcomes> all; ///< of each contestant
};

/// Prints the table of a robot; false: a path of ovoid's, the first contestant, is not proven.
bool report(const sheet &of, const std::vector<contestant> &who);
/// One line for each plan. false: not written.
bool write_csv(const char *file, const std::vector<sheet> &robots, const std::vector<contestant> &who);
/// The share of problems with a path that is proven free, by the time to plan and shorten it, a chart for each robot.
bool write_svg(const char *file, const std::vector<sheet> &robots, const std::vector<contestant> &who,
               const char *planner);

} // namespace planner

#endif
