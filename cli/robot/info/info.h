// What ovoid robot info tells: for people and as JSON.
#ifndef OVOID_CLI_ROBOT_INFO_INFO_H
#define OVOID_CLI_ROBOT_INFO_INFO_H

#include "robot/inputs.h"

#include <stdio.h>

/// A link's geometry in numbers.
typedef struct link_count {
    size_t elements, vertices;
} link_count;

void info_write_text(FILE *file, const cli_robot *robot, const link_count *links);
void info_write_json(FILE *file, const cli_robot *robot, const link_count *links);

#endif
