// Lower bounds of the signed distance of all parts of two nodes, one of each solid.
#ifndef OVOID_SCENE_NODES_H
#define OVOID_SCENE_NODES_H

#include "scene/compound.h"

/// Two solids in one frame, that of a.
typedef struct nodes_frame {
    mat3 world_a, world_b; ///< the rotations to the world
    mat3 rotation;         ///< x_a = rotation x_b + translation
    mat3 sizes;            ///< the rotation's entries without their signs
    vec3 translation;
    double size;  ///< S
    double claim; ///< what a measured bound is lowered by
    double check; ///< what the measurement of an exclusion may be off by
} nodes_frame;

void nodes_frame_make(const solid_view *a, const solid_view *b, nodes_frame *frame);

/// How far apart the spheres or, where that is more, the boxes are; negative where they overlap. Proven, rounding
/// included. `enough`: a bound above it need not be the best.
double nodes_compute_lower(const nodes_frame *frame, const compound_node *a, const compound_node *b, double enough);

/// A unit direction, world, along which a bound is found that is no less than that of nodes_compute_lower.
vec3 nodes_compute_normal(const nodes_frame *frame, const compound_node *a, const compound_node *b);

#endif
