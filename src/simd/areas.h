// The kernel of triangles' areas. Up to four lanes wide, as a triangle's corners are gathered one by one.
#ifndef OVOID_SIMD_AREAS_H
#define OVOID_SIMD_AREAS_H

#include "simd/support.h"

/// Triangles over points.
typedef struct simd_triangles {
    const double *xyz;       ///< x, y and z of each point
    const uint32_t *corners; ///< three of each triangle
    uint32_t count;
} simd_triangles;

/// Writes twice the area of each triangle as a vector, counter-clockwise about it, through double-double: in doubles
/// the normal of a thin triangle is off by a rounding over its least angle. Every instruction set gives the same bits.
typedef void areas_function(const simd_triangles *triangles, vec3 *areas);

/// That of the widest instruction set of this machine; that of one, for tests, NULL where it is lacking.
areas_function areas_compute;
areas_function *areas_get(simd_isa isa);

#endif
