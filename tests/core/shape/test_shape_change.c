// Deformed and divided shapes. Truth: a deformed shape is, to its ellipsoids' gaps, the shape made afresh, and its hull
// is that one bit for bit; the parts of a divided one have its volume, lie on their sides of the plane (to 8 roundings
// of the size, which the cut points have), and hold every vertex of their side.
#include "check.h"
#include "countdown.h"
#include "ellipsoid/contain.h"
#include "ovoid/ovoid.h"

#include <time.h>

static void fill(double *xyz, int count, uint64_t *s, ovoid_vec3 size, ovoid_vec3 center) {
    for (int i = 0; i < count; i++) {
        double x = random_normal(s), y = random_normal(s), z = random_normal(s), r = sqrt(x * x + y * y + z * z);
        xyz[3 * i] = center.x + size.x * x / r;
        xyz[3 * i + 1] = center.y + size.y * y / r;
        xyz[3 * i + 2] = center.z + size.z * z / r;
    }
}

static void check_proven(const ovoid_shape *s) {
    ovoid_polytope p = ovoid_shape_get_polytope(s);
    ovoid_ellipsoid outer = ovoid_shape_get_outer(s).ellipsoid, inner = ovoid_shape_get_inner(s).ellipsoid;
    CHECK(ellipsoid_is_enclosing(&p, &outer));
    if (p.rank == 3) CHECK(ellipsoid_is_enclosed(&p, &inner));
    CHECK(ovoid_shape_get_outer(s).converged && ovoid_shape_get_inner(s).converged);
}

static void check_deformed(int count, ovoid_vec3 size, ovoid_vec3 center, double amount, uint64_t seed) {
    uint64_t s = check_seed = seed;
    double *xyz = malloc(sizeof *xyz * 3 * (size_t)count);
    fill(xyz, count, &s, size, center);
    ovoid_shape *shape = ovoid_shape_create_from_points(xyz, (size_t)count, NULL, NULL);
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    for (uint32_t i = 0; i < p.vertex_count; i++) {
        xyz[3 * i] = p.vertices[3 * i] + p.origin.x + amount * size.x * random_normal(&s);
        xyz[3 * i + 1] = p.vertices[3 * i + 1] + p.origin.y + amount * size.y * random_normal(&s);
        xyz[3 * i + 2] = p.vertices[3 * i + 2] + p.origin.z + amount * size.z * random_normal(&s);
    }
    ovoid_shape *warm = ovoid_shape_create_deformed(shape, xyz, NULL, NULL);
    ovoid_shape *cold = ovoid_shape_create_from_points(xyz, p.vertex_count, NULL, NULL);
    ovoid_polytope a = ovoid_shape_get_polytope(warm), b = ovoid_shape_get_polytope(cold);
    CHECK(a.vertex_count == b.vertex_count && a.triangle_count == b.triangle_count);
    CHECK(memcmp(a.vertices, b.vertices, sizeof(double) * 3 * a.vertex_count) == 0);
    CHECK(memcmp(a.triangles, b.triangles, sizeof(uint32_t) * 3 * a.triangle_count) == 0);
    check_proven(warm);
    // Both are within their gaps of the one optimum.
    CHECK_NEAR(ovoid_shape_get_outer(warm).volume / ovoid_shape_get_outer(cold).volume, 1, 1.1e-6);
    CHECK_NEAR(ovoid_shape_get_inner(warm).volume / ovoid_shape_get_inner(cold).volume, 1, 1.1e-6);
    ovoid_shape_destroy(warm);
    ovoid_shape_destroy(cold);
    ovoid_shape_destroy(shape);
    free(xyz);
}

