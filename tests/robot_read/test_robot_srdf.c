// SRDF: pairs, groups, states, spheres, virtual joints; names that are not there. Truth: a robot written here, whose
// groups can be counted by hand.
#define FILES_FOLDER "test_srdf"
#include "robot_files.h"

#include "ovoid/ovoid.h"

// base - a - b - c and base - d; all joints turn but that of d.
static const char urdf[] =
    "<robot name=\"r\"><link name=\"base\"/><link name=\"a\"/><link name=\"b\"/><link name=\"c\"/><link name=\"d\"/>"
    "<joint name=\"ja\" type=\"continuous\"><parent link=\"base\"/><child link=\"a\"/></joint>"
    "<joint name=\"jb\" type=\"continuous\"><parent link=\"a\"/><child link=\"b\"/></joint>"
    "<joint name=\"jc\" type=\"continuous\"><parent link=\"b\"/><child link=\"c\"/></joint>"
    "<joint name=\"jd\" type=\"fixed\"><parent link=\"base\"/><child link=\"d\"/></joint></robot>";

enum { BASE, A, B, C, D };

#define SRDF(content) "<robot name=\"r\">\n" content "\n</robot>\n"

static int is_group(const ovoid_robot_file *file, size_t i, const char *name, uint32_t joints, uint32_t links) {
    ovoid_robot_group g = ovoid_robot_file_get_group(file, i);
    uint32_t own_joints = 0, own_links = 0;
    for (size_t k = 0; k < g.joint_count; k++) own_joints |= 1u << g.joints[k];
    for (size_t k = 0; k < g.link_count; k++) own_links |= 1u << g.links[k];
    // Each once.
    int each_once = 1;
    for (size_t k = 1; k < g.joint_count; k++) each_once &= g.joints[k - 1] < g.joints[k];
    for (size_t k = 1; k < g.link_count; k++) each_once &= g.links[k - 1] < g.links[k];
    int good = strcmp(g.name, name) == 0 && own_joints == joints && own_links == links && each_once;
    if (!good) printf("  %s: joints %x, links %x\n", g.name, own_joints, own_links);
    return good;
}

static void test_groups(void) {
    ovoid_robot_read_options options = make_read_options();
    ovoid_robot_file *file = read_both(urdf,
                                       SRDF("<group name=\"all\"><group name=\"arm\"/><link name=\"d\"/></group>"
                                            "<group name=\"arm\"><chain base_link=\"base\" tip_link=\"c\"/></group>"
                                            "<group name=\"some\"><joint name=\"jb\"/><joint name=\"jb\"/></group>"
                                            "<group name=\"across\"><chain base_link=\"d\" tip_link=\"a\"/></group>"
                                            "<group name=\"point\"><chain base_link=\"b\" tip_link=\"b\"/></group>"
                                            "<group name=\"none\"/>"),
                                       &options, NULL);
    if (!CHECK(file)) return;
    CHECK_EQ(ovoid_robot_file_get_group_count(file), 6);
    CHECK(is_group(file, 0, "all", 0xf, 1 << BASE | 1 << A | 1 << B | 1 << C | 1 << D));
    CHECK(is_group(file, 1, "arm", 0x7, 1 << BASE | 1 << A | 1 << B | 1 << C));
    CHECK(is_group(file, 2, "some", 0x2, 1 << B));
    CHECK(is_group(file, 3, "across", 0x9, 1 << BASE | 1 << A | 1 << D));
    CHECK(is_group(file, 4, "point", 0, 1 << B));
    CHECK(is_group(file, 5, "none", 0, 0));
    CHECK_EQ(notes.count, 0);
    ovoid_robot_file_destroy(file);
}

static int has_pair(const ovoid_robot_file *file, uint32_t a, uint32_t b) {
    ovoid_robot_description d = ovoid_robot_file_get_description(file);
    int found = 0;
    for (size_t i = 0; i < d.disabled_count; i++) found += d.disabled[i].a == a && d.disabled[i].b == b;
    return found;
}

