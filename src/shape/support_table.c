// A table for support functions: the areas of W.-K. Su, J.-S. Liu, I-F. Chen, Enhancing Collision Detection Method
// Based on Enclosed Ellipsoid by Facial Areas Splitting, 3.2-3.3, as a cube map of directions whose cells list the
// vertices that can be extreme. A cell with too long a list is divided into four, recursively.
//
// Directions are mapped by the root of the vertices' second moments, which makes those of a stretched body even. The
// map is only where the cells are: products are taken in the body frame, so an answer is that of a search of all
// vertices, bit for bit.
//
// Let the directions r_1 .. r_4 span a cone. A vertex i beats j there if x_i.r_k > x_j.r_k + e for each of them. Then
// x_i.r > x_j.r + e for every r of the cone that is a sum of w_k r_k with sum 1.
//
// Theorem. Let a list hold, with each of its vertices, every neighbor of it that no vertex of the list beats. Then each
// vertex j outside of the list is below the largest product of the list by more than e, for every r of the cone.
// Proof. Let v be the vertex of the list with the largest product. Its neighbors are not above it: those outside of
// the list are beaten. So v is extreme among all vertices, as a linear function on a convex body has no other local
// maximum; this is why the simplex method is right (G. B. Dantzig, 1951). A path over edges leads from j up to the
// extreme vertices and along them to v, and never down. It enters the list over an edge from some w outside to the
// list; w is beaten, so that x_j.r <= x_w.r < x_v.r - e.
// So no search in the list can miss the extreme vertex, nor one that equals it, if e exceeds the rounding of both
// products. A list may then leave out every vertex that another of it beats: what is left beats that one too.
//
// The list of a cell begins with a vertex found by climbing over edges to the cell's centre; the theorem does not rest
// on where the climb ends. It grows over edges by all vertices that those already listed do not beat. If it does not
// fit one block, all are tested against all.
//
// Rounding, u = 2^-53: a product with a direction r of the cone is off by 4 u X N, and so is one with a corner, X and N
// the greatest lengths; e = 32 u X N covers both products twice. Products with corners are computed from the mapped
// vertices, inverse x, and a corner of the cube, entries up to 1: with Y the sum of the sizes of the entries of the
// inverse times the largest coordinate, a mapped vertex is off by 4 u Y, a product by 8 u Y; 32 u Y is added to e. The
// edges of a solid are those of its exact hull. Of a flat body they are those of its projection along the axis nearest
// to its normal n, and n.x varies by no more than f = 64 u X over its vertices. With r' = r - (r_axis / n_axis) n,
// products with r' are those of the projection, for which the theorem holds; they differ from products with r by at
// most sqrt(3) f |r|, apart from a constant. So 4 f N is added to e. A mapped direction is off by 8 u of its length
// times the ratio of the map's radii, at most 1e3, so its place on the cube's face by 1e-12; each cell is taken wider
// by 1e-7 of itself, at least 1e-10.
//
// Cost: about 0.1 us a vertex. Lists of round bodies have 5 to 12 vertices and take 140 to 270 bytes a vertex. If lists
// stay long, as for the rings of a cylinder, cells are coarser, and at most 512 bytes a vertex are used.
#include "shape/support_table.h"

#include "base/allocator.h"
#include "base/compiler.h"
#include "linear/both.h"
#include "polytope/facets.h"
#include "polytope/sort.h"
#include "shape/direction_cells.h"

#include <stddef.h>
#include <string.h>

// FEW: entries that are sorted by insertion. LEAF_MOST: entries of a cell that is not divided; two blocks are read as
// fast as a divided cell and one block.
enum { LIMITS_MAX = 96, FEW = 24, NESTED_MOST = 4, K_MOST = 128, LEAF_MOST = 2 * SIMD_CELL };

/// A vertex on a face of the cube: its product with the face's point (a, b) is m + a p + b q.
typedef struct mapped {
    double m, p, q;
} mapped;

/// Products with the corners of a square.
typedef struct products {
    both low, high;
} products;

