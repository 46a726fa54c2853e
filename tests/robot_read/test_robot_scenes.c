// Scenes, requests, trajectories and planning problems: what is read, what is refused. Truth: files written here; the
// number of the known problems' files.
#define FILES_FOLDER "test_scenes"
#include "robot_files.h"

#include "ovoid/ovoid.h"

static ovoid_obstacles *read_scene(const char *name, const char *text, const ovoid_robot_read_options *options) {
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_obstacles *o = ovoid_obstacles_read(file_write_text(name, text), options, &error);
    if (!o) printf("  %s\n", error.message);
    return o;
}

static ovoid_box get_box(const ovoid_obstacles *o, size_t i) {
    return ovoid_shape_get_measures(ovoid_obstacles_get(o, i).shape).box;
}

static void test_primitives(void) {
    static const char text[] =
        "world:\n"
        "  collision_objects:\n"
        "    - id: table\n"
        "      pose: {position: [0, 0, 10], orientation: [0, 0, 1, 0]}\n"
        "      primitives:\n"
        "        - {type: box, dimensions: [2, 4, 6]}\n"
        "        - {type: 3, dimensions: [5, 0.5]}\n"
        "      primitive_poses:\n"
        "        - {position: [1, 0, 0], orientation: [0, 0, 0, 1]}\n"
        "        - {position: {x: 0, y: 2, z: 0}, orientation: {x: 0, y: 0, z: 0, w: 1}}\n"
        "    - id: 'ball'\n"
        "      primitives: [{type: sphere, dimensions: [0.25]}, {type: cone, dimensions: [2, 1]}]\n"
        "      primitive_poses: [{position: [3, 0, 0]}, {position: [4, 0, 0]}]\n"
        "    - id: second\n"
        "      pose: {position: [7, 0, 0]}\n"
        "      primitives: [{type: box, dimensions: [2, 4, 6]}]\n";
    ovoid_robot_read_options options = make_read_options();
    options.tolerance = 0.01;
    ovoid_obstacles *o = read_scene("primitives.yaml", text, &options);
    if (!CHECK(o)) return;
    CHECK_EQ(notes.count, 0);
    if (CHECK_EQ(ovoid_obstacles_get_count(o), 5)) {
        ovoid_obstacle box = ovoid_obstacles_get(o, 0), pillar = ovoid_obstacles_get(o, 1);
        CHECK(strcmp(box.name, "table") == 0 && strcmp(pillar.name, "table") == 0);
        // Turned by a half turn about z and raised by 10.
        CHECK_EQ(box.pose.position.x, -1);
        CHECK_EQ(box.pose.position.z, 10);
        CHECK_EQ(pillar.pose.position.y, -2);
        CHECK_EQ(get_box(o, 0).max.z, 3);
        CHECK_EQ(get_box(o, 1).max.z, 2.5); // the height comes first
        CHECK_NEAR(get_box(o, 1).max.x, 0.5, 0.01);
        ovoid_allowance allowance = ovoid_shape_get_allowance(pillar.shape);
        CHECK(allowance.outside > 0 && allowance.outside <= 0.01);
        CHECK_EQ(ovoid_shape_get_radius(ovoid_obstacles_get(o, 2).shape), 0.25);
        CHECK_EQ(get_box(o, 3).max.z, 1);
        CHECK_EQ(ovoid_obstacles_get(o, 4).pose.position.x, 7);
        CHECK(ovoid_obstacles_get(o, 4).shape == box.shape); // made once
    }
    ovoid_obstacles_destroy(o);
}

static void test_meshes(void) {
    static const char text[] =
        "world:\n  collision_objects:\n    - id: l\n      meshes:\n        - vertices: [[0, 0, 0], [1, 0, 0], [0, 1, "
        "0], "
        "{x: 0, y: 0, z: 1}]\n          triangles: [{vertex_indices: [0, 2, 1]}, [0, 1, 3], [1, 2, 3], [2, 0, 3]]\n"
        "        - vertices: [[0, 0, 0], [3, 0, 0], [0, 3, 0], [0, 0, 3], [0.5, 0.5, 0.5]]\n"
        "          triangles: [[0, 2, 1], [0, 1, 3], [2, 0, 3], [1, 2, 4], [2, 3, 4], [3, 1, 4]]\n"
        "      mesh_poses: [{position: [1, 0, 0]}, {position: [2, 0, 0]}]\n";
    ovoid_robot_read_options options = make_read_options();
    ovoid_obstacles *o = read_scene("meshes.yaml", text, &options);
    if (!CHECK(o)) return;
    if (CHECK_EQ(ovoid_obstacles_get_count(o), 2)) {
        CHECK_EQ(get_box(o, 0).max.z, 1);
        CHECK_EQ(get_box(o, 1).max.z, 3);
        CHECK_EQ(ovoid_obstacles_get(o, 1).pose.position.x, 2);
    }
    // The tip pushed in to (1/2, 1/2, 1/2) leaves half of the volume: a solid. The other one is its hull.
    CHECK_EQ(notes.count, 0);
    const ovoid_solid *solid = ovoid_obstacles_get(o, 1).solid;
    CHECK(!ovoid_obstacles_get(o, 0).solid && solid);
    if (solid) CHECK_NEAR(ovoid_solid_get_report(solid).volume, 2.25, 1e-12);
    ovoid_obstacles_destroy(o);
    // Hulls that are asked for.
    options = make_read_options();
    options.hull = 1;
    o = read_scene("meshes.yaml", text, &options);
    if (CHECK(o)) CHECK(!ovoid_obstacles_get(o, 1).solid && get_box(o, 1).max.z == 3);
    ovoid_obstacles_destroy(o);
    // One that is not closed is its surface: two faces of the first mesh are missing.
    static const char open[] =
        "world:\n  collision_objects:\n    - id: l\n      meshes:\n        - vertices: [[0, 0, 0], "
        "[1, 0, 0], [0, 1, 0], [0, 0, 1]]\n          triangles: [[0, 2, 1], [0, 1, 3]]\n";
    options = make_read_options();
    o = read_scene("open.yaml", open, &options);
    if (!CHECK(o && ovoid_obstacles_get_count(o) == 1)) return;
    solid = ovoid_obstacles_get(o, 0).solid;
    CHECK(solid && !ovoid_solid_get_report(solid).is_closed);
    CHECK(notes.count == 1 && has_note("open.yaml:5: a mesh of the object l is not closed, 4 of its edges are open"));
    ovoid_obstacles_destroy(o);
}

