// Filling the tables of the areas.
//
// Theorem. Let C be a cone spanned by r_1 .. r_m and p_i . r_k >= p_j . r_k + e_i + e_j for every k, where e bounds the
// rounding of a dot product. Then for no direction of C is the rounded dot product of j the largest: a direction is a
// sum of r_k with weights >= 0, so i stays ahead of j by more than the rounding of both. Leaving j out of the cell is
// sound, whether or not i is kept: no search of the cell could have answered j.
//
// So only points that one other point beats at all corners are left out. In small cells these are nearly all points
// that can be left out: on a fine surface, a point whose own region does not meet the cell has a neighbour, one step
// toward the cell, that beats it everywhere in the cell. First the extreme points at a grid of sample directions are
// tried as the beating points (linear cost), then in short lists all against all. A finer cell begins with the list of
// the coarser one, which is why k is a power of two. An octant is not a small cell; its list is the union of the lists
// of small pieces of it, cube cells of k = 2 to 64.
//
// Rounding, u = 2^-53, directions with largest coordinate 1, so |r| <= sqrt(3): a dot product is off by 6 u |p|, and a
// direction may lie 2 u outside its cell by the rounding of its column. 32 u |p| for e covers both, in the comparison
// here and in the search. Cost: about 30 dot products per point and level, 20 000 points with k = 16 in a tenth of a
// second.
#include "paper/table.h"

#include "base/allocator.h"
#include "shape/direction_cells.h"

#include <string.h>

enum { SAMPLES = 4, FINE_SAMPLES = 12, PAIRS_MAX = 256, PIECE_LIST = 24, PIECE_K = 64 };

/// The working state of filling a table.
typedef struct filler {
    const area_points *points;
    const ovoid_allocator *allocator;
    area_table *table;
    uint32_t k;
    uint32_t *lists;     ///< room for candidates, `points->count` for each level
    double (*values)[4]; ///< dot products at the corners, by place in a list
    double *margins;     ///< error_of, by place in a list
    uint8_t *octants;    ///< where k is 0: bit o where a piece of octant o lists the point
} filler;

/// A cell's four corners, in the order of a grid's (00, 01, 10, 11).
typedef struct cone {
    vec3 corner[4];
} cone;

/// A cell of the cube: row and column of a face that is split into k by k.
typedef struct cube_place {
    uint32_t face, row, column, k;
} cube_place;

/// A list of points by their indices.
typedef struct index_list {
    uint32_t *items, count;
} index_list;

static cone cone_make_cube(cube_place p) {
    double step = 2.0 / p.k, a = p.row * step - 1, b = p.column * step - 1;
    cone c;
    for (int i = 0; i < 4; i++) c.corner[i] = cube_point(p.face, i & 2 ? a + step : a, i & 1 ? b + step : b);
    return c;
}

/// A direction inside: s and t in [0, 1].
static vec3 cone_sample(const cone *c, double s, double t) {
    vec3 v = vec3_scale(c->corner[0], (1 - s) * (1 - t));
    v = vec3_add_scaled(v, c->corner[1], (1 - s) * t);
    return vec3_add_scaled(vec3_add_scaled(v, c->corner[2], s * (1 - t)), c->corner[3], s * t);
}

static double error_of(const area_points *p, uint32_t i) {
    return p->errors[i] + 32 * 0x1p-53 * vec3_norm(p->points[i]);
}

static void fill_values(const filler *f, index_list list, const cone *c) {
    for (uint32_t i = 0; i < list.count; i++) {
        for (int k = 0; k < 4; k++) f->values[i][k] = vec3_dot(f->points->points[list.items[i]], c->corner[k]);
        f->margins[i] = error_of(f->points, list.items[i]);
    }
}

/// 1 if place i of the list beats place j at all corners.
static int is_beating(const filler *f, uint32_t i, uint32_t j) {
    double margin = f->margins[i] + f->margins[j];
    for (int k = 0; k < 4; k++)
        if (!(f->values[i][k] > f->values[j][k] + margin)) return 0;
    return 1;
}

/// The place in the list of the largest dot product.
static uint32_t find_winner(const filler *f, index_list list, vec3 direction) {
    uint32_t best = 0;
    double most = -INFINITY;
    for (uint32_t i = 0; i < list.count; i++) {
        double value = vec3_dot(f->points->points[list.items[i]], direction);
        if (value > most) {
            most = value;
            best = i;
        }
    }
    return best;
}

/// Appends to `kept`, an empty list with room, the points that no extreme point of a grid of sample directions beats.
static index_list cull_by_samples(const filler *f, index_list list, const cone *c, int samples, index_list kept) {
    uint32_t winners[FINE_SAMPLES * FINE_SAMPLES];
    int winner_count = 0;
    for (int s = 0; s < samples; s++)
        for (int t = 0; t < samples; t++) {
            uint32_t w = find_winner(f, list, cone_sample(c, s / (samples - 1.0), t / (samples - 1.0)));
            int slot = 0;
            while (slot < winner_count && winners[slot] != w) slot++;
            if (slot == winner_count) winners[winner_count++] = w;
        }
    fill_values(f, list, c);
    for (uint32_t j = 0; j < list.count; j++) {
        int w = 0;
        while (w < winner_count && !is_beating(f, winners[w], j)) w++;
        if (w == winner_count) kept.items[kept.count++] = list.items[j];
    }
    return kept;
}

/// Drops from the list, in place, the points that another point of it beats.
static index_list cull_by_pairs(const filler *f, index_list list, const cone *c) {
    fill_values(f, list, c);
    index_list kept = {list.items, 0};
    for (uint32_t j = 0; j < list.count; j++) {
        uint32_t i = 0;
        while (i < list.count && !is_beating(f, i, j)) i++;
        if (i == list.count) kept.items[kept.count++] = list.items[j];
    }
    return kept;
}

