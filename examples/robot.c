// An arm of two links beside a wall: is a state free, and what is near, with the gradient by the joints.
#include <ovoid/robot.h>
#include <stdio.h>

enum { BASE, UPPER, LOWER };

static ovoid_robot_joint make_hinge(const char *name, uint32_t parent, uint32_t child, ovoid_vec3 at) {
    ovoid_robot_joint joint = {.name = name, .type = OVOID_JOINT_REVOLUTE, .parent = parent, .child = child};
    joint.origin = (ovoid_pose){at, {1, 0, 0, 0}};
    joint.axis = (ovoid_vec3){0, 0, 1};
    joint.lower = -2, joint.upper = 2;
    joint.mimic = OVOID_ROBOT_NONE;
    return joint;
}

int main(void) {
    ovoid_error error;
    // Each link is a rod of length 1 along x, from its joint on.
    ovoid_shape *rod = ovoid_shape_create_box((ovoid_vec3){0.5, 0.05, 0.05}, NULL, &error);
    ovoid_shape *wall = ovoid_shape_create_box((ovoid_vec3){0.1, 2, 2}, NULL, &error);
    const ovoid_pose middle = {{0.5, 0, 0}, {1, 0, 0, 0}};
    const ovoid_robot_link links[] = {{"base"}, {"upper"}, {"lower"}};
    const ovoid_robot_joint joints[] = {make_hinge("shoulder", BASE, UPPER, (ovoid_vec3){0, 0, 0}),
                                        make_hinge("elbow", UPPER, LOWER, (ovoid_vec3){1, 0, 0})};
    const ovoid_robot_element elements[] = {{UPPER, NULL, rod, middle, NULL}, {LOWER, NULL, rod, middle, NULL}};
    const ovoid_robot_pair touching[] = {{UPPER, LOWER, "neighbours"}};
    const ovoid_robot_description arm = {"arm", links, 3, joints, 2, elements, 2, touching, 1, NULL};

    ovoid_robot *robot = ovoid_robot_create(&arm, NULL, &error);
    ovoid_robot_cell *cell = ovoid_robot_cell_create(robot, NULL, &error);
    if (!cell) return fprintf(stderr, "%s\n", error.message), 1;
    const ovoid_body obstacle = {.shape = wall, .pose = {{1.9, 0, 0}, {1, 0, 0, 0}}};
    if (!ovoid_robot_cell_add(cell, &obstacle, &error)) return fprintf(stderr, "%s\n", error.message), 1;
    ovoid_robot_checker *checker = ovoid_robot_checker_create(cell, NULL, &error);
    if (!checker) return fprintf(stderr, "%s\n", error.message), 1;

    const double states[2][2] = {{0, 0}, {0.8, 0.4}};
    for (int i = 0; i < 2; i++) {
        ovoid_robot_answer answer;
        if (ovoid_robot_collide(checker, &(ovoid_robot_query){states[i], NULL}, &answer, &error) != OVOID_OK) return 1;
        printf("%.1f %.1f: %s\n", states[i][0], states[i][1], answer.status == OVOID_ROBOT_FREE ? "free" : "not free");
    }
    double gradient[2];
    ovoid_robot_near near;
    ovoid_robot_nears nears = {.items = &near, .gradients = gradient, .capacity = 1};
    const ovoid_robot_query_options options = {.margin = 1};
    if (ovoid_robot_find_nearest(checker, &(ovoid_robot_query){states[1], &options}, &nears, &error) != OVOID_OK)
        return 1;
    printf("link %u is %.12g from the wall; by the joints %.6f %.6f\n", near.a.link, near.lower, gradient[0],
           gradient[1]);
    ovoid_robot_checker_destroy(checker);
    ovoid_robot_cell_destroy(cell);
    ovoid_robot_destroy(robot);
    ovoid_shape_destroy(rod);
    ovoid_shape_destroy(wall);
}
