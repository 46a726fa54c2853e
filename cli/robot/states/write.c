// A path as CSV, and as the message moveit_msgs/RobotTrajectory in JSON, which is YAML too.
#include "robot/states/states.h"

#include "base/message.h"
#include "io/fields.h"

#include <math.h>

void states_write_csv(FILE *file, const cli_cell *cell, const cli_states *states) {
    size_t n = states->variable_count;
    char name[CELL_SIDE_ROOM];
    for (size_t i = 0; i < n; i++) {
        cell_format_variable(name, cell, i);
        if (i) fputc(',', file);
        cell_write_field(file, name);
    }
    fputc('\n', file);
    for (size_t i = 0; i < states->count * n; i++) {
        json_write_number(file, states->q[i]);
        fputc((i + 1) % n ? ',' : '\n', file);
    }
}

/// 1: the variable is all of a joint's.
static int is_joint(const cli_cell *cell, size_t variable) {
    ovoid_robot_variable v = ovoid_robot_get_variable(cell->robot.robot, variable);
    return ovoid_joint_type_get_variable_count(cell->description.joints[v.joint].type) == 1;
}

/// 1: it has the same number in all states.
static int stands_still(const cli_states *states, size_t variable) {
    size_t n = states->variable_count;
    for (size_t i = 1; i < states->count; i++)
        if (states->q[i * n + variable] != states->q[variable]) return 0;
    return 1;
}

int states_check_trajectory(const cli_cell *cell, const cli_states *states) {
    char name[CELL_SIDE_ROOM];
    for (size_t i = 0; i < states->variable_count; i++) {
        if (is_joint(cell, i)) continue;
        cell_format_variable(name, cell, i);
        if (stands_still(states, i)) continue;
        message_error("%s moves, and a trajectory of MoveIt cannot have it here: write CSV", name);
        return EXIT_INPUT;
    }
    return 0;
}

/// The numbers of a state; a time, where there are some.
static void write_point(FILE *file, const cli_cell *cell, const cli_states *states, size_t number) {
    size_t n = states->variable_count;
    const char *before = "";
    fputs(number ? ",\n{\"positions\":[" : "\n{\"positions\":[", file);
    for (size_t i = 0; i < n; i++) {
        if (!is_joint(cell, i)) continue;
        fputs(before, file);
        json_write_number(file, states->q[number * n + i]);
        before = ",";
    }
    fputc(']', file);
    if (states->times) {
        // Whole nanoseconds, as ROS 1 has them.
        double time = states->times[number] - states->times[0], seconds = floor(time);
        double rest = round(1e9 * (time - seconds));
        if (rest >= 1e9) rest = 0, seconds++;
        fprintf(file, ",\"time_from_start\":{\"secs\":%.0f,\"nsecs\":%.0f}", seconds, rest);
    }
    fputc('}', file);
}

void states_write_trajectory(FILE *file, const cli_cell *cell, const cli_states *states) {
    const char *before = "";
    fputs("{\"joint_trajectory\":{\"header\":{\"frame_id\":", file);
    ovoid_text_write_json(file, cell->description.links[ovoid_robot_get_root(cell->robot.robot)].name);
    fputs("},\"joint_names\":[", file);
    for (size_t i = 0; i < states->variable_count; i++) {
        if (!is_joint(cell, i)) continue;
        fputs(before, file);
        cell_write_variable_json(file, cell, i);
        before = ",";
    }
    fputs("],\"points\":[", file);
    for (size_t i = 0; i < states->count; i++) write_point(file, cell, states, i);
    fputs("\n]}}\n", file);
}
