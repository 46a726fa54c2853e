// Bodies that move: how far, and when the tree hears of it.
#ifndef OVOID_SCENE_MOVE_H
#define OVOID_SCENE_MOVE_H

#include "scene/state.h"

/// A body's enlarged box where it is now; from here its room is counted.
box body_compute_box(ovoid_world *w, uint32_t i);

/// All pairs of the body are dropped with the next frame, and found afresh if it still is there.
void body_mark_fresh(ovoid_world *w, uint32_t i);

/// The body's enlarged box made anew, and put in the tree.
void body_refresh(ovoid_world *w, uint32_t i);

#endif
