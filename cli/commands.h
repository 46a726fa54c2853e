// The commands of the tool, one file each.
#ifndef OVOID_CLI_COMMANDS_H
#define OVOID_CLI_COMMANDS_H

#include "base/args.h"

extern const cli_command command_fit, command_info, command_decompose, command_distance, command_batch, command_check,
    command_run, command_pack, command_merge, command_verify, command_view, command_paper, command_robot;

#endif