// By the scene's own rule, and where it asks for it; where hulls are asked for that is refused.
static void test_geometry_text(void) {
    static const char text[] =
        "(noname)+\n* the table\n0 0 10\n0 0 1 0\n2\nbox\n2 4 6\n1 0 0\n0 0 0 1\n0 0 0 0\n"
        "cylinder\n0.5 5\n0 2 0\n0 0 0 1\n1 0 0 1\n1\nhandle\n0 0 0\n0 0 0 1\n"
        "* ball\n0 0 0\n0 0 0 1\n3\nsphere\n0.25\n3 0 0\n0 0 0 1\n0 0 0 0\ncone\n1 2\n4 0 0\n0 0 0 1\n0 0 0 0\n"
        "mesh\n4 4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 2 1\n0 1 3\n1 2 3\n2 0 3\n5 0 0\n0 0 0 1\n0 0 0 0\n0\n.\n";
    static const char old[] = "scene\n* Box 0\n1\nbox\n2 4 6\n1 2 3\n0 0 0 1\n0 0 0 0\n*  next\n1\nsphere\n1\n"
                              "0 0 9\n0 0 0 1\n0 0 0 0\n.\n";
    ovoid_robot_read_options options = make_read_options();
    options.tolerance = 0.01;
    ovoid_obstacles *o = read_scene("new.scene", text, &options);
    if (CHECK(o) && CHECK_EQ(ovoid_obstacles_get_count(o), 5)) {
        CHECK(strcmp(ovoid_obstacles_get(o, 0).name, "the table") == 0);
        // Turned by a half turn about z and raised by 10.
        CHECK_EQ(ovoid_obstacles_get(o, 0).pose.position.x, -1);
        CHECK_EQ(ovoid_obstacles_get(o, 0).pose.position.z, 10);
        CHECK_EQ(get_box(o, 0).max.z, 3);
        CHECK_EQ(get_box(o, 1).max.z, 2.5); // the radius comes first
        CHECK_NEAR(get_box(o, 1).max.x, 0.5, 0.01);
        CHECK_EQ(ovoid_shape_get_radius(ovoid_obstacles_get(o, 2).shape), 0.25);
        CHECK_EQ(get_box(o, 3).max.z, 1);
        CHECK_EQ(ovoid_obstacles_get(o, 4).pose.position.x, 5);
        CHECK_EQ(get_box(o, 4).max.z, 1);
    }
    ovoid_obstacles_destroy(o);
    o = read_scene("old.scene", old, &options);
    if (CHECK(o) && CHECK_EQ(ovoid_obstacles_get_count(o), 2)) {
        CHECK(strcmp(ovoid_obstacles_get(o, 0).name, "Box 0") == 0);
        CHECK(strcmp(ovoid_obstacles_get(o, 1).name, "next") == 0);
        CHECK_EQ(ovoid_obstacles_get(o, 0).pose.position.y, 2);
        CHECK_EQ(ovoid_obstacles_get(o, 1).pose.position.z, 9);
    }
    ovoid_obstacles_destroy(o);
}

