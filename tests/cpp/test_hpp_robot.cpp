// Robots through <ovoid/robot.hpp>: a cart on a rail before a wall, whose distances are known in closed form; errors as
// exceptions; owners.
#include "check.h"

#include <ovoid/robot.hpp>

#include <array>
#include <cmath>
#include <string>

int main() {
    const ovoid::shape box = ovoid::shape::box({0.1, 0.1, 0.1});
    const std::array<ovoid_robot_link, 2> links = {{{"rail"}, {"cart"}}};
    ovoid_robot_joint slide = {};
    slide.name = "slide";
    slide.type = OVOID_JOINT_PRISMATIC;
    slide.child = 1;
    slide.origin = ovoid_pose_make_identity();
    slide.axis = {2, 0, 0};
    slide.upper = 10;
    slide.mimic = OVOID_ROBOT_NONE;
    const ovoid_robot_element element = {1, nullptr, box.get(), ovoid_pose_make_identity(), nullptr};
    ovoid_robot_description d = {};
    d.links = links.data(), d.link_count = links.size();
    d.joints = &slide, d.joint_count = 1;
    d.elements = &element, d.element_count = 1;

    const auto robot = ovoid::robot::create(d);
    CHECK(robot.link_count() == 2 && robot.variable_count() == 1 && robot.root() == 0);
    CHECK(robot.find_link("cart") == 1 && robot.find_joint("slide") == 0 && robot.parent_joint(1) == 0);
    CHECK(robot.variable(0).upper == 10 && robot.joint_variable(0) == 0 && !robot.is_rigid_pair(0, 1));
    CHECK(std::string(ovoid::name(OVOID_JOINT_PLANAR)) == "planar" && ovoid::variable_count(OVOID_JOINT_PLANAR) == 3);
    const std::array<double, 2> q = {{3, 4.7}};
    std::vector<ovoid_robot_pose_error> errors;
    CHECK(robot.compute_poses({q.data(), 1}, &errors)[1].position.x == 3);
    CHECK(errors.size() == 2 && errors[1].position > 0 && errors[1].position < 1e-13);
    CHECK(robot.compute_poses_batch({q.data(), 2})[3].position.x == q[1]);
    robot.validate_limits({q.data(), 1});

    auto cell = ovoid::robot_cell::create(robot);
    const ovoid::pose far({0, 0, 9});
    const auto wall = cell.add(ovoid::body(box, ovoid::pose({5, 0, 0})));
    auto checker = ovoid::robot_checker::create(cell);
    ovoid::robot_query_options options;
    options.margin = 0.5;
    CHECK_EQ(checker.collide({q.data(), 1}, options).status, OVOID_ROBOT_FREE);
    const auto answers = checker.collide_batch({q.data(), 2}, 2, options);
    CHECK(answers[0].status == OVOID_ROBOT_FREE && answers[1].status == OVOID_ROBOT_HIT && answers[1].b.body == wall);
    const auto near = checker.find_near({&q[1], 1}, options);
    CHECK(near.items.size() == 1 && near.gradients.size() == 1);
    CHECK_NEAR(near.items[0].lower, 0.1, 1e-8);
    CHECK_NEAR(near.gradients[0], -1, 1e-12);
    CHECK_EQ(checker.find_nearest({q.data(), 1}, options).items.size(), 0u);
    ovoid_robot_step steps[64];
    ovoid::robot_path_options wanted;
    wanted.steps = steps, wanted.capacity = 64;
    const auto path = checker.find_hit({q.data(), 2}, 2, wanted);
    CHECK(path.status == OVOID_ROBOT_FREE && path.free_until == 1 && path.step_count > 0 && path.step_count <= 64);
    ovoid::verify_robot_path(cell, {q.data(), 2}, 2, wanted, path, {steps, path.step_count});
    wanted.steps = nullptr, wanted.capacity = 0, wanted.any_hit = 1;
    const double edges[4] = {q[0], q[0], q[0], q[1]};
    const auto found = checker.find_hit_batch({edges, 4}, 2, wanted);
    CHECK(found.size() == 2 && found[0].status == OVOID_ROBOT_FREE && found[0].free_until == 1);
    CHECK_EQ(found[1].status, checker.find_hit({edges + 2, 2}, 2).status);
    const auto clearance = checker.compute_clearance({q.data(), 2}, 2);
    CHECK(clearance.status == OVOID_ROBOT_FREE && clearance.lower > 0 && clearance.lower <= clearance.upper);
    cell.set_padding(1, 2);
    CHECK_EQ(checker.collide({q.data(), 1}, options).status, OVOID_ROBOT_HIT);
    CHECK_EQ(cell.padding(1), 2);
    CHECK(!cell.is_body_allowed(wall, 1) && cell.is_allowed(1, 1));
    cell.set_body_allowed(wall, 1, true);
    CHECK(cell.is_body_allowed(wall, 1));
    CHECK_EQ(checker.collide({q.data(), 1}, options).status, OVOID_ROBOT_UNDECIDED); // no pair is left to compare
    cell.move(wall, far);
    const auto held = cell.attach(1, ovoid::body(box, far));
    cell.set_allowed(0, 1, true);
    cell.remove(held);
    checker.reset();

    const auto matrix = ovoid::robot_matrix::create(robot);
    CHECK(matrix.size() == 0 && matrix.find(0, 1) == nullptr);
    ovoid_robot_bracket depth = {0, 1};
    ovoid::robot_cover_options search;
    search.rounds = 10;
    const auto cover = ovoid::compute_sphere_cover(robot, 1, 1, search, &depth);
    CHECK(cover.size() == 1 && depth.upper <= 0);
    CHECK_NEAR(cover[0].radius, 0.1 * std::sqrt(3.0), 1e-9);
    ovoid::robot_audit_options brief;
    brief.without_volumes = 1;
    CHECK(ovoid::compute_sphere_audit(robot, 1, {cover.data(), 1}, brief).depth.upper <= 0);
    const ovoid_robot_link_sphere small = {1, {{0, 0, 0}, 0.05}};
    const auto model = ovoid::create_from_spheres(robot, {&small, 1});
    auto model_cell = ovoid::robot_cell::create(model), plain = ovoid::robot_cell::create(robot);
    const ovoid::body post(box, ovoid::pose({5, 0, 0}));
    model_cell.add(post), plain.add(post);
    auto first = ovoid::robot_checker::create(plain), second = ovoid::robot_checker::create(model_cell);
    ovoid_robot_comparison sum = {};
    std::vector<ovoid_robot_agreement> agreements;
    const std::array<double, 2> near_post = {{4.7, 4.83}};
    ovoid::compare_states(first, second, {near_post.data(), 2}, 2, sum, ovoid::robot_query_options(), &agreements);
    CHECK(sum.states == 2 && agreements[0] == OVOID_ROBOT_COMPARED_BOTH_FREE);
    CHECK(std::string(ovoid::name(agreements[1])) == "missed" && sum.deepest_state == 1);
    ovoid_robot_matrix_pair never = {};
    never.touch = OVOID_ROBOT_TOUCH_NEVER;
    CHECK(std::string(ovoid::reason(never)) == "Never" && std::string(ovoid::name(never.touch)) == "never");

    int thrown = 0;
    try {
        cell.remove(held);
    } catch (const ovoid::error &e) {
        thrown += e.code() == OVOID_ERROR_INDEX;
    }
    try {
        robot.validate_limits({q.data(), 1}, -20);
    } catch (const ovoid::error &e) {
        thrown += e.code() == OVOID_ERROR_RANGE && e.place() == 0;
    }
    d.link_count = 0;
    try {
        (void)ovoid::robot::create(d);
    } catch (const ovoid::error &e) {
        thrown += e.code() == OVOID_ERROR_EMPTY;
    }
    try {
        (void)ovoid::compute_sphere_cover(robot, 0, 1, search);
    } catch (const ovoid::error &e) {
        thrown += e.code() == OVOID_ERROR_EMPTY;
    }
    CHECK_EQ(thrown, 4);
    return check_end();
}
