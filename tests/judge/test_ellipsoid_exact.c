// Containment in exact arithmetic (GMP rationals): what the library calls proven is judged here without any of its
// own bounds. Outside: Q - (v - c)(v - c)' is positive semidefinite for every vertex, by its principal minors. Inside:
// for every plane through three vertices that has no vertex above it (found by trying all triples, with the exact
// orientation that test_linear.c checks) h(N) <= N . v. These planes are the facets of the hull of the vertices, so
// that the polytope's own faces and planes play no part. No tolerance anywhere.
#include "ellipsoid/contain.h"
#include "polytopes.h"

#include <gmp.h>

static mpq_t temporary[12];

// The exact rationals of three doubles.
static void set3(mpq_t x[3], vec3 v) {
    mpq_set_d(x[0], v.x);
    mpq_set_d(x[1], v.y);
    mpq_set_d(x[2], v.z);
}

static void init(mpq_t *x, int count) {
    for (int i = 0; i < count; i++) mpq_init(x[i]);
}

static void set_matrix(mpq_t q[3][3], sym3 s) {
    const double d[3][3] = {{s.xx, s.xy, s.xz}, {s.xy, s.yy, s.yz}, {s.xz, s.yz, s.zz}};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) mpq_set_d(q[i][j], d[i][j]);
}

// r = a b - c d
static void cross_term(mpq_t r, mpq_t a, mpq_t b, mpq_t c, mpq_t d) {
    mpq_mul(temporary[0], a, b);
    mpq_mul(temporary[1], c, d);
    mpq_sub(r, temporary[0], temporary[1]);
}

// All principal minors are >= 0.
static int is_semidefinite(mpq_t m[3][3]) {
    mpq_t *minor = temporary + 2, *sum = temporary + 5;
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3;
        if (mpq_sgn(m[i][i]) < 0) return 0;
        cross_term(*sum, m[i][i], m[j][j], m[i][j], m[j][i]);
        if (mpq_sgn(*sum) < 0) return 0;
    }
    cross_term(minor[0], m[1][1], m[2][2], m[1][2], m[2][1]);
    cross_term(minor[1], m[1][2], m[2][0], m[1][0], m[2][2]);
    cross_term(minor[2], m[1][0], m[2][1], m[1][1], m[2][0]);
    mpq_set_ui(*sum, 0, 1);
    for (int k = 0; k < 3; k++) {
        mpq_mul(temporary[0], m[0][k], minor[k]);
        mpq_add(*sum, *sum, temporary[0]);
    }
    return mpq_sgn(*sum) >= 0;
}

static int is_enclosing(const made *m, const ovoid_ellipsoid *e) {
    mpq_t q[3][3], c[3], d[3], rest[3][3];
    init(&q[0][0], 9), init(c, 3), init(d, 3), init(&rest[0][0], 9);
    set_matrix(q, e->q);
    set3(c, e->center);
    int enclosing = is_semidefinite(q);
    for (uint32_t v = 0; v < m->p.vertex_count && enclosing; v++) {
        set3(d, vec3_at(m->vertices, v));
        for (int i = 0; i < 3; i++) mpq_sub(d[i], d[i], c[i]);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) {
                mpq_mul(rest[i][j], d[i], d[j]);
                mpq_sub(rest[i][j], q[i][j], rest[i][j]);
            }
        enclosing = is_semidefinite(rest);
    }
    for (int i = 0; i < 3; i++) {
        mpq_clear(c[i]), mpq_clear(d[i]);
        for (int j = 0; j < 3; j++) mpq_clear(q[i][j]), mpq_clear(rest[i][j]);
    }
    return enclosing;
}

