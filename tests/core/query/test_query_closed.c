// Points, segments and boxes with radii, in closed form (exact/closed.c). Truth: distances known by construction; of
// random pairs the least distance of a segment's points from the other core, a convex function of one parameter, by
// sections in long double, with the rotations in long double too. Tolerance 1e-12 of sizes of about 5, some thousand
// roundings. Each answer is put before ovoid_answer_verify, and must be one without a search.
#include "ovoid/ovoid.h"
#include "ovoid/prepared.h"

#include "check.h"
#include "places.h"
#include "proofs/covers.h"

#include <string.h>

typedef long double real;

static const ovoid_quat upright = {1, 0, 0, 0};

static ovoid_vec3 random_place(uint64_t *r) {
    double x = random_normal(r), y = random_normal(r), z = random_normal(r);
    return (ovoid_vec3){x, y, z};
}

/// The answer, verified; is_quick: it must be one in closed form, whatever earlier proof comes with it.
static ovoid_answer ask(const ovoid_pair *pair, int is_depth, int is_quick) {
    STATIC_COVER(cover);
    ovoid_error error = {0};
    ovoid_answer answer = is_depth ? ovoid_depth(pair, NULL, NULL, &cover) : ovoid_distance(pair, NULL, NULL);
    const ovoid_answer_basis basis = {.cover = is_depth ? &cover : NULL};
    if (!CHECK(ovoid_answer_verify(pair, &answer, &basis, &error) == OVOID_OK)) printf("%s\n", error.message);
    if (is_quick) CHECK(answer.stage == OVOID_STAGE_SUPPORT && answer.iterations == 0);
    // No earlier proof makes another answer.
    ovoid_proof earlier = answer.proof;
    earlier.normal.x = -earlier.normal.x;
    ovoid_answer again = is_depth ? ovoid_depth(pair, NULL, &earlier, NULL) : ovoid_distance(pair, NULL, &earlier);
    if (is_quick) CHECK(memcmp(&again, &answer, sizeof answer) == 0);
    return answer;
}

static void check_known(const ovoid_shape *a, const ovoid_shape *b, ovoid_pose b_in_a, double d) {
    uint64_t r = 5;
    for (int i = 0; i < 12; i++) {
        ovoid_pose move = {random_place(&r), random_quat(&r)};
        ovoid_pair pair = {a, b, {{0, 0, 0}, upright}, b_in_a};
        if (i > 0) pair.pose_a = move, pair.pose_b = ovoid_pose_compute_product(&move, &b_in_a);
        if (i % 2) pair = (ovoid_pair){pair.shape_b, pair.shape_a, pair.pose_b, pair.pose_a};
        ovoid_answer answer = ask(&pair, 1, 1);
        CHECK_NEAR(answer.lower, d, 1e-12);
        CHECK_NEAR(answer.upper, d, 1e-12);
        ovoid_vec3 n = answer.normal, p = answer.point_a, q = answer.point_b;
        CHECK_NEAR((q.x - p.x) * n.x + (q.y - p.y) * n.y + (q.z - p.z) * n.z, d, 1e-12);
        CHECK_EQ((int)ovoid_collide(&pair, NULL, NULL).status, (int)(d > 0 ? OVOID_SEPARATED : OVOID_OVERLAPPING));
        ovoid_answer within = ovoid_within(&pair, 0.75, NULL, NULL);
        CHECK_EQ(ovoid_answer_is_within(&within, 0.75), d <= 0.75);
    }
}

/// The depth of a core that is inside, in closed form.
static void check_depth(const ovoid_shape *a, const ovoid_shape *b, ovoid_pose b_in_a, double d) {
    uint64_t r = 31;
    for (int i = 0; i < 12; i++) {
        ovoid_pose move = i > 1 ? (ovoid_pose){random_place(&r), random_quat(&r)} : (ovoid_pose){{0, 0, 0}, upright};
        ovoid_pair pair = {a, b, move, ovoid_pose_compute_product(&move, &b_in_a)};
        if (i % 2) pair = (ovoid_pair){pair.shape_b, pair.shape_a, pair.pose_b, pair.pose_a};
        ovoid_answer answer = ask(&pair, 1, 1);
        CHECK_NEAR(answer.lower, d, 1e-12);
        CHECK_NEAR(answer.upper, d, 1e-12);
        ovoid_vec3 n = answer.normal, p = answer.point_a, q = answer.point_b;
        CHECK_NEAR(q.x - p.x, d * n.x, 1e-12);
        CHECK_NEAR(q.y - p.y, d * n.y, 1e-12);
        CHECK_NEAR(q.z - p.z, d * n.z, 1e-12);
    }
}