// What is refused, at which line.
static void test_bad_geometry_text(void) {
    static const struct {
        const char *text, *place, *word;
    } cases[] = {
        {"n\n* a\n1\nbox\n1 1 1\n0 0 0\n0 0 0 1\n0 0 0 0\n", ":9:", "* name"},
        {"n\n* a\n1\nbox\n1 1\n", ":6:", "ends before"},
        {"n\n* a\n1\nbox\n1 1 x\n0 0 0\n0 0 0 1\n0 0 0 0\n.\n", ":5:", "finite number"},
        {"n\n* a\n1\nplane\n0 0 1 0\n0 0 0\n0 0 0 1\n0 0 0 0\n.\n", ":4:", "planes"},
        {"n\n* a\n1\npyramid\n1\n.\n", ":4:", "must be box"},
        {"n\n* a\nmany\n.\n", ":3:", "number of its shapes"},
        {"n\n* a\n0 0 0\n0 0 0 1\n1\nsphere\n1\n0 0 0\n0 0 0 1\n0 0 0 0\n.\n", ":11:", "subframes"},
        {"n\n* a\n1\nmesh\n3 1\n0 0 0\n1 0 0\n0 1 0\n0 1 3\n0 0 0\n0 0 0 1\n0 0 0 0\n.\n", ":9:", "vertex 3"},
        {"n\n* a\n1\nmesh\n99999999999 1\n0 0 0\n", ":7:", "ends before"},
        {"world:\n  collision_objects: []\n", ":2:", ".yaml"},
        {"n\n* \n1\nsphere\n1\n0 0 0\n0 0 0 1\n0 0 0 0\n.\n", ":2:", "needs an id"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        ovoid_error error = {OVOID_OK, -1, ""};
        ovoid_obstacles *o = ovoid_obstacles_read(file_write_text("bad.scene", cases[i].text), NULL, &error);
        if (!CHECK(!o) || !CHECK(strstr(error.message, cases[i].place) && strstr(error.message, cases[i].word)))
            printf("  case %zu: %s\n", i, o ? "accepted" : error.message);
        ovoid_obstacles_destroy(o);
    }
}

static void test_own_solids(void) {
    static const char dented[] = "v 0 0 0\nv 3 0 0\nv 0 3 0\nv 0 0 3\nv 0.5 0.5 0.5\n"
                                 "f 1 3 2\nf 1 2 4\nf 3 1 4\nf 2 3 5\nf 3 4 5\nf 4 2 5\n";
    static const char text[] = "{\"objects\": [{\"name\": \"a\", \"mesh\": \"dented.obj\"}, {\"name\": \"b\", "
                               "\"mesh\": \"dented.obj\", \"solid\": false}, {\"name\": \"c\", \"box\": [1, 1, 1]}]}";
    static const char asked[] = "{\"objects\": [{\"name\": \"a\", \"mesh\": \"dented.obj\", \"solid\": true}]}";
    file_write_text("dented.obj", dented);
    ovoid_robot_read_options options = make_read_options();
    for (options.hull = 0; options.hull < 2; options.hull++) {
        ovoid_obstacles *o = read_scene("own.json", text, &options);
        if (!CHECK(o && ovoid_obstacles_get_count(o) == 3)) continue;
        CHECK_EQ(ovoid_obstacles_get(o, 0).solid != NULL, !options.hull);
        CHECK(!ovoid_obstacles_get(o, 1).solid && !ovoid_obstacles_get(o, 2).solid);
        CHECK_EQ(get_box(o, 0).max.z, 3);
        ovoid_obstacles_destroy(o);
    }
    options.hull = 0;
    ovoid_obstacles *o = read_scene("own.json", asked, &options);
    if (CHECK(o)) CHECK(ovoid_obstacles_get(o, 0).solid != NULL);
    ovoid_obstacles_destroy(o);
    ovoid_error error;
    options.hull = 1;
    CHECK(!ovoid_obstacles_read(file_write_text("own.json", asked), &options, &error));
    CHECK(strstr(error.message, "hulls are asked for") != NULL);
    options = (ovoid_robot_read_options){.tolerance = -1};
    CHECK(!ovoid_obstacles_read(file_write_text("own.json", text), &options, &error));
    CHECK_EQ((int)error.code, (int)OVOID_ERROR_ARGUMENT);
    CHECK(strstr(error.message, "tolerance") != NULL);
}

static void test_own_scene(void) {
    static const char text[] = "{\"unit\": \"m\", \"objects\": ["
                               "{\"name\": \"a\", \"box\": [1, 1, 1]}, {\"name\": \"b\", \"compound\": ["
                               "{\"sphere\": 1, \"pose\": {\"xyz\": [1, 0, 0]}}, {\"sphere\": 2}], "
                               "\"pose\": {\"xyz\": [0, 5, 0]}}]}";
    ovoid_obstacles *o = read_scene("own.json", text, NULL);
    if (!CHECK(o)) return;
    if (CHECK_EQ(ovoid_obstacles_get_count(o), 3)) {
        CHECK(strcmp(ovoid_obstacles_get(o, 2).name, "b") == 0);
        CHECK_EQ(ovoid_obstacles_get(o, 1).pose.position.x, 1);
        CHECK_EQ(ovoid_obstacles_get(o, 1).pose.position.y, 5);
        CHECK_EQ(ovoid_shape_get_radius(ovoid_obstacles_get(o, 2).shape), 2);
    }
    ovoid_obstacles_destroy(o);
}

// ---- refusals

#define OBJECT(members) "world:\n  collision_objects:\n    - id: o\n" members
#define PART(part) OBJECT("      primitives: [" part "]\n      primitive_poses: [{position: [0, 0, 0]}]\n")
#define MESH(mesh) OBJECT("      meshes: [" mesh "]\n")

#define TAG4 "%TAG !x! y\n%TAG !x! y\n%TAG !x! y\n%TAG !x! y\n"

static const bad_input scenes[] = {
    {"empty.yaml", "", -1, "empty", OVOID_ERROR_EMPTY},
    {"blank.yaml", "# nothing\n", 1, "needs world: collision_objects"},
    {"list.yaml", "- 1\n", 1, "there must be a map with \"world\""},
    {"cut.yaml", "world: {collision_objects: [\n", 2, "YAML: "},
    {"alias.yaml", "a: &x [1, 2]\nworld: *x\n", 2, "aliases are not read"},
    {"key.yaml", "{[1, 2]: 3}\n", 1, "a key must be a text"},
    {"two.yaml", "a: 1\n---\nb: 2\n", 3, "a second document"},
    {"tags.yaml", TAG4 TAG4 TAG4 TAG4 "%TAG !x! y\n---\na: 1\n", -1, "there are 17 %TAG directives", OVOID_ERROR_LIMIT},
    {"wide.yaml",
     "\xff\xfe"
     "a\0:",
     1, "YAML: "},
    {"zero.yaml", "a: \"x\\0y\"\n", 1, "zero byte"},
    {"twice.yaml", "world: {}\nworld: {}\n", 2, "\"world\" is there twice"},
    {"world.yaml", "world: 7\n", 1, "\"world\" must be a map"},
    {"objects.yaml", "world: {collision_objects: 7}\n", 1, "\"collision_objects\" must be a list"},
    {"nameless.yaml", "world:\n  collision_objects:\n    - primitives: []\n", 3, "an object needs an id"},
    {"deep.yaml",
     "a: "
     "[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[["
     "[",
     1, "nested more than 64 deep", OVOID_ERROR_LIMIT},
    {"type.yaml", PART("{type: prism, dimensions: [1]}"), 4,
     "object \"o\": its type is \"prism\", not box, sphere, cylinder or cone"},
    {"sizes.yaml", PART("{type: box, dimensions: [1, 2]}"), 4, "there must be 3 numbers"},
    {"words.yaml", PART("{type: box, dimensions: [1, 2, x]}"), 4, "\"x\" must be a finite number"},
    {"nan.yaml", PART("{type: sphere, dimensions: [nan]}"), 4, "\"nan\" is not finite", OVOID_ERROR_NOT_FINITE},
    {"dot_inf.yaml", PART("{type: sphere, dimensions: [.inf]}"), 4, "must be a finite number"},
    {"negative.yaml", PART("{type: sphere, dimensions: [-1]}"), 4, "below zero", OVOID_ERROR_RADIUS},
    {"bare.yaml", PART("{type: sphere}"), 4, "needs type and dimensions"},
    {"huge.yaml", PART("{type: sphere, dimensions: [1e60]}"), 4, "object \"o\"", OVOID_ERROR_RANGE},
    {"poses.yaml", OBJECT("      primitives: [{type: sphere, dimensions: [1]}, {type: sphere, dimensions: [1]}]\n"), 4,
     "there are 2 primitives but 0 primitive_poses"},
    {"turn.yaml", OBJECT("      pose: {orientation: [0, 0, 0, 0]}\n"), 4, "four zeros", OVOID_ERROR_ROTATION},
    {"far.yaml", OBJECT("      pose: {position: [1e51, 0, 0]}\n"), 4, "above 1e+50", OVOID_ERROR_RANGE},
    {"missing.yaml", OBJECT("      pose: {position: {x: 1, y: 2, w: 3}}\n"), 4, "\"z\" is missing"},
    {"frame.yaml", "fixed_frame_transforms: [{transform: {translation: [1, 0, 0]}, child_frame_id: base}]\nworld: {}\n",
     1, "a fixed frame needs its name"},
    {"frames.yaml",
     "fixed_frame_transforms:\n  - {header: {frame_id: a}, child_frame_id: b, transform: {}}\n"
     "  - {header: {frame_id: c}, child_frame_id: d, transform: {translation: [1, 0, 0]}}\nworld: {}\n",
     3, "fixed frames are given in \"b\" and in \"d\""},
    {"frame_turn.yaml", "fixed_frame_transforms: [{transform: {rotation: [0, 0, 0, 0]}}]\nworld: {}\n", 1, "four zeros",
     OVOID_ERROR_ROTATION},
    {"octomap.yaml", "world:\n  octomap:\n    octomap: {id: OcTree, data: [1]}\n", 3,
     "\"data\" of an octomap is not read"},
    {"scale.yaml", "link_scale: [{link_name: a, scale: 1}, {link_name: b, scale: 1.1}]\nworld: {}\n", 1,
     "link_scale: b is 1.1 times as large"},
    {"padding.yaml", "link_padding: [{link_name: a, padding: -1}]\nworld: {}\n", 1, "the padding of a is -1",
     OVOID_ERROR_RADIUS},
    {"pad_key.yaml", "link_padding: [{link_name: a, radius: 1}]\nworld: {}\n", 1, "\"radius\" is no key"},
    {"matrix.yaml", "allowed_collision_matrix: {entry_names: [a, b], entry_values: [[0, 1], [1]]}\nworld: {}\n", 1,
     "a row needs 2 entries"},
    {"rows.yaml", "allowed_collision_matrix: {entry_names: [a, b], entry_values: [[0, 1]]}\nworld: {}\n", 1,
     "there are 2 entry_names but 1 entry_values"},
    {"flags.yaml", "allowed_collision_matrix: {entry_names: [a], entry_values: [[yes]]}\nworld: {}\n", 1,
     "\"yes\" is neither true nor false"},
    {"names.yaml", "allowed_collision_matrix: {entry_names: [a, a], entry_values: [[0, 1], [1, 0]]}\nworld: {}\n", 1,
     "\"a\" is there twice"},
    {"defaults.yaml", "allowed_collision_matrix: {default_entry_names: [a]}\nworld: {}\n", 1,
     "there are 1 default_entry_names but 0 default_entry_values"},
    {"state.yaml", "robot_state: {joint_state: {name: [a], position: []}}\nworld: {}\n", 1,
     "there are 1 name but 0 position"},
    {"held.yaml", "robot_state: {attached_collision_objects: [{object: {id: a}}]}\nworld: {}\n", 1,
     "an attached object needs link_name and object"},
    {"held_empty.yaml", "robot_state: {attached_collision_objects: [{link_name: b, object: {id: a}}]}\nworld: {}\n", 1,
     "object \"a\": it has neither primitives nor meshes", OVOID_ERROR_EMPTY},
    {"twin.yaml",
     PART("{type: sphere, dimensions: [1]}") "    - id: p\n      primitives: [{type: sphere, dimensions: [2]}]\n"
                                             "    - id: o\n      primitives: [{type: sphere, dimensions: [3]}]\n",
     8, "object \"o\": it is there twice"},
    {"held_twin.yaml",
     PART("{type: sphere, dimensions: [1]}") "robot_state:\n  attached_collision_objects:\n    - link_name: b\n"
                                             "      object: {id: o, primitives: [{type: sphere, dimensions: [2]}]}\n",
     9, "object \"o\": it is there twice"},
    {"root_key.yaml", "world: {}\ngravity: 9\n", 2, "\"gravity\" is no key that is read here"},
    {"world_key.yaml", "world:\n  voxels: 9\n", 2, "\"voxels\" is no key that is read here"},
    {"object_key.yaml", OBJECT("      colour: red\n"), 4, "\"colour\" is no key that is read here"},
    {"part_key.yaml", PART("{type: sphere, dimensions: [1], scale: 2}"), 4, "\"scale\" is no key"},
    {"mesh_key.yaml", MESH("{vertices: [], file: x}"), 4, "\"file\" is no key"},
    {"pose_key.yaml", OBJECT("      pose: {position: [0, 0, 0], rpy: [0, 0, 0]}\n"), 4, "\"rpy\" is no key"},
    {"no_part.yaml", OBJECT("      pose: {position: [0, 0, 0]}\n"), 3, "it has neither primitives nor meshes",
     OVOID_ERROR_EMPTY},
    {"plane.yaml", OBJECT("      planes: [{coef: [0, 0, 1, 0]}]\n"), 4, "put a box in the plane"},
    {"operation.yaml", OBJECT("      operation: 1\n"), 4, "only 0, to add, is read"},
    {"no_mesh.yaml", MESH("{triangles: []}"), 4, "a mesh needs vertices", OVOID_ERROR_EMPTY},
    {"index.yaml", MESH("{vertices: [[0, 0, 0]], triangles: [[0, 0, 1]]}"), 4, "names the vertex 1 of 1",
     OVOID_ERROR_INDEX},
    {"half.yaml", MESH("{vertices: [[0, 0, 0]], triangles: [[0, 0, 0.5]]}"), 4, "names the vertex 0.5",
     OVOID_ERROR_INDEX},
    {"own.json", "{}", -1, "needs \"objects\""},
    {"own.json", "{\"unit\": \"mm\", \"objects\": [{\"name\": \"a\", \"sphere\": 1}]}", -1,
     "the scene is in mm, and a robot is in metres"},
};

static int accepts_scene(const char *path, ovoid_error *error) {
    ovoid_obstacles *obstacles = ovoid_obstacles_read(path, NULL, error);
    ovoid_obstacles_destroy(obstacles);
    return obstacles != NULL;
}

// ---- requests

#define START "start_state: {joint_state: {name: [a, b], position: [1, -2.5e-1]}}\n"

static void test_request(void) {
    static const char text[] =
        START "group_name: arm\ngoal_constraints:\n  - joint_constraints:\n"
              "      - {joint_name: b, position: 3}\n  - joint_constraints: [{joint_name: a, position: 4}]\n"
              "    position_constraints: []\n";
    ovoid_robot_read_options options = make_read_options();
    ovoid_motion_request *r = ovoid_motion_request_read(file_write_text("good.yaml", text), &options, NULL);
    size_t count;
    if (!CHECK(r)) return;
    const ovoid_joint_position *start = ovoid_motion_request_get_start(r, &count);
    CHECK(count == 2 && strcmp(start[1].joint, "b") == 0 && start[1].position == -0.25);
    CHECK(strcmp(ovoid_motion_request_get_group(r), "arm") == 0);
    CHECK_EQ(ovoid_motion_request_get_goal_count(r), 2);
    const ovoid_joint_position *goal = ovoid_motion_request_get_goal(r, 0, &count);
    CHECK(count == 1 && strcmp(goal[0].joint, "b") == 0 && goal[0].position == 3);
    goal = ovoid_motion_request_get_goal(r, 1, &count);
    CHECK(count == 1 && goal[0].position == 4);
    CHECK_EQ(notes.count, 0);
    ovoid_motion_request_destroy(r);
}

static const bad_input requests[] = {
    {"no_start.yaml", "group_name: a\n", 1, "needs start_state: joint_state: name and position"},
    {"lengths.yaml", "start_state: {joint_state: {name: [a, b], position: [1]}}\n", 1,
     "there are 2 names but 1 positions"},
    {"name.yaml", "start_state: {joint_state: {name: [[a]], position: [1]}}\n", 1, "must be a text"},
    {"goal.yaml", START "goal_constraints: [{joint_constraints: [{joint_name: a}]}]\n", 2,
     "needs joint_name and position"},
    {"no_goal.yaml", START "goal_constraints:\n  - {name: home}\n", 3, "a goal without joint_constraints"},
    {"empty_goal.yaml", START "goal_constraints:\n  - joint_constraints: []\n", 3, "a goal without joint_constraints"},
    {"goals.yaml", START "goal_constraints: 5\n", 2, "must be a list"},
    {"region.yaml", START "goal_constraints: [{position_constraints: [{weight: 1}]}]\n", 2,
     "\"position_constraints\" of a goal are not read"},
    {"holds.yaml", "start_state: {attached_collision_objects: [{weight: 1}]}\n", 1,
     "\"attached_collision_objects\" of a request are not read"},
    {"base.yaml", "start_state: {multi_dof_joint_state: {joint_names: [v], transforms: [{translation: [1, 0, 0]}]}}\n",
     1, "a base that is not where its frame is"},
    {"unknown.yaml", START "gravity: 9\n", 2, "\"gravity\" is no key"},
    {"group.yaml", "group_name: [a]\n" START, 1, "\"group_name\" must be a text"},
};

// ---- trajectories

static void test_trajectory(void) {
    static const char text[] =
        "trajectory_start: {joint_state: {name: [a, b], position: [1, 2]}}\nmodel_id: r\ntrajectory:\n"
        "  - joint_trajectory:\n      header: {frame_id: base}\n      joint_names: [a, b]\n      points:\n"
        "        - {positions: [1, 2], velocities: [0, 0], time_from_start: {secs: 0, nsecs: 0}}\n"
        "        - {positions: [1.5, 2], time_from_start: {sec: 1, nanosec: 500000000}}\n"
        "    multi_dof_joint_trajectory: {header: {frame_id: ''}, joint_names: [], points: []}\n"
        "  - {joint_names: [b], points: [{positions: [-3], time_from_start: 0.25}]}\n---\n";
    ovoid_trajectory *t = ovoid_trajectory_read(file_write_text("moved.yaml", text), NULL, NULL);
    size_t count;
    if (!CHECK(t)) return;
    const ovoid_joint_position *start = ovoid_trajectory_get_start(t, &count);
    CHECK(count == 2 && strcmp(start[1].joint, "b") == 0 && start[1].position == 2);
    CHECK_EQ(ovoid_trajectory_get_count(t), 3);
    const ovoid_joint_position *second = ovoid_trajectory_get_point(t, 1, &count);
    CHECK(count == 2 && second[0].position == 1.5 && ovoid_trajectory_get_line(t, 1) == 9);
    const ovoid_joint_position *last = ovoid_trajectory_get_point(t, 2, &count);
    CHECK(count == 1 && strcmp(last[0].joint, "b") == 0 && last[0].position == -3);
    CHECK(ovoid_trajectory_get_time(t, 0) == 0 && ovoid_trajectory_get_time(t, 1) == 1.5);
    CHECK_EQ(ovoid_trajectory_get_time(t, 2), 1.75); // the second begins where the first ends
    ovoid_trajectory_destroy(t);
}

#define JOINED(first, later)                                                                                           \
    "trajectory_start: {joint_state: {name: [a, b, c], position: [1, 2, 0]}}\ntrajectory:\n"                           \
    "  - {joint_names: [a, b], points: [" first "{positions: [2, 2], time_from_start: 1}]}\n"                          \
    "  - {joint_names: [c], points: [{positions: [0], time_from_start: 0}, {positions: [7], time_from_start: "         \
    "1}]}\n" later
#define AT_ONCE "{positions: [1, 2], time_from_start: 0}, "

// A later trajectory that begins at its time 0 in the state in which the one before ended, of the joints that moved
// last or of others: that state is there once. The same where the first trajectory is that state alone.
static void test_joined_trajectories(void) {
    static const char text[] = JOINED(
        AT_ONCE, "  - {joint_names: [b, a], points: [{positions: [2, 2], time_from_start: 0}]}\n"
                 "  - joint_trajectory: {joint_names: [a], points: [{positions: [2], time_from_start: 0}, {positions: "
                 "[3], time_from_start: 2}]}\n");
    static const double times[] = {0, 1, 2, 4}, last[] = {1, 2, 7, 3};
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_trajectory *t = ovoid_trajectory_read(file_write_text("joined.yaml", text), NULL, &error);
    size_t count;
    if (CHECK(t) && CHECK_EQ(ovoid_trajectory_get_count(t), 4))
        for (size_t i = 0; i < 4; i++) {
            CHECK_EQ(ovoid_trajectory_get_time(t, i), times[i]);
            CHECK_EQ(ovoid_trajectory_get_point(t, i, &count)[0].position, last[i]);
        }
    if (!t) printf("  %s\n", error.message);
    ovoid_trajectory_destroy(t);
    static const char alone[] = "trajectory:\n  - {joint_names: [a], points: [{positions: [1], time_from_start: 0}]}\n"
                                "  - {joint_names: [a], points: [{positions: [1], time_from_start: 0}, {positions: "
                                "[2], time_from_start: 1}]}\n";
    t = ovoid_trajectory_read(file_write_text("alone.yaml", alone), NULL, NULL);
    if (CHECK(t)) CHECK_EQ(ovoid_trajectory_get_count(t), 2);
    ovoid_trajectory_destroy(t);
}

// Messages of other kinds; times that are absent, or all 0.
static void test_trajectory_kinds(void) {
    static const struct {
        const char *text;
        size_t points;
        double time; // of the last point; NaN: none
    } kinds[] = {
        {"{\"joint_trajectory\":{\"joint_names\":[\"a\"],\"points\":[{\"positions\":[1]},{\"positions\":[2]}]}}", 2,
         NAN},
        {"{\"joint_names\":[\"a\"],\"points\":[{\"positions\":[1],\"time_from_start\":0},{\"positions\":[2],"
         "\"time_from_start\":{\"secs\":0}}]}",
         2, NAN},
        {"trajectory: {joint_names: [a], points: [{positions: [2], time_from_start: 2}]}\ngoal_tolerance: []\n", 1, 2},
        {"name: [a]\nposition: [2]\nvelocity: []\n", 1, NAN},
    };
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        ovoid_trajectory *t = ovoid_trajectory_read(file_write_text("kind.json", kinds[i].text), NULL, NULL);
        size_t count;
        if (!CHECK(t)) continue;
        if (CHECK_EQ(ovoid_trajectory_get_count(t), kinds[i].points)) {
            size_t end = kinds[i].points - 1;
            const ovoid_joint_position *last = ovoid_trajectory_get_point(t, end, &count);
            CHECK(count == 1 && strcmp(last[0].joint, "a") == 0 && last[0].position == 2);
            double time = ovoid_trajectory_get_time(t, end);
            CHECK(isnan(kinds[i].time) ? isnan(time) : time == kinds[i].time);
        }
        (void)ovoid_trajectory_get_start(t, &count);
        CHECK_EQ(count, 0);
        ovoid_trajectory_destroy(t);
    }
}