static void test_deformed(void) {
    const ovoid_vec3 here = {0, 0, 0}, far = {1e7, -1e7, 3e6};
    for (int i = 0; i < 30; i++) {
        double amount = pow(10, -1 - i % 6);
        check_deformed(8 + 40 * i, (ovoid_vec3){1, 2, 3}, here, amount, 1 + (uint64_t)i);
        check_deformed(300, (ovoid_vec3){1, 1e-3, 1e-4}, here, amount, 100 + (uint64_t)i);
        check_deformed(60, (ovoid_vec3){1, 1, 1}, far, amount, 200 + (uint64_t)i);
    }
    // What was a box becomes flat, then a point; the start is of no use, and no harm.
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, NULL);
    double flat[24], point[24] = {0};
    for (int i = 0; i < 8; i++) flat[3 * i] = i & 1, flat[3 * i + 1] = i >> 1, flat[3 * i + 2] = 0;
    ovoid_shape *plate = ovoid_shape_create_deformed(box, flat, NULL, NULL);
    ovoid_shape *dot = ovoid_shape_create_deformed(box, point, NULL, NULL);
    CHECK(plate && ovoid_shape_get_polytope(plate).rank == 2);
    CHECK(dot && ovoid_shape_get_polytope(dot).rank == 0);
    ovoid_shape_destroy(dot);
    // And back.
    ovoid_shape *body = ovoid_shape_create_deformed(plate, flat, NULL, NULL);
    CHECK(body != NULL);
    ovoid_shape_destroy(body);
    ovoid_shape_destroy(plate);
    flat[5] = NAN;
    ovoid_error error = {0};
    CHECK(ovoid_shape_create_deformed(box, flat, NULL, &error) == NULL);
    CHECK_EQ(error.code, OVOID_ERROR_NOT_FINITE);
    ovoid_shape_destroy(box);
}

// Divides, which must succeed.
static void divide(const ovoid_shape *shape, ovoid_plane plane, ovoid_shape *parts[2]) {
    ovoid_shape_halves halves = ovoid_shape_create_divided(shape, &plane, NULL, NULL);
    CHECK_EQ(halves.code, OVOID_OK);
    parts[0] = halves.below;
    parts[1] = halves.above;
}

// Each vertex of the body on its side is in that part (by the distance of a point shape to it), and the part is on its
// side.
static void check_part(const ovoid_shape *body, const ovoid_shape *part, ovoid_plane plane, int side, double size) {
    if (!part) return;
    check_proven(part);
    ovoid_polytope p = ovoid_shape_get_polytope(part), all = ovoid_shape_get_polytope(body);
    for (uint32_t i = 0; i < p.vertex_count; i++) {
        const double *v = p.vertices + 3 * (size_t)i;
        double h = plane.normal.x * (v[0] + p.origin.x) + plane.normal.y * (v[1] + p.origin.y) +
                   plane.normal.z * (v[2] + p.origin.z) - plane.offset;
        CHECK_LE(-1e-15 * size, side * h);
    }
    for (uint32_t i = 0; i < all.vertex_count; i++) {
        const double *v = all.vertices + 3 * (size_t)i;
        ovoid_vec3 x = {v[0] + all.origin.x, v[1] + all.origin.y, v[2] + all.origin.z};
        double h = plane.normal.x * x.x + plane.normal.y * x.y + plane.normal.z * x.z - plane.offset;
        if (!(side * h > 0)) continue;
        int found = 0;
        for (uint32_t k = 0; k < p.vertex_count && !found; k++) {
            const double *w = p.vertices + 3 * (size_t)k;
            found = w[0] + p.origin.x == x.x && w[1] + p.origin.y == x.y && w[2] + p.origin.z == x.z;
        }
        CHECK(found);
    }
}

static void test_divided(void) {
    for (int i = 0; i < 60; i++) {
        uint64_t s = check_seed = 1000 + (uint64_t)i;
        double xyz[3 * 400], scale = i % 3 == 0 ? 1e-9 : i % 3 == 1 ? 1 : 1e9;
        const ovoid_vec3 size = {scale, 2 * scale, 0.3 * scale}, center = {3 * scale, scale, 0};
        fill(xyz, 8 + 6 * i, &s, size, center);
        ovoid_shape *body = ovoid_shape_create_from_points(xyz, (size_t)(8 + 6 * i), NULL, NULL);
        double a = random_normal(&s), b = random_normal(&s), c = random_normal(&s), r = sqrt(a * a + b * b + c * c);
        ovoid_plane plane = {{a / r, b / r, c / r}, 0};
        plane.offset = plane.normal.x * center.x + plane.normal.y * center.y + 0.2 * scale * random_normal(&s);
        ovoid_shape *parts[2];
        divide(body, plane, parts);
        double volume = 0;
        for (int k = 0; k < 2; k++) {
            check_part(body, parts[k], plane, k ? 1 : -1, 4 * scale);
            if (parts[k]) volume += ovoid_shape_get_measures(parts[k]).volume;
        }
        double whole = ovoid_shape_get_measures(body).volume;
        CHECK_NEAR(volume / whole, 1, 1e-12);
        ovoid_shape_destroy(parts[0]);
        ovoid_shape_destroy(parts[1]);
        ovoid_shape_destroy(body);
    }
}

