// Shapes: what is made from points, faces and primitives, what is refused and with which words, and that no failing
// allocation leaks. Truths are closed forms, exact arithmetic (ellipsoid_is_enclosing and ellipsoid_is_enclosed, tested
// by themselves) and counts known from how the input was made.
#include "check.h"
#include "countdown.h"
#include "ellipsoid/contain.h"
#include "linear/exact.h"
#include "linear/rotation.h"
#include "shape/block.h"
#include "shape/loops.h"

static double cloud[3 * 20000];

static void put(size_t i, vec3 v) {
    cloud[3 * i] = v.x;
    cloud[3 * i + 1] = v.y;
    cloud[3 * i + 2] = v.z;
}

// No vertex is farther from the point than the radius, in exact squares.
static int is_within(const ovoid_shape *s, vec3 center, double radius) {
    for (uint32_t i = 0; i < s->vertex_count; i++) {
        vec3 p = vec3_at(shape_vertices(s), i);
        dd x = two_sum(p.x, -center.x), y = two_sum(p.y, -center.y), z = two_sum(p.z, -center.z);
        dd d = dd_add(dd_add(dd_mul(x, x), dd_mul(y, y)), dd_mul(z, z));
        if (dd_sub(d, two_product(radius, radius)).high > 0) return 0;
    }
    return 1;
}

// What holds of every shape.
static void check_shape(const ovoid_shape *s) {
    if (!CHECK(s != NULL)) return;
    CHECK_EQ((uintptr_t)s % 64, 0);
    CHECK_EQ(s->padded_count % 8, 0);
    CHECK(s->padded_count >= s->vertex_count && s->padded_count < s->vertex_count + 8);
    CHECK_EQ((s->at.x | s->at.y | s->at.z | s->at.vertices | s->at.planes | s->at.triangles | s->at.neighbors) % 64, 0);
    int same = 1;
    for (uint32_t i = 0; i < s->padded_count; i++) {
        vec3 v = vec3_at(shape_vertices(s), i < s->vertex_count ? i : 0);
        same &= shape_x(s)[i] == v.x && shape_y(s)[i] == v.y && shape_z(s)[i] == v.z;
    }
    CHECK(same);
    CHECK(is_within(s, s->center, s->reach));
    CHECK(is_within(s, (vec3){0, 0, 0}, s->extent));
    ovoid_polytope p = ovoid_shape_get_polytope(s);
    ovoid_fit outer = ovoid_shape_get_outer(s), inner = ovoid_shape_get_inner(s);
    CHECK(ellipsoid_is_enclosing(&p, &outer.ellipsoid));
    if (s->rank == 3) CHECK(ellipsoid_is_enclosed(&p, &inner.ellipsoid));
    CHECK_LE(inner.volume, outer.volume);
    ovoid_report r = ovoid_shape_get_report(s);
    CHECK_EQ(r.points, r.vertices + r.duplicates + r.interior);
    CHECK_EQ(r.vertices, p.vertex_count);
    CHECK_EQ(r.rank, p.rank);
}

// ---- primitives ----

static void check_box(void) {
    ovoid_shape *s = ovoid_shape_create_box((vec3){1, 2, 3}, NULL, NULL);
    check_shape(s);
    ovoid_measures m = ovoid_shape_get_measures(s);
    CHECK_EQ(m.volume, 48);
    CHECK_EQ(m.area, 88);
    CHECK_EQ(ovoid_shape_get_polytope(s).facet_count, 6);
    // Volumes of the ellipsoids of a box: the inscribed one has the half sizes as radii, the enclosing one sqrt(3)
    // times.
    double unit = 4 * 3.141592653589793 / 3 * 6;
    CHECK_NEAR(ovoid_shape_get_inner(s).volume, unit, 2e-6 * unit);
    CHECK_NEAR(ovoid_shape_get_outer(s).volume, unit * sqrt(27), 2e-6 * unit * sqrt(27));
    CHECK_NEAR(s->reach, sqrt(14), 1e-14);
    ovoid_shape_destroy(s);

    ovoid_shape_options o = {.radius = 0.25, .inner = OVOID_INNER_PHASES};
    s = ovoid_shape_create_box((vec3){1, 2, 0}, &o, NULL);
    check_shape(s);
    CHECK_EQ(s->rank, 2);
    CHECK_EQ(ovoid_shape_get_radius(s), 0.25);
    ovoid_shape_destroy(s);
}

