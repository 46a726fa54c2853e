// A table for support functions: the areas of W.-K. Su, J.-S. Liu, I-F. Chen, Enhancing Collision Detection Method
// Based on Enclosed Ellipsoid by Facial Areas Splitting, 3.2-3.3, as a cube map of directions whose cells list the
// vertices that can be extreme. A cell with too long a list is divided into four, recursively.
//
// Directions are mapped by the root of the vertices' second moments, which makes those of a stretched body even. The
// map is only where the cells are: products are taken in the body frame, so an answer is that of a search of all
// vertices, bit for bit.
//
// Theorem (as in paper/table.c). Let the directions r_1 .. r_4 span a cone and x_i.r_k > x_j.r_k + e for each of them,
// where e exceeds the rounding of both products for any direction of the cone that is a sum of w_k r_k with sum 1. Then
// j is never the extreme vertex of a direction of the cone, as computed: i is ahead by more than the rounding. So a
// list may leave out every vertex that one other vertex beats at all four corners; no search in it can miss the extreme
// vertex, nor one that equals it.
//
// Rounding, u = 2^-53: a product with a direction r of the cone is off by 4 u |x| |r|, and so is one with a corner; 32
// u X N covers both products twice, X and N the greatest lengths. A mapped direction is off by 8 u of its length times
// the ratio of the map's radii, at most 1e3, so its place on the cube's face by 1e-12; each cell is taken wider by 1e-7
// of itself, at least 1e-10.
//
// A face of the cube begins with all vertices, each division with the list of the cell around it. The extreme vertices
// at the corners and the centre of a cell beat most vertices; of those left all are tested against all, unless they fit
// one block. Cost: about half a us a vertex. Lists of round bodies have 5 vertices and take 270 bytes a vertex. If
// lists stay long, as for the rings of a cylinder, cells are coarser, and at most 512 bytes a vertex are used.
#include "shape/support_table.h"

#include "base/allocator.h"
#include "base/compiler.h"
#include "linear/both.h"
#include "shape/direction_cells.h"
#include "simd/support.h"

#include <stddef.h>
#include <string.h>

enum { SAMPLES = 9, PAIRS_MAX = 96, NESTED_MOST = 4, K_MOST = 128, LEVELS = 14, WHOLE = 4 };

/// Vertices that may be extreme, padded to a multiple of 8 by the first.
typedef struct list {
    double *x, *y, *z;
    uint32_t *index;
    uint32_t count;
} list;

typedef struct builder {
    const ovoid_allocator *allocator;
    support_table *table;
    simd_cell *cells;
    uint32_t capacity;           ///< the largest number of cells
    uint32_t used, divided_most; ///< cells in use; from divided_most on no cell is divided further
    sym3 inverse;
    double reach;        ///< the largest length of a vertex
    list levels[LEVELS]; ///< room for the lists of a cell and of those around it
    /// Of the square at each level: the vertices that are extreme at nine directions, row by row.
    uint32_t winners[LEVELS][SAMPLES];
    uint8_t *bits;
} builder;

static uint32_t padded(uint32_t count) { return (count + 7) / 8 * 8; }

static void pad(const list *l) {
    const list p = *l;
    for (uint32_t i = p.count, end = padded(p.count); i < end; i++) {
        p.x[i] = p.x[0], p.y[i] = p.y[0], p.z[i] = p.z[0];
        p.index[i] = p.index[0];
    }
}

/// A square of a cube's face.
typedef struct square {
    uint32_t face, quarter; ///< quarter: of the square around it; WHOLE: the face
    double a, b, side;      ///< from (a, b) to (a + side, b + side)
} square;

/// The points that may beat others in the cone of a square, with their products with its corners.
typedef struct contest {
    square s;
    double corners[4][3];
    both_vec3 sides[2]; ///< the same, two by two
    double limits[PAIRS_MAX][4];
    uint32_t count;
    double margin;
} contest;

static vec3 direction_at(const builder *b, const square *s, double row, double column) {
    return sym3_mul_vec3(b->inverse, cube_point(s->face, s->a + row * s->side, s->b + column * s->side));
}

