// The exact judge. Truth: closed forms on representable coordinates, so that the exact bound is a double: the judge
// must accept it and refuse the next double beyond. Then every other part of an answer is altered, one at a time.
#include "check.h"
#include "judge.h"
#include "ovoid/ovoid.h"
#include "proofs/covers.h"

static judge *court;

static ovoid_shape *make_box(double x, double y, double z, double radius) {
    ovoid_shape_options options = {.radius = radius};
    return ovoid_shape_create_box((ovoid_vec3){x, y, z}, &options, NULL);
}

static ovoid_pose make_pose(double x, double y, double z) { return (ovoid_pose){{x, y, z}, {1, 0, 0, 0}}; }

static uint32_t find_vertex(const ovoid_shape *shape, double x, double y, double z) {
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    for (uint32_t i = 0; i < p.vertex_count; i++) {
        const double *v = p.vertices + 3 * i;
        if (v[0] + p.origin.x == x && v[1] + p.origin.y == y && v[2] + p.origin.z == z) return i;
    }
    CHECK(!"vertex");
    return 0;
}

static ovoid_code judge_it(const ovoid_pair *pair, const ovoid_answer *answer, const ovoid_cover *cover) {
    return judge_verify_answer(court, pair, answer, cover, NULL);
}

// The sentence goes to the report where an answer that should be accepted is not.
static void check_accepted(const ovoid_pair *pair, const ovoid_answer *answer, const ovoid_cover *cover, int line) {
    ovoid_error error = {0};
    ovoid_code code = judge_verify_answer(court, pair, answer, cover, &error);
    if (code != OVOID_OK) printf("line %d: %s\n", line, error.message);
    CHECK_EQ(code, OVOID_OK);
}
#define ACCEPT(pair, answer, cover) check_accepted(pair, answer, cover, __LINE__)
#define REFUSE(pair, answer, cover) CHECK(judge_it(pair, answer, cover) != OVOID_OK)

// Two unit cubes, faces 0.25 apart along x: a pair of corners shows the distance exactly.
static ovoid_answer make_box_answer(const ovoid_shape *s, double gap) {
    ovoid_answer answer = {.status = OVOID_SEPARATED, .lower = gap, .upper = gap};
    answer.normal = answer.proof.normal = (ovoid_vec3){1, 0, 0};
    answer.point_a = (ovoid_vec3){0.5, 0.5, 0.5};
    answer.point_b = (ovoid_vec3){0.5 + gap, 0.5, 0.5};
    answer.proof.kind = OVOID_PROOF_POINTS;
    answer.proof.count = 2;
    answer.proof.a[0] = find_vertex(s, 0.5, 0.5, 0.5);
    answer.proof.b[0] = find_vertex(s, -0.5, 0.5, 0.5);
    answer.proof.a[1] = find_vertex(s, 0.5, -0.5, 0.5);
    answer.proof.b[1] = find_vertex(s, -0.5, -0.5, 0.5);
    answer.proof.weight_a[0] = answer.proof.weight_b[0] = 1;
    return answer;
}

// Takes back one change after another.
#define ALTER(statement, verdict)                                                                                      \
    do {                                                                                                               \
        bad = good;                                                                                                    \
        statement;                                                                                                     \
        verdict(&pair, &bad, NULL);                                                                                    \
    } while (0)

