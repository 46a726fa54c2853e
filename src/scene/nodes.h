// Lower bounds of the signed distance of all parts of two nodes, one of each solid.
#ifndef OVOID_SCENE_NODES_H
#define OVOID_SCENE_NODES_H

#include "scene/compound.h"

/// The other solid as one sees it: x_own = rotation x_other + translation.
typedef struct nodes_side {
    mat3 rotation;
    mat3 sizes; ///< its entries without their signs
    vec3 translation;
} nodes_side;

/// Two solids.
typedef struct nodes_frame {
    mat3 world[2];       ///< the rotations of a and b to the world
    nodes_side sides[2]; ///< b as a sees it, a as b does
    double size;         ///< S
    double claim;        ///< what a measured bound is lowered by
    double check;        ///< what the measurement of an exclusion may be off by
    // A direction that parts some parts, by nodes_frame_set_normal.
    vec3 normal;     ///< unit, world, from a to b; zero: none
    vec3 in_a, in_b; ///< along the axes of each
    double offset;   ///< of the frames' origins along it
} nodes_frame;

void nodes_frame_make(const solid_view *a, const solid_view *b, nodes_frame *frame);
/// Another direction for parts_compute_lower; any numbers are safe.
void nodes_frame_set_normal(nodes_frame *frame, vec3 normal);

/// A node of the other solid, along the axes of the own one: what its pairs with several own nodes share.
typedef struct nodes_other {
    const compound_node *node;
    vec3 center, half;
} nodes_other;

/// side: 0 where the own solid is a, 1 where it is b.
nodes_other nodes_turn(const nodes_frame *frame, int side, const compound_node *other);

/// What a bound was found by: the line of the centres, the boxes along the axes of a or of b, the spheres of two parts,
/// their vertices along the frame's normal.
typedef enum nodes_means { NODES_LINE, NODES_BOX_A, NODES_BOX_B, NODES_PARTS, NODES_NORMAL } nodes_means;
typedef struct nodes_bound {
    double lower;
    nodes_means means;
} nodes_bound;

/// How far apart the nodes are; negative where they overlap. Proven, rounding included. `enough`: a bound above it need
/// not be the best.
nodes_bound nodes_compute_lower(const nodes_frame *frame, int side, const compound_node *own, const nodes_other *other,
                                double enough);

/// The unit direction, world, that shows the bound.
vec3 nodes_compute_normal(const nodes_frame *frame, const compound_node *a, const compound_node *b, nodes_means means);

/// The same for two parts, by their own spheres and by their supports along the frame's normal.
nodes_bound parts_compute_lower(const nodes_frame *frame, const compound_part *a, const compound_part *b,
                                double enough);

/// Likewise.
vec3 parts_compute_normal(const nodes_frame *frame, const compound_part *a, const compound_part *b, nodes_means means);

#endif