// As MoveIt 2 has it: all pairs of a, less those that are enabled, and those that are named, which count last.
static void test_defaults(void) {
    ovoid_robot_read_options options = make_read_options();
    ovoid_robot_file *file = read_both(urdf,
                                       SRDF("<disable_default_collisions link=\"a\"/>"
                                            "<enable_collisions link1=\"c\" link2=\"a\"/>"
                                            "<enable_collisions link1=\"a\" link2=\"d\"/>"
                                            "<disable_collisions link1=\"a\" link2=\"d\" reason=\"User\"/>"
                                            "<disable_collisions link1=\"b\" link2=\"c\" reason=\"Adjacent\"/>"
                                            "<disable_default_collisions link=\"other\"/>"),
                                       &options, NULL);
    if (!CHECK(file)) return;
    CHECK_EQ(ovoid_robot_file_get_description(file).disabled_count, 4);
    CHECK(has_pair(file, BASE, A) == 1 && has_pair(file, A, B) == 1 && has_pair(file, A, C) == 0);
    CHECK(has_pair(file, A, D) == 1 && has_pair(file, B, C) == 1);
    CHECK(notes.count == 1 && has_note("other"));
    ovoid_robot_file_destroy(file);
}

static void test_pairs(void) {
    ovoid_robot_read_options options = make_read_options();
    ovoid_robot_file *file = read_both(
        urdf,
        SRDF("<disable_collisions link1=\"b\" link2=\"a\" reason=\"Adjacent\"/>\n"
             "<disable_collisions link1=\"d\" link2=\"base\"/>\n<disable_collisions link1=\"a\" link2=\"b\"/>\n"
             "<disable_collisions link1=\"a\" link2=\"x\"/>\n<disable_collisions link1=\"x\" link2=\"b\"/>\n"
             "<disable_collisions link1=\"c\" link2=\"c\"/>"),
        &options, NULL);
    if (!CHECK(file)) return;
    ovoid_robot_description d = ovoid_robot_file_get_description(file);
    if (CHECK_EQ(d.disabled_count, 2)) {
        CHECK(d.disabled[0].a == BASE && d.disabled[0].b == D && !d.disabled[0].reason);
        CHECK(d.disabled[1].a == A && d.disabled[1].b == B);
    }
    CHECK_EQ(notes.count, 2);
    CHECK(has_note("robot.srdf:5: there is no link x; all 2 places that name it are passed over"));
    CHECK(has_note("robot.srdf:7: <disable_collisions> names the link c twice"));
    ovoid_robot_file_destroy(file);
}

static const char base_and_state[] =
    SRDF("<virtual_joint name=\"free\" type=\"floating\" parent_frame=\"world\" child_link=\"base\"/>"
         "<group_state name=\"up\" group=\"arm\"><joint name=\"ja\" value=\"1.5\"/>"
         "<joint name=\"free\" value=\"1 2 3 0.1 0.2 0.3 0.9\"/></group_state>"
         "<passive_joint name=\"jc\"/><end_effector name=\"e\"/>"
         "<link_sphere_approximation link=\"c\"><sphere center=\"1 2 3\" radius=\"0.5\"/>"
         "<sphere center=\"0 0 0\" radius=\"0\"/></link_sphere_approximation>");

static void test_base(void) {
    ovoid_robot_read_options options = make_read_options();
    ovoid_robot_file *file = read_both(urdf, base_and_state, &options, NULL);
    if (!CHECK(file)) return;
    ovoid_robot_description d = ovoid_robot_file_get_description(file);
    CHECK_EQ(d.link_count, 6);
    CHECK_EQ(d.joint_count, 5);
    CHECK(strcmp(d.links[5].name, "world") == 0 && strcmp(d.joints[4].name, "free") == 0);
    CHECK(d.joints[4].type == OVOID_JOINT_FLOATING && d.joints[4].parent == 5 && d.joints[4].child == BASE);
    ovoid_robot *robot = ovoid_robot_create(&d, NULL, NULL);
    CHECK(robot && ovoid_robot_get_root(robot) == 5);
    ovoid_robot_destroy(robot);
    ovoid_robot_state state = ovoid_robot_file_get_state(file, 0);
    if (CHECK_EQ(state.value_count, 2)) {
        const double *v = state.values[1].values;
        CHECK(state.values[0].count == 1 && state.values[0].values[0] == 1.5);
        CHECK(state.values[1].joint == 4 && state.values[1].count == 7);
        // x y z, then w x y z of what the file has as x y z w.
        CHECK(v[2] == 3 && v[3] == 0.9 && v[4] == 0.1 && v[5] == 0.2 && v[6] == 0.3);
    }
    size_t count;
    const ovoid_robot_link_sphere *spheres = ovoid_robot_file_get_spheres(file, &count);
    CHECK(count == 1 && spheres[0].link == C && spheres[0].ball.center.y == 2 && spheres[0].ball.radius == 0.5);
    const uint32_t *passive = ovoid_robot_file_get_passive(file, &count);
    CHECK(count == 1 && passive[0] == 2);
    CHECK_EQ(ovoid_robot_file_get_end_effector_count(file), 0);
    CHECK_EQ(notes.count, 1);
    CHECK(has_note("<end_effector> has no group; it is passed over"));
    ovoid_robot_file_destroy(file);
}

