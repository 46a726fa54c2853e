// Halfspaces as planes, computed on demand, without memory.
#include "ellipsoid/halfspaces.h"

#include "polytope/polygon.h"

halfspaces halfspaces_make(const ovoid_polytope *polytope) {
    const ovoid_polytope *p = polytope;
    halfspaces w = {p, p->rank == 3 ? p->facet_count : p->rank == 2 ? p->triangle_count + 2 : 2 * p->rank, {0, 0, 0}};
    for (uint32_t i = 0; p->rank == 2 && i < p->vertex_count; i++)
        w.middle = vec3_add_scaled(w.middle, vec3_at(p->vertices, i), 1.0 / p->vertex_count);
    return w;
}

// The corner where edge i of a polygon starts: its triangles are a fan, corner 0 the first of each.
static uint32_t find_corner(const ovoid_polytope *p, uint32_t i) {
    if (i == 0) return p->triangles[0];
    return i <= p->triangle_count ? p->triangles[3 * (size_t)(i - 1) + 1]
                                  : p->triangles[3 * (size_t)(p->triangle_count - 1) + 2];
}

void halfspaces_get_edge(const halfspaces *w, uint32_t i, uint32_t corner[2]) {
    const ovoid_polytope *p = w->polytope;
    if (p->rank == 2) {
        corner[0] = find_corner(p, i);
        corner[1] = find_corner(p, i + 1 < w->count ? i + 1 : 0);
        return;
    }
    uint32_t end[2];
    polytope_get_ends(p, end);
    corner[0] = end[i];
    corner[1] = end[1 - i];
}

// The plane through an edge, upright on the polygon.
static ovoid_plane compute_edge_plane(const halfspaces *w, const uint32_t corner[2]) {
    const ovoid_polytope *p = w->polytope;
    vec3 a = vec3_at(p->vertices, corner[0]), b = vec3_at(p->vertices, corner[1]);
    vec3 n = vec3_unit(vec3_cross(vec3_unit(vec3_sub(b, a)), p->planes[0].normal));
    if (vec3_dot(n, vec3_sub(w->middle, a)) > 0) n = vec3_neg(n);
    return (ovoid_plane){n, vec3_dot(n, a)};
}

ovoid_plane halfspaces_get(const halfspaces *w, uint32_t i) {
    const ovoid_polytope *p = w->polytope;
    if (p->rank == 3) return p->planes[i];
    uint32_t corner[2];
    halfspaces_get_edge(w, i, corner);
    if (p->rank == 2) return compute_edge_plane(w, corner);
    vec3 a = vec3_at(p->vertices, corner[0]), n = vec3_unit(vec3_sub(a, vec3_at(p->vertices, corner[1])));
    return (ovoid_plane){n, vec3_dot(n, a)};
}
