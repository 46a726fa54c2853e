// Measures against closed forms: boxes, the right simplex, flat and straight bodies, turned and moved, at sizes from
// 1e-60 to 1e60. The formulas are polynomials that add up a handful of terms of the body's own size: 1e-13 of the size
// to the measure's power is a hundred roundings and more; a needle's centroid and inertia are off by its
// corners' rounding over its thickness. Smallest spheres against all spheres through up to four
// points.
#include "base/allocator.h"
#include "check.h"
#include "linear/exact.h"
#include "linear/rotation.h"
#include "polytope/hull.h"
#include "polytope/sphere.h"

static ovoid_allocator allocator;
static double cloud[3 * 1000];

static void put(size_t i, vec3 v) {
    cloud[3 * i] = v.x;
    cloud[3 * i + 1] = v.y;
    cloud[3 * i + 2] = v.z;
}

static ovoid_measures measure(size_t count, uint32_t rank) {
    hull h;
    ovoid_code code = hull_create((xyz_points){cloud, count}, &allocator, &h, NULL);
    CHECK_EQ(code, OVOID_OK);
    CHECK_EQ(h.rank, rank);
    ovoid_polytope p = hull_get_polytope(&h);
    ovoid_measures m = ovoid_polytope_compute_measures(&p);
    m.centroid = vec3_add(m.centroid, h.origin);
    hull_destroy(&h, &allocator);
    return m;
}

static void check_sym3(sym3 a, sym3 b, double tolerance) {
    CHECK_NEAR(a.xx, b.xx, tolerance);
    CHECK_NEAR(a.yy, b.yy, tolerance);
    CHECK_NEAR(a.zz, b.zz, tolerance);
    CHECK_NEAR(a.xy, b.xy, tolerance);
    CHECK_NEAR(a.xz, b.xz, tolerance);
    CHECK_NEAR(a.yz, b.yz, tolerance);
}

// A box with zero to three of its edges zero, turned about its centre, which is moved.
static void check_box(vec3 edge, int rank, double size, uint64_t *s) {
    mat3 r = quat_to_mat3((ovoid_quat){random_normal(s), random_normal(s), random_normal(s), random_normal(s)});
    vec3 center = vec3_scale((vec3){0.3, -0.7, 0.2}, size);
    edge = vec3_scale(edge, size);
    for (int i = 0; i < 8; i++) {
        vec3 v = {i & 1 ? edge.x / 2 : -edge.x / 2, i & 2 ? edge.y / 2 : -edge.y / 2, i & 4 ? edge.z / 2 : -edge.z / 2};
        put((size_t)i, vec3_add(center, mat3_mul_vec3(r, v)));
    }
    ovoid_measures m = measure(8, (uint32_t)rank);
    double content = 1;
    if (edge.x > 0) content *= edge.x;
    if (edge.y > 0) content *= edge.y;
    if (edge.z > 0) content *= edge.z;
    if (rank == 0) content = 0;
    double power = pow(size, rank), thin = rank == 3 ? size / fmin(edge.x, fmin(edge.y, edge.z)) : 1;
    CHECK_NEAR(m.volume, rank == 3 ? content : 0, 1e-13 * power);
    CHECK_NEAR(m.area, 2 * (edge.x * edge.y + edge.y * edge.z + edge.z * edge.x), 1e-13 * size * size);
    CHECK_NEAR(vec3_norm(vec3_sub(m.centroid, center)), 0, 1e-14 * thin * size);
    double k = content / 12;
    sym3 want = sym3_diagonal(k * (edge.y * edge.y + edge.z * edge.z), k * (edge.x * edge.x + edge.z * edge.z),
                              k * (edge.x * edge.x + edge.y * edge.y));
    check_sym3(m.inertia, sym3_rotate(want, r), 1e-13 * power * size * size);
    CHECK_NEAR(m.sphere_radius, vec3_norm(edge) / 2, 1e-13 * size);
}

static void check_boxes(void) {
    static const double sizes[] = {1e-60, 1e-9, 1, 1e9, 1e45};
    uint64_t s = 1;
    for (int i = 0; i < 5; i++) {
        check_box((vec3){1, 2, 3}, 3, sizes[i], &s);
        check_box((vec3){1, 1e-3, 1e-5}, 3, sizes[i], &s);
        check_box((vec3){1, 0, 3}, 2, sizes[i], &s);
        check_box((vec3){0, 2, 0}, 1, sizes[i], &s);
        check_box((vec3){0, 0, 0}, 0, sizes[i], &s);
    }
}

