// Do two ellipsoids share a point? Truth: pairs placed at a known gap (pairs.h), and for every "yes" the point itself,
// whose membership in both is computed in double-double, where 1 - 1e-12 and 1 are far apart.
#include "pairs.h"

enum { PAIRS_PER_KIND = 4000 };

static void check_common(const ovoid_ellipsoid *a, const ovoid_ellipsoid *b, vec3 x) {
    CHECK_LE(membership(a, x), 1 - 1e-12);
    CHECK_LE(membership(b, x), 1 - 1e-12);
}

/// Apart by any gap above rounding: never a yes. Overlapping: a yes, wherever doubles can know.
static void test_known_gap(void) {
    static const double gaps[] = {1e-13, 1e-9, 1e-4, 0.1, 3};
    for (kind k = 0; k < KIND_COUNT; k++) {
        long missed = 0, possible = 0;
        for (uint64_t seed = 1; seed <= PAIRS_PER_KIND; seed++) {
            uint64_t s = check_seed = seed;
            double gap = gaps[seed % 5];
            ovoid_ellipsoid a = make_ellipsoid(k, (vec3){0, 0, 0}, &s), b = make_ellipsoid(k, a.center, &s);
            ovoid_ellipsoid far = b;
            vec3 n = random_unit(&s), x;
            place(&a, &far, n, gap);
            CHECK(!ovoid_ellipsoid_is_overlapping(&a, &far, &x) && !ovoid_ellipsoid_is_overlapping(&far, &a, NULL));
            // Flat ones overlap nowhere that can be proven but at their centres.
            if (k == KIND_FLAT) continue;
            double least = fmin(sqrt(sym3_quadratic(a.q, n)), sqrt(sym3_quadratic(b.q, n)));
            place(&a, &b, n, -fmin(gap, least));
            int known = ovoid_ellipsoid_is_overlapping(&a, &b, &x);
            if (known && k <= KIND_THIN) check_common(&a, &b, x);
            if (gap >= 1e-9) {
                possible++;
                missed += !known;
            }
            if (k <= KIND_PLAIN && gap >= 1e-9) CHECK(known && ovoid_ellipsoid_is_overlapping(&b, &a, NULL));
        }
        printf("%s: overlap not proven for %ld of %ld pairs\n", kind_names[k], missed, possible);
    }
}

static void test_special(void) {
    vec3 x;
    ovoid_ellipsoid ball = {{0, 0, 0}, {1, 0, 0, 1, 0, 1}}, disc = {{0.5, 0, 0}, {4, 0, 0, 4, 0, 0}};
    ovoid_ellipsoid point = {{0.25, 0.5, 0}, {0, 0, 0, 0, 0, 0}}, outside = {{1, 0.5, 0}, {0, 0, 0, 0, 0, 0}};
    // Identical, and touching: at a common surface point nothing can be proven.
    CHECK(ovoid_ellipsoid_is_overlapping(&ball, &ball, &x));
    check_common(&ball, &ball, x);
    ovoid_ellipsoid touching = {{2, 0, 0}, {1, 0, 0, 1, 0, 1}};
    CHECK(!ovoid_ellipsoid_is_overlapping(&ball, &touching, &x));
    // A small one deep in a large one, off centre.
    ovoid_ellipsoid seed = {{0.9, 0.1, 0}, {1e-6, 0, 0, 1e-6, 0, 1e-6}};
    CHECK(ovoid_ellipsoid_is_overlapping(&ball, &seed, &x) && ovoid_ellipsoid_is_overlapping(&seed, &ball, &x));
    check_common(&ball, &seed, x);
    // Flat ones: by the centre, or not known.
    CHECK(ovoid_ellipsoid_is_overlapping(&ball, &disc, &x));
    CHECK(membership(&ball, x) < 1 && x.x == 0.5 && x.y == 0 && x.z == 0);
    CHECK(ovoid_ellipsoid_is_overlapping(&disc, &ball, &x));
    CHECK(x.x == 0.5 && x.y == 0 && x.z == 0);
    CHECK(ovoid_ellipsoid_is_overlapping(&ball, &point, &x));
    CHECK(!ovoid_ellipsoid_is_overlapping(&ball, &outside, &x));
    CHECK(!ovoid_ellipsoid_is_overlapping(&disc, &disc, &x));
    CHECK(!ovoid_ellipsoid_is_overlapping(&point, &point, &x));
}

static void test_scales(void) {
    static const double scales[] = {1e-9, 1e9, 1e-40, 1e40, 1e-120, 1e89};
    for (int i = 0; i < 6; i++)
        for (uint64_t seed = 1; seed <= 200; seed++) {
            uint64_t s = check_seed = seed;
            ovoid_ellipsoid a = make_ellipsoid(KIND_PLAIN, (vec3){0, 0, 0}, &s);
            ovoid_ellipsoid b = make_ellipsoid(KIND_PLAIN, a.center, &s), far = b;
            vec3 n = random_unit(&s), x = {0, 0, 0};
            place(&a, &b, n, -0.01);
            place(&a, &far, n, 0.01);
            ovoid_ellipsoid sa = scale_ellipsoid(a, scales[i]), sb = scale_ellipsoid(b, scales[i]);
            ovoid_ellipsoid sf = scale_ellipsoid(far, scales[i]);
            CHECK(ovoid_ellipsoid_is_overlapping(&sa, &sb, &x));
            CHECK(!ovoid_ellipsoid_is_overlapping(&sa, &sf, NULL));
            x = vec3_scale(x, 1 / scales[i]);
            CHECK_LE(fmax(membership(&a, x), membership(&b, x)), 1 - 1e-3 * 0.01);
        }
    // Far from the origin the point is rounded to 1e-9: still proven, with the rounding counted.
    for (uint64_t seed = 1; seed <= 200; seed++) {
        uint64_t s = check_seed = seed;
        ovoid_ellipsoid a = make_ellipsoid(KIND_PLAIN, (vec3){1e7, 1e7, -1e7}, &s);
        ovoid_ellipsoid b = make_ellipsoid(KIND_PLAIN, a.center, &s);
        vec3 x;
        place(&a, &b, random_unit(&s), -0.01);
        CHECK(ovoid_ellipsoid_is_overlapping(&a, &b, &x));
        check_common(&a, &b, x);
    }
}

int main(void) {
    test_known_gap();
    test_special();
    test_scales();
    return check_end();
}
