// The halfspaces that confine an ellipsoid: the facets of a solid, the edges of a flat polygon within its plane, the
// ends of a segment.
#ifndef OVOID_ELLIPSOID_HALFSPACES_H
#define OVOID_ELLIPSOID_HALFSPACES_H

#include "linear/mat3.h"
#include "ovoid/ellipsoid.h"

typedef struct halfspaces {
    const ovoid_polytope *polytope;
    uint32_t count;
    vec3 middle; ///< of a flat polygon: the mean of its vertices
} halfspaces;

/// The halfspaces of a polytope; a view that borrows it.
halfspaces halfspaces_make(const ovoid_polytope *polytope);

/// The plane of halfspace i < count.
ovoid_plane halfspaces_get(const halfspaces *w, uint32_t i);

/// The two corners of edge i of a flat polygon; of a segment end i, then the other end.
void halfspaces_get_edge(const halfspaces *w, uint32_t i, uint32_t corner[2]);

/// n . c + sqrt(n' Q n), rounded.
static inline double ellipsoid_compute_support(const ovoid_ellipsoid *e, vec3 n) {
    return vec3_dot(n, e->center) + sqrt(fmax(sym3_quadratic(e->q, n), 0));
}

#endif