// A first point that is not where the trajectory is said to begin, which is told of, once.
static void test_far_start(void) {
    static const struct {
        const char *text;
        size_t notes;
    } starts[] = {{"[a, b], position: [1.25, 2]", 1}, {"[b, a], position: [7, 1.25]", 1}, {"[a], position: [1.5]", 0},
                  {"[a], position: [1.4901]", 0},     {"[a], position: [1.4899]", 1},     {"[c], position: [9]", 0},
                  {"[a], position: [1.75]", 1}};
    for (size_t i = 0; i < sizeof starts / sizeof *starts; i++) {
        char text[300];
        snprintf(text, sizeof text,
                 "trajectory_start: {joint_state: {name: %s}}\ntrajectory:\n  - joint_names: [a, b]\n    points:\n"
                 "      - {positions: [1.5, 2]}\n      - {positions: [9, 2]}\n",
                 starts[i].text);
        ovoid_robot_read_options options = make_read_options();
        ovoid_trajectory *t = ovoid_trajectory_read(file_write_text("far.yaml", text), &options, NULL);
        CHECK(t);
        ovoid_trajectory_destroy(t);
        CHECK_EQ(notes.count, starts[i].notes);
        if (i == 0)
            CHECK(has_note("far.yaml:5: a is 1.25 in trajectory_start, 1.5 in the first point: the way between is not "
                           "checked"));
    }
}

