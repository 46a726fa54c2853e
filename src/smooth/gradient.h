// What gradients of the exact distance are made of: the features that hold the witness points, angles, torques.
#ifndef OVOID_SMOOTH_GRADIENT_H
#define OVOID_SMOOTH_GRADIENT_H

#include "ovoid/smooth.h"
#include "pair/frame.h"

/// The feature of one body that holds its witness point.
typedef struct feature {
    const ovoid_shape *shape;
    vec3 n;     ///< body frame, outward
    vec3 point; ///< body frame
    uint32_t v[OVOID_PROOF_PAIRS];
    int count; ///< vertices: 1, 2 or more
    vec3 edge; ///< where count is 2, the unit direction between them
    double slope;
} feature;

/// Vertices with weights.
typedef struct weighted_vertices {
    const uint32_t *index;
    const double *weight;
    uint32_t count;
} weighted_vertices;

/// The feature of vertices; its slope: the least of the edges that leave it, along n. Of a round body the point alone.
feature feature_make(const ovoid_shape *shape, vec3 n, weighted_vertices of);

/// An upper bound of the angle whose cosine is 1 - rest; pi where rest is not below 2.
double gradient_find_angle_above(double rest);

/// Puts a normal and the torques at two points of the bodies (world axes, from their own body frames' origins) into the
/// gradient.
void gradient_put(const pair_frame *f, vec3 n, vec3 point_a, vec3 point_b, ovoid_gradient *out);

/// The gradient of cylinders and cones as they are: refined from an answer's proof by points of two bodies that are
/// apart, and taken where it is shown. Each body is its polyhedron without an allowance, or round. docs/smooth.md
/// derives it.
void gradient_refine_round(const pair_frame *f, const ovoid_pair *pair, const ovoid_proof *proof, ovoid_gradient *out);

#endif
