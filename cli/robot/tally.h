// How many states are free, and which pairs are hit most often.
#ifndef OVOID_CLI_ROBOT_TALLY_H
#define OVOID_CLI_ROBOT_TALLY_H

#include "robot/cell_files.h"

/// Two links, or a link and an obstacle, that ended a check.
typedef struct tally_pair {
    ovoid_robot_side a, b;
    size_t count;
} tally_pair;

/// Counts; all zero is the beginning.
typedef struct tally {
    size_t statuses[4]; ///< by ovoid_robot_status
    size_t empty;       ///< of the undecided, those of which nothing is compared
    size_t outside;     ///< of the refused, those outside their limits
    tally_pair links;   ///< the first two links that touch or may touch; count 0: none do
    tally_pair *pairs;
    size_t pair_count, capacity;
} tally;

/// Counts a state; 0 where memory is out.
int tally_add(tally *tally, const ovoid_robot_answer *answer);

/// The exit code of them all.
int tally_get_exit(const tally *tally);

/// The counts and the ten pairs that were named most often, as notes; no state is counted after it.
void tally_report(tally *tally, const cli_cell *cell, double seconds);

void tally_clear(tally *tally);

#endif