static void contest_make(const builder *b, const square *s, contest *c) {
    double widened = 1e-7, longest = 0;
    for (int k = 0; k < 4; k++) {
        vec3 v = direction_at(b, s, k & 2 ? 1 + widened : -widened, k & 1 ? 1 + widened : -widened);
        c->corners[k][0] = v.x, c->corners[k][1] = v.y, c->corners[k][2] = v.z;
        longest = max2(longest, vec3_norm_squared(v));
    }
    for (int k = 0; k < 2; k++)
        c->sides[k] = both_vec3_make(vec3_at(c->corners[2 * k], 0), vec3_at(c->corners[2 * k + 1], 0));
    c->s = *s;
    c->count = 0;
    c->margin = 32 * 0x1p-53 * b->reach * sqrt(longest);
}

/// Adds point i of the list to the points that may beat others.
static void enter(contest *c, const list *l, uint32_t i) {
    both_vec3 p = {both_set(l->x[i]), both_set(l->y[i]), both_set(l->z[i])};
    for (int k = 0; k < 2; k++)
        both_store(&c->limits[c->count][2 * k], both_vec3_dot(p, c->sides[k]) - both_set(c->margin));
    c->count++;
}

/// Copies the points whose bit is set; *to may be the list itself.
static void keep(const uint8_t *all, const list *from, list *to) {
    uint32_t kept = 0, count = from->count;
    const list f = *from, t = *to;
    for (uint32_t block = 0; 8 * block < count; block++) {
        unsigned bits = all[block];
        if (count - 8 * block < 8) bits &= (1u << (count - 8 * block)) - 1;
        for (; bits; bits &= bits - 1, kept++) {
            uint32_t i = 8 * block + (uint32_t)__builtin_ctz(bits);
            t.x[kept] = f.x[i], t.y[kept] = f.y[i], t.z[kept] = f.z[i];
            t.index[kept] = f.index[i];
        }
    }
    to->count = kept;
    pad(to);
}

static simd_points get_points(const list *l) { return (simd_points){l->x, l->y, l->z, padded(l->count)}; }

/// Copies the points that are not beaten; *to may be the list itself.
static void cull(const builder *b, const contest *c, const list *from, list *to) {
    simd_cull by = {(const double(*)[3])c->corners, (const double(*)[4])c->limits, c->count};
    simd_points points = get_points(from);
    simd_find_unbeaten(&by, &points, b->bits);
    keep(b->bits, from, to);
}

/// The vertex of the list of a square that is extreme at a direction of the square.
static uint32_t find_winner(const builder *b, const list *l, const square *s, uint32_t row, uint32_t column) {
    simd_points points = get_points(l);
    return l->index[simd_find_support(&points, direction_at(b, s, 0.5 * row, 0.5 * column)).index];
}

/// Adds the vertices that are extreme at the corners of the square and at its centre, each once. The corners are among
/// the nine directions of the square around it.
static void enter_winners(builder *b, contest *c, int level) {
    uint32_t *own = b->winners[level], found[5];
    const square *s = &c->s;
    for (uint32_t i = 0; i < 5; i++) {
        uint32_t row = i == 4 ? 1 : i & 2, column = i == 4 ? 1 : 2 * (i & 1), before = 0;
        own[3 * row + column] =
            i < 4 && s->quarter != WHOLE
                ? b->winners[level - 1][3 * ((s->quarter >> 1) + row / 2) + (s->quarter & 1) + column / 2]
                : find_winner(b, &b->levels[level], s, row, column);
        found[i] = own[3 * row + column];
        while (found[before] != found[i]) before++;
        if (before == i) enter(c, &b->levels[0], found[i]);
    }
}

/// Finds the vertices that are extreme at the middles of the square's sides, before it is divided. l: its own list.
static void find_middles(builder *b, const square *s, const list *l, int level) {
    for (uint32_t i = 1; i < SAMPLES; i += 2) b->winners[level][i] = find_winner(b, l, s, i / 3, i % 3);
}

