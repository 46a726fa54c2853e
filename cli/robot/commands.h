// The commands about robots, one file each.
#ifndef OVOID_CLI_ROBOT_COMMANDS_H
#define OVOID_CLI_ROBOT_COMMANDS_H

#include "base/args.h"

extern const cli_command command_robot_info, command_robot_check, command_robot_path, command_robot_matrix,
    command_robot_spheres, command_robot_plan;

#endif