static void test_end_effectors(void) {
    static const char text[] = SRDF(
        "<end_effector name=\"late\" group=\"two\" parent_link=\"b\"/><group name=\"one\"><link name=\"a\"/></group>"
        "<group name=\"two\"><link name=\"c\"/></group><end_effector name=\"e\" group=\"one\" parent_link=\"c\"/>"
        "<end_effector name=\"x\" group=\"three\" parent_link=\"c\"/><end_effector name=\"y\" group=\"one\" "
        "parent_link=\"z\"/>");
    ovoid_robot_read_options options = make_read_options();
    ovoid_robot_file *file = read_both(urdf, text, &options, NULL);
    if (!CHECK(file)) return;
    if (CHECK_EQ(ovoid_robot_file_get_end_effector_count(file), 2)) {
        ovoid_robot_end_effector late = ovoid_robot_file_get_end_effector(file, 0);
        ovoid_robot_end_effector e = ovoid_robot_file_get_end_effector(file, 1);
        CHECK(strcmp(late.name, "late") == 0 && late.link == B && late.group == 1);
        CHECK(strcmp(e.name, "e") == 0 && e.link == C && e.group == 0);
    }
    CHECK_EQ(notes.count, 2);
    CHECK(has_note("there is no group three") && has_note("there is no link z"));
    ovoid_robot_file_destroy(file);
}

static void test_fixed_base(void) {
    ovoid_robot_read_options options = make_read_options();
    options.fixed_base = 1;
    ovoid_robot_file *file = read_both(urdf, base_and_state, &options, NULL);
    if (!CHECK(file)) return;
    CHECK_EQ(ovoid_robot_file_get_description(file).link_count, 5);
    CHECK_EQ(ovoid_robot_file_get_state(file, 0).value_count, 1);
    CHECK(has_note("there is no joint free; what <joint> says of it is passed over"));
    ovoid_robot_file_destroy(file);
}

static void test_passed_over(void) {
    ovoid_robot_read_options options = make_read_options();
    ovoid_robot_file *file = read_both(
        urdf,
        "<robot name=\"other\">\n<virtual_joint name=\"v\" type=\"fixed\" parent_frame=\"w\" child_link=\"a\"/>\n"
        "<group name=\"g\"><joint name=\"jx\"/><link name=\"lx\"/><group name=\"gx\"/>\n"
        "<chain base_link=\"base\" tip_link=\"tx\"/></group>\n"
        "<group_state name=\"s\"><joint name=\"jd\" value=\"1\"/><joint name=\"jy\" value=\"1\"/></group_state>"
        "<passive_joint name=\"jz\"/><link_sphere_approximation link=\"ly\"/></robot>",
        &options, NULL);
    if (!CHECK(file)) return;
    CHECK_EQ(ovoid_robot_file_get_description(file).link_count, 5);
    CHECK(has_note("the SRDF is of the robot other, the URDF of r"));
    CHECK(has_note("robot.srdf:2: <virtual_joint> does not hold the root link but a"));
    CHECK(has_note("gives a value to the fixed joint jd"));
    static const char *const unknown[] = {"joint jx", "link lx",  "group gx", "link tx",
                                          "joint jy", "joint jz", "link ly"};
    for (size_t i = 0; i < sizeof unknown / sizeof *unknown; i++) CHECK(has_note(unknown[i]));
    CHECK_EQ(notes.count, 10);
    CHECK_EQ(ovoid_robot_file_get_state(file, 0).value_count, 0);
    ovoid_robot_file_destroy(file);
}

