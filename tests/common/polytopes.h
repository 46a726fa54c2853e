// Polytopes made by hand, with exact topology and without hull code: box, simplex, prism, sphere of triangles, the hull
// of a few random points, flat bodies; and any affine image of them.
#ifndef OVOID_TESTS_POLYTOPES_H
#define OVOID_TESTS_POLYTOPES_H

#include "check.h"
#include "linear/exact.h"
#include "linear/mat3.h"
#include "linear/rotation.h"
#include "ovoid/polytope.h"

/// A polytope and its arrays.
typedef struct made {
    ovoid_polytope p;
    double *vertices;
    uint32_t *triangles, *triangle_facets, *neighbor_starts, *neighbors;
    ovoid_plane *planes;
} made;

static inline void made_destroy(made *m) {
    free(m->vertices);
    free(m->triangles);
    free(m->triangle_facets);
    free(m->neighbor_starts);
    free(m->neighbors);
    free(m->planes);
    *m = (made){0};
}

/// Recomputes the planes from the vertices: Newell's normal over the facet's triangles, offset at the mean of their
/// corners.
static inline void made_update_planes(made *m) {
    if (m->p.rank < 2) return;
    uint32_t *count = calloc(m->p.facet_count, sizeof *count);
    memset(m->planes, 0, m->p.facet_count * sizeof *m->planes);
    for (int pass = 0; pass < 2; pass++)
        for (uint32_t t = 0; t < m->p.triangle_count; t++) {
            uint32_t f = m->triangle_facets[t], *i = m->triangles + 3 * t;
            vec3 a = vec3_at(m->vertices, i[0]), b = vec3_at(m->vertices, i[1]), c = vec3_at(m->vertices, i[2]);
            ovoid_plane *plane = &m->planes[f];
            if (pass == 0)
                plane->normal = vec3_add(plane->normal, vec3_cross(vec3_sub(b, a), vec3_sub(c, a)));
            else {
                if (count[f] == 0) plane->normal = vec3_unit(plane->normal);
                plane->offset += vec3_dot(plane->normal, a) + vec3_dot(plane->normal, b) + vec3_dot(plane->normal, c);
                count[f] += 3;
            }
        }
    for (uint32_t f = 0; f < m->p.facet_count; f++) m->planes[f].offset /= count[f];
    free(count);
}

/// From polygons: sizes[f] indices each, one after another in `indices`, counter-clockwise from outside.
static inline made made_from_polygons(const double *xyz, uint32_t vertex_count, const uint32_t *indices,
                                      const uint32_t *sizes, uint32_t facet_count) {
    made m = {0};
    uint32_t corners = 0;
    for (uint32_t f = 0; f < facet_count; f++) corners += sizes[f];
    uint32_t triangle_count = corners - 2 * facet_count;
    m.vertices = malloc(3 * sizeof(double) * vertex_count);
    memcpy(m.vertices, xyz, 3 * sizeof(double) * vertex_count);
    m.triangles = malloc(3 * sizeof(uint32_t) * triangle_count);
    m.triangle_facets = malloc(sizeof(uint32_t) * triangle_count);
    m.planes = malloc(sizeof(ovoid_plane) * facet_count);
    m.neighbor_starts = calloc(vertex_count + 1, sizeof(uint32_t));
    m.neighbors = malloc(sizeof(uint32_t) * corners);
    uint32_t t = 0, at = 0;
    for (uint32_t f = 0; f < facet_count; at += sizes[f++]) {
        for (uint32_t k = 0; k + 2 < sizes[f]; k++, t++) {
            uint32_t triangle[3] = {indices[at], indices[at + k + 1], indices[at + k + 2]};
            memcpy(m.triangles + 3 * t, triangle, sizeof triangle);
            m.triangle_facets[t] = f;
        }
        for (uint32_t k = 0; k < sizes[f]; k++) m.neighbor_starts[indices[at + k] + 1]++;
    }
    // Each vertex has as many directed edges as facets.
    for (uint32_t v = 0; v < vertex_count; v++) m.neighbor_starts[v + 1] += m.neighbor_starts[v];
    uint32_t *next = malloc(sizeof(uint32_t) * vertex_count);
    memcpy(next, m.neighbor_starts, sizeof(uint32_t) * vertex_count);
    at = 0;
    for (uint32_t f = 0; f < facet_count; at += sizes[f++])
        for (uint32_t k = 0; k < sizes[f]; k++) m.neighbors[next[indices[at + k]]++] = indices[at + (k + 1) % sizes[f]];
    free(next);
    m.p = (ovoid_polytope){
        m.vertices,   m.triangles,    m.triangle_facets, m.planes, m.neighbor_starts, m.neighbors, {0, 0, 0},
        vertex_count, triangle_count, facet_count,       3};
    made_update_planes(&m);
    return m;
}