/// Appends a cell's list to the table; 0 if memory runs out.
static int append(const filler *f, uint32_t cell, index_list list) {
    area_table *t = f->table;
    uint32_t count = list.count;
    if (t->entry_count + count > t->entry_capacity) {
        uint64_t capacity = 2 * (t->entry_capacity + count);
        uint32_t *entries = allocator_allocate(f->allocator, capacity, sizeof *entries);
        if (!entries) return 0;
        if (t->entry_count > 0) memcpy(entries, t->entries, t->entry_count * sizeof *entries);
        allocator_release(f->allocator, t->entries);
        t->entries = entries;
        t->entry_capacity = capacity;
    }
    memcpy(t->entries + t->entry_count, list.items, count * sizeof *list.items);
    t->starts[cell] = t->entry_count;
    t->counts[cell] = count;
    t->entry_count += count;
    return 1;
}

/// Culls a cell's list, behind which there is room for another, once more and appends it to the table.
static int finish_cell(const filler *f, uint32_t cell, const cone *c, index_list list) {
    index_list behind = {list.items + f->points->count, 0};
    if (list.count > PAIRS_MAX) list = cull_by_samples(f, list, c, FINE_SAMPLES, behind);
    if (list.count <= PAIRS_MAX) list = cull_by_pairs(f, list, c);
    return append(f, cell, list);
}

/// 1 if a piece of an octant needs no further division: its list is short, or the piece small.
static int is_piece(uint32_t k, uint32_t count) { return k >= 2 && (count <= PIECE_LIST || k >= PIECE_K); }

/// The octant's bit for every point of the piece's list.
static void mark_octant(const filler *f, uint32_t octant, const cone *c, index_list list) {
    if (list.count <= PAIRS_MAX) list = cull_by_pairs(f, list, c);
    for (uint32_t i = 0; i < list.count; i++) f->octants[list.items[i]] |= (uint8_t)(1u << octant);
}

/// Fills a cell of the cube from the candidates of the cell around it; room: free lists.
static int fill_cube(const filler *f, cube_place p, index_list candidates, uint32_t *room) {
    cone c = cone_make_cube(p);
    index_list kept = cull_by_samples(f, candidates, &c, SAMPLES, (index_list){room, 0});
    if (p.k == f->k) return finish_cell(f, cube_cell(p.face, p.row, p.column, p.k), &c, kept);
    if (f->k == 0 && is_piece(p.k, kept.count)) {
        mark_octant(f, octant_of(cone_sample(&c, 0.5, 0.5)), &c, kept);
        return 1;
    }
    for (uint32_t i = 0; i < 4; i++) {
        cube_place inner = {p.face, 2 * p.row + (i >> 1), 2 * p.column + (i & 1), 2 * p.k};
        if (!fill_cube(f, inner, kept, room + f->points->count)) return 0;
    }
    return 1;
}

static int fill_cells(const filler *f) {
    // The first list: all points.
    uint32_t count = f->points->count, *room = f->lists + count;
    index_list all = {f->lists, count};
    for (uint32_t i = 0; i < count; i++) all.items[i] = i;
    if (f->k == 0) memset(f->octants, 0, count);
    for (uint32_t face = 0; face < 6; face++)
        if (!fill_cube(f, (cube_place){face, 0, 0, 1}, all, room)) return 0;

    // An octant's list: the points that a piece of it lists.
    for (uint32_t octant = 0; f->k == 0 && octant < 8; octant++) {
        index_list marked = {f->lists, 0};
        for (uint32_t i = 0; i < count; i++)
            if (f->octants[i] >> octant & 1) marked.items[marked.count++] = i;
        if (!append(f, octant, marked)) return 0;
    }
    return 1;
}

ovoid_code area_table_create(area_table *table, const area_points *points, uint32_t k,
                             const ovoid_allocator *allocator) {
    // Lists: all points, one for each k from 1 on, one more for finish_cell.
    size_t levels = 3, count = points->count;
    for (uint32_t i = 1; i < (k > 0 ? k : PIECE_K); i *= 2) levels++;
    *table = (area_table){.cells = k == 0 ? 8 : 6 * k * k};
    filler f = {.points = points, .allocator = allocator, .table = table, .k = k};
    table->starts = allocator_allocate(allocator, table->cells, sizeof *table->starts);
    table->counts = allocator_allocate(allocator, table->cells, sizeof *table->counts);
    f.lists = allocator_allocate(allocator, levels * count, sizeof *f.lists);
    f.values = allocator_allocate(allocator, count, sizeof *f.values);
    f.margins = allocator_allocate(allocator, count, sizeof *f.margins);
    f.octants = allocator_allocate(allocator, count, sizeof *f.octants);
    int is_done = table->starts && table->counts && f.lists && f.values && f.margins && f.octants && fill_cells(&f);
    allocator_release(allocator, f.lists);
    allocator_release(allocator, f.values);
    allocator_release(allocator, f.margins);
    allocator_release(allocator, f.octants);
    if (is_done) return OVOID_OK;
    area_table_destroy(table, allocator);
    return OVOID_ERROR_MEMORY;
}

void area_table_destroy(area_table *table, const ovoid_allocator *allocator) {
    allocator_release(allocator, table->starts);
    allocator_release(allocator, table->counts);
    allocator_release(allocator, table->entries);
    *table = (area_table){0};
}

uint64_t area_table_get_bytes(const area_table *table) {
    return table->cells * (sizeof *table->starts + sizeof *table->counts) +
           table->entry_capacity * sizeof *table->entries;
}