static void test_numbers_altered(void) {
    ovoid_shape *s = make_box(0.5, 0.5, 0.5, 0);
    ovoid_pair pair = {s, s, make_pose(0, 0, 0), make_pose(1.25, 0, 0)};
    ovoid_answer good = make_box_answer(s, 0.25), bad;
    ACCEPT(&pair, &good, NULL);

    // The bounds: the next double is already wrong on one side, and weaker but true on the other.
    ALTER(bad.lower = nextafter(bad.lower, 1), REFUSE);
    ALTER(bad.upper = nextafter(bad.upper, 0), REFUSE);
    ALTER(bad.lower = nextafter(bad.lower, 0), ACCEPT);
    ALTER(bad.upper = nextafter(bad.upper, 1), ACCEPT);
    ALTER(bad.lower = bad.upper = 0.25 * (1 + 1e-9), REFUSE);
    ALTER(bad.lower = NAN, REFUSE);
    ALTER(bad.upper = NAN, REFUSE);
    ALTER(bad.lower = INFINITY; bad.upper = INFINITY, REFUSE);
    ALTER(bad.upper = INFINITY, ACCEPT);
    // Status and limit.
    ALTER(bad.status = OVOID_OVERLAPPING, REFUSE);
    ALTER(bad.status = OVOID_TOUCHING, REFUSE);
    ALTER(bad.status = OVOID_UNDECIDED, REFUSE);
    ALTER(bad.limit = OVOID_LIMIT_POSE_A, REFUSE);
    ALTER(bad.lower = 0; bad.status = OVOID_TOUCHING, REFUSE);
    ALTER(bad.lower = 0; bad.status = OVOID_UNDECIDED, ACCEPT);
    // Directions.
    ALTER(bad.normal.y = 1e-9, REFUSE);
    ALTER(bad.normal.x = 1 + 1e-9, REFUSE);
    ALTER(bad.normal.x = -1, REFUSE);
    ALTER(bad.normal = ((ovoid_vec3){0, 0, 0}), REFUSE);
    ALTER(bad.normal.z = NAN, REFUSE);
    ALTER(bad.proof.normal.y = bad.normal.y = 1e-9, REFUSE);
    ALTER(bad.proof.normal = ((ovoid_vec3){0, 0, 0}), REFUSE);
    ALTER(bad.proof.normal.y = INFINITY, REFUSE);
    ALTER(bad.proof.normal.x = 0x1p-700, ACCEPT); // only its direction counts
    // The low half is added exactly: any of it across the exact direction loses the exact bound, and only that.
    ALTER(bad.proof.normal_low.y = 1e-30, REFUSE);
    ALTER(bad.proof.normal_low.y = 1e-300, REFUSE);
    ALTER(bad.proof.normal_low.y = 1e-30; bad.lower = nextafter(bad.lower, 0), ACCEPT);
    ALTER(bad.proof.normal_low.x = 1e-30, ACCEPT);
    ALTER(bad.proof.normal_low.x = -1, REFUSE);
    ALTER(bad.proof.normal.y = 1e-18; bad.proof.normal_low.y = -1e-18, ACCEPT);
    ALTER(bad.proof.normal_low.z = NAN, REFUSE);
    ALTER(bad.proof.normal_low.z = INFINITY, REFUSE);
    ovoid_shape_destroy(s);
    judge_forget(court);
}

static void test_proofs_altered(void) {
    ovoid_shape *s = make_box(0.5, 0.5, 0.5, 0);
    ovoid_pair pair = {s, s, make_pose(0, 0, 0), make_pose(1.25, 0, 0)};
    ovoid_answer good = make_box_answer(s, 0.25), bad;
    // Weights, indices, kinds.
    ALTER(bad.proof.weight_b[1] = 1e-9, REFUSE); // the point of B moves along y
    ALTER(bad.proof.weight_a[0] = bad.proof.weight_b[0] = 3e200, ACCEPT);
    ALTER(bad.proof.weight_a[1] = -1e-30, REFUSE);
    ALTER(bad.proof.weight_a[0] = 0, REFUSE);
    ALTER(bad.proof.weight_a[0] = NAN, REFUSE);
    ALTER(bad.proof.a[0] = bad.proof.b[0], REFUSE);
    ALTER(bad.proof.a[1] = 8, REFUSE);
    ALTER(bad.proof.b[1] = UINT32_MAX, REFUSE);
    ALTER(bad.proof.count = OVOID_PROOF_PAIRS + 1, REFUSE);
    ALTER(bad.proof.count = 0, REFUSE);
    ALTER(bad.proof.kind = OVOID_PROOF_NONE, REFUSE);
    ALTER(bad.proof.kind = OVOID_PROOF_HULL, REFUSE);
    ALTER(bad.proof.kind = OVOID_PROOF_COVER, REFUSE);
    ALTER(bad.proof.kind = (ovoid_proof_kind)17, REFUSE);
    // Witness points: off the body by more than 256 half ulps of some 3 lengths.
    ALTER(bad.point_a.x += 1e-12, REFUSE);
    ALTER(bad.point_b.x -= 1e-12, REFUSE);
    ALTER(bad.point_a.x += 1e-15, ACCEPT);
    ALTER(bad.point_a.y = -0.5, ACCEPT); // another point of the body
    ALTER(bad.point_a.x = NAN, REFUSE);
    CHECK_EQ(judge_verify_points(court, &pair, &good, NULL), OVOID_OK);
    bad = good;
    bad.point_a.y -= 1e-8;
    CHECK_EQ(judge_verify_points(court, &pair, &bad, NULL), OVOID_ERROR_PROOF);
    // The pair.
    pair.pose_b.position.x = nextafter(1.25, 1);
    REFUSE(&pair, &good, NULL);
    pair.pose_b.position.x = 1.25;
    pair.pose_b.rotation.z = 1e-12;
    REFUSE(&pair, &good, NULL);
    ovoid_shape_destroy(s);
    judge_forget(court);
}

