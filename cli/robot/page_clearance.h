// The clearance over a path, sampled for a page.
#ifndef OVOID_CLI_ROBOT_PAGE_CLEARANCE_H
#define OVOID_CLI_ROBOT_PAGE_CLEARANCE_H

#include "robot/states/states.h"

/// Writes ,"clearance":[[s,lower,upper,a,b],...]: the bracket of the nearest pair at samples, with its sides as a
/// path's answer has them. 0, or EXIT_INPUT after a message.
int page_write_clearance(FILE *file, const cli_cell *cell, const cli_states *states, ovoid_robot_checker *checker,
                         const ovoid_robot_query_options *options);

#endif
