// Contacts of plain bodies. Truth: positions by hand; for random pairs the bracket of ovoid_depth, which has its own
// judge, and the verifier.
#include "manifolds.h"
#include "places.h"
#include "proofs/covers.h"

static ovoid_quat turn_z(double angle) { return (ovoid_quat){cos(angle / 2), 0, 0, sin(angle / 2)}; }
#define PI 3.14159265358979323846
static const ovoid_quat straight = {1, 0, 0, 0};

// The bodies' poses: A at the origin.
static ovoid_pair pair_of(const ovoid_shape *a, const ovoid_shape *b, vec3 at, ovoid_quat turn) {
    return (ovoid_pair){a, b, ovoid_pose_make_identity(), {at, turn}};
}

// Every claim of the contact, and those of its points that the caller sees.
static void check_contact(const ovoid_pair *pair, const ovoid_manifold *m, const ovoid_manifold_options *o) {
    ovoid_error error = {0};
    CHECK_EQ(ovoid_manifold_verify(pair, m, o, &error), OVOID_OK);
    if (error.code) printf("  %s\n", error.message);
    ovoid_manifold_points p = ovoid_manifold_compute_points(pair, m);
    CHECK_EQ(p.count, m->count);
    for (uint32_t i = 0; i < p.count; i++) {
        vec3 d = vec3_sub(p.points[i].point_b, p.points[i].point_a);
        double off = vec3_norm(vec3_sub(d, vec3_scale(m->normal, p.points[i].separation)));
        CHECK_LE(off, 1e-13 * (1 + vec3_norm(p.points[i].point_a)));
        CHECK_EQ(p.points[i].id, m->id[i]);
    }
}

// The same from the other side.
static void check_exchanged(const ovoid_pair *pair, const ovoid_manifold *m, const ovoid_manifold_options *o) {
    ovoid_pair other = {pair->shape_b, pair->shape_a, pair->pose_b, pair->pose_a};
    ovoid_manifold found = ovoid_manifold_find(&other, o, NULL), back = ovoid_manifold_make_swapped(&found);
    CHECK(memcmp(&back, m, sizeof back) == 0);
    ovoid_manifold_points p = ovoid_manifold_compute_points(pair, m);
    ovoid_manifold_points q = ovoid_manifold_compute_points(&other, &found);
    CHECK_EQ(p.count, q.count);
    for (uint32_t i = 0; i < p.count; i++) {
        CHECK(memcmp(&p.points[i].point_a, &q.points[i].point_b, sizeof(vec3)) == 0);
        CHECK(memcmp(&p.points[i].point_b, &q.points[i].point_a, sizeof(vec3)) == 0);
        CHECK(memcmp(&p.points[i].separation, &q.points[i].separation, sizeof(double)) == 0);
    }
}

// Two boxes of half size 1, the upper one 0.1 deep and moved by (0.5, 0.25): the overlap is [-0.5, 1] x [-0.75, 1].
static void test_boxes(void) {
    ovoid_error error;
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, &error);
    ovoid_pair pair = pair_of(box, box, (vec3){0.5, 0.25, 1.9}, straight);
    ovoid_manifold m = ovoid_manifold_find(&pair, NULL, NULL);
    CHECK_EQ(m.status, OVOID_OVERLAPPING);
    CHECK_EQ(m.limit, OVOID_LIMIT_NONE);
    CHECK_NEAR(m.lower, -0.1, 1e-12);
    CHECK_NEAR(m.upper, -0.1, 1e-12);
    CHECK_EQ(m.count, 4);
    CHECK_EQ(m.corners, 4);
    CHECK_EQ(m.proof, OVOID_MANIFOLD_PROOF_FACETS);
    CHECK_NEAR(m.normal.z, 1, 0);
    check_contact(&pair, &m, NULL);
    check_exchanged(&pair, &m, NULL);
    ovoid_manifold_points p = ovoid_manifold_compute_points(&pair, &m);
    const double corner[4][2] = {{-0.5, -0.75}, {1, -0.75}, {1, 1}, {-0.5, 1}};
    for (int k = 0; k < 4; k++) {
        double nearest = INFINITY;
        for (uint32_t i = 0; i < p.count; i++) {
            vec3 a = p.points[i].point_a, b = p.points[i].point_b;
            nearest = fmin(nearest, hypot(a.x - corner[k][0], a.y - corner[k][1]));
            CHECK_NEAR(a.z, 1, 1e-14);
            CHECK_NEAR(b.z, 0.9, 1e-14);
            CHECK_NEAR(p.points[i].separation, -0.1, 1e-14);
        }
        CHECK_LE(nearest, 1e-14);
    }
    ovoid_manifold_polygon polygon;
    CHECK_EQ(ovoid_manifold_compute_polygon(&pair, &m, NULL, &polygon), OVOID_OK);
    // Each side of a polygon of length 6.5 is moved by twice the rounding of a point, and counted with as much doubt.
    CHECK_NEAR(polygon.inner, 1.5 * 1.75, 6 * 6.5 * polygon.grown);
    CHECK_NEAR(polygon.outer, 1.5 * 1.75, 6 * 6.5 * polygon.grown);
    CHECK_LE(polygon.inner, 1.5 * 1.75);
    CHECK_LE(1.5 * 1.75, polygon.outer);
    ovoid_shape_destroy(box);
}