static const bad_input refusals[] = {
    {"root.srdf", "<robots/>", 1, "the root of an SRDF is <robot>"},
    {"urdf.srdf", SRDF("<link name=\"a\"/>"), 1, "this is a URDF"},
    {"pair.srdf", SRDF("<disable_collisions link1=\"a\"/>"), 2, "needs link2="},
    {"group.srdf", SRDF("<group/>"), 2, "<group> needs name="},
    {"groups.srdf", SRDF("<group name=\"g\"/>\n<group name=\"g\"/>"), 3, "an earlier group"},
    {"ring.srdf", SRDF("<group name=\"g\"><group name=\"h\"/></group>\n<group name=\"h\"><group name=\"g\"/></group>"),
     3, "group \"h\": holds itself by way of the group \"g\""},
    {"chain.srdf", SRDF("<group name=\"g\"><chain base_link=\"a\"/></group>"), 2, "needs tip_link="},
    {"state.srdf", SRDF("<group_state name=\"s\"><joint name=\"ja\"/></group_state>"), 2, "<joint> needs value="},
    {"value.srdf", SRDF("<group_state name=\"s\"><joint name=\"ja\" value=\"1 2\"/></group_state>"), 2,
     "must be a number"},
    {"nan.srdf", SRDF("<group_state name=\"s\"><joint name=\"ja\" value=\"nan\"/></group_state>"), 2, "is not finite",
     OVOID_ERROR_NOT_FINITE},
    {"sphere.srdf",
     SRDF("<link_sphere_approximation link=\"a\"><sphere center=\"0 0 0\" radius=\"-1\"/></link_sphere_approximation>"),
     2, "below zero", OVOID_ERROR_RADIUS},
    {"virtual.srdf", SRDF("<virtual_joint name=\"v\" type=\"ball\" parent_frame=\"w\" child_link=\"base\"/>"), 2,
     "not fixed, planar or floating"},
    {"frame.srdf", SRDF("<virtual_joint name=\"v\" type=\"fixed\" parent_frame=\"a\" child_link=\"base\"/>"), 2,
     "is a link of the robot"},
    {"joint.srdf", SRDF("<virtual_joint name=\"ja\" type=\"fixed\" parent_frame=\"w\" child_link=\"base\"/>"), 2,
     "the URDF has a joint of that name"},
    {"cut.srdf", "<robot>", 1, "XML: "},
};

static int accepts(const char *path, ovoid_error *error) {
    ovoid_robot_file *file = ovoid_robot_file_read(file_path("robot.urdf"), path, NULL, error);
    ovoid_robot_file_destroy(file);
    return file != NULL;
}

static void test_refusals(void) {
    file_write_text("robot.urdf", urdf);
    check_bad_inputs(refusals, sizeof refusals / sizeof *refusals, accepts);
}

// Groups that hold each other one in the next: as deep as is read, and one deeper; and groups that together have too
// many members, each holding the last one twice.
static void test_nests(void) {
    for (int doubled = 0; doubled < 2; doubled++)
        for (int count = 60; count < 70; count += 9) {
            char text[16384], *at = text + snprintf(text, sizeof text, "<robot name=\"r\">");
            char *end = text + sizeof text;
            for (int i = 0; i < count; i++) {
                at += snprintf(at, (size_t)(end - at), "<group name=\"g%d\"><link name=\"a\"/><group name=\"g%d\"/>", i,
                               i + 1);
                at += snprintf(at, (size_t)(end - at), doubled ? "<group name=\"g%d\"/></group>" : "</group>", i + 1);
            }
            snprintf(at, (size_t)(end - at), "<group name=\"g%d\"><link name=\"a\"/></group></robot>", count);
            ovoid_error error = {OVOID_OK, -1, ""};
            ovoid_robot_file *file = read_both(urdf, text, NULL, &error);
            // Members are counted once a group, so that doubling costs nothing.
            CHECK(count < 65 ? file != NULL : !file && error.code == OVOID_ERROR_LIMIT);
            ovoid_robot_file_destroy(file);
        }
}

int main(void) {
    test_groups();
    test_pairs();
    test_defaults();
    test_base();
    test_end_effectors();
    test_fixed_base();
    test_passed_over();
    test_refusals();
    test_nests();
    return check_end();
}