/// Maps every vertex v to a v + b; the determinant of a must be positive.
static inline void made_map(made *m, mat3 a, vec3 b) {
    for (uint32_t v = 0; v < m->p.vertex_count; v++) {
        vec3 x = vec3_add(mat3_mul_vec3(a, vec3_at(m->vertices, v)), b);
        memcpy(m->vertices + 3 * v, &x, sizeof x);
    }
    made_update_planes(m);
}

static inline mat3 mat3_diagonal(double x, double y, double z) { return (mat3){{x, 0, 0}, {0, y, 0}, {0, 0, z}}; }
/// One coordinate after another, since the order of initialisers is the compiler's.
static inline vec3 vec3_random(uint64_t *s) {
    vec3 v;
    v.x = random_normal(s);
    v.y = random_normal(s);
    v.z = random_normal(s);
    return v;
}
static inline mat3 mat3_random_rotation(uint64_t *s) {
    vec3 v = vec3_random(s);
    return quat_to_mat3((ovoid_quat){random_normal(s), v.x, v.y, v.z});
}

static inline made made_box(double x, double y, double z) {
    double v[24];
    for (int i = 0; i < 8; i++) {
        v[3 * i] = i & 1 ? x : -x;
        v[3 * i + 1] = i & 2 ? y : -y;
        v[3 * i + 2] = i & 4 ? z : -z;
    }
    const uint32_t indices[24] = {0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4, 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6};
    const uint32_t sizes[6] = {4, 4, 4, 4, 4, 4};
    return made_from_polygons(v, 8, indices, sizes, 6);
}

/// The regular tetrahedron with corners at the unit sphere.
static inline made made_simplex(void) {
    const double r = 0.57735026918962576;
    const double v[12] = {r, r, r, r, -r, -r, -r, r, -r, -r, -r, r};
    const uint32_t indices[12] = {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2}, sizes[4] = {3, 3, 3, 3};
    return made_from_polygons(v, 4, indices, sizes, 4);
}

/// n sides, radius 1, z from -1 to 1.
static inline made made_prism(uint32_t n) {
    double *v = malloc(6 * sizeof(double) * n);
    uint32_t *indices = malloc(6 * sizeof(uint32_t) * n), *sizes = malloc((n + 2) * sizeof(uint32_t));
    for (uint32_t i = 0; i < n; i++) {
        double angle = 6.283185307179586 * i / n;
        for (uint32_t k = 0; k < 2; k++) {
            v[3 * (i + k * n)] = cos(angle);
            v[3 * (i + k * n) + 1] = sin(angle);
            v[3 * (i + k * n) + 2] = k ? 1 : -1;
        }
        uint32_t j = (i + 1) % n, side[4] = {i, j, j + n, i + n};
        memcpy(indices + 4 * i, side, sizeof side);
        sizes[i] = 4;
        indices[4 * n + i] = n - 1 - i;
        indices[5 * n + i] = n + i;
    }
    sizes[n] = sizes[n + 1] = n;
    made m = made_from_polygons(v, 2 * n, indices, sizes, n + 2);
    free(v);
    free(indices);
    free(sizes);
    return m;
}

/// An octahedron whose triangles are cut into k k each, pushed out to the unit sphere: 4 k k + 2 vertices. Points of a
/// face's grid are found again by brute comparison of integer coordinates on the octahedron's surface.
static inline made made_sphere(uint32_t k) {
    uint32_t count = 0, side = 2 * k + 1, *at = malloc(sizeof(uint32_t) * side * side * 2), face = 0;
    double *v = malloc(3 * sizeof(double) * (4 * k * k + 2));
    uint32_t *indices = malloc(3 * sizeof(uint32_t) * 8 * k * k), *sizes = malloc(sizeof(uint32_t) * 8 * k * k);
    int n = (int)k;
    for (int up = 0; up < 2; up++)
        for (int x = -n; x <= n; x++)
            for (int y = -n; y <= n; y++) {
                int z = n - abs(x) - abs(y);
                uint32_t cell = ((uint32_t)up * side + (uint32_t)(x + n)) * side + (uint32_t)(y + n);
                at[cell] = z == 0 && up ? at[cell - side * side] : count;
                if (z < 0 || (z == 0 && up)) continue;
                vec3 p = vec3_unit(vec3_make(x, y, up ? z : -z));
                memcpy(v + 3 * count++, &p, sizeof p);
            }
    for (int octant = 0; octant < 8; octant++)
        for (int a = 0; a < n; a++)
            for (int b = 0; a + b < n; b++)
                for (int half = 0; half < (a + b + 2 <= n ? 2 : 1); half++) {
                    int corner[3][2] = {{a + half, b + half}, {a + 1, b}, {a, b + 1}};
                    int sx = octant & 1 ? -1 : 1, sy = octant & 2 ? -1 : 1, up = !(octant & 4);
                    int flip = (sx * sy * (up ? 1 : -1) < 0) != (half == 1);
                    for (int i = 0; i < 3; i++) {
                        int *c = corner[flip && i ? 3 - i : i];
                        uint32_t column = (uint32_t)(sx * c[0] + n), row = (uint32_t)(sy * c[1] + n);
                        indices[3 * face + (uint32_t)i] = at[((uint32_t)up * side + column) * side + row];
                    }
                    sizes[face++] = 3;
                }
    made m = made_from_polygons(v, count, indices, sizes, face);
    free(at);
    free(v);
    free(indices);
    free(sizes);
    return m;
}

