// What is asked of a map. The cell of a vertex is a spherical polygon with the normals of the facets around it as
// corners and the arcs of its edges as sides. Each arc's plane must have all other normals of the cell on one side, of
// the cells of its two ends on opposite sides, by a margin that no rotation's rounding undoes. Then each cell is convex
// and the cells around an arc do not overlap. So the cells cover the sphere some number of times, and that is once,
// where a direction in the middle of one cell is in no other.
//
// Nothing else of the polyhedron is trusted: not that its planes are exact, nor that its hull is.
#include "shape/gauss_map.h"

#include "shape/loops.h"

#include <string.h>

/// The least triple product of an arc's unit normals and another one.
#define CLEAR 0x1p-36
/// The least product of a direction within a cell and the cell's corners.
#define WIDE 0x1p-14

// A map that is being made.
typedef struct maker {
    const ovoid_shape *shape;
    gauss_map *map;
    double *facets; ///< as gauss_get_facet has them
    uint8_t *list[4];
} maker;

static uint64_t get_row(uint64_t count) { return (count + GAUSS_ROW - 1) / GAUSS_ROW * GAUSS_ROW; }

uint64_t gauss_map_get_size(const block_counts *c) {
    uint64_t arcs = c->neighbors / 2;
    if (c->vertices < 4 || c->vertices > GAUSS_POINTS || c->facets > GAUSS_FACETS || arcs > GAUSS_ARCS) return 0;
    return sizeof(gauss_map) + 4 * simd_get_padded(c->facets) * sizeof(double) + 4 * get_row(arcs);
}

static vec3 get_normal(const maker *m, uint32_t facet) {
    const double *x = gauss_get_facet(m->map, facet);
    return (vec3){x[0], x[8], x[16]};
}

static vec3 get_cross(const maker *m, uint32_t arc) {
    return vec3_cross(get_normal(m, m->list[0][arc]), get_normal(m, m->list[1][arc]));
}

// The mean of the normals around a vertex, as a unit vector.
static vec3 find_middle(const maker *m, uint32_t vertex) {
    const uint32_t *starts = shape_neighbor_starts(m->shape), *facets = shape_edge_facets(m->shape);
    vec3 sum = {0, 0, 0};
    for (uint32_t i = starts[vertex]; i < starts[vertex + 1]; i++) sum = vec3_add(sum, get_normal(m, facets[i]));
    return vec3_unit(sum);
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

// The arcs, of edges between facets; those within a facet are none.
static void set_lists(maker *m) {
    const ovoid_shape *s = m->shape;
    const uint32_t *starts = shape_neighbor_starts(s), *neighbors = shape_neighbors(s), *facets = shape_edge_facets(s);
    uint32_t arc = 0;
    for (uint32_t v = 0; v < s->vertex_count; v++)
        for (uint32_t i = starts[v]; i < starts[v + 1]; i++) {
            uint32_t to = neighbors[i], right = facets[shape_find_edge(s, to, v)];
            if (to < v || right == facets[i]) continue;
            m->list[0][arc] = (uint8_t)facets[i];
            m->list[1][arc] = (uint8_t)right;
            m->list[2][arc] = (uint8_t)v;
            m->list[3][arc++] = (uint8_t)to;
        }
    m->map->arcs = arc;
}

// How far vertices are above planes.
static void set_bulge(maker *m) {
    const ovoid_shape *s = m->shape;
    for (uint32_t f = 0; f < m->map->facets; f++)
        for (uint32_t v = 0; v < s->vertex_count; v++) {
            double above = vec3_dot(get_normal(m, f), vec3_at(shape_vertices(s), v)) - gauss_get_facet(m->map, f)[24];
            m->map->bulge = fmax(m->map->bulge, above);
        }
}

// The side of an arc's plane on which the other normals around a vertex are, as 1 or -1; 0 if that is not clear. The
// normals around it are those to the left of its edges.
static int find_side(const maker *m, uint32_t arc, uint32_t vertex) {
    const uint32_t *starts = shape_neighbor_starts(m->shape), *facets = shape_edge_facets(m->shape);
    vec3 cross = get_cross(m, arc);
    int side = 0;
    for (uint32_t i = starts[vertex]; i < starts[vertex + 1]; i++) {
        uint32_t f = facets[i];
        if (f == m->list[0][arc] || f == m->list[1][arc]) continue;
        double product = vec3_dot(cross, get_normal(m, f));
        int now = product > CLEAR ? 1 : product < -CLEAR ? -1 : 0;
        if (now == 0 || (side != 0 && now != side)) return 0;
        side = now;
    }
    return side;
}

static int are_cells_convex(const maker *m) {
    for (uint32_t arc = 0; arc < m->map->arcs; arc++) {
        int side = find_side(m, arc, m->list[2][arc]);
        if (side == 0 || find_side(m, arc, m->list[3][arc]) != -side) return 0;
    }
    return 1;
}

// Is a direction clearly inside the cell of a vertex (1), clearly outside (-1), or neither (0)?
static int locate(const maker *m, uint32_t vertex, vec3 direction) {
    int found = 1;
    for (uint32_t arc = 0; arc < m->map->arcs; arc++) {
        if (m->list[2][arc] != vertex && m->list[3][arc] != vertex) continue;
        double product = find_side(m, arc, vertex) * vec3_dot(get_cross(m, arc), direction);
        if (product < -CLEAR) return -1;
        if (!(product > CLEAR)) found = 0;
    }
    return found;
}

static int is_covered_once(const maker *m) {
    vec3 middle = find_middle(m, 0);
    if (locate(m, 0, middle) != 1) return 0;
    for (uint32_t v = 1; v < m->shape->vertex_count; v++)
        if (locate(m, v, middle) != -1) return 0;
    return 1;
}

// The least product of a direction and the corners of a vertex's cell.
static double find_least_product(const maker *m, uint32_t vertex, vec3 direction) {
    const uint32_t *starts = shape_neighbor_starts(m->shape), *facets = shape_edge_facets(m->shape);
    double least = 1;
    for (uint32_t i = starts[vertex]; i < starts[vertex + 1]; i++)
        least = min2(least, vec3_dot(direction, get_normal(m, facets[i])));
    return least;
}

// A unit vector that is a sum of a cell's corners of weights >= 0 has a product with any unit x of at most 1, and of at
// least the sum of the weights times the least product of x and a corner. x: their mean, or the way from the middle of
// the body, which is in every cell.
static void set_spread(maker *m) {
    m->map->spread = 1;
    for (uint32_t v = 0; v < m->shape->vertex_count; v++) {
        vec3 way = vec3_unit(vec3_sub(vec3_at(shape_vertices(m->shape), v), m->shape->inner.center));
        double least = fmax(find_least_product(m, v, find_middle(m, v)), find_least_product(m, v, way));
        m->map->spread = fmax(m->map->spread, least > WIDE ? 1 / least : INFINITY);
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
    maker m = {.shape = s, .map = map};
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
    set_spread(&m);
    choose_wide(&m);
    if (!are_cells_convex(&m) || !is_covered_once(&m) || !(map->spread < INFINITY)) map->arcs = 0;
}
