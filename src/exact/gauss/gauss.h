// The depth of two small polyhedra from all planes of their difference, without a search.
#ifndef OVOID_EXACT_GAUSS_GAUSS_H
#define OVOID_EXACT_GAUSS_GAUSS_H

#include "pair/search.h"
#include "simd/gauss.h"

/// Takes the depth of two polyhedra that have Gauss maps (shape/gauss_map.h), to rounding, with its witness. Where a
/// cover is wanted, EPA grows it: so a depth has the same bits with a cover and without, unless that surface shows
/// less. Two boxes are left to exact/boxes.h. 0 if a shape has no map, or if the depth or the cover is not beyond
/// rounding: then nothing is taken. frame_relate is done. Cost: two thirds of EPA's without a cover.
int gauss_take_depth(search *s, ovoid_cover *cover);

/// The box among the bodies, if one is, in the body frame of the other one.
void gauss_set_box(const pair_frame *f, gauss_box *to);

#endif
