// URDF: what is read, what is refused and how it is said. Truth: texts written here, whose content is known; the
// shapes' boxes and allowances in closed form.
#define FILES_FOLDER "test_urdf"
#include "robot_files.h"

#include "ovoid/ovoid.h"

#include <time.h>

static const char all_types[] =
    "<?xml version=\"1.0\"?>\n"
    "<robot name=\"six\">\n"
    "  <material name=\"grey\"/><gazebo/><gazebo/>\n"
    "  <link name=\"base\"><inertial/></link>\n"
    "  <link name=\"a\"/> <link name=\"b\"/> <link name=\"c\"/> <link name=\"d\"/> <link name=\"e\"/> <link "
    "name=\"f\"/>\n"
    "  <joint name=\"f1\" type=\"fixed\"><parent link=\"base\"/><child link=\"a\"/><mimic joint=\"r\"/></joint>\n"
    "  <joint name=\"r\" type=\"revolute\"><origin xyz=\"1 2 3\" rpy=\"0 0 1.5707963267948966\"/><parent link=\"a\"/>"
    "<child link=\"b\"/><axis xyz=\"0 0 2\"/><limit lower=\"-1.5\" upper=\"2\" velocity=\"3\" effort=\"9\"/></joint>\n"
    "  <joint name=\"c1\" type=\"continuous\"><parent link=\"b\"/><child link=\"c\"/><limit velocity=\"0.5\"/>"
    "<dynamics damping=\"1\"/></joint>\n"
    "  <joint name=\"p\" type=\"prismatic\"><parent link=\"c\"/><child link=\"d\"/><limit lower=\"0\" upper=\".25\"/>"
    "<mimic joint=\"r\" multiplier=\"-2\" offset=\" 0.5 \"/><origin quat_xyzw=\"0 0 2 2\"/></joint>\n"
    "  <joint name=\"pl\" type=\"planar\"><parent link=\"d\"/><child link=\"e\"/><axis xyz=\"0 1 0\"/></joint>\n"
    "  <joint name=\"fl\" type=\"floating\"><parent link=\"e\"/><child link=\"f\"/></joint>\n"
    "</robot>\n";

static void test_joints(void) {
    ovoid_robot_read_options options = make_read_options();
    ovoid_robot_file *file = read_urdf(all_types, &options, NULL);
    if (!CHECK(file)) return;
    ovoid_robot_description d = ovoid_robot_file_get_description(file);
    CHECK(strcmp(d.name, "six") == 0);
    CHECK_EQ(d.link_count, 7);
    CHECK_EQ(d.joint_count, 6);
    CHECK(strcmp(d.links[0].name, "base") == 0 && strcmp(d.links[6].name, "f") == 0);
    static const ovoid_joint_type types[6] = {OVOID_JOINT_FIXED,     OVOID_JOINT_REVOLUTE, OVOID_JOINT_CONTINUOUS,
                                              OVOID_JOINT_PRISMATIC, OVOID_JOINT_PLANAR,   OVOID_JOINT_FLOATING};
    for (uint32_t i = 0; i < 6; i++) {
        CHECK_EQ(d.joints[i].type, types[i]);
        CHECK_EQ(d.joints[i].parent, i);
        CHECK_EQ(d.joints[i].child, i + 1);
        CHECK_EQ(d.joints[i].mimic, i == 3 ? 1u : OVOID_ROBOT_NONE);
    }
    const ovoid_robot_joint *r = &d.joints[1], *p = &d.joints[3];
    CHECK_EQ(r->origin.position.x, 1);
    CHECK_EQ(r->origin.position.z, 3);
    CHECK_NEAR(r->origin.rotation.z, sqrt(0.5), 1e-15);
    CHECK_EQ(r->axis.z, 2);
    CHECK_EQ(r->axis.x, 0);
    CHECK_EQ(r->lower, -1.5);
    CHECK_EQ(r->upper, 2);
    CHECK_EQ(r->velocity, 3);
    CHECK_EQ(d.joints[2].velocity, 0.5);
    CHECK_EQ(d.joints[2].lower, -INFINITY);
    CHECK_EQ(d.joints[2].axis.x, 1); // the default
    CHECK_EQ(p->upper, 0.25);
    CHECK_EQ(p->multiplier, -2);
    CHECK_EQ(p->offset, 0.5);
    CHECK_EQ(p->origin.rotation.w, 2);
    CHECK_EQ(p->origin.rotation.z, 2);
    CHECK_EQ(p->origin.rotation.x, 0);
    CHECK_EQ(r->multiplier, 1);
    CHECK_EQ(ovoid_robot_file_get_fixed_mimic_count(file), 1);
    CHECK(has_note("robot.urdf:6: joint \"f1\" is fixed: its <mimic> has no effect"));
    CHECK_EQ(ovoid_robot_file_get_ignored_count(file), 4);
    CHECK_EQ(count_ignored(file, "robot/gazebo"), 2);
    CHECK_EQ(count_ignored(file, "robot/material"), 1);
    CHECK_EQ(count_ignored(file, "link/inertial"), 1);
    CHECK_EQ(count_ignored(file, "joint/dynamics"), 1);
    ovoid_robot *robot = ovoid_robot_create(&d, NULL, NULL);
    CHECK(robot && ovoid_robot_get_variable_count(robot) == 1 + 1 + 3 + 7);
    ovoid_robot_destroy(robot);
    ovoid_robot_file_destroy(file);
}

