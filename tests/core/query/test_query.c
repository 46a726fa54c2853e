// The queries against closed forms, and the meaning of each field of an answer. The truth is a formula; the tolerance
// is the bracket that the library itself promises: 1e-9 of the pair's size, and the truth inside the bracket (with
// 1e-13 of the size for the rounding of the formula itself).
#include "check.h"
#include "ovoid/ovoid.h"
#include "proofs/covers.h"

static const ovoid_quat unturned = {1, 0, 0, 0};

static ovoid_pose at(double x, double y, double z) { return (ovoid_pose){{x, y, z}, unturned}; }

static ovoid_shape *box(double x, double y, double z, double radius) {
    ovoid_shape_options o = {.radius = radius};
    return ovoid_shape_create_box((ovoid_vec3){x, y, z}, &o, NULL);
}

static ovoid_shape *points(const double *xyz, size_t count, double radius) {
    ovoid_shape_options o = {.radius = radius};
    return ovoid_shape_create_from_points(xyz, count, &o, NULL);
}

static double size_of(const ovoid_pair *p) {
    ovoid_vec3 a = p->pose_a.position, b = p->pose_b.position;
    double reach_a = ovoid_shape_get_measures(p->shape_a).sphere_radius + ovoid_shape_get_radius(p->shape_a);
    double reach_b = ovoid_shape_get_measures(p->shape_b).sphere_radius + ovoid_shape_get_radius(p->shape_b);
    return reach_a + reach_b + sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z));
}

static int holds(const ovoid_pair *p, const ovoid_answer *x, const ovoid_cover *cover) {
    ovoid_error error = {OVOID_OK, 0, ""};
    if (ovoid_answer_verify(p, x, &(ovoid_answer_basis){.cover = cover}, &error) == OVOID_OK) return 1;
    printf("%s\n", error.message);
    return 0;
}

// All five questions about a pair whose signed distance is known.
static void check_pair(const ovoid_pair *p, double truth) {
    STATIC_COVER(cover);
    double size = size_of(p), margin = 0.25 * size + 1e-100, slack = 1e-13 * size, tolerance = 2e-9 * size + 1e-128;
    int sign = truth > slack ? 1 : truth < -slack ? -1 : 0;
    ovoid_answer x[5] = {ovoid_collide(p, NULL, NULL), ovoid_within(p, margin, NULL, NULL),
                         ovoid_distance(p, NULL, NULL), ovoid_depth(p, NULL, NULL, &cover),
                         ovoid_pair_compute_bounds(p)};
    for (int i = 0; i < 5; i++) {
        CHECK_LE(x[i].lower, truth + slack);
        CHECK_LE(truth - slack, x[i].upper);
        CHECK(holds(p, &x[i], i == 3 ? &cover : NULL));
    }
    // The sign is decided by all but the bounds.
    ovoid_status expected = sign > 0 ? OVOID_SEPARATED : sign < 0 ? OVOID_OVERLAPPING : OVOID_TOUCHING;
    CHECK_EQ(x[0].status, expected);
    CHECK_EQ(x[2].status, expected);
    CHECK_EQ(x[3].status, expected);
    CHECK_EQ(ovoid_answer_is_within(&x[1], margin), truth <= margin);
    // The depth query measures on both sides of zero; its points are d normal apart.
    CHECK_LE(x[3].upper - x[3].lower, tolerance);
    CHECK_EQ(x[3].limit, OVOID_LIMIT_NONE);
    CHECK_EQ(ovoid_answer_get_distance(&x[3]), x[3].lower);
    CHECK_NEAR(ovoid_answer_get_distance(&x[3]), truth, tolerance);
    // What was not measured is no number.
    CHECK(x[2].limit == OVOID_LIMIT_NONE || isnan(ovoid_answer_get_distance(&x[2])));
    ovoid_vec3 a = x[3].point_a, b = x[3].point_b, n = x[3].normal;
    CHECK_NEAR(b.x - a.x, truth * n.x, tolerance);
    CHECK_NEAR(b.y - a.y, truth * n.y, tolerance);
    CHECK_NEAR(b.z - a.z, truth * n.z, tolerance);
    if (sign >= 0) CHECK_LE(x[2].upper - x[2].lower, tolerance);
    // Every proof is a warm start for every question, whoever asked before.
    for (int i = 0; i < 5; i++) {
        ovoid_answer warm = ovoid_depth(p, NULL, &x[i].proof, &cover);
        CHECK(holds(p, &warm, &cover));
        CHECK_EQ(warm.status, expected);
        CHECK_LE(warm.upper - warm.lower, tolerance);
        CHECK_EQ(ovoid_collide(p, NULL, &x[i].proof).status, expected);
    }
}

