// What holds an ellipsoid in: the facets of a solid, the edges of a flat polygon within its plane, the ends of a
// segment.
#ifndef OVOID_ELLIPSOID_WALLS_H
#define OVOID_ELLIPSOID_WALLS_H

#include "linear/mat3.h"
#include "ovoid/ellipsoid.h"

typedef struct walls {
    const ovoid_polytope *polytope;
    uint32_t count;
    vec3 middle; ///< of a flat polygon: the mean of its vertices
} walls;

walls walls_make(const ovoid_polytope *polytope);

/// The plane of wall i < count.
ovoid_plane walls_get(const walls *w, uint32_t i);

/// Of a flat body: the corners of edge i of the polygon; of a segment: end i, then the other one.
void walls_get_edge(const walls *w, uint32_t i, uint32_t corner[2]);

/// n . c + sqrt(n' Q n), rounded.
static inline double ellipsoid_compute_support(const ovoid_ellipsoid *e, vec3 n) {
    return vec3_dot(n, e->center) + sqrt(fmax(sym3_quadratic(e->q, n), 0));
}

#endif
