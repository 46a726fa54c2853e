// Bodies that move: their enlarged boxes, and when the tree is updated.
#ifndef OVOID_WORLD_MOVE_H
#define OVOID_WORLD_MOVE_H

#include "world/state.h"

/// The enlarged box of a body at its present place, from which its room is counted from now on.
box world_compute_box(ovoid_world *w, uint32_t i);

/// All pairs of the body are dropped by the next step, and found afresh if the body still exists.
void body_mark_fresh(ovoid_world *w, uint32_t i);

/// Makes the body's enlarged box anew, and updates the tree.
void body_refresh(ovoid_world *w, uint32_t i);

#endif