static void check_both_ways(ovoid_shape *a, ovoid_shape *b, ovoid_pose pose_a, ovoid_pose pose_b, double truth) {
    ovoid_pair p = {a, b, pose_a, pose_b}, q = {b, a, pose_b, pose_a};
    CHECK(a && b);
    if (!a || !b) return;
    check_pair(&p, truth);
    check_pair(&q, truth);
    // The same scene turned and moved as a whole: an exact quarter turn about z.
    ovoid_quat turn = {1, 0, 0, 1};
    p.pose_a.rotation = p.pose_b.rotation = turn;
    p.pose_a.position = (ovoid_vec3){-pose_a.position.y + 3, pose_a.position.x - 5, pose_a.position.z + 7};
    p.pose_b.position = (ovoid_vec3){-pose_b.position.y + 3, pose_b.position.x - 5, pose_b.position.z + 7};
    check_pair(&p, truth);
}

static void check_boxes(void) {
    ovoid_shape *a = box(1, 1, 1, 0), *b = box(0.5, 2, 0.25, 0), *r = box(1, 1, 1, 0.5);
    check_both_ways(a, b, at(0, 0, 0), at(2, 0, 0), 0.5);                // face to face
    check_both_ways(a, b, at(0, 0, 0), at(1.5 + 3, 3 + 4, 0), 5);        // edge to edge
    check_both_ways(a, b, at(0, 0, 0), at(1.5 + 2, 3 + 3, 1.25 + 6), 7); // corner to corner
    check_both_ways(a, b, at(0, 0, 0), at(1.5, 0, 0), 0);                // touching faces
    check_both_ways(a, b, at(0, 0, 0), at(1.5, 3, 0), 0);                // touching edges
    check_both_ways(a, b, at(0, 0, 0), at(1.5, 3, 1.25), 0);             // touching corners
    check_both_ways(a, b, at(0, 0, 0), at(1.375, 0, 0), -0.125);         // slight overlap
    check_both_ways(a, b, at(0, 0, 0), at(0, 0, 0), -1.25);              // concentric
    check_both_ways(a, a, at(0, 0, 0), at(0, 0, 0), -2);                 // identical poses
    check_both_ways(a, a, at(0, 0, 0), at(0.5, 0.25, 0), -1.5);
    check_both_ways(r, a, at(0, 0, 0), at(3, 0, 0), 0.5); // rounded
    check_both_ways(r, a, at(0, 0, 0), at(2.5, 0, 0), 0);
    check_both_ways(r, r, at(0, 0, 0), at(2.5, 0, 0), -0.5);
    check_both_ways(r, r, at(0, 0, 0), at(2, 0, 0), -1);     // cores touch
    check_both_ways(r, r, at(0, 0, 0), at(1.5, 0, 0), -1.5); // cores overlap
    ovoid_shape_destroy(a);
    ovoid_shape_destroy(b);
    ovoid_shape_destroy(r);
}

static void check_round(void) {
    ovoid_shape *s = ovoid_shape_create_sphere(1, NULL, NULL), *t = ovoid_shape_create_sphere(0.5, NULL, NULL);
    ovoid_shape *c = ovoid_shape_create_capsule(0.5, 2, NULL, NULL);
    check_both_ways(s, t, at(0, 0, 0), at(2, 3, 6), 5.5);
    check_both_ways(s, t, at(0, 0, 0), at(0, 0.25, 0), -1.25);
    check_both_ways(s, t, at(1, 1, 1), at(1, 1, 1), -1.5); // concentric spheres
    check_both_ways(s, t, at(0, 0, 0), at(1.5, 0, 0), 0);
    check_both_ways(s, c, at(0, 0, 0), at(3, 0, 1), 1.5);    // beside the capsule
    check_both_ways(s, c, at(0, 0, 0), at(0, 0, 4), 0.5);    // on its axis
    check_both_ways(c, c, at(0, 0, 0), at(0.5, 0, 1), -0.5); // side by side
    check_both_ways(c, c, at(0, 0, 0), at(0, 0, 3), -1);     // segments overlap: free across, depth 2 r
    ovoid_shape_destroy(s);
    ovoid_shape_destroy(t);
    ovoid_shape_destroy(c);
}

