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
    // A direction that parts some of the nodes, by nodes_frame_set_normal.
    vec3 normal;     ///< unit, world; zero: none
    vec3 in_a, in_b; ///< along the axes of each
    double offset;   ///< of the frames' origins along it
} nodes_frame;

void nodes_frame_make(const solid_view *a, const solid_view *b, nodes_frame *frame);
/// Another direction to try first; any numbers are safe.
void nodes_frame_set_normal(nodes_frame *frame, vec3 normal);

/// What a bound was found by.
typedef enum nodes_means { NODES_SPHERES, NODES_NORMAL, NODES_BOX_A, NODES_BOX_B, NODES_PARTS } nodes_means;
typedef struct nodes_bound {
    double lower;
    nodes_means means;
} nodes_bound;

/// How far apart the nodes are; negative where they overlap. Proven, rounding included. `enough`: a bound above it need
/// not be the best.
nodes_bound nodes_compute_lower(const nodes_frame *frame, const compound_node *a, const compound_node *b,
                                double enough);

/// The unit direction, world, that shows the bound; normal: that of the frame at the time.
vec3 nodes_compute_normal(const nodes_frame *frame, const compound_node *a, const compound_node *b, nodes_means means,
                          vec3 normal);

/// The same for two parts, by their own spheres (NODES_PARTS) and by their supports along the frame's normal
/// (NODES_NORMAL).
nodes_bound parts_compute_lower(const nodes_frame *frame, const compound_part *a, const compound_part *b,
                                double enough);

/// The unit direction, world, between the spheres.
vec3 parts_compute_normal(const nodes_frame *frame, const compound_part *a, const compound_part *b);

#endif
