// Judging by proven brackets. A bracket that is not proven counts as unbounded, so that it makes no answer wrong.
#include "common/judge.h"

#include <math.h>
#include <stdlib.h>

truth *truths_create(const workload *work, uint32_t *open) {
    static uint64_t memory[OVOID_COVER_SIZE / sizeof(uint64_t)];
    static ovoid_cover cover = {.memory = memory, .size = sizeof memory};
    truth *truths = malloc(sizeof *truths * work->pair_count);
    *open = 0;
    for (uint32_t i = 0; truths && i < work->pair_count; i++) {
        ovoid_pair pair = workload_get_pair(work, i);
        ovoid_answer answer = ovoid_depth(&pair, NULL, NULL, &cover);
        truths[i] = (truth){answer.lower, answer.upper};
        if (ovoid_answer_verify(&pair, &answer, &(ovoid_answer_basis){.cover = &cover}, NULL) != OVOID_OK)
            truths[i] = (truth){-INFINITY, INFINITY};
        *open += !(truths[i].upper - truths[i].lower <= 1e-7 * work->pairs[i].size);
    }
    return truths;
}

static double dot(ovoid_vec3 a, ovoid_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static ovoid_vec3 sub(ovoid_vec3 a, ovoid_vec3 b) { return (ovoid_vec3){a.x - b.x, a.y - b.y, a.z - b.z}; }

/// The distance outside the body's planes: the largest plane distance, negative inside.
static double get_outside(const ovoid_shape *shape, const ovoid_pose *pose, ovoid_vec3 point) {
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    ovoid_vec3 local = sub(ovoid_pose_compute_local_point(pose, point), p.origin);
    double most = -INFINITY;
    for (uint32_t f = 0; f < p.facet_count; f++) most = fmax(most, dot(p.planes[f].normal, local) - p.planes[f].offset);
    return most;
}

/// The largest n . x over the posed body.
static double get_support(const body *b, const ovoid_pose *pose, ovoid_vec3 n) {
    ovoid_pose turn = {{0, 0, 0}, pose->rotation};
    ovoid_vec3 local = ovoid_pose_compute_local_point(&turn, n);
    double most = -INFINITY;
    for (uint32_t i = 0; i < b->vertex_count; i++) {
        const double *v = b->vertices + (size_t)3 * i;
        most = fmax(most, local.x * v[0] + local.y * v[1] + local.z * v[2]);
    }
    return most + dot(n, pose->position);
}

static int are_points_wrong(const workload *work, const placed *p, const found *answer) {
    ovoid_vec3 between = sub(answer->point_b, answer->point_a);
    double most = 1e-4 * p->size, apart = sqrt(dot(between, between));
    // The comparisons are written so that NaN counts as wrong.
    return !(fabs(apart - answer->distance) <= most &&
             get_outside(work->bodies[p->a].shape, &p->pose_a, answer->point_a) <= most &&
             get_outside(work->bodies[p->b].shape, &p->pose_b, answer->point_b) <= most);
}

/// Peers differ in whether the normal points from A to B or back; both are accepted.
static int is_normal_wrong(const workload *work, const placed *p, const found *answer, double depth) {
    ovoid_vec3 n = answer->normal, back = {-n.x, -n.y, -n.z};
    const body *a = &work->bodies[p->a], *b = &work->bodies[p->b];
    double there = get_support(a, &p->pose_a, n) + get_support(b, &p->pose_b, back);
    double thence = get_support(a, &p->pose_a, back) + get_support(b, &p->pose_b, n);
    return !(fabs(dot(n, n) - 1) < 1e-3 && fmin(there, thence) <= depth * 1.001 + 1e-9 * p->size);
}

/// The true answer to a yes or no question; NONE if the bracket does not say.
static verdict get_truth(const truth *t, question what, double margin) {
    double limit = what == QUESTION_WITHIN ? margin : 0;
    if (t->lower > limit) return VERDICT_NO;
    return t->upper < limit ? VERDICT_YES : VERDICT_NONE;
}

static void judge_one(const workload *work, const placed *p, const truth *t, question what, const found *answer,
                      faults *sum) {
    verdict right = get_truth(t, what, p->margin);
    if (right == VERDICT_NONE) return;
    sum->asked++;
    sum->none += answer->yes == VERDICT_NONE;
    sum->sign += answer->yes != VERDICT_NONE && answer->yes != right;
    int measured =
        (what == QUESTION_DISTANCE && right == VERDICT_NO) || (what == QUESTION_DEPTH && right == VERDICT_YES);
    if (!measured || answer->yes != right || !(t->upper - t->lower <= 1e-7 * p->size)) return;
    double exact = fabs(t->upper), miss = fabs(answer->distance - exact), width = t->upper - t->lower;
    sum->off += !(miss <= (what == QUESTION_DEPTH ? 1e-3 : 1e-4) * exact + width);
    sum->off_fine += !(miss <= 1e-6 * exact + width);
    sum->points += what == QUESTION_DEPTH ? is_normal_wrong(work, p, answer, exact) : are_points_wrong(work, p, answer);
}

faults faults_count(const workload *work, const truth *truths, question what, const found *answers) {
    faults sum = {0};
    for (uint32_t i = 0; i < work->pair_count; i++)
        judge_one(work, &work->pairs[i], &truths[i], what, &answers[i], &sum);
    return sum;
}
