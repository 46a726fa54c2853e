// The steps that prove a path, on a page: which of them prove which stretch.
#ifndef OVOID_CLI_ROBOT_PAGE_STEPS_H
#define OVOID_CLI_ROBOT_PAGE_STEPS_H

#include "robot/path/path.h"

/// Writes "steps" and the "pairs" that they name, after a comma; *left_out: how many steps are too many. 0, or
/// EXIT_INPUT after a message.
int page_write_steps(FILE *file, const path_report *report, size_t *left_out);

#endif