static void check_round(void) {
    ovoid_shape *s = ovoid_shape_create_sphere(2, NULL, NULL);
    check_shape(s);
    CHECK_EQ(s->rank, 0);
    CHECK_EQ(s->radius, 2);
    CHECK_EQ(s->reach, 0);
    ovoid_shape_destroy(s);
    ovoid_shape_options o = {.radius = 0.5};
    s = ovoid_shape_create_capsule(1, 3, &o, NULL);
    check_shape(s);
    CHECK_EQ(s->rank, 1);
    CHECK_EQ(s->vertex_count, 2);
    CHECK_EQ(s->radius, 1.5);
    CHECK_NEAR(s->reach, 3, 1e-15 * 3);
    ovoid_shape_destroy(s);
    s = ovoid_shape_create_capsule(1, 0, NULL, NULL);
    CHECK_EQ(s->rank, 0);
    ovoid_shape_destroy(s);
}

static void check_turned(void) {
    for (uint32_t n = 3; n < 70; n = n * 3 / 2 + 1) {
        double area = n * sin(6.283185307179586 / n) / 2 * 4;
        ovoid_shape *s = ovoid_shape_create_prism(&(ovoid_prism){2, 5, n}, NULL, NULL);
        check_shape(s);
        CHECK_EQ(s->vertex_count, 2 * n);
        CHECK_EQ(ovoid_shape_get_polytope(s).facet_count, n + 2);
        CHECK_NEAR(s->measures.volume, area * 10, 1e-13 * area);
        ovoid_shape_destroy(s);
        s = ovoid_shape_create_pyramid(&(ovoid_prism){2, 5, n}, NULL, NULL);
        check_shape(s);
        CHECK_EQ(s->vertex_count, n + 1);
        CHECK_NEAR(s->measures.volume, area * 10 / 3, 1e-13 * area);
        ovoid_shape_destroy(s);
    }
}

// ---- refusals ----

static void check_refused(const ovoid_shape *s, const ovoid_error *e, ovoid_code code, const char *word) {
    CHECK(s == NULL);
    if (!CHECK_EQ(e->code, code) || !CHECK(strstr(e->message, word) != NULL)) printf("    %s\n", e->message);
}

static void check_options(void) {
    ovoid_error e;
    ovoid_shape_options o = {.radius = -1};
    check_refused(ovoid_shape_create_box((vec3){1, 1, 1}, &o, &e), &e, OVOID_ERROR_RADIUS, "negative");
    o.radius = NAN;
    check_refused(ovoid_shape_create_box((vec3){1, 1, 1}, &o, &e), &e, OVOID_ERROR_NOT_FINITE, "radius");
    o.radius = 2 * OVOID_LENGTH_MAX;
    check_refused(ovoid_shape_create_box((vec3){1, 1, 1}, &o, &e), &e, OVOID_ERROR_RANGE, "radius");
    o = (ovoid_shape_options){.gap = -1};
    check_refused(ovoid_shape_create_box((vec3){1, 1, 1}, &o, &e), &e, OVOID_ERROR_ARGUMENT, "gap");
    check_refused(ovoid_shape_create_box((vec3){1, -1, 1}, NULL, &e), &e, OVOID_ERROR_ARGUMENT, "negative");
    check_refused(ovoid_shape_create_box((vec3){1, 1, INFINITY}, NULL, &e), &e, OVOID_ERROR_NOT_FINITE, "finite");
    check_refused(ovoid_shape_create_box((vec3){1, 1, 1e51}, NULL, &e), &e, OVOID_ERROR_RANGE, "point");
    check_refused(ovoid_shape_create_sphere(-1, NULL, &e), &e, OVOID_ERROR_RADIUS, "negative");
    check_refused(ovoid_shape_create_sphere(NAN, NULL, &e), &e, OVOID_ERROR_NOT_FINITE, "radius");
    check_refused(ovoid_shape_create_cylinder(-1, 1, NULL, &e), &e, OVOID_ERROR_RADIUS, "negative");
    check_refused(ovoid_shape_create_pyramid(&(ovoid_prism){-1, 1, 5}, NULL, &e), &e, OVOID_ERROR_RADIUS, "negative");
    check_refused(ovoid_shape_create_capsule(1, NAN, NULL, &e), &e, OVOID_ERROR_NOT_FINITE, "half length");
    check_refused(ovoid_shape_create_pyramid(&(ovoid_prism){1, 1, 2}, NULL, &e), &e, OVOID_ERROR_ARGUMENT, "sides");
    check_refused(ovoid_shape_create_prism(&(ovoid_prism){1, 1, UINT32_MAX}, NULL, &e), &e, OVOID_ERROR_LIMIT, "sides");
    o = (ovoid_shape_options){.radius = -1};
    check_refused(ovoid_shape_create_sphere(2, &o, &e), &e, OVOID_ERROR_RADIUS, "negative");
    check_refused(ovoid_shape_create_from_points(NULL, 0, NULL, &e), &e, OVOID_ERROR_EMPTY, "points");
    check_refused(ovoid_shape_create_from_points(NULL, 5, NULL, &e), &e, OVOID_ERROR_ARGUMENT, "NULL");
    double bad[6] = {0, 0, 0, 0, NAN, 0};
    check_refused(ovoid_shape_create_from_points(bad, 2, NULL, &e), &e, OVOID_ERROR_NOT_FINITE, "point 1");
    CHECK_EQ(e.place, 1);
    // Without an error to fill.
    CHECK(ovoid_shape_create_from_points(bad, 2, NULL, NULL) == NULL);
}

