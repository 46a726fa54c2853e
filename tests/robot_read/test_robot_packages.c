// Where meshes are looked for, and what is said of those that are absent. Truth: folders made here.
#define _POSIX_C_SOURCE 200809L
#define FILES_FOLDER "test_packages"
#include "robot_files.h"

#include "ovoid/ovoid.h"

#include <unistd.h>

static const char tetra[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

static void make_folder(const char *name) { mkdir(file_path(name), 0777); }

// A tetrahedron of that size, so that the file that was found is known by its box.
static void write_mesh(const char *name, int size) {
    char text[200];
    snprintf(text, sizeof text, "v 0 0 0\nv %d 0 0\nv 0 1 0\nv 0 0 1\n%s", size, strchr(tetra, 'f'));
    file_write_text(name, text);
}

static void make_tree(void) {
    static const char *const folders[] = {"given",
                                          "given/m",
                                          "given/n",
                                          "ros",
                                          "ros/pack",
                                          "ros/pack/m",
                                          "ament",
                                          "ament/share",
                                          "ament/share/pack",
                                          "ament/share/pack/m",
                                          "top",
                                          "top/pack",
                                          "top/pack/m",
                                          "top/named",
                                          "top/named/urdf",
                                          "top/named/m",
                                          "top/copied",
                                          "top/copied/m",
                                          "top/copied/urdf",
                                          "top/copied/urdf/deep"};
    make_folder(".");
    for (size_t i = 0; i < sizeof folders / sizeof *folders; i++) make_folder(folders[i]);
    write_mesh("given/m/x.obj", 2);
    write_mesh("given/n/w.obj", 9);
    write_mesh("ros/pack/m/x.obj", 3);
    write_mesh("ament/share/pack/m/x.obj", 4);
    write_mesh("top/pack/m/x.obj", 5);
    write_mesh("top/named/m/x.obj", 6);
    write_mesh("top/copied/m/x.obj", 7);
    write_mesh("top/copied/m/y.obj", 8);
    file_write_text("top/named/package.xml", "<?xml version=\"1.0\"?>\n<package>\n  <name>\n  other </name></package>");
}

// Reads a robot of that file with one mesh: the size of the mesh that was found; 0: refused.
static double find(const char *urdf, const char *address, const ovoid_robot_read_options *options) {
    char text[600];
    ovoid_error error;
    snprintf(
        text, sizeof text,
        "<robot name=\"r\"><link name=\"a\"><collision><geometry><mesh filename=\"%s\"/></geometry></collision></link>"
        "</robot>",
        address);
    ovoid_robot_file *file = ovoid_robot_file_read(file_write_text(urdf, text), NULL, options, &error);
    if (!file) return 0;
    double size = ovoid_shape_get_measures(ovoid_robot_file_get_description(file).elements[0].shape).box.max.x;
    ovoid_robot_file_destroy(file);
    return size;
}

static void test_order(void) {
    ovoid_robot_read_options options = make_read_options();
    const char *deep = "top/copied/urdf/r.urdf";
    // By the folder of that name above the file.
    CHECK_EQ(find(deep, "package://pack/m/x.obj", &options), 5);
    CHECK_EQ(find(deep, "package://pack/m/./../m/x.obj", &options), 5);
    options.ament_prefix_path = file_path("ament");
    CHECK_EQ(find(deep, "package://pack/m/x.obj", &options), 4);
    char list[1200];
    snprintf(list, sizeof list, ":/nowhere:%s:", file_path("ros"));
    options.ros_package_path = list;
    CHECK_EQ(find(deep, "package://pack/m/x.obj", &options), 3);
    // A folder of the list may be the package.
    options.ament_prefix_path = "";
    snprintf(list, sizeof list, "%s", file_path("ros/pack"));
    CHECK_EQ(find(deep, "package://pack/m/x.obj", &options), 3);
    const ovoid_robot_package given[] = {{"pack", "/nowhere"}, {"pack/deep", file_path("given")}};
    options.packages = given, options.package_count = 2;
    CHECK_EQ(find(deep, "package://pack/deep/m/x.obj", &options), 2);
    // What was given counts alone.
    CHECK_EQ(find(deep, "package://pack/m/x.obj", &options), 0);
    CHECK(has_note("looked for m/x.obj in /nowhere, the folder given for pack"));
    CHECK_EQ(find(deep, "package://packet/m/x.obj", &options), 7);
}

static void test_above(void) {
    ovoid_robot_read_options options = make_read_options();
    CHECK_EQ(find("top/named/urdf/r.urdf", "package://named/m/x.obj", &options), 6); // the folder's own name
    CHECK_EQ(find("top/named/urdf/r.urdf", "package://other/m/x.obj", &options), 6); // its package.xml
    CHECK_EQ(notes.count, 0);
    // Copied without its package.
    CHECK_EQ(find("top/copied/urdf/r.urdf", "package://lost/robots/lost_description/m/y.obj", &options), 8);
    CHECK_EQ(notes.count, 1);
    CHECK(has_note("the package lost is nowhere; its meshes are taken by the ends of their paths, as "));
    // Not by the name of the file alone, and not upwards out of a folder.
    CHECK_EQ(find("top/copied/m/r.urdf", "package://lost/z/y.obj", &options), 0);
    CHECK_EQ(find("top/copied/urdf/r.urdf", "package://lost/z/../m/y.obj", &options), 8);
    CHECK_EQ(find("top/copied/m/r.urdf", "package://lost/z/../../m/y.obj", &options), 0);
    CHECK_EQ(find("top/copied/urdf/deep/r.urdf", "package://lost/z/../given/n/w.obj", &options), 0);
}

static void test_paths(void) {
    ovoid_robot_read_options options = make_read_options();
    char address[600];
    CHECK_EQ(find("top/r.urdf", "copied/m/x.obj", &options), 7);
    CHECK_EQ(find("top/named/r.urdf", "../copied/m/x.obj", &options), 7);
    CHECK_EQ(find("top/r.urdf", "file://copied/m/x.obj", &options), 7);
    snprintf(address, sizeof address, "file://%s", file_path("top/copied/m/x.obj"));
    CHECK_EQ(find("top/r.urdf", address, &options), 7);
    CHECK_EQ(find("top/r.urdf", address + 7, &options), 7);
    // A folder is no mesh.
    CHECK_EQ(find("top/r.urdf", "copied/m", &options), 0);
    CHECK_EQ(find("top/r.urdf", "file://", &options), 0);
}

// A mesh of more bytes than are read is refused before it is read: the file has no blocks.
static void test_huge(void) {
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_robot_read_options options = make_read_options();
    FILE *file = fopen(file_path("top/pack/m/huge.stl"), "wb");
    if (!file || ftruncate(fileno(file), (off_t)OVOID_FILE_SIZE_MAX + 1) != 0) {
        check_skip("no file of that size can be made here");
        if (file) fclose(file);
        return;
    }
    fclose(file);
    ovoid_robot_file *robot = ovoid_robot_file_read(
        file_write_text("top/pack/r.urdf", "<robot name=\"r\"><link name=\"a\">\n<collision><geometry>"
                                           "<mesh filename=\"package://pack/m/huge.stl\"/></geometry>"
                                           "</collision></link></robot>"),
        NULL, &options, &error);
    CHECK(!robot && error.code == OVOID_ERROR_LIMIT && error.place == 2);
    CHECK(strstr(error.message, "at most 1073741824 are read"));
    (void)remove(file_path("top/pack/m/huge.stl"));
}

static void test_all_absent_told(void) {
    static const char text[] =
        "<robot name=\"r\"><link name=\"a\">\n<collision><geometry><mesh "
        "filename=\"package://p/z.stl\"/></geometry></collision>\n"
        "<collision><geometry><mesh filename=\"b.stl\"/></geometry></collision>\n"
        "<collision><geometry><mesh filename=\"b.stl\" scale=\"2 2 2\"/></geometry></collision></link></robot>";
    ovoid_robot_read_options options = make_read_options();
    ovoid_error error = {OVOID_OK, -1, ""};
    CHECK(!read_urdf(text, &options, &error));
    CHECK_EQ(error.code, OVOID_ERROR_FILE);
    CHECK_EQ(error.place, 2);
    CHECK(strstr(error.message, "the mesh \"package://p/z.stl\" is absent, as are others"));
    CHECK(strstr(error.message, "--package NAME=DIR"));
    CHECK_EQ(notes.count, 2);
    CHECK(has_note("robot.urdf:2: the mesh package://p/z.stl is absent: looked in ROS_PACKAGE_PATH (not set), in "
                   "AMENT_PREFIX_PATH (not set), and from /"));
    CHECK(has_note("upwards for a folder p"));
    CHECK(has_note("robot.urdf:3: the mesh b.stl is absent: looked for b.stl beside the URDF"));
}

int main(void) {
    make_tree();
    test_order();
    test_above();
    test_paths();
    test_huge();
    test_all_absent_told();
    return check_end();
}
