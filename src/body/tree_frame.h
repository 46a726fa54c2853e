// A pair of posed bodies, each a solid, a shape or a compound, in the frame of the first.
//
// With u = 2^-53, ea, eb the largest point norms in the bodies' frames (of a shape its origin's norm, span and radius),
// t the place of b's frame and S = ea + eb + |t|:
// - the rotation of b in a's frame is off by 82 u, t by 43 u |t| (two rotations of a difference that is off by u);
// - a point of b in a's frame is off by 91 u S, as in pair/frame.h; so is one of a in b's;
// - centres and half sizes of boxes are off by 8 u S beside that, since boxes are rounded outward to single precision
//   when they are made; the largest of gaps, sums and a root by 16 u S;
// - the axes of a box are a rotation but for 12 u in the operator norm, and points along them are off by 4 u S: a
//   length along one axis, the turn between two boxes' axes, a centre there and back, and the extent of the other box
//   along a turned direction are together off by 100 u S;
// - a gap across an axis of each box is measured times the length of their product, at most 1, by the same numbers: off
//   by no more. It counts only above the claim, so the gap itself is above 0, and no less than the product;
// - a gap of two triangles along a unit direction is off by 100 u S, turning the direction to the world moves it by
//   42 u S, and whoever measures it again there is off by 148 u S.
// A bound of boxes is off by all of these but that of triangles, one of triangles by the first, its own and the turn:
// below 405 u S; a bound is lowered by 512 u S and twice what underflow can hide.
// A part of a compound is where the rounded product of two poses has it (compound.h): off by 45 u S more, and by u of
// its body's position; where a compound takes part, a bound is lowered by 8 u of both positions beside that.
#ifndef OVOID_BODY_TREE_FRAME_H
#define OVOID_BODY_TREE_FRAME_H

#include "body/body_tree.h"

#define TREE_CLAIM (512 * 0x1p-53)
#define TREE_CHECK (148 * 0x1p-53)

typedef struct tree_frame {
    mat3 world, world_b;         ///< of a's and of b's frame to the world
    mat3 to_a, to_b;             ///< of b's frame to a's, and of a's to b's: the transpose
    mat3 absolute_a, absolute_b; ///< the sizes of their entries
    vec3 offset;                 ///< of b's frame from a's, world
    vec3 translation;            ///< of b's frame, in a's
    vec3 translation_a;          ///< of a's frame, in b's
    vec3 between;                ///< of b's tree's frame from a's, in a's frame
    double size;                 ///< S
    double claim;                ///< by this a computed bound is lowered
    double check;                ///< the error of measuring an exclusion
} tree_frame;

/// The size and the claim of a frame, for bodies whose origins are `offset` apart.
static inline double trees_compute_size(const body_tree *a, const body_tree *b, vec3 offset) {
    return a->extent + b->extent + vec3_norm(offset);
}
static inline double trees_compute_claim(const body_tree *a, const body_tree *b, double size) {
    double claim = TREE_CLAIM * size + 4 * OVOID_LENGTH_MIN;
    if (!a->compound && !b->compound) return claim;
    return claim + 8 * 0x1p-53 * (vec3_norm(a->pose->position) + vec3_norm(b->pose->position));
}

void tree_frame_make(const body_tree *a, const body_tree *b, tree_frame *frame);

/// The width that a bracket of two bodies may keep beside their allowances.
static inline double tree_frame_compute_tolerance(const tree_frame *f, const ovoid_options *options) {
    return options_compute_tolerance(options, f->size, OVOID_LENGTH_MIN);
}

/// The bound of two boxes, and a unit direction in a's frame that shows it: as the kernel's. normal: one to try, in a's
/// frame; zero: of those across an axis of both boxes the best.
typedef struct box_gap {
    double lower;
    vec3 normal;
} box_gap;
box_gap tree_frame_find_gap(const tree_frame *f, const turned_box *a, const turned_box *b, vec3 normal);

/// A node of a (side 0) or of b (side 1) whose children are bounded in lanes: its axes, and the other body's box.
typedef struct framed_node {
    int side;
    const mat3 *axes;
    const turned_box *rest;
} framed_node;
/// The other body's box as the kernel wants it; the unit of the node's boxes is left to the caller. Where no normal is
/// tried, as of a yes or no, axes across one of each box are tried instead.
solid8_other tree_frame_turn(const tree_frame *f, const framed_node *node, vec3 normal);

/// The bound by the boxes of both roots, lowered by the claim, and its direction in the world: what parts the bodies.
box_gap tree_frame_find_parting(const tree_frame *f, const body_tree *a, const body_tree *b);

#endif
