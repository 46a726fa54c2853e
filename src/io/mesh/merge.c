// Merging equal points: the same three numbers, nothing else. A hash table with open addressing over the points of a
// part; expected constant time a point.
#include "io/mesh/mesh_build.h"

#include <stdlib.h>
#include <string.h>

// Three independent products, none of which waits for another; their top bits are well mixed.
static size_t hash_point(const double xyz[3], size_t size) {
    static const uint64_t factors[3] = {0x9e3779b97f4a7c15u, 0xbf58476d1ce4e5b9u, 0x94d049bb133111ebu};
    uint64_t h = 0;
    for (int k = 0; k < 3; k++) {
        double v = xyz[k] + 0.0; // -0 is equal to 0
        uint64_t bits;
        memcpy(&bits, &v, sizeof bits);
        h ^= (bits ^ bits >> 32) * factors[k];
    }
    return (size_t)((h ^ h >> 29) * factors[0] >> 32) & (size - 1);
}

static int is_equal_point(const double *a, const double *b) { return a[0] == b[0] && a[1] == b[1] && a[2] == b[2]; }

// Doubles the table and inserts every point again.
static int table_grow(point_table *table, const mesh_part *part) {
    size_t size = table->size ? table->size * 2 : 1024;
    uint32_t *slots = calloc(size, sizeof *slots);
    if (!slots) return 0;
    free(table->slots);
    table->slots = slots;
    table->size = size;
    for (size_t i = 0; i < table->count; i++) {
        size_t at = hash_point(part->points + 3 * i, size);
        while (slots[at]) at = (at + 1) & (size - 1);
        slots[at] = (uint32_t)i + 1;
    }
    return 1;
}

// The slot of an equal point, or the empty one where it belongs.
static size_t find_slot(const point_table *table, const mesh_part *part, const double *stored) {
    size_t slot = hash_point(stored, table->size);
    for (; table->slots[slot]; slot = (slot + 1) & (table->size - 1))
        if (is_equal_point(part->points + 3 * (size_t)(table->slots[slot] - 1), stored)) break;
    return slot;
}

ovoid_code mesh_add_merged_point(mesh_reader *reader, mesh_part *part, point_table *table, const double xyz[3],
                                 where at, uint32_t *index) {
    // The table holds the points as they are stored, scaled.
    double stored[3] = {xyz[0] * reader->scale, xyz[1] * reader->scale, xyz[2] * reader->scale};
    // Neighbouring triangles share corners, so the last few points are compared first.
    for (int i = 0; i < POINT_TABLE_RECENT && table->count; i++) {
        *index = table->recent[i];
        if (is_equal_point(part->points + 3 * (size_t)*index, stored)) return OVOID_OK;
    }
    if (2 * table->count >= table->size && !table_grow(table, part)) return io_fail_memory(reader->error, reader->path);
    size_t slot = find_slot(table, part, stored);
    if (table->slots[slot]) {
        *index = table->slots[slot] - 1;
    } else {
        ovoid_code code = mesh_add_point(reader, part, xyz, at);
        if (code) return code;
        *index = (uint32_t)table->count++;
        table->slots[slot] = *index + 1;
    }
    table->recent[table->turn++ % POINT_TABLE_RECENT] = *index;
    return OVOID_OK;
}