// The pose is a rational map: quaternions of any norm turn exactly; so do quarter turns and 3-4-5 turns.
static void test_rotations(void) {
    ovoid_shape *s = make_box(0.5, 0.5, 0.5, 0);
    ovoid_pair pair = {s, s, make_pose(0, 0, 0), make_pose(1.25, 0, 0)};
    ovoid_answer good = make_box_answer(s, 0.25), bad = good;
    bad.lower = nextafter(bad.lower, 1);
    const double norms[] = {1, 3, 1e-100, 1e150, 0x1p-1070};
    for (int i = 0; i < 5; i++) {
        pair.pose_b.rotation = (ovoid_quat){norms[i], 0, 0, 0};
        pair.pose_a.rotation = (ovoid_quat){0, 0, 0, 0};
        REFUSE(&pair, &good, NULL);
        pair.pose_a.rotation = (ovoid_quat){-norms[i], 0, 0, 0};
        ACCEPT(&pair, &good, NULL);
        REFUSE(&pair, &bad, NULL);
        // A quarter turn of A about x: the corner (.5, .5, .5) is where (.5, .5, -.5) was.
        pair.pose_a.rotation = (ovoid_quat){norms[i], norms[i], 0, 0};
        ovoid_answer turned = good;
        turned.proof.a[0] = find_vertex(s, 0.5, 0.5, -0.5);
        ACCEPT(&pair, &turned, NULL);
        REFUSE(&pair, &good, NULL);
    }
    // q = 2 + k turns by the angle of 3-4-5: A's corner (.5, -.5) comes to (.7, .1), B's face is at x = .75.
    pair = (ovoid_pair){s, s, {{0, 0, 0}, {2, 0, 0, 1}}, make_pose(1.25, 0, 0)};
    good.lower = 0.05 * (1 - 1e-15);
    good.upper = 0.05 * (1 + 1e-14);
    good.proof.a[0] = good.proof.a[1] = find_vertex(s, 0.5, -0.5, 0.5);
    good.proof.weight_b[0] = 0.6, good.proof.weight_b[1] = 0.4;
    good.proof.weight_a[1] = 1;
    good.point_a = (ovoid_vec3){0.7, 0.1, 0.5};
    good.point_b = (ovoid_vec3){0.75, 0.1, 0.5};
    ACCEPT(&pair, &good, NULL);
    bad = good;
    bad.lower = 0.05 * (1 + 1e-15);
    REFUSE(&pair, &bad, NULL);
    bad = good;
    bad.upper = 0.05 * (1 - 1e-14);
    bad.lower = 0;
    bad.status = OVOID_UNDECIDED;
    REFUSE(&pair, &bad, NULL);
    ovoid_shape_destroy(s);
    judge_forget(court);
}

