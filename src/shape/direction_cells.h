// Cells of directions in the space where the ellipsoid is the unit sphere: octants, and the cells of a cube map.
//
// An octant's number has bit 0 if x < 0, bit 1 if y < 0, bit 2 where z < 0. A cube cell is face (0..5: +x, -x,
// +y, -y, +z, -z), row and column; its cone is spanned by four corners (1, a, b), a and b multiples of 2/k, exact in
// doubles. A cell with k divides into four with 2k; from k = 2 on it lies in one octant.
#ifndef OVOID_SHAPE_DIRECTION_CELLS_H
#define OVOID_SHAPE_DIRECTION_CELLS_H

#include "linear/vec3.h"

/// The octant of a vector.
static inline uint32_t octant_of(vec3 v) { return (uint32_t)((v.x < 0) | (v.y < 0) << 1 | (v.z < 0) << 2); }

/// The vector of a cube face's point (a, b), a and b in [-1, 1].
static inline vec3 cube_point(uint32_t face, double a, double b) {
    double s = face & 1 ? -1 : 1;
    return face < 2 ? (vec3){s, a, b} : face < 4 ? (vec3){a, s, b} : (vec3){a, b, s};
}

/// The number of the cell in that row and column of a face.
static inline uint32_t cube_cell(uint32_t face, uint32_t row, uint32_t column, uint32_t k) {
    return (face * k + row) * k + column;
}

/// The column that holds a in [-1, 1]. The sum is off by at most 2^-53: a may be that far outside the column.
static inline uint32_t cube_column(double a, uint32_t k) {
    uint32_t i = (uint32_t)((a + 1) * (0.5 * k));
    return i < k ? i : k - 1;
}

/// The cell of a direction; cell 0 for one that is zero or not finite.
static inline uint32_t cube_cell_of(vec3 v, uint32_t k) {
    double x = fabs(v.x), y = fabs(v.y), z = fabs(v.z), m = fmax(x, fmax(y, z));
    if (!(m > 0) || !vec3_is_finite(v)) return 0;
    if (m == x) return cube_cell(v.x < 0, cube_column(v.y / m, k), cube_column(v.z / m, k), k);
    if (m == y) return cube_cell(2 + (v.y < 0), cube_column(v.x / m, k), cube_column(v.z / m, k), k);
    return cube_cell(4 + (v.z < 0), cube_column(v.x / m, k), cube_column(v.y / m, k), k);
}

#endif
