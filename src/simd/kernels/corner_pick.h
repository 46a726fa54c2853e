// What the kernels of a step of GJK have in common.
#ifndef OVOID_SIMD_KERNELS_CORNER_PICK_H
#define OVOID_SIMD_KERNELS_CORNER_PICK_H

#include "simd/corner.h"

#include <stdint.h>

// The old corners that a direction of corner.c keeps: of faces, 0 to 2, of edges, 4 to 6, and of the new corner, 7.
static const uint8_t corner_kept[8] = {1 | 2, 2 | 4, 4 | 1, 0, 1, 2, 4, 0};

#endif
