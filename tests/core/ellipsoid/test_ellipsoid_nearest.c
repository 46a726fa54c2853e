// Nearest points of ellipsoids. Truth: closed forms; pairs placed so that the conditions of Karush, Kuhn and Tucker
// hold by construction (pairs.h); brute force over sampled points; and the certificate that each answer carries, lower
// <= true distance <= distance. Tolerance: 1e-12 of the pair's size, which the header promises; the construction itself
// is off by a few roundings, 1e-15.
#include "pairs.h"

enum { PAIRS_PER_KIND = 2000 };

static const double promised = 1e-12;

/// What must hold of every answer.
static void check_answer(const ovoid_ellipsoid *a, const ovoid_ellipsoid *b, const ovoid_nearest *r, double slack) {
    double size = size_of(a, b);
    CHECK(vec3_is_finite(r->point_a) && vec3_is_finite(r->point_b) && vec3_is_finite(r->normal));
    CHECK_NEAR(vec3_norm(r->normal), 1, 1e-15);
    CHECK_EQ(r->distance, vec3_norm(vec3_sub(r->point_b, r->point_a)));
    CHECK_LE(r->lower, r->distance);
    if (!r->overlap) CHECK_LE(r->distance - r->lower, slack * size);
    // The points lie in their bodies, up to the promise: no support plane cuts them off.
    uint64_t s = 77;
    for (int k = 0; k < 20; k++) {
        vec3 n = k == 0 ? r->normal : k == 1 ? vec3_neg(r->normal) : random_unit(&s);
        CHECK_LE(vec3_dot(n, vec3_sub(r->point_a, a->center)) - sqrt(fmax(0, sym3_quadratic(a->q, n))), 1e-7 * size);
        CHECK_LE(vec3_dot(n, vec3_sub(r->point_b, b->center)) - sqrt(fmax(0, sym3_quadratic(b->q, n))), 1e-7 * size);
    }
}

static void test_closed_forms(void) {
    ovoid_ellipsoid a = {{0, 0, 0}, {4, 0, 0, 1, 0, 0.25}}, b = {{10, 0, 0}, {9, 0, 0, 1, 0, 1}};
    ovoid_nearest r = ovoid_ellipsoid_compute_nearest(&a, &b);
    CHECK_NEAR(r.distance, 5, 1e-14);
    CHECK_NEAR(r.lower, 5, 1e-13);
    CHECK_NEAR(r.point_a.x, 2, 1e-14);
    CHECK_NEAR(r.point_b.x, 7, 1e-14);
    CHECK_NEAR(r.normal.x, 1, 1e-15);
    r = ovoid_ellipsoid_compute_nearest_by_sphere(&a, &b);
    CHECK_NEAR(r.distance, 5, 1e-14);

    // A unit sphere above a disc of radius 3: the nearest point is in the disc's interior.
    ovoid_ellipsoid disc = {{0, 0, 0}, {9, 0, 0, 9, 0, 0}}, sphere = {{1, 0.5, 4}, {1, 0, 0, 1, 0, 1}};
    r = ovoid_ellipsoid_compute_nearest(&disc, &sphere);
    CHECK_NEAR(r.distance, 3, 1e-13);
    CHECK_NEAR(r.lower, 3, 1e-13);
    CHECK_NEAR(r.point_a.x, 1, 1e-6);
    CHECK_NEAR(r.point_a.y, 0.5, 1e-6);
    r = ovoid_ellipsoid_compute_nearest_by_sphere(&disc, &sphere);
    CHECK_NEAR(r.distance, 3, 1e-13);

    // Two parallel discs that overlap in projection: a whole region is nearest.
    ovoid_ellipsoid above = {{2, 0, 1}, {9, 0, 0, 9, 0, 0}};
    r = ovoid_ellipsoid_compute_nearest(&disc, &above);
    CHECK_NEAR(r.distance, 1, 1e-13);
    CHECK_NEAR(r.lower, 1, 1e-13);

    // Crossing segments, and parallel ones.
    ovoid_ellipsoid along_x = {{0, 0, 0}, {1, 0, 0, 0, 0, 0}}, along_y = {{0.5, 0.25, 2}, {0, 0, 0, 1, 0, 0}};
    r = ovoid_ellipsoid_compute_nearest(&along_x, &along_y);
    CHECK_NEAR(r.distance, 2, 1e-13);
    CHECK_NEAR(r.point_a.x, 0.5, 1e-6);
    ovoid_ellipsoid parallel = {{0.5, 3, 0}, {1, 0, 0, 0, 0, 0}};
    r = ovoid_ellipsoid_compute_nearest(&along_x, &parallel);
    CHECK_NEAR(r.distance, 3, 1e-13);
    CHECK_NEAR(r.lower, 3, 1e-13);

    // Points.
    ovoid_ellipsoid point = {{1, 2, 3}, {0, 0, 0, 0, 0, 0}}, other = {{1, 2, 7}, {0, 0, 0, 0, 0, 0}};
    r = ovoid_ellipsoid_compute_nearest(&point, &other);
    CHECK_NEAR(r.distance, 4, 1e-14);
    CHECK_NEAR(r.lower, 4, 1e-13);
    r = ovoid_ellipsoid_compute_nearest(&point, &point);
    CHECK_EQ(r.distance, 0);
    CHECK_LE(r.lower, 0);
}