// ---- geometry

#define COLLISION(geometry) "<collision><geometry>" geometry "</geometry></collision>"

static ovoid_box get_box(const ovoid_shape *shape) { return ovoid_shape_get_measures(shape).box; }

static void test_primitives(void) {
    static const char text[] =
        "<robot name=\"p\"><link name=\"a\">"
        "<collision name=\"first\"><origin xyz=\"0 0 1\"/><geometry><box size=\"2 4 6\"/></geometry></collision>" //
        COLLISION("<sphere radius=\"0.5\"/>") COLLISION("<cylinder radius=\"2\" length=\"3\"/>")
            COLLISION("<capsule radius=\"0.25\" length=\"2\"/>") COLLISION("<box size=\"2 4 6\"/>") //
        "<visual/></link></robot>";
    ovoid_robot_read_options options = make_read_options();
    options.tolerance = 0.125;
    ovoid_robot_file *file = read_urdf(text, &options, NULL);
    if (!CHECK(file)) return;
    ovoid_robot_description d = ovoid_robot_file_get_description(file);
    const ovoid_robot_element *e = d.elements;
    if (!CHECK_EQ(d.element_count, 5)) return;
    CHECK(strcmp(e[0].name, "first") == 0 && !e[1].name);
    CHECK_EQ(e[0].pose.position.z, 1);
    CHECK_EQ(get_box(e[0].shape).max.x, 1);
    CHECK_EQ(get_box(e[0].shape).max.y, 2);
    CHECK_EQ(get_box(e[0].shape).min.z, -3);
    CHECK_EQ(ovoid_shape_get_radius(e[1].shape), 0.5);
    // The true cylinder: inscribed, its allowance within the tolerance and not zero; as long as it is.
    ovoid_allowance allowance = ovoid_shape_get_allowance(e[2].shape);
    CHECK(allowance.outside > 0.02 && allowance.outside <= 0.125); // 0.01 without the option
    CHECK_EQ(get_box(e[2].shape).max.z, 1.5);
    CHECK_EQ(ovoid_shape_get_radius(e[3].shape), 0.25);
    CHECK_EQ(get_box(e[3].shape).max.z, 1);
    CHECK(e[4].shape == e[0].shape); // made once
    CHECK_EQ(count_ignored(file, "link/visual"), 1);
    ovoid_robot_file_destroy(file);
}

static void test_visual(void) {
    static const char text[] =
        "<robot name=\"v\"><link name=\"a\"><visual><geometry><box size=\"1 1 "
        "1\"/></geometry><material/></visual></link>"
        "<link name=\"b\"><visual><geometry><mesh filename=\"absent.stl\"/></geometry></visual>" //
        COLLISION(
            "<sphere radius=\"1\"/>") "</link><joint name=\"j\" type=\"fixed\"><parent link=\"a\"/><child link=\"b\"/>"
                                      "</joint></robot>";
    ovoid_robot_read_options options = make_read_options();
    for (int visual = 0; visual < 2; visual++) {
        options.visual = visual;
        ovoid_robot_file *file = read_urdf(text, &options, NULL);
        if (!CHECK(file)) continue;
        ovoid_robot_description d = ovoid_robot_file_get_description(file);
        CHECK_EQ(d.element_count, 1 + visual);
        CHECK_EQ(d.elements[0].link, visual ? 0u : 1u);
        CHECK_EQ(count_ignored(file, "link/visual"), visual ? 1u : 2u);
        ovoid_robot_file_destroy(file);
    }
}