// h(N) <= N . a for the exact normal N of the triangle a, b, c.
static int is_below(const vec3 corner[3], mpq_t q[3][3], mpq_t center[3]) {
    mpq_t p[3][3], n[3], reach, room;
    init(&p[0][0], 9), init(n, 3), mpq_init(reach), mpq_init(room);
    for (int i = 0; i < 3; i++) set3(p[i], corner[i]);
    for (int i = 1; i < 3; i++)
        for (int k = 0; k < 3; k++) mpq_sub(p[i][k], p[i][k], p[0][k]);
    for (int k = 0; k < 3; k++) {
        int x = (k + 1) % 3, y = (k + 2) % 3;
        cross_term(n[k], p[1][x], p[2][y], p[1][y], p[2][x]);
    }
    // room = N . (a - c), reach = N' Q N
    for (int i = 0; i < 3; i++) {
        mpq_sub(p[0][i], p[0][i], center[i]);
        mpq_mul(temporary[0], n[i], p[0][i]);
        mpq_add(room, room, temporary[0]);
        for (int j = 0; j < 3; j++) {
            mpq_mul(temporary[0], n[i], n[j]);
            mpq_mul(temporary[0], temporary[0], q[i][j]);
            mpq_add(reach, reach, temporary[0]);
        }
    }
    mpq_mul(temporary[0], room, room);
    int below = mpq_sgn(room) >= 0 && mpq_cmp(reach, temporary[0]) <= 0;
    for (int i = 0; i < 3; i++) {
        mpq_clear(n[i]);
        for (int j = 0; j < 3; j++) mpq_clear(p[i][j]);
    }
    mpq_clear(reach), mpq_clear(room);
    return below;
}

// Every vertex lies on or below the plane, and it is a plane: some vertex lies strictly below.
static int is_supporting(const made *m, const vec3 corner[3]) {
    int below = 0;
    for (uint32_t v = 0; v < m->p.vertex_count; v++) {
        int sign = orient3d_sign(corner[0], corner[1], corner[2], vec3_at(m->vertices, v));
        if (sign < 0) return 0;
        below |= sign > 0;
    }
    return below;
}

static int is_enclosed(const made *m, const ovoid_ellipsoid *e) {
    mpq_t q[3][3], center[3];
    init(&q[0][0], 9), init(center, 3);
    set_matrix(q, e->q);
    set3(center, e->center);
    int enclosed = is_semidefinite(q);
    uint32_t n = m->p.vertex_count, planes = 0;
    for (uint32_t i = 0; i < n && enclosed; i++)
        for (uint32_t j = i + 1; j < n && enclosed; j++)
            for (uint32_t k = i + 1; k < n && enclosed; k++) {
                vec3 corner[3] = {vec3_at(m->vertices, i), vec3_at(m->vertices, j), vec3_at(m->vertices, k)};
                if (j == k || !is_supporting(m, corner)) continue;
                planes++;
                enclosed = is_below(corner, q, center);
            }
    for (int i = 0; i < 3; i++) {
        mpq_clear(center[i]);
        for (int j = 0; j < 3; j++) mpq_clear(q[i][j]);
    }
    return enclosed && planes >= 4;
}

// The judge itself: a unit cube and balls that touch it from either side, exactly and by one rounding.
static void check_judge(void) {
    made m = made_box(1, 1, 1);
    ovoid_ellipsoid e = {{0, 0, 0}, {1, 0, 0, 1, 0, 1}};
    CHECK(is_enclosed(&m, &e));
    CHECK(!is_enclosing(&m, &e));
    e.q.yy = 1 + 0x1p-52;
    CHECK(!is_enclosed(&m, &e));
    e.q = (sym3){3, 0, 0, 3, 0, 3};
    CHECK(is_enclosing(&m, &e));
    e.q.zz = 3 - 0x1p-51;
    CHECK(!is_enclosing(&m, &e));
    made_destroy(&m);
}

// All steps of one body, judged.
static void check_steps(made m) {
    ovoid_fit fit[5];
    CHECK_EQ(ovoid_ellipsoid_compute_outer(&m.p, NULL, &fit[0], NULL), OVOID_OK);
    CHECK(is_enclosing(&m, &fit[0].ellipsoid));
    CHECK(ellipsoid_is_enclosing(&m.p, &fit[0].ellipsoid));
    if (m.p.rank == 3) {
        fit[1] = ovoid_ellipsoid_compute_shrunk(&m.p, &fit[0].ellipsoid);
        fit[2] = ovoid_ellipsoid_compute_stretched(&m.p, &fit[1].ellipsoid);
        fit[3] = ovoid_ellipsoid_compute_enlarged(&m.p, &fit[2].ellipsoid);
        CHECK_EQ(ovoid_ellipsoid_compute_inner(&m.p, NULL, &fit[4], NULL), OVOID_OK);
        for (int i = 1; i < 5; i++) {
            CHECK(is_enclosed(&m, &fit[i].ellipsoid));
            CHECK(ellipsoid_is_enclosed(&m.p, &fit[i].ellipsoid));
            CHECK(fit[i].volume > 0);
        }
    }
    made_destroy(&m);
}

