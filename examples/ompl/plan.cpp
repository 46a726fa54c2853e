// Plans a motion of a robot in OMPL, with motions that ovoid proves: reads URDF, SRDF, scene and a request of MoveIt,
// plans with RRTConnect, shortens, verifies the proof of the whole path and writes its states as CSV.
//     plan ROBOT.urdf ROBOT.srdf SCENE REQUEST.yaml PATH.csv
#include <ovoid/ompl.hpp>
#include <ovoid/robot_io.hpp>

#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>

#include <cstdio>

static ovoid::span<const double> view(const std::vector<double> &of) { return {of.data(), of.size()}; }

// Puts the joints' numbers of a request into a state.
static void set_positions(const ovoid::robot &robot, ovoid::span<const ovoid_joint_position> from,
                          std::vector<double> &state) {
    for (const auto &item : from) {
        const std::uint32_t joint = robot.find_joint(item.joint);
        if (joint != OVOID_ROBOT_NONE) state[robot.joint_variable(joint)] = item.position;
    }
}

// The path once more as a whole, with the steps of its proof, which are verified without a search. Throws where it
// fails.
static std::size_t prove(const ovoid::robot_cell &cell, const std::vector<double> &states, std::size_t count,
                         const ovoid_robot_query_options &how) {
    auto checker = ovoid::robot_checker::create(cell);
    ovoid::robot_path_options options;
    options.query = how;
    std::vector<ovoid_robot_step> steps(checker.find_hit(view(states), count, options).step_count);
    checker.reset();
    options.steps = steps.data();
    options.capacity = steps.size();
    const auto found = checker.find_hit(view(states), count, options);
    if (found.status != OVOID_ROBOT_FREE) throw std::runtime_error("the path is not proven free");
    ovoid::verify_robot_path(cell, view(states), count, options, found, {steps.data(), steps.size()});
    return steps.size();
}

static void write_csv(const char *path, const ovoid::robot &robot, const std::vector<double> &states) {
    const std::size_t n = robot.variable_count();
    std::FILE *file = std::fopen(path, "w");
    if (!file) throw std::runtime_error("the path cannot be written");
    for (std::size_t i = 0; i < n; i++)
        std::fprintf(file, "%s%c", robot.description().joints[robot.variable(i).joint].name, i + 1 < n ? ',' : '\n');
    for (std::size_t i = 0; i < states.size(); i++) std::fprintf(file, "%.17g%c", states[i], (i + 1) % n ? ',' : '\n');
    if (std::fclose(file) != 0) throw std::runtime_error("the path cannot be written");
}

static int plan(char **names) {
    ovoid::robot_read_options read;
    read.fixed_base = 1;
    const auto file = ovoid::robot_file::read(names[1], names[2], read);
    const auto robot = file.create_robot();
    const auto scene = ovoid::obstacles::read(names[3], read);
    auto cell = ovoid::robot_cell::create(robot);
    scene.add_to(cell);
    const auto request = ovoid::motion_request::read(names[4], read);
    if (request.goal_count() != 1) throw std::runtime_error("a request with one goal is wanted");
    std::vector<double> start(robot.variable_count());
    set_positions(robot, request.start(), start);
    std::vector<double> goal = start;
    set_positions(robot, request.goal(0), goal);

    // The two lines: the space and the cell.
    const auto space = std::make_shared<ovoid::robot_space>(robot, view(start));
    ompl::geometric::SimpleSetup setup(space);
    ovoid::robot_query_options how;
    how.margin = 0.005;
    ovoid::set_cell(*setup.getSpaceInformation(), cell, how);

    ompl::base::ScopedState<ovoid::robot_space> from(space), to(space);
    space->read_state(view(start), from.get());
    space->read_state(view(goal), to.get());
    setup.setStartAndGoalStates(from, to);
    setup.setPlanner(std::make_shared<ompl::geometric::RRTConnect>(setup.getSpaceInformation()));
    if (setup.solve(10.0) != ompl::base::PlannerStatus::EXACT_SOLUTION) return std::puts("no path was found"), 1;
    setup.simplifySolution();
    const std::size_t count = setup.getSolutionPath().getStateCount();
    const std::vector<double> states = space->make_states(setup.getSolutionPath(), view(start));
    const std::size_t steps = prove(cell, states, count, how);
    write_csv(names[5], robot, states);
    std::printf("%zu states; free at all times, %zu steps of the proof hold\n", count, steps);
    std::printf("its page: ovoid robot path %s --srdf %s --scene %s --margin %g --states %s --html path.html\n",
                names[1], names[2], names[3], how.margin, names[5]);
    return 0;
}

int main(int count, char **names) {
    if (count != 6) return std::fputs("usage: plan ROBOT.urdf ROBOT.srdf SCENE REQUEST.yaml PATH.csv\n", stderr), 2;
    ompl::RNG::setSeed(1);
    try {
        return plan(names);
    } catch (const std::exception &e) {
        std::fprintf(stderr, "plan: %s\n", e.what());
        return 3;
    }
}