/// Ratio of radii 1e8, axis-aligned so that Q holds them exactly.
static void test_ratio(void) {
    ovoid_ellipsoid needle = {{0, 0, 0}, {1, 0, 0, 1e-16, 0, 1e-16}}, slab = {{0.3, 0.2, 1}, {1, 0, 0, 1, 0, 1e-16}};
    // The needle's radius at x is 1e-8 sqrt(1 - x^2), the slab's top likewise: both tops are at the needle's middle.
    ovoid_nearest r = ovoid_ellipsoid_compute_nearest(&needle, &slab);
    check_answer(&needle, &slab, &r, promised);
    CHECK_NEAR(r.distance, 1 - 2e-8, 1e-9);
    ovoid_ellipsoid end = {{2.5, 0, 0}, {1e-16, 0, 0, 1, 0, 1}};
    r = ovoid_ellipsoid_compute_nearest(&needle, &end);
    check_answer(&needle, &end, &r, promised);
    CHECK_NEAR(r.distance, 1.5 - 1e-8, 1e-14);
    for (uint64_t seed = 1; seed <= 200; seed++) {
        uint64_t s = check_seed = seed;
        ovoid_ellipsoid a = needle, b = seed & 1 ? slab : needle;
        b.q = (sym3){b.q.zz, 0, 0, b.q.xx, 0, b.q.yy};
        double gap = exp(random_uniform(&s, log(1e-3), log(10)));
        place(&a, &b, random_unit(&s), gap);
        r = ovoid_ellipsoid_compute_nearest(&a, &b);
        check_answer(&a, &b, &r, promised);
        CHECK_NEAR(r.distance, gap, promised * size_of(&a, &b));
    }
}

static void test_known_distance(void) {
    static const double gaps[] = {1e-10, 1e-6, 1e-3, 0.05, 0.7, 20};
    for (kind k = 0; k < KIND_COUNT; k++) {
        uint32_t worst_rounds = 0, total = 0;
        double worst = 0;
        for (uint64_t seed = 1; seed <= PAIRS_PER_KIND; seed++) {
            uint64_t s = check_seed = seed;
            double gap = gaps[seed % 6];
            ovoid_ellipsoid a = make_ellipsoid(k, (vec3){0, 0, 0}, &s), b = make_ellipsoid(k, a.center, &s);
            place(&a, &b, random_unit(&s), gap);
            ovoid_nearest r = ovoid_ellipsoid_compute_nearest(&a, &b);
            // A rotated flat Q is not flat in doubles: some 1e-8 thick, or not positive. The placing knows nothing of
            // that; the bracket does.
            double size = size_of(&a, &b), placed = k == KIND_FLAT ? 1e-7 : promised;
            check_answer(&a, &b, &r, promised);
            CHECK_NEAR(r.distance, gap, placed * size);
            CHECK_LE(r.lower, gap + 1e-2 * placed * size);
            CHECK(!r.overlap);
            worst = fmax(worst, (r.distance - r.lower) / size);
            worst_rounds = r.iterations > worst_rounds ? r.iterations : worst_rounds;
            total += r.iterations;

            // The other way round, the same distance.
            ovoid_nearest t = ovoid_ellipsoid_compute_nearest(&b, &a);
            CHECK_NEAR(t.distance, r.distance, promised * size);

            // The paper's points: in their bodies, no nearer than the nearest, and a direction that separates.
            ovoid_nearest p = ovoid_ellipsoid_compute_nearest_by_sphere(&a, &b);
            check_answer(&a, &b, &p, INFINITY);
            CHECK_LE(gap - 1e-7 * size, p.distance);
            CHECK_LE(p.lower, r.distance);
            if (k <= KIND_PLAIN && gap >= 1e-10) CHECK(!p.overlap && p.lower > 0);
        }
        printf("%s: bracket at most %.1e of the size, %.1f rounds on average, at most %u\n", kind_names[k], worst,
               (double)total / PAIRS_PER_KIND, worst_rounds);
    }
}

