// The model: what is refused and how it is said; order of links, joints and variables; memory. Truth: descriptions made
// here, whose trees are known.
#include "check.h"
#include "countdown.h"
#include "ovoid/robot.h"

#include <time.h>

static ovoid_error error;

static ovoid_robot_joint make_joint(const char *name, ovoid_joint_type type, uint32_t parent, uint32_t child) {
    return (ovoid_robot_joint){.name = name,
                               .type = type,
                               .parent = parent,
                               .child = child,
                               .origin = ovoid_pose_make_identity(),
                               .axis = {0, 0, 1},
                               .lower = -1,
                               .upper = 2,
                               .mimic = OVOID_ROBOT_NONE,
                               .multiplier = 1};
}

// Five links: base - arm - hand - left finger, right finger; the right finger follows the left one. The joints do not
// come in the tree's order.
typedef struct arm {
    ovoid_robot_link links[5];
    ovoid_robot_joint joints[4];
    ovoid_robot_element elements[2];
    ovoid_robot_pair disabled[3];
    ovoid_robot_description d;
} arm;

static ovoid_shape *box;

static void make_arm(arm *a) {
    static const char *const names[5] = {"hand", "base", "arm", "left", "right"};
    for (int i = 0; i < 5; i++) a->links[i].name = names[i];
    a->joints[0] = make_joint("finger_right", OVOID_JOINT_PRISMATIC, 0, 4);
    a->joints[0].mimic = 1, a->joints[0].multiplier = -1;
    a->joints[1] = make_joint("finger_left", OVOID_JOINT_PRISMATIC, 0, 3);
    a->joints[2] = make_joint("wrist", OVOID_JOINT_CONTINUOUS, 2, 0);
    a->joints[3] = make_joint("mount", OVOID_JOINT_PLANAR, 1, 2);
    a->elements[0] = (ovoid_robot_element){2, "upper", box, ovoid_pose_make_identity(), NULL};
    a->elements[1] = (ovoid_robot_element){0, NULL, box, ovoid_pose_make_identity(), NULL};
    a->disabled[0] = (ovoid_robot_pair){3, 0, "near"};
    a->disabled[1] = (ovoid_robot_pair){0, 3, NULL};
    a->disabled[2] = (ovoid_robot_pair){2, 0, "near"};
    a->d = (ovoid_robot_description){"arm", a->links, 5, a->joints, 4, a->elements, 2, a->disabled, 3, NULL};
}

static void test_tree(void) {
    arm a;
    make_arm(&a);
    ovoid_robot *r = ovoid_robot_create(&a.d, NULL, &error);
    CHECK(r != NULL);
    if (!r) return;
    memset(&a.links, 0, sizeof a.links); // the description is not kept
    memset(&a.joints, 0, sizeof a.joints);
    ovoid_robot_description d = ovoid_robot_get_description(r);
    CHECK(strcmp(d.name, "arm") == 0 && strcmp(d.links[4].name, "right") == 0);
    CHECK_EQ(ovoid_robot_get_root(r), 1u);
    CHECK_EQ(ovoid_robot_find_link(r, "base"), 1u);
    CHECK_EQ(ovoid_robot_find_link(r, "bas"), OVOID_ROBOT_NONE);
    CHECK_EQ(ovoid_robot_find_joint(r, "wrist"), 2u);
    CHECK_EQ(ovoid_robot_get_parent_joint(r, 0), 2u);
    CHECK_EQ(ovoid_robot_get_parent_joint(r, 1), OVOID_ROBOT_NONE);
    // finger_left, wrist, mount: 1 + 1 + 3.
    CHECK_EQ(ovoid_robot_get_variable_count(r), 5u);
    CHECK_EQ(ovoid_robot_get_variable(r, 0).joint, 1u);
    CHECK_EQ(ovoid_robot_get_variable(r, 0).upper, 2.0);
    CHECK_EQ(ovoid_robot_get_variable(r, 1).upper, (double)INFINITY);
    CHECK_EQ(ovoid_robot_get_variable(r, 4).component, 2u);
    CHECK_EQ(ovoid_robot_get_joint_variable(r, 0), 0u);
    CHECK_EQ(ovoid_robot_get_joint_variable(r, 3), 2u);
    CHECK_EQ(d.disabled_count, 2u);
    CHECK(d.disabled[0].a == 0 && d.disabled[0].b == 2 && d.disabled[1].a == 0 && d.disabled[1].b == 3);
    ovoid_robot_destroy(r);
    ovoid_robot_destroy(NULL);
}

