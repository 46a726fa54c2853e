// Robots from files through <ovoid/robot_io.hpp>: the arm of the tool's tests, whose numbers are in its files; a scene;
// a request and its folder, written here.
#include "check.h"

#include <ovoid/robot_io.hpp>

#include <cstdio>
#include <string>

static const std::string folder = OVOID_SOURCE_DIR "/tests/cli/data/arm/";

static void write_file(const char *path, const char *text) {
    std::FILE *file = std::fopen(path, "w");
    CHECK(file != nullptr);
    if (!file) return;
    std::fputs(text, file);
    std::fclose(file);
}

static void test_robot() {
    const auto file = ovoid::robot_file::read(folder + "arm.urdf", folder + "arm.srdf");
    CHECK(file.mesh_count() == 1 && file.mesh(0).part_count == 1 && file.fixed_mimic_count() == 0);
    CHECK(file.ignored_count() > 0 && file.ignored(0).count > 0);
    CHECK(file.group_count() == 2 && std::string(file.group(0).name) == "reach");
    CHECK(file.state_count() == 1 && std::string(file.state(0).name) == "up");
    CHECK(file.spheres().size() == 1 && file.spheres()[0].ball.radius == 0.6);
    CHECK(file.passive().size() == 1);
    const auto robot = file.create_robot();
    CHECK(robot.find_link("hand") == 2 && file.description().link_count == robot.link_count());
    auto cell = ovoid::robot_cell::create(robot);
    const auto scene = ovoid::obstacles::read(folder + "cell.yaml");
    const auto ids = scene.add_to(cell);
    CHECK(scene.size() > 0 && ids.size() == scene.size() && ids[0].id != 0 && scene[0].shape != nullptr);
    auto checker = ovoid::robot_checker::create(cell);
    const std::vector<double> up(robot.variable_count());
    CHECK_EQ(checker.collide({up.data(), up.size()}).status, OVOID_ROBOT_FREE);
    CHECK_EQ(ovoid::robot_file::read(folder + "arm.urdf").state_count(), 0u);
}

static void test_problem() {
    write_file("hpp_scene1.yaml", "world:\n  collision_objects: []\n");
    write_file("hpp_request1.yaml", "group_name: reach\nstart_state:\n  joint_state:\n    name: [shoulder]\n"
                                    "    position: [0.5]\ngoal_constraints:\n  - joint_constraints:\n"
                                    "      - joint_name: shoulder\n        position: 1.5\n");
    const auto request = ovoid::motion_request::read("hpp_request1.yaml");
    CHECK(std::string(request.group()) == "reach" && request.goal_count() == 1);
    CHECK(request.start().size() == 1 && request.start()[0].position == 0.5);
    CHECK(request.goal(0).size() == 1 && request.goal(0)[0].position == 1.5);
    CHECK_EQ(ovoid::obstacles::read("hpp_scene1.yaml").size(), 0u);
    std::remove("hpp_scene1.yaml");
    write_file("hpp_trajectory.json", "{\"joint_names\": [\"shoulder\"], \"points\": [{\"positions\": [0.5], "
                                      "\"time_from_start\": 0},\n{\"positions\": [1], \"time_from_start\": 2}]}");
    const std::string whole = "<robot name='r'><link name='a'/></robot>";
    CHECK(ovoid::robot_file::read_text({"memory.urdf", whole.data(), whole.size()}).description().link_count == 1);
    const auto moved = ovoid::trajectory::read("hpp_trajectory.json");
    CHECK(moved.size() == 2 && moved.start().size() == 0 && moved.point(1)[0].position == 1);
    CHECK(moved.time(1) == 2 && moved.line(1) == 2);
    std::remove("hpp_trajectory.json");
    std::remove("hpp_request1.yaml");
}

int main() {
    test_robot();
    test_problem();
    int thrown = 0;
    try {
        (void)ovoid::robot_file::read("absent.urdf");
    } catch (const ovoid::error &e) {
        thrown += e.code() == OVOID_ERROR_FILE;
    }
    try {
        (void)ovoid::problems::find("absent");
    } catch (const ovoid::error &e) {
        thrown += e.code() == OVOID_ERROR_FILE;
    }
    CHECK_EQ(thrown, 2);
    return check_end();
}