/// Lengths are free: 1e-9, 1e9 and the limits of the library; and far from the origin.
static void test_scales(void) {
    static const double scales[] = {1e-9, 1e9, 1e-60, 1e60, 1e-110, 1e89};
    for (int i = 0; i < 6; i++)
        for (uint64_t seed = 1; seed <= 300; seed++) {
            uint64_t s = check_seed = seed;
            kind k = (kind)(seed % KIND_COUNT);
            ovoid_ellipsoid a = make_ellipsoid(k, (vec3){0, 0, 0}, &s), b = make_ellipsoid(k, a.center, &s);
            place(&a, &b, random_unit(&s), 0.1);
            a = scale_ellipsoid(a, scales[i]);
            b = scale_ellipsoid(b, scales[i]);
            ovoid_nearest r = ovoid_ellipsoid_compute_nearest(&a, &b);
            CHECK_NEAR(r.distance / scales[i], 0.1, promised * 6);
            CHECK_LE(r.distance / scales[i] - r.lower / scales[i], promised * 6);
            // What rounding makes of a flat Q need not be positive semidefinite: 1e-17 too little is 3e-9 of a radius.
            r = ovoid_ellipsoid_compute_nearest_to_point(&a, b.center);
            CHECK_LE(r.distance / scales[i] - r.lower / scales[i], k == KIND_FLAT ? 1e-7 : promised * 6);
        }
    // A power of two changes no bit.
    uint64_t s = check_seed = 5;
    ovoid_ellipsoid a = make_ellipsoid(KIND_PLAIN, (vec3){0, 0, 0}, &s), b = make_ellipsoid(KIND_PLAIN, a.center, &s);
    place(&a, &b, random_unit(&s), 0.1);
    ovoid_nearest near_one = ovoid_ellipsoid_compute_nearest(&a, &b);
    a = scale_ellipsoid(a, 0x1p100);
    b = scale_ellipsoid(b, 0x1p100);
    CHECK_EQ(ovoid_ellipsoid_compute_nearest(&a, &b).distance, near_one.distance * 0x1p100);
    // Far away a coordinate holds only 1e7 times its rounding: the points are off by that, the lower bound is not.
    for (uint64_t seed = 1; seed <= 100; seed++) {
        s = check_seed = seed;
        a = make_ellipsoid(KIND_PLAIN, (vec3){1e7, -1e7, 1e7}, &s);
        b = make_ellipsoid(KIND_PLAIN, a.center, &s);
        place(&a, &b, random_unit(&s), 0.1);
        ovoid_nearest r = ovoid_ellipsoid_compute_nearest(&a, &b);
        CHECK_NEAR(r.distance, 0.1, 1e-8);
        CHECK_NEAR(r.lower, 0.1, 1e-8);
    }
}

/// No sampled pair of points is nearer than the lower bound, and none much nearer than the answer.
static void test_brute_force(void) {
    for (uint64_t seed = 1; seed <= 30; seed++) {
        uint64_t s = check_seed = seed;
        ovoid_ellipsoid a = make_ellipsoid(KIND_PLAIN, (vec3){0, 0, 0}, &s);
        ovoid_ellipsoid b = make_ellipsoid(KIND_PLAIN, (vec3){3 * random_normal(&s), 3 * random_normal(&s), 1}, &s);
        ovoid_nearest r = ovoid_ellipsoid_compute_nearest(&a, &b);
        for (int i = 0; i < 300; i++) {
            vec3 x = support_point(&a, random_unit(&s));
            ovoid_nearest t = ovoid_ellipsoid_compute_nearest_to_point(&b, x);
            CHECK_LE(r.lower, t.distance);
            CHECK_LE(r.distance - 1e-12, t.distance);
            for (int j = 0; j < 30; j++) {
                double d = vec3_norm(vec3_sub(support_point(&b, random_unit(&s)), x));
                CHECK_LE(r.lower, d);
                CHECK_LE(t.distance, d + 1e-12);
            }
        }
    }
}

