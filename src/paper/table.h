// Tables from cells to the points that can have the largest dot product with a direction of the cell. One table serves
// vertices and polar dual points of facets.
#ifndef OVOID_PAPER_TABLE_H
#define OVOID_PAPER_TABLE_H

#include "linear/vec3.h"

/// The entries of cell c are entries[starts[c]] to entries[starts[c] + counts[c] - 1], ascending.
typedef struct area_table {
    uint32_t cells;
    uint64_t entry_count, entry_capacity;
    uint64_t *starts;
    uint32_t *counts;
    uint32_t *entries;
} area_table;

/// Points in sphere space. For a direction whose largest coordinate is 1, errors[i] bounds the difference between the
/// dot product that a search uses for point i and that with points[i], beyond the rounding of this folder's own
/// arithmetic.
typedef struct area_points {
    const vec3 *points;
    const double *errors;
    uint32_t count; ///< > 0
} area_points;

/// Makes the table: k = 0 for the octants, else 6 k k cells. OVOID_OK or MEMORY (the table is then empty).
ovoid_code area_table_create(area_table *table, const area_points *points, uint32_t k,
                             const ovoid_allocator *allocator);
void area_table_destroy(area_table *table, const ovoid_allocator *allocator);
uint64_t area_table_get_bytes(const area_table *table);

#endif
