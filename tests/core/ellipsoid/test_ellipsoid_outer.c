// The outer ellipsoid against closed forms, an independent slow solver, and its own promises. Containment in exact
// arithmetic is in test_ellipsoid_exact.c. A volume V reported with gap g and a true optimum T: T <= V <= T (1 + g), up
// to the rounding of T here, 1e-12.
#include "countdown.h"
#include "ellipsoid/contain.h"
#include "polytopes.h"

static const double PI = 3.14159265358979323846;

static ovoid_fit fit_outer(const made *m, double gap) {
    ovoid_fit fit;
    CHECK_EQ(ovoid_ellipsoid_compute_outer(&m->p, &(ovoid_ellipsoid_options){.gap = gap}, &fit, NULL), OVOID_OK);
    CHECK(ellipsoid_is_enclosing(&m->p, &fit.ellipsoid));
    return fit;
}

// The fit of a body whose smallest volume is known; it is destroyed.
static void check_known(made m, double truth) {
    ovoid_fit fit = fit_outer(&m, 0);
    CHECK(fit.converged);
    CHECK_LE(fit.gap, 1e-6);
    CHECK_LE(truth * (1 - 1e-12), fit.volume);
    CHECK_LE(fit.volume, truth * (1 + fit.gap) * (1 + 1e-12));
    if (m.p.rank == 3) CHECK_NEAR(ovoid_ellipsoid_compute_volume(&fit.ellipsoid) / fit.volume, 1, 1e-13);
    made_destroy(&m);
}

static made mapped(made m, mat3 a, vec3 b) {
    made_map(&m, a, b);
    return m;
}

static void check_closed_forms(void) {
    uint64_t s = 1;
    const vec3 zero = {0, 0, 0};
    double ball = 4 * PI / 3;
    // Box of half sizes h: radii sqrt(3) h. Simplex and points of a sphere: the sphere. Prism: radius sqrt(3 / 2),
    // height sqrt(3), whatever the number of sides.
    check_known(made_box(1, 2, 3), ball * sqrt(27) * 6);
    check_known(mapped(made_box(1, 1, 1), mat3_random_rotation(&s), vec3_make(5, -7, 2)), ball * sqrt(27));
    check_known(made_simplex(), ball);
    check_known(made_sphere(10), ball);
    const uint32_t sides[] = {3, 4, 7, 31, 1000};
    for (int i = 0; i < 5; i++) check_known(made_prism(sides[i]), ball * 1.5 * sqrt(3));
    // Needles and slabs: any affine image of a sphere's points, along the axes and in any direction.
    for (int i = 0; i < 30; i++) {
        check_seed = s;
        double thin = pow(10, -i * 0.2), size = pow(10, random_uniform(&s, -80, 80));
        mat3 a = mat3_diagonal(size, i % 2 ? size : size * thin, size * thin);
        if (i % 3) a = mat3_mul(mat3_random_rotation(&s), mat3_mul(a, mat3_random_rotation(&s)));
        double det = vec3_dot(a.r0, vec3_cross(a.r1, a.r2));
        // The points are moved by rounding, 1e-16 of the size, which the thin axes feel.
        made m = mapped(made_sphere(4), a, zero);
        ovoid_fit fit = fit_outer(&m, 0);
        CHECK(fit.converged);
        CHECK_NEAR(fit.volume / (ball * det), 1, 1.1e-6 + 1e-14 / thin);
        made_destroy(&m);
    }
    check_seed = 0;
}

