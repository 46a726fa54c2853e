// Failing memory: for every k, the k-th allocation of reading a robot, a scene, a request and a trajectory fails.
// Truth: then it says MEMORY, and nothing leaks (the leak checker of the sanitizers says so at the end); with enough
// memory it succeeds. expat and libyaml have memory of their own, which does not fail.
#define FILES_FOLDER "test_robot_memory"
#include "failing.h"
#include "files.h"

#include "ovoid/robot_io.h"
#include "ovoid/robot_proof.h"

static void drop_note(void *context, const ovoid_robot_note *note) {
    (void)note;
    ++*(size_t *)context;
}

static size_t notes;

static int with_parts = 1;

static int read_robot(ovoid_error *error) {
    static const ovoid_robot_package package = {"p", "/nowhere"};
    ovoid_robot_read_options options = {.packages = &package,
                                        .package_count = 1,
                                        .ros_package_path = "",
                                        .ament_prefix_path = "/nowhere",
                                        .parts = with_parts,
                                        .note = drop_note,
                                        .context = &notes};
    ovoid_robot_file *file =
        ovoid_robot_file_read(file_path("deep/robot.urdf"), file_path("robot.srdf"), &options, error);
    ovoid_robot_file_destroy(file);
    return file != NULL;
}

static int read_scene(ovoid_error *error) {
    ovoid_obstacles *o = ovoid_obstacles_read(file_path("scene.yaml"), NULL, error);
    ovoid_obstacles_destroy(o);
    return o != NULL;
}

// The scene around a robot of two links that is there.
static ovoid_robot *robot;
static void make_robot(void) {
    static const ovoid_robot_link links[2] = {{"a"}, {"b"}};
    const ovoid_robot_joint joint = {.name = "j",
                                     .type = OVOID_JOINT_CONTINUOUS,
                                     .child = 1,
                                     .origin = {{0, 0, 0}, {1, 0, 0, 0}},
                                     .axis = {0, 0, 1},
                                     .mimic = OVOID_ROBOT_NONE,
                                     .multiplier = 1};
    const ovoid_robot_description d = {.links = links, .link_count = 2, .joints = &joint, .joint_count = 1};
    robot = ovoid_robot_create(&d, NULL, NULL);
}

static int place_scene(ovoid_error *error) {
    ovoid_obstacles *o = ovoid_obstacles_read(file_path("scene.yaml"), NULL, error);
    ovoid_robot_cell *cell = o ? ovoid_robot_cell_create(robot, NULL, error) : NULL;
    int good = cell && ovoid_robot_cell_add_obstacles(cell, o, NULL, error) == OVOID_OK;
    ovoid_robot_cell_destroy(cell);
    ovoid_obstacles_destroy(o);
    return good;
}

static int read_trajectory(ovoid_error *error) {
    ovoid_trajectory *t = ovoid_trajectory_read(file_path("moved.json"), NULL, error);
    ovoid_trajectory_destroy(t);
    return t != NULL;
}

static int read_request(ovoid_error *error) {
    ovoid_motion_request *r = ovoid_motion_request_read(file_path("problems/request1.yaml"), NULL, error);
    ovoid_motion_request_destroy(r);
    return r != NULL;
}

static int find_problems(ovoid_error *error) {
    ovoid_problems *p = ovoid_problems_find(file_path("."), error);
    ovoid_problems_destroy(p);
    return p != NULL;
}

static int read_proofs(ovoid_error *error) {
    ovoid_robot_proofs_reader *proofs = ovoid_robot_proofs_reader_open(file_path("proofs.jsonl"), error);
    ovoid_robot_proof p;
    int got = proofs ? ovoid_robot_proofs_reader_read(proofs, &p, error) : -1;
    CHECK(got != 0 &&
          (got < 0 || (p.count == 2 && p.times[1] == 3 && p.steps[0].mask == 5 && p.steps[1].normal.x == 1)));
    ovoid_robot_proofs_reader_close(proofs);
    return got > 0;
}

static const char urdf[] =
    "<robot name=\"r\"><material/>\n<link name=\"a\"><inertial/><collision name=\"x\"><geometry><box size=\"1 2 "
    "3\"/></geometry>"
    "</collision><collision><geometry><mesh filename=\"package://q/two.obj\" scale=\"1 -1 "
    "2\"/></geometry></collision></link>\n"
    "<link name=\"b\"><collision><geometry><mesh filename=\"two.obj\"/></geometry></collision></link>\n"
    "<joint name=\"j\" type=\"continuous\"><parent link=\"a\"/><child link=\"b\"/></joint></robot>\n";