typedef struct builder {
    const ovoid_polytope *polytope;
    support_table *table;
    support_block *blocks;
    uint32_t capacity;           ///< the largest number of cells
    uint32_t used, divided_most; ///< cells in use; from divided_most on no cell is divided further
    sym3 inverse;
    double margin;    ///< what a vertex must be ahead by
    mapped *vertices; ///< of the present face
    uint32_t *met;    ///< of each vertex: the last list for which it was tested
    uint32_t stamp;   ///< the number of the present list
    uint32_t *list;   ///< of the present cell
    uint32_t count;   ///< of the list
    uint32_t *scratch;
    products limits[LIMITS_MAX]; ///< of the vertices of the list, less the margin
} builder;

/// A square of a cube's face.
typedef struct square {
    uint32_t face;
    double a, b, side; ///< from (a, b) to (a + side, b + side)
} square;

// ---- the list of a cell ----

/// Climbs over edges from a vertex to one whose neighbors have no larger product with (a, b).
static uint32_t climb(const builder *b, uint32_t vertex, double at_a, double at_b) {
    const ovoid_polytope *p = b->polytope;
    double most = -INFINITY;
    for (uint32_t from = UINT32_MAX; from != vertex;) {
        from = vertex;
        for (uint32_t i = p->neighbor_starts[from]; i < p->neighbor_starts[from + 1]; i++) {
            const mapped *v = &b->vertices[p->neighbors[i]];
            double value = v->m + (at_a * v->p + at_b * v->q);
            if (value > most) most = value, vertex = p->neighbors[i];
        }
    }
    return vertex;
}

/// The coordinates of the corners, two by two, of a square that is a little wider.
typedef struct corners {
    both a[2], b;
} corners;

static corners make_corners(const square *s) {
    double low = -1e-7 * s->side, high = s->side - low;
    return (corners){{both_set(s->a + low), both_set(s->a + high)}, both_make(s->b + low, s->b + high)};
}

static products multiply(const corners *c, const mapped *v) {
    both rest = both_set(v->m) + c->b * both_set(v->q), p = both_set(v->p);
    return (products){rest + c->a[0] * p, rest + c->a[1] * p};
}

/// 1 if all four are below, by the signs of the differences.
static int is_below(const products *v, const products *limit) {
    both_bits below = (both_bits)(v->low - limit->low) & (both_bits)(v->high - limit->high);
    return (below[0] & below[1]) < 0;
}

/// 1 if a vertex of the list beats these products; the one at `likely` is tried first.
static int is_beaten(const builder *b, const products *v, uint32_t likely) {
    uint32_t count = b->count < LIMITS_MAX ? b->count : LIMITS_MAX;
    if (likely < count && is_below(v, &b->limits[likely])) return 1;
    for (uint32_t i = 0; i < count; i++)
        if (is_below(v, &b->limits[i])) return 1;
    return 0;
}

static void append(builder *b, uint32_t vertex, const products *v) {
    both margin = both_set(b->margin);
    if (b->count < LIMITS_MAX) b->limits[b->count] = (products){v->low - margin, v->high - margin};
    b->list[b->count++] = vertex;
}

/// Grows the list from one vertex.
static void grow(builder *b, const corners *c, uint32_t first) {
    const ovoid_polytope *p = b->polytope;
    products v = multiply(c, &b->vertices[first]);
    b->count = 0;
    b->met[first] = ++b->stamp;
    append(b, first, &v);
    for (uint32_t done = 0; done < b->count; done++) {
        uint32_t from = b->list[done];
        for (uint32_t i = p->neighbor_starts[from]; i < p->neighbor_starts[from + 1]; i++) {
            uint32_t to = p->neighbors[i];
            if (b->met[to] == b->stamp) continue;
            b->met[to] = b->stamp;
            v = multiply(c, &b->vertices[to]);
            if (!is_beaten(b, &v, done)) append(b, to, &v);
        }
    }
}

/// Drops the vertices that others of the list beat.
static void cull_by_pairs(builder *b, const corners *c) {
    uint32_t kept = 0, count = b->count;
    for (uint32_t i = 0; i < count; i++) {
        products v = multiply(c, &b->vertices[b->list[i]]);
        if (!is_beaten(b, &v, 0)) b->list[kept++] = b->list[i];
    }
    b->count = kept;
}

static int compare_numbers(const void *context, uint32_t a, uint32_t b) {
    (void)context;
    return a < b ? -1 : a > b;
}