static void test_known(void) {
    ovoid_shape *ball = ovoid_shape_create_sphere(0.5, NULL, NULL),
                *pill = ovoid_shape_create_capsule(0.5, 2, NULL, NULL),
                *box = ovoid_shape_create_box((ovoid_vec3){1, 2, 3}, NULL, NULL),
                *dot = ovoid_shape_create_capsule(0.5, 0, NULL, NULL);
    const ovoid_quat lying = {1, 1, 0, 0}, slanted = {cos(0.3926990816987241), 0, -sin(0.3926990816987241), 0};
    check_known(ball, ball, (ovoid_pose){{3, 0, 0}, lying}, 2);
    check_known(ball, ball, (ovoid_pose){{0, 0.25, 0}, lying}, -0.75);
    check_known(ball, dot, (ovoid_pose){{0, 0, 0}, upright}, -1);
    check_known(dot, pill, (ovoid_pose){{0, 3, 5}, upright}, sqrt(18) - 1);
    check_known(ball, pill, (ovoid_pose){{3, 0, 1}, upright}, 2);
    check_known(ball, pill, (ovoid_pose){{0, 0, 1}, upright}, -1);
    check_known(pill, pill, (ovoid_pose){{0, 3.25, 0}, lying}, 0.25);
    check_known(pill, pill, (ovoid_pose){{3, 0, 0}, lying}, 2);
    check_known(pill, pill, (ovoid_pose){{0.25, 0, 0}, lying}, -0.75);
    check_known(pill, pill, (ovoid_pose){{0, 3, 1}, upright}, 2);
    check_known(pill, pill, (ovoid_pose){{0, 0, 7}, upright}, 2);
    check_known(pill, pill, (ovoid_pose){{0, 0.25, 1}, upright}, -0.75);
    // Cores that nearly cross: their difference is too short for the digits of a direction.
    check_known(pill, pill, (ovoid_pose){{0, 1e-13, 0}, (ovoid_quat){1, 0, 0.5, 0}}, 1e-13 - 1);
    check_known(pill, pill, (ovoid_pose){{0, 1e-10, 0.5}, (ovoid_quat){1, 0, -2, 0}}, 1e-10 - 1);
    check_known(box, ball, (ovoid_pose){{3, 1, -2}, lying}, 1.5);
    check_known(box, ball, (ovoid_pose){{-2, 3, -2}, lying}, sqrt(2) - 0.5);
    check_known(box, ball, (ovoid_pose){{2, -3, 4}, lying}, sqrt(3) - 0.5);
    check_known(box, ball, (ovoid_pose){{1.25, 0, 0}, upright}, -0.25);
    check_known(box, pill, (ovoid_pose){{3, 0, 0}, upright}, 1.5);
    check_known(box, pill, (ovoid_pose){{3, 3, 2}, upright}, sqrt(5) - 0.5);
    check_known(box, pill, (ovoid_pose){{0, 5, 0}, lying}, 0.5);
    check_known(box, pill, (ovoid_pose){{1.5, 0, 3.5}, slanted}, sqrt(0.5) - 0.5);
    check_known(box, pill, (ovoid_pose){{2, 3, 6}, upright}, sqrt(3) - 0.5);
    ovoid_shape_destroy(ball);
    ovoid_shape_destroy(pill);
    ovoid_shape_destroy(box);
    ovoid_shape_destroy(dot);
}