// ---- faces ----

static const double cube[24] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
static const uint32_t cube_indices[24] = {0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 2, 3, 7, 6, 0, 4, 7, 3, 1, 2, 6, 5};
static const uint32_t fours[6] = {4, 4, 4, 4, 4, 4};

static void check_cube_faces(void) {
    ovoid_error e;
    ovoid_faces f = {cube, 8, cube_indices, fours, 6};
    ovoid_shape *s = ovoid_shape_create_from_faces(&f, NULL, &e);
    check_shape(s);
    CHECK_EQ(s->vertex_count, 8);
    CHECK_EQ(s->report.faces, 6);
    ovoid_shape_destroy(s);

    // Open, index out of range, two corners, inside out, twice, a point outside, a point inside.
    f.face_count = 5;
    check_refused(ovoid_shape_create_from_faces(&f, NULL, &e), &e, OVOID_ERROR_NOT_CONVEX, "open");
    f.face_count = 6;
    uint32_t indices[24];
    memcpy(indices, cube_indices, sizeof indices);
    f.indices = indices;
    indices[13] = 8;
    check_refused(ovoid_shape_create_from_faces(&f, NULL, &e), &e, OVOID_ERROR_INDEX, "vertex 8 of 8");
    CHECK_EQ(e.place, 3);
    for (int i = 0; i < 24; i++) indices[i] = cube_indices[23 - i];
    check_refused(ovoid_shape_create_from_faces(&f, NULL, &e), &e, OVOID_ERROR_NOT_CONVEX, "inside out");
    for (int i = 0; i < 24; i++) indices[i] = cube_indices[i % 4];
    check_refused(ovoid_shape_create_from_faces(&f, NULL, &e), &e, OVOID_ERROR_NOT_CONVEX, "same direction");
    memcpy(indices, cube_indices, sizeof indices);
    indices[5] = 4;
    check_refused(ovoid_shape_create_from_faces(&f, NULL, &e), &e, OVOID_ERROR_NOT_CONVEX, "twice");
    memcpy(indices, cube_indices, sizeof indices);
    uint32_t sizes[6] = {4, 4, 2, 4, 4, 4};
    f.sizes = sizes;
    check_refused(ovoid_shape_create_from_faces(&f, NULL, &e), &e, OVOID_ERROR_NOT_CONVEX, "at least 3");
    CHECK_EQ(e.place, 2);
    f.sizes = fours;
    double more[27] = {0};
    memcpy(more, cube, sizeof cube);
    more[24] = more[25] = 0.5;
    more[26] = 1 + 1e-9;
    f.vertices = more;
    f.vertex_count = 9;
    check_refused(ovoid_shape_create_from_faces(&f, NULL, &e), &e, OVOID_ERROR_NOT_CONVEX, "above its plane");
    CHECK_EQ(e.place, 1);
    more[26] = 0.5;
    s = ovoid_shape_create_from_faces(&f, NULL, &e);
    check_shape(s);
    CHECK_EQ(s->report.interior, 1);
    ovoid_shape_destroy(s);
    more[26] = NAN;
    check_refused(ovoid_shape_create_from_faces(&f, NULL, &e), &e, OVOID_ERROR_NOT_FINITE, "point 8");
    f.face_count = 0;
    check_refused(ovoid_shape_create_from_faces(&f, NULL, &e), &e, OVOID_ERROR_EMPTY, "faces");
    check_refused(ovoid_shape_create_from_faces(NULL, NULL, &e), &e, OVOID_ERROR_ARGUMENT, "NULL");
}