static void sort_list(const builder *b) {
    uint32_t *list = b->list;
    if (b->count > FEW) {
        sort_indices(list, b->scratch, b->count, (index_order){compare_numbers, NULL});
        return;
    }
    for (uint32_t i = 1; i < b->count; i++) {
        uint32_t v = list[i], k = i;
        for (; k > 0 && list[k - 1] > v; k--) list[k] = list[k - 1];
        list[k] = v;
    }
}

static void find_list(builder *b, const square *s, uint32_t first) {
    corners c = make_corners(s);
    grow(b, &c, first);
    if (b->count > SIMD_CELL && b->count <= LIMITS_MAX) cull_by_pairs(b, &c);
}

// ---- cells ----

static square quarter(const square *s, uint32_t i) {
    double side = 0.5 * s->side;
    return (square){s->face, s->a + (i >> 1) * side, s->b + (i & 1) * side, side};
}

/// Reserves consecutive blocks; 0 if there are too many.
static int reserve(builder *b, uint32_t blocks, uint32_t *at) {
    *at = b->used;
    if (blocks > b->capacity - b->used) return 0;
    b->used += blocks;
    return 1;
}

static void fill_block(const builder *b, support_block *block, uint32_t first) {
    *block = (support_block){.count = 0};
    for (uint32_t i = 0; i < SIMD_CELL; i++) block->index[i] = b->list[first + i < b->count ? first + i : first];
}

static int fill_list(builder *b, uint32_t at) {
    sort_list(b);
    uint32_t more = (b->count + SIMD_CELL - 1) / SIMD_CELL - 1, next = 0;
    if (more && !reserve(b, more, &next)) return 0;
    fill_block(b, &b->blocks[at], 0);
    b->blocks[at].count = b->count;
    b->blocks[at].next = next;
    for (uint32_t i = 0; i < more; i++) fill_block(b, &b->blocks[next + i], (i + 1) * SIMD_CELL);
    return 1;
}

/// Fills the cell at a place of the array. near: a vertex to climb from; replaced by that found. nested: the number of
/// divisions of the cell.
static int fill_cell(builder *b, const square *s, uint32_t at, uint32_t *near, int nested) {
    uint32_t next;
    *near = climb(b, *near, s->a + 0.5 * s->side, s->b + 0.5 * s->side);
    find_list(b, s, *near);
    if (b->count <= LEAF_MOST || nested == NESTED_MOST || b->used > b->divided_most) return fill_list(b, at);
    if (!reserve(b, 4, &next)) return 0;
    b->blocks[at] = (support_block){.next = next};
    uint32_t inside = *near;
    for (uint32_t i = 0; i < 4; i++) {
        square inner = quarter(s, i);
        if (!fill_cell(b, &inner, next + i, &inside, nested + 1)) return 0;
    }
    return 1;
}

/// Maps the vertices for a face.
static void map_vertices(const builder *b, uint32_t face) {
    const ovoid_polytope *p = b->polytope;
    for (uint32_t i = 0; i < p->vertex_count; i++) {
        vec3 v = sym3_mul_vec3(b->inverse, vec3_at(p->vertices, i));
        double m = face < 2 ? v.x : face < 4 ? v.y : v.z;
        b->vertices[i] = (mapped){face & 1 ? -m : m, face < 2 ? v.y : v.x, face < 4 ? v.z : v.y};
    }
}

/// Fills all cells of a face, row by row, forth and back, so that the next one is at the side of the last.
static int fill_face(builder *b, uint32_t face, uint32_t *near) {
    uint32_t k = b->table->k;
    double side = 2.0 / k;
    map_vertices(b, face);
    for (uint32_t i = 0; i < k * k; i++) {
        uint32_t row = i / k, column = row & 1 ? k - 1 - i % k : i % k;
        square s = {face, -1 + side * row, -1 + side * column, side};
        if (!fill_cell(b, &s, cube_cell(face, row, column, k), near, 0)) return 0;
    }
    return 1;
}