// With kept corners the verifier still refuses a point that is outside of the other box by more than they may be.
static void test_point_outside(void) {
    ovoid_error error;
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, &error);
    ovoid_pair pair = pair_of(box, box, (vec3){0.5, 0.25, 1.9}, straight);
    const ovoid_manifold_options o = {.keep = 0.01};
    const ovoid_manifold m = ovoid_manifold_find(&pair, &o, NULL);
    ovoid_polytope p = ovoid_shape_get_polytope(box);
    CHECK_EQ(ovoid_manifold_verify(&pair, &m, &o, NULL), OVOID_OK);
    int refused = 0;
    for (uint32_t v = 0; v < p.vertex_count; v++) {
        const double *x = p.vertices + 3 * v;
        if ((x[0] > 0 && x[1] > 0) || x[2] < 0) continue;
        for (int i = 0; i < 4; i++) {
            ovoid_manifold lie = m;
            lie.id[i] = OVOID_MANIFOLD_ID_VERTEX_A | v;
            CHECK(ovoid_manifold_verify(&pair, &lie, &o, NULL) != OVOID_OK);
            refused++;
        }
    }
    CHECK_EQ(refused, 12);
    ovoid_shape_destroy(box);
}

// Two boxes of as many vertices in one sphere, at one pose: their order is that of the vertices.
static void test_one_place(void) {
    ovoid_error error;
    ovoid_shape *a = ovoid_shape_create_box((ovoid_vec3){1, 2, 3}, NULL, &error),
                *b = ovoid_shape_create_box((ovoid_vec3){2, 1, 3}, NULL, &error);
    LOCAL_COVER(cover);
    const ovoid_manifold_options o = {.cover = &cover};
    ovoid_pair pair = pair_of(a, b, (vec3){0, 0, 0}, straight);
    ovoid_manifold m = ovoid_manifold_find(&pair, &o, NULL);
    CHECK_NEAR(m.lower, -3, 1e-12);
    check_contact(&pair, &m, &o);
    check_exchanged(&pair, &m, &o);
    ovoid_shape_destroy(a);
    ovoid_shape_destroy(b);
}

// A square turned by an eighth over an equal one: an octagon of area 8 (root 2 - 1); four of its corners span, at best,
// every other one: a square whose diagonal is the circle's, 1 / cos(pi / 8) from the middle.
static void test_octagon(void) {
    ovoid_error error;
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, &error);
    ovoid_pair pair = pair_of(box, box, (vec3){0, 0, 1.9}, turn_z(PI / 4));
    ovoid_manifold m = ovoid_manifold_find(&pair, NULL, NULL);
    CHECK_EQ(m.corners, 8);
    CHECK_EQ(m.count, 4);
    double radius = 1 / cos(PI / 8);
    CHECK_NEAR((double)m.share, 2 * radius * radius / (8 * (sqrt(2) - 1)), 1e-6);
    check_contact(&pair, &m, NULL);
    check_exchanged(&pair, &m, NULL);
    ovoid_shape_destroy(box);
}

// Two bars across each other, edge on edge: one point, at the middle of both edges.
static void test_edges(void) {
    ovoid_error error;
    ovoid_shape *bar = ovoid_shape_create_box((ovoid_vec3){4, 1, 1}, NULL, &error);
    double c = cos(PI / 8), s = sin(PI / 8), high = 2 * sqrt(2);
    ovoid_pair pair = pair_of(bar, bar, (vec3){0.5, 0.25, high - 0.1}, straight);
    pair.pose_a.rotation = (ovoid_quat){c, s, 0, 0};
    // B: turned about x as A is, then by a quarter about z.
    ovoid_pose quarter = {{0, 0, 0}, turn_z(PI / 2)};
    pair.pose_b.rotation = ovoid_pose_compute_product(&quarter, &pair.pose_a).rotation;
    ovoid_manifold m = ovoid_manifold_find(&pair, NULL, NULL);
    CHECK_EQ(m.axis, OVOID_MANIFOLD_EDGES);
    CHECK_EQ(m.count, 1);
    CHECK_EQ(m.id[0] & OVOID_MANIFOLD_KIND, OVOID_MANIFOLD_ID_CROSSING);
    CHECK_NEAR(m.lower, -0.1, 1e-9);
    check_contact(&pair, &m, NULL);
    check_exchanged(&pair, &m, NULL);
    ovoid_manifold_points p = ovoid_manifold_compute_points(&pair, &m);
    CHECK_NEAR(p.points[0].point_a.x, 0.5, 1e-12);
    CHECK_NEAR(p.points[0].point_a.y, 0, 1e-12);
    CHECK_NEAR(p.points[0].point_a.z, sqrt(2), 1e-12);
    ovoid_shape_destroy(bar);
}

