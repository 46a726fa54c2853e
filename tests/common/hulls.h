// Properties of every hull, by exact arithmetic: a closed surface of triangles that are all convex to their neighbors,
// with every given point behind every triangle, is the hull. Planes and rank are promised to 64 roundings of the
// largest coordinate (polytope/facets.h). Twice that is allowed here, as the plane of a facet may differ from that of
// its largest triangle by as much.
#ifndef OVOID_TESTS_HULLS_H
#define OVOID_TESTS_HULLS_H

#include "base/allocator.h"
#include "check.h"
#include "linear/exact.h"
#include "polytope/hull.h"

#define FLATNESS (2 * 64 * 0x1p-53)

// ---- properties of every hull ----

// Vertices are given points, in their given order, and the counts add up.
static inline void check_counts(const hull *h, const double *xyz, size_t count) {
    const ovoid_report *r = &h->report;
    CHECK_EQ(r->points, count);
    CHECK_EQ(r->vertices, h->vertex_count);
    CHECK_EQ(r->points, r->vertices + r->duplicates + r->interior);
    CHECK_LE(r->coplanar, r->interior);
    CHECK_EQ(r->rank, h->rank);
    size_t at = 0;
    int found = 1;
    for (uint32_t v = 0; v < h->vertex_count && found; v++, at++) {
        vec3 want = vec3_at(h->vertices, v);
        for (; at < count; at++) {
            // The difference is exact, so this finds the given point.
            vec3 p = vec3_sub(vec3_at(xyz, at), h->origin);
            if (p.x == want.x && p.y == want.y && p.z == want.z) break;
        }
        found = at < count;
    }
    CHECK(found);
}

static inline void check_adjacency(const hull *h) {
    CHECK_EQ(h->neighbor_starts[0], 0);
    int symmetric = 1, ascending = 1;
    for (uint32_t v = 0; v < h->vertex_count; v++)
        for (uint32_t i = h->neighbor_starts[v]; i < h->neighbor_starts[v + 1]; i++) {
            uint32_t w = h->neighbors[i], found = 0;
            if (w >= h->vertex_count || w == v) {
                CHECK(!"a neighbor in range");
                return;
            }
            for (uint32_t k = h->neighbor_starts[w]; k < h->neighbor_starts[w + 1]; k++) found += h->neighbors[k] == v;
            symmetric &= found == 1;
            ascending &= h->rank < 3 || i == h->neighbor_starts[v] || h->neighbors[i - 1] < w;
        }
    // The edge at a corner of a triangle is in the list of that corner, and leads to the next one.
    int known = 1;
    for (uint32_t i = 0; i < 3 * h->triangle_count && h->corner_edges; i++) {
        uint32_t e = h->corner_edges[i], v = h->triangles[i], to = h->triangles[i % 3 == 2 ? i - 2 : i + 1];
        known &= e >= h->neighbor_starts[v] && e < h->neighbor_starts[v + 1] && h->neighbors[e] == to;
    }
    CHECK(known);
    CHECK(symmetric);
    CHECK(ascending);
}

static inline double compute_extent_of(const hull *h) {
    double extent = 0;
    for (uint32_t i = 0; i < 3 * h->vertex_count; i++) extent = fmax(extent, fabs(h->vertices[i]));
    return extent;
}

// Unit normals, no vertex above a plane, every facet used, triangles on their facet's plane.
static inline void check_planes(const hull *h) {
    double flatness = FLATNESS * compute_extent_of(h), above = 0, off = 0;
    uint8_t *used = calloc(h->facet_count + 1, 1);
    for (uint32_t f = 0; f < h->facet_count; f++) {
        CHECK_NEAR(vec3_norm(h->planes[f].normal), 1, 4e-16);
        for (uint32_t v = 0; v < h->vertex_count; v++)
            above = fmax(above, vec3_dot(h->planes[f].normal, vec3_at(h->vertices, v)) - h->planes[f].offset);
    }
    for (uint32_t t = 0; t < h->triangle_count; t++) {
        ovoid_plane plane = h->planes[h->triangle_facets[t]];
        used[h->triangle_facets[t]] = 1;
        for (int k = 0; k < 3; k++)
            off = fmax(off, plane.offset - vec3_dot(plane.normal, vec3_at(h->vertices, h->triangles[3 * t + k])));
    }
    CHECK_LE(above, flatness);
    CHECK_LE(off, 2 * flatness);
    for (uint32_t f = 0; f < h->facet_count; f++) CHECK(used[f]);
    free(used);
}

// The edge from b to a in the triangles around it; the corner beyond it.
static inline uint32_t find_opposite(const hull *h, uint32_t a, uint32_t b, uint32_t *beyond) {
    uint32_t found = 0;
    for (uint32_t t = 0; t < h->triangle_count; t++)
        for (int k = 0; k < 3; k++)
            if (h->triangles[3 * t + k] == b && h->triangles[3 * t + (k + 1) % 3] == a) {
                found++;
                *beyond = h->triangles[3 * t + (k + 2) % 3];
            }
    return found;
}

