// The curve of G. M. Morton, A computer oriented geodetic data base and a new technique in file sequencing, 1966: the
// bits of a point's cell along the three axes, interleaved, are its place.
#include "polytope/curve.h"

#include "linear/box.h"
#include "polytope/sort.h"

#include <string.h>

// Cells along an axis: 2^BITS.
enum { BITS = 10 };

static uint64_t interleave(const uint32_t cell[3]) {
    uint64_t key = 0;
    for (int bit = 0; bit < BITS; bit++)
        for (int c = 0; c < 3; c++) key |= (uint64_t)(cell[c] >> bit & 1) << (3 * bit + c);
    return key;
}

// Sorting entries by the cells of a cube: a flat box spans few cells in its thin direction.
static void fill_entries(const double *grid, uint32_t count, sort_entry *entries) {
    box b = box_make_around(grid, count);
    vec3 size = vec3_sub(b.max, b.min);
    double most = vec3_max_abs(size), scale = most > 0 ? ((1 << BITS) - 1) / most : 0;
    for (uint32_t i = 0; i < count; i++) {
        vec3 p = vec3_scale(vec3_sub(vec3_at(grid, i), b.min), scale);
        uint32_t cell[3] = {(uint32_t)p.x, (uint32_t)p.y, (uint32_t)p.z};
        entries[i] = (sort_entry){interleave(cell), i};
    }
}

int curve_create(const double *grid, uint32_t count, const ovoid_allocator *allocator, curve *c) {
    sort_entry *entries = allocator_allocate(allocator, 2 * (size_t)count, sizeof *entries);
    c->grid = allocator_allocate(allocator, count, 3 * sizeof *c->grid);
    c->given = allocator_allocate(allocator, count, sizeof *c->given);
    int good = entries && c->grid && c->given;
    if (good) {
        fill_entries(grid, count, entries);
        sort_entries(entries, entries + count, count);
        for (uint32_t i = 0; i < count; i++) {
            c->given[i] = entries[i].index;
            memcpy(c->grid + 3 * (size_t)i, grid + 3 * (size_t)entries[i].index, 3 * sizeof *grid);
        }
    }
    allocator_release(allocator, entries);
    if (!good) curve_destroy(c, allocator);
    return good;
}

void curve_destroy(curve *c, const ovoid_allocator *allocator) {
    allocator_release(allocator, c->grid);
    allocator_release(allocator, c->given);
    *c = (curve){0};
}
