// Merging equal points: the same three numbers, nothing else. A hash table with open addressing over the points of a
// part; expected constant time a point.
#include "io/mesh/mesh_build.h"
#include "tools/hash.h"

#include <stdlib.h>
#include <string.h>

// The points that are merged, and their table.
typedef struct merged_points {
    const uint32_t *slots;
    const double *points;
} merged_points;

static int is_end(const void *table, size_t slot, const void *key) {
    const merged_points *m = table;
    return !m->slots[slot] || hash_is_same_point(m->points + 3 * (size_t)(m->slots[slot] - 1), key);
}

// The slot of an equal point, or the empty one where it belongs.
static size_t find_slot(const point_table *table, const mesh_part *part, const double *stored) {
    merged_points all = {table->slots, part->points};
    return hash_find(hash_point(stored), table->size, &all, stored, is_end);
}

// Doubles the table and inserts every point again.
static int table_grow(point_table *table, const mesh_part *part) {
    size_t size = table->size ? table->size * 2 : 1024;
    uint32_t *slots = calloc(size, sizeof *slots);
    if (!slots) return 0;
    free(table->slots);
    table->slots = slots;
    table->size = size;
    for (size_t i = 0; i < table->count; i++) {
        slots[find_slot(table, part, part->points + 3 * i)] = (uint32_t)i + 1;
    }
    return 1;
}

ovoid_code mesh_add_merged_point(mesh_reader *reader, mesh_part *part, point_table *table, const double xyz[3],
                                 where at, uint32_t *index) {
    // The table holds the points as they are stored, scaled.
    double stored[3] = {xyz[0] * reader->scale, xyz[1] * reader->scale, xyz[2] * reader->scale};
    // Neighbouring triangles share corners, so the last few points are compared first.
    for (int i = 0; i < POINT_TABLE_RECENT && table->count; i++) {
        *index = table->recent[i];
        if (hash_is_same_point(part->points + 3 * (size_t)*index, stored)) return OVOID_OK;
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
