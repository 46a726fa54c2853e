// Whether triangles are closed: no other file decides it.
#ifndef OVOID_SOLID_EDGES_H
#define OVOID_SOLID_EDGES_H

#include "solid/solid.h"

/// The edges of triangles whose equal points have been merged.
typedef struct solid_edges {
    uint64_t unmatched; ///< pieces of edges that do not cancel; 0: closed
    uint64_t crowded;   ///< edges of more than two triangles
} solid_edges;

/// 0 if memory runs out.
int solid_find_edges(const solid_parts *parts, const ovoid_allocator *allocator, solid_edges *edges);

/// 1 if b - a and c - a are parallel, exactly. Coordinates in units of the body.
int solid_is_collinear(vec3 a, vec3 b, vec3 c);

#endif