/// The hull of points in general position. Only extreme points become corners of facets; others stay as vertices
/// without a facet. By insertion with exact orientations: cost points times facets.
static inline made made_hull(const double *xyz, uint32_t count) {
    uint32_t(*face)[3] = malloc(sizeof(uint32_t[3]) * (8 * count + 64)), faces = 0;
    uint32_t(*edge)[2] = malloc(sizeof(uint32_t[2]) * (16 * count + 64));
    for (uint32_t i = 0; i < 4; i++) {
        uint32_t t[3] = {(i + 1) % 4, (i + 2) % 4, (i + 3) % 4};
        if (orient3d_sign(vec3_at(xyz, t[0]), vec3_at(xyz, t[1]), vec3_at(xyz, t[2]), vec3_at(xyz, i)) < 0) {
            uint32_t swap = t[1];
            t[1] = t[2], t[2] = swap;
        }
        memcpy(face[faces++], t, sizeof t);
    }
    for (uint32_t v = 4; v < count; v++) {
        uint32_t kept = 0, edges = 0;
        for (uint32_t f = 0; f < faces; f++) {
            uint32_t *t = face[f];
            if (orient3d_sign(vec3_at(xyz, t[0]), vec3_at(xyz, t[1]), vec3_at(xyz, t[2]), vec3_at(xyz, v)) >= 0) {
                memmove(face[kept++], t, sizeof *face);
                continue;
            }
            // The horizon: directed edges of visible faces whose opposite is not visible.
            for (int k = 0; k < 3; k++) {
                uint32_t a = t[k], b = t[(k + 1) % 3], e = 0;
                while (e < edges && !(edge[e][0] == b && edge[e][1] == a)) e++;
                if (e < edges)
                    memcpy(edge[e], edge[--edges], sizeof *edge);
                else
                    edge[edges][0] = a, edge[edges++][1] = b;
            }
        }
        faces = kept;
        for (uint32_t e = 0; e < edges; e++) {
            uint32_t t[3] = {edge[e][0], edge[e][1], v};
            memcpy(face[faces++], t, sizeof t);
        }
    }
    uint32_t *sizes = malloc(sizeof(uint32_t) * faces);
    for (uint32_t f = 0; f < faces; f++) sizes[f] = 3;
    made m = made_from_polygons(xyz, count, &face[0][0], sizes, faces);
    free(face);
    free(edge);
    free(sizes);
    return m;
}

/// The hull of random points: on the unit sphere, or normally distributed (then some are interior).
static inline made made_random(uint32_t count, int on_sphere, uint64_t *seed) {
    double *v = malloc(3 * sizeof(double) * count);
    for (uint32_t i = 0; i < count; i++) {
        vec3 p = vec3_random(seed);
        if (on_sphere) p = vec3_unit(p);
        memcpy(v + 3 * i, &p, sizeof p);
    }
    made m = made_hull(v, count);
    free(v);
    return m;
}

/// A flat polygon of n given corners, counter-clockwise about the normal of the first three.
static inline made made_polygon(const double *xyz, uint32_t n) {
    uint32_t *indices = calloc(n, sizeof(uint32_t));
    for (uint32_t i = 0; i < n; i++) indices[i] = i;
    made m = made_from_polygons(xyz, n, indices, &n, 1);
    free(indices);
    free(m.neighbors);
    m.neighbors = malloc(2 * sizeof(uint32_t) * n);
    for (uint32_t i = 0; i < n; i++) {
        m.neighbor_starts[i + 1] = 2 * i + 2;
        m.neighbors[2 * i] = (i + 1) % n;
        m.neighbors[2 * i + 1] = (i + n - 1) % n;
    }
    m.p.neighbors = m.neighbors;
    m.p.rank = 2;
    return m;
}

/// A point (count 1) or a segment (count 2).
static inline made made_segment(const double *xyz, uint32_t count) {
    made m = {0};
    m.vertices = malloc(3 * sizeof(double) * count);
    memcpy(m.vertices, xyz, 3 * sizeof(double) * count);
    m.neighbor_starts = calloc(count + 1, sizeof(uint32_t));
    m.neighbors = malloc(2 * sizeof(uint32_t));
    if (count == 2) {
        m.neighbor_starts[1] = 1, m.neighbor_starts[2] = 2;
        m.neighbors[0] = 1, m.neighbors[1] = 0;
    }
    m.p.vertices = m.vertices;
    m.p.neighbor_starts = m.neighbor_starts;
    m.p.neighbors = m.neighbors;
    m.p.vertex_count = count;
    m.p.rank = count - 1;
    return m;
}

#endif
