// The lower bound of bodies of which one is a true cylinder or cone, by their own supports.
#ifndef OVOID_EXACT_ROUND_H
#define OVOID_EXACT_ROUND_H

#include "pair/search.h"

/// Raises the lower bound of a search that has ended, from its normal n. The goal's tolerance is that of the shapes.
void round_run(search *s, vec3 n);

#endif
