// The checks of containment at ellipsoids of known size: radii one rounding margin on either side of touching.
#include "ellipsoid/contain.h"
#include "ellipsoid/factor.h"
#include "polytope/winding.h"
#include "polytopes.h"

static ovoid_ellipsoid ball(double radius) {
    return (ovoid_ellipsoid){{0, 0, 0}, sym3_diagonal(radius * radius, radius * radius, radius * radius)};
}

// A unit cube: the enclosing ball has radius sqrt(3), the enclosed one radius 1. 1e-15 is a few times the margin that
// the bounds of rounding take there.
static void check_cube(void) {
    made m = made_box(1, 1, 1);
    ovoid_ellipsoid out = ball(sqrt(3) * (1 + 4e-15)), in = ball(1 - 4e-15);
    CHECK(ellipsoid_is_enclosing(&m.p, &out));
    CHECK(ellipsoid_is_enclosed(&m.p, &in));
    out = ball(sqrt(3) * (1 - 1e-15)), in = ball(1 + 1e-15);
    CHECK(!ellipsoid_is_enclosing(&m.p, &out));
    CHECK(!ellipsoid_is_enclosed(&m.p, &in));
    CHECK(!ellipsoid_is_enclosed(&m.p, &(ovoid_ellipsoid){{3, 0, 0}, ball(0.5).q}));
    CHECK(!ellipsoid_is_enclosed(&m.p, &(ovoid_ellipsoid){{0, 0, 0}, {1, 2, 0, 1, 0, 1}}));
    CHECK(!ellipsoid_is_enclosing(&m.p, &(ovoid_ellipsoid){{0, 0, 0}, {9, 10, 0, 9, 0, 9}}));
    CHECK(!ellipsoid_is_enclosing(&m.p, &(ovoid_ellipsoid){{NAN, 0, 0}, ball(9).q}));
    CHECK(!ellipsoid_is_enclosed(&m.p, &(ovoid_ellipsoid){{0, NAN, 0}, ball(.1).q}));
    CHECK(!ellipsoid_is_enclosed(&m.p, &(ovoid_ellipsoid){{0, 0, 0}, {NAN, 0, 0, 1, 0, 1}}));
    CHECK(!ellipsoid_is_enclosed(&m.p, &(ovoid_ellipsoid){{0, 0, 0}, {1, NAN, 0, 1, 0, 1}}));
    // A single point is enclosed only as a vertex.
    CHECK(ellipsoid_is_enclosed(&m.p, &(ovoid_ellipsoid){{1, -1, 1}, ball(0).q}));
    CHECK(!ellipsoid_is_enclosed(&m.p, &(ovoid_ellipsoid){{1, -1, 0}, ball(0).q}));
    // Planes are not believed: wild ones cannot make a wrong ball pass, nor lose a right one.
    for (uint32_t f = 0; f < 6; f++) m.planes[f].normal = vec3_make(f == 2 ? NAN : 1, f == 3 ? 1e300 : 2, f);
    in = ball(1 + 1e-15);
    CHECK(!ellipsoid_is_enclosed(&m.p, &in));
    in = ball(1 - 4e-15);
    CHECK(ellipsoid_is_enclosed(&m.p, &in));
    made_destroy(&m);
}

// The surface of every hand-made body winds around its inside and not around points outside.
static void check_winding(void) {
    uint64_t s = 5;
    made bodies[] = {made_box(1, 2, 3), made_simplex(), made_prism(7),
                     made_prism(31),    made_sphere(6), made_random(40, 1, &s)};
    for (size_t i = 0; i < sizeof bodies / sizeof *bodies; i++) {
        CHECK_EQ(polytope_compute_winding(&bodies[i].p, vec3_make(0, 0, 0)), 1);
        CHECK_EQ(polytope_compute_winding(&bodies[i].p, vec3_make(0.01, -0.02, 0.015)), 1);
        CHECK_EQ(polytope_compute_winding(&bodies[i].p, vec3_make(3, 3, 3.5)), 0);
        CHECK_EQ(polytope_compute_winding(&bodies[i].p, vec3_make(-4, 0, 0)), 0);
        CHECK_EQ(polytope_compute_winding(&bodies[i].p, vec3_at(bodies[i].vertices, 0)), 0);
        made_destroy(&bodies[i]);
    }
}

