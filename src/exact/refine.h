// The last stage: the sign and the bracket where doubles cannot decide them.
#ifndef OVOID_EXACT_REFINE_H
#define OVOID_EXACT_REFINE_H

#include "pair/search.h"

/// Continues in double-double where the search ended near contact or short of the tolerance without an answer; else
/// does nothing. Its results go into the search: bounds with their evidence, the direction in world and world_low.
void refine_run(search *s, const ovoid_pair *pair);

#endif
