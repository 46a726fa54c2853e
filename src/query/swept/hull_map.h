// A hull whose faces are known beside another core, in the axes of the hull's shape: the facets, edges and vertices of
// its Gauss map, and along each facet's normal a point of the other core. And the search that goes by its arcs.
#ifndef OVOID_QUERY_SWEPT_HULL_MAP_H
#define OVOID_QUERY_SWEPT_HULL_MAP_H

#include "query/swept/descend.h"
#include "shape/gauss_map.h"

// How far heights are off, and what the map may leave open, as parts of the size.
#define HULL_HEIGHTS (8 * 0x1p-53)
#define HULL_DOUBT 3e-13

typedef struct hull_map {
    const ovoid_swept_sphere *of;
    int is_b; ///< of the two cores
    const gauss_map *map;
    simd_points points;
    const uint8_t *list[4];
    double x[GAUSS_FACETS], y[GAUSS_FACETS], z[GAUSS_FACETS]; ///< the points
    double least;                                             ///< of the heights of the difference along the normals
    uint32_t least_facet;
} hull_map;

/// Is it a hull that has a map?
static inline int hull_map_is_of(const ovoid_swept_sphere *s) {
    return s->core == OVOID_SWEPT_POINTS && s->shape && shape_get_gauss_map(s->shape);
}

/// Without the points.
static inline void hull_map_set(const cores *p, hull_map *to) {
    to->is_b = p->b->core == OVOID_SWEPT_POINTS;
    to->of = to->is_b ? p->b : p->a;
    to->map = shape_get_gauss_map(to->of->shape);
    to->points = shape_get_points(to->of->shape);
    for (uint32_t k = 0; k < 4; k++) to->list[k] = gauss_get_list(to->map, k);
}

static inline vec3 hull_map_get_normal(const hull_map *h, uint32_t f) { return gauss_map_get_normal(h->map, f); }
static inline double hull_map_get_low(const hull_map *h, uint32_t f) { return gauss_map_get_low(h->map, f); }
static inline vec3 hull_map_get_point(const hull_map *h, uint32_t f) { return (vec3){h->x[f], h->y[f], h->z[f]}; }
static inline vec3 hull_map_get_vertex(const hull_map *h, uint32_t i) {
    return (vec3){h->points.x[i], h->points.y[i], h->points.z[i]};
}

/// Takes the other core's point along a facet's normal, reversed and from the hull's frame.
static inline void hull_map_take_point(hull_map *h, uint32_t f, vec3 at) {
    const double height = hull_map_get_low(h, f) + vec3_dot(at, hull_map_get_normal(h, f));
    h->x[f] = at.x, h->y[f] = at.y, h->z[f] = at.z;
    h->least_facet = height < h->least ? f : h->least_facet;
    h->least = min2(height, h->least);
}

/// How far the heights of a cell's vertex, of both vertices along an arc, and of the hull along the cell's directions
/// may differ: a unit vector of a cell is a sum of its corners of at most the map's spread, along which the vertices
/// are no farther from the facet's plane than its bulge.
static inline double hull_map_find_doubt(const hull_map *h, double size) {
    return h->map->spread * (h->map->bulge + HULL_HEIGHTS * size);
}

// ---- beside a cylinder or a cone (query/swept/hull_arcs.c)

/// 1 if one core is a hull with a shape that has a Gauss map (shape/gauss_map.h), the other one a cylinder or a cone.
int cores_have_hull_arcs(const cores *p);

/// The least overlap of such cores: of *at the direction, the value and both points are set. 0 if it is not found. Else
/// no overlap is less than the value by more than `tolerance` and *doubt, beside 100 u of the size.
int cores_search_hull_arcs(const cores *p, double tolerance, least_overlap *at, double *doubt);

#endif
