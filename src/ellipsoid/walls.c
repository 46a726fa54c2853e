// Walls as planes, made when asked for: no memory.
#include "ellipsoid/walls.h"

walls walls_make(const ovoid_polytope *polytope) {
    const ovoid_polytope *p = polytope;
    walls w = {p, p->rank == 3 ? p->facet_count : p->rank == 2 ? 2 * p->vertex_count : 2 * p->rank, {0, 0, 0}};
    for (uint32_t i = 0; p->rank == 2 && i < p->vertex_count; i++)
        w.middle = vec3_add_scaled(w.middle, vec3_at(p->vertices, i), 1.0 / p->vertex_count);
    return w;
}

// The plane through the edge from vertex v to one of its two neighbours, upright on the polygon.
static ovoid_plane compute_edge_plane(const walls *w, uint32_t v, uint32_t side) {
    const ovoid_polytope *p = w->polytope;
    vec3 a = vec3_at(p->vertices, v), b = vec3_at(p->vertices, p->neighbors[p->neighbor_starts[v] + side]);
    vec3 n = vec3_unit(vec3_cross(vec3_unit(vec3_sub(b, a)), p->planes[0].normal));
    if (vec3_dot(n, vec3_sub(w->middle, a)) > 0) n = vec3_neg(n);
    return (ovoid_plane){n, vec3_dot(n, a)};
}

ovoid_plane walls_get(const walls *w, uint32_t i) {
    const ovoid_polytope *p = w->polytope;
    if (p->rank == 3) return p->planes[i];
    if (p->rank == 2) return compute_edge_plane(w, i / 2, i % 2);
    vec3 a = vec3_at(p->vertices, i), n = vec3_unit(vec3_sub(a, vec3_at(p->vertices, 1 - i)));
    return (ovoid_plane){n, vec3_dot(n, a)};
}