// The surface is closed, of the sphere's topology, convex at every edge, with three creases at every vertex. Quadratic:
// for small hulls.
static inline void check_surface(const hull *h) {
    CHECK_EQ(h->triangle_count, 2 * h->vertex_count - 4);
    uint32_t *creases = calloc(h->vertex_count, sizeof *creases);
    int closed = 1, convex = 1, extreme = 1;
    for (uint32_t t = 0; t < h->triangle_count; t++) {
        const uint32_t *c = h->triangles + 3 * t;
        vec3 p[3] = {vec3_at(h->vertices, c[0]), vec3_at(h->vertices, c[1]), vec3_at(h->vertices, c[2])};
        for (int k = 0; k < 3; k++) {
            uint32_t beyond = 0;
            closed &= find_opposite(h, c[k], c[(k + 1) % 3], &beyond) == 1;
            int side = orient3d_sign(p[0], p[1], p[2], vec3_at(h->vertices, beyond));
            convex &= side >= 0;
            creases[c[k]] += side > 0;
        }
    }
    for (uint32_t v = 0; v < h->vertex_count; v++) extreme &= creases[v] >= 3;
    CHECK(closed);
    CHECK(convex);
    CHECK(extreme);
    free(creases);
}

// Every given point is behind every triangle, exactly. Every `step`th triangle of large ones.
static inline void check_holds(const hull *h, const double *xyz, size_t count) {
    size_t step = 1 + (size_t)h->triangle_count * count / 4000000;
    size_t outside = 0;
    for (size_t t = 0; t < h->triangle_count; t += step) {
        const uint32_t *c = h->triangles + 3 * t;
        vec3 p[3] = {vec3_at(h->vertices, c[0]), vec3_at(h->vertices, c[1]), vec3_at(h->vertices, c[2])};
        for (size_t i = 0; i < count; i++)
            outside += orient3d_sign(p[0], p[1], p[2], vec3_sub(vec3_at(xyz, i), h->origin)) < 0;
    }
    CHECK_EQ(outside, 0);
}

// No point is beyond the vertices along any direction, without tolerance: the rounded dot product is a function of the
// point alone, and extreme points are vertices. A point that is not extreme may round above all vertices, by 3
// roundings of the largest term.
static inline void check_directions(const hull *h, const double *xyz, size_t count, int directions) {
    uint64_t s = count;
    double extent = compute_extent_of(h), worst = 0;
    for (int i = 0; i < directions; i++) {
        vec3 n = vec3_unit((vec3){random_normal(&s), random_normal(&s), random_normal(&s)});
        double of_points = -INFINITY, of_vertices = -INFINITY;
        for (size_t k = 0; k < count; k++)
            of_points = fmax(of_points, vec3_dot(n, vec3_sub(vec3_at(xyz, k), h->origin)));
        for (uint32_t k = 0; k < h->vertex_count; k++)
            of_vertices = fmax(of_vertices, vec3_dot(n, vec3_at(h->vertices, k)));
        worst = fmax(worst, of_points - of_vertices);
    }
    CHECK_LE(worst, 6 * 0x1p-53 * extent);
}

// The hull of the vertices is the hull, bit for bit.
static inline void check_again(const hull *h) {
    hull g;
    ovoid_allocator memory = allocator_make(NULL);
    ovoid_code code;
    code = hull_create((xyz_points){h->vertices, h->vertex_count}, &memory, &g, NULL);
    CHECK_EQ(code, OVOID_OK);
    CHECK_EQ(g.vertex_count, h->vertex_count);
    CHECK_EQ(g.triangle_count, h->triangle_count);
    CHECK_EQ(g.facet_count, h->facet_count);
    CHECK_EQ(g.rank, h->rank);
    if (g.vertex_count == h->vertex_count && g.triangle_count == h->triangle_count && g.facet_count == h->facet_count) {
        uint32_t edges = h->neighbor_starts[h->vertex_count];
        CHECK(!memcmp(g.vertices, h->vertices, g.vertex_count * 3 * sizeof(double)));
        CHECK(!memcmp(g.neighbor_starts, h->neighbor_starts, (g.vertex_count + 1) * sizeof(uint32_t)));
        CHECK(!memcmp(g.neighbors, h->neighbors, edges * sizeof(uint32_t)));
        if (g.triangle_count) {
            CHECK(!memcmp(g.triangles, h->triangles, g.triangle_count * 3 * sizeof(uint32_t)));
            CHECK(!memcmp(g.triangle_facets, h->triangle_facets, g.triangle_count * sizeof(uint32_t)));
            CHECK(!memcmp(g.planes, h->planes, g.facet_count * sizeof(ovoid_plane)));
        }
    }
    CHECK(g.origin.x == 0 && g.origin.y == 0 && g.origin.z == 0);
    hull_destroy(&g, &memory);
}

// All of these checks; the caller destroys the hull.
static inline hull check_hull(const double *xyz, size_t count) {
    hull h;
    ovoid_allocator memory = allocator_make(NULL);
    ovoid_error error = {0};
    ovoid_code code = hull_create((xyz_points){xyz, count}, &memory, &h, &error);
    if (!CHECK_EQ(code, OVOID_OK)) {
        printf("%s\n", error.message);
        return h;
    }
    check_counts(&h, xyz, count);
    check_adjacency(&h);
    check_planes(&h);
    check_directions(&h, xyz, count, 20);
    check_again(&h);
    if (h.rank == 3 && h.triangle_count < 3000) check_surface(&h);
    if (h.rank == 3) check_holds(&h, xyz, count);
    CHECK_EQ(h.facet_count, h.rank == 3 ? h.facet_count : h.rank == 2);
    return h;
}

#endif
