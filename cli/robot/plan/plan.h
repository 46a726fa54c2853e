// What `ovoid robot plan` is asked, for the tool, which reads its command line, and the program ovoid-plan, which
// plans.
#ifndef OVOID_CLI_ROBOT_PLAN_PLAN_H
#define OVOID_CLI_ROBOT_PLAN_PLAN_H

#include "robot/states/states.h"

/// The program that plans, in the folder of the tool. It alone is linked with OMPL.
#define PLAN_PROGRAM "ovoid-plan"

typedef struct plan_settings {
    cell_settings cell;
    robot_settings robot;
    states_settings states;
    const char *output, *proofs, *html;
    const char *moving; ///< a group of the SRDF; NULL: by the request, or all joints
    double seconds;
    unsigned seed;
    int json, planner, is_raw;
} plan_settings;

/// The settings before the command line is read.
#define PLAN_DEFAULTS                                                                                                  \
    { .cell.slack = CELL_SLACK, .seconds = 10, .seed = 1 }

/// Reads the command line. -1 to go on, or an exit code. The settings must stay where they are.
int plan_settle(const cli_command *command, int argc, char **argv, plan_settings *settings, cli_operands *operands);

#endif
