// Lower bounds of the signed distance of all parts of two nodes, one of each body.
#ifndef OVOID_COMPOUND_NODE_BOUNDS_H
#define OVOID_COMPOUND_NODE_BOUNDS_H

#include "body/body_view.h"

/// The other body in one's own frame: x_own = rotation x_other + translation.
typedef struct nodes_side {
    mat3 rotation;
    mat3 sizes; ///< its entries without their signs
    vec3 translation;
} nodes_side;

/// The relative poses of two bodies, and the bounds of rounding.
typedef struct nodes_frame {
    mat3 world[2];       ///< the rotations of a and b to the world
    nodes_side sides[2]; ///< b in the frame of a, and a in that of b
    double size;         ///< S of node_bounds.c, length
    double claim;        ///< the amount by which a computed bound is lowered
    double check;        ///< the error of measuring an exclusion
    // A direction that separates some parts, by nodes_frame_set_normal.
    vec3 normal;     ///< unit, world, from a to b; zero: none
    vec3 in_a, in_b; ///< the normal along the axes of each
    double offset;   ///< of the frames' origins along it
} nodes_frame;

/// The size and the claim of a frame, for bodies whose origins are `offset` apart.
double nodes_compute_size(const body_view *a, const body_view *b, vec3 offset);
double nodes_compute_claim(const body_view *a, const body_view *b, double size);

void nodes_frame_make(const body_view *a, const body_view *b, nodes_frame *frame);
/// Sets the direction for parts_compute_lower; any numbers are safe.
void nodes_frame_set_normal(nodes_frame *frame, vec3 normal);

/// A node of the other body along the axes of the own one: shared by its pairs with several own nodes.
typedef struct nodes_other {
    const compound_node *node;
    vec3 center, half;
} nodes_other;

/// side: 0 where the own body is a, 1 where it is b.
nodes_other nodes_turn(const nodes_frame *frame, int side, const compound_node *other);

/// What shows a bound: the line of the centres, the boxes along the axes of a or of b, the spheres of two parts, or
/// their vertices along the frame's normal.
typedef enum nodes_means { NODES_LINE, NODES_BOX_A, NODES_BOX_B, NODES_PARTS, NODES_NORMAL } nodes_means;
typedef struct nodes_bound {
    double lower;
    nodes_means means;
} nodes_bound;

/// A lower bound of the signed distance of two nodes, proven with rounding; negative where they overlap. `enough`: a
/// bound above it need not be the best.
nodes_bound nodes_compute_lower(const nodes_frame *frame, int side, const compound_node *own, const nodes_other *other,
                                double enough);

/// The unit direction of a bound, world frame, from a to b.
vec3 nodes_compute_normal(const nodes_frame *frame, const compound_node *a, const compound_node *b, nodes_means means);

/// A lower bound of the signed distance of two parts, by their own spheres and by their supports along the frame's
/// normal.
nodes_bound parts_compute_lower(const nodes_frame *frame, const compound_part *a, const compound_part *b,
                                double enough);

/// The unit direction of a bound of two parts, world frame, from a to b.
vec3 parts_compute_normal(const nodes_frame *frame, const compound_part *a, const compound_part *b, nodes_means means);

#endif
