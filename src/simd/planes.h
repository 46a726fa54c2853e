// The vector kernel of a growing polytope: the planes between a new point and its horizon.
#ifndef OVOID_SIMD_PLANES_H
#define OVOID_SIMD_PLANES_H

#include "linear/vec3.h"

#include <stdint.h>

enum { SIMD_CONE = 16 };
#define SIMD_AREA_MIN 1e-250

/// The triangles (r[i], r[i + 1], apex) of a cone over a ring of points: edges r[i] - apex in, planes out, structure of
/// arrays. With N = edge[i] x edge[i + 1]:
typedef struct simd_cone {
    double edge[3][SIMD_CONE + 4]; ///< x, y, z; one more than there are triangles, and finite up to the next four
    double n[3][SIMD_CONE];        ///< N divided by its length; undivided where area is at most SIMD_AREA_MIN
    double offset[SIMD_CONE];      ///< n.apex
    double area[SIMD_CONE];        ///< |N|^2
    double product[SIMD_CONE];     ///< |edge[i]|^2 |edge[i + 1]|^2
    double sum[SIMD_CONE];         ///< |edge[i]|^2 + |edge[i + 1]|^2
} simd_cone;

/// The planes of the first `count` triangles (at most SIMD_CONE), and maybe of the next up to a multiple of four. The
/// same bits from every instruction set.
void simd_compute_cone(simd_cone *c, uint32_t count, vec3 apex);

/// The scalar twin.
void simd_compute_cone_scalar(simd_cone *c, uint32_t count, vec3 apex);

#endif