// The depth of a ball whose centre is in a box, and of a pill along one of its edges: the least way to a face. A common
// point of the cores does not answer that.
static void test_inside(void) {
    ovoid_shape *ball = ovoid_shape_create_sphere(0.5, NULL, NULL),
                *pill = ovoid_shape_create_capsule(0.5, 0.5, NULL, NULL),
                *box = ovoid_shape_create_box((ovoid_vec3){1, 2, 3}, NULL, NULL);
    const ovoid_quat lying = {1, 1, 0, 0}, over = {0, 1, 0, 0}, slanted = {1, 0.25, 0.125, 0};
    check_depth(box, ball, (ovoid_pose){{0.5, 0.75, -1}, slanted}, -1);
    check_depth(box, ball, (ovoid_pose){{-0.25, 1.75, 1}, lying}, -0.75);
    check_depth(box, ball, (ovoid_pose){{0.25, -1, -2.5}, lying}, -1);
    check_depth(box, ball, (ovoid_pose){{0, 0, 0}, lying}, -1.5);
    check_depth(box, pill, (ovoid_pose){{0.25, 0.5, 1}, upright}, -1.25);
    check_depth(box, pill, (ovoid_pose){{-0.25, 0.5, 1}, over}, -1.25);
    check_depth(box, pill, (ovoid_pose){{0.25, 1.875, 1}, lying}, -1.125);
    check_depth(box, pill, (ovoid_pose){{0.25, -1.875, -1}, lying}, -1.125);
    check_depth(box, pill, (ovoid_pose){{0.25, 0, 3}, over}, -1);
    check_depth(box, pill, (ovoid_pose){{0.25, 0, -3}, upright}, -1);
    // Another direction: by the search for all pairs.
    ovoid_pair pair = {box, pill, {{0, 0, 0}, upright}, {{0.25, 0.5, 0}, {2, 0, 1, 0}}};
    ovoid_answer answer = ask(&pair, 1, 0);
    CHECK_NEAR(answer.lower, -1.65, 1e-8);
    CHECK_NEAR(answer.upper, -1.65, 1e-8);
    ovoid_shape_destroy(ball);
    ovoid_shape_destroy(pill);
    ovoid_shape_destroy(box);
}

// ---- the same bits alone, prepared and, where the closed form answers, in a batch

static ovoid_answer ask_question(const ovoid_pair *pair, int question) {
    return question == 0   ? ovoid_collide(pair, NULL, NULL)
           : question == 1 ? ovoid_distance(pair, NULL, NULL)
                           : ovoid_within(pair, 0.5, NULL, NULL);
}

// What the spheres decide, a batch may decide by other spheres than the single query: another bound, as true.
static void check_spheres(const ovoid_pair *pair, const ovoid_answer *alone, const ovoid_answer *batch) {
    CHECK(batch->stage == OVOID_STAGE_SPHERE && batch->status == OVOID_SEPARATED);
    CHECK(batch->lower <= alone->upper && alone->lower <= batch->upper);
    CHECK(ovoid_answer_verify(pair, batch, NULL, NULL) == OVOID_OK);
}

static void check_same(const ovoid_pair *pair, int question) {
    ovoid_answer alone = ask_question(pair, question), prepared, several[4];
    const ovoid_posed_shape bodies[2] = {{pair->shape_a, pair->pose_a}, {pair->shape_b, pair->pose_b}};
    const ovoid_couple couples[4] = {{0, 1}, {0, 1}, {0, 1}, {0, 1}};
    ovoid_prepared_shape a, b;
    ovoid_prepared_shape_make(&bodies[0], &a);
    ovoid_prepared_shape_make(&bodies[1], &b);
    const ovoid_prepared_pair both = {&a, &b};
    const ovoid_evidence out = {.answer = &prepared};
    const ovoid_batch batch = {
        .bodies = bodies, .body_count = 2, .couples = couples, .couple_count = 4, .answers = several};
    if (question == 0) (void)ovoid_prepared_collide(both, NULL, &out), (void)ovoid_collide_batch(&batch, NULL);
    if (question == 1) (void)ovoid_prepared_distance(both, NULL, &out), (void)ovoid_distance_batch(&batch, NULL);
    if (question == 2) (void)ovoid_prepared_within(both, 0.5, NULL, &out), (void)ovoid_within_batch(&batch, 0.5, NULL);
    CHECK(memcmp(&alone, &prepared, sizeof alone) == 0);
    CHECK(memcmp(&several[0], &several[3], sizeof alone) == 0);
    if (alone.stage == OVOID_STAGE_SPHERE)
        check_spheres(pair, &alone, &several[3]);
    else
        CHECK(memcmp(&alone, &several[3], sizeof alone) == 0);
    ovoid_error error = {0};
    if (!CHECK(ovoid_answer_verify(pair, &alone, NULL, &error) == OVOID_OK)) printf("%s\n", error.message);
}

