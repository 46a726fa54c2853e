// The hull of points. The truth is exact arithmetic (orient3d_sign, tested by itself): a closed surface of triangles
// that are all convex to their neighbors, with every given point behind every triangle, is the hull. Counts come from
// how the points were made; Qhull, another program, gives the vertices and the volume of random clouds. Tolerances:
// planes and rank are promised to 64 roundings of the largest coordinate (polytope/facets.h); the tests allow twice
// that, as a facet's plane turns away from that of its largest triangle by as much.
#include "check.h"
#include "linear/exact.h"
#include "linear/rotation.h"
#include "polytope/hull.h"
#include "polytope/points.h"
#include "polytope/quickhull.h"

#include <libqhull_r/qhull_ra.h>

#define FLATNESS (2 * 64 * 0x1p-53)

static ovoid_allocator allocator;

// ---- what must hold of every hull ----

// Vertices are given points, in the order given, and the counts add up.
static void check_counts(const hull *h, const double *xyz, size_t count) {
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
            // The difference is exact, so this finds the very point.
            vec3 p = vec3_sub(vec3_at(xyz, at), h->origin);
            if (p.x == want.x && p.y == want.y && p.z == want.z) break;
        }
        found = at < count;
    }
    CHECK(found);
}

static void check_adjacency(const hull *h) {
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
    CHECK(symmetric);
    CHECK(ascending);
}

static double compute_extent_of(const hull *h) {
    double extent = 0;
    for (uint32_t i = 0; i < 3 * h->vertex_count; i++) extent = fmax(extent, fabs(h->vertices[i]));
    return extent;
}

