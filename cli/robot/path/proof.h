// Files of path proofs: what they say of the robot and its obstacles, and whether these are the ones at hand.
#ifndef OVOID_CLI_ROBOT_PATH_PROOF_H
#define OVOID_CLI_ROBOT_PATH_PROOF_H

#include "robot/path/path.h"

/// What a proof is of.
typedef struct proof_source {
    const char *urdf;
    const cell_settings *cell;
    const cli_cell *opened;
    size_t path_count;
} proof_source;

/// A number that another robot, other shapes, other obstacles or other disabled pairs do not have, but by chance.
uint64_t proof_compute_digest(const cli_cell *cell);

/// Writes the pairs of a cell, each a list of two sides, as the items of a list.
void proof_write_pairs(FILE *file, const cli_cell *cell);

/// Writes the first line.
void proof_write_source(FILE *file, const proof_source *source);

/// The number of a pair, or OVOID_ROBOT_NONE.
uint32_t proof_find_pair(const cli_cell *cell, const ovoid_robot_side *a, const ovoid_robot_side *b);

#endif
