// The maximum-volume inscribed ellipsoid against closed forms, an independent slow solver, and its own promises. That
// it lies inside is judged in exact arithmetic by test_ellipsoid_exact.c. A volume V reported with gap g and a true
// optimum T: V <= T <= V (1 + g), up to the rounding of T here, 1e-12.
#include "countdown.h"
#include "ellipsoid/contain.h"
#include "polytopes.h"

static const double PI = 3.14159265358979323846;

static ovoid_fit fit_inner(const made *m, double gap) {
    ovoid_fit fit;
    CHECK_EQ(ovoid_ellipsoid_compute_inner(&m->p, &(ovoid_ellipsoid_options){.gap = gap}, &fit, NULL), OVOID_OK);
    CHECK_EQ(ellipsoid_is_enclosed(&m->p, &fit.ellipsoid), m->p.rank == 3);
    return fit;
}

static made mapped(made m, mat3 a, vec3 b) {
    made_map(&m, a, b);
    return m;
}

// The fit of a body whose largest volume is known; it is destroyed.
static void check_known(made m, double truth) {
    ovoid_fit fit = fit_inner(&m, 0);
    CHECK(fit.converged);
    CHECK_LE(fit.gap, 1e-6);
    CHECK_LE(fit.volume, truth * (1 + 1e-12));
    CHECK_LE(truth * (1 - 1e-12), fit.volume * (1 + fit.gap));
    made_destroy(&m);
}

static void check_closed_forms(void) {
    uint64_t s = 1;
    double ball = 4 * PI / 3;
    // Box: radii are the half sizes. Simplex: the insphere, a third of the circumsphere. Prism: radius cos(pi / n),
    // height 1.
    made m = made_box(1, 2, 3);
    ovoid_fit fit = fit_inner(&m, 0);
    CHECK_NEAR(fit.ellipsoid.q.xx, 1, 1e-6);
    CHECK_NEAR(fit.ellipsoid.q.yy, 4, 4e-6);
    CHECK_NEAR(fit.ellipsoid.q.zz, 9, 9e-6);
    CHECK_NEAR(fit.volume, 8 * PI, 8 * PI * 1e-9);
    check_known(m, 8 * PI);
    check_known(mapped(made_box(1, 1, 1), mat3_random_rotation(&s), vec3_make(5, -7, 2)), ball * (1 + 2e-14));
    check_known(made_simplex(), ball / 27);
    const uint32_t sides[] = {3, 4, 7, 31, 1000};
    for (int i = 0; i < 5; i++) check_known(made_prism(sides[i]), ball * pow(cos(PI / sides[i]), 2));
    // Affine images, at all sizes: needles and slabs of the aspect 10^(0.2 i). Rounding moves the vertices by 1e-16 of
    // the size, which the thin axes feel.
    for (int i = 0; i < 30; i++) {
        check_seed = s;
        double thin = pow(10, -i * 0.2), size = pow(10, random_uniform(&s, -80, 80));
        mat3 a = mat3_diagonal(size, i % 2 ? size : size * thin, size * thin);
        if (i % 3) a = mat3_mul(mat3_random_rotation(&s), a);
        double det = vec3_dot(a.r0, vec3_cross(a.r1, a.r2));
        m = mapped(made_prism(13), a, vec3_make(0, 0, 0));
        fit = fit_inner(&m, 0);
        CHECK(fit.converged);
        CHECK_NEAR(fit.volume / (ball * pow(cos(PI / 13), 2) * det), 1, 1.1e-6 + 1e-14 / thin);
        made_destroy(&m);
    }
    check_seed = 0;
}

// The largest volume about a given centre: with v = n / (d - n . c) the walls are v' Q v <= 1, and the best Q is the
// inverse of a design on the points v, found by the multiplicative algorithm (D. M. Titterington, 1976). Q is scaled
// until it is feasible, so the answer is a lower bound of the optimum.
static double solve_at(const made *m, vec3 c, double *weight) {
    uint32_t n = m->p.facet_count;
    double top = 0, det = 0;
    for (uint32_t i = 0; i < n; i++) weight[i] = 1.0 / n;
    for (int step = 0; step < 3000; step++) {
        sym3 s = {0, 0, 0, 0, 0, 0};
        for (uint32_t i = 0; i < n; i++) {
            double room = m->planes[i].offset - vec3_dot(m->planes[i].normal, c);
            if (!(room > 0)) return 0;
            s = sym3_add(s, sym3_outer(m->planes[i].normal, weight[i] / (room * room)));
        }
        sym3 inverse = sym3_inverse(s);
        det = sym3_det(inverse);
        top = 0;
        for (uint32_t i = 0; i < n; i++) {
            double room = m->planes[i].offset - vec3_dot(m->planes[i].normal, c);
            double d = sym3_quadratic(inverse, m->planes[i].normal) / (room * room);
            top = fmax(top, d);
            weight[i] *= d / 3;
        }
        if (top < 3 * (1 + 1e-7)) break;
    }
    return 4 * PI / 3 * sqrt(det / (top * top * top));
}