/// Copies the points that no other point of the list beats.
static void cull_by_pairs(const builder *b, contest *c, const list *from, list *to) {
    c->count = 0;
    for (uint32_t i = 0; i < from->count; i++) enter(c, from, i);
    cull(b, c, from, to);
}

/// Copies the points that the extreme points at five directions of the cell do not beat.
static void cull_by_samples(builder *b, contest *c, int level) {
    enter_winners(b, c, level);
    cull(b, c, &b->levels[level], &b->levels[level + 1]);
}

static square quarter(const square *s, uint32_t i) {
    double side = 0.5 * s->side;
    return (square){s->face, i, s->a + (i >> 1) * side, s->b + (i & 1) * side, side};
}

/// Reserves consecutive blocks; 0 if there are too many.
static int reserve(builder *b, uint32_t blocks, uint32_t *at) {
    *at = b->used;
    if (blocks > b->capacity - b->used) return 0;
    b->used += blocks;
    return 1;
}

/// Fills a block's entries and clears what follows them, padding too, so that equal shapes are equal blocks.
static void fill_block(simd_cell *cell, const list *l, uint32_t first) {
    memset((char *)cell + offsetof(simd_cell, count), 0, sizeof *cell - offsetof(simd_cell, count));
    for (uint32_t i = 0; i < SIMD_CELL; i++) {
        uint32_t k = first + i < l->count ? first + i : first;
        cell->x[i] = l->x[k], cell->y[i] = l->y[k], cell->z[i] = l->z[k];
        cell->index[i] = l->index[k];
    }
}

static int fill_list(builder *b, uint32_t at, const list *l) {
    uint32_t more = (l->count + SIMD_CELL - 1) / SIMD_CELL - 1, next = 0;
    if (more && !reserve(b, more, &next)) return 0;
    fill_block(&b->cells[at], l, 0);
    b->cells[at].count = l->count;
    b->cells[at].next = next;
    for (uint32_t i = 0; i < more; i++) fill_block(&b->cells[next + i], l, (i + 1) * SIMD_CELL);
    return 1;
}

/// Fills the cell at a place of the array from the candidates of the cell around it, which are at `level`. nested: the
/// number of divisions of the cell.
static int fill_cell(builder *b, const square *s, uint32_t at, int level, int nested) {
    contest c;
    list *l = &b->levels[level + 1];
    contest_make(b, s, &c);
    cull_by_samples(b, &c, level);
    if (l->count > SIMD_CELL && l->count <= PAIRS_MAX) cull_by_pairs(b, &c, l, l);
    if (l->count <= SIMD_CELL || nested == NESTED_MOST || b->used > b->divided_most) return fill_list(b, at, l);
    uint32_t next;
    if (!reserve(b, 4, &next)) return 0;
    memset(&b->cells[at], 0, sizeof b->cells[at]);
    b->cells[at].next = next;
    find_middles(b, s, l, level);
    for (uint32_t i = 0; i < 4; i++) {
        square inner = quarter(s, i);
        if (!fill_cell(b, &inner, next + i, level + 1, nested + 1)) return 0;
    }
    return 1;
}

/// Divides a square of a face down to the cells of the grid. row, column: the square's place in the face divided
/// `level` times.
static int fill_grid(builder *b, const square *s, uint32_t row, uint32_t column, int level) {
    uint32_t k = b->table->k;
    if (1u << level == k) return fill_cell(b, s, cube_cell(s->face, row, column, k), level, 0);
    contest c;
    contest_make(b, s, &c);
    cull_by_samples(b, &c, level);
    find_middles(b, s, &b->levels[level + 1], level);
    for (uint32_t i = 0; i < 4; i++) {
        square inner = quarter(s, i);
        if (!fill_grid(b, &inner, 2 * row + (i >> 1), 2 * column + (i & 1), level + 1)) return 0;
    }
    return 1;
}

/// Fills all cells of a grid of 6 k k; 0 if they take too much memory.
static int fill_all(builder *b) {
    uint32_t k = b->table->k, grid;
    b->used = 0;
    if (!reserve(b, 6 * k * k, &grid)) return 0;
    for (uint32_t face = 0; face < 6; face++) {
        square s = {face, WHOLE, -1, -1, 2};
        if (!fill_grid(b, &s, 0, 0, 0)) return 0;
    }
    return 1;
}

