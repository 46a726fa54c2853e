// Before anything else of two bodies is looked at: are the balls around them farther apart than was asked, or the boxes
// of their roots?
#ifndef OVOID_BODY_FIRST_LOOK_H
#define OVOID_BODY_FIRST_LOOK_H

#include "body/search.h"

/// The whole answer, and the exclusion of all pairs of parts, where they are: 1. The search has its options and trees.
/// boxes: NULL, for the balls; or the gap of the boxes as measured, and its direction in a's frame.
int first_look(const body_search *state, const query_goal *goal, const box_gap *boxes);

#endif