// A lying capsule on a box touches along its segment, a standing one and a ball at a point.
static void test_round(void) {
    ovoid_error error;
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){2, 2, 1}, NULL, &error);
    ovoid_shape *capsule = ovoid_shape_create_capsule(0.5, 1, NULL, &error);
    ovoid_shape *ball = ovoid_shape_create_sphere(0.5, NULL, &error);
    const ovoid_quat lying = {sqrt(0.5), 0, sqrt(0.5), 0};
    const struct {
        const ovoid_shape *shape;
        ovoid_quat turn;
        double height;
        uint32_t count;
        double x;
    } cases[] = {{capsule, lying, 1.4, 2, 1}, {capsule, straight, 2.4, 1, 0}, {ball, straight, 1.4, 1, 0}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        ovoid_pair pair = pair_of(box, cases[k].shape, (vec3){0.25, 0, cases[k].height}, cases[k].turn);
        ovoid_manifold m = ovoid_manifold_find(&pair, NULL, NULL);
        CHECK_EQ(m.count, cases[k].count);
        CHECK_NEAR(m.lower, -0.1, 1e-9);
        CHECK_NEAR(m.upper, -0.1, 1e-9);
        check_contact(&pair, &m, NULL);
        check_exchanged(&pair, &m, NULL);
        ovoid_manifold_points p = ovoid_manifold_compute_points(&pair, &m);
        for (uint32_t i = 0; i < p.count; i++) {
            CHECK_NEAR(p.points[i].point_a.z, 1, 1e-13);
            CHECK_NEAR(p.points[i].point_b.z, 0.9, 1e-13);
            CHECK_NEAR(fabs(p.points[i].point_a.x - 0.25), cases[k].x, 1e-13);
        }
    }
    ovoid_shape_destroy(box);
    ovoid_shape_destroy(capsule);
    ovoid_shape_destroy(ball);
}

// Beyond the margin there is no contact; within it there is one, with a distance.
static void test_margin(void) {
    ovoid_error error;
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, &error);
    ovoid_pair pair = pair_of(box, box, (vec3){0.5, 0.25, 2.1}, straight);
    ovoid_manifold_options o = {.margin = 0.05};
    ovoid_manifold m = ovoid_manifold_find(&pair, &o, NULL);
    CHECK_EQ(m.axis, OVOID_MANIFOLD_NONE);
    CHECK_EQ(m.status, OVOID_SEPARATED);
    CHECK_EQ(m.limit, OVOID_LIMIT_CAP);
    CHECK_EQ(m.count, 0);
    check_contact(&pair, &m, &o);
    o.margin = 0.2;
    m = ovoid_manifold_find(&pair, &o, NULL);
    CHECK_EQ(m.status, OVOID_SEPARATED);
    CHECK_EQ(m.count, 4);
    CHECK_NEAR(m.lower, 0.1, 1e-12);
    CHECK_NEAR(m.upper, 0.1, 2.1 * ovoid_manifold_compute_points(&pair, &m).grown);
    check_contact(&pair, &m, &o);
    check_exchanged(&pair, &m, &o);
    o.margin = -1;
    m = ovoid_manifold_find(&pair, &o, NULL);
    CHECK_EQ(m.limit, OVOID_LIMIT_OPTIONS);
    CHECK_EQ(ovoid_manifold_verify(&pair, &m, &o, NULL), OVOID_OK);
    pair.pose_b.rotation = (ovoid_quat){0, 0, 0, 0};
    m = ovoid_manifold_find(&pair, NULL, NULL);
    CHECK_EQ(m.limit, OVOID_LIMIT_POSE_B);
    CHECK_EQ(m.count, 0);
    CHECK_EQ(ovoid_manifold_compute_points(&pair, &m).count, 0);
    ovoid_shape_destroy(box);
}

// ---- random pairs ----