// The hull of random points gives triangles that are convex; a vertex moved inward past its neighbors makes a dent. At
// every size and place; equal points that are not the same vertex are one.
static void check_random_faces(void) {
    static const double sizes[] = {1e-100, 1e-9, 1, 1e40};
    uint64_t s = 12;
    for (int i = 0; i < 40; i++) {
        check_seed = s;
        size_t n = 20 + random_next(&s) % 200;
        vec3 away = {i % 3 == 0 ? 1e5 : 0, 0, 0};
        for (size_t k = 0; k < n; k++)
            put(k,
                vec3_scale(vec3_add(vec3_unit((vec3){random_normal(&s), random_normal(&s), random_normal(&s)}), away),
                           sizes[i % 4]));
        ovoid_shape *a = ovoid_shape_create_from_points(cloud, n, NULL, NULL);
        ovoid_polytope p = ovoid_shape_get_polytope(a);
        uint32_t *sizes3 = malloc(p.triangle_count * sizeof *sizes3), *soup = malloc(p.triangle_count * 12);
        for (uint32_t t = 0; t < p.triangle_count; t++) sizes3[t] = 3;
        double *vertices = malloc(p.vertex_count * 24), *corners = malloc(p.triangle_count * 72);
        memcpy(vertices, p.vertices, p.vertex_count * 24);
        for (uint32_t k = 0; k < 3 * p.triangle_count; k++) {
            soup[k] = k;
            memcpy(corners + 3 * k, vertices + 3 * p.triangles[k], 24);
        }
        ovoid_error e = {0};
        ovoid_faces f = {vertices, p.vertex_count, p.triangles, sizes3, p.triangle_count};
        ovoid_shape *b = ovoid_shape_create_from_faces(&f, NULL, &e);
        if (!CHECK(b != NULL)) printf("    %s\n", e.message);
        CHECK(b && b->vertex_count == p.vertex_count);
        ovoid_shape_destroy(b);
        f = (ovoid_faces){corners, 3 * p.triangle_count, soup, sizes3, p.triangle_count};
        b = ovoid_shape_create_from_faces(&f, NULL, &e);
        CHECK(b && b->vertex_count == p.vertex_count);
        ovoid_shape_destroy(b);

        f = (ovoid_faces){vertices, p.vertex_count, p.triangles, sizes3, p.triangle_count};
        vec3 center = a->center, dented = vec3_at(vertices, 0);
        dented = vec3_add_scaled(center, vec3_sub(dented, center), 0.5);
        memcpy(vertices, &dented, sizeof dented);
        check_refused(ovoid_shape_create_from_faces(&f, NULL, &e), &e, OVOID_ERROR_NOT_CONVEX, "above its plane");
        free(sizes3);
        free(soup);
        free(vertices);
        free(corners);
        ovoid_shape_destroy(a);
    }
    check_seed = 0;
}

// Rounded to a float; volatile, as GCC 12 at -O2 leaves the rounding out of pairs of doubles.
static double to_float(double v) {
    volatile float f = (float)v;
    return f;
}

