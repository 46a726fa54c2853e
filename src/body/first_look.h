// Before anything else of two bodies is looked at: are the balls around them farther apart than was asked?
#ifndef OVOID_BODY_FIRST_LOOK_H
#define OVOID_BODY_FIRST_LOOK_H

#include "body/search.h"

/// The whole answer, and the exclusion of all pairs of parts, where they are: 1. The search has its options and trees.
int first_look(const body_search *state, const query_goal *goal);

#endif
