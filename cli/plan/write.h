// A planned path as it is written.
#ifndef OVOID_CLI_PLAN_WRITE_H
#define OVOID_CLI_PLAN_WRITE_H

#include "robot/states.h"

/// States as "ovoid robot path --states" reads them.
void write_states_csv(FILE *file, const cli_cell *cell, const cli_states *states);

/// A RobotTrajectory of MoveIt without times: the joints of one variable, those that stand still too.
void write_trajectory_json(FILE *file, const cli_cell *cell, const cli_states *states);

#endif