// An L of two boxes, each an object: 3/4 of its hull's box less a corner; the hull has 7/8.
static const char l_shape[] = "o low\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nv 0 0 1\nv 2 0 1\nv 2 1 1\nv 0 1 1\n"
                              "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"
                              "o high\nv 0 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 1 1\nv 1 1 1\nv 1 2 1\nv 0 2 1\n"
                              "f 12 11 10 9\nf 13 14 15 16\nf 9 10 14 13\nf 10 11 15 14\nf 11 12 16 15\nf 12 9 13 16\n";

// A closed mesh that is not its hull is a solid, of each scale one, mirrored or not, an open one a surface; objects
// that are parts are hulls, and so is what is asked for as hulls.
static void test_solids(void) {
    static const char text[] = "<robot name=\"m\"><link name=\"a\">" //
        COLLISION("<mesh filename=\"l.obj\"/>") COLLISION("<mesh filename=\"l.obj\" scale=\"1 -2 0.5\"/>")
            COLLISION("<mesh filename=\"l.obj\" scale=\"1 -2 0.5\"/>") COLLISION("<mesh filename=\"box.obj\"/>")
                COLLISION("<mesh filename=\"open.obj\"/>") "</link></robot>";
    static const char bent[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0.3 0.3 0.3\n"; // the last one is in the hull
    char open[256];
    snprintf(open, sizeof open, "%sf 1 3 2\nf 1 2 5\nf 1 5 3\nf 2 3 4\nf 1 4 2\n", bent);
    file_write_text("l.obj", l_shape);
    file_write_text("open.obj", open);
    file_write_text("box.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    ovoid_robot_read_options options = make_read_options();
    for (options.parts = 0; options.parts < 2; options.parts++) {
        ovoid_robot_file *file = read_urdf(text, &options, NULL);
        if (!CHECK(file)) continue;
        ovoid_robot_description d = ovoid_robot_file_get_description(file);
        size_t solids = 0;
        for (size_t i = 0; i < d.element_count; i++) solids += d.elements[i].solid != NULL;
        CHECK_EQ(solids, options.parts ? 0 : 4);
        if (!options.parts && CHECK_EQ(d.element_count, 5)) {
            const ovoid_solid *own = d.elements[0].solid, *scaled = d.elements[1].solid;
            CHECK(own != scaled && scaled == d.elements[2].solid && !d.elements[3].solid);
            CHECK(!ovoid_solid_get_report(d.elements[4].solid).is_closed);
            CHECK(notes.count == 1 && has_note("the mesh open.obj is not closed, "));
            CHECK_EQ(ovoid_solid_get_report(own).volume, 3);
            CHECK_EQ(fabs(ovoid_solid_get_report(scaled).volume), 3); // twice as wide, half as high
            CHECK_EQ(ovoid_solid_get_report(scaled).box.min.y, -4);
            CHECK_EQ(get_box(d.elements[1].shape).min.y, -4);
        }
        size_t said = 0;
        for (size_t i = 0; i < ovoid_robot_file_get_mesh_count(file); i++)
            said |= (size_t)1 << 4 * ovoid_robot_file_get_mesh(file, i).kind;
        CHECK_EQ(said, options.parts ? (size_t)0x10 : (size_t)0x1101); // parts; hull, solid and surface
        ovoid_robot_file_destroy(file);
    }
    options = make_read_options();
    options.hull = 1;
    ovoid_robot_file *file = read_urdf(text, &options, NULL);
    if (CHECK(file)) CHECK(!ovoid_robot_file_get_description(file).elements[0].solid);
    if (file) CHECK_EQ(ovoid_robot_file_get_mesh(file, 0).kind, OVOID_MESH_HULL);
    CHECK_EQ(notes.count, 0);
    ovoid_robot_file_destroy(file);
}

static void test_meshes(void) {
    static const char text[] = "<robot name=\"m\"><link name=\"a\">" //
        COLLISION("<mesh filename=\"l.obj\"/>") COLLISION("<mesh filename=\"l.obj\" scale=\"1 -2 0.5\"/>")
            COLLISION("<mesh filename=\"./l.obj\" scale=\"1 1 1\"/>") "</link></robot>";
    file_write_text("l.obj", l_shape);
    ovoid_robot_read_options options = make_read_options();
    for (int parts = 0; parts < 2; parts++) {
        options.parts = parts;
        ovoid_robot_file *file = read_urdf(text, &options, NULL);
        if (!CHECK(file)) continue;
        ovoid_robot_description d = ovoid_robot_file_get_description(file);
        size_t each = parts ? 2 : 1;
        CHECK_EQ(d.element_count, 3 * each);
        // Two paths to the file are two meshes; of each path and scale one.
        CHECK_EQ(ovoid_robot_file_get_mesh_count(file), 3);
        const ovoid_shape *mirrored = d.elements[each].shape;
        CHECK_EQ(get_box(mirrored).min.y, parts ? -2 : -4);
        CHECK_EQ(get_box(mirrored).max.y, 0);
        CHECK_EQ(get_box(mirrored).max.z, 0.5);
        if (parts) CHECK(strcmp(d.elements[0].name, "low") == 0 && strcmp(d.elements[1].name, "high") == 0);
        for (size_t i = 0; i < 3; i++) {
            ovoid_robot_mesh mesh = ovoid_robot_file_get_mesh(file, i);
            double volume = mesh.scale.y == -2 ? 1 : 1;
            CHECK_EQ(mesh.part_count, each);
            CHECK_EQ(mesh.use_count, 1);
            CHECK_EQ(mesh.convexity.kind, parts ? OVOID_MESH_HULL : OVOID_MESH_SOLID);
            CHECK_NEAR(mesh.convexity.hull_volume, (parts ? 3 : 3.5) * volume, 1e-12);
            CHECK_NEAR(mesh.convexity.mesh_volume, 3 * volume, 1e-12);
        }
        ovoid_robot_file_destroy(file);
    }
}

// ---- refusals

#define ROBOT(content) "<robot name=\"x\">\n" content "\n</robot>\n"
#define LINKS "<link name=\"a\"/><link name=\"b\"/>\n"
#define ENDS "<parent link=\"a\"/><child link=\"b\"/>"
#define JOINT(type, content) ROBOT(LINKS "<joint name=\"j\" type=\"" type "\">" ENDS content "</joint>")
#define SHAPE(content) ROBOT("<link name=\"a\">\n" COLLISION(content) "</link>")

static const bad_input refusals[] = {
    {"empty.urdf", "", -1, "empty", OVOID_ERROR_EMPTY},
    {"no_xml.urdf", "robot", 1, "XML: "},
    {"cut.urdf", "<robot name=\"x\">\n<link name=\"a\">", 2, "XML: no element found"},
    {"root.urdf", "<robots/>", 1, "the root of a URDF is <robot>, not <robots>"},
    {"sdf.urdf", "<sdf version=\"1.6\"/>", 1, "SDF"},
    {"srdf.urdf", ROBOT("<group name=\"g\"/>"), 1, "this is an SRDF", OVOID_ERROR_EMPTY},
    {"none.urdf", ROBOT(""), 1, "the robot has no links", OVOID_ERROR_EMPTY},
    {"xacro.urdf", ROBOT("<xacro:include filename=\"y\"/>"), 2, "\"xacro FILE > robot.urdf\""},
    {"dollar.urdf", ROBOT("<link name=\"${prefix}a\"/>"), 2, "\"xacro FILE > robot.urdf\""},
    {"find.urdf", SHAPE("<mesh filename=\"$(find p)/x.stl\"/>"), 3, "\"xacro FILE > robot.urdf\""},
    {"laughs.urdf",
     "<!DOCTYPE robot [<!ENTITY a \"ha\">\n<!ENTITY b \"&a;&a;\">]>\n<robot name=\"&b;\"><link name=\"a\"/></robot>", 1,
     "entities are not read"},
    {"external.urdf", "<!DOCTYPE robot SYSTEM \"x.dtd\">\n<robot><link name=\"&b;\"/></robot>", 2, ""},
    {"deep.urdf",
     "<robot><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><"
     "a>"
     "<a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a>",
     1, "nested more than 64 deep", OVOID_ERROR_LIMIT},
    {"nameless.urdf", ROBOT("<link/>"), 2, "<link> needs name=\"...\""},
    {"twice.urdf", ROBOT("<link name=\"a\"/>\n<link name=\"a\"/>"), 3,
     "link \"a\": the name is that of the link of line 2 too"},
    {"joint_twice.urdf",
     ROBOT("<link name=\"a\"/><link name=\"b\"/><link name=\"c\"/>\n<joint name=\"j\" type=\"fixed\">" ENDS "</joint>\n"
           "<joint name=\"j\" type=\"fixed\"><parent link=\"a\"/><child link=\"c\"/></joint>"),
     4, "joint \"j\": the name is that of the joint of line 3 too"},
    {"roots.urdf", ROBOT("<link name=\"a\"/>\n<link name=\"b\"/>"), 3,
     "link \"b\": is no joint's child, nor is the link \"a\" (line 2)"},
    {"loop.urdf",
     ROBOT(LINKS "<joint name=\"j\" type=\"fixed\">" ENDS "</joint>\n"
                 "<joint name=\"k\" type=\"fixed\"><parent link=\"b\"/><child link=\"a\"/></joint>"),
     4, "closes a loop"},
    {"side_loop.urdf",
     ROBOT("<link name=\"r\"/>" LINKS "<joint name=\"j\" type=\"fixed\">" ENDS "</joint>\n"
           "<joint name=\"k\" type=\"fixed\"><parent link=\"b\"/><child link=\"a\"/></joint>"),
     4, "joint \"k\": closes a loop: the link \"a\" would hang on itself"},
    {"itself.urdf", ROBOT(LINKS "<joint name=\"j\" type=\"fixed\"><parent link=\"b\"/><child link=\"b\"/></joint>"), 3,
     "joint \"j\": joins the link \"b\" with itself"},
    {"parents.urdf",
     ROBOT(LINKS "<link name=\"c\"/><joint name=\"j\" type=\"fixed\">" ENDS "</joint>\n"
                 "<joint name=\"k\" type=\"fixed\"><parent link=\"c\"/><child link=\"b\"/></joint>"),
     4, "its child, the link \"b\", is that of the joint \"j\" (line 3) too"},
    {"type.urdf", JOINT("screw", ""), 3, "its type is \"screw\", not one of revolute"},
    {"typeless.urdf", ROBOT(LINKS "<joint name=\"j\">" ENDS "</joint>"), 3, "needs type="},
    {"parent.urdf", ROBOT("<link name=\"b\"/><joint name=\"j\" type=\"fixed\">" ENDS "</joint>"), 2,
     "joint \"j\": its parent, the link \"a\", is not there"},
    {"childless.urdf", ROBOT(LINKS "<joint name=\"j\" type=\"fixed\"><parent link=\"a\"/></joint>"), 3,
     "needs a <child link=\"...\"/>"},
    {"unlimited.urdf", JOINT("revolute", ""), 3, "a revolute joint needs a <limit lower="},
    {"slider.urdf", JOINT("prismatic", ""), 3, "a prismatic joint needs a <limit lower="},
    {"upside_down.urdf", JOINT("revolute", "\n<limit lower=\"1\" upper=\"-1\"/>"), 4,
     "joint \"j\": lower, 1, is above upper, -1"},
    {"nan.urdf", JOINT("revolute", "<limit lower=\"nan\" upper=\"1\"/>"), 3, "is not finite", OVOID_ERROR_NOT_FINITE},
    {"inf.urdf", JOINT("fixed", "<origin xyz=\"0 inf 0\"/>"), 3, "is not finite", OVOID_ERROR_NOT_FINITE},
    {"huge.urdf", JOINT("fixed", "<origin xyz=\"0 1e51 0\"/>"), 3, "a number above 1e+50", OVOID_ERROR_RANGE},
    {"two_numbers.urdf", JOINT("fixed", "<origin xyz=\"0 1\"/>"), 3, "must be three numbers"},
    {"joined.urdf", JOINT("fixed", "<origin xyz=\"1-2 3\"/>"), 3, "must be three numbers"},
    {"four_numbers.urdf", JOINT("fixed", "<origin xyz=\"0 1 2 3\"/>"), 3, "must be three numbers"},
    {"trailing.urdf", JOINT("revolute", "<limit lower=\"1m\" upper=\"2\"/>"), 3, "must be a number"},
    {"comma.urdf", JOINT("fixed", "<origin xyz=\"0,1,2\"/>"), 3, "with blanks between"},
    {"origins.urdf", JOINT("fixed", "<origin/>\n<origin/>"), 4, "<joint> has a second <origin>"},
    {"turns.urdf", JOINT("fixed", "<origin rpy=\"0 0 0\" quat_xyzw=\"0 0 0 1\"/>"), 3, "has both"},
    {"quat.urdf", JOINT("fixed", "<origin quat_xyzw=\"0 0 0 0\"/>"), 3, "four zeros", OVOID_ERROR_ROTATION},
    {"axis.urdf", JOINT("continuous", "\n<axis xyz=\"0 0 0\"/>"), 4, "its axis is zero", OVOID_ERROR_ROTATION},
    {"mimic.urdf", JOINT("continuous", "<mimic joint=\"k\"/>"), 3, "the joint \"k\", which is not there"},
    {"mimic_itself.urdf", JOINT("continuous", "\n<mimic joint=\"j\"/>"), 4, "joint \"j\": mimics itself"},
    {"mimic_floating.urdf", JOINT("floating", "<mimic joint=\"j\"/>"), 3, "mimics itself"},
    {"mimic_fixed.urdf",
     ROBOT(LINKS
           "<link name=\"c\"/><joint name=\"j\" type=\"fixed\">" ENDS "</joint>\n"
           "<joint name=\"k\" type=\"continuous\"><parent link=\"b\"/><child link=\"c\"/><mimic joint=\"j\"/></joint>"),
     4, "mimics the joint \"j\", which is fixed"},
    {"mimic_ring.urdf",
     ROBOT(LINKS
           "<link name=\"c\"/><joint name=\"j\" type=\"continuous\">" ENDS "<mimic joint=\"k\"/></joint>\n"
           "<joint name=\"k\" type=\"continuous\"><parent link=\"b\"/><child link=\"c\"/><mimic joint=\"j\"/></joint>"),
     3, "mimics itself by way of"},
    {"bare.urdf", ROBOT("<link name=\"a\"><collision/></link>"), 2, "<collision> needs a <geometry>"},
    {"hollow.urdf", SHAPE(""), 3, "<collision> needs a <geometry>"},
    {"shapes.urdf", SHAPE("<box size=\"1 1 1\"/><sphere radius=\"1\"/>"), 3, "more than one shape"},
    {"plane.urdf", SHAPE("<plane/>"), 3, "link \"a\": <plane> is no geometry"},
    {"box.urdf", SHAPE("<box/>"), 3, "<box> needs size="},
    {"flat.urdf", SHAPE("<box size=\"1 -1 1\"/>"), 3, "below zero", OVOID_ERROR_RADIUS},
    {"radius.urdf", SHAPE("<sphere radius=\"-1\"/>"), 3, "below zero", OVOID_ERROR_RADIUS},
    {"length.urdf", SHAPE("<cylinder radius=\"1\"/>"), 3, "<cylinder> needs length="},
    {"far.urdf", SHAPE("<sphere radius=\"1e60\"/>"), 3, "link \"a\"", OVOID_ERROR_RANGE},
    {"mesh.urdf", SHAPE("<mesh/>"), 3, "<mesh> needs filename="},
    {"scale.urdf", SHAPE("<mesh filename=\"l.obj\" scale=\"1 0 1\"/>"), 3, "a factor of zero"},
    {"one_scale.urdf", SHAPE("<mesh filename=\"l.obj\" scale=\"2\"/>"), 3, "three numbers"},
    {"http.urdf", SHAPE("<mesh filename=\"http://x/l.obj\"/>"), 3, "neither package://NAME/PATH"},
    {"package.urdf", SHAPE("<mesh filename=\"package://p\"/>"), 3, "neither package://NAME/PATH"},
    {"up.urdf", SHAPE("<mesh filename=\"package://p/a/../../l.obj\"/>"), 3, "leaves its package"},
    {"up_name.urdf", SHAPE("<mesh filename=\"package://../l.obj\"/>"), 3, "leaves its package"},
    {"absent.urdf", SHAPE("<mesh filename=\"absent.stl\"/>"), 3, "the mesh \"absent.stl\" is absent", OVOID_ERROR_FILE},
    {"no_mesh.urdf", SHAPE("<mesh filename=\"robot.urdf\"/>"), 3, "robot.urdf"},
};

// It is refused without a place for the error as well.
static int accepts(const char *path, ovoid_error *error) {
    ovoid_robot_read_options options = make_read_options();
    ovoid_robot_file *file = ovoid_robot_file_read(path, NULL, &options, error);
    ovoid_robot_file *again = ovoid_robot_file_read(path, NULL, &options, NULL);
    CHECK(!again);
    ovoid_robot_file_destroy(file);
    ovoid_robot_file_destroy(again);
    return file != NULL;
}

static void test_refusals(void) {
    file_write_text("l.obj", l_shape);
    file_write_text("robot.urdf", "<robot/>");
    check_bad_inputs(refusals, sizeof refusals / sizeof *refusals, accepts);
}

static void test_options(void) {
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_shape_options round = {.radius = 1};
    ovoid_robot_package nameless = {"", "."};
    const ovoid_robot_read_options bad[] = {
        {.shape = &round}, {.tolerance = -1}, {.tolerance = NAN}, {.packages = &nameless, .package_count = 1}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        CHECK(!read_urdf(all_types, &bad[i], &error));
        CHECK_EQ(error.code, OVOID_ERROR_ARGUMENT);
    }
    CHECK(!ovoid_robot_file_read(file_path("is_not_there.urdf"), NULL, NULL, &error));
    CHECK_EQ(error.code, OVOID_ERROR_FILE);
    ovoid_robot_file_destroy(NULL);
}

// Old files keep the name space of xacro after they were expanded.
static void test_expanded_xacro(void) {
    ovoid_robot_file *file =
        read_urdf("<robot name=\"x\" xmlns:xacro=\"http://ros.org/wiki/xacro\"><link name=\"a\"/></robot>", NULL, NULL);
    CHECK(file);
    ovoid_robot_file_destroy(file);
}

static void test_no_limits_given(void) {
    ovoid_robot_read_options options = make_read_options();
    ovoid_robot_file *file = read_urdf(JOINT("revolute", "<limit effort=\"1\"/>"), &options, NULL);
    if (!CHECK(file)) return;
    CHECK_EQ(ovoid_robot_file_get_description(file).joints[0].upper, 0);
    CHECK(has_note("robot.urdf:3: the limits of joint \"j\" have no lower and no upper: 0 by default"));
    ovoid_robot_file_destroy(file);
}

// ---- scales

static void test_scales(void) {
    static const char text[] = "<robot name=\"s\"><link name=\"a\">" COLLISION("<box size=\"2 4 6\"/>") COLLISION(
        "<mesh filename=\"l.obj\" scale=\"1 -2 0.5\"/>") "</link><link name=\"b\">"
                                                         "<collision><origin xyz=\"1 0 0\"/><geometry><capsule "
                                                         "radius=\"0.5\" length=\"4\"/></geometry></collision>"
                                                         "</link><joint name=\"j\" type=\"fixed\"><parent "
                                                         "link=\"a\"/><child link=\"b\"/></joint></robot>";
    file_write_text("l.obj", l_shape);
    ovoid_robot_link_scale scales[] = {{"a", 1.5}, {NULL, 2}, {"c", 1}};
    ovoid_robot_read_options options = make_read_options();
    options.scales = scales, options.scale_count = 2;
    ovoid_robot_file *file = read_urdf(text, &options, NULL);
    if (!CHECK(file)) return;
    const ovoid_robot_element *e = ovoid_robot_file_get_description(file).elements;
    CHECK_EQ(get_box(e[0].shape).max.x, 1.5);
    CHECK_EQ(get_box(e[0].shape).max.z, 4.5);
    CHECK_EQ(get_box(e[1].shape).min.y, -6);
    CHECK_EQ(get_box(e[1].shape).max.z, 0.75);
    CHECK_EQ(ovoid_robot_file_get_mesh(file, 0).scale.y, -3);
    CHECK_EQ(ovoid_shape_get_radius(e[2].shape), 1);
    CHECK_EQ(get_box(e[2].shape).max.z, 4);
    CHECK_EQ(e[2].pose.position.x, 1); // about the element's origin
    ovoid_robot_file_destroy(file);
    ovoid_error error;
    options.scale_count = 3;
    CHECK(!read_urdf(text, &options, &error) && error.code == OVOID_ERROR_ARGUMENT);
    CHECK(strstr(error.message, "there is no link \"c\" to scale"));
    scales[2].link = "a";
    CHECK(!read_urdf(text, &options, &error) && strstr(error.message, "there are two scales of link a"));
    scales[2].link = NULL;
    CHECK(!read_urdf(text, &options, &error) && strstr(error.message, "there are two scales of all links"));
    static const double wrong[] = {0, -1, INFINITY, NAN};
    for (int i = 0; i < 4; i++) {
        scales[1].factor = wrong[i], options.scale_count = 2;
        CHECK(!read_urdf(text, &options, &error) && error.code == OVOID_ERROR_ARGUMENT);
    }
}

// An attribute without effect, here one that is misspelt, is counted.
static void test_attributes(void) {
    ovoid_robot_read_options options = make_read_options();
    ovoid_robot_file *file =
        read_urdf(JOINT("revolute", "<limit lower=\"-1\" uper=\"2\"/><dynamics friction=\"1\"/>"), &options, NULL);
    if (!CHECK(file)) return;
    CHECK_EQ(ovoid_robot_file_get_description(file).joints[0].upper, 0);
    CHECK(has_note("the limits of joint \"j\" have no upper: 0 by default"));
    CHECK_EQ(count_ignored(file, "limit@uper"), 1);
    CHECK_EQ(ovoid_robot_file_get_ignored_count(file), 2);
    ovoid_robot_file_destroy(file);
}

// ---- size

// A chain of that many links, each with a box; the seconds that reading takes.
static double time_chain(size_t count) {
    size_t room = count * 400 + 100, used = 0;
    char *text = malloc(room);
    if (!CHECK(text)) return 0;
    used += (size_t)snprintf(text, room, "<robot name=\"long\">\n");
    for (size_t i = 0; i < count; i++)
        used += (size_t)snprintf(text + used, room - used,
                                 "<link name=\"l%zu\">" COLLISION("<box size=\"1 1 1\"/>") "</link>\n", count - i);
    for (size_t i = 1; i < count; i++)
        used +=
            (size_t)snprintf(text + used, room - used,
                             "<joint name=\"j%zu\" type=\"continuous\"><parent link=\"l%zu\"/><child link=\"l%zu\"/>%s"
                             "</joint>\n",
                             i, i, i + 1, i > 1 ? "<mimic joint=\"j1\"/>" : "");
    snprintf(text + used, room - used, "</robot>\n");
    clock_t start = clock();
    ovoid_robot_file *file = read_urdf(text, NULL, NULL);
    double seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
    CHECK(file && ovoid_robot_file_get_description(file).link_count == count);
    ovoid_robot_file_destroy(file);
    free(text);
    return seconds;
}

static void test_long_chain(void) {
    double small = time_chain(10000), large = time_chain(100000);
    // Linear would be 10 times; quadratic 100.
    if (!CHECK_LE(large, 30 * small + 1)) printf("  10^4 links: %g s, 10^5: %g s\n", small, large);
}

int main(void) {
    test_joints();
    test_primitives();
    test_visual();
    test_meshes();
    test_solids();
    test_refusals();
    test_options();
    test_expanded_xacro();
    test_no_limits_given();
    test_scales();
    test_attributes();
    test_long_chain();
    return check_end();
}
