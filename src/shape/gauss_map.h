// A shape's Gauss map (simd/gauss.h). Solids of at most GAUSS_POINTS vertices have room for one, but for lean ones; it
// is there where the normals around each vertex are the corners of a convex cell, clearly.
#ifndef OVOID_SHAPE_GAUSS_MAP_H
#define OVOID_SHAPE_GAUSS_MAP_H

#include "shape/block.h"
#include "simd/gauss.h"

/// NULL: there is none. A shape that is no block has no map.
static inline const gauss_map *shape_get_gauss_map(const ovoid_shape *s) {
    const gauss_map *map = (const gauss_map *)((const char *)s + s->at.gauss);
    return s->at.gauss != 0 && s->at.gauss < s->at.vertices && map->arcs ? map : NULL;
}

/// Bytes of the map of a block with these counts; 0: no room for one.
uint64_t gauss_map_get_size(const block_counts *counts);

/// Writes the map of a block with its polytope and its inner ellipsoid. Cost: the squares of the vertices' degrees.
void shape_gauss_map_fill(ovoid_shape *shape);

#endif
