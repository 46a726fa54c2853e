// The winding number of a closed surface: the signed crossings of a ray from the point, by exact orientations. The
// first ray runs along z, and most triangles are beside it by their coordinates alone.
#include "polytope/winding.h"

#include "linear/exact.h"
#include "polytope/facets.h"

// The signed crossing of the ray from c through q with a triangle: 1, 0 or -1, or 2 if the ray meets its border.
static int count_crossing(vec3 c, vec3 q, const vec3 corner[3]) {
    int s0 = orient3d_sign(c, q, corner[0], corner[1]), s1 = orient3d_sign(c, q, corner[1], corner[2]);
    if (s0 * s1 < 0) return 0;
    int s2 = orient3d_sign(c, q, corner[2], corner[0]);
    if (s0 * s2 < 0 || s1 * s2 < 0) return 0;
    if (s0 == 0 || s1 == 0 || s2 == 0) return 2;
    // The line crosses; the triangle lies ahead of c if its plane separates c from the line's far end.
    int side = orient3d_sign(corner[0], corner[1], corner[2], c);
    return side == 0 ? 2 : side == -s0 ? side : 0;
}

// 1 if the line through the point along z passes beside a triangle: all corners lie to one side of it along x, or along
// y. The comparisons are exact. Each by itself follows no pattern, so there is no branch between them.
static int is_beside(vec3 point, const vec3 corner[3]) {
    double x = point.x, y = point.y;
    const vec3 *a = corner, *b = corner + 1, *c = corner + 2;
    return ((a->x > x) & (b->x > x) & (c->x > x)) | ((a->x < x) & (b->x < x) & (c->x < x)) |
           ((a->y > y) & (b->y > y) & (c->y > y)) | ((a->y < y) & (b->y < y) & (c->y < y));
}

// A point on the ray of an attempt: up along z at first; then through points inside a triangle, at weights of no
// symmetry.
static vec3 find_aim(const ovoid_polytope *p, vec3 c, double unit, uint32_t attempt) {
    if (attempt == 0) return (vec3){c.x, c.y, c.z + 1};
    const uint32_t *aim = p->triangles + 3 * (size_t)(p->triangle_count * (uint64_t)(attempt - 1) / 8);
    double wa = 0.371 + 0.02 * (attempt - 1), wb = 0.297 - 0.013 * (attempt - 1), wc = 1 - wa - wb;
    vec3 q = vec3_scale(vec3_at(p->vertices, aim[0]), wa);
    q = vec3_add_scaled(q, vec3_at(p->vertices, aim[1]), wb);
    return vec3_scale(vec3_add_scaled(q, vec3_at(p->vertices, aim[2]), wc), unit);
}

int64_t polytope_compute_winding(const ovoid_polytope *polytope, vec3 point) {
    // In units of the body: the orientations underflow for bodies below 1e-90.
    double unit = ldexp(1, -find_unit_exponent(compute_extent(polytope->vertices, polytope->vertex_count)));
    vec3 c = vec3_scale(point, unit);
    // Another ray if one meets an edge.
    for (uint32_t attempt = 0; attempt < 9 && polytope->triangle_count > 0; attempt++) {
        vec3 q = find_aim(polytope, c, unit, attempt);
        int64_t winding = 0;
        int met = 0;
        for (uint32_t t = 0; t < polytope->triangle_count && !met; t++) {
            vec3 corner[3];
            for (int i = 0; i < 3; i++) corner[i] = vec3_at(polytope->vertices, polytope->triangles[3 * (size_t)t + i]);
            if (attempt == 0 && is_beside(point, corner)) continue;
            for (int i = 0; i < 3; i++) corner[i] = vec3_scale(corner[i], unit);
            int crossing = count_crossing(c, q, corner);
            met = crossing == 2;
            winding += met ? 0 : crossing;
        }
        if (!met) return winding;
    }
    return 0;
}
