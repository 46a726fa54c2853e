// Is the path of an arm past a wall free at all times in between? Proven, and the proof verified.
#include <ovoid/robot_path.h>
#include <stdio.h>

enum { STEPS = 64 };

// A base and a rod of length 1 that turns about z.
static ovoid_robot *make_arm(const ovoid_shape *rod, ovoid_error *error) {
    const ovoid_robot_link links[] = {{"base"}, {"rod"}};
    const ovoid_robot_joint hinge = {.name = "hinge",
                                     .type = OVOID_JOINT_REVOLUTE,
                                     .parent = 0,
                                     .child = 1,
                                     .origin = {{0, 0, 0}, {1, 0, 0, 0}},
                                     .axis = {0, 0, 1},
                                     .lower = -3,
                                     .upper = 3,
                                     .mimic = OVOID_ROBOT_NONE};
    const ovoid_robot_element element = {1, NULL, rod, {{0.5, 0, 0}, {1, 0, 0, 0}}, NULL};
    const ovoid_robot_description arm = {"arm", links, 2, &hinge, 1, &element, 1, NULL, 0, NULL};
    return ovoid_robot_create(&arm, NULL, error);
}

int main(void) {
    ovoid_error error;
    ovoid_shape *rod = ovoid_shape_create_box((ovoid_vec3){0.5, 0.05, 0.05}, NULL, &error);
    ovoid_shape *wall = ovoid_shape_create_box((ovoid_vec3){0.001, 0.1, 2}, NULL, &error);
    ovoid_robot *robot = make_arm(rod, &error);
    ovoid_robot_cell *cell = ovoid_robot_cell_create(robot, NULL, &error);
    if (!cell) return fprintf(stderr, "%s\n", error.message), 1;
    const ovoid_body obstacle = {.shape = wall, .pose = {{0, 0.9, 0}, {1, 0, 0, 0}}}; // thinner than any sampling
    if (!ovoid_robot_cell_add(cell, &obstacle, &error)) return fprintf(stderr, "%s\n", error.message), 1;
    ovoid_robot_checker *checker = ovoid_robot_checker_create(cell, NULL, &error);
    if (!checker) return fprintf(stderr, "%s\n", error.message), 1;

    const double clear[] = {-1.5, 0, 1}, blocked[] = {-1.5, 3};
    const ovoid_robot_path paths[] = {{clear, 3}, {blocked, 2}};
    for (int i = 0; i < 2; i++) {
        ovoid_robot_step steps[STEPS];
        const ovoid_robot_path_options options = {.steps = steps, .capacity = STEPS};
        ovoid_robot_path_answer is;
        if (ovoid_robot_path_find_hit(checker, &(ovoid_robot_path_query){&paths[i], &options}, &is, &error) != OVOID_OK)
            return 1;
        int holds = is.step_count <= STEPS &&
                    ovoid_robot_path_verify(cell, &is, &(ovoid_robot_path_basis){{&paths[i], &options}, steps},
                                            &error) == OVOID_OK;
        printf("%s until s = %.4f; %s\n", is.status == OVOID_ROBOT_FREE ? "free" : "first hit, free", is.free_until,
               holds ? "the proof holds" : "no proof");
    }
    ovoid_robot_checker_destroy(checker);
    ovoid_robot_cell_destroy(cell);
    ovoid_robot_destroy(robot);
    ovoid_shape_destroy(rod);
    ovoid_shape_destroy(wall);
}
