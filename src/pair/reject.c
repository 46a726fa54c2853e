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

ovoid_answer rejection_make_answer(const rejection *g, const pair_frame *f, const query_goal *goal) {
    vec3 a = mat3_mul_vec3(f->world, g->a ? vec3_at(shape_vertices(f->a), g->a) : f->a->first);
    vec3 b = mat3_mul_vec3(f->world_b, g->b ? vec3_at(shape_vertices(f->b), g->b) : f->b->first);
    vec3 d = vec3_add(f->offset, vec3_sub(b, a));
    double distance = vec3_norm(d);
    double upper = distance - f->upper_radii + reject_get_claim(f);
    // The radii go along the difference of the points, which is longer than both, as the lower bound is above zero.
    double share_a = f->a->radius, share_b = f->b->radius;
    if (share_a + share_b > 0) {
        share_a /= distance;
        share_b /= distance;
    }
    // No zero is negative: of two spheres its sign would depend on their rotations.
    const vec3 normal = vec3_clear_signs(g->normal);
    // One expression, which gcc 12 builds in the result's place; it would copy a variable. All members are named: else
    // it would clear the whole first.
    return (ovoid_answer){.status = OVOID_SEPARATED,
                          .stage = g->stage,
                          .limit = upper - g->lower <= goal->tolerance ? OVOID_LIMIT_NONE : goal->beyond,
                          .iterations = 0,
                          .lower = g->lower,
                          .upper = upper,
                          .point_a = vec3_clear_signs(vec3_add(f->world_origin, vec3_add_scaled(a, d, share_a))),
                          .point_b =
                              vec3_clear_signs(vec3_add(f->world_origin, vec3_add_scaled(vec3_add(a, d), d, -share_b))),
                          .normal = normal,
                          .proof = {.normal = normal,
                                    .normal_low = {0, 0, 0},
                                    .kind = OVOID_PROOF_POINTS,
                                    .count = 1,
                                    .a = {g->a, 0, 0, 0, 0, 0},
                                    .b = {g->b, 0, 0, 0, 0, 0},
                                    .weight_a = {1, 0, 0, 0, 0, 0},
                                    .weight_b = {1, 0, 0, 0, 0, 0},
                                    .inner_a = {0, 0, 0},
                                    .inner_b = {0, 0, 0}}};
}
