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

// The old corners that a candidate keeps.
static const uint8_t candidates_kept[8] = {1 | 2, 2 | 4, 4 | 1, 0, 1, 2, 4, 0};

#endif
