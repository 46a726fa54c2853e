// Solids and convex parts in extended precision: the distance of a point from either, by brute force over triangles.
// Long double has 11 bits more than double, so distances are trusted to 1e-16 of the size.
#ifndef OVOID_TESTS_DECOMPOSITIONS_H
#define OVOID_TESTS_DECOMPOSITIONS_H

#include "solids.h"

/// Triangles in the solid's frame.
typedef struct long_mesh {
    long3 *corners;
    size_t count;
} long_mesh;

static inline long_mesh long_mesh_of_solid(const ovoid_solid *s) {
    size_t count = ovoid_solid_get_report(s).triangles;
    const double *xyz = ovoid_solid_get_points(s);
    long_mesh m = {malloc(3 * count * sizeof(long3)), count};
    for (size_t i = 0; i < count; i++) {
        uint32_t p[3];
        ovoid_solid_get_triangle(s, i, p);
        for (int k = 0; k < 3; k++)
            m.corners[3 * i + (size_t)k] = (long3){xyz[3 * p[k]], xyz[3 * p[k] + 1], xyz[3 * p[k] + 2]};
    }
    return m;
}

static inline long_mesh long_mesh_of_shape(const ovoid_shape *s) {
    ovoid_polytope p = ovoid_shape_get_polytope(s);
    long_mesh m = {malloc((3 * (size_t)p.triangle_count + 1) * sizeof(long3)), p.triangle_count};
    for (size_t i = 0; i < 3 * m.count; i++) {
        const double *v = p.vertices + 3 * (size_t)p.triangles[i];
        m.corners[i] =
            (long3){(long double)p.origin.x + v[0], (long double)p.origin.y + v[1], (long double)p.origin.z + v[2]};
    }
    return m;
}

/// The distance of a point from the body that the closed triangles enclose; 0 inside.
static inline long double long_mesh_distance(const long_mesh *m, long3 x) {
    if (fabsl(long_winding(m->corners, m->count, x)) > 0.5L) return 0;
    long double best = INFINITY;
    const long3 point[3] = {x, x, x};
    for (size_t i = 0; i < m->count; i++) best = fminl(best, long_triangles_distance(point, m->corners + 3 * i));
    return best;
}

/// The least distance from a part, each rounded by its radius.
static inline long double long_parts_distance(const long_mesh *parts, const ovoid_decomposition *d, long3 x) {
    long double best = INFINITY;
    for (size_t i = 0; i < d->part_count; i++) {
        long double r = ovoid_shape_get_radius(d->parts[i]);
        best = fminl(best, fmaxl(0, long_mesh_distance(&parts[i], x) - r));
    }
    return best;
}

/// A point of the box.
static inline ovoid_vec3 draw_in(uint64_t *s, const ovoid_box *b) {
    double x = random_uniform(s, b->min.x, b->max.x), y = random_uniform(s, b->min.y, b->max.y);
    return (ovoid_vec3){x, y, random_uniform(s, b->min.z, b->max.z)};
}

static inline long3 long3_from(ovoid_vec3 p) { return (long3){p.x, p.y, p.z}; }

/// A box as a single part.
static inline ovoid_shape *make_box_between(ovoid_vec3 a, ovoid_vec3 b) {
    double xyz[24];
    for (int i = 0; i < 8; i++) {
        xyz[3 * i] = i & 1 ? b.x : a.x;
        xyz[3 * i + 1] = i & 2 ? b.y : a.y;
        xyz[3 * i + 2] = i & 4 ? b.z : a.z;
    }
    return ovoid_shape_create_from_points(xyz, 8, NULL, NULL);
}

/// Adds the surface of a box, inside out if `inward`.
static inline void mesh_add_box(mesh *m, ovoid_vec3 a, ovoid_vec3 b, int inward) {
    static const uint8_t faces[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                         {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    uint32_t first = (uint32_t)m->points;
    for (int i = 0; i < 8; i++) mesh_add_point(m, i & 1 ? b.x : a.x, i & 2 ? b.y : a.y, i & 4 ? b.z : a.z);
    for (int i = 0; i < 12; i++)
        mesh_add_triangle(m, first + faces[i][0], first + faces[i][inward ? 2 : 1], first + faces[i][inward ? 1 : 2]);
}

#endif
