// How fast joints go between two states with times, and how fast they may.
#ifndef OVOID_CLI_ROBOT_PATH_SPEED_H
#define OVOID_CLI_ROBOT_PATH_SPEED_H

#include "robot/states/states.h"

/// Warns of each joint that is faster than its limit from state i to the next one. 1: there was one.
int speed_report(const cli_cell *cell, const cli_states *states, size_t i);

#endif