enum { HULL = 24 };
static ovoid_shape *create_hull(uint64_t *s) {
    double xyz[3 * HULL];
    ovoid_error error;
    for (int i = 0; i < HULL; i++) {
        vec3 p = vec3_unit((vec3){random_normal(s), random_normal(s), random_normal(s)});
        for (int k = 0; k < 3; k++) xyz[3 * i + k] = (&p.x)[k];
    }
    return ovoid_shape_create_from_points(xyz, HULL, NULL, &error);
}

static void check_against_depth(const ovoid_pair *pair, const ovoid_manifold *m) {
    ovoid_answer truth = ovoid_depth(pair, NULL, NULL, NULL);
    CHECK_LE(m->lower, truth.upper);
    if (m->axis != OVOID_MANIFOLD_NONE) CHECK_LE(truth.lower, m->upper);
}

// Cold, then five small motions, each from the contact before.
static void test_random(void) {
    LOCAL_COVER(cover);
    ovoid_manifold_options o = {.margin = 0.02, .cover = &cover};
    for (uint64_t seed = 1; seed <= 200; seed++) {
        uint64_t s = check_seed = seed;
        ovoid_shape *a = create_hull(&s), *b = create_hull(&s);
        ovoid_pair pair = {a, b, {{1, 2, 3}, random_quat(&s)}, {{0, 0, 0}, random_quat(&s)}};
        pair.pose_a.position = (vec3){0, 0, 0};
        place_at_distance(&pair, random_uniform(&s, -0.1, 0.03), 6, &s);
        o.tolerance = 0;
        ovoid_manifold m = ovoid_manifold_find(&pair, &o, NULL);
        check_contact(&pair, &m, &o);
        check_against_depth(&pair, &m);
        check_exchanged(&pair, &m, &o);
        o.tolerance = 1e-3;
        for (int k = 0; k < 5; k++) {
            pair.pose_b.position = vec3_add_scaled(pair.pose_b.position, (vec3){random_normal(&s), 1, -1}, 1e-4);
            pair.pose_b.rotation.x += 1e-4 * random_normal(&s);
            m = ovoid_manifold_find(&pair, &o, &m);
            check_contact(&pair, &m, &o);
            check_against_depth(&pair, &m);
        }
        ovoid_shape_destroy(a);
        ovoid_shape_destroy(b);
    }
    check_seed = 0;
}

// Hulls that are moved and searched again each time, with kept corners: no point is deeper than the bodies, and the
// deepest one is as deep. Corners that are one differ by 1e-6 of the size, which is below 6, and so do those that a
// kept corner stands for, and those that the points are chosen among.
static void test_depth_of_points(void) {
    ovoid_manifold_points points;
    LOCAL_COVER(cover);
    const ovoid_manifold_options o = {.margin = 0.02, .keep = 0.03, .cover = &cover, .points = &points};
    int kept = 0;
    for (uint64_t seed = 1; seed <= 200; seed++) {
        uint64_t s = check_seed = seed;
        ovoid_shape *a = create_hull(&s), *b = create_hull(&s);
        ovoid_pair pair = {a, b, {{0, 0, 0}, random_quat(&s)}, {{0, 0, 0}, random_quat(&s)}};
        place_at_distance(&pair, random_uniform(&s, -0.1, -0.01), 6, &s);
        ovoid_manifold m = {0};
        for (int k = 0; k < 5; k++) {
            pair.pose_b.position = vec3_add_scaled(pair.pose_b.position, (vec3){random_normal(&s), 1, -1}, 1e-2);
            pair.pose_b.rotation.x += 1e-2 * random_normal(&s);
            ovoid_manifold next = ovoid_manifold_find(&pair, &o, &m);
            kept += k > 0 && next.id[0] == m.id[0];
            m = next;
            check_contact(&pair, &m, &o);
            if (!(m.upper < 0)) continue;
            double least = find_deepest(points.points, points.count);
            CHECK_LE(m.lower, least + 1e-12);
            CHECK_LE(least, m.lower + 18e-6);
        }
        ovoid_shape_destroy(a);
        ovoid_shape_destroy(b);
    }
    check_seed = 0;
    CHECK(kept > 200);
}

// Twice the area of four points about a normal.
static double find_area(const ovoid_manifold_point *p[4], vec3 n) {
    vec3 d = vec3_sub(p[2]->point_a, p[0]->point_a), e = vec3_sub(p[3]->point_a, p[1]->point_a);
    return vec3_dot(vec3_cross(d, e), n);
}

