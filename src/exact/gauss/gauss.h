// The depth of two small polyhedra from all planes of their difference, without a search.
#ifndef OVOID_EXACT_GAUSS_GAUSS_H
#define OVOID_EXACT_GAUSS_GAUSS_H

#include "pair/search.h"

/// Takes the depth of two polyhedra that have Gauss maps (shape/gauss_map.h), to rounding, with its witness, without a
/// cover. Two boxes are left to exact/boxes.h. 0 if a shape has no map, or if the depth is not beyond rounding: then
/// nothing is taken. frame_relate is done. Cost: half of EPA's.
int gauss_take_depth(search *s);

#endif