// The smallest volume by the multiplicative algorithm (D. M. Titterington, Optimal design, 1976): every weight times
// its variance over k + 1, again and again. Slow, short, and unlike the library's. Returns a lower bound and an upper
// one.
static void solve_slowly(const made *m, double *lower, double *upper) {
    uint32_t n = m->p.vertex_count;
    double *weight = malloc(n * sizeof *weight), top = 0, det = 0;
    for (uint32_t i = 0; i < n; i++) weight[i] = 1.0 / n;
    for (int step = 0; step < 20000; step++) {
        vec3 mean = {0, 0, 0};
        sym3 s = {0, 0, 0, 0, 0, 0};
        for (uint32_t i = 0; i < n; i++) mean = vec3_add_scaled(mean, vec3_at(m->vertices, i), weight[i]);
        for (uint32_t i = 0; i < n; i++)
            s = sym3_add(s, sym3_outer(vec3_sub(vec3_at(m->vertices, i), mean), weight[i]));
        sym3 inverse = sym3_inverse(s);
        det = sym3_det(s);
        top = 0;
        for (uint32_t i = 0; i < n; i++) {
            double d = sym3_quadratic(inverse, vec3_sub(vec3_at(m->vertices, i), mean));
            top = fmax(top, d);
            weight[i] *= (1 + d) / 4;
        }
    }
    *lower = 4 * PI / 3 * sqrt(27 * det);
    *upper = 4 * PI / 3 * sqrt(top * top * top * det);
    free(weight);
}

static void check_brute_force(void) {
    uint64_t s = 21;
    for (int i = 0; i < 12; i++) {
        check_seed = s;
        made m = made_random(5 + 3 * (uint32_t)i, i & 1, &s);
        double lower, upper;
        solve_slowly(&m, &lower, &upper);
        ovoid_fit fit = fit_outer(&m, 0);
        CHECK(fit.converged);
        CHECK_LE(fit.volume / (1 + fit.gap), upper * (1 + 1e-12));
        CHECK_LE(lower * (1 - 1e-12), fit.volume);
        CHECK_NEAR(fit.volume / upper, 1, 1e-3);
        // A finer gap and a coarser one are honoured, and agree with each other.
        ovoid_fit fine = fit_outer(&m, 1e-10), coarse = fit_outer(&m, 0.1);
        CHECK(fine.converged && coarse.converged);
        CHECK_LE(fine.gap, 1e-10);
        CHECK_LE(fine.volume, fit.volume * (1 + 1e-10));
        CHECK_LE(fit.volume, fine.volume * (1 + fit.gap));
        CHECK_LE(coarse.volume, fine.volume * (1 + coarse.gap));
        made_destroy(&m);
    }
    check_seed = 0;
}

// The fit of an affine image is the image of the fit, to the two gaps.
static void check_affine(void) {
    uint64_t s = 31;
    for (int i = 0; i < 20; i++) {
        check_seed = s;
        made m = made_random(60, 0, &s);
        ovoid_fit fit = fit_outer(&m, 1e-9);
        mat3 a = mat3_mul(mat3_random_rotation(&s), mat3_mul(mat3_diagonal(1, 30, 0.02), mat3_random_rotation(&s)));
        made_map(&m, a, vec3_make(3, 2, 1));
        ovoid_fit image = fit_outer(&m, 1e-9);
        CHECK_NEAR(image.volume / (fit.volume * 0.6), 1, 3e-9);
        vec3 moved = vec3_add(mat3_mul_vec3(a, fit.ellipsoid.center), vec3_make(3, 2, 1));
        // A centre is known to the root of the gap, times the size.
        CHECK_NEAR(vec3_norm(vec3_sub(moved, image.ellipsoid.center)), 0, 30 * 3 * sqrt(2e-9));
        made_destroy(&m);
    }
    check_seed = 0;
}