// Spheres take a way of their own where nothing of them is prepared. Places on a grid, with zeros of both signs: they
// touch, are one in the other or concentric, and components of differences are zero, whose signs the rotations must not
// set.
static void test_same_bits(void) {
    uint64_t r = 23;
    const double aside[3] = {0.25, -0.5, 0};
    const ovoid_shape_options rounded = {.radius = 0.25};
    ovoid_shape *shapes[5] = {ovoid_shape_create_sphere(0.5, NULL, NULL), ovoid_shape_create_sphere(1, NULL, NULL),
                              ovoid_shape_create_sphere(0, NULL, NULL),
                              ovoid_shape_create_capsule(0.25, 0.5, NULL, NULL),
                              ovoid_shape_create_from_points(aside, 1, &rounded, NULL)};
    const double grid[5] = {-0.0, 0.0, 0.5, -1.5, 2};
    for (int i = 0; i < 6000; i++) {
        check_seed = (uint64_t)i;
        double at[6];
        for (int k = 0; k < 6; k++) at[k] = grid[(size_t)random_uniform(&r, 0, 4.999)];
        ovoid_quat q = random_quat(&r), p = i % 2 ? random_quat(&r) : (ovoid_quat){-1, -0.0, 0, 0};
        if (i % 7 == 0) p = (ovoid_quat){1e-200, 0, 3e-200, 0};
        ovoid_pair pair = {shapes[i % 5], shapes[i / 5 % 5], {{at[0], at[1], at[2]}, q}, {{at[3], at[4], at[5]}, p}};
        for (int question = 0; question < 3; question++) check_same(&pair, question);
    }
    for (int i = 0; i < 5; i++) ovoid_shape_destroy(shapes[i]);
}

// What is refused of any pair is refused of spheres, by the same reason.
static void test_refused(void) {
    ovoid_shape *ball = ovoid_shape_create_sphere(0.5, NULL, NULL);
    const ovoid_pose still = {{0, 0, 0}, upright};
    ovoid_pose bad[5] = {still, still, still, still, still};
    bad[0].position.x = NAN;
    bad[1].position.y = 2 * OVOID_LENGTH_MAX;
    bad[2].rotation.w = 0;
    bad[3].rotation.z = INFINITY;
    bad[4].position.z = -INFINITY;
    for (int i = 0; i < 5; i++) {
        ovoid_pair a = {ball, ball, bad[i], still}, b = {ball, ball, still, bad[i]};
        CHECK_EQ((int)ovoid_distance(&a, NULL, NULL).limit, (int)OVOID_LIMIT_POSE_A);
        CHECK_EQ((int)ovoid_distance(&b, NULL, NULL).limit, (int)OVOID_LIMIT_POSE_B);
    }
    const ovoid_options wrong = {.absolute_tolerance = -1}, capped = {.cap = 0.25};
    ovoid_pair pair = {ball, ball, still, {{3, 0, 0}, upright}};
    CHECK_EQ((int)ovoid_distance(&pair, &wrong, NULL).limit, (int)OVOID_LIMIT_OPTIONS);
    CHECK_EQ((int)ovoid_within(&pair, NAN, NULL, NULL).limit, (int)OVOID_LIMIT_OPTIONS);
    CHECK_EQ((int)ovoid_distance(&pair, &capped, NULL).stage, (int)OVOID_STAGE_SPHERE);
    LOCAL_COVER(cover);
    cover.point_count = cover.triangle_count = 3;
    CHECK_EQ((int)ovoid_depth(&pair, NULL, NULL, &cover).status, (int)OVOID_SEPARATED);
    CHECK_EQ((int)cover.point_count, 0);
    ovoid_shape_destroy(ball);
}

// ---- the middle of what is nearest