static void test_touching_and_overlapping(void) {
    for (uint64_t seed = 1; seed <= 500; seed++) {
        uint64_t s = check_seed = seed;
        kind k = (kind)(seed % KIND_COUNT);
        ovoid_ellipsoid a = make_ellipsoid(k, (vec3){0, 0, 0}, &s), b = make_ellipsoid(k, a.center, &s);
        // Identical, concentric.
        ovoid_nearest r = ovoid_ellipsoid_compute_nearest(&a, &a);
        CHECK_LE(r.distance, 1e-13);
        CHECK_LE(r.lower, 0);
        r = ovoid_ellipsoid_compute_nearest(&a, &b);
        CHECK_LE(r.distance, 1e-13);
        CHECK_LE(r.lower, 0);
        // Touching: zero is in the bracket up to the roundings of the placing.
        place(&a, &b, random_unit(&s), 0);
        r = ovoid_ellipsoid_compute_nearest(&a, &b);
        CHECK_LE(r.distance, (k == KIND_FLAT ? 1e-7 : 1e-12) * size_of(&a, &b));
        CHECK_LE(r.lower, 1e-14 * size_of(&a, &b));
        // Overlapping.
        a = make_ellipsoid(KIND_PLAIN, (vec3){0, 0, 0}, &s);
        b = make_ellipsoid(KIND_PLAIN, a.center, &s);
        place(&a, &b, random_unit(&s), -0.01);
        r = ovoid_ellipsoid_compute_nearest(&a, &b);
        CHECK(r.overlap && r.distance == 0 && r.lower < 0);
        CHECK(membership(&a, r.point_a) < 1 && membership(&b, r.point_b) < 1);
        r = ovoid_ellipsoid_compute_nearest_by_sphere(&a, &b);
        CHECK(r.overlap && r.distance == 0 && r.lower < 0);
        CHECK_LE(membership(&a, r.point_a), 1 + 1e-12);
        CHECK_LE(membership(&b, r.point_b), 1 + 1e-12);
    }
}

static void test_point(void) {
    // In the plane of a disc, above it, beside it, at the centre.
    ovoid_ellipsoid disc = {{0, 0, 0}, {4, 0, 0, 1, 0, 0}};
    CHECK_EQ(ovoid_ellipsoid_compute_nearest_to_point(&disc, (vec3){0.5, 0.25, 0}).distance, 0);
    CHECK_NEAR(ovoid_ellipsoid_compute_nearest_to_point(&disc, (vec3){0.5, 0.25, -3}).distance, 3, 1e-15);
    CHECK_NEAR(ovoid_ellipsoid_compute_nearest_to_point(&disc, (vec3){5, 0, 4}).distance, 5, 1e-14);
    CHECK(ovoid_ellipsoid_compute_nearest_to_point(&disc, (vec3){0, 0, 0}).overlap);
    // On the axes of an ellipsoid, inside, on the surface, at the centre.
    ovoid_ellipsoid e = {{1, 1, 1}, {4, 0, 0, 1, 0, 0.25}};
    CHECK_NEAR(ovoid_ellipsoid_compute_nearest_to_point(&e, (vec3){4, 1, 1}).distance, 1, 1e-15);
    CHECK_NEAR(ovoid_ellipsoid_compute_nearest_to_point(&e, (vec3){1, 1, 0}).distance, 0.5, 1e-15);
    CHECK_EQ(ovoid_ellipsoid_compute_nearest_to_point(&e, (vec3){1, 1, 1}).distance, 0);
    CHECK_EQ(ovoid_ellipsoid_compute_nearest_to_point(&e, (vec3){2, 1, 1.25}).distance, 0);
    CHECK_NEAR(ovoid_ellipsoid_compute_nearest_to_point(&e, (vec3){3, 1, 1}).distance, 0, 1e-15);

    for (kind k = 0; k < KIND_COUNT; k++) {
        uint32_t worst = 0;
        for (uint64_t seed = 1; seed <= PAIRS_PER_KIND; seed++) {
            uint64_t s = check_seed = seed;
            ovoid_ellipsoid a = make_ellipsoid(k, (vec3){0.3, 0, -0.1}, &s);
            // Along the normal of a surface point: that point is the nearest.
            vec3 n = random_unit(&s), x = support_point(&a, n);
            double gap = exp(random_uniform(&s, log(1e-9), log(1e3)));
            vec3 y = vec3_add_scaled(x, n, gap);
            ovoid_ellipsoid b = {y, {0, 0, 0, 0, 0, 0}};
            ovoid_nearest r = ovoid_ellipsoid_compute_nearest_to_point(&a, y);
            double size = size_of(&a, &b);
            check_answer(&a, &b, &r, promised);
            CHECK_NEAR(r.distance, gap, promised * size + 1e-15);
            worst = r.iterations > worst ? r.iterations : worst;
        }
        printf("a point and %s: at most %u rounds\n", kind_names[k], worst);
    }
}

int main(void) {
    test_closed_forms();
    test_ratio();
    test_known_distance();
    test_scales();
    test_brute_force();
    test_touching_and_overlapping();
    test_point();
    return check_end();
}