static const char srdf[] =
    "<robot name=\"r\"><virtual_joint name=\"v\" type=\"planar\" parent_frame=\"w\" child_link=\"a\"/><group "
    "name=\"h\">"
    "<group name=\"g\"/></group><group name=\"g\"><chain base_link=\"a\" tip_link=\"b\"/><joint name=\"x\"/></group>"
    "<group_state name=\"s\" group=\"g\"><joint name=\"j\" value=\"1\"/></group_state><passive_joint name=\"j\"/>"
    "<disable_collisions link1=\"a\" link2=\"b\" reason=\"Adjacent\"/><link_sphere_approximation link=\"b\">"
    "<sphere radius=\"1\"/></link_sphere_approximation><end_effector/></robot>";
static const char obj[] = "o one\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"
                          "o two\nv 5 0 0\nv 6 0 0\nv 5 1 0\nv 5 0 1\nf 5 7 6\nf 5 6 8\nf 6 7 8\nf 7 5 8\n";
static const char scene[] =
    "world:\n  collision_objects:\n    - id: o\n      primitives: [{type: box, dimensions: [1, 1, 1]}]\n"
    "      meshes: [{vertices: [[0, 0, 0], [1, 0, 0], [0, 1, 0]], triangles: [[0, 1, 2]]}]\n"
    "      primitive_poses: [{}]\n      mesh_poses: [{}]\n      header: {frame_id: b}\n"
    "robot_state:\n  joint_state: {name: [j], position: [1]}\n  attached_collision_objects:\n"
    "    - {link_name: b, touch_links: [a], object: {id: h, header: {frame_id: cam}, primitives: [{type: sphere, "
    "dimensions: [1]}]}}\n"
    "fixed_frame_transforms: [{header: {frame_id: cam}, child_frame_id: a, transform: {translation: [1, 0, 0]}}]\n"
    "link_padding: [{link_name: a, padding: 0.1}]\n"
    "allowed_collision_matrix: {entry_names: [a, b], entry_values: [[0, 1], [1, 0]], default_entry_names: [o, h], "
    "default_entry_values: [1, 1]}\n";
static const char moved[] = "{\"joint_names\":[\"a\"],\"points\":[{\"positions\":[1]},{\"positions\":[2]}]}";
static const char request[] = "start_state: {joint_state: {name: [a], position: [1]}}\ngroup_name: g\n"
                              "goal_constraints: [{joint_constraints: [{joint_name: a, position: 2}]}]\n";

static const char proofs[] =
    "{\"path_proofs\":2,\"robot\":\"r\",\"srdf\":null,\"scene\":\"s\",\"packages\":[\"a=b\"],\"scales\":[\"x=2\"],"
    "\"paddings\":[],\"parts\":true,\"hull\":false,\"visual\":"
    "false,"
    "\"fixed_base\":false,\"cylinder_tolerance\":0,\"margin\":0,\"limit_slack\":0,\"paths\":1,"
    "\"digest\":\"0123456789abcdef\",\"variables\":[\"x\",\"y\"],\"pairs\":[[{\"link\":\"a\",\"element\":0,\"name\":"
    "\"n\"},"
    "{\"obstacle\":\"o\",\"part\":1}]]}\n"
    "{\"path\":0,\"status\":\"hit\",\"states\":2,\"margin\":0,\"free_until\":0,\"free_until_time\":1,\"hit_at\":0.5,"
    "\"hit_at_time\":2,\"segment\":0,\"pair\":0,\"a\":{\"link\":\"a\",\"element\":0,\"name\":\"n\"},\"b\":{"
    "\"obstacle\":\"o\","
    "\"part\":1},\"lower\":null,\"upper\":0,\"looked_at\":1,\"steps\":2,\"q\":[[1,2],[3,4]],\"times\":[1,3]}\n"
    "{\"step\":\"outer\",\"begin\":0,\"end\":1,\"pairs\":[4,6]}\n"
    "{\"step\":\"ends\",\"begin\":0,\"end\":1,\"normal\":[1,0,0],\"pairs\":[0]}\n";

int main(void) {
    mkdir(file_path("."), 0777);
    mkdir(file_path("deep"), 0777);
    mkdir(file_path("problems"), 0777);
    file_write_text("deep/package.xml", "<package><name>q</name></package>");
    file_write_text("deep/two.obj", obj);
    file_write_text("deep/robot.urdf", urdf);
    file_write_text("robot.srdf", srdf);
    file_write_text("scene.yaml", scene);
    file_write_text("problems/scene1.yaml", scene);
    file_write_text("problems/request1.yaml", request);
    file_write_text("moved.json", moved);
    check_operation("robot", 0, read_robot);
    CHECK(notes > 0);
    with_parts = 0;
    // A triangle that cannot be measured beside the hull makes the mesh a solid, which it is in any case.
    check_operation("robot of solids", 1, read_robot);
    check_operation("scene", 0, read_scene);
    make_robot();
    check_operation("cell", 0, place_scene);
    ovoid_robot_destroy(robot);
    check_operation("request", 0, read_request);
    check_operation("trajectory", 0, read_trajectory);
    file_write_text("proofs.jsonl", proofs);
    check_operation("problems", 0, find_problems);
    check_operation("proofs", 0, read_proofs);
    return check_end();
}
