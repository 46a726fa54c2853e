// The making of a collision matrix: its pairs, their joints' limits, and who fills them.
#ifndef OVOID_ROBOT_MATRIX_MATRIX_H
#define OVOID_ROBOT_MATRIX_MATRIX_H

#include "ovoid/robot_matrix.h"
#include "robot/cell/cell.h"

struct ovoid_robot_matrix {
    ovoid_allocator allocator;
    ovoid_robot_matrix_pair *pairs;
    size_t count;
};

/// What the making of a matrix has.
typedef struct matrix_work {
    ovoid_robot_matrix *matrix;
    const ovoid_robot_cell *cell; ///< nothing is left out in it, and it has no obstacles
    ovoid_robot_matrix_options options;
    ovoid_allocator allocator;
    uint32_t *of_group_pair; ///< of each pair of groups: the matrix' pair
    double *low, *high;      ///< of each variable: the box that stands for all states; where there is none, one state
} matrix_work;

/// Keeps a copy of a state with a pair, if it has none yet. MEMORY.
ovoid_code matrix_keep_state(const matrix_work *w, const double **kept, const double *q);

/// Counts hits and free states of all pairs among the random states. MEMORY.
ovoid_code matrix_sample(matrix_work *w, ovoid_error *error);

/// Proves what it can of the pairs without a hit, and of those without a free state. MEMORY.
ovoid_code matrix_prove(matrix_work *w, ovoid_error *error);

#endif
