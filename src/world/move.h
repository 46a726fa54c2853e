// Bodies that move: their enlarged boxes, and when the tree is updated.
#ifndef OVOID_WORLD_MOVE_H
#define OVOID_WORLD_MOVE_H

#include "world/state.h"

/// The enlarged box of a body at its present place; its room is measured from now on.
box world_compute_box(ovoid_world *w, uint32_t i);

/// The next step drops all pairs of the body, and finds them again if the body still exists.
void body_mark_fresh(ovoid_world *w, uint32_t i);

/// Gives the body a new enlarged box, and updates the tree.
void body_refresh(ovoid_world *w, uint32_t i);

#endif
