// Coordinates in which a needle or a slab is as round as other bodies.
#ifndef OVOID_ELLIPSOID_FRAME_H
#define OVOID_ELLIPSOID_FRAME_H

#include "linear/mat3.h"
#include "ovoid/ellipsoid.h"

/// Orthonormal axes and a box along them that contain the points: y = (axes (x - origin)) / half lies in about [-1,
/// 1]^3, and the points fill a fair part of it, however thin they are.
typedef struct frame {
    uint32_t rank;
    vec3 origin, half; ///< half: half lengths of the box; beyond the rank that of the first axis
    mat3 axes;         ///< rows
} frame;

/// The frame of the vertices, at least two of them; rank 1 to 3.
frame frame_compute(const ovoid_polytope *polytope, uint32_t rank);
/// The coordinates y of the vertices, 3 numbers each; those beyond the rank are 0.
void frame_fill_local(const frame *f, const ovoid_polytope *polytope, double *local);

#endif