// Polygons whose corners were rounded to floats are flat to about 1e-7, and so convex only to that.
static void check_float_faces(void) {
    uint64_t s = 19;
    for (int i = 0; i < 50; i++) {
        mat3 r = quat_to_mat3((ovoid_quat){random_normal(&s), random_normal(&s), random_normal(&s), random_normal(&s)});
        enum { SIDES = 24 };
        uint32_t indices[6 * SIDES], sizes[SIDES + 2], n = 0;
        for (uint32_t k = 0; k < SIDES; k++) {
            double a = 6.283185307179586 * k / SIDES;
            for (uint32_t top = 0; top < 2; top++) {
                vec3 v = mat3_mul_vec3(r, (vec3){cos(a), sin(a), top ? 1 : -1});
                put(2 * k + top, (vec3){to_float(v.x), to_float(v.y), to_float(v.z)});
            }
        }
        for (uint32_t k = 0; k < SIDES; k++) {
            uint32_t next = (k + 1) % SIDES, quad[4] = {2 * k, 2 * next, 2 * next + 1, 2 * k + 1};
            memcpy(indices + n, quad, sizeof quad);
            n += 4;
            sizes[k] = 4;
        }
        for (uint32_t k = 0; k < SIDES; k++) indices[n++] = 2 * k + 1;
        for (uint32_t k = 0; k < SIDES; k++) indices[n++] = 2 * (SIDES - 1 - k);
        sizes[SIDES] = sizes[SIDES + 1] = SIDES;
        ovoid_error e = {0};
        ovoid_faces f = {cloud, 2 * SIDES, indices, sizes, SIDES + 2};
        ovoid_shape *shape = ovoid_shape_create_from_faces(&f, NULL, &e);
        if (!CHECK(shape != NULL)) printf("    %s\n", e.message);
        ovoid_shape_destroy(shape);
    }
    // Both sides of a flat polygon are a closed surface; one side is open.
    static const double square[12] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    static const uint32_t both[8] = {0, 1, 2, 3, 3, 2, 1, 0};
    ovoid_faces f = {square, 4, both, fours, 2};
    ovoid_shape *shape = ovoid_shape_create_from_faces(&f, NULL, NULL);
    check_shape(shape);
    CHECK_EQ(shape->rank, 2);
    ovoid_shape_destroy(shape);
}

// ---- copies, memory ----

static ovoid_shape *make(int kind, const ovoid_shape_options *o, ovoid_error *e) {
    ovoid_faces f = {cube, 8, cube_indices, fours, 6};
    switch (kind) {
    case 0: return ovoid_shape_create_box((vec3){1, 2, 3}, o, e);
    case 1: return ovoid_shape_create_box((vec3){1, 2, 0}, o, e);
    case 2: return ovoid_shape_create_sphere(1, o, e);
    case 3: return ovoid_shape_create_capsule(1, 1, o, e);
    case 4: return ovoid_shape_create_prism(&(ovoid_prism){1, 1, 40}, o, e);
    case 5: return ovoid_shape_create_pyramid(&(ovoid_prism){1, 1, 5}, o, e);
    case 6: return ovoid_shape_create_from_points(cloud, 300, o, e);
    default: return ovoid_shape_create_from_faces(&f, o, e);
    }
}

static void check_memory(void) {
    uint64_t s = 2;
    for (size_t i = 0; i < 300; i++) put(i, (vec3){random_normal(&s), random_normal(&s), random_normal(&s)});
    for (int kind = 0; kind < 8; kind++)
        for (int method = 0; method < 2; method++) {
            ovoid_shape *shape = NULL;
            for (long k = 0; !shape; k++) {
                countdown c = {k, 0};
                ovoid_allocator counted = countdown_make_allocator(&c);
                ovoid_shape_options o = {.allocator = &counted, .inner = (ovoid_inner_method)method};
                ovoid_error e = {0};
                shape = make(kind, &o, &e);
                if (!shape) CHECK_EQ(e.code, OVOID_ERROR_MEMORY);
                // One block is all that a shape is.
                CHECK_EQ(c.held, shape ? 1 : 0);
                if (!shape) continue;
                check_shape(shape);
                ovoid_shape *copy = ovoid_shape_create_copy(shape, NULL, &e);
                check_shape(copy);
                CHECK_EQ(ovoid_shape_get_size(copy), ovoid_shape_get_size(shape));
                ovoid_shape_destroy(shape);
                CHECK_EQ(c.held, 0);
                CHECK_EQ(copy->rank, ovoid_shape_get_polytope(copy).rank);
                ovoid_shape_destroy(copy);
            }
        }
    countdown none = {0, 0};
    ovoid_allocator counted = countdown_make_allocator(&none);
    ovoid_shape *shape = make(0, NULL, NULL);
    ovoid_error e;
    check_refused(ovoid_shape_create_copy(shape, &(ovoid_shape_options){.allocator = &counted}, &e), &e,
                  OVOID_ERROR_MEMORY, "memory");
    ovoid_shape_destroy(shape);
    ovoid_shape_destroy(NULL);
}