// A sliver folded against its neighbours by one rounding must not cost volume: a cube with one more vertex, inward of
// the middle of an edge by 1e-16, so that the sliver's exact normal points down while its facet looks up.
static void check_sliver(void) {
    double v[27] = {-1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1, -1, -1, -1, 1, 1, -1, 1, -1, 1, 1, 1, 1, 1};
    v[24] = 1 - 0x1p-53, v[26] = 1;
    const uint32_t indices[28] = {0, 4, 6, 2, 1, 3, 7, 8, 5, 0, 1, 5, 4, 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6, 5, 8, 7};
    const uint32_t sizes[7] = {4, 5, 4, 4, 4, 4, 3};
    made m = made_from_polygons(v, 9, indices, sizes, 7);
    ovoid_ellipsoid in = ball(1 - 4e-15);
    CHECK_EQ(m.planes[6].normal.z, -1);
    CHECK(!ellipsoid_is_enclosed(&m.p, &in));
    m.planes[6].normal = vec3_make(0, 0, 1);
    CHECK(ellipsoid_is_enclosed(&m.p, &in));
    made_destroy(&m);
}

// Enclosing at every size and thinness: a box's ellipsoid with radii sqrt(3) half sizes, rotated. The margin taken is
// 2^-50 times the aspect, and the storing of Q costs 2^-52 times its square, so the loss allowed is their sum.
static void check_sizes(void) {
    uint64_t s = 11;
    for (int i = 0; i < 400; i++) {
        check_seed = s;
        double aspect = pow(10, random_uniform(&s, 0, 6)), size = pow(10, random_uniform(&s, -60, 60));
        vec3 h = {size, size / (i % 2 ? aspect : 1), size / aspect};
        mat3 r = i % 3 ? mat3_random_rotation(&s) : mat3_diagonal(1, 1, 1);
        made m = made_box(h.x, h.y, h.z);
        made_map(&m, r, vec3_make(0, 0, 0));
        double room = i % 3 ? 4e-15 * aspect * aspect + 1e-14 * aspect : 4e-15;
        sym3 q = sym3_rotate(sym3_diagonal(3 * h.x * h.x, 3 * h.y * h.y, 3 * h.z * h.z), r);
        ovoid_ellipsoid out = {{0, 0, 0}, sym3_scale(q, 1 + room)}, in = {{0, 0, 0}, sym3_scale(q, (1 - room) / 3)};
        if (room < 0.1) {
            CHECK(ellipsoid_is_enclosing(&m.p, &out));
            CHECK(ellipsoid_is_enclosed(&m.p, &in));
            CHECK(!ellipsoid_is_enclosed(&m.p, &out));
            CHECK(!ellipsoid_is_enclosing(&m.p, &in));
        }
        double volume = 4 * 3.14159265358979 / 3 * sqrt(27) * h.x * h.y * h.z;
        CHECK_NEAR(ovoid_ellipsoid_compute_volume(&out) / volume, 1, 3 * room + 1e-13);
        made_destroy(&m);
    }
    check_seed = 0;
}

// Radii and volume of a posed ellipsoid are those it had.
static void check_values(void) {
    uint64_t s = 3;
    for (int i = 0; i < 200; i++) {
        check_seed = s;
        vec3 n = vec3_random(&s), r = {2 + fabs(sin(n.x)), 1 + fabs(sin(n.y)), 0.1 + 0.9 * fabs(sin(n.z))};
        ovoid_pose pose = {{random_normal(&s), 5, 1}, {n.x, n.y, 1, n.z}};
        ovoid_ellipsoid e = {{1, 2, 3}, sym3_diagonal(r.z * r.z, r.x * r.x, r.y * r.y)};
        ovoid_ellipsoid posed = ovoid_ellipsoid_compute_posed(&e, &pose);
        vec3 back = ovoid_ellipsoid_compute_radii(&posed);
        vec3 center = ovoid_pose_compute_point(&pose, e.center);
        CHECK_NEAR(back.x, r.x, 1e-14);
        CHECK_NEAR(back.y, r.y, 1e-14);
        CHECK_NEAR(back.z, r.z, 1e-13);
        CHECK_NEAR(vec3_norm(vec3_sub(center, posed.center)), 0, 1e-14);
        CHECK_NEAR(ovoid_ellipsoid_compute_volume(&posed), 4.1887902047863905 * r.x * r.y * r.z, 1e-12);
    }
    check_seed = 0;
    CHECK_EQ(ovoid_ellipsoid_compute_volume(&(ovoid_ellipsoid){{0, 0, 0}, {4, 0, 0, 9, 0, 0}}), 0);
    CHECK_EQ(ovoid_ellipsoid_compute_radii(&(ovoid_ellipsoid){{0, 0, 0}, {4, 0, 0, 9, 0, 0}}).x, 3);
    CHECK_EQ(ovoid_ellipsoid_compute_radii(&(ovoid_ellipsoid){{0, 0, 0}, {4, 0, 0, 9, 0, 0}}).z, 0);
}

