// The hull of points. The truth is exact arithmetic (orient3d_sign, tested by itself): a closed surface of triangles
// that are all convex to their neighbors, with every given point behind every triangle, is the hull. Counts come from
// how the points were made; Qhull, another program, gives the vertices and the volume of random clouds. Tolerances:
// planes and rank are promised to 64 roundings of the largest coordinate (polytope/facets.h); the tests allow twice
// that, as a facet's plane turns away from that of its largest triangle by as much.
#include "countdown.h"
#include "hulls.h"
#include "linear/rotation.h"
#include "polytope/points.h"
#include "polytope/quickhull.h"

static ovoid_allocator allocator;

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
static void check_grids(int g) {
    size_t n = put_grid_box((vec3){2, 3, 5}, g);
    hull h = check_hull(cloud, n);
    CHECK_EQ(h.vertex_count, 8);
    CHECK_EQ(h.facet_count, 6);
    CHECK_EQ(h.triangle_count, 12);
    CHECK_EQ(h.report.coplanar, n - 8);
    hull_destroy(&h, &allocator);

    // A full grid with integer coordinates: the inner ones are interior, not coplanar. Each twice, one as -0.
    n = 0;
    for (int twice = 0; twice < 2; twice++)
        for (int i = 0; i < g; i++)
            for (int j = 0; j < g; j++)
                for (int k = 0; k < g; k++) put(n++, (vec3){i ? i : twice ? -0.0 : 0.0, j, k});
    uint64_t all = (uint64_t)(g * g * g), inner = (uint64_t)((g - 2) * (g - 2) * (g - 2));
    h = check_hull(cloud, n);
    CHECK_EQ(h.vertex_count, 8);
    CHECK_EQ(h.report.duplicates, all);
    CHECK_EQ(h.report.interior, all - 8);
    CHECK_EQ(h.report.coplanar, all - inner - 8);
    hull_destroy(&h, &allocator);
}

