// The rejection by the normal of an earlier proof.
#include "pair/reject.h"

int reject_by_normal(const pair_frame *f, double far, const ovoid_proof *earlier, rejection *found) {
    found->a = found->b = 0;
    if (!vec3_is_finite(earlier->normal)) return 0;
    vec3 n = vec3_unit(earlier->normal);
    vec3 in_a = mat3_mul_transposed_vec3(f->world, n), in_b = vec3_neg(mat3_mul_transposed_vec3(f->world_b, n));
    simd_pair ends = frame_find_pair(f, in_a, in_b);
    double gap = (vec3_dot(n, f->offset) - ends.low.value) - ends.high.value,
           lower = gap - f->lower_radii - reject_get_claim(f);
    if (frame_has_axis(f)) lower = frame_take_gain(lower, frame_compute_gain(f, in_a, in_b, AXIS_CLAIM));
    found->a = ends.high.index;
    found->b = ends.low.index;
    // A direction that underflowed to zero proves nothing.
    if (!(lower > far) || !(vec3_norm_squared(n) > 0.5)) return 0;
    *found = (rejection){lower, n, ends.high.index, ends.low.index, OVOID_STAGE_PROOF};
    return 1;
}

// The vertex of A behind the upper bound, from A's body frame in the world's axes; from it to that of B; how far.
typedef struct rejection_ends {
    vec3 a, d;
    double distance, upper;
} rejection_ends;

static inline rejection_ends find_ends(const rejection *g, const pair_frame *f) {
    vec3 a = mat3_mul_vec3(f->world, g->a ? vec3_at(shape_vertices(f->a), g->a) : f->a->first);
    vec3 b = mat3_mul_vec3(f->world_b, g->b ? vec3_at(shape_vertices(f->b), g->b) : f->b->first);
    vec3 d = vec3_add(f->offset, vec3_sub(b, a));
    double distance = vec3_norm(d);
    return (rejection_ends){a, d, distance, distance - f->upper_radii + reject_get_claim(f)};
}

static inline ovoid_limit find_limit(const rejection *g, double upper, const query_goal *goal) {
    return upper - g->lower <= goal->tolerance ? OVOID_LIMIT_NONE : goal->beyond;
}

// The initialiser of the proof, in which all members are named (query/answer.h has the reason).
#define REJECTION_PROOF(g, direction)                                                                                  \
    {                                                                                                                  \
        .normal = (direction), .normal_low = {0, 0, 0}, .kind = OVOID_PROOF_POINTS, .count = 1,                        \
        .a = {(g)->a, 0, 0, 0, 0, 0}, .b = {(g)->b, 0, 0, 0, 0, 0}, .weight_a = {1, 0, 0, 0, 0, 0},                    \
        .weight_b = {1, 0, 0, 0, 0, 0}, .inner_a = {0, 0, 0}, .inner_b = {0, 0, 0},                                    \
    }

ovoid_verdict rejection_write_proof(const rejection *g, const pair_frame *f, const query_goal *goal, ovoid_proof *to) {
    double upper = find_ends(g, f).upper;
    const vec3 normal = vec3_clear_signs(g->normal);
    *to = (ovoid_proof)REJECTION_PROOF(g, normal);
    return (ovoid_verdict){OVOID_SEPARATED, g->stage, find_limit(g, upper, goal), 0, g->lower, upper};
}

ovoid_answer rejection_make_answer(const rejection *g, const pair_frame *f, const query_goal *goal) {
    const rejection_ends e = find_ends(g, f);
    // The radii go along the difference of the points, which is longer than both, as the lower bound is above zero.
    double share_a = f->a->radius, share_b = f->b->radius;
    if (share_a + share_b > 0) {
        share_a /= e.distance;
        share_b /= e.distance;
    }
    // No zero is negative: of two spheres its sign would depend on their rotations.
    const vec3 normal = vec3_clear_signs(g->normal);
    // One expression, which gcc 12 builds in the result's place; it would copy a variable. All members are named: else
    // it would clear the whole first.
    return (ovoid_answer){
        .status = OVOID_SEPARATED,
        .stage = g->stage,
        .limit = find_limit(g, e.upper, goal),
        .iterations = 0,
        .lower = g->lower,
        .upper = e.upper,
        .point_a = vec3_clear_signs(vec3_add(f->world_origin, vec3_add_scaled(e.a, e.d, share_a))),
        .point_b = vec3_clear_signs(vec3_add(f->world_origin, vec3_add_scaled(vec3_add(e.a, e.d), e.d, -share_b))),
        .normal = normal,
        .proof = REJECTION_PROOF(g, normal)};
}
