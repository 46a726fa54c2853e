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
// The list of four cells begins with a vertex found by climbing over edges to their middle; the theorem does not rest
// on where the climb ends. It grows over edges by all vertices that neither the first one beats nor the one over whose
// edge they are met. The list of a cell is that of the four, or of the cell that is divided into it, without those that
// one of two vertices beats. The vertex with the largest product in a direction of the cell is beaten by none, so it
// stays, and what is beaten is below it by more than e. If a list does not fit one block, all are tested against all.
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
// Cost: some 0.3 us a vertex. Lists of round bodies have 5 to 12 vertices and take 140 to 270 bytes a vertex. If lists
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

// FEW: entries that are sorted by counting. LISTS: those of four cells, of one of them, and of its divisions.
// LEAF_MOST: entries of a cell that is not divided; two blocks are read as fast as a divided cell and one block.
enum { LIMITS_MAX = 96, FEW = 48, NESTED_MOST = 4, LISTS = NESTED_MOST + 2, K_MOST = 128, LEAF_MOST = 2 * SIMD_CELL };

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
    uint32_t *lists;  ///< of the present four cells; behind each list, those of the cells in it
    uint32_t *scratch;
    uint32_t limit_count;            ///< at most LIMITS_MAX
    products limits[LIMITS_MAX + 1]; ///< of the vertices of a list, less the margin
} builder;

/// A square of a cube's face.
typedef struct square {
    uint32_t face;
    double a, b, side; ///< from (a, b) to (a + side, b + side)
} square;

/// Vertices in ascending order.
typedef struct vertex_list {
    uint32_t *items, count;
} vertex_list;

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

static products make_limit(const builder *b, products v) {
    both margin = both_set(b->margin);
    return (products){v.low - margin, v.high - margin};
}

/// The signs of the differences to a limit; in each lane that of two corners.
static both_bits compare(const products *v, const products *limit) {
    return (both_bits)(v->low - limit->low) & (both_bits)(v->high - limit->high);
}

/// 1 if all four are below either limit.
static int is_below(const products *v, const products *limit, const products *other) {
    both_bits x = compare(v, limit), y = compare(v, other);
    both_bits below = (both_bits){x[0], y[0]} & (both_bits){x[1], y[1]};
    return (below[0] | below[1]) < 0;
}

/// 1 if a vertex of the limits beats these products.
static int is_beaten(const builder *b, const products *v) {
    both_bits below = {0, 0};
    for (uint32_t i = 0; i < b->limit_count; i += 2) {
        both_bits x = compare(v, &b->limits[i]), y = compare(v, &b->limits[i + 1]);
        below |= (both_bits){x[0], y[0]} & (both_bits){x[1], y[1]};
    }
    return (below[0] | below[1]) < 0;
}

static int compare_numbers(const void *context, uint32_t a, uint32_t b) {
    (void)context;
    return a < b ? -1 : a > b;
}

static void sort_list(const builder *b, vertex_list all) {
    uint32_t *list = all.items;
    if (all.count > FEW) {
        sort_indices(list, b->scratch, all.count, (index_order){compare_numbers, NULL});
        return;
    }
    // Each goes to its place, the number of lesser ones; none is there twice. Numbers are below 2^31.
    int32_t copy[FEW];
    memcpy(copy, list, all.count * sizeof *list);
    for (uint32_t i = 0; i < all.count; i++) {
        uint32_t below = 0;
        for (uint32_t k = 0; k < all.count; k++) below += copy[k] < copy[i];
        list[below] = (uint32_t)copy[i];
    }
}

/// The list of a square, grown from one vertex: by neighbors that neither that vertex nor the one that they are
/// neighbors of beats. Each neighbor is written, and counts if it is new and not beaten: branches would follow no
/// pattern.
static vertex_list grow(builder *b, const square *s, uint32_t first) {
    const ovoid_polytope *p = b->polytope;
    const corners c = make_corners(s);
    vertex_list list = {b->lists, 1};
    products most = make_limit(b, multiply(&c, &b->vertices[first]));
    list.items[0] = first;
    b->met[first] = ++b->stamp;
    for (uint32_t done = 0; done < list.count; done++) {
        uint32_t from = list.items[done];
        products limit = make_limit(b, multiply(&c, &b->vertices[from]));
        for (uint32_t i = p->neighbor_starts[from]; i < p->neighbor_starts[from + 1]; i++) {
            uint32_t to = p->neighbors[i];
            products v = multiply(&c, &b->vertices[to]);
            int is_new = b->met[to] != b->stamp;
            b->met[to] = b->stamp;
            list.items[list.count] = to;
            list.count += is_new & !is_below(&v, &limit, &most);
        }
    }
    sort_list(b, list);
    return list;
}

/// The vertices of a list with the largest products with two points of a square: a quarter of the diagonal from its
/// ends. The numbers of the places are kept beside the products, two at a time.
static void find_tops(const builder *b, const square *s, vertex_list list, uint32_t top[2]) {
    double near = 0.25 * s->side, far = 0.75 * s->side;
    both at_a = both_make(s->a + near, s->a + far), at_b = both_make(s->b + near, s->b + far);
    both most = both_set(-INFINITY), which = both_set(0), place = both_set(0);
    for (uint32_t i = 0; i < list.count; i++, place += both_set(1)) {
        const mapped *v = &b->vertices[list.items[i]];
        both value = both_set(v->m) + (at_a * both_set(v->p) + at_b * both_set(v->q));
        both_bits is_more = value > most;
        which = (both)((is_more & (both_bits)place) | (~is_more & (both_bits)which));
        most = (both)((is_more & (both_bits)value) | (~is_more & (both_bits)most));
    }
    for (int k = 0; k < 2; k++) top[k] = list.items[(uint32_t)which[k]];
}

