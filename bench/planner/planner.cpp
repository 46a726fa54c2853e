// The program: options, the robots and their problems, contestants in turn.
#include "planner/planner.h"

extern "C" {
#include "common/build.h"
}

#include <ompl/util/Console.h>

#include <cstdio>
#include <cstring>
#include <string>

namespace {

using namespace planner;

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
    "  --csv FILE       a line for each plan\n"
    "  --svg FILE       a picture: problems with a proven path, by time\n"
    "  --edges FOLDER   the motions that ovoid accepted while it planned, one CSV file of states for each problem:\n"
    "                   each two states are a motion (scripts/path_proofs.sh --planned)\n"
    "  --data FOLDER    where robots/ is (OVOID_DATA, else ../shared/data)\n"
    "  --help           this\n";

// ---- motions for other programs

/// FAMILY-SCENE of a scene's file .../FAMILY/SCENE.yaml.
std::string get_scene_name(const std::string &file) {
    const std::size_t name = file.rfind('/'), family = file.rfind('/', name - 1);
    return file.substr(family + 1, name - family - 1) + "-" + file.substr(name + 1, file.rfind('.') - name - 1);
}

bool write_edges(const problem &of, machine *m, const settings &how, const std::vector<double> &edges) {
    const std::string file = std::string(how.edges) + "/" + m->name + "-" +
                             get_scene_name(ovoid_problems_get(m->problems, of.index).scene) + ".csv";
    std::FILE *out = std::fopen(file.c_str(), "w");
    if (!out) return std::fprintf(stderr, "bench_planner: %s cannot be written\n", file.c_str()), false;
    const std::size_t n = of.start.size();
    for (std::size_t i = 0; i < n; i++)
        std::fprintf(out, "%s%c", of.robot.description().joints[of.robot.variable(i).joint].name,
                     i + 1 < n ? ',' : '\n');
    for (std::size_t i = 0; i < edges.size(); i++) std::fprintf(out, "%.17g%c", edges[i], i % n + 1 < n ? ',' : '\n');
    return std::fclose(out) == 0;
}

// ---- robots

/// One problem by all contestants, who begins in turn.
bool run_problem(const problem &of, machine *m, const std::vector<contestant> &who, const settings &how, sheet &into) {
    std::vector<double> edges;
    for (unsigned seed = 1; seed <= how.seeds; seed++)
        for (std::size_t k = 0; k < who.size(); k++) {
            const std::size_t turn = (k + of.index) % who.size();
            outcome one;
            one.problem = of.index;
            one.seed = seed;
            if (plan(of, who[turn], how, one, how.edges && !who[turn].peer ? &edges : nullptr))
                into.all[turn].push_back(one);
        }
    return !how.edges || edges.empty() || write_edges(of, m, how, edges);
}

bool run_robot(const machine_files &files, const std::vector<contestant> &who, const settings &how,
               std::vector<sheet> &into) {
    machine m;
    if (!machine_read(&m, how.data, &files)) return true;
    const unsigned scenes = machine_count_scenes(&m), count = std::min(scenes, how.scenes);
    unsigned left_out = 0;
    bool is_good = true;
    into.push_back({m.name, std::vector<outcomes>(who.size())});
    for (unsigned i = 0; i < count; i++) {
        problem of;
        if (problem_open(of, &m, unsigned(std::uint64_t(i) * scenes / count)))
            is_good = run_problem(of, &m, who, how, into.back()) && is_good;
        else
            left_out++;
        problem_close(of, &m);
    }
    is_good = report(into.back(), who) && is_good;
    std::printf("%u of %u problems, %u of them left out: an end hits, or there is no goal\n", count, scenes, left_out);
    machine_destroy(&m);
    return is_good;
}

// ---- options

bool set_planner(settings &how, const char *name) {
    how.is_bit_star = std::strcmp(name, "BITstar") == 0;
    return how.is_bit_star || std::strcmp(name, "RRTConnect") == 0;
}

/// An option with a value.
bool set_option(settings &how, const char *name, const char *value) {
    const struct {
        const char *name, **text;
    } texts[] = {{"--robot", &how.only},
                 {"--data", &how.data},
                 {"--csv", &how.csv},
                 {"--svg", &how.svg},
                 {"--edges", &how.edges}};
    for (const auto &one : texts)
        if (std::strcmp(name, one.name) == 0) return *one.text = value, true;
    if (std::strcmp(name, "--scenes") == 0) return (how.scenes = unsigned(std::strtoul(value, nullptr, 10))) > 0;
    if (std::strcmp(name, "--seeds") == 0) return (how.seeds = unsigned(std::strtoul(value, nullptr, 10))) > 0;
    if (std::strcmp(name, "--seconds") == 0) return (how.seconds = std::strtod(value, nullptr)) > 0;
    if (std::strcmp(name, "--peer") == 0) return robots_field_load(&how.modules, value) != 0;
    return std::strcmp(name, "--planner") == 0 && set_planner(how, value);
}

bool read_options(int count, char **words, settings &how) {
    for (int i = 1; i < count; i++) {
        if (std::strcmp(words[i], "--smoke") == 0)
            how.scenes = 1;
        else if (std::strcmp(words[i], "--alone") == 0)
            how.is_alone = true;
        else if (i + 1 == count || !set_option(how, words[i], words[i + 1]))
            return false;
        else
            i++;
    }
    return true;
}

std::vector<contestant> make_contestants(const settings &how) {
    // Hulls as ovoid has them; FCL's second contestant.
    const robot_peer *convex = bench_get_robot_peers()[1];
    std::vector<contestant> who = {{"ovoid, proven", nullptr, 0}};
    if (!how.is_alone)
        for (const auto &[name, part] : {std::pair{"FCL convex, 1 %", 0.01}, {"FCL convex, 0.5 %", 0.005}})
            who.push_back({name, convex, part});
    for (std::uint32_t i = 0; i < how.modules.count; i++)
        who.push_back({how.modules.peers[i]->name, how.modules.peers[i], 0.005});
    return who;
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
    const std::vector<contestant> who = make_contestants(how);
    const char *name = how.is_bit_star ? "BITstar" : "RRTConnect";
    std::printf("%s, OMPL; %s\n", name, get_build());
    std::vector<sheet> robots;
    bool is_good = true;
    for (const auto &robot : files)
        if (std::strstr(robot.name, how.only)) is_good = run_robot(robot, who, how, robots) && is_good;
    if (how.csv && !write_csv(how.csv, robots, who)) is_good = false;
    if (how.svg && !robots.empty() && !write_svg(how.svg, robots, who, name)) is_good = false;
    return is_good ? 0 : 1;
}