#define POINTS "joint_names: [a]\npoints:\n"
static const bad_input trajectories[] = {
    {"list.yaml", "[1]\n", 1, "this is no trajectory"},
    {"scene.yaml", "name: s\nworld: {}\n", 1, "no trajectory: there is neither \"joint_trajectory\""},
    {"none.yaml", "joint_trajectory: {joint_names: [a], points: []}\n", 1, "has no points", OVOID_ERROR_EMPTY},
    {"long.yaml", POINTS "  - {positions: [1, 2]}\n", 3, "2 positions for 1 joints"},
    {"short.yaml", POINTS "  - {velocities: [1]}\n", 3, "0 positions for 1 joints"},
    {"timed.yaml", POINTS "  - {positions: [1], time_from_start: 0}\n  - {positions: [1]}\n", 4, "no time_from_start"},
    {"untimed.yaml", POINTS "  - {positions: [1]}\n  - {positions: [1], time_from_start: 1}\n", 4,
     "a time_from_start, unlike"},
    {"duration.yaml", POINTS "  - {positions: [1], time_from_start: {hours: 1}}\n", 3, "\"hours\" is no key"},
    {"early.yaml", POINTS "  - {positions: [1], time_from_start: -0.5}\n", 3, "below zero: -0.5 s"},
    {"past.yaml", POINTS "  - positions: [1]\n    time_from_start: {sec: -1, nanosec: 0}\n", 4, "below zero: -1 s"},
    {"second.yaml", POINTS "  - positions: [1]\n    time_from_start: {sec: 1, nanosec: 1000000000}\n", 4,
     "1e+09 nanoseconds are not between"},
    {"nsecs.yaml", POINTS "  - positions: [1]\n    time_from_start: {secs: 1, nsecs: -1}\n", 4,
     "-1 nanoseconds are not between"},
    {"back.yaml", POINTS "  - {positions: [1], time_from_start: 1}\n  - {positions: [1], time_from_start: 0.5}\n", 4,
     "point 1: its time, 0.5 s, is not after that of the point before, 1 s"},
    {"still.yaml",
     POINTS "  - {positions: [1], time_from_start: 0}\n  - {positions: [1], time_from_start: 2}\n"
            "  - {positions: [3], time_from_start: 2}\n",
     5, "point 2: its time, 2 s, is not after that of the point before, 2 s"},
    {"infinite.yaml", POINTS "  - {positions: [1e999]}\n", 3, "is not finite", OVOID_ERROR_NOT_FINITE},
    {"key.yaml", POINTS "  - {positions: [1], jerk: [1]}\n", 3, "\"jerk\" is no key"},
    {"floats.yaml", "multi_dof_joint_trajectory: {joint_names: [world], points: []}\n", 1, "moves joint \"world\""},
    {"both.yaml", "trajectory: []\nmulti_dof_trajectory: {joint_names: [v]}\n", 2,
     "\"multi_dof_trajectory\" is not read"},
    {"held.yaml", "trajectory_start: {attached_collision_objects: [{weight: 1}]}\ntrajectory: []\n", 1,
     "\"attached_collision_objects\" of a trajectory are not read"},
    {"name.yaml", "joint_names: [[a]]\npoints: []\n", 1, "must be a text"},
    {"leap.yaml", JOINED(AT_ONCE, "  - joint_names: [b]\n    points:\n      - {positions: [9], time_from_start: 0}\n"),
     7, "begins at time 0 with joint \"b\" at 9, where the one before ended with 2"},
    {"leap_c.yaml", JOINED(AT_ONCE, "  - {joint_names: [a, c], points: [{positions: [2, 6], time_from_start: 0}]}\n"),
     5, "begins at time 0 with joint \"c\" at 6, where the one before ended with 7"},
    {"untold.yaml", JOINED(AT_ONCE, "  - {joint_names: [d], points: [{positions: [2], time_from_start: 0}]}\n"), 5,
     "joint \"d\" at 2, and nothing says where it was before: name it in trajectory_start"},
};