// Hard bodies: every one becomes a shape that holds what check_shape asks for.
static void check_hard(void) {
    uint64_t s = 33;
    static const double stretch[][3] = {{1, 1, 1},     {1, 1, 1e-6},  {1, 1e-6, 1e-6},  {1, 1e-3, 1e-9},
                                        {1, 1, 1e-13}, {1, 1, 1e-16}, {1, 1e-16, 1e-16}};
    static const double sizes[] = {1e-120, 1e-9, 1, 1e9, 1e40};
    for (size_t i = 0; i < sizeof stretch / sizeof *stretch; i++)
        for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++)
            for (int turned = 0; turned < 3; turned++) {
                check_seed = s;
                mat3 r = quat_to_mat3(
                    (ovoid_quat){random_normal(&s), random_normal(&s), random_normal(&s), random_normal(&s)});
                vec3 away = {turned == 2 ? 1e7 : 0, 0, 0};
                for (size_t j = 0; j < 60; j++) {
                    vec3 v = {random_normal(&s) * stretch[i][0], random_normal(&s) * stretch[i][1],
                              random_normal(&s) * stretch[i][2]};
                    if (turned) v = mat3_mul_vec3(r, v);
                    put(j, vec3_scale(vec3_add(v, away), sizes[k]));
                }
                ovoid_error e = {0};
                ovoid_shape *shape = ovoid_shape_create_from_points(cloud, 60, NULL, &e);
                if (!CHECK(shape != NULL)) printf("    %s\n", e.message);
                check_shape(shape);
                ovoid_shape_destroy(shape);
            }
    check_seed = 0;
}

// A vertex that is off a segment by less than rounding is kept, whatever its place in the array; the ends are the ends.
static void check_nearly_straight(void) {
    const double point[3][3] = {{0, 0, 0}, {1, 1e-20, 0}, {39, 0, 0}};
    static const int order[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    for (int i = 0; i < 6; i++) {
        for (int k = 0; k < 3; k++) put((size_t)k, vec3_at(point[order[i][k]], 0));
        ovoid_shape *s = ovoid_shape_create_from_points(cloud, 3, NULL, NULL);
        check_shape(s);
        ovoid_fit inner = ovoid_shape_get_inner(s);
        ovoid_measures m = ovoid_shape_get_measures(s);
        CHECK(s->rank == 1 && s->vertex_count == 3);
        CHECK_NEAR(m.centroid.x, 19.5, 1e-14);
        CHECK(inner.volume == 39 && inner.ellipsoid.center.x == 19.5 && inner.ellipsoid.q.xx == 19.5 * 19.5);
        ovoid_shape_destroy(s);
    }
}

// The loop of each facet names its edges from the lower vertex, and begins with the directed edge of the lowest number.
static void check_loops(void) {
    uint64_t seed = 57;
    for (uint32_t count = 8; count < 60; count += 3) {
        double xyz[3 * 60];
        for (uint32_t i = 0; i < 3 * count; i++)
            xyz[i] = count % 2 ? random_normal(&seed) : (double)(random_next(&seed) % 4);
        ovoid_shape *s = ovoid_shape_create_from_points(xyz, count, NULL, NULL);
        if (!CHECK(s && s->rank == 3)) continue;
        const uint32_t *starts = shape_loop_starts(s), *edges = shape_loop_edges(s);
        for (uint32_t f = 0; f < s->counts.facets; f++) {
            const uint32_t *corners = shape_loop_vertices(s) + starts[f], size = starts[f + 1] - starts[f];
            uint32_t first = shape_find_edge(s, corners[0], corners[1]);
            CHECK(size >= 3);
            for (uint32_t i = 0; i < size; i++) {
                uint32_t a = corners[i], b = corners[(i + 1) % size];
                CHECK_EQ(edges[starts[f] + i], shape_find_edge(s, a < b ? a : b, a < b ? b : a));
                CHECK_LE(first, shape_find_edge(s, a, b));
            }
        }
        ovoid_shape_destroy(s);
    }
}

int main(void) {
    check_loops();
    check_box();
    check_round();
    check_turned();
    check_options();
    check_cube_faces();
    check_random_faces();
    check_float_faces();
    check_memory();
    check_hard();
    check_nearly_straight();
    return check_end();
}
