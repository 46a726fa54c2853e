// The support of a body of many vertices: from a direction to the few vertices that can be extreme along it, at a cost
// that does not depend on their number.
#ifndef OVOID_AREA_LOOKUP_H
#define OVOID_AREA_LOOKUP_H

#include "linear/mat3.h"
#include "ovoid/base.h"
#include "simd/cell.h"

/// How a direction n finds its cell: root n on the cube's 6 k k cells. k = 0: there is no table.
typedef struct lookup {
    sym3 root;
    double scale; ///< k / 2
    uint32_t k;
    uint32_t cell_count; ///< blocks of the array
} lookup;

/// From LOOKUP_LEAST vertices on a table is made: below, looking at all is as fast.
enum { LOOKUP_LEAST = 96 };

/// The table of the vertices (xyz): its array, cell_count blocks, to be released by the caller; NULL with k = 0 where a
/// table is of no use, or of unusual lengths. OVOID_OK or MEMORY.
ovoid_code lookup_create(const double *xyz, uint32_t count, const ovoid_allocator *allocator, lookup *table,
                         simd_cell **cells);

/// The vertex extreme along n, with the bits of simd_find_support over all vertices; 0 where n is none that a table
/// can be asked about (zero, not finite, of extreme length).
static inline int lookup_find(const lookup *t, const simd_cell *cells, vec3 n, simd_extreme *found) {
    vec3 v = sym3_mul_vec3(t->root, n);
    double x = fabs(v.x), y = fabs(v.y), z = fabs(v.z), m = max2(x, max2(y, z));
    if (!(m > 1e-90 && m < 1e90)) return 0;
    // The cube's face, and the two other coordinates in units of its cells.
    uint32_t axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    double p[3] = {v.x, v.y, v.z}, first = axis == 0 ? v.y : v.x, second = axis == 2 ? v.y : v.z;
    uint32_t face = 2 * axis + (p[axis] < 0);
    double r = (first / m + 1) * t->scale, c = (second / m + 1) * t->scale;
    uint32_t row = (uint32_t)r, column = (uint32_t)c;
    row = row < t->k ? row : t->k - 1;
    column = column < t->k ? column : t->k - 1;
    const simd_cell *cell = &cells[(face * t->k + row) * t->k + column];
    while (cell->count == 0) {
        r = 2 * (r - row);
        c = 2 * (c - column);
        row = r >= 1;
        column = c >= 1;
        cell = &cells[cell->next + 2 * row + column];
    }
    *found = simd_find_in_cell(cell, &cells[cell->next], cell->count, n.x, n.y, n.z);
    return 1;
}

#endif
