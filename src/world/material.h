// Materials of bodies, and how far beyond the margin their contacts are wanted.
#ifndef OVOID_WORLD_MATERIAL_H
#define OVOID_WORLD_MATERIAL_H

#include "world/state.h"

/// The material of the body at an index; zeros if none was set.
ovoid_material material_get(const ovoid_world *w, uint32_t i);

/// A new body at the index has no material.
void material_forget(ovoid_world *w, uint32_t i);

/// Sets the ranges of all bodies for a step, and gives new boxes to those whose boxes are too small for them. 0: memory
/// ran out, and nothing has changed.
int material_update_ranges(ovoid_world *w, double ahead);

#endif
