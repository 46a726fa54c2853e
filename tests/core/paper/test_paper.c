// The paper's online steps. Truth: boxes whose exits are known by hand, and for random pairs the library's own proven
// bracket of the distance (its tests have the exact judge). Tolerance: 1e-12 of the pair's size for |Q1 Q2|, which is
// rounded; none for the lower bound, which is proven.
#include "ovoid/ovoid.h"

#include "check.h"

/// A shape with the tables of its inner ellipsoid.
typedef struct body {
    ovoid_shape *shape;
    ovoid_areas *areas;
} body;

static body body_make(ovoid_shape *shape, ovoid_split split, uint32_t k) {
    body b = {shape, NULL};
    if (!CHECK(shape != NULL)) exit(check_end());
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    ovoid_ellipsoid inner = ovoid_shape_get_inner(shape).ellipsoid;
    if (p.rank == 3) b.areas = ovoid_areas_create(&p, &inner, &(ovoid_areas_options){.split = split, .k = k}, NULL);
    return b;
}
static void body_destroy(body *b) {
    ovoid_areas_destroy(b->areas);
    ovoid_shape_destroy(b->shape);
}

static ovoid_pair pair_make(const body *a, const body *b, ovoid_vec3 at) {
    ovoid_pair pair = {a->shape, b->shape, ovoid_pose_make_identity(), ovoid_pose_make_identity()};
    pair.pose_b.position = at;
    return pair;
}

static void test_boxes(void) {
    body a = body_make(ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, NULL), OVOID_SPLIT_OCTANTS, 0);
    body b = body_make(ovoid_shape_create_box((ovoid_vec3){2, 1, 1}, NULL, NULL), OVOID_SPLIT_OCTANTS, 0);
    const ovoid_areas *areas[2] = {a.areas, b.areas};
    // Face to face, 3 apart. Inner ellipsoids have the half sizes as radii, outer ones sqrt(3) times them; 1e-6 of
    // volume.
    ovoid_pair pair = pair_make(&a, &b, (ovoid_vec3){6, 0, 0});
    ovoid_paper_bounds r = ovoid_paper_compute_bounds(&pair, areas, OVOID_RULE_RAY, 1);
    CHECK_NEAR(r.nearest.point_a.x, 1, 1e-5);
    CHECK_NEAR(r.nearest.point_b.x, 4, 1e-5);
    CHECK_NEAR(r.q1.x, 1, 1e-12);
    CHECK_NEAR(r.q2.x, 4, 1e-12);
    CHECK_NEAR(r.p1.x, sqrt(3), 1e-5);
    CHECK_NEAR(r.p2.x, 6 - 2 * sqrt(3), 1e-5);
    CHECK_NEAR(r.upper, 3, 1e-11);
    CHECK_NEAR(r.lower, 6 - 3 * sqrt(3), 1e-4);
    CHECK(!r.collides);
    // Deep in each other.
    pair.pose_b.position.x = 1;
    r = ovoid_paper_compute_bounds(&pair, areas, OVOID_RULE_RAY, 1);
    CHECK(r.nearest.overlap && r.upper == 0 && r.lower < 0 && r.collides);
    // The same place.
    pair.pose_b.position.x = 0;
    r = ovoid_paper_compute_bounds(&pair, areas, OVOID_RULE_RAY, 1);
    CHECK(r.nearest.overlap && r.upper == 0 && r.lower < 0 && r.collides);
    // A refused pose.
    pair.pose_b.position.x = NAN;
    r = ovoid_paper_compute_bounds(&pair, areas, OVOID_RULE_RAY, 1);
    CHECK(r.upper == INFINITY && r.lower == -INFINITY);
    body_destroy(&a);
    body_destroy(&b);
}

