// A point that two bodies have in common in a whole cell of joint space.
#ifndef OVOID_ROBOT_MATRIX_CELL_CONTACT_H
#define OVOID_ROBOT_MATRIX_CELL_CONTACT_H

#include "robot/path/motion.h"

/// A pair of items in a cell, whose middle has these frames, and a point of the world.
typedef struct cell_contact {
    const path_work *w;
    const path_state *middle;
    const ovoid_shape *point; ///< a shape that is a point at its frame's origin
    uint32_t pair;            ///< NONE: none was chosen
    vec3 at;                  ///< the point
    double spare;             ///< by how much it stays inside both, below zero: by how much it may leave one
} cell_contact;

/// 1 where the point is proven inside both bodies of its pair in every state of the cell.
int cell_contact_is_proven(cell_contact *c);
/// cell_contact_is_proven after a search from the witness points of a pair that overlaps in the middle.
int cell_contact_find(cell_contact *c, uint32_t pair, const ovoid_answer *deepest);
/// Adds for each variable by how much its joints may move the bodies against the point.
void cell_contact_add_shares(const cell_contact *c, double *shares);

#endif
