// Points in space, put together into cells of about the same weight.
#ifndef OVOID_CLI_PAIRS_CELLS_H
#define OVOID_CLI_PAIRS_CELLS_H

#include <stddef.h>
#include <stdint.h>

typedef struct cell_point {
    double at[3];
    double weight; ///< > 0
    uint32_t id;   ///< the caller's
    uint32_t cell;
} cell_point;

/// Numbers the cells of the points, from 0 to at most `cells` - 1, and sorts the points by them. The points are halved
/// along the longest axis of their box, as in a k-d tree (J. L. Bentley, Multidimensional binary search trees used for
/// associative searching, 1975), so that both halves have their share of the weight within one point. The same on all
/// machines. Cost: linear in the points, times the logarithm of the cells.
void cells_make(cell_point *points, size_t count, uint32_t cells);

#endif