// The best centre by a search in 26 directions with ever smaller steps: the volume to the power 1/3 is concave in it.
static double solve_slowly(const made *m, vec3 c) {
    double *weight = malloc(m->p.facet_count * sizeof *weight), best = solve_at(m, c, weight);
    for (double step = 0.1; step > 2e-4; step /= 2)
        for (int moved = 1; moved;) {
            moved = 0;
            for (int k = 0; k < 27; k++) {
                vec3 d = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1}, next = vec3_add_scaled(c, d, step);
                double volume = k == 13 ? 0 : solve_at(m, next, weight);
                if (volume > best) best = volume, c = next, moved = 1;
            }
        }
    free(weight);
    return best;
}

static void check_brute_force(void) {
    uint64_t s = 21;
    for (int i = 0; i < 5; i++) {
        check_seed = s;
        made m = made_random(6 + (uint32_t)i, 1, &s);
        ovoid_fit fit = fit_inner(&m, 0);
        double truth = solve_slowly(&m, vec3_make(0, 0, 0));
        // The search is a lower bound of the optimum, and so is the fit, which the exact test shows inside; the search
        // stalls on ridges, so that near means 1e-3 here.
        CHECK_LE(truth, fit.volume * (1 + fit.gap) * (1 + 1e-12));
        CHECK_NEAR(fit.volume / truth, 1, 1e-3);
        made_destroy(&m);
    }
    check_seed = 0;
}

static void check_gaps(void) {
    uint64_t s = 31;
    for (int i = 0; i < 30; i++) {
        check_seed = s;
        made m = made_random(6 + 3 * (uint32_t)i, i & 1, &s);
        ovoid_fit fit = fit_inner(&m, 0), fine = fit_inner(&m, 1e-10), coarse = fit_inner(&m, 0.1);
        CHECK(fit.converged && fine.converged && coarse.converged);
        CHECK_LE(fine.gap, 1e-10);
        CHECK_LE(coarse.gap, 0.1);
        CHECK_LE(fine.volume, fit.volume * (1 + fit.gap));
        CHECK_LE(fine.volume, coarse.volume * (1 + coarse.gap));
        CHECK_LE(fit.volume, fine.volume * (1 + fine.gap));
        // An affine image has the image of the fit.
        mat3 a = mat3_mul(mat3_random_rotation(&s), mat3_mul(mat3_diagonal(1, 30, 0.02), mat3_random_rotation(&s)));
        made_map(&m, a, vec3_make(3, 2, 1));
        ovoid_fit image = fit_inner(&m, 1e-9);
        CHECK_NEAR(image.volume / (fine.volume * 0.6), 1, 2e-9);
        made_destroy(&m);
    }
    check_seed = 0;
}

// John's theorem ties both: the outer ellipsoid shrunk by 3 is inside, so the inner one is no smaller; and the inner
// one enlarged by 3 encloses, so the outer one is no larger.
static void check_john(void) {
    uint64_t s = 41;
    for (int i = 0; i < 30; i++) {
        check_seed = s;
        made m = made_random(4 + (uint32_t)i, 1, &s);
        ovoid_fit inner = fit_inner(&m, 0), outer;
        (void)ovoid_ellipsoid_compute_outer(&m.p, NULL, &outer, NULL);
        CHECK_LE(outer.volume / 27, inner.volume * (1 + 2e-6));
        ovoid_ellipsoid large = inner.ellipsoid;
        large.q = sym3_scale(large.q, 9 * pow(1 + 3e-3, 2)); // a gap of 1e-6 moves the form by its root
        CHECK(ellipsoid_is_enclosing(&m.p, &large));
        made_destroy(&m);
    }
    check_seed = 0;
}

// Facets that say almost the same: a cube whose faces are cut into grids, with points lifted by
// 1e-13 to 1e-4.
static void check_parallel(void) {
    uint64_t s = 51;
    enum { N = 6 };
    for (int round = 0; round < 4; round++) {
        check_seed = s;
        double xyz[3 * 6 * N * N];
        uint32_t count = 0;
        for (int face = 0; face < 6; face++)
            for (int k = 0; k < N * N; k++) {
                double p[3];
                p[face / 2] = (face % 2 ? 1 : -1) * (1 + random_uniform(&s, 0, 1) * pow(10, -13 + 3 * round));
                p[(face / 2 + 1) % 3] = random_uniform(&s, -1, 1);
                p[(face / 2 + 2) % 3] = random_uniform(&s, -1, 1);
                memcpy(xyz + 3 * count++, p, sizeof p);
            }
        made m = made_hull(xyz, count);
        ovoid_fit fit = fit_inner(&m, 0);
        CHECK(fit.converged);
        CHECK_LE(fit.gap, 1e-6);
        made_destroy(&m);
    }
    check_seed = 0;
}