static int accepts_trajectory(const char *path, ovoid_error *error) {
    ovoid_trajectory *t = ovoid_trajectory_read(path, NULL, error);
    ovoid_trajectory_destroy(t);
    return t != NULL;
}

static int accepts_request(const char *path, ovoid_error *error) {
    ovoid_motion_request *request = ovoid_motion_request_read(path, NULL, error);
    ovoid_motion_request_destroy(request);
    return request != NULL;
}

// ---- problems

static void test_problems(void) {
    ovoid_error error = {OVOID_OK, -1, ""};
    static const char *const folders[] = {"all", "all/b", "all/a", "all/a/deep", "none", "lone"};
    for (size_t i = 0; i < sizeof folders / sizeof *folders; i++) mkdir(file_path(folders[i]), 0777);
    static const char *const files[] = {"all/b/scene2.yaml",    "all/b/request2.yaml", "all/a/deep/request.yml",
                                        "all/a/deep/scene.yml", "all/request1.yaml",   "all/scene1.yaml",
                                        "all/other.yaml",       "all/request.txt",     "lone/request1.yaml"};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) file_write_text(files[i], "x: 1\n");
    ovoid_problems *p = ovoid_problems_find(file_path("all"), &error);
    if (CHECK(p) && CHECK_EQ(ovoid_problems_get_count(p), 3)) {
        CHECK(strcmp(ovoid_problems_get(p, 0).name, "1") == 0);
        CHECK(strcmp(ovoid_problems_get(p, 1).name, "a/deep/") == 0);
        CHECK(strcmp(ovoid_problems_get(p, 2).name, "b/2") == 0);
        CHECK(strcmp(ovoid_problems_get(p, 2).scene, file_path("all/b/scene2.yaml")) == 0);
        CHECK(strcmp(ovoid_problems_get(p, 1).request, file_path("all/a/deep/request.yml")) == 0);
    }
    ovoid_problems_destroy(p);
    CHECK(!ovoid_problems_find(file_path("none"), &error) && error.code == OVOID_ERROR_EMPTY);
    CHECK(!ovoid_problems_find(file_path("lone"), &error) && error.code == OVOID_ERROR_FILE);
    CHECK(strstr(error.message, "there is no scene1.yaml beside it"));
    CHECK(!ovoid_problems_find(file_path("is_not_there"), &error) && error.code == OVOID_ERROR_FILE);
    CHECK(!ovoid_problems_find(file_path("all/scene1.yaml"), &error) && error.code == OVOID_ERROR_FILE);
}