/// Drops the vertices that others of the list beat.
static void cull_by_pairs(builder *b, const corners *c, vertex_list *list) {
    uint32_t count = list->count;
    b->limit_count = count;
    for (uint32_t i = 0; i < count; i++) b->limits[i] = make_limit(b, multiply(c, &b->vertices[list->items[i]]));
    b->limits[count] = b->limits[0];
    list->count = 0;
    for (uint32_t i = 0; i < count; i++) {
        products v = multiply(c, &b->vertices[list->items[i]]);
        list->items[list->count] = list->items[i];
        list->count += !is_beaten(b, &v);
    }
}

/// The list of a square from that of one that it is in, behind which it is written. Each vertex is written, and counts
/// if it is not beaten: a branch would follow no pattern.
static vertex_list cull(builder *b, const square *s, vertex_list from) {
    corners c = make_corners(s);
    vertex_list list = {from.items + from.count, 0};
    uint32_t top[2];
    find_tops(b, s, from, top);
    products first = make_limit(b, multiply(&c, &b->vertices[top[0]]));
    products second = make_limit(b, multiply(&c, &b->vertices[top[1]]));
    for (uint32_t i = 0; i < from.count; i++) {
        products v = multiply(&c, &b->vertices[from.items[i]]);
        list.items[list.count] = from.items[i];
        list.count += !is_below(&v, &first, &second);
    }
    if (list.count > SIMD_CELL && list.count <= LIMITS_MAX) cull_by_pairs(b, &c, &list);
    return list;
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

static void fill_block(support_block *block, vertex_list list, uint32_t first) {
    *block = (support_block){.count = 0};
    for (uint32_t i = 0; i < SIMD_CELL; i++) block->index[i] = list.items[first + i < list.count ? first + i : first];
}

static int fill_list(builder *b, vertex_list list, uint32_t at) {
    uint32_t more = (list.count + SIMD_CELL - 1) / SIMD_CELL - 1, next = 0;
    if (more && !reserve(b, more, &next)) return 0;
    fill_block(&b->blocks[at], list, 0);
    b->blocks[at].count = list.count;
    b->blocks[at].next = next;
    for (uint32_t i = 0; i < more; i++) fill_block(&b->blocks[next + i], list, (i + 1) * SIMD_CELL);
    return 1;
}

/// A cell, its place in the array, and how often cells that it is in are divided.
typedef struct place {
    square s;
    uint32_t at, nested;
} place;

/// Fills a cell. from: the list of a square that it is in.
static int fill_cell(builder *b, place of, vertex_list from) {
    uint32_t next;
    vertex_list list = cull(b, &of.s, from);
    if (list.count <= LEAF_MOST || of.nested == NESTED_MOST || b->used > b->divided_most)
        return fill_list(b, list, of.at);
    if (!reserve(b, 4, &next)) return 0;
    b->blocks[of.at] = (support_block){.next = next};
    for (uint32_t i = 0; i < 4; i++)
        if (!fill_cell(b, (place){quarter(&of.s, i), next + i, of.nested + 1}, list)) return 0;
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

/// Fills the cells of a square of a face, `step` a side, from that row and column on. near: a vertex to climb from;
/// replaced by that found.
static int fill_square(builder *b, uint32_t face, const uint32_t at[2], uint32_t step, uint32_t *near) {
    uint32_t k = b->table->k;
    double side = 2.0 / k;
    square whole = {face, -1 + side * at[0], -1 + side * at[1], side * step};
    *near = climb(b, *near, whole.a + 0.5 * whole.side, whole.b + 0.5 * whole.side);
    vertex_list list = grow(b, &whole, *near);
    for (uint32_t i = 0; i < step * step; i++) {
        uint32_t row = at[0] + i / step, column = at[1] + i % step;
        square s = {face, -1 + side * row, -1 + side * column, side};
        if (!fill_cell(b, (place){s, cube_cell(face, row, column, k), 0}, list)) return 0;
    }
    return 1;
}

/// Fills all cells of a face, four by four, in rows, forth and back, so that the next ones are at the side of the last.
static int fill_face(builder *b, uint32_t face, uint32_t *near) {
    uint32_t step = b->table->k > 1 ? 2 : 1, count = b->table->k / step;
    map_vertices(b, face);
    for (uint32_t row = 0; row < count; row++)
        for (uint32_t i = 0; i < count; i++) {
            uint32_t column = row & 1 ? count - 1 - i : i;
            if (!fill_square(b, face, (uint32_t[2]){row * step, column * step}, step, near)) return 0;
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
    b->vertices = allocator_allocate(allocator, count, sizeof *b->vertices + (2 + LISTS) * sizeof *b->met);
    if (!b->vertices || !b->blocks) return 0;
    b->met = (uint32_t *)(b->vertices + count);
    b->scratch = b->met + count;
    b->lists = b->scratch + count;
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