// Points, segments, flat polygons.
static void check_flat(void) {
    double one[3] = {0, 0, 0}, line[6] = {-1, 0, 0, 1, 0, 0}, across[6] = {0, -1, 0, 0, 1, 0};
    double square[12] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
    ovoid_shape *p = points(one, 1, 0), *l = points(line, 2, 0), *m = points(across, 2, 0), *q = points(square, 4, 0);
    check_both_ways(p, p, at(0, 0, 0), at(2, 3, 6), 7);
    check_both_ways(p, p, at(1, 2, 3), at(1, 2, 3), 0);
    check_both_ways(p, l, at(0, 0, 0), at(0, 3, 4), 5);
    check_both_ways(p, l, at(0, 0, 0), at(0.5, 0, 0), 0);
    check_both_ways(l, m, at(0, 0, 0), at(0, 0, 2), 2);
    check_both_ways(l, m, at(0, 0, 0), at(0.25, 0.5, 0), 0); // crossing in one plane
    check_both_ways(l, l, at(0, 0, 0), at(5, 0, 0), 3);      // on one line
    check_both_ways(l, l, at(0, 0, 0), at(1, 0, 0), 0);
    check_both_ways(p, q, at(0, 0, 0), at(0.25, 0.5, 1), 1);
    check_both_ways(p, q, at(0, 0, 0), at(0.25, 0.5, 0), 0); // point in the polygon
    check_both_ways(q, q, at(0, 0, 0), at(0.5, 0.5, 0), 0);  // coplanar, overlapping in the plane
    check_both_ways(q, q, at(0, 0, 0), at(5, 0, 0), 3);      // coplanar, apart
    check_both_ways(q, l, at(0, 0, 0), at(0, 0, 0), 0);
    ovoid_shape *b = box(2, 2, 2, 0);
    check_both_ways(b, p, at(0, 0, 0), at(0.5, 0, 0), -1.5); // depth of a point
    check_both_ways(b, q, at(0, 0, 0), at(0, 0, 1.75), -0.25);
    check_both_ways(b, l, at(0, 0, 0), at(0, 0, 0), -2);
    ovoid_shape *all[5] = {p, l, m, q, b};
    for (int i = 0; i < 5; i++) ovoid_shape_destroy(all[i]);
}

// The centre of an octahedron: no four of its corners prove the overlap, six do.
static void check_octahedron(void) {
    double xyz[18] = {1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1}, zero[3] = {0, 0, 0};
    ovoid_shape *o = points(xyz, 6, 0), *p = points(zero, 1, 0);
    check_both_ways(o, p, at(0, 0, 0), at(0, 0, 0), -1 / sqrt(3));
    ovoid_pair pair = {o, p, at(0, 0, 0), at(0, 0, 0)};
    ovoid_answer x = ovoid_collide(&pair, NULL, NULL);
    CHECK_EQ(x.proof.kind, OVOID_PROOF_HULL);
    CHECK_EQ(x.proof.count, 6);
    ovoid_shape_destroy(o);
    ovoid_shape_destroy(p);
}

// Scales, and far from the origin: only the relations between the numbers matter.
static void check_scales(void) {
    static const double scales[] = {1e-30, 1e-9, 1, 1e9, 1e30};
    for (int i = 0; i < 5; i++) {
        double k = scales[i];
        ovoid_shape *a = box(k, k, k, 0), *b = box(0.5 * k, 2 * k, 0.25 * k, 0.125 * k);
        ovoid_pair p = {a, b, at(0, 0, 0), at(2 * k, 0, 0)};
        check_pair(&p, 0.375 * k);
        p.pose_b = at(1.5 * k, 0, 0);
        check_pair(&p, -0.125 * k);
        // Both far away, where a coordinate still has the digits: powers of two.
        p.pose_a = at(0x1p24 * k, -0x1p24 * k, 0x1p24 * k);
        p.pose_b = at(0x1p24 * k + 2 * k, -0x1p24 * k, 0x1p24 * k);
        check_pair(&p, p.pose_b.position.x - p.pose_a.position.x - 1.5 * k - 0.125 * k);
        ovoid_shape_destroy(a);
        ovoid_shape_destroy(b);
    }
    // Vertices far from their own frame's origin; the pose turns them.
    double xyz[24];
    for (int i = 0; i < 8; i++) {
        xyz[3 * i] = 0x1p23 + (i & 1 ? 1 : -1);
        xyz[3 * i + 1] = -0x1p23 + (i & 2 ? 1 : -1);
        xyz[3 * i + 2] = i & 4 ? 1 : -1;
    }
    ovoid_shape *far = points(xyz, 8, 0), *near = box(1, 1, 1, 0);
    // A quarter turn about z takes (x, y) to (-y, x): the box is at (2^23, 2^23).
    ovoid_pair p = {far, near, {{0, 0, 0}, {1, 0, 0, 1}}, at(0x1p23 + 3, 0x1p23, 0)};
    check_pair(&p, 1);
    ovoid_shape_destroy(far);
    ovoid_shape_destroy(near);
}

