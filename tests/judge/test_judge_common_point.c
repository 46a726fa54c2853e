// The common point of two overlapping bodies is one point, however thin they are: the weights of a few differences
// whose hull holds the origin, and the points of answers, before the check without a search and the exact judge.
#include "check.h"
#include "judge.h"
#include "ovoid/ovoid.h"
#include "pair/hull_weights.h"
#include "places.h"
#include "proofs/covers.h"

static judge *court;

// ---- the weights alone

// Corners of a hull that holds the origin at known weights: wide along one or two axes, turned.
static int make_corners(uint64_t *r, double thin, vec3 *w) {
    int count = 4 + (int)random_uniform(r, 0, 3), flat = random_uniform(r, 0, 1) < 0.5;
    double weight[6], sum = 0;
    vec3 middle = {0, 0, 0};
    for (int i = 0; i < count; i++) {
        w[i] = random_vec3(r, 1);
        w[i].y *= flat ? 1 : thin, w[i].z *= thin;
        weight[i] = random_uniform(r, 0.01, 1);
        sum += weight[i];
        middle = vec3_add_scaled(middle, w[i], weight[i]);
    }
    mat3 turn = quat_to_mat3(random_quat(r));
    for (int i = 0; i < count; i++) w[i] = mat3_mul_vec3(turn, vec3_add_scaled(w[i], middle, -1 / sum));
    return count;
}

static double measure_exactly(const vec3 *w, int count, const double *weight) {
    dd3 sum = dd3_mul_double(dd3_from(w[0]), weight[0]);
    for (int i = 1; i < count; i++) sum = dd3_add(sum, dd3_mul_double(dd3_from(w[i]), weight[i]));
    return vec3_norm(dd3_high(sum));
}

static void test_weights(void) {
    uint64_t r = 7;
    for (int k = 0; k < 4000; k++) {
        check_seed = (uint64_t)k;
        vec3 w[6];
        double thin = pow(10, -random_uniform(&r, 0, 12)), scale = pow(10, random_uniform(&r, -80, 80)), sum = 0;
        int count = make_corners(&r, thin, w), used = 0;
        for (int i = 0; i < count; i++) w[i] = vec3_scale(w[i], scale);
        double weight[6] = {0};
        hull_set_weights_of_doubles(w, count, weight);
        for (int i = 0; i < count; i++) {
            CHECK(weight[i] >= 0);
            used += weight[i] > 0;
            sum += weight[i];
        }
        CHECK(used <= 4);
        CHECK_NEAR(sum, 1, 1e-15);
        for (int i = 0; i < count; i++) w[i] = vec3_scale(w[i], 1 / scale);
        CHECK_LE(measure_exactly(w, count, weight), 1e-15);
    }
    check_seed = 0;
    // The tips of an octahedron alone hold its centre; four corners on a plane keep what they had.
    const vec3 tips[6] = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    double of_tips[6] = {0}, of_flat[4] = {0.25, 0.25, 0.25, 0.25};
    hull_set_weights_of_doubles(tips, 6, of_tips);
    CHECK_LE(hull_measure_weights(tips, 6, of_tips), 0);
    CHECK_NEAR(of_tips[0] + of_tips[1] + of_tips[2] + of_tips[3] + of_tips[4] + of_tips[5], 1, 1e-15);
    hull_set_weights_of_doubles(tips, 4, of_flat);
    CHECK_EQ(of_flat[2], 0.25);
}

// ---- answers

static ovoid_shape *make_thin(uint64_t *r, double thin) {
    double xyz[30];
    size_t count = 4 + (size_t)random_uniform(r, 0, 6);
    double flat = random_uniform(r, 0, 3), x = flat > 2 ? thin : 1, y = flat < 1 ? 1 : thin;
    for (size_t i = 0; i < count; i++) {
        vec3 p = random_vec3(r, 1);
        xyz[3 * i] = p.x * x, xyz[3 * i + 1] = p.y * y, xyz[3 * i + 2] = p.z * thin;
    }
    return ovoid_shape_create_from_points(xyz, count, NULL, NULL);
}

static vec3 place(const ovoid_shape *shape, const ovoid_pose *pose, uint32_t vertex) {
    vec3 p = vec3_at(ovoid_shape_get_polytope(shape).vertices, vertex);
    return vec3_add(pose->position, mat3_mul_vec3(quat_to_mat3(pose->rotation), p));
}

// The point of one pair of corners is in both bodies' hulls, and common to neither.
static void check_liar(const ovoid_pair *p, const ovoid_answer *x) {
    ovoid_answer y = *x;
    for (uint32_t i = 0; i < y.proof.count; i++) y.proof.weight_a[i] = y.proof.weight_b[i] = i == 0;
    y.point_a = place(p->shape_a, &p->pose_a, y.proof.a[0]);
    y.point_b = place(p->shape_b, &p->pose_b, y.proof.b[0]);
    CHECK(ovoid_answer_verify(p, &y, NULL, NULL) == OVOID_ERROR_PROOF);
    CHECK(judge_verify_answer(court, p, &y, NULL, NULL) == OVOID_ERROR_PROOF);
}

static long seen[2];

static void check_answer(const ovoid_pair *p, const ovoid_answer *x, int is_depth) {
    CHECK(ovoid_answer_verify(p, x, NULL, NULL) == OVOID_OK || x->proof.kind == OVOID_PROOF_COVER);
    if (x->proof.kind != OVOID_PROOF_HULL) return;
    CHECK(judge_verify_answer(court, p, x, NULL, NULL) == OVOID_OK);
    CHECK_LE(vec3_norm(vec3_sub(x->point_b, x->point_a)), 2e-13);
    check_liar(p, x);
    seen[is_depth]++;
}

static void test_answers(void) {
    uint64_t r = 11;
    STATIC_COVER(cover);
    for (int k = 0; k < 960; k++) {
        check_seed = (uint64_t)k;
        double thin = pow(10, -k % 16);
        ovoid_shape *a = make_thin(&r, thin), *b = make_thin(&r, thin);
        ovoid_pair p = {.shape_a = a, .shape_b = b};
        p.pose_a.rotation = random_quat(&r), p.pose_b.rotation = random_quat(&r);
        p.pose_b.position = random_vec3(&r, 0.3 * thin);
        if (CHECK(a && b)) {
            ovoid_answer x[4] = {ovoid_collide(&p, NULL, NULL), ovoid_within(&p, 0.05, NULL, NULL),
                                 ovoid_distance(&p, NULL, NULL), ovoid_depth(&p, NULL, NULL, &cover)};
            for (int i = 0; i < 4; i++) check_answer(&p, &x[i], i == 3);
            ovoid_answer warm = ovoid_collide(&p, NULL, &x[0].proof);
            check_answer(&p, &warm, 0);
        }
        ovoid_shape_destroy(a), ovoid_shape_destroy(b);
    }
    printf("%ld common points, %ld of depths\n", seen[0], seen[1]);
    CHECK(seen[0] > 1000 && seen[1] > 50);
}

int main(void) {
    court = judge_create();
    if (!CHECK(court != NULL)) return check_end();
    test_weights();
    test_answers();
    judge_destroy(court);
    return check_end();
}
