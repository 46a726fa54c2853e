// Lower bounds of the signed distance of all parts of two nodes, one of each body.
#ifndef OVOID_BODY_NODE_BOUNDS_H
#define OVOID_BODY_NODE_BOUNDS_H

#include "body/tree_frame.h"

/// A direction that separates some parts: any numbers are safe.
typedef struct parts_direction {
    vec3 normal;     ///< unit, world, from a to b; zero: none
    vec3 in_a, in_b; ///< the normal along the axes of each
    double offset;   ///< of the frames' origins along it
} parts_direction;

parts_direction parts_direction_make(const tree_frame *frame, vec3 normal);

/// A node of the other body along the axes of the own one: shared by its pairs with several own nodes.
typedef struct nodes_other {
    int side; ///< 0 where the own body is a, 1 where it is b
    const compound_node *node;
    vec3 center, half;
} nodes_other;

nodes_other nodes_turn(const tree_frame *frame, int side, const compound_node *other);

/// What shows a bound: the line of the centres, the boxes along the axes of a or of b, the spheres of two parts, or
/// their vertices along a known direction.
typedef enum nodes_means { NODES_LINE, NODES_BOX_A, NODES_BOX_B, NODES_PARTS, NODES_NORMAL } nodes_means;
typedef struct nodes_bound {
    double lower;
    nodes_means means;
} nodes_bound;

/// A lower bound of the signed distance of two nodes, proven with rounding; negative where they overlap. `enough`: a
/// bound above it need not be the best.
nodes_bound nodes_compute_lower(const tree_frame *frame, const compound_node *own, const nodes_other *other,
                                double enough);

/// The unit direction of a bound, world frame, from a to b.
vec3 nodes_compute_normal(const tree_frame *frame, const compound_node *a, const compound_node *b, nodes_means means);

typedef struct part_pair {
    const compound_part *a, *b;
} part_pair;

/// A lower bound of the signed distance of two parts, by their own spheres and by their supports along the direction.
nodes_bound parts_compute_lower(const tree_frame *frame, const parts_direction *direction, const part_pair *pair,
                                double enough);

/// The unit direction of a bound of two parts by their spheres, world frame, from a to b.
vec3 parts_compute_normal(const tree_frame *frame, const compound_part *a, const compound_part *b);

#endif
