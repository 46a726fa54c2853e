// Points, segments and boxes among one another, in closed form: with their radii, spheres, capsules and rounded boxes.
// No search, no support, and no earlier proof: the same pair has the same answer whatever was asked before.
//
// Errors (docs/error-analysis.md): bounds are widened by CLOSED_CLAIM s.
#ifndef OVOID_EXACT_CLOSED_H
#define OVOID_EXACT_CLOSED_H

#include "exact/small.h"

#define CLOSED_CLAIM (640 * 0x1p-53)

/// 1 for a point, a segment, or a body of eight vertices, which may be a box.
static inline int closed_may_take(const ovoid_shape *s) {
    return (s->vertex_count <= 2) | (s->vertex_count == 8 && s->box.is_right);
}

/// 1 if the pair is one for closed_run: no allowance, and at most one box.
static inline int closed_fits(const ovoid_shape *a, const ovoid_shape *b) {
    int is_thin = (a->vertex_count <= 2) | (b->vertex_count <= 2);
    return is_thin && !(a->has_allowance | b->has_allowance) && closed_may_take(a) && closed_may_take(b);
}

/// The answer to the query, of a pair that fits: 1. 0: the sign is within rounding, or the depth of a box that a point
/// or a segment enters is asked for, and nothing is known. The frame needs only frame_place.
int closed_run(const placed_query *query, small_end *end);

#endif