static void check_boxes(void) {
    check_grids(9);
    // Few enough to be inserted one by one.
    check_grids(5);

    // Rotated: rounding makes some points of the faces extreme; facets are seen as six all the same.
    uint64_t s = 3;
    for (int i = 0; i < 10; i++) {
        size_t n = put_grid_box((vec3){2, 3, 5}, 8);
        rotate_cloud(n, random_rotation(&s));
        hull h = check_hull(cloud, n);
        CHECK_EQ(h.rank, 3);
        CHECK_EQ(h.facet_count, 6);
        hull_destroy(&h, &allocator);
    }
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
        ovoid_code code = hull_create((xyz_points){cloud, n}, &allocator, &h, NULL);
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

// The base of a turned cone: 5000 corners of one plane, rounded, in a few thousand slivers. The plane of their summed
// areas is off by what the corners are, a rounding, and not by thousands of roundings of the sum.
static void check_round_face(void) {
    uint64_t s = 91;
    for (int i = 0; i < 12; i++) {
        check_seed = s;
        for (int k = 0; k < 5000; k++) put((size_t)k, (vec3){cos(k * 1e-3), sin(k * 1e-3), 0});
        put(5000, (vec3){0, 0, 2});
        rotate_cloud(5001, random_rotation(&s));
        hull h;
        if (!CHECK_EQ(hull_create((xyz_points){cloud, 5001}, &allocator, &h, NULL), OVOID_OK)) continue;
        double off = 0, flatness = FLATNESS * compute_extent_of(&h);
        for (uint32_t t = 0; t < h.triangle_count; t++)
            for (int k = 0; k < 3; k++) {
                ovoid_plane plane = h.planes[h.triangle_facets[t]];
                off = fmax(off, plane.offset - vec3_dot(plane.normal, vec3_at(h.vertices, h.triangles[3 * t + k])));
            }
        CHECK_LE(off, flatness / 8);
        hull_destroy(&h, &allocator);
    }
    check_seed = 0;
}

// The surface of the cloud beside its points: every extreme one, none inside, and the simplex that simplex_find names.
static void check_states(size_t count, size_t extreme) {
    points p;
    surface s, first = {0};
    if (!CHECK_EQ(points_create((xyz_points){cloud, count}, &allocator, &p, NULL), OVOID_OK)) return;
    if (CHECK_EQ(quickhull_create(&p, &allocator, &s, NULL), OVOID_OK)) {
        size_t found = 0;
        for (uint32_t i = 0; i < p.count; i++) found += s.state[i] == POINT_EXTREME && p.source[i] % 3 != 0;
        CHECK_EQ(found, extreme);
        simplex_find(&p, &first);
        CHECK_EQ(memcmp(first.corner, s.corner, sizeof s.corner), 0);
        for (size_t i = 0; i < 3 * (size_t)s.triangle_count; i++) CHECK(s.state[s.triangles[i]] == POINT_EXTREME);
        surface_destroy(&s, &allocator);
    }
    points_destroy(&p, &allocator);
}

// The edge back of each edge of a surface begins where that ends; the corner beyond is the third one of its triangle.
// Returns 0 where one is not, since facets that are found by such a corner need not come to an end.
static int check_beyond(size_t count) {
    uint64_t seed = 78;
    size_t n = put_sphere(&seed, count, 1);
    points p;
    surface s;
    int is_right = 0;
    if (!CHECK_EQ(points_create((xyz_points){cloud, n}, &allocator, &p, NULL), OVOID_OK)) return 0;
    if (CHECK_EQ(quickhull_create(&p, &allocator, &s, NULL), OVOID_OK)) {
        is_right = 1;
        for (uint32_t i = 0; i < 3 * s.triangle_count; i++) {
            uint32_t across = surface_get_across(&s, i / 3, i % 3), back = s.across[i] % 4;
            if (!CHECK(across < s.triangle_count && back < 3)) return 0;
            const uint32_t *t = s.triangles + i / 3 * 3, *other = s.triangles + 3 * (size_t)across;
            uint32_t from = t[i % 3], to = t[(i + 1) % 3], sum = other[0] + other[1] + other[2];
            is_right &= CHECK_EQ(other[back], to) & CHECK_EQ(other[(back + 1) % 3], from);
            is_right &= CHECK_EQ(surface_get_beyond(&s, i / 3, i % 3), sum - from - to);
        }
        surface_destroy(&s, &allocator);
    }
    points_destroy(&p, &allocator);
    return is_right;
}

// So many points that they are put along a curve: they come out in the order given, and what was asked of few is so of
// them. Every third is inside.
static void check_many(void) {
    uint64_t s = 77;
    size_t n = put_sphere(&s, 4500, 1), at = 0;
    for (size_t k = 0; k < n; k += 3) put(k, vec3_scale(vec3_at(cloud, k), 0.5));
    hull h = check_hull(cloud, n);
    CHECK_EQ(h.vertex_count, 3000);
    for (uint32_t i = 0; i < h.vertex_count; i++) {
        at += at % 3 == 0;
        CHECK_EQ(memcmp(h.vertices + 3 * (size_t)i, cloud + 3 * at++, 3 * sizeof *cloud), 0);
    }
    hull_destroy(&h, &allocator);
    check_states(n, 3000);
    check_states(90, 60);

    n = put_grid_box((vec3){2, 3, 5}, 21);
    h = check_hull(cloud, n);
    CHECK_EQ(h.vertex_count, 8);
    CHECK_EQ(h.facet_count, 6);
    CHECK_EQ(h.report.coplanar, n - 8);
    hull_destroy(&h, &allocator);
}

// Facets are numbered by their largest triangles, the largest first: of few triangles and of many, which are sorted in
// different ways.
static void check_order(void) {
    uint64_t s = 57;
    for (int n = 20; n <= 2000; n *= 10) {
        hull h = check_hull(cloud, put_sphere(&s, (size_t)n, 1));
        double *largest = calloc(h.facet_count, sizeof *largest);
        for (uint32_t t = 0; t < h.triangle_count; t++) {
            const uint32_t *c = h.triangles + 3 * t;
            vec3 a = vec3_at(h.vertices, c[0]), b = vec3_at(h.vertices, c[1]), d = vec3_at(h.vertices, c[2]);
            double area = vec3_norm(vec3_cross(vec3_sub(b, a), vec3_sub(d, a)));
            largest[h.triangle_facets[t]] = fmax(largest[h.triangle_facets[t]], area);
        }
        int descending = 1;
        for (uint32_t f = 1; f < h.facet_count; f++) descending &= largest[f] <= largest[f - 1] * (1 + 1e-12) + 1e-15;
        CHECK(descending);
        free(largest);
        hull_destroy(&h, &allocator);
    }
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
        size_t n = i % 4 < 2 ? 30 : 200;
        for (size_t k = 0; k < n; k++) {
            vec3 v = {1, 1, 1};
            double *c = &v.x;
            for (int a = 0; a < 3; a++) {
                for (uint64_t m = random_next(&s) % 4; m > 0; m--) c[a] = nextafter(c[a], 2);
                if (i % 2 && random_next(&s) % 3 == 0) c[a] = ldexp(1, -(int)(random_next(&s) % 1074));
            }
            put(k, v);
        }
        hull h;
        ovoid_code code = hull_create((xyz_points){cloud, n}, &allocator, &h, NULL);
        CHECK_EQ(code, OVOID_OK);
        check_counts(&h, cloud, n);
        check_adjacency(&h);
        check_planes(&h);
        hull_destroy(&h, &allocator);
    }
    check_seed = 0;
}

