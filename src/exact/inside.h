// The depth of a point, or of a segment along an edge, in a box, without a search.
#ifndef OVOID_EXACT_INSIDE_H
#define OVOID_EXACT_INSIDE_H

#include "pair/search.h"

/// Takes the depth of a point in a box, or of a segment that is along one of the box's edges, to rounding, with its
/// witness, and its cover if that is not NULL. 0 if the shapes are others, or if the depth is not beyond rounding: then
/// nothing is taken. frame_relate is done. Cost: a third of EPA's.
int inside_take_depth(search *s, ovoid_cover *cover);

#endif
