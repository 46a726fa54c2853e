// The winding number of a closed surface: the signed crossings of a ray from the point, by exact orientations. The
// first ray runs up along z, and most triangles are beside it, or below its start, by their coordinates alone.
#include "polytope/winding.h"

#include "linear/both.h"
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

// Which of a triangle and the next one the ray from the point up along z passes beside, as bits of their lanes: all
// corners lie to one side of it along x, or along y, or below the point. The comparisons are exact. Each by itself
// follows no pattern, so there is no branch between them.
static both_bits find_beside(const ovoid_polytope *p, uint32_t t, vec3 point) {
    const uint32_t *first = p->triangles + 3 * (size_t)t, *second = t + 1 < p->triangle_count ? first + 3 : first;
    both x = both_set(point.x), y = both_set(point.y), z = both_set(point.z);
    both_bits right = {-1, -1}, left = right, above = right, below = right, under = right;
    for (int i = 0; i < 3; i++) {
        const double *a = p->vertices + 3 * (size_t)first[i], *b = p->vertices + 3 * (size_t)second[i];
        both along_x = both_make(a[0], b[0]), along_y = both_make(a[1], b[1]), along_z = both_make(a[2], b[2]);
        right &= along_x > x, left &= along_x < x;
        above &= along_y > y, below &= along_y < y;
        under &= along_z < z;
    }
    return (right | left) | (above | below) | under;
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

// From c through q; lengths in units of the body are `unit` times as long.
typedef struct ray {
    vec3 c, q;
    double unit;
} ray;

// Adds the crossing with a triangle; 0 if the ray meets its border.
static int add_crossing(const ovoid_polytope *p, uint32_t t, const ray *r, int64_t *winding) {
    vec3 corner[3];
    for (int i = 0; i < 3; i++) corner[i] = vec3_scale(vec3_at(p->vertices, p->triangles[3 * (size_t)t + i]), r->unit);
    int crossing = count_crossing(r->c, r->q, corner);
    if (crossing != 2) *winding += crossing;
    return crossing != 2;
}

int64_t polytope_compute_winding(const ovoid_polytope *polytope, vec3 point) {
    uint32_t count = polytope->triangle_count;
    // In units of the body: the orientations underflow for bodies below 1e-90.
    double unit = ldexp(1, -find_unit_exponent(compute_extent(polytope->vertices, polytope->vertex_count)));
    ray r = {.c = vec3_scale(point, unit), .unit = unit};
    // Another ray if one meets an edge.
    for (uint32_t attempt = 0; attempt < 9 && count > 0; attempt++) {
        r.q = find_aim(polytope, r.c, unit, attempt);
        int64_t winding = 0;
        int good = 1;
        for (uint32_t t = 0; t < count && good; t += 2) {
            both_bits beside = attempt == 0 ? find_beside(polytope, t, point) : (both_bits){0, 0};
            if (!beside[0]) good = add_crossing(polytope, t, &r, &winding);
            if (!beside[1] && t + 1 < count && good) good = add_crossing(polytope, t + 1, &r, &winding);
        }
        if (good) return winding;
    }
    return 0;
}