// R' diag(square) R for a rotation, in double-double. A rotation of doubles is orthonormal to a rounding, which changes
// every eigenvalue by about as much of itself (A. M. Ostrowski, 1959).
static sym3dd compute_matrix(mat3 r, vec3 square) {
    const double full[3][3] = {{r.r0.x, r.r0.y, r.r0.z}, {r.r1.x, r.r1.y, r.r1.z}, {r.r2.x, r.r2.y, r.r2.z}};
    const double value[3] = {square.x, square.y, square.z};
    sym3dd q;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            q.m[i][j] = dd_from(0);
            for (int k = 0; k < 3; k++)
                q.m[i][j] = dd_add(q.m[i][j], dd_mul(two_product(full[k][i], full[k][j]), dd_from(value[k])));
        }
    return q;
}

// Doubles rounded together keep every radius of needles and slabs in any direction, where rounding each to nearest
// loses them from an aspect a of 1e8 on. The room is the one that docs/ellipsoid.md derives, times 64: 2^-53 a^(4/3).
static void check_round(void) {
    uint64_t s = 17;
    for (int i = 0; i < 300; i++) {
        check_seed = s;
        double aspect = pow(10, i / 33.0), size = pow(10, random_uniform(&s, -60, 60)), middle;
        middle = i % 3 == 0 ? 1 : i % 3 == 1 ? aspect : sqrt(aspect);
        vec3 radii = {size, size / middle, size / aspect};
        sym3dd q =
            compute_matrix(mat3_random_rotation(&s), (vec3){radii.x * radii.x, radii.y * radii.y, radii.z * radii.z});
        ovoid_ellipsoid e = {{0, 0, 0}, sym3dd_round(&q)};
        vec3 back = ovoid_ellipsoid_compute_radii(&e);
        double room = 0x1p-47 * pow(aspect, 4 / 3.0);
        CHECK_NEAR(back.x / radii.x, 1, room);
        CHECK_NEAR(back.y / radii.y, 1, room);
        CHECK_NEAR(back.z / radii.z, 1, room);
        CHECK_NEAR(ovoid_ellipsoid_compute_volume(&e) / (4.1887902047863905 * radii.x * radii.y * radii.z), 1,
                   3 * room);
    }
    check_seed = 0;
}

// The mean of a cube's corners, 0, is in an ellipsoid along the axes by the sum of (c_k / r_k)^2; it is shown up to 0.9
// of the ellipsoid. Far out the mean is known to a rounding of its coordinates alone, which a small ball does not hold.
static void check_mean(void) {
    uint64_t s = 81;
    made m = made_box(1, 1, 1);
    factor f;
    double size;
    for (int i = 0; i < 1000; i++) {
        double c[3], square = 0;
        sym3 q = {0, 0, 0, 0, 0, 0};
        double *diagonal[3] = {&q.xx, &q.yy, &q.zz};
        for (int k = 0; k < 3; k++) {
            double radius = random_uniform(&s, 0.1, 1);
            c[k] = random_uniform(&s, -1, 1) * radius;
            *diagonal[k] = radius * radius;
            square += c[k] * c[k] / *diagonal[k];
        }
        if (!CHECK(factor_make_quickly(q, &f, &size)) || fabs(sqrt(square) - 0.9) < 1e-9) continue;
        CHECK_EQ(factor_holds_mean(&f, &m.p, vec3_at(c, 0)), sqrt(square) < 0.9);
    }
    made_destroy(&m);
    double far[24];
    for (int i = 0; i < 24; i++) far[i] = 1e8 + (i / 3 >> i % 3 & 1);
    const ovoid_polytope p = {.vertices = far, .vertex_count = 8, .rank = 3};
    for (int large = 0; large < 2; large++) {
        double square = large ? 1e-12 : 1e-16;
        CHECK(factor_make_quickly(sym3_diagonal(square, square, square), &f, &size));
        CHECK_EQ(factor_holds_mean(&f, &p, vec3_make(1e8 + 0.5, 1e8 + 0.5, 1e8 + 0.5)), large);
    }
}

int main(void) {
    check_round();
    check_mean();
    check_cube();
    check_winding();
    check_sliver();
    check_sizes();
    check_values();
    return check_end();
}
