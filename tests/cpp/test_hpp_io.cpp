// Files through <ovoid/io.hpp>: what is written is read back, byte for byte; owners and errors as in the core's header.
// Truth: the numbers that this test writes into the files.
#include "same.hpp"

#include <ovoid/io.hpp>

#include <cstdio>
#include <fstream>
#include <string>

#include <unistd.h>

namespace {

std::string folder;

std::string write_text(const std::string &name, const std::string &text) {
    std::ofstream(folder + "/" + name) << text;
    return folder + "/" + name;
}

const char *const two_parts = "o one\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
                              "o two\nv 5 0 0\nv 7 0 0\nv 5 2 0\nv 5 0 2\nf 5 7 6\nf 5 6 8\nf 5 8 7\nf 6 7 8\n";

void check_shapes() {
    const std::string path = write_text("mesh.obj", two_parts);
    CHECK(throws(OVOID_ERROR_NOT_CONVEX, -1, "closed and not convex", [&] { ovoid::read_shape(path); }));
    ovoid::read_options filled;
    filled.hull = 1;
    const ovoid::shape hull = ovoid::read_shape(path, filled);
    CHECK_EQ(hull.report().points, 8);
    ovoid::write_shape(hull, folder + "/hull.ovoid");
    CHECK(is_same_shape(ovoid::read_shape(folder + "/hull.ovoid"), hull.get()));

    ovoid::read_options each;
    each.parts = 1;
    each.scale = 10;
    const auto mesh = ovoid::mesh::read(path, each);
    CHECK(mesh.size() == 2 && std::string(mesh[1].name) == "two");
    const ovoid::shape second = ovoid::shape::from_points(ovoid::points_of(mesh[1]));
    CHECK_NEAR(second.measures().volume, 8000.0 / 6, 1e-9);
    CHECK_NEAR(mesh.compute_convexity(1, second).mesh_volume, 8000.0 / 6, 1e-9);
    CHECK(mesh.create_solid(1).report().is_closed);
    CHECK_EQ(second.allowed({0, 0.5, {0, 0, 0}}).allowance().inside, 0.5);
    const std::uint32_t one[3] = {0, 1, 2};
    CHECK(!ovoid::match_hull({mesh[1].faces.vertices, mesh[1].faces.vertex_count, one, 1}, second).is_closed);
    const auto shapes = ovoid::shapes::read_file(path, each);
    CHECK(shapes.size() == 2 && std::string(shapes.name(0)) == "one" && is_same_shape(shapes[1], second.get()));
    CHECK_EQ(shapes.create_compound().size(), 2);
    CHECK(shapes.convexity(0).kind == OVOID_MESH_HULL &&
          ovoid::shapes::read_file(path).convexity(0).kind == OVOID_MESH_SOLID);
    const auto list = ovoid::shapes::read_list(write_text("list.txt", "# two\nmesh.obj\nhull.ovoid\n"));
    CHECK(list.size() == 2 && is_same_shape(list[1], hull.get()));
    const ovoid::solid triangles = ovoid::read_solid(path, each);
    CHECK(triangles.report().components == 2);
    CHECK_NEAR(triangles.report().volume, 9000.0 / 6, 1e-9);
    CHECK(throws(OVOID_ERROR_FILE, -1, "absent", [] { ovoid::read_solid(folder + "/absent.obj"); }));
    CHECK(throws(OVOID_ERROR_FILE, -1, "absent", [] { ovoid::read_shape(folder + "/absent.obj"); }));
    CHECK(throws(OVOID_ERROR_FORMAT, 2, "bad.obj:2",
                 [] { ovoid::read_shape(write_text("bad.obj", "v 0 0 0\nv 1 x 0\n")); }));
}

void check_scenes() {
    const std::string path = write_text("scene.json", R"({"unit": "mm", "objects": [
        {"name": "box", "box": [2, 2, 2]},
        {"name": "pair", "compound": [{"sphere": 1}, {"sphere": 1, "pose": {"xyz": [4, 0, 0]}}],
         "pose": {"xyz": [9, 0, 0]}}], "ignore": [["box", "pair"]]})");
    auto scene = ovoid::scene::read(path);
    CHECK(scene.size() == 2 && std::string(scene.name(1)) == "pair" && scene.find("pair") == 1);
    CHECK(scene.find("none") == scene.size() && scene.is_ignored(1, 0));
    CHECK(std::string(scene.unit()) == "mm" && scene.mesh_count() == 0);
    const auto meshes =
        ovoid::scene::read(write_text("meshes.json", R"({"objects": [{"name": "a", "mesh": "mesh.obj"}]})"));
    CHECK(meshes.mesh_count() == 1 && meshes.mesh(0).convexity.kind == OVOID_MESH_SOLID && !*meshes.unit());
    const auto hulls = ovoid::scene::read_hulls(folder + "/meshes.json");
    CHECK(ovoid_scene_get(hulls.get(), 0).solid == nullptr && ovoid_scene_get(meshes.get(), 0).solid != nullptr);
    scene.write(folder + "/scene.ovoids");
    const auto packed = ovoid::scene::read(folder + "/scene.ovoids");
    CHECK(meshes.read_mesh(0).size() == 1);
    CHECK(throws(OVOID_ERROR_ARGUMENT, -1, "box: the object has no mesh", [&] { packed.read_mesh(0); }));
    CHECK(packed.size() == scene.size() && packed.is_ignored(0, 1) && std::string(packed.unit()) == "mm");
    CHECK(scene.pair_count() == ovoid_scene_get_pair_count(scene.get()));
    const ovoid::body_answer a = ovoid::distance(ovoid::body_pair(scene[0], scene[1]));
    CHECK(a.lower <= 7 && a.upper >= 7 && a.part_b == 0);
    auto world = ovoid::world::create();
    for (std::size_t i = 0; i < scene.size(); i++) world.add(scene[i]);
    CHECK_EQ(world.compute_contacts({OVOID_QUERY_WITHIN, 8}).size(), 1);

    const std::string motion_path =
        write_text("motion.csv", "time,body,x,y,z,qw,qx,qy,qz\n0,box,1,2,3,1,0,0,0\n0.5,nobody,0,0,0,1,0,0,0\n");
    auto motion = ovoid::motion_reader::open(motion_path, scene);
    ovoid_motion_line line;
    CHECK(motion.columns() == OVOID_MOTION_COLUMNS_POSE && motion.read(line) && is_vec3(line.pose.position, 1, 2, 3));
    CHECK_EQ(motion.line(), 2);
    CHECK(throws(OVOID_ERROR_FORMAT, 3, "nobody", [&] { motion.read(line); }));
    auto later = ovoid::motion_reader::open(
        write_text("later.csv", "time,body,x,y,z,qw,qx,qy,qz\n0,box,1,2,3,1,0,0,0\n1,box,4,5,6,1,0,0,0\n"), scene);
    later.skip(1);
    CHECK(later.frame_count() == 1 && later.read(line) && is_vec3(line.pose.position, 1, 2, 3));
    CHECK(later.read(line) && is_vec3(line.pose.position, 4, 5, 6) && later.frame_count() == 2);
    CHECK(throws(OVOID_ERROR_FORMAT, 3, "nobody", [&] {
        auto bad = ovoid::motion_reader::open(motion_path, scene);
        bad.skip(5);
    }));
    auto moved = std::move(scene);
    CHECK(!scene && moved.size() == 2); // NOLINT: moved from is empty
}

