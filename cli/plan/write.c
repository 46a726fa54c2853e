// A planned path as CSV, and as the message moveit_msgs/RobotTrajectory in JSON, which is YAML too.
#include "plan/write.h"

#include "io/fields.h"

void write_states_csv(FILE *file, const cli_cell *cell, const cli_states *states) {
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

void write_trajectory_json(FILE *file, const cli_cell *cell, const cli_states *states) {
    size_t n = states->variable_count;
    const char *before = "";
    fputs("{\"joint_trajectory\":{\"header\":{\"frame_id\":", file);
    ovoid_text_write_json(file, cell->description.links[ovoid_robot_get_root(cell->robot.robot)].name);
    fputs("},\"joint_names\":[", file);
    for (size_t i = 0; i < n; i++) {
        if (!is_joint(cell, i)) continue;
        fputs(before, file);
        cell_write_variable_json(file, cell, i);
        before = ",";
    }
    fputs("],\"points\":[", file);
    for (size_t k = 0; k < states->count; k++) {
        fputs(k ? ",\n{\"positions\":[" : "\n{\"positions\":[", file);
        before = "";
        for (size_t i = 0; i < n; i++) {
            if (!is_joint(cell, i)) continue;
            fputs(before, file);
            json_write_number(file, states->q[k * n + i]);
            before = ",";
        }
        fputs("]}", file);
    }
    fputs("\n]}}\n", file);
}