/// The root of the second moments, with radii of a ratio of at most 1e3, and its inverse.
static void find_map(xyz_points given, double size, sym3 *root, sym3 *inverse) {
    const double *xyz = given.xyz;
    uint32_t count = (uint32_t)given.count;
    vec3 sum = {0, 0, 0};
    sym3 q = {0, 0, 0, 0, 0, 0};
    for (uint32_t i = 0; i < count; i++) sum = vec3_add(sum, vec3_scale(vec3_at(xyz, i), 1 / size));
    vec3 mean = vec3_scale(sum, 1.0 / count);
    for (uint32_t i = 0; i < count; i++)
        q = sym3_add(q, sym3_outer(vec3_sub(vec3_scale(vec3_at(xyz, i), 1 / size), mean), 1));
    eigen3 e = sym3_compute_eigen(q);
    double r[3], s[3], unit = sqrt(e.value[2]);
    for (int i = 0; i < 3; i++) {
        r[i] = e.value[i] > 1e-6 * e.value[2] ? sqrt(e.value[i]) / unit : 1e-3;
        s[i] = 1 / r[i];
    }
    *root = sym3_from_eigen(r, e.v);
    *inverse = sym3_from_eigen(s, e.v);
}

/// Allocates the lists; the first has room for all vertices, the lower ones for fewer.
static int make_room(builder *b, const double *xyz, uint32_t count, double **numbers) {
    size_t each = padded(count);
    *numbers = allocator_allocate(b->allocator, LEVELS * each, 4 * sizeof **numbers);
    b->cells = allocator_allocate(b->allocator, b->capacity, sizeof *b->cells);
    if (!*numbers || !b->cells) return 0;
    // Four doubles for each vertex and level: three coordinates and the index. The last level is room for the bits.
    for (int i = 0; i < LEVELS; i++) {
        double *at = *numbers + 4 * each * (size_t)i;
        b->levels[i] = (list){at, at + each, at + 2 * each, (uint32_t *)(at + 3 * each), 0};
    }
    b->bits = (uint8_t *)(*numbers + 4 * each * (LEVELS - 1));
    list *all = &b->levels[0];
    for (uint32_t i = 0; i < count; i++) {
        all->x[i] = xyz[3 * i], all->y[i] = xyz[3 * i + 1], all->z[i] = xyz[3 * i + 2];
        all->index[i] = i;
    }
    all->count = count;
    pad(all);
    return 1;
}

ovoid_code support_table_create(xyz_points given, const ovoid_allocator *allocator, support_table *table,
                                simd_cell **cells) {
    const double *xyz = given.xyz;
    uint32_t count = (uint32_t)given.count;
    double size = 0, *numbers = NULL;
    *table = (support_table){.k = 0};
    *cells = NULL;
    if (count < SUPPORT_TABLE_LEAST) return OVOID_OK;
    for (size_t i = 0; i < 3 * (size_t)count; i++) size = max2(size, fabs(xyz[i]));
    if (!(size > 1e-90 && size < 1e90)) return OVOID_OK;
    builder b = {
        .allocator = allocator, .table = table, .capacity = 2 * count, .divided_most = count, .reach = 1.75 * size};
    table->k = K_MOST;
    while (6 * table->k * table->k > count && table->k > 1) table->k /= 2;
    ovoid_code code = make_room(&b, xyz, count, &numbers) ? OVOID_OK : OVOID_ERROR_MEMORY;
    if (code == OVOID_OK) {
        find_map(given, size, &table->root, &b.inverse);
        while (table->k && !fill_all(&b)) table->k /= 2;
    }
    allocator_release(allocator, numbers);
    if (code != OVOID_OK || !table->k) {
        *table = (support_table){.k = 0};
        allocator_release(allocator, b.cells);
        return code;
    }
    table->scale = 0.5 * table->k;
    table->cell_count = b.used;
    *cells = b.cells;
    return OVOID_OK;
}