// Flat bodies: areas and lengths, with supports proven; flat in an axis exactly where the points are.
static void check_flat(void) {
    uint64_t s = 41;
    double xyz[3 * 12];
    for (int k = 0; k < 12; k++)
        xyz[3 * k] = 5 * cos(PI / 6 * k), xyz[3 * k + 1] = 2 * sin(PI / 6 * k), xyz[3 * k + 2] = 0.3;
    made m = made_polygon(xyz, 12);
    ovoid_fit fit = fit_outer(&m, 0);
    CHECK(fit.converged);
    CHECK_NEAR(fit.volume, 10 * PI, 10 * PI * 1e-6);
    CHECK(fit.ellipsoid.q.zz == 0 && fit.ellipsoid.q.xz == 0 && fit.ellipsoid.q.yz == 0);
    CHECK_EQ(fit.ellipsoid.center.z, 0.3);
    made_map(&m, mat3_random_rotation(&s), vec3_make(1, 2, 3));
    fit = fit_outer(&m, 0);
    vec3 radii = ovoid_ellipsoid_compute_radii(&fit.ellipsoid);
    CHECK(fit.converged);
    CHECK_NEAR(fit.volume, 10 * PI, 10 * PI * 1e-6);
    CHECK_NEAR(radii.y, 2, 1e-5);
    // The thickness that doubles cannot avoid: 2^-26 of the size or so.
    CHECK_LE(radii.z, 5 * 0x1p-24);
    made_destroy(&m);
    const double ends[6] = {1, 2, 3, 4, -2, 3}, along[6] = {-7, 2, 3, 5, 2, 3};
    m = made_segment(ends, 2);
    fit = fit_outer(&m, 0);
    CHECK_NEAR(fit.volume, 5, 5e-8);
    made_destroy(&m);
    m = made_segment(along, 2);
    fit = fit_outer(&m, 0);
    CHECK_NEAR(fit.volume, 12, 1e-12);
    CHECK_EQ(ovoid_ellipsoid_compute_radii(&fit.ellipsoid).y, 0);
    made_destroy(&m);
    m = made_segment(along, 1);
    fit = fit_outer(&m, 0);
    CHECK(fit.volume == 0 && fit.gap == 0 && fit.converged && fit.ellipsoid.center.x == -7);
    made_destroy(&m);
}

// Near-coplanar and doubled points, a thickness of a few roundings, and a body far from its frame's origin: enclosed,
// with the gap that is true, though it may not be the one asked for.
static void check_hard(void) {
    uint64_t s = 51;
    for (int i = 0; i < 40; i++) {
        check_seed = s;
        made m = made_random(30, 1, &s);
        double thin = pow(10, -10 - i % 6);
        mat3 a = mat3_diagonal(1, i % 4 == 3 ? thin : 1, thin);
        made_map(&m, i % 2 ? mat3_mul(mat3_random_rotation(&s), a) : a, vec3_make(0, 0, 0));
        // As a solid, and as what a hull of it may be called.
        m.p.rank = i % 4 == 3 ? 1 : i % 3 ? 3 : 2;
        memcpy(m.vertices + 3, m.vertices, 3 * sizeof(double));
        ovoid_fit fit = fit_outer(&m, 0);
        CHECK(fit.gap >= 0);
        CHECK_EQ(fit.converged, fit.gap <= 1e-6);
        made_destroy(&m);
    }
    check_seed = 0;
    made m = made_sphere(5);
    made_map(&m, mat3_diagonal(1, 1, 1), vec3_make(1e7, -1e7, 1e7));
    ovoid_fit fit = fit_outer(&m, 0);
    // The points are rounded by 1e-9, and so is the centre.
    CHECK_NEAR(fit.volume, 4 * PI / 3, 1e-7);
    CHECK(fit.converged);
    made_destroy(&m);
    // One point beside a plane of many.
    double xyz[3 * 41] = {0};
    for (int k = 0; k < 40; k++) xyz[3 * k] = cos(k), xyz[3 * k + 1] = sin(k), xyz[3 * k + 2] = 0.1;
    xyz[3 * 40 + 2] = nextafter(0.1, 1);
    m = made_polygon(xyz, 41);
    fit = fit_outer(&m, 0);
    CHECK_NEAR(fit.volume, PI, 0.05);
    made_destroy(&m);
}

