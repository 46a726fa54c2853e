// Two boxes that are apart, and the depth of two parallelepipeds, without a search.
#ifndef OVOID_EXACT_BOXES_H
#define OVOID_EXACT_BOXES_H

#include "exact/small.h"

/// A face's middle + s u + t v, |s|, |t| <= 1 but for rounding, in that triangle of the face in which it lies. Sets the
/// count, and the weights of the triangle's corner at both ends of u and v, of the next along u, and of the next along
/// v. 1 if that corner is middle + u + v; 0: middle - u - v.
static inline int face_set_weights(double s, double t, evidence *found) {
    int is_high = s + t > 0;
    double along_u = max2(0, (is_high ? 1 - s : 1 + s) / 2), along_v = max2(0, (is_high ? 1 - t : 1 + t) / 2);
    found->weight[0] = max2(0, 1 - along_u - along_v);
    found->weight[1] = along_u;
    found->weight[2] = along_v;
    found->count = 3;
    return is_high;
}

/// 1 if both shapes are boxes.
static inline int boxes_are_right(const ovoid_shape *a, const ovoid_shape *b) {
    return a->box.is_right & b->box.is_right;
}

/// A yes or no of two boxes that one of their 15 axes separates by more than the goal's `far`: 1, with its bounds and
/// its proof, without a search. 0: nothing is known. The frame needs only frame_place.
int boxes_separate(const placed_query *query, small_end *end);

/// Takes the depth of two shapes that are parallelepipeds, with its witness, and its cover if that is not NULL. 0 if
/// the shapes are others, if they are apart or nearly touch, or if edges of theirs are parallel, or a face and an edge,
/// to rounding: then nothing is taken. frame_relate is done. Cost: 15 planes in lanes, a third of EPA's.
int boxes_take_depth(search *s, ovoid_cover *cover);

#endif
