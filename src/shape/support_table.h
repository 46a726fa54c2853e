// The support function of a body of many vertices: from a direction to the few vertices that can be extreme along it,
// at a cost that does not depend on the number of vertices.
#ifndef OVOID_SHAPE_SUPPORT_TABLE_H
#define OVOID_SHAPE_SUPPORT_TABLE_H

#include "linear/mat3.h"
#include "ovoid/polytope.h"
#include "simd/support_cell.h"

/// The map from a direction n to its cell: root n falls in one of the cube's 6 k k cells. k = 0: there is no table.
typedef struct support_table {
    sym3 root;
    double scale; ///< k / 2
    uint32_t k;
    uint32_t cell_count; ///< blocks of the array
} support_table;

/// The smallest number of vertices of a body with a table; for fewer, a search of all vertices is as fast.
enum { SUPPORT_TABLE_LEAST = 96 };

/// A block of a cell's list, or a divided cell: simd_cell without its coordinates.
typedef struct support_block {
    uint32_t index[SIMD_CELL], count, next;
} support_block;

/// The table of a polytope's vertices and its cell_count blocks, which the caller releases. NULL and k = 0 if a table
/// would not help, the lengths are unusual or a vertex has no neighbor. OVOID_OK or MEMORY.
ovoid_code support_table_create(const ovoid_polytope *polytope, const ovoid_allocator *allocator, support_table *table,
                                support_block **blocks);

/// Fills `count` cells from the blocks and the coordinates of the vertices, x y z of each.
void support_table_fill(const double *vertices, const support_block *blocks, uint32_t count, simd_cell *cells);

/// The cell of a direction; NULL if n is zero, not finite or of extreme length.
static inline const simd_cell *support_table_find_cell(const support_table *t, const simd_cell *cells, vec3 n) {
    vec3 v = sym3_mul_vec3(t->root, n);
    double m = vec3_max_abs(v);
    if (!(m > 1e-90 && m < 1e90)) return NULL;
    // The cube's face, and the two other coordinates in units of its cells.
    uint32_t axis = (uint32_t)vec3_find_largest(vec3_abs(v));
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
    return cell;
}

/// The vertex extreme along n, with the bits of simd_find_support over all vertices. Returns 0 without a result if n
/// has no cell.
static inline int support_table_find(const support_table *t, const simd_cell *cells, vec3 n, simd_extreme *found) {
    const simd_cell *cell = support_table_find_cell(t, cells, n);
    if (!cell) return 0;
    *found = simd_find_in_cell(cell, &cells[cell->next], cell->count, &n);
    return 1;
}

#endif
