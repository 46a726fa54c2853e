// Robots written in xacro, the language of macros that makes URDF and SRDF, expanded by the program of that name.
#ifndef OVOID_CLI_ROBOT_XACRO_H
#define OVOID_CLI_ROBOT_XACRO_H

#include "base/args.h"

#include <ovoid/robot_io.h>

/// 1: the path ends in ".xacro".
int xacro_is_file(const char *path);

/// Expands the file by the program xacro, which is looked for on PATH, with these arguments, "NAME:=VALUE". Writes the
/// text, whose data the caller frees. 0, or an exit code after a message.
int xacro_expand(const cli_command *command, const char *path, const args_list *arguments, ovoid_robot_text *text);

#endif