// A coordinate: small integers, plain or made hard. Exact coincidences of all kinds come up all the time.
static double make_coordinate(int kind, int axis, uint64_t *s) {
    double v = (double)(random_next(s) % 7) - 3;
    switch (kind) {
    case 0: return v;
    case 1: return v * 0.1 + (axis == 0 ? 1e3 : 0);
    case 2: return ldexp(v, -(int)(random_next(s) % 60));
    case 3: return v * (axis == 2 ? 1e-15 : 1);
    case 4: return v / 3;
    case 5: return v == 0 ? 0 : nextafter(v, (double)(random_next(s) % 3) - 1);
    case 6: return v * pow(10, -8 * (int)(random_next(s) % 3));
    default: return ldexp(v, (int)(random_next(s) % 160) - 80);
    }
}

// Thousands of small bodies of every rank and degeneracy; of each ninth there are more points than the incremental hull
// takes, until the extreme ones are left.
static void check_lattices(void) {
    uint64_t s = 100;
    for (int i = 0; i < 4000; i++) {
        check_seed = s;
        size_t n = i % 9 ? 1 + random_next(&s) % 40 : 2 * INCREMENTAL_MOST;
        int kind = i % 8;
        for (size_t k = 0; k < n; k++) {
            double x = make_coordinate(kind, 0, &s), y = make_coordinate(kind, 1, &s);
            put(k, (vec3){x, y, make_coordinate(kind, 2, &s)});
        }
        if (kind == 4) rotate_cloud(n, random_rotation(&s));
        hull h = check_hull(cloud, n);
        hull_destroy(&h, &allocator);
    }
    check_seed = 0;
}

// ---- trouble ----

// A solid, a flat one, the same turned, a line; a solid of many points, of few.
static void check_memory(void) {
    uint64_t s = 6;
    static const size_t counts[] = {400, 400, 400, 400, 2100, 60};
    for (int kind = 0; kind < 6; kind++) {
        size_t n = put_sphere(&s, counts[kind], 1);
        for (size_t i = 0; i < n; i++) {
            vec3 v = vec3_at(cloud, i);
            put(i, vec3_scale((vec3){v.x, kind != 3 ? v.y : 0, kind % 4 < 2 && kind != 1 ? v.z : 0}, i % 2 ? 1 : 0.3));
        }
        if (kind == 2) rotate_cloud(n, random_rotation(&s));
        ovoid_code code = OVOID_ERROR_MEMORY;
        for (long k = 0; code; k++) {
            countdown c = {k, 0};
            ovoid_allocator counted = countdown_make_allocator(&c);
            hull h;
            code = hull_create((xyz_points){cloud, n}, &counted, &h, NULL);
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
    code = hull_create((xyz_points){cloud, 0}, &allocator, &h, &error);
    CHECK_EQ(code, OVOID_ERROR_EMPTY);
    code = hull_create((xyz_points){cloud, POINTS_MAX + 1}, &allocator, &h, &error);
    CHECK_EQ(code, OVOID_ERROR_LIMIT);
    cloud[3 * 7 + 1] = NAN;
    code = hull_create((xyz_points){cloud, 10}, &allocator, &h, &error);
    CHECK_EQ(code, OVOID_ERROR_NOT_FINITE);
    CHECK_EQ(error.place, 7);
    cloud[3 * 7 + 1] = -INFINITY;
    code = hull_create((xyz_points){cloud, 10}, &allocator, &h, &error);
    CHECK_EQ(code, OVOID_ERROR_NOT_FINITE);
    cloud[3 * 7 + 1] = -1.1e50;
    code = hull_create((xyz_points){cloud, 10}, &allocator, &h, &error);
    CHECK_EQ(code, OVOID_ERROR_RANGE);
    CHECK_EQ(error.place, 7);
}

int main(void) {
    allocator = allocator_make(NULL);
    // The triangles of 600 points are numbered along a walk.
    if (!check_beyond(100) || !check_beyond(200) || !check_beyond(600)) return check_end();
    check_boxes();
    check_scales();
    check_far();
    check_hard();
    check_round_face();
    check_many();
    check_order();
    check_flat();
    check_tiny_differences();
    check_lattices();
    check_memory();
    check_errors();
    uint64_t s = 2;
    hull h = check_hull(cloud, put_sphere(&s, 5000, 1e9));
    CHECK_EQ(h.vertex_count, 5000);
    hull_destroy(&h, &allocator);
    return check_end();
}
