// What a search begins with: the joints that move, the start and the goals, those that hit left out.
#ifndef OVOID_CLI_PLAN_ENDS_H
#define OVOID_CLI_PLAN_ENDS_H

#include "robot/plan/plan.h"

/// The ends of a path. All zero holds nothing.
typedef struct plan_ends {
    uint32_t *moving; ///< variables
    size_t moving_count;
    double *goals; ///< that are free, one after another
    size_t goal_count;
} plan_ends;

/// Finds them; states: the start, then the goals. 0, or an exit code after a message, with nothing left open.
int ends_open(const cli_command *command, const plan_settings *settings, const cli_cell *cell, const cli_states *states,
              plan_ends *ends);
void ends_close(plan_ends *ends);

#endif
