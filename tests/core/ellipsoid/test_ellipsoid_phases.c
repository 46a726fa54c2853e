// The three phases against closed forms and against the paper's own formulas with matrix square roots. That the results
// lie inside is judged in exact arithmetic by test_ellipsoid_exact.c.
#include "ellipsoid/contain.h"
#include "polytopes.h"

static const double PI = 3.14159265358979323846;

typedef struct steps {
    ovoid_fit outer, shrunk, stretched, enlarged;
} steps;

static steps run(const made *m) {
    steps s;
    CHECK_EQ(ovoid_ellipsoid_compute_outer(&m->p, &(ovoid_ellipsoid_options){.gap = 1e-9}, &s.outer, NULL), OVOID_OK);
    s.shrunk = ovoid_ellipsoid_compute_shrunk(&m->p, &s.outer.ellipsoid);
    s.stretched = ovoid_ellipsoid_compute_stretched(&m->p, &s.shrunk.ellipsoid);
    s.enlarged = ovoid_ellipsoid_compute_enlarged(&m->p, &s.stretched.ellipsoid);
    return s;
}

// The least of (d - n . c) / sqrt(n' Q n) over the facets: 1 where the ellipsoid touches.
static double compute_room(const made *m, const ovoid_ellipsoid *e) {
    double room = INFINITY;
    for (uint32_t f = 0; f < m->p.facet_count; f++) {
        const ovoid_plane *p = &m->planes[f];
        room = fmin(room, (p->offset - vec3_dot(p->normal, e->center)) / sqrt(sym3_quadratic(e->q, p->normal)));
    }
    return room;
}

// Box: shrinking the outer ellipsoid alone gives the largest ellipsoid, with the half sizes as radii. The bisection
// ends 2^-40 below, which costs 3 times that in volume.
static void check_box(void) {
    made m = made_box(1, 2, 3);
    steps s = run(&m);
    CHECK_NEAR(s.shrunk.volume, 8 * PI, 8 * PI * 4e-9);
    CHECK_NEAR(ovoid_ellipsoid_compute_radii(&s.shrunk.ellipsoid).x, 3, 1e-8);
    CHECK_NEAR(ovoid_ellipsoid_compute_radii(&s.shrunk.ellipsoid).z, 1, 1e-8);
    CHECK_NEAR(s.enlarged.volume, 8 * PI, 8 * PI * 4e-9);
    CHECK(isnan(s.shrunk.gap) && isnan(s.stretched.gap) && isnan(s.enlarged.gap));
    made_destroy(&m);
}

// Any body: never smaller from phase to phase, inside, and the first phase touches: the same centre and form as the
// outer one, with 1e-9 of room at most.
static void check_order(void) {
    uint64_t seed = 1;
    for (int i = 0; i < 60; i++) {
        check_seed = seed;
        made m = made_random(8 + (uint32_t)i, i & 1, &seed);
        if (i % 3 == 2) made_map(&m, mat3_diagonal(1, 0.1, 0.01), vec3_make(1, 2, 3));
        steps s = run(&m);
        CHECK(ellipsoid_is_enclosed(&m.p, &s.shrunk.ellipsoid));
        CHECK(ellipsoid_is_enclosed(&m.p, &s.stretched.ellipsoid));
        CHECK(ellipsoid_is_enclosed(&m.p, &s.enlarged.ellipsoid));
        CHECK_LE(s.shrunk.volume, s.stretched.volume);
        CHECK_LE(s.stretched.volume, s.enlarged.volume);
        CHECK_NEAR(compute_room(&m, &s.shrunk.ellipsoid), 1, 1e-9);
        double scale = s.shrunk.ellipsoid.q.xx / s.outer.ellipsoid.q.xx;
        CHECK_NEAR(s.shrunk.ellipsoid.q.xy, scale * s.outer.ellipsoid.q.xy, 1e-12 * s.outer.ellipsoid.q.xx);
        CHECK_NEAR(s.shrunk.ellipsoid.q.zz, scale * s.outer.ellipsoid.q.zz, 1e-12 * s.outer.ellipsoid.q.xx);
        // John's theorem: at least a third of the radii.
        CHECK_LE(1 / 3.0 - 1e-6, sqrt(scale));
        CHECK(s.stretched.beta >= 0 && s.stretched.beta <= 1);
        // Phase 3 leaves the centre.
        CHECK_EQ(s.enlarged.ellipsoid.center.x, s.stretched.ellipsoid.center.x);
        made_destroy(&m);
    }
    check_seed = 0;
}