// Spheres 3-4-12 apart: 13, less the radii; and lengths from 1e-100 to 1e50 in one pair.
static void test_spheres_and_spread(void) {
    ovoid_shape *a = ovoid_shape_create_sphere(2, NULL, NULL), *b = ovoid_shape_create_sphere(1, NULL, NULL);
    ovoid_pair pair = {a, b, make_pose(0, 0, 0), make_pose(3, 4, 12)};
    ovoid_answer good = {.status = OVOID_SEPARATED, .lower = 10, .upper = 10}, bad;
    good.proof.normal = (ovoid_vec3){3, 4, 12};
    good.normal = (ovoid_vec3){3 / 13.0, 4 / 13.0, 12 / 13.0};
    good.proof.kind = OVOID_PROOF_POINTS;
    good.proof.count = 1;
    good.proof.weight_a[0] = good.proof.weight_b[0] = 1;
    good.point_a = (ovoid_vec3){6 / 13.0, 8 / 13.0, 24 / 13.0};
    good.point_b = (ovoid_vec3){36 / 13.0, 48 / 13.0, 144 / 13.0};
    ACCEPT(&pair, &good, NULL);
    CHECK_EQ(judge_verify_points(court, &pair, &good, NULL), OVOID_OK);
    ALTER(bad.lower = nextafter(10, 11); bad.upper = 11, REFUSE);
    ALTER(bad.upper = nextafter(10, 9); bad.lower = 9, REFUSE);
    ALTER(bad.point_a.z += 1e-11, REFUSE);
    // Overlapping: centres 13 apart, radii 8 and 8.
    ovoid_shape *c = ovoid_shape_create_sphere(8, NULL, NULL);
    pair = (ovoid_pair){c, c, make_pose(0, 0, 0), make_pose(3, 4, 12)};
    good.status = OVOID_OVERLAPPING;
    good.lower = good.upper = -3;
    good.point_a = (ovoid_vec3){24 / 13.0, 32 / 13.0, 96 / 13.0};
    good.point_b = (ovoid_vec3){15 / 13.0, 20 / 13.0, 60 / 13.0};
    ACCEPT(&pair, &good, NULL);
    CHECK_EQ(judge_verify_points(court, &pair, &good, NULL), OVOID_OK);
    ALTER(bad.lower = nextafter(-3, 0), REFUSE);
    ALTER(bad.upper = nextafter(-3, -4); bad.lower = -4, REFUSE);
    // Touching: 16 apart along x.
    pair.pose_b = make_pose(16, 0, 0);
    good.proof.normal = good.normal = (ovoid_vec3){1, 0, 0};
    good.point_a = good.point_b = (ovoid_vec3){8, 0, 0};
    good.status = OVOID_TOUCHING;
    good.lower = good.upper = 0;
    ACCEPT(&pair, &good, NULL);
    ALTER(bad.lower = -1e-3, REFUSE); // wide for a touch
    judge_set_options(court, &(ovoid_options){.absolute_tolerance = 1e-3});
    ALTER(bad.lower = -1e-3, ACCEPT);
    judge_set_options(court, NULL);
    // Spread: a tiny vertical step on top of a huge gap is seen.
    pair.pose_a = make_pose(-1e50, 0, 1e-100);
    pair.pose_b = make_pose(1e50, 0, 1e-100);
    good.status = OVOID_SEPARATED;
    good.point_a = (ovoid_vec3){-1e50, 0, 0};
    good.point_b = (ovoid_vec3){1e50, 0, 0};
    good.lower = nextafter(2e50, 0);
    good.upper = 2e50;
    ACCEPT(&pair, &good, NULL);
    ALTER(bad.lower = 2e50, REFUSE);
    pair.pose_b.position.z = 1e-90;
    ALTER(bad.proof.normal.z = 1e-200, ACCEPT);
    ovoid_shape_destroy(a), ovoid_shape_destroy(b), ovoid_shape_destroy(c);
    judge_forget(court);
}

static const double corners[8][3] = {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1},
                                     {-1, -1, 1},  {1, -1, 1},  {-1, 1, 1},  {1, 1, 1}};

// The difference of two unit cubes: corner d of [-1, 1]^3 is the corner d / 2 of B minus the opposite one of A.
static void set_difference(const ovoid_shape *s, int corner, uint32_t *a, uint32_t *b) {
    const double *d = corners[corner];
    *b = find_vertex(s, d[0] / 2, d[1] / 2, d[2] / 2);
    *a = find_vertex(s, -d[0] / 2, -d[1] / 2, -d[2] / 2);
}