// The description is refused with the code, and a sentence that holds the words.
static void expect_refused(const arm *a, ovoid_code code, int64_t place, const char *words) {
    error = (ovoid_error){0};
    ovoid_robot *r = ovoid_robot_create(&a->d, NULL, &error);
    CHECK(r == NULL);
    CHECK_EQ(error.code, code);
    CHECK_EQ(error.place, place);
    CHECK(strstr(error.message, words) != NULL);
    if (!strstr(error.message, words)) printf("  %s\n", error.message);
    ovoid_robot_destroy(r);
}
#define REFUSED(change, code, place, words)                                                                            \
    do {                                                                                                               \
        arm a;                                                                                                         \
        make_arm(&a);                                                                                                  \
        change;                                                                                                        \
        expect_refused(&a, code, place, words);                                                                        \
    } while (0)

static void test_refusals(void) {
    REFUSED(a.d.link_count = 0, OVOID_ERROR_EMPTY, -1, "needs a link");
    REFUSED(a.d.joints = NULL, OVOID_ERROR_ARGUMENT, -1, "NULL");
    REFUSED(a.d.link_count = OVOID_ROBOT_LINKS_MAX + 1, OVOID_ERROR_LIMIT, -1, "allowed");
    REFUSED(a.links[2].name = "", OVOID_ERROR_ARGUMENT, 2, "link 2 has no name");
    REFUSED(a.links[2].name = "hand", OVOID_ERROR_ARGUMENT, 2, "two links are named \"hand\"");
    REFUSED(a.joints[3].name = "wrist", OVOID_ERROR_ARGUMENT, 3, "two joints are named \"wrist\"");
    REFUSED(a.joints[1].name = NULL, OVOID_ERROR_ARGUMENT, 1, "joint 1 has no name");
    REFUSED(a.joints[1].child = 5, OVOID_ERROR_INDEX, 1, "\"finger_left\": its child link is 5, there are 5");
    REFUSED(a.joints[1].type = (ovoid_joint_type)6, OVOID_ERROR_ARGUMENT, 1, "no such type");
    REFUSED(a.joints[1].mimic = 4, OVOID_ERROR_INDEX, 1, "mimics joint 4");
    REFUSED(a.joints[1].mimic = 1, OVOID_ERROR_ARGUMENT, 0, "mimics itself");
    REFUSED(a.joints[1].mimic = 0, OVOID_ERROR_ARGUMENT, 0, "mimics itself, or others");
    REFUSED(a.joints[1].mimic = 3, OVOID_ERROR_ARGUMENT, 0, "mimics \"mount\", which is planar");
    REFUSED(a.joints[3].mimic = 1, OVOID_ERROR_ARGUMENT, 3, "\"mount\" is planar: only joints of one variable");
    REFUSED(a.joints[1].lower = 3, OVOID_ERROR_ARGUMENT, 1, "\"finger_left\": its lower limit 3 is above");
    REFUSED(a.joints[1].upper = NAN, OVOID_ERROR_NOT_FINITE, 1, "finger_left");
    REFUSED(a.joints[1].offset = INFINITY, OVOID_ERROR_NOT_FINITE, 1, "finger_left");
    REFUSED(a.joints[1].velocity = -1, OVOID_ERROR_ARGUMENT, 1, "velocity");
    REFUSED(a.joints[2].axis.z = 0, OVOID_ERROR_ROTATION, 2, "\"wrist\": its axis is zero");
    REFUSED(a.joints[2].axis.z = NAN, OVOID_ERROR_NOT_FINITE, 2, "wrist");
    REFUSED(a.joints[2].origin.rotation.w = 0, OVOID_ERROR_ROTATION, 2, "joint 2 \"wrist\" has a quaternion");
    REFUSED(a.joints[2].origin.position.x = 1e51, OVOID_ERROR_RANGE, 2, "above 1e50");
    REFUSED(a.elements[1].link = 5, OVOID_ERROR_INDEX, 1, "link 5");
    REFUSED(a.elements[1].shape = NULL, OVOID_ERROR_ARGUMENT, 1, "\"hand\" has no shape");
    REFUSED(a.elements[0].pose.position.y = NAN, OVOID_ERROR_NOT_FINITE, 0, "element 0 \"upper\" has NaN");
    REFUSED(a.disabled[2].b = 7, OVOID_ERROR_INDEX, 2, "7");
    // Trees that are none.
    REFUSED(a.d.joint_count = 3, OVOID_ERROR_ARGUMENT, 2, "two roots: links \"base\" and \"arm\"");
    REFUSED(a.joints[1].child = 4, OVOID_ERROR_ARGUMENT, 4,
            "\"right\" hangs on two joints, \"finger_right\" and \"finger_left\"");
    REFUSED(a.joints[3].parent = 3, OVOID_ERROR_ARGUMENT, 0,
            "a loop: link \"hand\" hangs on itself, by joint \"wrist\"");
    REFUSED((a.d.link_count = 4, a.joints[0].child = 1), OVOID_ERROR_ARGUMENT, 0, "none is the root");
    CHECK(ovoid_robot_create(NULL, NULL, NULL) == NULL);
}