static made mapped(made m, mat3 a) {
    made_map(&m, a, vec3_make(0, 0, 0));
    return m;
}

static void check_bodies(void) {
    uint64_t s = 1;
    check_steps(made_box(1, 2, 3));
    check_steps(made_simplex());
    check_steps(made_prism(7));
    check_steps(made_prism(15));
    check_steps(made_sphere(2));
    check_steps(mapped(made_box(1, 1, 1), mat3_random_rotation(&s)));
    check_steps(mapped(made_prism(12), mat3_random_rotation(&s)));
    for (int i = 0; i < 24; i++) {
        check_seed = s;
        made m = made_random(4 + i / 2, 1, &s);
        // Round, needle, slab, both; at all sizes; along the axes and not.
        double thin = pow(10, -random_uniform(&s, 0, 8)), size = pow(10, random_uniform(&s, -60, 60));
        mat3 a = mat3_diagonal(size, size * (i & 1 ? thin : 1), size * (i & 2 ? thin : 1));
        check_steps(mapped(m, i % 3 ? mat3_mul(mat3_random_rotation(&s), a) : a));
    }
    // Nearly flat: a slab of a few roundings.
    for (int i = 0; i < 4; i++) {
        check_seed = s;
        mat3 a = mat3_diagonal(1, 1, pow(10, -10 - i));
        check_steps(mapped(made_random(10, 1, &s), i % 2 ? mat3_mul(mat3_random_rotation(&s), a) : a));
    }
    check_seed = 0;
}

static void check_flat(void) {
    uint64_t s = 3;
    for (int i = 0; i < 30; i++) {
        check_seed = s;
        double xyz[3 * 9], size = pow(10, random_uniform(&s, -60, 60)), thin = pow(10, -random_uniform(&s, 0, 7));
        for (int k = 0; k < 9; k++) {
            xyz[3 * k] = size * cos(0.7 * k);
            xyz[3 * k + 1] = thin * size * sin(0.7 * k);
            xyz[3 * k + 2] = 0.3 * size;
        }
        made m = i % 5 == 4 ? made_segment(xyz, 2) : i % 5 == 3 ? made_segment(xyz, 1) : made_polygon(xyz, 9);
        check_steps(i % 2 ? mapped(m, mat3_random_rotation(&s)) : m);
    }
    check_seed = 0;
}

// Whatever ellipsoid is tried near the limit: a yes of the library is a yes of the judge. And where the limit is
// 1e-12 away, the library says yes too.
static void check_yes(void) {
    uint64_t s = 9;
    for (int i = 0; i < 40; i++) {
        check_seed = s;
        made m = made_random(8, 1, &s);
        made_map(&m, mat3_mul(mat3_random_rotation(&s), mat3_diagonal(1, 0.3, 0.05)), vec3_make(0.1, 0.2, 0));
        ovoid_fit inner, outer;
        (void)ovoid_ellipsoid_compute_inner(&m.p, NULL, &inner, NULL);
        (void)ovoid_ellipsoid_compute_outer(&m.p, NULL, &outer, NULL);
        for (int k = -6; k <= 6; k++) {
            ovoid_ellipsoid in = inner.ellipsoid, out = outer.ellipsoid;
            in.q = sym3_scale(in.q, 1 + k * 0x1p-50), out.q = sym3_scale(out.q, 1 + k * 0x1p-50);
            CHECK(!ellipsoid_is_enclosed(&m.p, &in) || is_enclosed(&m, &in));
            CHECK(!ellipsoid_is_enclosing(&m.p, &out) || is_enclosing(&m, &out));
        }
        inner.ellipsoid.q = sym3_scale(inner.ellipsoid.q, 1 - 1e-12);
        outer.ellipsoid.q = sym3_scale(outer.ellipsoid.q, 1 + 1e-12);
        CHECK(ellipsoid_is_enclosed(&m.p, &inner.ellipsoid));
        CHECK(ellipsoid_is_enclosing(&m.p, &outer.ellipsoid));
        made_destroy(&m);
    }
    check_seed = 0;
}

int main(void) {
    init(temporary, 12);
    check_judge();
    check_bodies();
    check_flat();
    check_yes();
    for (int i = 0; i < 12; i++) mpq_clear(temporary[i]);
    return check_end();
}