// M^(1/2) by eigenvalues.
static sym3 compute_root(sym3 m, double power) {
    eigen3 e = sym3_compute_eigen(m);
    for (int i = 0; i < 3; i++) e.value[i] = pow(e.value[i], power);
    return sym3_from_eigen(e.value, e.v);
}

// Phase 2 as the paper writes it, at the beta that was found: c' = c + beta (s - c), M'^(1/2) = (I + (alpha - 1) a a')
// M^(1/2), from the facet that was named; s - c = l (s_m - c) / |s_m - c|.
static void check_stretch_formula(void) {
    uint64_t seed = 5;
    int moved = 0;
    for (int i = 0; i < 40; i++) {
        check_seed = seed;
        made m = made_random(14, 0, &seed);
        steps s = run(&m);
        const ovoid_ellipsoid *e = &s.shrunk.ellipsoid, *result = &s.stretched.ellipsoid;
        vec3 c = e->center, mean = {0, 0, 0};
        double farthest = 0;
        for (uint32_t f = 0; f < m.p.facet_count; f++)
            farthest = fmax(farthest, m.planes[f].offset - vec3_dot(m.planes[f].normal, c));
        const ovoid_plane *plane = &m.planes[s.stretched.facet];
        CHECK_EQ(plane->offset - vec3_dot(plane->normal, c), farthest);
        const uint32_t *t = m.triangles + 3 * s.stretched.facet;
        for (int k = 0; k < 3; k++) mean = vec3_add_scaled(mean, vec3_at(m.vertices, t[k]), 1 / 3.0);
        vec3 d = vec3_scale(vec3_unit(vec3_sub(mean, c)), farthest);
        sym3 root = compute_root(sym3_inverse(e->q), 0.5);
        vec3 md = sym3_mul_vec3(root, d), a = vec3_unit(md);
        double alpha = 1 / (1 + s.stretched.beta * vec3_norm(md));
        // M' = M^(1/2) (I + (alpha - 1) a a')^2 M^(1/2), as both factors are symmetric.
        sym3 middle = sym3_add(sym3_diagonal(1, 1, 1), sym3_outer(a, alpha * alpha - 1));
        sym3 stretched = sym3_rotate(
            middle, (mat3){{root.xx, root.xy, root.xz}, {root.xy, root.yy, root.yz}, {root.xz, root.yz, root.zz}});
        sym3 q = sym3_inverse(stretched);
        CHECK_NEAR(q.xx, result->q.xx, 1e-10);
        CHECK_NEAR(q.xy, result->q.xy, 1e-10);
        CHECK_NEAR(q.yz, result->q.yz, 1e-10);
        CHECK_NEAR(q.zz, result->q.zz, 1e-10);
        vec3 center = vec3_add_scaled(c, d, s.stretched.beta);
        CHECK_NEAR(vec3_norm(vec3_sub(center, result->center)), 0, 1e-12);
        // It goes as far as it can: a little more is outside.
        if (s.stretched.beta < 1) CHECK_NEAR(compute_room(&m, result), 1, 1e-9);
        moved += s.stretched.beta > 1e-3;
        made_destroy(&m);
    }
    CHECK(moved > 5);
    check_seed = 0;
}

// The mean of a facet of many triangles is that of its vertices: a prism that is cut short on one side has its farthest
// facet, a cap, elsewhere; the centre moves along the axis.
static void check_facet_mean(void) {
    made m = made_prism(9);
    ovoid_ellipsoid e = {{0, 0, -0.2}, {0.01, 0, 0, 0.01, 0, 0.01}};
    ovoid_fit fit = ovoid_ellipsoid_compute_stretched(&m.p, &e);
    CHECK_EQ(fit.facet, 10);
    CHECK_NEAR(fit.ellipsoid.center.x, 0, 1e-15);
    CHECK_NEAR(fit.ellipsoid.center.y, 0, 1e-15);
    // The point opposite stays: z from -0.3 to the cap.
    CHECK_NEAR(fit.ellipsoid.center.z, 0.35, 1e-9);
    CHECK_NEAR(fit.ellipsoid.q.zz, 0.65 * 0.65, 1e-9);
    CHECK_NEAR(fit.beta, 0.55 / 1.2, 1e-9);
    made_destroy(&m);
}