// The problems of MotionBenchMaker: 7 kinds of 100 for each of two robots, unpacked beside the build.
static void read_known(const char *data, const char *archive, const char *into) {
    char command[1200], path[600];
    snprintf(path, sizeof path, "%s/robots/%s", data, archive);
    FILE *there = fopen(path, "rb");
    if (!there) {
        check_skip("the planning problems are absent");
        return;
    }
    fclose(there);
    mkdir(file_path(into), 0777);
    snprintf(command, sizeof command, "tar -xjf '%s' -C '%s'", path, file_path(into));
    if (system(command) != 0) {
        check_skip("tar cannot unpack the planning problems");
        return;
    }
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_problems *p = ovoid_problems_find(file_path(into), &error);
    if (!CHECK(p)) return;
    CHECK_EQ(ovoid_problems_get_count(p), 700);
    size_t bad = 0, obstacles = 0;
    for (size_t i = 0; i < ovoid_problems_get_count(p); i++) {
        ovoid_problem problem = ovoid_problems_get(p, i);
        ovoid_obstacles *o = ovoid_obstacles_read(problem.scene, NULL, &error);
        ovoid_motion_request *r = ovoid_motion_request_read(problem.request, NULL, &error);
        if (!o || !r || !ovoid_motion_request_get_goal_count(r)) {
            if (!bad++) printf("  %s\n", error.message);
        }
        obstacles += o ? ovoid_obstacles_get_count(o) : 0;
        ovoid_obstacles_destroy(o);
        ovoid_motion_request_destroy(r);
    }
    CHECK_EQ(bad, 0);
    printf("%s: %zu problems, %zu obstacles\n", archive, ovoid_problems_get_count(p), obstacles);
    ovoid_problems_destroy(p);
}

int main(void) {
    file_write_text("x", "");
    test_primitives();
    test_meshes();
    test_geometry_text();
    test_bad_geometry_text();
    test_own_solids();
    test_own_scene();
    check_bad_inputs(scenes, sizeof scenes / sizeof *scenes, accepts_scene);
    test_request();
    test_trajectory();
    test_joined_trajectories();
    test_trajectory_kinds();
    test_far_start();
    check_bad_inputs(trajectories, sizeof trajectories / sizeof *trajectories, accepts_trajectory);
    check_bad_inputs(requests, sizeof requests / sizeof *requests, accepts_request);
    test_problems();
    const char *data = check_data_folder();
    if (data) {
        read_known(data, "panda/mbm_problems.tar.bz2", "panda");
        read_known(data, "fetch_mbm/problems.tar.bz2", "fetch");
    } else {
        check_skip("OVOID_DATA is absent");
    }
    return check_end();
}