static void check_options(void) {
    ovoid_shape *a = box(1, 1, 1, 0);
    ovoid_pair p = {a, a, at(0, 0, 0), at(3, 0.5, 0)};
    // A cap below the distance stops early, and says so; the bracket is true.
    ovoid_options o = {.cap = 0.25};
    ovoid_answer x = ovoid_distance(&p, &o, NULL);
    CHECK_EQ(x.limit, OVOID_LIMIT_CAP);
    CHECK(x.lower > 0.25 && x.lower <= 1 && x.upper >= 1 && holds(&p, &x, NULL));
    // A cap above it does not.
    o.cap = 2;
    x = ovoid_distance(&p, &o, NULL);
    CHECK_EQ(x.limit, OVOID_LIMIT_NONE);
    // One iteration: a true bracket, and the limit named.
    p.pose_b = (ovoid_pose){{2.4, 1.1, 0.7}, {0.9, 0.1, -0.3, 0.2}};
    o = (ovoid_options){.iterations = 1};
    LOCAL_COVER(cover);
    x = ovoid_depth(&p, &o, NULL, &cover);
    CHECK(x.lower <= x.upper && (x.limit == OVOID_LIMIT_ITERATIONS || x.limit == OVOID_LIMIT_NONE) &&
          holds(&p, &x, &cover));
    // A wide tolerance is used.
    o = (ovoid_options){.absolute_tolerance = 0.5};
    x = ovoid_distance(&p, &o, NULL);
    CHECK_LE(x.upper - x.lower, 0.5);
    // A margin met exactly: the bracket straddles it, and is narrow.
    p.pose_b = at(3, 0, 0);
    x = ovoid_within(&p, 1, NULL, NULL);
    CHECK_EQ(ovoid_answer_is_within(&x, 1), -1);
    CHECK_LE(x.upper - x.lower, 1e-8);
    CHECK_EQ(ovoid_answer_is_within(&x, 1.001), 1);
    CHECK_EQ(ovoid_answer_is_within(&x, 0.999), 0);
    ovoid_shape_destroy(a);
}

static void check_refused(void) {
    ovoid_shape *a = box(1, 1, 1, 0);
    ovoid_pair p = {a, a, at(0, 0, 0), at(3, 0, 0)}, bad;
    bad = p;
    bad.pose_a.position.x = NAN;
    CHECK_EQ(ovoid_collide(&bad, NULL, NULL).limit, OVOID_LIMIT_POSE_A);
    bad = p;
    bad.pose_b.rotation = (ovoid_quat){0, 0, 0, 0};
    ovoid_answer x = ovoid_depth(&bad, NULL, NULL, NULL);
    CHECK_EQ(x.limit, OVOID_LIMIT_POSE_B);
    CHECK(x.status == OVOID_UNDECIDED && x.lower == -INFINITY && x.upper == INFINITY);
    CHECK_EQ(ovoid_answer_verify(&bad, &x, NULL, NULL), OVOID_OK);
    x.upper = 1;
    CHECK_EQ(ovoid_answer_verify(&bad, &x, NULL, NULL), OVOID_ERROR_PROOF);
    bad.pose_b.rotation.x = INFINITY;
    CHECK_EQ(ovoid_pair_compute_bounds(&bad).limit, OVOID_LIMIT_POSE_B);
    bad = p;
    bad.pose_b.position.z = 1e51;
    CHECK_EQ(ovoid_distance(&bad, NULL, NULL).limit, OVOID_LIMIT_POSE_B);
    ovoid_options o = {.relative_tolerance = NAN};
    CHECK_EQ(ovoid_collide(&p, &o, NULL).limit, OVOID_LIMIT_OPTIONS);
    o = (ovoid_options){.absolute_tolerance = -1};
    CHECK_EQ(ovoid_distance(&p, &o, NULL).limit, OVOID_LIMIT_OPTIONS);
    o = (ovoid_options){.cap = NAN};
    CHECK_EQ(ovoid_distance(&p, &o, NULL).limit, OVOID_LIMIT_OPTIONS);
    CHECK_EQ(ovoid_within(&p, -1, NULL, NULL).limit, OVOID_LIMIT_OPTIONS);
    CHECK_EQ(ovoid_within(&p, NAN, NULL, NULL).limit, OVOID_LIMIT_OPTIONS);
    ovoid_shape_destroy(a);
}

