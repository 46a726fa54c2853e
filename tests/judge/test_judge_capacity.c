// Depths that no surface of the search's memory can narrow to the tolerance: round bodies with nearly one centre, whose
// Minkowski difference is round and has its centre near the origin. The answer ends by `capacity`; its bracket is true,
// and its witness points still differ by a d of the bracket along the normal, so that they say the same as the bracket.
// Truth: the judge.
#include "check.h"
#include "linear/rotation.h"
#include "ovoid/query.h"
#include "proofs/covers.h"

#include "judge.h"

static judge *exact;
static int ended, wide;

/// A ball of points, to rounding on the sphere; none has a partner on the other side.
static ovoid_shape *make_ball(uint32_t count, double radius) {
    double *points = malloc(3 * sizeof *points * count);
    for (uint32_t i = 0; i < count; i++) {
        double z = (2 * i + 1.0) / count - 1, r = sqrt(1 - z * z), turn = 2.399963229728653 * i;
        points[3 * i] = r * cos(turn);
        points[3 * i + 1] = r * sin(turn);
        points[3 * i + 2] = z;
    }
    ovoid_shape_options options = {.radius = radius};
    ovoid_shape *shape = ovoid_shape_create_from_points(points, count, &options, NULL);
    free(points);
    return shape;
}

static ovoid_pose make_pose(uint64_t *s, double offset) {
    ovoid_pose pose = ovoid_pose_make_identity();
    pose.position = (vec3){offset * random_normal(s), offset * random_normal(s), offset * random_normal(s)};
    pose.rotation = (ovoid_quat){random_normal(s), random_normal(s), random_normal(s), random_normal(s)};
    return pose;
}

/// The judge takes the answer and its points; the difference of the points is d normal for a d of the bracket.
static void check_answer(const ovoid_pair *pair, const ovoid_answer *x, const ovoid_cover *cover) {
    ovoid_error error = {.message = ""};
    if (!CHECK(judge_verify_answer(exact, pair, x, cover, &error) == OVOID_OK) ||
        !CHECK(judge_verify_points(exact, pair, x, &error) == OVOID_OK) ||
        !CHECK(ovoid_answer_verify(pair, x, &(ovoid_answer_basis){.cover = cover}, &error) == OVOID_OK))
        printf("  %s\n", error.message);
    vec3 difference = vec3_sub(x->point_b, x->point_a);
    double d = vec3_dot(difference, x->normal), rounding = 1e-9 + 1e-13;
    CHECK_LE(x->lower - rounding, d);
    CHECK_LE(d, x->upper + rounding);
    CHECK_LE(vec3_norm(vec3_sub(difference, vec3_scale(x->normal, d))), 4e-9);
    ended += x->limit == OVOID_LIMIT_CAPACITY;
    wide += x->upper - x->lower > 1e-6;
}

static void check_pair(const ovoid_shape *a, const ovoid_shape *b, ovoid_pose pose_b) {
    STATIC_COVER(cover);
    ovoid_pair pair = {a, b, ovoid_pose_make_identity(), pose_b};
    ovoid_answer x = ovoid_depth(&pair, NULL, NULL, &cover);
    check_answer(&pair, &x, &cover);
    // The answer's proof is the start of the next query.
    x = ovoid_depth(&pair, NULL, &x.proof, &cover);
    check_answer(&pair, &x, &cover);
}

/// A surface that is full, or that rounding keeps from growing, still proves what it shows: of d, 2 less the balls'
/// sagittas, half a per cent is open, not half of it.
static void check_widths(void) {
    STATIC_COVER(cover);
    uint64_t s = 5;
    ovoid_shape *a = make_ball(512, 0);
    for (int i = 0; i < 60; i++) {
        check_seed = s;
        ovoid_pair pair = {a, a, ovoid_pose_make_identity(), make_pose(&s, 0)};
        ovoid_answer x = ovoid_depth(&pair, NULL, NULL, &cover);
        CHECK_LE(x.upper - x.lower, 0.02);
        CHECK_LE(x.upper, -1.97);
        CHECK(ovoid_answer_verify(&pair, &x, &(ovoid_answer_basis){.cover = &cover}, NULL) == OVOID_OK);
    }
    ovoid_shape_destroy(a);
}