// Four corners of the polygon that are less deep than its deepest, with their share: the verifier refuses them.
static int refuse_without_deepest(const ovoid_pair *pair, const ovoid_manifold *m, const ovoid_manifold_options *o,
                                  const ovoid_manifold_polygon *polygon) {
    double all = 0;
    uint32_t count = polygon->count, deepest = 0;
    const ovoid_manifold_point *p = polygon->points;
    for (uint32_t i = 1; i < count; i++)
        if (p[i].separation < p[deepest].separation) deepest = i;
    for (uint32_t i = 1; i + 1 < count; i++)
        all +=
            vec3_dot(vec3_cross(vec3_sub(p[i].point_a, p->point_a), vec3_sub(p[i + 1].point_a, p->point_a)), m->normal);
    ovoid_manifold lie = *m;
    const ovoid_manifold_point *four[4];
    uint32_t taken = 0;
    for (uint32_t i = 0; i < count && taken < 4; i++) {
        if (p[i].separation <= p[deepest].separation + 3e-5) continue;
        lie.id[taken] = p[i].id;
        four[taken++] = p + i;
    }
    if (taken < 4) return 0;
    lie.share = (float)(find_area(four, m->normal) / all);
    CHECK(ovoid_manifold_verify(pair, &lie, o, NULL) != OVOID_OK);
    return 1;
}

// Turns a pair whose body A is at the origin.
static void turn_both(ovoid_pair *pair, ovoid_quat turn) {
    const ovoid_pose turned = {{0, 0, 0}, turn};
    pair->pose_a = ovoid_pose_compute_product(&turned, &pair->pose_a);
    pair->pose_b = ovoid_pose_compute_product(&turned, &pair->pose_b);
}

// Plates on one another need no search, wherever the line of centres goes and however both are turned: the cover stays
// as it was.
static void test_faces_without_search(void) {
    ovoid_error error;
    ovoid_shape *plate = ovoid_shape_create_box((ovoid_vec3){2, 2, 0.3}, NULL, &error);
    STATIC_COVER(cover);
    ovoid_cover untouched = cover;
    untouched.point_count = untouched.triangle_count = 77;
    const ovoid_manifold_options o = {.margin = 0.05, .cover = &cover};
    for (uint64_t seed = 1; seed <= 200; seed++) {
        uint64_t s = check_seed = seed;
        vec3 at = {random_uniform(&s, -1.5, 1.5), random_uniform(&s, -1.5, 1.5), 0.59};
        ovoid_pair pair = pair_of(plate, plate, at, turn_z(random_uniform(&s, 0, 6)));
        if (seed % 2) turn_both(&pair, random_quat(&s));
        cover = untouched;
        ovoid_manifold m = ovoid_manifold_find(&pair, &o, NULL);
        CHECK(memcmp(&cover, &untouched, sizeof cover) == 0);
        CHECK_NEAR(m.lower, -0.01, 1e-12);
        CHECK_NEAR(m.upper, -0.01, 1e-9 * 6);
        check_contact(&pair, &m, &o);
        check_exchanged(&pair, &m, &o);
        // As they tilt an upper bound is one that can be verified: there is no cover of a search.
        const ovoid_manifold_options wide = {
            .margin = 0.05, .cover = &cover, .tolerance = random_uniform(&s, 1e-3, 4e-3)};
        cover.point_count = cover.triangle_count = 0;
        for (int k = 0; k < 3; k++) {
            pair.pose_b.rotation.x += 5e-4 * random_normal(&s);
            pair.pose_b.rotation.y += 5e-4 * random_normal(&s);
            m = ovoid_manifold_find(&pair, &wide, &m);
            check_contact(&pair, &m, &wide);
        }
    }
    check_seed = 0;
    ovoid_shape_destroy(plate);
}

// Boxes along common axes, whose depth is the least of the three by hand: often not that of the faces that the line of
// centres meets. Then frames in which they tilt: where there is a cover, an upper bound is one that can be verified.
static void test_common_axes(void) {
    STATIC_COVER(cover);
    int other = 0;
    for (uint64_t seed = 1; seed <= 1000; seed++) {
        uint64_t s = check_seed = seed;
        ovoid_error error;
        double half[2][3], d[3], depth = INFINITY, rate = 0;
        int shallowest = 0, met = 0;
        for (int k = 0; k < 3; k++) {
            for (int i = 0; i < 2; i++) half[i][k] = random_uniform(&s, 0.3, 2);
            double sum = half[0][k] + half[1][k];
            d[k] = random_uniform(&s, 0.1, 0.98) * sum;
            if (sum - d[k] < depth) depth = sum - d[k], shallowest = k;
            if (d[k] / half[0][k] > rate) rate = d[k] / half[0][k], met = k;
        }
        other += shallowest != met;
        ovoid_shape *a = ovoid_shape_create_box((ovoid_vec3){half[0][0], half[0][1], half[0][2]}, NULL, &error),
                    *b = ovoid_shape_create_box((ovoid_vec3){half[1][0], half[1][1], half[1][2]}, NULL, &error);
        ovoid_pair pair = pair_of(a, b, (vec3){d[0], d[1], d[2]}, straight);
        ovoid_manifold_options o = {.cover = &cover};
        ovoid_manifold m = ovoid_manifold_find(&pair, &o, NULL);
        CHECK_NEAR(m.lower, -depth, 1e-9 * 10);
        CHECK_NEAR(m.upper, -depth, 1e-9 * 10);
        check_contact(&pair, &m, &o);
        o.tolerance = 0.01;
        for (int k = 0; k < 3; k++) {
            pair.pose_b.rotation.x += 1e-3 * random_normal(&s);
            pair.pose_b.rotation.y += 1e-3 * random_normal(&s);
            m = ovoid_manifold_find(&pair, &o, &m);
            check_contact(&pair, &m, &o);
        }
        ovoid_shape_destroy(a);
        ovoid_shape_destroy(b);
    }
    check_seed = 0;
    CHECK(other > 100);
}