void check_tables() {
    const std::string header = "a,b,ax,ay,az,aqw,aqx,aqy,aqz,bx,by,bz,bqw,bqx,bqy,bqz\n";
    const std::string path = write_text("pairs.csv", header + "0,1,1,2,3,1,0,0,0,4,5,6,1,0,0,0\n");
    auto pairs = ovoid::pairs_reader::open(path, 2);
    ovoid_indexed_pair pair;
    CHECK(pairs.read(pair) && pair.b == 1 && is_vec3(pair.pose_b.position, 4, 5, 6) && !pairs.read(pair));
    auto half = ovoid::pairs_reader::open(path, 2);
    CHECK(throws(OVOID_ERROR_ARGUMENT, -1, "no part 2", [&] { half.set_part(2, 2); }));
    half.set_part(0, 2);
    half.skip(1);
    CHECK(!half.read(pair));
    auto few = ovoid::pairs_reader::open(path, 1);
    CHECK(throws(OVOID_ERROR_INDEX, 2, "pairs.csv:2", [&] { few.read(pair); }));

    const ovoid::shape ball = ovoid::shape::sphere(1);
    ovoid::zeroed<ovoid_record> record;
    record.a = "left", record.b = "right";
    record.answer = ovoid::distance({ball, ball, {}, ovoid::vec3(5, 0, 0)});
    {
        auto lost = ovoid::output::open(folder + "/lost.jsonl");
        ovoid_record_write_json(lost.file(), &record);
    }
    CHECK(throws(OVOID_ERROR_FILE, -1, "lost", [] { ovoid::results_reader::open(folder + "/lost.jsonl"); }));
    auto output = ovoid::output::open(folder + "/results.jsonl");
    CHECK(ovoid_record_write_json(output.file(), &record) == OVOID_OK);
    output.commit();
    auto results = ovoid::results_reader::open(folder + "/results.jsonl");
    ovoid_record got;
    CHECK(results.read(got) && std::string(got.b) == "right" && got.answer.lower == record.answer.lower);
    CHECK_EQ(results.line(), 1);
    CHECK(!results.read(got));
}

} // namespace

int main() {
    char path[] = "/tmp/test_hpp_io.XXXXXX";
    if (!mkdtemp(path)) return std::perror(path), 1;
    folder = path;
    check_shapes();
    check_scenes();
    check_tables();
    for (const char *name : {"mesh.obj", "hull.ovoid", "list.txt", "bad.obj", "scene.json", "scene.ovoids",
                             "meshes.json", "motion.csv", "later.csv", "pairs.csv", "results.jsonl"})
        CHECK(std::remove((folder + "/" + name).c_str()) == 0);
    CHECK(rmdir(path) == 0);
    return check_end();
}