// Cubes in one place: the tetrahedron of four differences has its faces 1/sqrt(3) = 0.57735026918962576451 away.
static void test_hull(void) {
    ovoid_shape *s = make_box(0.5, 0.5, 0.5, 0);
    ovoid_pair pair = {s, s, make_pose(0, 0, 0), make_pose(0, 0, 0)};
    ovoid_answer good = {.status = OVOID_OVERLAPPING, .lower = -1, .upper = -0.57735026918962573}, bad;
    good.normal = good.proof.normal = (ovoid_vec3){1, 0, 0};
    good.proof.kind = OVOID_PROOF_HULL;
    good.proof.count = 4;
    const int of[4] = {7, 1, 2, 4};
    for (int i = 0; i < 4; i++) {
        set_difference(s, of[i], &good.proof.a[i], &good.proof.b[i]);
        good.proof.weight_a[i] = good.proof.weight_b[i] = 0.25;
    }
    ACCEPT(&pair, &good, NULL);
    ALTER(bad.upper = nextafter(good.upper, -1), REFUSE);
    ALTER(bad.upper = -1e-300, ACCEPT);
    ALTER(bad.lower = nextafter(-1, 0), REFUSE);
    ALTER(bad.proof.count = 3, REFUSE);
    ALTER(bad.proof.a[3] = bad.proof.a[2]; bad.proof.b[3] = bad.proof.b[2], REFUSE);
    ALTER(bad.proof.weight_a[0] = NAN, ACCEPT); // not used: the point is inside the cube
    ALTER(bad.point_b.x = 0.5 + 1e-12, REFUSE);
    good.point_a.x = good.point_b.x = 0.5;
    // The origin leaves the tetrahedron through the face x + y + z = -1.
    ALTER(pair.pose_b.position.x = 1; bad.upper = -1e-300; bad.lower = -2, REFUSE);
    pair.pose_b.position.x = 1 - 0x1p-50;
    ALTER(bad.upper = -1e-300; bad.lower = -2, ACCEPT);
    ovoid_shape_destroy(s);
    judge_forget(court);
}

// A point in an octahedron: the double pyramid of all six corners, its faces 1/sqrt(3) away; of five, none.
static void test_double_pyramid(void) {
    static const double xyz[] = {0, 0, 1, 0, 0, -1, 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0};
    ovoid_shape *a = ovoid_shape_create_sphere(0, NULL, NULL), *b = ovoid_shape_create_from_points(xyz, 6, NULL, NULL);
    ovoid_pair pair = {a, b, make_pose(0, 0, 0), make_pose(0, 0, 0)};
    ovoid_answer good = {.status = OVOID_OVERLAPPING, .lower = -1, .upper = -0.57735026918962573}, bad;
    good.normal = good.proof.normal = (ovoid_vec3){1, 0, 0};
    good.proof.kind = OVOID_PROOF_HULL;
    good.proof.count = 6;
    for (int i = 0; i < 6; i++) {
        good.proof.b[i] = find_vertex(b, xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]);
        good.proof.weight_a[i] = good.proof.weight_b[i] = 1;
    }
    ACCEPT(&pair, &good, NULL);
    ALTER(bad.upper = nextafter(good.upper, -1), REFUSE);
    ALTER(bad.proof.count = 5, REFUSE); // half of the ring: the origin is on its boundary
    ALTER(bad.proof.b[3] = good.proof.b[4]; bad.proof.b[4] = good.proof.b[3], REFUSE); // the ring crosses itself
    ALTER(bad.proof.count = 4, REFUSE);
    // Away from the centre the half octahedron with y > x will do: the face x + y = 0 is 0.125 sqrt(2) away.
    pair.pose_a.position = (ovoid_vec3){-0.125, 0.125, 0};
    good.proof.count = 5; // without -y
    good.proof.b[2] = find_vertex(b, 1, 0, 0);
    good.point_a = good.point_b = pair.pose_a.position;
    good.upper = -0.125;
    ACCEPT(&pair, &good, NULL);
    ALTER(bad.upper = -0.1251, REFUSE);
    ovoid_shape_destroy(a), ovoid_shape_destroy(b);
    judge_forget(court);
}