static void check_middle(const ovoid_shape *a, const ovoid_shape *b, ovoid_pose b_in_a, ovoid_vec3 on_a) {
    uint64_t r = 29;
    for (int i = 0; i < 12; i++) {
        ovoid_pose move = {random_place(&r), random_quat(&r)};
        ovoid_pair pair = {a, b, move, ovoid_pose_compute_product(&move, &b_in_a)};
        if (i % 2) pair = (ovoid_pair){pair.shape_b, pair.shape_a, pair.pose_b, pair.pose_a};
        ovoid_answer answer = ask(&pair, 0, 1);
        ovoid_vec3 p = i % 2 ? answer.point_b : answer.point_a, q = ovoid_pose_compute_point(&move, on_a);
        CHECK_NEAR(p.x, q.x, 1e-12);
        CHECK_NEAR(p.y, q.y, 1e-12);
        CHECK_NEAR(p.z, q.z, 1e-12);
    }
}

// Where the nearest points are not unique, those in the middle of the common length.
static void test_middle(void) {
    ovoid_shape *pill = ovoid_shape_create_capsule(0.5, 2, NULL, NULL),
                *small = ovoid_shape_create_capsule(0.5, 1, NULL, NULL),
                *box = ovoid_shape_create_box((ovoid_vec3){1, 2, 3}, NULL, NULL);
    const ovoid_quat over = {0, 0, 1, 0}, lying = {1, 1, 0, 0};
    check_middle(pill, small, (ovoid_pose){{3, 0, 0.25}, upright}, (ovoid_vec3){0.5, 0, 0.25});
    check_middle(pill, small, (ovoid_pose){{3, 0, 2}, upright}, (ovoid_vec3){0.5, 0, 1.5});
    check_middle(pill, small, (ovoid_pose){{3, 0, -2}, over}, (ovoid_vec3){0.5, 0, -1.5});
    check_middle(pill, small, (ovoid_pose){{3, 0, 3}, upright}, (ovoid_vec3){0.5, 0, 2});
    check_middle(box, pill, (ovoid_pose){{3, 0, 0.25}, upright}, (ovoid_vec3){1, 0, 0.25});
    check_middle(box, pill, (ovoid_pose){{3, 0, 2}, over}, (ovoid_vec3){1, 0, 1.5});
    check_middle(box, pill, (ovoid_pose){{3, 1, -2}, lying}, (ovoid_vec3){1, 0.5, -2});
    check_middle(box, pill, (ovoid_pose){{0, 4, 5.5}, lying}, (ovoid_vec3){0, 2, 3});
    ovoid_shape_destroy(pill);
    ovoid_shape_destroy(small);
    ovoid_shape_destroy(box);
}

// ---- slanted boxes

// A parallelepiped that is no box has no closed form: coordinates along its axes would be cut off as if these were at
// right angles. Truth: the proof of each answer.
static void test_slanted(void) {
    uint64_t r = 17;
    for (int i = 0; i < 400; i++) {
        double xyz[24], slant = random_uniform(&r, 0.1, 2);
        for (int k = 0; k < 8; k++) {
            xyz[3 * k] = (k & 1 ? 1 : -1) + (k & 2 ? slant : -slant);
            xyz[3 * k + 1] = k & 2 ? 0.5 : -0.5;
            xyz[3 * k + 2] = k & 4 ? 0.75 : -0.75;
        }
        ovoid_shape *a = ovoid_shape_create_from_points(xyz, 8, NULL, NULL),
                    *b = ovoid_shape_create_capsule(0.25, i % 2 ? 0.5 : 0, NULL, NULL);
        ovoid_pair pair = {a, b, {{0, 0, 0}, random_quat(&r)}, {random_place(&r), random_quat(&r)}};
        ovoid_answer answer = ask(&pair, i % 3 == 0, 0);
        CHECK(answer.limit == OVOID_LIMIT_NONE || answer.limit == OVOID_LIMIT_ANSWERED);
        CHECK(answer.status != OVOID_SEPARATED || answer.upper - answer.lower <= 1e-8);
        ovoid_shape_destroy(a);
        ovoid_shape_destroy(b);
    }
}

// ---- random pairs