// The simplex of the axes: volume 1/6, centroid 1/4; second moments 1/60 and 1/120 about the corner.
static void check_simplex(void) {
    put(0, (vec3){1, 0, 0});
    put(1, (vec3){0, 0, 0});
    put(2, (vec3){0, 0, 1});
    put(3, (vec3){0, 1, 0});
    ovoid_measures m = measure(4, 3);
    CHECK_NEAR(m.volume, 1.0 / 6, 1e-15);
    CHECK_NEAR(m.area, 1.5 + sqrt(3) / 2, 1e-15);
    CHECK_NEAR(m.centroid.x, 0.25, 1e-15);
    double own = 1.0 / 60 - 1.0 / 96, mixed = 1.0 / 120 - 1.0 / 96;
    check_sym3(m.inertia, (sym3){2 * own, -mixed, -mixed, 2 * own, -mixed, 2 * own}, 1e-15);
    CHECK_EQ(m.box.max.y, 1);
    CHECK_EQ(m.box.min.y, 0);
}

// At the largest size nothing overflows; at the smallest ones what underflows is zero and the rest stays right.
static void check_extremes(void) {
    for (int sign = -1; sign <= 1; sign += 2) {
        double size = ldexp(1, sign < 0 ? -1060 : 165);
        for (int i = 0; i < 8; i++) put((size_t)i, (vec3){i & 1 ? size : 0, i & 2 ? size : 0, i & 4 ? size : 0});
        ovoid_measures m = measure(8, 3);
        CHECK_EQ(m.volume, sign < 0 ? 0 : ldexp(1, 495));
        CHECK_EQ(m.centroid.x, size / 2);
        // To the precision that doubles have there.
        CHECK_NEAR(m.sphere_radius, sqrt(0.75) * size, sign < 0 ? 0x1p-1073 : 1e-14 * size);
        CHECK_NEAR(m.inertia.xx, sign < 0 ? 0 : ldexp(1, 825) / 6, sign < 0 ? 0 : ldexp(1, 785));
    }
}

// Exactly: no point is outside of the sphere.
static int is_enclosing(const double *xyz, size_t count, sphere s) {
    int holds = 1;
    for (size_t i = 0; i < count; i++) {
        vec3 p = vec3_at(xyz, i);
        dd x = two_sum(p.x, -s.center.x), y = two_sum(p.y, -s.center.y), z = two_sum(p.z, -s.center.z);
        dd d = dd_add(dd_add(dd_mul(x, x), dd_mul(y, y)), dd_mul(z, z));
        d = dd_sub(d, two_product(s.radius, s.radius));
        holds &= d.high <= 0;
    }
    return holds;
}

// A sphere is the smallest one if its centre is in the hull of the points on it (J. E. Jung): no direction leads the
// centre nearer to all of them. Tried with the directions to all points and many random ones.
static void check_smallest(size_t count) {
    sphere s = sphere_compute_smallest(cloud, (uint32_t)count);
    CHECK(is_enclosing(cloud, count, s));
    if (count == 1) {
        CHECK_EQ(s.radius, 0);
        return;
    }
    uint64_t state = count;
    for (int i = 0; i < 400; i++) {
        vec3 n = {random_normal(&state), random_normal(&state), random_normal(&state)};
        if (i < 100) n = vec3_sub(vec3_at(cloud, (size_t)i % count), s.center);
        n = vec3_unit(n);
        double most = -1;
        for (size_t k = 0; k < count; k++) {
            vec3 d = vec3_sub(vec3_at(cloud, k), s.center);
            if (vec3_norm(d) >= s.radius * (1 - 1e-9)) most = fmax(most, -vec3_dot(n, d) / s.radius);
        }
        // A centre that is off by 1e-9 or a point within 1e-9 of the sphere turn this by about the root of it.
        CHECK_LE(-1e-4, most);
    }
}

static void check_spheres(void) {
    uint64_t s = 5;
    for (int i = 0; i < 200; i++) {
        check_seed = s;
        size_t n = 1 + random_next(&s) % 40;
        double flat = i % 3 == 0 ? 0 : 1, thin = i % 5 == 0 ? 1e-7 : 1;
        for (size_t k = 0; k < n; k++) {
            vec3 v = {random_normal(&s), thin * random_normal(&s), flat * random_normal(&s)};
            put(k, i % 4 == 0 ? vec3_unit(v) : v);
        }
        check_smallest(n);
    }
    check_seed = 0;
    // On a sphere, every point counts.
    for (size_t k = 0; k < 1000; k++)
        put(k, vec3_unit((vec3){random_normal(&s), random_normal(&s), random_normal(&s)}));
    sphere ball = sphere_compute_smallest(cloud, 1000);
    CHECK(is_enclosing(cloud, 1000, ball));
    CHECK_NEAR(ball.radius, 1, 1e-14);
}

int main(void) {
    allocator = allocator_make(NULL);
    check_boxes();
    check_simplex();
    check_extremes();
    check_spheres();
    return check_end();
}