// Unit normals, no vertex above a plane, every facet used, triangles on their facet's plane.
static void check_planes(const hull *h) {
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
static uint32_t find_opposite(const hull *h, uint32_t a, uint32_t b, uint32_t *beyond) {
    uint32_t found = 0;
    for (uint32_t t = 0; t < h->triangle_count; t++)
        for (int k = 0; k < 3; k++)
            if (h->triangles[3 * t + k] == b && h->triangles[3 * t + (k + 1) % 3] == a) {
                found++;
                *beyond = h->triangles[3 * t + (k + 2) % 3];
            }
    return found;
}

// Closed, of the sphere's kind, convex at every edge, three creases at every vertex. Quadratic: for small hulls.
static void check_surface(const hull *h) {
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
static void check_holds(const hull *h, const double *xyz, size_t count) {
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

// No point is beyond the vertices along any direction, without tolerance: the rounded dot product is one function of
// the point, and extreme points are vertices themselves. Where a point is not extreme it may still round above all
// vertices, by 3 roundings of the largest term.
static void check_directions(const hull *h, const double *xyz, size_t count, int directions) {
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
static void check_again(const hull *h) {
    hull g;
    ovoid_code code;
    code = hull_create(h->vertices, h->vertex_count, &allocator, &g, NULL);
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
    hull_destroy(&g, &allocator);
}

// All of it; the caller destroys the hull.
static hull check_hull(const double *xyz, size_t count) {
    hull h;
    ovoid_error error = {0};
    ovoid_code code = hull_create(xyz, count, &allocator, &h, &error);
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

// ---- clouds ----

static double cloud[3 * 100000];

static void put(size_t i, vec3 v) {
    cloud[3 * i] = v.x;
    cloud[3 * i + 1] = v.y;
    cloud[3 * i + 2] = v.z;
}

static mat3 random_rotation(uint64_t *s) {
    return quat_to_mat3((ovoid_quat){random_normal(s), random_normal(s), random_normal(s), random_normal(s)});
}

static void rotate_cloud(size_t count, mat3 r) {
    for (size_t i = 0; i < count; i++) put(i, mat3_mul_vec3(r, vec3_at(cloud, i)));
}

// A grid on the six faces of a box of that size: g points along an edge.
static size_t put_grid_box(vec3 size, int g) {
    size_t n = 0;
    for (int i = 0; i < g; i++)
        for (int j = 0; j < g; j++)
            for (int k = 0; k < g; k++)
                if (i % (g - 1) == 0 || j % (g - 1) == 0 || k % (g - 1) == 0)
                    put(n++, (vec3){size.x * i / (g - 1), size.y * j / (g - 1), size.z * k / (g - 1)});
    return n;
}

static size_t put_sphere(uint64_t *s, size_t count, double radius) {
    for (size_t i = 0; i < count; i++)
        put(i, vec3_scale(vec3_unit((vec3){random_normal(s), random_normal(s), random_normal(s)}), radius));
    return count;
}

// Boxes: 8 vertices, 6 facets, everything else on a face or inside, whatever is put there.
static void check_boxes(void) {
    size_t n = put_grid_box((vec3){2, 3, 5}, 9);
    hull h = check_hull(cloud, n);
    CHECK_EQ(h.vertex_count, 8);
    CHECK_EQ(h.facet_count, 6);
    CHECK_EQ(h.triangle_count, 12);
    CHECK_EQ(h.report.coplanar, n - 8);
    hull_destroy(&h, &allocator);

    // A full grid with integer coordinates: the inner ones are interior, not coplanar. Each twice, one as -0.
    n = 0;
    for (int twice = 0; twice < 2; twice++)
        for (int i = 0; i < 7; i++)
            for (int j = 0; j < 7; j++)
                for (int k = 0; k < 7; k++) put(n++, (vec3){i ? i : twice ? -0.0 : 0.0, j, k});
    h = check_hull(cloud, n);
    CHECK_EQ(h.vertex_count, 8);
    CHECK_EQ(h.report.duplicates, 343);
    CHECK_EQ(h.report.interior, 335);
    CHECK_EQ(h.report.coplanar, 343 - 125 - 8);
    hull_destroy(&h, &allocator);

    // Rotated: rounding makes some points of the faces extreme; facets are seen as six all the same.
    uint64_t s = 3;
    for (int i = 0; i < 10; i++) {
        n = put_grid_box((vec3){2, 3, 5}, 8);
        rotate_cloud(n, random_rotation(&s));
        h = check_hull(cloud, n);
        CHECK_EQ(h.rank, 3);
        CHECK_EQ(h.facet_count, 6);
        hull_destroy(&h, &allocator);
    }
}

// Qhull's vertices, as flags, and volume.
static double compute_with_qhull(size_t count, uint8_t *is_vertex) {
    qhT qh;
    FILE *nothing = fopen("/dev/null", "w");
    memset(&qh, 0, sizeof qh);
    qh_zero(&qh, nothing);
    char command[] = "qhull FA";
    if (qh_new_qhull(&qh, 3, (int)count, cloud, 0, command, nothing, nothing) == 0) {
        qh_getarea(&qh, qh.facet_list);
        memset(is_vertex, 0, count);
        for (vertexT *v = qh.vertex_list; v && v->next; v = v->next) is_vertex[qh_pointid(&qh, v->point)] = 1;
    }
    double volume = qh.totvol;
    qh_freeqhull(&qh, 1);
    int current, total;
    qh_memfreeshort(&qh, &current, &total);
    fclose(nothing);
    return volume;
}

// Random clouds have no four points so near a plane that Qhull's tolerance (about 1e-15) would matter.
static void check_against_qhull(void) {
    uint64_t s = 11;
    static uint8_t is_vertex[20000];
    for (int i = 0; i < 60; i++) {
        check_seed = s;
        size_t n = i < 50 ? 4 + random_next(&s) % 60 : 2000;
        for (size_t k = 0; k < n; k++) put(k, (vec3){random_normal(&s), 3 * random_normal(&s), random_normal(&s) / 3});
        hull h = check_hull(cloud, n);
        double volume = compute_with_qhull(n, is_vertex), ours = 0;
        uint32_t at = 0;
        int same = 1;
        for (size_t k = 0; k < n; k++) {
            vec3 p = vec3_at(cloud, k);
            int kept = at < h.vertex_count && h.vertices[3 * at] == p.x && h.vertices[3 * at + 1] == p.y &&
                       h.vertices[3 * at + 2] == p.z;
            at += (uint32_t)kept;
            same &= kept == is_vertex[k];
        }
        CHECK(same);
        for (uint32_t t = 0; t < h.triangle_count; t++)
            ours += vec3_dot(
                vec3_at(h.vertices, h.triangles[3 * t]),
                vec3_cross(vec3_at(h.vertices, h.triangles[3 * t + 1]), vec3_at(h.vertices, h.triangles[3 * t + 2])));
        // Sums of a few thousand terms, each rounded a few times.
        CHECK_NEAR(ours / 6, volume, 1e-12 * volume);
        hull_destroy(&h, &allocator);
    }
    check_seed = 0;
}

// The same cloud at any scale and place gives the same hull.
static void check_scales(void) {
    static const double scales[] = {1e-290, 1e-120, 1e-9, 1, 1e9, 1e45};
    uint32_t vertices = 0;
    for (size_t i = 0; i < sizeof scales / sizeof *scales; i++) {
        uint64_t s = 5;
        size_t n = put_sphere(&s, 300, 1);
        for (size_t k = 0; k < n; k += 3) put(k, vec3_scale(vec3_at(cloud, k), 0.5));
        // A power of two, so that no coordinate is rounded.
        int e;
        (void)frexp(scales[i], &e);
        for (size_t k = 0; k < 3 * n; k++) cloud[k] = ldexp(cloud[k], e);
        hull h;
        ovoid_code code = hull_create(cloud, n, &allocator, &h, NULL);
        CHECK_EQ(code, OVOID_OK);
        check_counts(&h, cloud, n);
        check_planes(&h);
        check_again(&h);
        CHECK_EQ(h.rank, 3);
        if (i == 0) vertices = h.vertex_count;
        CHECK_EQ(h.vertex_count, vertices);
        hull_destroy(&h, &allocator);
    }
}

// Far from the origin the frame moves along, exactly, and only along the components that are far.
static void check_far(void) {
    uint64_t s = 8;
    size_t n = put_sphere(&s, 500, 1);
    for (size_t i = 0; i < n; i++) put(i, vec3_add(vec3_at(cloud, i), (vec3){1e7, 2, -3e15}));
    hull h = check_hull(cloud, n);
    CHECK_EQ(h.rank, 3);
    CHECK_NEAR(h.origin.x, 1e7, 2);
    CHECK_EQ(h.origin.y, 0);
    CHECK_NEAR(h.origin.z, -3e15, 2);
    CHECK_LE(compute_extent_of(&h), 5);
    hull_destroy(&h, &allocator);

    put(0, (vec3){1e7, -1e-30, 1e50});
    h = check_hull(cloud, 1);
    CHECK_EQ(h.rank, 0);
    CHECK_EQ(h.origin.z, 1e50);
    CHECK_EQ(h.vertices[2], 0);
    hull_destroy(&h, &allocator);
}

// Cylinder, cone, needle, slab, all turned: near-coplanar and near-collinear points.
static void check_hard(void) {
    uint64_t s = 21;
    static const double stretch[][3] = {{1, 1, 1}, {1, 1, 1e-6}, {1, 1e-6, 1e-6}, {1, 1e-3, 1e-9}, {1, 1, 1e-13}};
    for (size_t i = 0; i < sizeof stretch / sizeof *stretch; i++)
        for (int turned = 0; turned < 4; turned++) {
            size_t n = put_grid_box((vec3){1, 1, 1}, 7);
            for (int k = 0; k < 40; k++) {
                double a = 6.283185307179586 * k / 40;
                put(n++, (vec3){0.5 + cos(a), 0.5 + sin(a), 0});
                put(n++, (vec3){0.5 + cos(a), 0.5 + sin(a), 1});
            }
            for (size_t k = 0; k < n; k++) {
                vec3 v = vec3_at(cloud, k);
                put(k, (vec3){v.x * stretch[i][0], v.y * stretch[i][1], v.z * stretch[i][2]});
            }
            if (turned) rotate_cloud(n, random_rotation(&s));
            hull h = check_hull(cloud, n);
            CHECK_EQ(h.rank, 3);
            if (!turned) CHECK_EQ(h.vertex_count, 80);
            hull_destroy(&h, &allocator);
        }
    // A cone's apex has many neighbors.
    for (int k = 0; k < 5000; k++) put((size_t)k, (vec3){cos(k * 1e-3), sin(k * 1e-3), 0});
    put(5000, (vec3){0, 0, 2});
    rotate_cloud(5001, random_rotation(&s));
    hull h = check_hull(cloud, 5001);
    CHECK_EQ(h.rank, 3);
    hull_destroy(&h, &allocator);
}

// Exactly flat bodies, whose corners are known, and nearly flat ones, which keep every extreme point.
static void check_flat(void) {
    size_t n = 0;
    for (int i = 0; i < 11; i++)
        for (int j = 0; j < 6; j++) put(n++, (vec3){j, i - 2 * j, i});
    hull h = check_hull(cloud, n);
    CHECK_EQ(h.rank, 2);
    CHECK_EQ(h.vertex_count, 4);
    CHECK_EQ(h.triangle_count, 2);
    CHECK_EQ(h.report.coplanar, n - 4);
    for (uint32_t v = 0; v < 4; v++) CHECK_EQ(h.neighbor_starts[v + 1] - h.neighbor_starts[v], 2);
    vec3 turn = vec3_cross(vec3_sub(vec3_at(h.vertices, h.triangles[1]), vec3_at(h.vertices, h.triangles[0])),
                           vec3_sub(vec3_at(h.vertices, h.triangles[2]), vec3_at(h.vertices, h.triangles[0])));
    CHECK_NEAR(vec3_dot(vec3_unit(turn), h.planes[0].normal), 1, 1e-15);
    hull_destroy(&h, &allocator);

    uint64_t s = 77;
    for (int i = 0; i < 20; i++) {
        check_seed = s;
        n = 0;
        for (int j = 0; j < 12; j++)
            for (int k = 0; k < 12; k++) put(n++, (vec3){j / 11.0, k / 11.0, 0});
        rotate_cloud(n, random_rotation(&s));
        h = check_hull(cloud, n);
        CHECK_EQ(h.rank, 2);
        CHECK_LE(4, h.vertex_count);
        hull_destroy(&h, &allocator);
        for (int j = 0; j < 100; j++) put((size_t)j, (vec3){0, 0, j / 99.0});
        rotate_cloud(100, random_rotation(&s));
        h = check_hull(cloud, 100);
        CHECK_EQ(h.rank, 1);
        CHECK_EQ(h.neighbor_starts[h.vertex_count], 2);
        hull_destroy(&h, &allocator);
    }
    check_seed = 0;
    for (int i = 0; i < 50; i++) put((size_t)i, (vec3){(i * 7 % 50) * 3, (i * 7 % 50) * -2, 1});
    h = check_hull(cloud, 50);
    CHECK_EQ(h.rank, 1);
    CHECK_EQ(h.vertex_count, 2);
    CHECK_EQ(h.report.coplanar, 48);
    hull_destroy(&h, &allocator);
    for (int i = 0; i < 9; i++) put((size_t)i, (vec3){0.1, 0.2, 0.3});
    h = check_hull(cloud, 9);
    CHECK_EQ(h.rank, 0);
    CHECK_EQ(h.report.duplicates, 8);
    hull_destroy(&h, &allocator);
}

// Points that differ by the least that doubles can say, and coordinates far below the body's size.
static void check_tiny_differences(void) {
    uint64_t s = 4;
    for (int i = 0; i < 200; i++) {
        check_seed = s;
        for (size_t k = 0; k < 30; k++) {
            vec3 v = {1, 1, 1};
            double *c = &v.x;
            for (int a = 0; a < 3; a++) {
                for (uint64_t m = random_next(&s) % 4; m > 0; m--) c[a] = nextafter(c[a], 2);
                if (i % 2 && random_next(&s) % 3 == 0) c[a] = ldexp(1, -(int)(random_next(&s) % 1074));
            }
            put(k, v);
        }
        hull h;
        ovoid_code code = hull_create(cloud, 30, &allocator, &h, NULL);
        CHECK_EQ(code, OVOID_OK);
        check_counts(&h, cloud, 30);
        check_adjacency(&h);
        check_planes(&h);
        hull_destroy(&h, &allocator);
    }
    check_seed = 0;
}

// ---- trouble ----

typedef struct countdown {
    long left, held;
} countdown;

static void *allocate_counted(void *context, size_t size) {
    countdown *c = context;
    if (c->left-- <= 0) return NULL;
    c->held++;
    return aligned_alloc(64, (size + 63) / 64 * 64);
}
static void release_counted(void *context, void *memory) {
    ((countdown *)context)->held--;
    free(memory);
}

static void check_memory(void) {
    uint64_t s = 6;
    for (int kind = 0; kind < 4; kind++) {
        size_t n = put_sphere(&s, 400, 1);
        for (size_t i = 0; i < n; i++) {
            vec3 v = vec3_at(cloud, i);
            put(i, vec3_scale((vec3){v.x, kind < 3 ? v.y : 0, kind == 0 ? v.z : 0}, i % 2 ? 1 : 0.3));
        }
        if (kind == 2) rotate_cloud(n, random_rotation(&s));
        ovoid_code code = OVOID_ERROR_MEMORY;
        for (long k = 0; code; k++) {
            countdown c = {k, 0};
            ovoid_allocator counted = {allocate_counted, release_counted, &c};
            hull h;
            code = hull_create(cloud, n, &counted, &h, NULL);
            if (code)
                CHECK_EQ(code, OVOID_ERROR_MEMORY);
            else
                hull_destroy(&h, &counted);
            CHECK_EQ(c.held, 0);
        }
    }
}

static void check_errors(void) {
    hull h;
    ovoid_error error;
    ovoid_code code;
    uint64_t s = 9;
    put_sphere(&s, 10, 1);
    code = hull_create(cloud, 0, &allocator, &h, &error);
    CHECK_EQ(code, OVOID_ERROR_EMPTY);
    code = hull_create(cloud, POINTS_MAX + 1, &allocator, &h, &error);
    CHECK_EQ(code, OVOID_ERROR_LIMIT);
    cloud[3 * 7 + 1] = NAN;
    code = hull_create(cloud, 10, &allocator, &h, &error);
    CHECK_EQ(code, OVOID_ERROR_NOT_FINITE);
    CHECK_EQ(error.place, 7);
    cloud[3 * 7 + 1] = -INFINITY;
    code = hull_create(cloud, 10, &allocator, &h, &error);
    CHECK_EQ(code, OVOID_ERROR_NOT_FINITE);
    cloud[3 * 7 + 1] = -1.1e50;
    code = hull_create(cloud, 10, &allocator, &h, &error);
    CHECK_EQ(code, OVOID_ERROR_RANGE);
    CHECK_EQ(error.place, 7);
}

// ---- real points ----

static void check_game_hulls(void) {
    const char *folder = check_data_folder();
    char path[1024];
    snprintf(path, sizeof path, "%s/pieces/game_hulls.bin", folder ? folder : "");
    FILE *file = folder ? fopen(path, "rb") : NULL;
    if (!file) {
        check_skip("pieces/game_hulls.bin is absent");
        return;
    }
    uint32_t n, hulls = 0;
    while (fread(&n, sizeof n, 1, file) == 1 && CHECK_LE(n, 30000)) {
        for (uint32_t i = 0; i < 3 * n; i++) {
            float v = 0;
            size_t got = fread(&v, sizeof v, 1, file);
            CHECK_EQ(got, 1);
            cloud[i] = v;
        }
        check_seed = hulls++;
        hull h = check_hull(cloud, n);
        hull_destroy(&h, &allocator);
    }
    check_seed = 0;
    CHECK_EQ(hulls, 3378);
    fclose(file);
}

int main(void) {
    allocator = allocator_make(NULL);
    check_boxes();
    check_against_qhull();
    check_scales();
    check_far();
    check_hard();
    check_flat();
    check_tiny_differences();
    check_memory();
    check_errors();
    check_game_hulls();
    uint64_t s = 2;
    hull h = check_hull(cloud, put_sphere(&s, 5000, 1e9));
    CHECK_EQ(h.vertex_count, 5000);
    hull_destroy(&h, &allocator);
    return check_end();
}
