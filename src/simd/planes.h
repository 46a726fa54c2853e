// The vector kernel of a growing polytope: the planes of several triangles at once.
#ifndef OVOID_SIMD_PLANES_H
#define OVOID_SIMD_PLANES_H

#include <stdint.h>

enum { SIMD_TRIANGLES = 8 };
#define SIMD_AREA_MIN 1e-250

/// Triangles in and planes out, structure of arrays. With e1 = b - a, e2 = c - a of the corners a, b, c:
typedef struct simd_triangles {
    double corner[3][3][SIMD_TRIANGLES]; ///< a, b, c; x, y, z
    double n[3][SIMD_TRIANGLES];         ///< e1 x e2 divided by its length; undivided where area is at most SIMD_AREA_MIN
    double low[SIMD_TRIANGLES];          ///< least n.corner
    double area[SIMD_TRIANGLES];         ///< |e1 x e2|^2
    double product[SIMD_TRIANGLES];      ///< |e1|^2 |e2|^2
    double sum[SIMD_TRIANGLES];          ///< |e1|^2 + |e2|^2
} simd_triangles;

/// The planes of the first `count` triangles (at most SIMD_TRIANGLES), and maybe of the next up to a multiple of four:
/// those corners too must be finite. The same bits from every instruction set.
void simd_compute_planes(simd_triangles *t, uint32_t count);

/// The scalar twin.
void simd_compute_planes_scalar(simd_triangles *t, uint32_t count);

#endif
