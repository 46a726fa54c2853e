// The vector kernel of a table of supports (shape/support_table.h): the best of the few vertices that a cell lists.
#ifndef OVOID_SIMD_SUPPORT_CELL_H
#define OVOID_SIMD_SUPPORT_CELL_H

#include "simd/support.h"

enum { SIMD_CELL = 8 };

/// A block of a cell's list: four cache lines, the coordinates beside the indices.
typedef struct simd_cell {
    _Alignas(64) double x[SIMD_CELL];
    double y[SIMD_CELL], z[SIMD_CELL]; ///< entries that are not used repeat the first
    uint32_t index[SIMD_CELL];         ///< ascending, also from block to block
    uint32_t count;                    ///< of the cell's first block: entries of the whole list; 0: divided
    uint32_t next; ///< of the cell's first block: the first of the blocks with the rest, or of four smaller cells
} simd_cell;

/// A vertex that is extreme, with its place.
typedef struct simd_extreme {
    double value;
    double x, y, z;
    uint32_t index;
} simd_extreme;

/// The vertex of a list of `count` that is extreme along a direction. The first block is at `first`, the others from
/// `more` on; the direction comes by its address, as a copy costs a part of so short a search. The same bits as
/// simd_find_support over the vertices listed.
simd_extreme simd_find_in_cell(const simd_cell *first, const simd_cell *more, uint32_t count, const vec3 *n);
simd_extreme simd_find_in_cell_scalar(const simd_cell *first, const simd_cell *more, uint32_t count, const vec3 *n);

#endif