/// v turned by q, of any length.
static void turn(ovoid_quat q, const real v[3], real out[3]) {
    const real w = q.w, p[3] = {q.x, q.y, q.z}, norm = w * w + p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
    real c[3], e[3];
    for (int i = 0; i < 3; i++) c[i] = p[(i + 1) % 3] * v[(i + 2) % 3] - p[(i + 2) % 3] * v[(i + 1) % 3];
    for (int i = 0; i < 3; i++) e[i] = p[(i + 1) % 3] * c[(i + 2) % 3] - p[(i + 2) % 3] * c[(i + 1) % 3];
    for (int i = 0; i < 3; i++) out[i] = v[i] + 2 * (w * c[i] + e[i]) / norm;
}

/// The point at s of a core that is a segment along z, in the frame of the other body.
static void place(const ovoid_pair *pair, real s, real out[3]) {
    const ovoid_vec3 a = pair->pose_a.position, b = pair->pose_b.position;
    const ovoid_quat q = pair->pose_a.rotation, back = {q.w, -q.x, -q.y, -q.z};
    real x[3], local[3] = {0, 0, s};
    turn(pair->pose_b.rotation, local, x);
    const real d[3] = {x[0] + b.x - a.x, x[1] + b.y - a.y, x[2] + b.z - a.z};
    turn(back, d, out);
}

/// The distance of that point from A's core, a box of these half sizes; a segment has none in x and y.
static real measure(const ovoid_pair *pair, const double half[3], real s) {
    real x[3], square = 0;
    place(pair, s, x);
    for (int i = 0; i < 3; i++) {
        real beyond = fabsl(x[i]) - half[i];
        if (beyond > 0) square += beyond * beyond;
    }
    return sqrtl(square);
}

static real find_distance(const ovoid_pair *pair, const double half[3], double length) {
    real low = -length, high = length;
    for (int i = 0; i < 300; i++) {
        real a = low + (high - low) / 3, b = high - (high - low) / 3;
        if (measure(pair, half, a) <= measure(pair, half, b))
            high = b;
        else
            low = a;
    }
    return measure(pair, half, (low + high) / 2);
}

static void test_random(void) {
    uint64_t r = 11;
    long quick = 0, count = 0;
    for (int i = 0; i < 4000; i++) {
        check_seed = (uint64_t)i;
        double half[3] = {random_uniform(&r, 0.05, 1), random_uniform(&r, 0.05, 1), random_uniform(&r, 0.05, 1)};
        double length = i % 3 ? random_uniform(&r, 0.01, 2) : 0, radius = random_uniform(&r, 0, 0.3);
        int is_box = i % 4 != 0;
        if (!is_box) half[0] = half[1] = 0;
        if (i % 8 == 0) half[2] = 0;
        ovoid_shape *a = is_box ? ovoid_shape_create_box((ovoid_vec3){half[0], half[1], half[2]}, NULL, NULL)
                                : ovoid_shape_create_capsule(0.25, half[2], NULL, NULL);
        ovoid_shape *b = ovoid_shape_create_capsule(radius, length, NULL, NULL);
        ovoid_pair pair = {a, b, {random_place(&r), random_quat(&r)}, {random_place(&r), random_quat(&r)}};
        // One time in four of the same axes.
        if (i % 16 < 4) pair.pose_b.rotation = pair.pose_a.rotation;
        real d = find_distance(&pair, half, length);
        ovoid_answer answer = ask(&pair, i % 2, 0);
        if (d > 1e-9) {
            double truth = (double)(d - radius - (is_box ? 0 : 0.25));
            CHECK_NEAR(answer.lower, truth, 1e-12);
            if (i % 2 || truth > 0) CHECK_NEAR(answer.upper, truth, 1e-12);
            quick += answer.iterations == 0;
            count++;
        } else {
            CHECK_EQ((int)answer.status, (int)OVOID_OVERLAPPING);
        }
        ovoid_shape_destroy(a);
        ovoid_shape_destroy(b);
    }
    CHECK_LE(3000, count);
    CHECK_EQ(quick, count);
}

int main(void) {
    test_known();
    test_inside();
    test_same_bits();
    test_refused();
    test_middle();
    test_slanted();
    test_random();
    return check_end();
}