/// Fills all cells of a grid of 6 k k; 0 if they take too much memory.
static int fill_all(builder *b) {
    uint32_t k = b->table->k, grid;
    b->used = 0;
    if (!reserve(b, 6 * k * k, &grid)) return 0;
    for (uint32_t face = 0, near = 0; face < 6; face++)
        if (!fill_face(b, face, &near)) return 0;
    return 1;
}

/// The root of the second moments, with radii of a ratio of at most 1e3, and its inverse.
static void find_map(const ovoid_polytope *p, double size, sym3 *root, sym3 *inverse) {
    const double *xyz = p->vertices;
    uint32_t count = p->vertex_count;
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

/// 1 if the theorem holds of the neighbors: of solids, and of polygons all of whose vertices are on the loop.
static int has_edges(const ovoid_polytope *p) {
    for (uint32_t v = 0; v < p->vertex_count; v++)
        if (p->neighbor_starts[v] == p->neighbor_starts[v + 1]) return 0;
    return p->rank >= 2;
}

static int make_room(builder *b, const ovoid_allocator *allocator) {
    uint32_t count = b->polytope->vertex_count;
    b->blocks = allocator_allocate(allocator, b->capacity, sizeof *b->blocks);
    b->vertices = allocator_allocate(allocator, count, sizeof *b->vertices + 3 * sizeof *b->met);
    if (!b->vertices || !b->blocks) return 0;
    b->met = (uint32_t *)(b->vertices + count);
    b->list = b->met + count;
    b->scratch = b->list + count;
    memset(b->met, 0, count * sizeof *b->met);
    return 1;
}

/// The sum of the sizes of the entries: at least by what it makes vectors longer.
static double bound_norm(sym3 m) {
    return fabs(m.xx) + fabs(m.yy) + fabs(m.zz) + 2 * (fabs(m.xy) + fabs(m.xz) + fabs(m.yz));
}

static void find_margin(builder *b, double size) {
    double norm = bound_norm(b->inverse), longest = 1.75 * norm;
    b->margin = 0x1p-53 * 32 * (1.75 * size * longest + size * norm);
    if (b->polytope->rank == 2) b->margin += 4.01 * FACET_FLATNESS * size * longest;
}

ovoid_code support_table_create(const ovoid_polytope *p, const ovoid_allocator *allocator, support_table *table,
                                support_block **blocks) {
    uint32_t count = p->vertex_count;
    *table = (support_table){.k = 0};
    *blocks = NULL;
    if (count < SUPPORT_TABLE_LEAST || !has_edges(p)) return OVOID_OK;
    double size = compute_extent(p->vertices, count);
    if (!(size > 1e-90 && size < 1e90)) return OVOID_OK;
    builder b = {.polytope = p, .table = table, .capacity = 2 * count, .divided_most = count};
    table->k = K_MOST;
    while (6 * table->k * table->k > count && table->k > 1) table->k /= 2;
    ovoid_code code = make_room(&b, allocator) ? OVOID_OK : OVOID_ERROR_MEMORY;
    if (code == OVOID_OK) {
        find_map(p, size, &table->root, &b.inverse);
        find_margin(&b, size);
        while (table->k && !fill_all(&b)) table->k /= 2;
    }
    allocator_release(allocator, b.vertices);
    if (code != OVOID_OK || !table->k) {
        *table = (support_table){.k = 0};
        allocator_release(allocator, b.blocks);
        return code;
    }
    table->scale = 0.5 * table->k;
    table->cell_count = b.used;
    *blocks = b.blocks;
    return OVOID_OK;
}

// What follows the entries is cleared, padding too, so that equal shapes are equal blocks.
void support_table_fill(const double *vertices, const support_block *blocks, uint32_t count, simd_cell *cells) {
    const size_t entries = offsetof(simd_cell, count);
    for (uint32_t i = 0; i < count; i++) {
        simd_cell *cell = &cells[i];
        const support_block *block = &blocks[i];
        for (uint32_t k = 0; k < SIMD_CELL; k++) {
            vec3 p = vec3_at(vertices, block->index[k]);
            cell->x[k] = p.x, cell->y[k] = p.y, cell->z[k] = p.z;
            cell->index[k] = block->index[k];
        }
        memset((char *)cell + entries, 0, sizeof *cell - entries);
        cell->count = block->count;
        cell->next = block->next;
    }
}