// Enlarging: from a ball in a box, each radius grows to its wall.
static void check_enlarge(void) {
    made m = made_box(1, 2, 3);
    ovoid_ellipsoid e = {{0.5, 0, 0}, {0.01, 0, 0, 0.02, 0, 0.03}};
    ovoid_fit fit = ovoid_ellipsoid_compute_enlarged(&m.p, &e);
    vec3 radii = ovoid_ellipsoid_compute_radii(&fit.ellipsoid);
    CHECK_NEAR(radii.x, 3, 1e-10);
    CHECK_NEAR(radii.y, 2, 1e-10);
    CHECK_NEAR(radii.z, 0.5, 1e-10);
    made_destroy(&m);
}

// The largest square of the semi-axis along an angle of an ellipse in a regular polygon of inradius `room`, where the
// other one has the square `across`: the least over the walls.
static double compute_axis(uint32_t sides, double room, double angle, double across) {
    double best = INFINITY;
    for (uint32_t i = 0; i < sides; i++) {
        double turn = (2 * i + 1) * PI / sides - angle, c = cos(turn) * cos(turn);
        best = fmin(best, (room * room - (1 - c) * across) / c);
    }
    return best;
}

// What the paper's three phases miss: of the largest ellipsoid's volume, cos^2(pi / n) 4 pi / 3 for a prism, they reach
// 71 % with 31 sides. Shrinking stops at the caps; a stretch toward a cap has no room; the first radius that grows
// stops the other. A prism longer along an angle has axes there: as those of the regular one, whose radii across are
// the root of 1/2 after shrinking, the shorter one first.
static void check_ratio(void) {
    const uint32_t sides[2] = {7, 31};
    const double angle = 0.35, c = cos(angle), s = sin(angle);
    for (int i = 0; i < 2; i++) {
        made m = made_prism(sides[i]);
        mat3 turn = {{c, s, 0}, {-s, c, 0}, {0, 0, 1}};
        made_map(&m, mat3_mul(mat3_transpose(turn), mat3_mul(mat3_diagonal(1.002, 1, 1), turn)), vec3_make(0, 0, 0));
        steps run_of = run(&m);
        double room = cos(PI / sides[i]), first = compute_axis(sides[i], room, angle + PI / 2, 0.5);
        double truth = sqrt(first * compute_axis(sides[i], room, angle, first)) / (room * room);
        double ratio = run_of.enlarged.volume / (1.002 * 4 * PI / 3 * room * room);
        printf("three phases, %u-sided prism: %.4f of the largest volume, beta %.1e\n", sides[i], ratio,
               run_of.stretched.beta);
        CHECK_NEAR(ratio, truth, 1e-5);
        CHECK_LE(run_of.stretched.beta, 1e-6);
        made_destroy(&m);
    }
}

// Flat bodies stay flat; a square's inscribed circle, a segment's whole length.
static void check_flat(void) {
    uint64_t seed = 3;
    const double square[12] = {1, 0, 0.3, 0, 1, 0.3, -1, 0, 0.3, 0, -1, 0.3}, ends[6] = {1, 2, 3, 4, -2, 3};
    for (int i = 0; i < 2; i++) {
        made m = made_polygon(square, 4);
        if (i) made_map(&m, mat3_random_rotation(&seed), vec3_make(1, 2, 3));
        steps s = run(&m);
        CHECK_NEAR(s.shrunk.volume, PI / 2, 1e-8);
        CHECK_NEAR(s.enlarged.volume, PI / 2, 1e-8);
        CHECK_LE(ovoid_ellipsoid_compute_radii(&s.enlarged.ellipsoid).z, i ? 0x1p-24 : 0);
        made_destroy(&m);
    }
    made m = made_segment(ends, 2);
    CHECK_NEAR(run(&m).enlarged.volume, 5, 1e-6);
    made_destroy(&m);
    m = made_segment(ends, 1);
    CHECK_EQ(run(&m).enlarged.volume, 0);
    made_destroy(&m);
}

int main(void) {
    check_box();
    check_order();
    check_stretch_formula();
    check_facet_mean();
    check_enlarge();
    check_ratio();
    check_flat();
    return check_end();
}