// Points that are nearly, not quite, on one ellipsoid: any ten of many would do, and exchanges alone crawl.
static void check_nearly_round(void) {
    for (int i = 0; i < 12; i++) {
        uint64_t s = check_seed = 500 + (uint64_t)i;
        uint32_t count = 200 + 100 * (uint32_t)i;
        double *xyz = malloc(sizeof *xyz * 3 * count);
        for (uint32_t k = 0; k < count; k++) {
            double x = random_normal(&s), y = random_normal(&s), z = random_normal(&s);
            double r = sqrt(x * x + y * y + z * z) * (1 + pow(10, -2 - i % 6) * random_normal(&s));
            xyz[3 * k] = x / r, xyz[3 * k + 1] = 2 * y / r, xyz[3 * k + 2] = 3 * z / r;
        }
        made m = made_hull(xyz, count);
        ovoid_fit fit;
        CHECK_EQ(ovoid_ellipsoid_compute_outer(&m.p, NULL, &fit, NULL), OVOID_OK);
        CHECK(fit.converged);
        CHECK_LE(fit.iterations, 20000);
        made_destroy(&m);
        free(xyz);
    }
}

static void check_contract(void) {
    made m = made_simplex();
    ovoid_fit fit;
    long allowed = 0;
    fit.volume = 0;
    for (; allowed < 9; allowed++) {
        countdown c = {allowed, 0};
        ovoid_allocator allocator = countdown_make_allocator(&c);
        ovoid_code code = ovoid_ellipsoid_compute_outer(&m.p, &(ovoid_ellipsoid_options){0, &allocator}, &fit, NULL);
        CHECK_EQ(c.held, 0);
        if (code == OVOID_OK) break;
        CHECK_EQ(code, OVOID_ERROR_MEMORY);
    }
    CHECK(allowed >= 1 && allowed < 9);
    CHECK_EQ(ovoid_ellipsoid_compute_outer(NULL, NULL, &fit, NULL), OVOID_ERROR_ARGUMENT);
    CHECK_EQ(ovoid_ellipsoid_compute_outer(&m.p, NULL, NULL, NULL), OVOID_ERROR_ARGUMENT);
    CHECK_EQ(ovoid_ellipsoid_compute_outer(&m.p, &(ovoid_ellipsoid_options){.gap = -1}, &fit, NULL),
             OVOID_ERROR_ARGUMENT);
    CHECK_EQ(ovoid_ellipsoid_compute_outer(&m.p, &(ovoid_ellipsoid_options){.gap = NAN}, &fit, NULL),
             OVOID_ERROR_ARGUMENT);
    m.p.vertex_count = 0;
    CHECK_EQ(ovoid_ellipsoid_compute_outer(&m.p, NULL, &fit, NULL), OVOID_ERROR_ARGUMENT);
    made_destroy(&m);
}

// 10 000 vertices: on a sphere, where all of them matter, a prism, and random ones on an ellipsoid, most of them near
// the optimum's surface. What a fit costs is its steps, each on some ten vertices, and not many more passes over all:
// 5, 3 and 5 of them; four times as many would be another method.
static void check_cost(void) {
    uint64_t s = 61;
    static const uint32_t most[] = {20, 12, 20};
    made bodies[] = {made_sphere(50), made_prism(5000), made_sphere(50)};
    for (uint32_t v = 0; v < bodies[2].p.vertex_count; v++) {
        vec3 x = vec3_unit(vec3_random(&s));
        memcpy(bodies[2].vertices + 3 * v, &(vec3){x.x, 3 * x.y, 0.01 * x.z}, sizeof x);
    }
    for (int i = 0; i < 3; i++) {
        ovoid_fit fit = fit_outer(&bodies[i], 0);
        printf("outer, %u vertices: %u steps, gap %.2g\n", bodies[i].p.vertex_count, fit.iterations, fit.gap);
        CHECK(fit.converged);
        CHECK_LE(fit.iterations, most[i]);
        made_destroy(&bodies[i]);
    }
}

int main(void) {
    check_closed_forms();
    check_brute_force();
    check_affine();
    check_flat();
    check_hard();
    check_nearly_round();
    check_contract();
    check_cost();
    return check_end();
}
