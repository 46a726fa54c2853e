// A lower bound of the signed distance of two bodies in a whole cell of joint space, along one direction.
#ifndef OVOID_ROBOT_MATRIX_CELL_GAP_H
#define OVOID_ROBOT_MATRIX_CELL_GAP_H

#include "robot/path/motion.h"

/// Chains of more joints that turn are not bounded.
enum { CELL_GAP_TURNS = 48 };

/// A joint that turns.
typedef struct chain_turn {
    vec3 axis, from;     ///< world
    double half, radius; ///< of its way through the cell; the greatest distance of a vertex from the axis in the cell
    uint32_t step;
} chain_turn;

/// An item's chain in a cell.
typedef struct chain_motion {
    chain_turn turns[CELL_GAP_TURNS]; ///< from the item up
    uint32_t item, links, count;      ///< count: of turns
    double d1, d2, d3;                ///< bounds of the derivatives of a vertex' place
    double sliding; ///< what joints that slide move: a slide only adds a vector, which those above turn
    double rounded; ///< what rounding does to the terms of the first order
    double slack;   ///< what it does to all of them
} chain_motion;

/// A pair of items in a cell.
typedef struct cell_gap {
    const path_work *w;
    const path_state *middle;
    chain_motion a, b;
} cell_gap;

/// For the cell whose middle has these frames, and path_set_item was called for both items of the pair; 0: it has too
/// many joints.
int cell_gap_make(cell_gap *g, const path_work *w, const path_state *middle, uint32_t pair);

/// Never more than the gap of the pair along the unit vector n, from the first to the second item in the world, in any
/// state of the cell. -infinity where it is not above `needed`, and less close to the gap the farther it is above that;
/// needed -infinity: as close as it can be. Errors of the poses in the middle are not counted: a gap above them proves
/// the cell free.
double cell_gap_compute(const cell_gap *g, vec3 n, double needed);

/// Adds for each variable by how much the gap along n falls over the cell by its joints, and to first order by how much
/// more where the variable grows than where it falls.
typedef struct cell_gap_shares {
    double *shares, *slopes;
} cell_gap_shares;
void cell_gap_add_shares(const cell_gap *g, vec3 n, const cell_gap_shares *to);

#endif
