// How deep in a body a point is, and points that two bodies have in common.
#ifndef OVOID_SOLID_CLEARANCE_H
#define OVOID_SOLID_CLEARANCE_H

#include "body/tree_frame.h"

/// A pair of bodies in the frame of the first.
typedef struct framed_pair {
    const tree_frame *frame;
    const body_tree *a, *b;
} framed_pair;

/// What parts the bodies by all points, along the best of some directions (parting.c). normal: one to try, world frame.
box_gap framed_pair_find_parting(const framed_pair *pair, vec3 normal);

/// The clearance of a point in a body: above 0 the body covers a ball of that radius around the point; else a point of
/// the body is no farther from it than minus the clearance. side: 0 for a, 1 for b; point: in a's frame. linear: all
/// triangles are looked at, without the tree. Off by less than frame->check and what that counts for a compound.
double framed_pair_find_clearance(const framed_pair *framed, int side, vec3 point, int linear);

/// Pairs of leaves, by their places, whose surfaces touch flush or may.
typedef struct flush_pairs {
    uint32_t count;
    struct {
        uint32_t a, b;
    } pair[24];
} flush_pairs;

/// A point that shows an overlap, in a's frame: the bodies' clearances there add up to `depth` at least.
typedef struct common_point {
    vec3 point;
    double depth;
} common_point;

/// Looks for a point that shows an overlap deeper than frame->claim; 0 where it finds none. Bounded work.
int framed_pair_find_common_point(const framed_pair *pair, const flush_pairs *flush, common_point *found);

#endif
