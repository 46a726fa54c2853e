// A robot from its files in a cell from MoveIt's YAML: is the arm free in its named state, and when bent toward the
// table?
#include <ovoid/robot_io.h>
#include <stdio.h>

static void print_note(void *context, const ovoid_robot_note *note) {
    (void)context;
    printf("%s:%d: %s\n", note->path, (int)note->line, note->text);
}

/// The cell of a robot among obstacles; NULL if something fails.
static ovoid_robot_cell *create_cell(const ovoid_robot *robot, const ovoid_obstacles *obstacles, ovoid_error *error) {
    ovoid_robot_cell *cell = ovoid_robot_cell_create(robot, NULL, error);
    if (cell && ovoid_robot_cell_add_obstacles(cell, obstacles, NULL, error) != OVOID_OK) return NULL;
    return cell;
}

int main(void) {
    ovoid_error error;
    const ovoid_robot_read_options options = {.fixed_base = 1, .parts = 1, .note = print_note};
    ovoid_robot_file *file = ovoid_robot_file_read("arm/arm.urdf", "arm/arm.srdf", &options, &error);
    ovoid_obstacles *obstacles = file ? ovoid_obstacles_read("arm/cell.yaml", &options, &error) : NULL;
    if (!obstacles) return fprintf(stderr, "%s\n", error.message), 1;
    ovoid_robot_description description = ovoid_robot_file_get_description(file);
    ovoid_robot *robot = ovoid_robot_create(&description, NULL, &error);
    ovoid_robot_cell *cell = robot ? create_cell(robot, obstacles, &error) : NULL;
    ovoid_robot_checker *checker = cell ? ovoid_robot_checker_create(cell, NULL, &error) : NULL;
    if (!checker) return fprintf(stderr, "%s\n", error.message), 1;

    // The joint values of the SRDF's first state; the others stay 0.
    double state[16] = {0};
    if (ovoid_robot_get_variable_count(robot) > 16) return 1;
    ovoid_robot_state named = ovoid_robot_file_get_state(file, 0);
    for (size_t i = 0; i < named.value_count; i++)
        state[ovoid_robot_get_joint_variable(robot, named.values[i].joint)] = named.values[i].values[0];
    for (int bent = 0; bent < 2; bent++) {
        ovoid_robot_answer answer;
        if (bent) state[0] = 1.4; // the shoulder
        if (ovoid_robot_collide(checker, &(ovoid_robot_query){state, NULL}, &answer, &error) != OVOID_OK) return 1;
        printf("%s: %s\n", bent ? "bent" : named.name, answer.status == OVOID_ROBOT_FREE ? "free" : "not free");
    }
    ovoid_robot_checker_destroy(checker);
    ovoid_robot_cell_destroy(cell);
    ovoid_robot_destroy(robot);
    ovoid_obstacles_destroy(obstacles);
    ovoid_robot_file_destroy(file);
}