static void test_known_cuts(void) {
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, NULL), *parts[2];
    // Through the middle: two boxes of eight vertices each, whatever diagonals the faces have.
    divide(box, (ovoid_plane){{0, 0, 4}, 2}, parts);
    if (CHECK(parts[0] && parts[1])) {
        CHECK_EQ(ovoid_shape_get_polytope(parts[0]).vertex_count, 8);
        CHECK_EQ(ovoid_shape_get_measures(parts[0]).volume, 6);
        CHECK_EQ(ovoid_shape_get_measures(parts[1]).volume, 2);
    }
    ovoid_shape_destroy(parts[0]);
    ovoid_shape_destroy(parts[1]);
    // Through four corners: two prisms.
    divide(box, (ovoid_plane){{1, 1, 0}, 0}, parts);
    for (int k = 0; k < 2; k++) {
        CHECK(parts[k] && ovoid_shape_get_polytope(parts[k]).vertex_count == 6);
        CHECK(parts[k] && ovoid_shape_get_measures(parts[k]).volume == 4);
        ovoid_shape_destroy(parts[k]);
    }
    // Beside it, and along a face.
    divide(box, (ovoid_plane){{1, 0, 0}, 3}, parts);
    CHECK(parts[0] && !parts[1]);
    ovoid_shape_destroy(parts[0]);
    divide(box, (ovoid_plane){{1, 0, 0}, -1}, parts);
    CHECK(!parts[0] && parts[1]);
    ovoid_shape_destroy(parts[1]);
    ovoid_shape_destroy(box);
    // A polygon, a segment, a point.
    const double flat[] = {0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0};
    const uint32_t counts[] = {4, 2, 1}, expected[] = {4, 2, 0};
    for (int i = 0; i < 3; i++) {
        ovoid_shape *s = ovoid_shape_create_from_points(flat, counts[i], NULL, NULL);
        divide(s, (ovoid_plane){{1, 0, 0}, 0.5}, parts);
        CHECK_EQ(parts[0] ? ovoid_shape_get_polytope(parts[0]).vertex_count : 0, i < 2 ? expected[i] : 1);
        CHECK_EQ(parts[1] ? ovoid_shape_get_polytope(parts[1]).vertex_count : 0, expected[i]);
        ovoid_shape_destroy(parts[0]);
        ovoid_shape_destroy(parts[1]);
        ovoid_shape_destroy(s);
    }
}

static void test_trouble(void) {
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 2, 3}, NULL, NULL);
    const ovoid_plane bad[] = {{{0, 0, 0}, 1}, {{NAN, 0, 1}, 1}, {{1, 0, 0}, INFINITY}, {{1e-200, 0, 0}, 0}};
    const ovoid_code codes[] = {OVOID_ERROR_ARGUMENT, OVOID_ERROR_NOT_FINITE, OVOID_ERROR_NOT_FINITE,
                                OVOID_ERROR_ARGUMENT};
    for (int i = 0; i < 4; i++) {
        ovoid_error error = {0};
        ovoid_shape_halves halves = ovoid_shape_create_divided(box, &bad[i], NULL, &error);
        CHECK_EQ(halves.code, codes[i]);
        CHECK(error.code == codes[i] && error.message[0] && !halves.below && !halves.above);
    }
    const ovoid_plane plane = {{1, 2, 3}, 0.3};
    ovoid_code code = OVOID_ERROR_MEMORY;
    for (long k = 0; code; k++) {
        countdown c = {k, 0};
        ovoid_allocator counted = countdown_make_allocator(&c);
        const ovoid_shape_options o = {.allocator = &counted};
        ovoid_shape_halves halves = ovoid_shape_create_divided(box, &plane, &o, NULL);
        code = halves.code;
        CHECK_EQ(code, code ? OVOID_ERROR_MEMORY : OVOID_OK);
        CHECK_EQ(c.held, code ? 0 : 2);
        ovoid_shape_destroy(halves.below);
        ovoid_shape_destroy(halves.above);
    }
    ovoid_shape_destroy(box);
}

int main(void) {
    test_deformed();
    test_divided();
    test_known_cuts();
    test_trouble();
    return check_end();
}