// Flat bodies, for information: areas and lengths.
static void check_flat(void) {
    uint64_t s = 61;
    const double square[12] = {2, 0, 0.3, 0, 1, 0.3, -2, 0, 0.3, 0, -1, 0.3}, ends[6] = {1, 2, 3, 4, -2, 3};
    const double triangle[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    for (int i = 0; i < 4; i++) {
        made m = i < 2 ? made_polygon(square, 4) : made_polygon(triangle, 3);
        // Half the square of the diagonals' ellipse; Steiner's inellipse, pi / (3 sqrt 3) of the triangle.
        double truth = i < 2 ? PI : PI / sqrt(27) / 2;
        if (i % 2) made_map(&m, mat3_random_rotation(&s), vec3_make(1, 2, 3));
        ovoid_fit fit = fit_inner(&m, 0);
        CHECK(fit.converged);
        CHECK_NEAR(fit.volume, truth, 1e-6 * truth);
        CHECK_LE(ovoid_ellipsoid_compute_radii(&fit.ellipsoid).z, i % 2 ? 0x1p-24 : 0);
        made_destroy(&m);
    }
    made m = made_segment(ends, 2);
    CHECK_NEAR(fit_inner(&m, 0).volume, 5, 1e-14);
    made_destroy(&m);
    m = made_segment(ends, 1);
    ovoid_fit fit = fit_inner(&m, 0);
    CHECK(fit.volume == 0 && fit.converged && fit.ellipsoid.center.y == 2);
    made_destroy(&m);
}

// Thinner than doubles can hold an ellipsoid in, and a body far from its frame's origin: still inside, with a true gap.
static void check_hard(void) {
    uint64_t s = 71;
    for (int i = 0; i < 24; i++) {
        check_seed = s;
        double thin = pow(10, -8 - i / 3);
        mat3 a = mat3_diagonal(1, i % 2 ? thin : 1, thin);
        made m = mapped(made_random(20, 1, &s), i % 3 ? mat3_mul(mat3_random_rotation(&s), a) : a, vec3_make(0, 0, 0));
        ovoid_fit fit = fit_inner(&m, 0);
        CHECK_LE(0, fit.gap);
        CHECK_EQ(fit.converged, fit.gap <= 1e-6);
        made_destroy(&m);
    }
    check_seed = 0;
    made m = mapped(made_prism(9), mat3_diagonal(1, 1, 1), vec3_make(1e7, -1e7, 1e7));
    ovoid_fit fit = fit_inner(&m, 0);
    CHECK(fit.converged);
    CHECK_NEAR(fit.volume, 4 * PI / 3 * pow(cos(PI / 9), 2), 1e-7);
    made_destroy(&m);
}

static void check_contract(void) {
    made m = made_simplex();
    ovoid_fit fit;
    long allowed = 0;
    for (; allowed < 9; allowed++) {
        countdown c = {allowed, 0};
        ovoid_allocator allocator = countdown_make_allocator(&c);
        ovoid_code code = ovoid_ellipsoid_compute_inner(&m.p, &(ovoid_ellipsoid_options){0, &allocator}, &fit, NULL);
        CHECK_EQ(c.held, 0);
        if (code == OVOID_OK) break;
        CHECK_EQ(code, OVOID_ERROR_MEMORY);
    }
    CHECK(allowed >= 1 && allowed < 9);
    CHECK_EQ(ovoid_ellipsoid_compute_inner(NULL, NULL, &fit, NULL), OVOID_ERROR_ARGUMENT);
    CHECK_EQ(ovoid_ellipsoid_compute_inner(&m.p, NULL, NULL, NULL), OVOID_ERROR_ARGUMENT);
    CHECK_EQ(ovoid_ellipsoid_compute_inner(&m.p, &(ovoid_ellipsoid_options){.gap = -1}, &fit, NULL),
             OVOID_ERROR_ARGUMENT);
    CHECK_EQ(ovoid_ellipsoid_compute_inner(&m.p, &(ovoid_ellipsoid_options){.gap = NAN}, &fit, NULL),
             OVOID_ERROR_ARGUMENT);
    m.p.vertex_count = 0;
    CHECK_EQ(ovoid_ellipsoid_compute_inner(&m.p, NULL, &fit, NULL), OVOID_ERROR_ARGUMENT);
    made_destroy(&m);
}

// 10 000 vertices, 20 000 facets: what a fit costs is its steps, 2 at most here; four times as many would be another
// method.
static void check_cost(void) {
    made bodies[] = {made_sphere(50), made_prism(5000),
                     mapped(made_sphere(50), mat3_diagonal(1, 3, 0.01), (vec3){0, 0, 0})};
    for (int i = 0; i < 3; i++) {
        ovoid_fit fit = fit_inner(&bodies[i], 0);
        printf("inner, %u facets: %u iterations, gap %.2g\n", bodies[i].p.facet_count, fit.iterations, fit.gap);
        CHECK(fit.converged);
        CHECK_LE(fit.iterations, 8);
        made_destroy(&bodies[i]);
    }
}

int main(void) {
    check_closed_forms();
    check_brute_force();
    check_gaps();
    check_john();
    check_parallel();
    check_flat();
    check_hard();
    check_contract();
    check_cost();
    return check_end();
}