// The cover of all of [-1, 1]^3, moved by 0.75 along x: depth 0.25 exactly.
static void test_cover(void) {
    static const uint16_t triangles[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                              {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    ovoid_shape *s = make_box(0.5, 0.5, 0.5, 0);
    ovoid_pair pair = {s, s, make_pose(0, 0, 0), make_pose(0.75, 0, 0)};
    static own_cover whole, broken;
    own_cover_set(&whole, 8, 12);
    for (int i = 0; i < 8; i++) set_difference(s, i, &whole.a[i], &whole.b[i]);
    memcpy(whole.triangles, triangles, sizeof triangles);
    ovoid_answer good = {.status = OVOID_OVERLAPPING, .lower = -0.25, .upper = -0.25}, bad = good;
    good.normal = good.proof.normal = (ovoid_vec3){1, 0, 0};
    good.proof.kind = OVOID_PROOF_COVER;
    good.point_a = (ovoid_vec3){0.5, 0, 0};
    good.point_b = (ovoid_vec3){0.25, 0, 0};
    ACCEPT(&pair, &good, &whole.cover);
    CHECK_EQ(judge_verify_points(court, &pair, &good, NULL), OVOID_OK);
    REFUSE(&pair, &good, NULL);
    bad = good;
    bad.upper = nextafter(-0.25, -1), bad.lower = -1;
    REFUSE(&pair, &bad, &whole.cover);
    bad = good;
    bad.point_a.x += 1e-12;
    REFUSE(&pair, &bad, &whole.cover);
#define BREAK(statement)                                                                                               \
    do {                                                                                                               \
        own_cover_copy(&broken, &whole.cover);                                                                         \
        statement;                                                                                                     \
        REFUSE(&pair, &good, &broken.cover);                                                                           \
    } while (0)
    BREAK(broken.cover.triangle_count = 11);
    BREAK(broken.cover.triangle_count = 0);
    BREAK(broken.cover.triangle_count = 2 * OVOID_COVER_POINTS_MAX + 1);
    BREAK(broken.cover.point_count = 7);
    BREAK(broken.cover.point_count = OVOID_COVER_POINTS_MAX + 1);
    BREAK(broken.a[3] = 8);
    BREAK(broken.triangles[5][0] = 8);
    BREAK(broken.triangles[3][0] = 7; broken.triangles[3][1] = 5); // one triangle turned over
    BREAK(memcpy(broken.triangles[1], broken.triangles[0], sizeof broken.triangles[0]));
    BREAK(broken.a[0] = broken.a[1]); // a corner moved inward: 0.25 / sqrt(1.5) from the origin
    // Outside: the surface does not wind around the origin.
    pair.pose_b.position.x = 1.25;
    good.point_b.x = 0.75;
    good.lower = -1;
    REFUSE(&pair, &good, &whole.cover);
    ovoid_shape_destroy(s);
    judge_forget(court);
}

// Cubes in one place: two balls of nearly radius 0.5 around a common point.
static void test_inner(void) {
    ovoid_shape *s = make_box(0.5, 0.5, 0.5, 0.125);
    ovoid_ellipsoid e = ovoid_shape_get_inner(s).ellipsoid;
    CHECK_NEAR(ovoid_ellipsoid_compute_radii(&e).z, 0.5, 1e-6);
    ovoid_pair pair = {s, s, make_pose(0, 0, 0), make_pose(0.25, 0, 0)};
    ovoid_answer good = {.status = OVOID_OVERLAPPING, .lower = -1}, bad;
    good.normal = good.proof.normal = (ovoid_vec3){1, 0, 0};
    good.proof.kind = OVOID_PROOF_INNER;
    good.proof.inner_a = good.point_a = good.point_b = (ovoid_vec3){0.125, 0, 0};
    // 0.125 of 0.5 is used up on each side: depth 0.75 by balls, and the radii. The solver's gap of 1e-6 in the volume.
    good.upper = -0.75 * (1 - 1e-5) - 0.25;
    ACCEPT(&pair, &good, NULL);
    ALTER(bad.upper = -1 - 1e-9; bad.lower = -2, REFUSE);
    ALTER(bad.proof.inner_a.x = bad.point_a.x = bad.point_b.x = 0.5; bad.upper = -0.25 * 1.0001, REFUSE);
    ALTER(bad.proof.inner_a.x = NAN, REFUSE);
    ALTER(bad.point_a.x = 0.625 + 1e-12, REFUSE);
    // Two points of the balls, apart.
    pair.pose_b.position.x = 2;
    good.status = OVOID_SEPARATED;
    good.lower = 0.75;
    good.upper = 1 + 2e-5 - 0.25;
    good.proof.kind = OVOID_PROOF_INNER_POINTS;
    good.proof.inner_a = (ovoid_vec3){0.5 - 1e-5, 0, 0};
    good.proof.inner_b = (ovoid_vec3){-0.5 + 1e-5, 0, 0};
    good.point_a = (ovoid_vec3){0.625 - 1e-5, 0, 0};
    good.point_b = (ovoid_vec3){1.375 + 1e-5, 0, 0};
    good.upper = nextafter(good.upper, 1);
    ACCEPT(&pair, &good, NULL);
    ALTER(bad.upper = 0.75 + 1.9e-5, REFUSE);
    ALTER(bad.proof.inner_a.x = 0.5 + 1e-9, REFUSE);
    ALTER(bad.proof.inner_b.y = 0.1, REFUSE);
    ovoid_shape_destroy(s);
    judge_forget(court);
}

static void test_refusals(void) {
    ovoid_shape *s = make_box(0.5, 0.5, 0.5, 0);
    ovoid_pair pair = {s, s, make_pose(NAN, 0, 0), make_pose(0, 0, 0)};
    ovoid_answer good = {.limit = OVOID_LIMIT_POSE_A, .lower = -INFINITY, .upper = INFINITY}, bad;
    ACCEPT(&pair, &good, NULL);
    ALTER(bad.limit = OVOID_LIMIT_POSE_B, REFUSE);
    ALTER(bad.upper = 1, REFUSE);
    ALTER(bad.status = OVOID_SEPARATED, REFUSE);
    ALTER(bad.limit = OVOID_LIMIT_NONE, REFUSE);
    pair.pose_a = make_pose(2e50, 0, 0);
    ACCEPT(&pair, &good, NULL);
    pair.pose_a = make_pose(0, 0, 0);
    REFUSE(&pair, &good, NULL);
    ALTER(bad.limit = OVOID_LIMIT_OPTIONS, ACCEPT);
    CHECK_EQ(judge_verify_answer(court, NULL, &good, NULL, NULL), OVOID_ERROR_ARGUMENT);
    ovoid_shape_destroy(s);
}

// Bytes that are no answer at all: refused, or accepted for the nothing that they claim; never a crash.
static void test_garbage(void) {
    ovoid_shape *s = make_box(0.5, 0.5, 0.5, 0.25);
    ovoid_pair pair = {s, s, make_pose(0, 0, 0), make_pose(0.5, 0.25, 0)};
    static own_cover cover;
    uint64_t state = 7;
    for (int i = 0; i < 4000; i++) {
        ovoid_answer x = {.status = (ovoid_status)(random_next(&state) % 4), .lower = -1, .upper = 1};
        for (size_t k = 2; k < sizeof x / 8; k++)
            if (random_next(&state) % 4 == 0) {
                uint64_t word = random_next(&state) >> random_next(&state) % 64;
                memcpy((char *)&x + 8 * k, &word, 8);
            }
        x.normal = x.proof.normal = (ovoid_vec3){1, 0, 0};
        x.proof.kind = (ovoid_proof_kind)(random_next(&state) % 7);
        x.proof.count = (uint32_t)(random_next(&state) % 8);
        for (int k = 0; k < OVOID_PROOF_PAIRS; k++) x.proof.a[k] %= 10, x.proof.b[k] %= 10;
        own_cover_set(&cover, (uint32_t)(random_next(&state) % (OVOID_COVER_POINTS + 1)),
                      (uint32_t)(random_next(&state) % (2 * OVOID_COVER_POINTS + 1)));
        for (size_t k = 0; k < 16; k++) cover.a[k] = (uint32_t)(random_next(&state) % 9);
        for (size_t k = 0; k < 16; k++) cover.triangles[k][k % 3] = (uint16_t)(random_next(&state) % 20);
        ovoid_code code = judge_it(&pair, &x, &cover.cover);
        // The bodies overlap by 0.5 and both radii: what is accepted must at least say so.
        if (code == OVOID_OK) CHECK(x.lower <= -1 && x.upper >= -1);
        check_passed++;
    }
    ovoid_shape_destroy(s);
    judge_forget(court);
}

// --- the truth by brute force, against closed forms

static void check_truth(const ovoid_pair *pair, double d, int sign, int line) {
    judge_truth truth;
    CHECK_EQ(judge_compute_truth(court, pair, &truth, NULL), OVOID_OK);
    int ok = truth.sign == sign && truth.low <= d && d <= truth.high &&
             truth.high - truth.low <= 4 * 0x1p-52 * fmax(fabs(d), 1e-300);
    if (!ok) printf("line %d: sign %d, [%.17g, %.17g] for %.17g\n", line, truth.sign, truth.low, truth.high, d);
    CHECK(ok);
}
#define TRUTH(pair, d, sign) check_truth(pair, d, sign, __LINE__)

static ovoid_shape *make_points(const double *xyz, size_t count) {
    return ovoid_shape_create_from_points(xyz, count, NULL, NULL);
}

static void test_truth(void) {
    ovoid_shape *s = make_box(0.5, 0.5, 0.5, 0), *round = make_box(0.5, 0.5, 0.5, 0.25);
    ovoid_pair pair = {s, s, make_pose(0, 0, 0), make_pose(1.25, 0.5, -0.25)};
    TRUTH(&pair, 0.25, 1); // face to face
    pair.pose_b = make_pose(4, 5, 0.25);
    TRUTH(&pair, 5, 1); // edge to edge, 3-4
    pair.pose_b = make_pose(4, 5, 13);
    TRUTH(&pair, 13, 1); // corner to corner, 3-4-12
    pair.shape_b = round;
    TRUTH(&pair, 12.75, 1);
    pair.pose_b = make_pose(1.25, 0, 0);
    TRUTH(&pair, 0, 0); // touching by its radius
    pair.pose_b = make_pose(0.25, 0.125, 0);
    TRUTH(&pair, -1, -1); // 0.75 deep, and the radius
    pair.shape_b = s;
    TRUTH(&pair, -0.75, -1);
    pair.pose_b = make_pose(1, 0.125, 0);
    TRUTH(&pair, 0, 0);
    pair.pose_b = make_pose(1 - 0x1p-40, 0.125, 0);
    TRUTH(&pair, -0x1p-40, -1);
    pair.pose_b = make_pose(0, 0, 0);
    TRUTH(&pair, -1, -1);
    // 3-4-5: B's corner points along -x, 0.7 long.
    pair.pose_b = (ovoid_pose){{1.25, 0, 0}, {2, 0, 0, 1}};
    judge_truth truth;
    CHECK_EQ(judge_compute_truth(court, &pair, &truth, NULL), OVOID_OK);
    CHECK_NEAR(truth.low, 0.05, 1e-16);

    // Flat bodies: crossing squares have depth 0, a segment through a square too; parallel segments; points.
    const double square[] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0}, segment[] = {0, 0, -1, 0, 0, 2};
    const double segment_x[] = {-1, 0, 0, 1, 0, 0}, point[] = {0, 0, 0};
    ovoid_shape *q = make_points(square, 4), *z = make_points(segment, 2), *x = make_points(segment_x, 2);
    ovoid_shape *o = make_points(point, 1);
    pair = (ovoid_pair){q, z, make_pose(0, 0, 0), make_pose(0, 0, 0)};
    TRUTH(&pair, -1, -1); // the prism [-1, 1]^2 x [-2, 1]
    pair.pose_b = make_pose(3, 0, 0);
    TRUTH(&pair, 2, 1);
    pair = (ovoid_pair){q, q, make_pose(0, 0, 0), make_pose(0, 0, 0)};
    TRUTH(&pair, 0, 0); // coplanar
    pair.pose_b = make_pose(5, 0, 0);
    TRUTH(&pair, 3, 1);
    pair = (ovoid_pair){x, x, make_pose(0, 0, 0), make_pose(1, 0, 0)};
    TRUTH(&pair, 0, 0); // collinear, sharing a part
    pair.pose_b = make_pose(5, 4, 0);
    TRUTH(&pair, 5, 1);
    pair = (ovoid_pair){x, z, make_pose(0, 0, 0), make_pose(0, 0, 0)};
    TRUTH(&pair, 0, 0); // crossing
    pair.pose_b = make_pose(0, 0.5, 0);
    TRUTH(&pair, 0.5, 1);
    pair = (ovoid_pair){o, o, make_pose(1, 1, 1), make_pose(1, 1, 1)};
    TRUTH(&pair, 0, 0);
    pair.pose_b = make_pose(2, 3, 3);
    TRUTH(&pair, 3, 1);
    pair = (ovoid_pair){o, s, make_pose(0.25, 0, 0), make_pose(0, 0, 0)};
    TRUTH(&pair, -0.25, -1); // a point inside a cube
    ovoid_shape_destroy(q), ovoid_shape_destroy(z), ovoid_shape_destroy(x), ovoid_shape_destroy(o);
    ovoid_shape_destroy(s), ovoid_shape_destroy(round);
    judge_forget(court);
}

int main(void) {
    court = judge_create();
    if (!CHECK(court != NULL)) return check_end();
    test_numbers_altered();
    test_proofs_altered();
    test_rotations();
    test_spheres_and_spread();
    test_hull();
    test_double_pyramid();
    test_cover();
    test_inner();
    test_refusals();
    test_garbage();
    test_truth();
    judge_destroy(court);
    return check_end();
}
