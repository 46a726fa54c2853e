// Cutting the faces along the areas' borders: each triangle along the three coordinate planes of sphere space. W.-K.
// Su, J.-S. Liu, I-F. Chen, Enhancing Collision Detection Method Based on Enclosed Ellipsoid by Facial Areas Splitting,
// chart 0 counts the polygons that this gives: 36 for a box of 12 triangles.
//
// Only the counts are computed: the tables (table.c) hold whole facets, since a ray needs the facet, not the piece. A
// coordinate below 2^-46 of the largest is taken for zero, so that a vertex that lies on a plane to rounding cuts no
// sliver.
#include "base/environment.h"
#include "paper/area.h"
#include "shape/direction_cells.h"

enum { CORNERS_MAX = 6 };

/// A convex polygon: a triangle cut by three planes has at most six corners.
typedef struct polygon {
    vec3 corner[CORNERS_MAX];
    int count;
} polygon;

static vec3 with_zero(vec3 v, int axis) {
    return (vec3){axis == 0 ? 0 : v.x, axis == 1 ? 0 : v.y, axis == 2 ? 0 : v.z};
}

/// The part on one side (sign 1 or -1) of the plane through zero; empty if the polygon only touches it from the other
/// side. A polygon in the plane is on the positive side.
static polygon cut(const polygon *p, int axis, double sign) {
    polygon part = {.count = 0};
    int is_beyond = 0, is_behind = 0;
    for (int i = 0; i < p->count; i++) {
        vec3 a = p->corner[i], b = p->corner[(i + 1) % p->count];
        double ha = sign * vec3_get(a, axis), hb = sign * vec3_get(b, axis);
        if (ha > 0) is_beyond = 1;
        if (ha < 0) is_behind = 1;
        if (ha >= 0 && part.count < CORNERS_MAX) part.corner[part.count++] = a;
        if (((ha > 0 && hb < 0) || (ha < 0 && hb > 0)) && part.count < CORNERS_MAX) {
            vec3 x = vec3_add_scaled(a, vec3_sub(b, a), ha / (ha - hb));
            part.corner[part.count++] = with_zero(x, axis);
        }
    }
    if (!is_beyond && (is_behind || sign < 0)) part.count = 0;
    return part;
}

static void count_pieces(ovoid_split_counts *counts, const polygon *p, int axis, uint32_t octant) {
    if (p->count < 3) return;
    if (axis == 3) {
        counts->pieces++;
        counts->triangles += (uint32_t)p->count - 2;
        counts->per_octant[octant]++;
        return;
    }
    polygon positive = cut(p, axis, 1), negative = cut(p, axis, -1);
    count_pieces(counts, &positive, axis + 1, octant);
    count_pieces(counts, &negative, axis + 1, octant | 1u << axis);
}

/// A vertex in sphere space.
static vec3 map_vertex(const ovoid_polytope *polytope, uint32_t i, vec3 center, sym3 inverse_root) {
    vec3 v = sym3_mul_vec3(inverse_root, vec3_sub(vec3_at(polytope->vertices, i), center));
    double least = 0x1p-46 * vec3_max_abs(v);
    return (vec3){fabs(v.x) <= least ? 0 : v.x, fabs(v.y) <= least ? 0 : v.y, fabs(v.z) <= least ? 0 : v.z};
}

static ovoid_split_counts compute_split(const ovoid_polytope *polytope, const ovoid_ellipsoid *ellipsoid) {
    ovoid_split_counts counts = {.faces = polytope->triangle_count};
    sym3 root, inverse_root;
    double ratio;
    if (!sphere_space_make(ellipsoid->q, &root, &inverse_root, &ratio)) return counts;
    for (uint32_t t = 0; t < polytope->triangle_count; t++) {
        polygon p = {.count = 3};
        for (int i = 0; i < 3; i++)
            p.corner[i] = map_vertex(polytope, polytope->triangles[3 * t + i], ellipsoid->center, inverse_root);
        count_pieces(&counts, &p, 0, 0);
    }
    return counts;
}

ovoid_split_counts ovoid_polytope_compute_split(const ovoid_polytope *polytope, const ovoid_ellipsoid *ellipsoid) {
    ENVIRONMENT_RETURN(ovoid_split_counts, polytope, compute_split(polytope, ellipsoid));
}
