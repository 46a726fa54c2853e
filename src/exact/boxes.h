// The depth of two parallelepipeds, without a search.
#ifndef OVOID_EXACT_BOXES_H
#define OVOID_EXACT_BOXES_H

#include "pair/search.h"

/// Takes the depth of two shapes that are parallelepipeds, with its witness, and its cover if that is not NULL. 0 if
/// the shapes are others, if they are apart or nearly touch, or if edges of theirs are parallel, or a face and an edge,
/// to rounding: then nothing is taken. frame_relate is done. Cost: 15 planes in lanes, a third of EPA's.
int boxes_take_depth(search *s, ovoid_cover *cover);

#endif