/// A flat body has no tables: its nearest point stands for its exit. Radii come off both bounds.
static void test_flat_and_round(void) {
    ovoid_shape_options round = {.radius = 0.25};
    body plate = body_make(ovoid_shape_create_box((ovoid_vec3){2, 2, 0}, &round, NULL), OVOID_SPLIT_OCTANTS, 0);
    body box = body_make(ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, &round, NULL), OVOID_SPLIT_CUBE, 4);
    CHECK(plate.areas == NULL);
    const ovoid_areas *areas[2] = {plate.areas, box.areas};
    ovoid_pair pair = pair_make(&plate, &box, (ovoid_vec3){0, 0, 4});
    ovoid_paper_bounds r = ovoid_paper_compute_bounds(&pair, areas, OVOID_RULE_RAY, 1);
    CHECK_NEAR(r.upper, 2.5, 1e-5);
    CHECK_LE(r.lower, 2.5);
    CHECK(r.faces > 0);
    body_destroy(&plate);
    body_destroy(&box);
}

/// Counts over the random pairs.
typedef struct tally {
    long pairs, wrong, apart;
    uint64_t faces[4];
} tally;

static void check_pair(const ovoid_pair *pair, const ovoid_areas *areas[2], tally *t) {
    ovoid_answer d = ovoid_distance(pair, NULL, NULL);
    double size = 20, upper = 0;
    for (ovoid_area_rule rule = OVOID_RULE_ALL; rule <= OVOID_RULE_PAPER; rule++) {
        ovoid_paper_bounds r = ovoid_paper_compute_bounds(pair, areas, rule, INFINITY);
        t->faces[rule] += r.faces;
        CHECK_LE(r.lower, d.upper);
        if (rule == OVOID_RULE_PAPER) continue;
        CHECK_LE(fmax(d.lower, 0), r.upper + 1e-12 * size);
        // The sound rules agree to the last bit.
        if (rule == OVOID_RULE_ALL) upper = r.upper;
        CHECK_EQ(r.upper, upper);
        if (rule != OVOID_RULE_RAY) continue;
        // The exits are points of the bodies: no nearer than the bodies are.
        t->pairs++;
        t->apart += d.lower > 0;
        t->wrong += r.collides != (d.upper <= 0);
    }
}

static void test_random(void) {
    tally t = {0};
    for (uint64_t seed = 1; seed <= 60; seed++) {
        uint64_t s = check_seed = seed;
        double xyz[2][3 * 40];
        for (int i = 0; i < 2 * 120; i++) xyz[i / 120][i % 120] = random_normal(&s);
        body a = body_make(ovoid_shape_create_from_points(xyz[0], 40, NULL, NULL), OVOID_SPLIT_CUBE, 4);
        body b = body_make(ovoid_shape_create_from_points(xyz[1], 40, NULL, NULL), OVOID_SPLIT_OCTANTS, 0);
        const ovoid_areas *areas[2] = {a.areas, b.areas};
        for (int i = 0; i < 20; i++) {
            ovoid_pair pair = pair_make(&a, &b, (ovoid_vec3){0, 0, 0});
            double far = random_uniform(&s, 0, 6);
            ovoid_vec3 n = {random_normal(&s), random_normal(&s), random_normal(&s)};
            double length = sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
            pair.pose_b.position = (ovoid_vec3){n.x * far / length, n.y * far / length, n.z * far / length};
            pair.pose_a.rotation = (ovoid_quat){random_normal(&s), random_normal(&s), random_normal(&s), 0.5};
            pair.pose_b.rotation = (ovoid_quat){random_normal(&s), 1, random_normal(&s), random_normal(&s)};
            check_pair(&pair, areas, &t);
        }
        body_destroy(&a);
        body_destroy(&b);
    }
    printf(
        "%ld pairs, %ld apart: the criterion is wrong for %ld; facets looked at per pair: all %.1f, signs %.1f, paper "
        "%.1f, ray %.1f\n",
        t.pairs, t.apart, t.wrong, (double)t.faces[OVOID_RULE_ALL] / (double)t.pairs,
        (double)t.faces[OVOID_RULE_SIGNS] / (double)t.pairs, (double)t.faces[OVOID_RULE_PAPER] / (double)t.pairs,
        (double)t.faces[OVOID_RULE_RAY] / (double)t.pairs);
    CHECK(t.apart > t.pairs / 4 && t.apart < t.pairs);
    CHECK(t.faces[OVOID_RULE_RAY] < t.faces[OVOID_RULE_PAPER] && t.faces[OVOID_RULE_PAPER] < t.faces[OVOID_RULE_ALL]);
}

int main(void) {
    test_boxes();
    test_flat_and_round();
    test_random();
    return check_end();
}
