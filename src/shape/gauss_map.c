// What is asked of a map. The cell of a vertex is a spherical polygon with the normals of the facets around it as
// corners and the arcs of its edges as sides. Each arc's plane must have all other normals of the cell on one side, of
// the cells of its two ends on opposite sides, by a margin that no rotation's rounding undoes. Then each cell is convex
// and the cells around an arc do not overlap. So the cells cover the sphere some number of times, and that is once,
// where a direction in the middle of one cell is in no other.
//
// Nothing else of the polyhedron is trusted: not that its planes are exact, nor that its hull is.
#include "shape/gauss_map.h"

#include "linear/both.h"
#include "shape/loops.h"

#include <string.h>

/// The least triple product of an arc's unit normals and another one.
#define CLEAR 0x1p-36
/// The least product of a direction within a cell and the cell's corners.
#define WIDE 0x1p-14

enum { NO_ARC = GAUSS_ARCS };

// A map that is being made. Lists have one entry more than arcs, for edges that are none.
typedef struct maker {
    const ovoid_shape *shape;
    gauss_map *map;
    double *facets; ///< as gauss_get_facet has them
    uint8_t *list[4];
    uint8_t row[4][GAUSS_ARCS + 1]; // the lists
    uint8_t arc[2 * GAUSS_ARCS];    // of directed edges
    vec3 cross[GAUSS_ARCS + 1];     // of an arc's normals
    int8_t side[2][GAUSS_ARCS + 1]; // of an arc's plane, where the normals around its two vertices are
} maker;

// The normals around a vertex: those to the left of the edges that are arcs, and a zero one behind an odd number.
typedef struct ring {
    uint32_t count;
    uint8_t arc[GAUSS_POINTS];
    double x[GAUSS_POINTS], y[GAUSS_POINTS], z[GAUSS_POINTS];
    vec3 middle; // the mean of the normals to the left of all edges, as a unit vector
} ring;

static uint64_t get_row(uint64_t count) { return (count + GAUSS_ROW - 1) / GAUSS_ROW * GAUSS_ROW; }

uint64_t gauss_map_get_size(const block_counts *c) {
    uint64_t arcs = c->neighbors / 2;
    if (c->is_lean || c->vertices < 4 || c->vertices > GAUSS_POINTS || c->facets > GAUSS_FACETS || arcs > GAUSS_ARCS)
        return 0;
    return sizeof(gauss_map) + 4 * simd_get_padded(c->facets) * sizeof(double) + 4 * get_row(arcs);
}

static void set_facets(maker *m) {
    const ovoid_shape *s = m->shape;
    const uint32_t *starts = shape_loop_starts(s), *vertices = shape_loop_vertices(s);
    for (uint32_t f = 0; f < simd_get_padded(m->map->facets); f++) {
        double low = INFINITY;
        vec3 n = {0, 0, 0};
        if (f < m->map->facets) {
            n = shape_planes(s)[f].normal;
            for (uint32_t i = starts[f]; i < starts[f + 1]; i++)
                low = min2(low, vec3_dot(n, vec3_at(shape_vertices(s), vertices[i])));
        }
        double *to = m->facets + gauss_get_place(f);
        to[0] = n.x, to[8] = n.y, to[16] = n.z, to[24] = low;
    }
}

// The arcs, of edges between facets; those within a facet are none. Lists of neighbors ascend, so the edges back from a
// vertex are met in the order of its list. An edge is written behind the arcs so far, and counts if it is one: a branch
// would follow no pattern.
static void set_lists(maker *m) {
    const ovoid_shape *s = m->shape;
    const uint32_t *starts = shape_neighbor_starts(s), *neighbors = shape_neighbors(s), *facets = shape_edge_facets(s);
    uint32_t arc = 0, places[GAUSS_POINTS];
    memcpy(places, starts, s->vertex_count * sizeof *places);
    for (uint32_t v = 0; v < s->vertex_count; v++)
        for (uint32_t i = starts[v]; i < starts[v + 1]; i++) {
            uint32_t to = neighbors[i], back = places[to]++, left = facets[i], right = facets[back];
            int is_arc = (to > v) & (right != left);
            m->row[0][arc] = (uint8_t)left;
            m->row[1][arc] = (uint8_t)right;
            m->row[2][arc] = (uint8_t)v;
            m->row[3][arc] = (uint8_t)to;
            m->arc[i] = to > v ? (uint8_t)(is_arc ? arc : NO_ARC) : m->arc[back];
            arc += is_arc;
        }
    m->map->arcs = arc;
    for (uint32_t k = 0; k < 4; k++) memcpy(m->list[k], m->row[k], arc);
    for (uint32_t i = 0; i < arc; i++)
        m->cross[i] =
            vec3_cross(gauss_map_get_normal(m->map, m->row[0][i]), gauss_map_get_normal(m->map, m->row[1][i]));
}

// How far vertices are above planes, three planes at a time.
static void set_bulge(maker *m) {
    const simd_points points = shape_get_points(m->shape);
    uint32_t last = m->map->facets - 1;
    for (uint32_t f = 0; f <= last; f += 3) {
        const uint32_t which[3] = {f, f < last ? f + 1 : last, f + 1 < last ? f + 2 : last};
        const mat3 rows = {gauss_map_get_normal(m->map, which[0]), gauss_map_get_normal(m->map, which[1]),
                           gauss_map_get_normal(m->map, which[2])};
        simd_extents reach = simd_find_extents(&points, &rows);
        for (int k = 0; k < 3; k++) {
            double low = gauss_map_get_low(m->map, which[k]);
            m->map->bulge = max2(m->map->bulge, reach.high[k] - low);
        }
    }
}