// Bodies that were apart along a diagonal and are farther than the margin along the same direction are not searched;
// those that then touch are found.
static void test_apart_without_search(void) {
    ovoid_error error;
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, &error);
    STATIC_COVER(cover);
    ovoid_cover untouched = cover;
    untouched.point_count = untouched.triangle_count = 77;
    const ovoid_manifold_options o = {.margin = 0.05, .cover = &cover};
    ovoid_pair pair = pair_of(box, box, (vec3){2.2, 2.2, 2.2}, straight);
    ovoid_manifold m = ovoid_manifold_find(&pair, &o, NULL);
    CHECK_EQ(m.axis, OVOID_MANIFOLD_NONE);
    vec3 n = m.normal;
    pair.pose_b.position = (vec3){2.15, 2.2, 2.25};
    cover = untouched;
    m = ovoid_manifold_find(&pair, &o, &m);
    CHECK(memcmp(&cover, &untouched, sizeof cover) == 0);
    CHECK(m.axis == OVOID_MANIFOLD_NONE && memcmp(&m.normal, &n, sizeof n) == 0);
    check_contact(&pair, &m, &o);
    CHECK_NEAR(m.lower, ovoid_pair_compute_gap(&pair, n), 1e-12);
    pair.pose_b.position = (vec3){1.97, 1.98, 1.99};
    m = ovoid_manifold_find(&pair, &o, &m);
    CHECK_NEAR(m.lower, -0.01, 1e-9);
    check_contact(&pair, &m, &o);
    ovoid_shape_destroy(box);
}

// A box turned about the normal and tilted over a larger one: of six to eight corners the deepest is among the four,
// in the next frames too, where other corners are the deepest. To 1e-6 of the size, which is below 6.
static void test_deepest_of_many(void) {
    ovoid_error error;
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, &error);
    static ovoid_manifold_polygon polygon;
    ovoid_manifold_points points;
    LOCAL_COVER(cover);
    const ovoid_manifold_options o = {.cover = &cover, .points = &points};
    int many = 0, refused = 0;
    for (uint64_t seed = 1; seed <= 200; seed++) {
        uint64_t s = check_seed = seed;
        ovoid_pair pair = pair_of(box, box, (vec3){0.1, -0.05, 1.95}, turn_z(random_uniform(&s, 0.2, 1.4)));
        ovoid_manifold m = {0};
        for (int k = 0; k < 5; k++) {
            ovoid_pose tilt = {{0, 0, 0}, {1, 2e-3 * random_normal(&s), 2e-3 * random_normal(&s), 0}};
            ovoid_pose turned = {{0, 0, 0}, turn_z(random_uniform(&s, 0.7, 0.9))};
            pair.pose_b.rotation = ovoid_pose_compute_product(&tilt, &turned).rotation;
            m = ovoid_manifold_find(&pair, &o, &m);
            CHECK_EQ(ovoid_manifold_compute_polygon(&pair, &m, &o, &polygon), OVOID_OK);
            CHECK_LE(find_deepest(points.points, points.count), find_deepest(polygon.points, polygon.count) + 6e-6);
            many += m.corners > 4;
            check_contact(&pair, &m, &o);
            if (!(m.memory.flags & 2)) refused += refuse_without_deepest(&pair, &m, &o, &polygon);
        }
    }
    check_seed = 0;
    CHECK(many > 500);
    CHECK(refused > 20);
    ovoid_shape_destroy(box);
}

