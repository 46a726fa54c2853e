// What the kernels of a step of GJK have in common: the candidates of corner.c, and what they are to whom.
#ifndef OVOID_SIMD_KERNELS_CORNER_PICK_H
#define OVOID_SIMD_KERNELS_CORNER_PICK_H

#include "simd/corner.h"

#include <stdint.h>

// The candidates: faces in 0 to 2, edges in 4 to 6, the corner in 7. Squares of the edges' lengths.
typedef struct candidates {
    _Alignas(32) double x[8];
    _Alignas(32) double y[8];
    _Alignas(32) double z[8];
    _Alignas(32) double edge[4];
} candidates;

// The candidate that the bits name: of the faces, of the edges.
static inline __attribute__((always_inline)) corner_step candidates_pick(const candidates *all, unsigned faces,
                                                                         unsigned edges, int is_inside) {
    static const uint8_t kept[8] = {1 | 2, 2 | 4, 4 | 1, 0, 1, 2, 4, 0}, next[4] = {1, 2, 0, 3};
    unsigned i = (unsigned)__builtin_ctz(faces | edges << 4 | 1u << 7);
    double x = all->x[i], y = all->y[i], z = all->z[i], square = (x * x + y * y) + z * z;
    int is_sliver = (i < 3) & !(square > 1e-4 * (all->edge[i & 3] * all->edge[next[i & 3]]));
    return (corner_step){x, y, z, square, kept[i], is_inside, is_sliver};
}

#endif