// Proofs of another pair, with indices out of range, with numbers that are none: the answer is as good as without.
static void check_foreign_proofs(void) {
    ovoid_shape *a = box(1, 1, 1, 0), *c = ovoid_shape_create_prism(&(ovoid_prism){1, 1, 20}, NULL, NULL);
    ovoid_pair p = {a, a, at(0, 0, 0), at(3, 0, 0)}, other = {c, c, at(0, 0, 0), at(0.5, 0.3, 0.1)};
    ovoid_proof proofs[4] = {
        ovoid_depth(&other, NULL, NULL, NULL).proof, {.count = 77}, {.normal = {NAN, 0, 0}}, {.count = 1}};
    for (int i = 0; i < 4; i++) {
        ovoid_answer x = ovoid_distance(&p, NULL, &proofs[i]);
        CHECK_EQ(x.status, OVOID_SEPARATED);
        CHECK(x.lower <= 1 && x.upper >= 1 && x.upper - x.lower < 1e-8 && holds(&p, &x, NULL));
    }
    ovoid_shape_destroy(a);
    ovoid_shape_destroy(c);
}

// Whatever is altered in an answer, the check notices.
static void check_altered(void) {
    STATIC_COVER(cover);
    STATIC_COVER(empty);
    ovoid_shape *a = box(1, 1, 1, 0);
    ovoid_pair p = {a, a, at(0, 0, 0), {{2.7, 0.4, 0.3}, {0.9, 0.2, 0.1, 0.3}}}, q = p;
    ovoid_answer x = ovoid_distance(&p, NULL, NULL), y;
    q.pose_b.position = (ovoid_vec3){1.5, 0.2, 0};
    ovoid_answer deep = ovoid_depth(&q, NULL, NULL, &cover);
    CHECK(holds(&p, &x, NULL) && holds(&q, &deep, &cover));
#define REJECTED(pair, answer, evidence)                                                                               \
    CHECK(ovoid_answer_verify(pair, answer, &(ovoid_answer_basis){.cover = evidence}, NULL) == OVOID_ERROR_PROOF)
    y = x, y.lower += 1e-9, REJECTED(&p, &y, NULL);
    y = x, y.upper -= 1e-9, REJECTED(&p, &y, NULL);
    y = x, y.status = OVOID_OVERLAPPING, REJECTED(&p, &y, NULL);
    y = x, y.status = OVOID_TOUCHING, REJECTED(&p, &y, NULL);
    y = x, y.point_a.x += 1e-9, REJECTED(&p, &y, NULL);
    y = x, y.point_b.z -= 1e-9, REJECTED(&p, &y, NULL);
    y = x, y.normal.y += 1e-9, REJECTED(&p, &y, NULL);
    y = x, y.proof.normal.y += 1e-3, y.normal = y.proof.normal, REJECTED(&p, &y, NULL);
    y = x, y.proof.a[0] = 8, REJECTED(&p, &y, NULL);
    y = x, y.proof.kind = OVOID_PROOF_NONE, REJECTED(&p, &y, NULL);
    y = x, y.proof.weight_a[0] = -1, REJECTED(&p, &y, NULL);
    y = x, y.lower = NAN, REJECTED(&p, &y, NULL);
    y = deep, y.upper -= 1e-9, REJECTED(&q, &y, &cover);
    y = deep, y.lower += 1e-9, REJECTED(&q, &y, &cover);
    REJECTED(&q, &deep, NULL);
    REJECTED(&q, &deep, &empty);
    // A surface with a hole, and one turned inside itself.
    cover.triangle_count--;
    REJECTED(&q, &deep, &cover);
    cover.triangle_count++;
    ((uint32_t *)cover.a)[cover.triangles[0][0]] ^= 7;
    REJECTED(&q, &deep, &cover);
    ovoid_shape_destroy(a);
}