// A chain of 10^5 links, each joint following the one before, described backwards.
static void test_large(void) {
    enum { COUNT = 100000 };
    ovoid_robot_link *links = malloc(COUNT * sizeof *links);
    ovoid_robot_joint *joints = malloc(COUNT * sizeof *joints);
    char(*names)[16] = malloc(COUNT * sizeof *names);
    if (!links || !joints || !names) exit(1);
    for (uint32_t i = 0; i < COUNT; i++) {
        snprintf(names[i], sizeof *names, "%u", i);
        links[i].name = names[i];
        if (i == 0) continue;
        joints[i - 1] = make_joint(names[i], OVOID_JOINT_REVOLUTE, i, i - 1);
        if (i > 1) joints[i - 1].mimic = i - 2;
    }
    ovoid_robot_description d = {.links = links, .link_count = COUNT, .joints = joints, .joint_count = COUNT - 1};
    clock_t start = clock();
    ovoid_robot *r = ovoid_robot_create(&d, NULL, &error);
    CHECK(r != NULL);
    // Linear work takes some hundredths of a second; a walk of each chain of mimics took twenty seconds.
    CHECK_LE((double)(clock() - start) / CLOCKS_PER_SEC, 5.0);
    if (r) {
        CHECK_EQ(ovoid_robot_get_root(r), COUNT - 1u);
        CHECK_EQ(ovoid_robot_get_variable_count(r), 1u);
        CHECK_EQ(ovoid_robot_get_joint_variable(r, COUNT - 2), 0u);
        CHECK_EQ(ovoid_robot_find_link(r, "4711"), 4711u);
    }
    ovoid_robot_destroy(r);
    joints[0].mimic = COUNT - 2; // now a ring
    CHECK(ovoid_robot_create(&d, NULL, &error) == NULL);
    CHECK(strstr(error.message, "mimics itself") != NULL);
    free(links), free(joints), free(names);
}

static void test_memory(void) {
    arm a;
    make_arm(&a);
    for (long k = 0;; k++) {
        countdown c = {.left = k};
        ovoid_allocator allocator = countdown_make_allocator(&c);
        ovoid_robot_options options = {.allocator = &allocator};
        error = (ovoid_error){0};
        ovoid_robot *r = ovoid_robot_create(&a.d, &options, &error);
        if (!r) CHECK_EQ(error.code, OVOID_ERROR_MEMORY);
        ovoid_robot_destroy(r);
        CHECK_EQ(c.held, 0);
        if (r) break;
    }
    // Shapes that become the robot's: one of two elements is destroyed once.
    ovoid_shape *own = ovoid_shape_create_sphere(1, NULL, &error);
    a.elements[0].shape = a.elements[1].shape = own;
    ovoid_robot_options options = {.takes_shapes = 1};
    ovoid_robot_destroy(ovoid_robot_create(&a.d, &options, &error));
}

int main(void) {
    box = ovoid_shape_create_box((ovoid_vec3){1, 2, 3}, NULL, &error);
    if (!box) return 1;
    for (int t = 0; t <= OVOID_JOINT_FLOATING; t++)
        CHECK(strcmp(ovoid_joint_type_get_name((ovoid_joint_type)t), "unknown type") != 0);
    CHECK_EQ(ovoid_joint_type_get_variable_count(OVOID_JOINT_FLOATING), 7u);
    test_tree();
    test_refusals();
    test_large();
    test_memory();
    ovoid_shape_destroy(box);
    return check_end();
}
