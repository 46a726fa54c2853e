// A claimed surface of a hull, and the flaw that refutes a claim.
#ifndef OVOID_POLYTOPE_SURFACE_CLAIM_H
#define OVOID_POLYTOPE_SURFACE_CLAIM_H

#include "linear/vec3.h"

/// A surface that is claimed to be the hull of points of full dimension, each of them extreme.
typedef struct surface_claim {
    const double *xyz; ///< the points
    size_t count;
    const uint32_t *triangles; ///< three points each, counter-clockwise from outside
    uint32_t triangle_count;
    vec3 inside; ///< a point of the interior
} surface_claim;

/// Why a claim does not hold.
typedef struct surface_flaw {
    const char *what;
    uint32_t index; ///< of the triangle, or of the vertex
    int is_vertex;
} surface_flaw;

#endif