// Boxes 1 apart, with a true bracket around 0: what it says of the sign depends on the options' tolerance alone.
static void check_touching(void) {
    ovoid_shape *a = box(1, 1, 1, 0);
    ovoid_pair p = {a, a, at(0, 0, 0), at(3, 0, 0)};
    ovoid_answer x = ovoid_distance(&p, NULL, NULL);
    x.proof.normal = x.normal = (ovoid_vec3){0.8, 0.6, 0};
    x.lower = -0.5;
    x.limit = OVOID_LIMIT_PRECISION;
    x.status = OVOID_UNDECIDED;
    CHECK(holds(&p, &x, NULL));
    x.status = OVOID_TOUCHING;
    double width = x.upper - x.lower, size = 2 * sqrt(3) + 3;
    struct {
        ovoid_options options;
        int is_touching;
    } cases[] = {{{0}, 0},
                 {{.absolute_tolerance = width}, 1},
                 {{.absolute_tolerance = width * (1 - 1e-12)}, 0},
                 {{.relative_tolerance = width / size * (1 + 1e-9)}, 1},
                 {{.relative_tolerance = width / size * (1 - 1e-9)}, 0},
                 {{.absolute_tolerance = NAN}, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        CHECK_EQ(ovoid_answer_verify(&p, &x, &(ovoid_answer_basis){.options = &cases[i].options}, NULL) == OVOID_OK,
                 cases[i].is_touching);
    CHECK_EQ(ovoid_answer_verify(&p, &x, NULL, NULL), OVOID_ERROR_PROOF);
    // A sign that the bracket shows is not open.
    x = ovoid_distance(&p, NULL, NULL);
    x.status = OVOID_UNDECIDED;
    CHECK_EQ(ovoid_answer_verify(&p, &x, NULL, NULL), OVOID_ERROR_PROOF);
    ovoid_shape_destroy(a);
}

/// The nearest points of the cores are found to rounding, and from there GJK's steps gained by rounding alone: a circle
/// that ended at the limit of 1000 steps, before the sign was proven.
static void check_circle(void) {
    ovoid_shape *a = ovoid_shape_create_sphere(0.075948878912939832, NULL, NULL),
                *b = box(1, 0.5, 0.25, 5.3156186006697581);
    ovoid_pose pose_a = {{-10.429997156437592, -1.745039445573209, -9.1517790524097649},
                         {-1.295339604391492, 0.90981691866001413, 0.11033891707636009, 0.22495589661187662}};
    ovoid_pose pose_b = {{-15.725284918365119, -1.2750186980638853, -11.733326962801447},
                         {-1.0409829165060678, -0.41448177621171978, 0.074753833182894844, 1.1411804285861245}};
    ovoid_pair p = {a, b, pose_a, pose_b};
    ovoid_answer x[3] = {ovoid_collide(&p, NULL, NULL), ovoid_distance(&p, NULL, NULL),
                         ovoid_within(&p, 0, NULL, NULL)};
    for (int i = 0; i < 3; i++) {
        CHECK_EQ(x[i].status, OVOID_OVERLAPPING);
        CHECK(x[i].iterations < 32);
        CHECK(holds(&p, &x[i], NULL));
    }
    ovoid_shape_destroy(a);
    ovoid_shape_destroy(b);
}

/// The reading of a bracket against a margin, at the ends of the doubles.
static void check_reading(void) {
    static const double values[] = {-INFINITY, -1e300, -1, -5e-324, -0.0, 0.0, 5e-324, 1e-310, 1, 2, 1e300, INFINITY};
    enum { VALUES = sizeof values / sizeof *values };
    for (int i = 0; i < VALUES; i++)
        for (int k = i; k < VALUES; k++)
            for (int m = 0; m < VALUES; m++) {
                ovoid_answer x = {.lower = values[i], .upper = values[k]};
                int is = values[k] <= values[m] ? 1 : values[i] > values[m] ? 0 : -1;
                CHECK_EQ(ovoid_answer_is_within(&x, values[m]), is);
            }
    CHECK_EQ(ovoid_answer_is_within(&(ovoid_answer){.lower = 1, .upper = 2}, NAN), -1);
    CHECK_EQ(ovoid_answer_is_within(&(ovoid_answer){.lower = 1, .upper = NAN}, 3), -1);
}

int main(void) {
    check_reading();
    check_boxes();
    check_round();
    check_flat();
    check_octahedron();
    check_scales();
    check_options();
    check_refused();
    check_foreign_proofs();
    check_altered();
    check_touching();
    check_circle();
    return check_end();
}