// A prism of 100 sides that stands on one edge of its end, a little: of its 100 corners 64 are used, the lowest among
// them, so the point is as deep as the bodies.
static void test_many_corners(void) {
    ovoid_error error;
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){3, 3, 1}, NULL, &error);
    double xyz[3 * 200];
    for (int i = 0; i < 200; i++) {
        double angle = 2 * PI * (i % 100) / 100;
        xyz[3 * i] = cos(angle);
        xyz[3 * i + 1] = sin(angle);
        xyz[3 * i + 2] = i < 100 ? -1 : 1;
    }
    ovoid_shape *prism = ovoid_shape_create_from_points(xyz, 200, NULL, &error);
    ovoid_manifold_points points;
    LOCAL_COVER(cover);
    const ovoid_manifold_options o = {.cover = &cover, .points = &points};
    for (int k = 0; k < 20; k++) {
        ovoid_pair pair = pair_of(box, prism, (vec3){0.1, 0.2, 1.95}, turn_z(0.3 + k));
        ovoid_pose tilt = {{0, 0, 0}, {1, 0.01, 0.002 * k, 0}};
        pair.pose_b.rotation = ovoid_pose_compute_product(&tilt, &pair.pose_b).rotation;
        ovoid_manifold m = ovoid_manifold_find(&pair, &o, NULL);
        CHECK_EQ(m.count, 4);
        CHECK_NEAR(find_deepest(points.points, points.count), m.lower, 1e-5);
        check_contact(&pair, &m, &o);
        check_exchanged(&pair, &m, &o);
    }
    ovoid_shape_destroy(box);
    ovoid_shape_destroy(prism);
}

// What features show where they are not the shallowest way out: contacts whose bodies are then moved far, of which no
// search is left, at a tolerance that the points alone do not reach. What the features show is true.
static void test_features_alone(void) {
    const ovoid_manifold_options o = {.tolerance = 0.05};
    int counts[5] = {0};
    for (uint64_t seed = 1; seed <= 4000; seed++) {
        uint64_t s = check_seed = seed;
        ovoid_error error;
        ovoid_vec3 half_a = {random_uniform(&s, 0.3, 2), random_uniform(&s, 0.3, 2), random_uniform(&s, 0.3, 2)},
                   half_b = {random_uniform(&s, 0.3, 2), random_uniform(&s, 0.3, 2), random_uniform(&s, 0.3, 2)};
        ovoid_shape *a = seed % 4 ? ovoid_shape_create_box(half_a, NULL, &error) : create_hull(&s),
                    *b = seed % 4 ? ovoid_shape_create_box(half_b, NULL, &error) : create_hull(&s);
        ovoid_pair pair = {a, b, {{0, 0, 0}, random_quat(&s)}, {{0, 0, 0}, random_quat(&s)}};
        if (seed % 4 == 1) pair.pose_a.rotation = pair.pose_b.rotation = straight;
        place_at_distance(&pair, -0.1, 6, &s);
        ovoid_manifold m = ovoid_manifold_find(&pair, NULL, NULL);
        double far = seed % 2 ? 0.3 : 0.03;
        vec3 d = vec3_unit((vec3){random_normal(&s), random_normal(&s), random_normal(&s)});
        pair.pose_b.position = vec3_add_scaled(pair.pose_b.position, d, far);
        vec3 axis = vec3_scale(vec3_unit((vec3){random_normal(&s), random_normal(&s), random_normal(&s)}), far / 2);
        ovoid_pose by = {{0, 0, 0}, {1, axis.x, axis.y, axis.z}};
        pair.pose_b.rotation = ovoid_pose_compute_product(&by, &pair.pose_b).rotation;
        memset(&m.memory.pose, 0, sizeof m.memory.pose);
        m = ovoid_manifold_find(&pair, &o, &m);
        check_against_depth(&pair, &m);
        if (m.proof == OVOID_MANIFOLD_PROOF_FACETS) counts[m.axis]++;
        ovoid_shape_destroy(a);
        ovoid_shape_destroy(b);
    }
    check_seed = 0;
    CHECK(counts[OVOID_MANIFOLD_FACE_A] > 100 && counts[OVOID_MANIFOLD_FACE_B] > 100);
    CHECK(counts[OVOID_MANIFOLD_EDGES] > 100);
}

// Equal boxes on one another, moved by rounding: with jitter of 1e-9 no id changes; with 1e-5, where corners are kept
// while they are outside by 0.005, in at most one frame of 20.
static void test_rest(void) {
    ovoid_error error;
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){0.5, 0.5, 0.5}, NULL, &error);
    for (int which = 0; which < 2; which++) {
        ovoid_manifold_options o = {.margin = 0.005, .tolerance = 1e-3, .keep = which ? 0.005 : 0};
        double jitter = which ? 1e-5 : 1e-9;
        ovoid_manifold m = {0};
        uint64_t s = 7;
        int changes = 0;
        for (int frame = 0; frame < 200; frame++) {
            vec3 at = {jitter * random_normal(&s), jitter * random_normal(&s), 0.998};
            ovoid_pair pair = pair_of(box, box, at, straight);
            pair.pose_b.rotation.x = jitter * random_normal(&s);
            ovoid_manifold next = ovoid_manifold_find(&pair, &o, &m);
            changes += frame > 0 && memcmp(next.id, m.id, sizeof m.id) != 0;
            CHECK_EQ(next.count, 4);
            m = next;
        }
        CHECK_LE(changes, which ? 10 : 0);
    }
    ovoid_shape_destroy(box);
}

