// The kernels of hulls: triangles' areas, up to four lanes wide, as a triangle's corners are gathered one by one; and
// which planes a point is not clearly below.
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

/// Planes as structure of arrays; behind the last one up to a multiple of 8 there are planes too, any.
typedef struct simd_planes {
    const double *x, *y, *z, *offset;
    uint32_t count;
} simd_planes;

/// A point, and how high it must be over a plane.
typedef struct heights_query {
    vec3 point;
    double least;
} heights_query;

/// What is found; room for as many as there are planes, of heights up to a multiple of 8.
typedef struct heights_result {
    double *height; ///< ((n.x p.x + n.y p.y) + n.z p.z) - offset, over each plane
    uint16_t *near; ///< the planes over which it is at least `least`, ascending
} heights_result;

/// Returns the number of planes listed. count: at most 65536. Every instruction set gives the same bits.
typedef uint32_t heights_function(const simd_planes *planes, const heights_query *query, const heights_result *out);

/// That of the widest instruction set of this machine; that of one, for tests, NULL where it is lacking.
heights_function heights_find;
heights_function *heights_get(simd_isa isa);

#endif