static void take_ring(const maker *m, uint32_t vertex, ring *r) {
    const uint32_t *starts = shape_neighbor_starts(m->shape), *facets = shape_edge_facets(m->shape);
    vec3 sum = {0, 0, 0};
    uint32_t count = 0;
    for (uint32_t i = starts[vertex]; i < starts[vertex + 1]; i++) {
        vec3 n = gauss_map_get_normal(m->map, facets[i]);
        sum = vec3_add(sum, n);
        if (m->arc[i] == NO_ARC) continue;
        r->x[count] = n.x, r->y[count] = n.y, r->z[count] = n.z;
        r->arc[count++] = m->arc[i];
    }
    r->count = count;
    if (count % 2) r->x[count] = r->y[count] = r->z[count] = 0;
    r->middle = vec3_unit(sum);
}

// The side of an arc's plane on which the other normals around a vertex are, as 1 or -1; 0 if that is not clear. The
// arc's own two normals are in its plane, clearly on neither side.
static int find_side(const maker *m, const ring *r, uint32_t arc) {
    both_vec3 cross = both_vec3_make(m->cross[arc], m->cross[arc]);
    both clear = both_set(CLEAR);
    both_bits sides = {0, 0};
    for (uint32_t i = 0; i < r->count; i += 2) {
        both product = both_vec3_dot(cross, (both_vec3){both_load(r->x + i), both_load(r->y + i), both_load(r->z + i)});
        sides += (product < -clear) - (product > clear);
    }
    long long others = (long long)r->count - 2, sum = sides[0] + sides[1];
    return others ? (sum == others) - (sum == -others) : 0;
}

// The sides of the arcs' planes as a vertex has them.
static void set_sides(maker *m, const ring *r, uint32_t vertex) {
    for (uint32_t i = 0; i < r->count; i++) {
        uint32_t arc = r->arc[i];
        m->side[m->row[3][arc] == vertex][arc] = (int8_t)find_side(m, r, arc);
    }
}

static int are_cells_convex(const maker *m) {
    int good = 1;
    for (uint32_t arc = 0; arc < m->map->arcs; arc++)
        good &= m->side[0][arc] != 0 && m->side[1][arc] == -m->side[0][arc];
    return good;
}

// Is a direction in the middle of the cell of vertex 0 clearly inside that, and clearly outside of all others? The
// cells are convex.
static int is_covered_once(const maker *m) {
    ring first;
    take_ring(m, 0, &first);
    uint8_t is_outside[GAUSS_POINTS] = {0};
    int good = 1;
    for (uint32_t arc = 0; arc < m->map->arcs; arc++) {
        uint32_t from = m->row[2][arc], to = m->row[3][arc];
        double product = m->side[0][arc] * vec3_dot(m->cross[arc], first.middle);
        is_outside[from] |= product < -CLEAR;
        is_outside[to] |= product > CLEAR;
        // No arc of vertex 0 leads to it.
        good &= from != 0 || product > CLEAR;
    }
    for (uint32_t v = 1; v < m->shape->vertex_count; v++) good &= is_outside[v];
    return good;
}

// A unit vector that is a sum of a cell's corners of weights >= 0 has a product with any unit x of at most 1, and of at
// least the sum of the weights times the least product of x and a corner. x: their mean, or the way from the middle of
// the body, which is in every cell.
static void raise_spread(const maker *m, const ring *r, uint32_t vertex) {
    vec3 way = vec3_unit(vec3_sub(vec3_at(shape_vertices(m->shape), vertex), m->shape->inner.center));
    both_vec3 directions = both_vec3_make(r->middle, way);
    both products = both_set(1);
    for (uint32_t i = 0; i < r->count; i++) {
        both_vec3 n = {both_set(r->x[i]), both_set(r->y[i]), both_set(r->z[i])};
        products = both_min(products, both_vec3_dot(directions, n));
    }
    double least = max2(products[0], products[1]);
    m->map->spread = max2(m->map->spread, least > WIDE ? 1 / least : INFINITY);
}

// What the normals around each vertex show.
static void visit_vertices(maker *m) {
    m->map->spread = 1;
    for (uint32_t v = 0; v < m->shape->vertex_count; v++) {
        ring r;
        take_ring(m, v, &r);
        set_sides(m, &r, v);
        raise_spread(m, &r, v);
    }
}

// Vertices far apart: those that are the farthest in seven directions, as the inner ellipsoid sees them.
static void choose_wide(maker *m) {
    const double *w = m->shape->inside.w;
    for (uint32_t k = 0; k < GAUSS_WIDE; k++) {
        vec3 d = {k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1};
        vec3 n = {(w[0] * d.x + w[1] * d.y) + w[3] * d.z, w[2] * d.y + w[4] * d.z, w[5] * d.z};
        m->map->wide[k] = (uint8_t)shape_find_extreme(m->shape, n).index;
    }
}

void shape_gauss_map_fill(ovoid_shape *s) {
    if (!gauss_map_get_size(&s->counts)) return;
    gauss_map *map = (gauss_map *)((char *)s + s->at.gauss);
    maker m;
    m.shape = s, m.map = map;
    memset(map, 0, gauss_map_get_size(&s->counts));
    if (s->rank < 3 || !(s->inside.least > 0)) return;
    map->facets = s->counts.facets;
    map->row = (uint32_t)get_row(s->counts.neighbors / 2);
    m.facets = (double *)(map + 1);
    for (uint32_t k = 0; k < 4; k++) {
        m.list[k] = (uint8_t *)((double *)(map + 1) + 4 * simd_get_padded(map->facets)) + (size_t)k * map->row;
    }
    set_facets(&m);
    set_lists(&m);
    set_bulge(&m);
    visit_vertices(&m);
    choose_wide(&m);
    if (!are_cells_convex(&m) || !is_covered_once(&m) || !(map->spread < INFINITY)) map->arcs = 0;
}