/// With memory for more points the bracket is narrow, and the judge takes the large cover, but none with a hole.
static void check_large(void) {
    ovoid_cover cover = {.size = ovoid_cover_get_size(2000)};
    cover.memory = malloc(cover.size);
    ovoid_shape *a = make_ball(642, 0), *b = make_ball(642, 0.25);
    uint64_t s = 23;
    ovoid_pair pair = {a, b, ovoid_pose_make_identity(), make_pose(&s, 1e-6)};
    ovoid_answer x = ovoid_depth(&pair, NULL, NULL, &cover);
    CHECK(cover.point_count > OVOID_COVER_POINTS && x.limit == OVOID_LIMIT_NONE && x.upper - x.lower < 1e-8);
    check_answer(&pair, &x, &cover);
    cover.triangle_count--;
    CHECK(judge_verify_answer(exact, &pair, &x, &cover, NULL) != OVOID_OK);
    judge_forget(exact);
    ovoid_shape_destroy(a);
    ovoid_shape_destroy(b);
    free(cover.memory);
}

/// The radius of the largest sphere about the origin in a body of rank 3.
static double find_inner_radius(const ovoid_shape *shape) {
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    double least = INFINITY;
    for (uint32_t i = 0; i < p.facet_count; i++)
        least = fmin(least, p.planes[i].offset + vec3_dot(p.planes[i].normal, p.origin));
    return least;
}

/// The fewest triangles of any surface around the origin that keeps r from it, with corners no farther than R: each is
/// seen from the origin within a cap of half-angle acos(r / R), where the largest triangle is the regular one.
static double find_fewest(double r, double most) {
    double side = 2 * asin(sqrt(3) / 2 * sin(acos(r / most))), angle = acos(tan(side / 2) / tan(side));
    return 4 * 3.141592653589793 / (3 * angle - 3.141592653589793);
}

/// Of balls of 2562 points and one centre, as deep as their inner spheres at least, no cover has room: `capacity` is
/// then no fault of the search. Of those of 162 there is room.
static void check_need(void) {
    ovoid_shape *a = make_ball(2562, 0), *b = make_ball(162, 0);
    CHECK_LE(2.0 * OVOID_COVER_POINTS, find_fewest(2 * find_inner_radius(a), 2));
    CHECK_LE(find_fewest(2 * find_inner_radius(b), 2), 2.0 * OVOID_COVER_POINTS);
    ovoid_shape_destroy(a);
    ovoid_shape_destroy(b);
}

int main(void) {
    static const uint32_t counts[] = {162, 642, 2562};
    static const double offsets[] = {0, 1e-9, 1e-3, 0.1};
    exact = judge_create();
    uint64_t s = 17;
    ovoid_shape *cylinder = ovoid_shape_create_cylinder(1, 5, &(ovoid_shape_options){.tolerance = 256}, NULL);
    check_pair(cylinder, cylinder, ovoid_pose_make_identity());
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 4; k++) {
            check_seed = s;
            ovoid_shape *a = make_ball(counts[i], 0), *b = make_ball(counts[i], k % 2 ? 0.25 : 0);
            check_pair(a, b, make_pose(&s, offsets[k]));
            judge_forget(exact);
            ovoid_shape_destroy(a);
            ovoid_shape_destroy(b);
        }
    check_widths();
    check_large();
    check_need();
    // The pairs are hard enough to be worth the test.
    CHECK_LE(10, ended);
    CHECK_LE(10, wide);
    judge_forget(exact);
    ovoid_shape_destroy(cylinder);
    judge_destroy(exact);
    return check_end();
}