// Plates and low pyramids whose features are kept while they slide to where another way out is shorter: the depth that
// the facets prove is never more than there is. Without the height of the point above the base in a frustum's sides 15
// of these contacts are wrong.
static void test_slides(void) {
    ovoid_error error;
    const ovoid_prism low = {1, 0.1, 4};
    ovoid_shape *shapes[2] = {ovoid_shape_create_box((ovoid_vec3){0.6, 0.7, 0.02}, NULL, &error),
                              ovoid_shape_create_pyramid(&low, NULL, &error)};
    long proven = 0;
    for (uint64_t seed = 1; seed <= 3000; seed++) {
        uint64_t s = check_seed = seed;
        ovoid_pair pair = pair_of(shapes[seed & 1], shapes[seed >> 1 & 1], (vec3){0, 0, 0}, straight);
        double tilt = random_uniform(&s, 0, 0.15), near = 0, far = 3, want = random_uniform(&s, -0.08, -0.005);
        pair.pose_b.rotation = (ovoid_quat){1, tilt * random_normal(&s), tilt * random_normal(&s), random_normal(&s)};
        pair.pose_b.position = (vec3){random_uniform(&s, -1.5, 1.5), random_uniform(&s, -1.5, 1.5), 0};
        for (int k = 0; k < 30; k++) {
            pair.pose_b.position.z = (near + far) / 2;
            if (ovoid_depth(&pair, NULL, NULL, NULL).lower > want)
                far = pair.pose_b.position.z;
            else
                near = pair.pose_b.position.z;
        }
        const ovoid_manifold_options o = {.margin = 0.02, .tolerance = pow(10, random_uniform(&s, -4, -1.3))};
        ovoid_manifold m = {0};
        for (int frame = 0; frame < 4; frame++) {
            m = ovoid_manifold_find(&pair, &o, &m);
            check_against_depth(&pair, &m);
            proven += m.proof == OVOID_MANIFOLD_PROOF_FACETS;
            pair.pose_b.position.x += 0.1 * random_normal(&s);
            pair.pose_b.position.y += 0.1 * random_normal(&s);
            pair.pose_b.position.z += 0.03 * random_normal(&s);
            pair.pose_b.rotation.y += 0.05 * random_normal(&s);
        }
    }
    CHECK_LE(1000, proven);
    for (int i = 0; i < 2; i++) ovoid_shape_destroy(shapes[i]);
    check_seed = 0;
}

// A box on its edge: its facets are turned by half a right angle, and are faces of the contact where that is asked.
static void test_angle(void) {
    ovoid_error error;
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){0.5, 0.5, 0.5}, NULL, &error);
    ovoid_pair pair =
        pair_of(box, box, (vec3){0, 0, 0.5 + sqrt(0.5) - 0.001}, (ovoid_quat){cos(PI / 8), sin(PI / 8), 0, 0});
    STATIC_COVER(cover);
    const ovoid_manifold_options wide = {.margin = 0.02, .cover = &cover},
                                 narrow = {.margin = 0.02, .angle = 0.5, .cover = &cover};
    ovoid_manifold found = ovoid_manifold_find(&pair, &wide, NULL), few = ovoid_manifold_find(&pair, &narrow, NULL);
    CHECK_EQ(found.facet_b & OVOID_MANIFOLD_KIND, OVOID_MANIFOLD_FACET);
    CHECK(few.facet_b != found.facet_b);
    check_contact(&pair, &found, &wide);
    check_contact(&pair, &few, &narrow);
    CHECK_EQ(ovoid_manifold_verify(&pair, &found, &narrow, &error), OVOID_ERROR_PROOF);
    ovoid_shape_destroy(box);
}

int main(void) {
    test_slides();
    test_angle();
    test_rest();
    test_boxes();
    test_one_place();
    test_octagon();
    test_edges();
    test_round();
    test_margin();
    test_random();
    test_point_outside();
    test_features_alone();
    test_faces_without_search();
    test_common_axes();
    test_apart_without_search();
    test_depth_of_points();
    test_deepest_of_many();
    test_many_corners();
    return check_end();
}
