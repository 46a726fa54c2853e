// From an earlier proof's differences to the bounds that they give now.
#include "exact/kept.h"

// 1 if a single difference is more than what the supports met along a normal that parted the bodies: within the margin.
static int is_near(const pair_frame *f, const query_goal *goal, const ovoid_proof *p) {
    vec3 w = kept_get_difference(f, p, 0).w;
    double reach = goal->near + f->upper_radii;
    return vec3_norm_squared(w) <= reach * reach;
}

small_gjk_kept kept_get_simplex(const pair_frame *f, const query_goal *goal, const ovoid_proof *earlier) {
    const ovoid_proof *p = earlier;
    uint32_t count = p->count, is_sound = 1;
    int is_single = count == 1 && goal->far < INFINITY;
    small_gjk_kept kept = {.count = 0};
    if (p->kind != OVOID_PROOF_POINTS || count - 1 > 2 || (is_single && !(goal->near > 0))) return kept;
    for (uint32_t i = 0; i < 4; i++) {
        uint32_t counts = -(uint32_t)(i < count);
        kept.a[i] = (p->a[i] & counts) | (p->a[0] & ~counts);
        kept.b[i] = (p->b[i] & counts) | (p->b[0] & ~counts);
        is_sound &= (kept.a[i] < f->a->vertex_count) & (kept.b[i] < f->b->vertex_count);
    }
    if (is_sound && (!is_single || is_near(f, goal, p))) kept.count = count;
    return kept;
}

// The direction to measure along: that of the point, or where a margin is asked for the proof's normal. It parted the
// bodies well, and a search that a margin ended early left no nearest point, but any that was within.
static vec3 choose_direction(const query_goal *goal, const ovoid_proof *earlier, const small_gjk_result *r) {
    if (goal->far < INFINITY && vec3_is_finite(earlier->normal)) return vec3_unit(earlier->normal);
    return vec3_unit((vec3){r->n[0], r->n[1], r->n[2]});
}

// The gap along a unit direction.
static void set_gap(const pair_frame *f, vec3 n, small_gjk_result *r) {
    vec3 in_a = mat3_mul_transposed_vec3(f->world, n), in_b = mat3_mul_transposed_vec3(f->world_b, n);
    simd_pair ends = frame_find_pair(f, in_a, vec3_neg(in_b));
    r->n[0] = n.x;
    r->n[1] = n.y;
    r->n[2] = n.z;
    r->scale = 1;
    r->gap = (vec3_dot(n, f->offset) - ends.low.value) - ends.high.value;
}

int kept_run(const placed_query *query, small_end *end) {
    const pair_frame *f = query->frame;
    const query_goal *goal = query->goal;
    const ovoid_proof *earlier = query->earlier;
    small_gjk_kept kept = kept_get_simplex(f, goal, earlier);
    if (!kept.count) return 0;
    small_gjk_query q = small_make_query(f, goal);
    small_gjk_result r;
    simd_find_kept(&q, &kept, &r);
    if (r.end != SMALL_GJK_KEPT) return 0;
    vec3 n = choose_direction(goal, earlier, &r);
    set_gap(f, n, &r);
    if (!(vec3_norm_squared(n) > 0.5) || !small_finish(f, goal, &r, end)) return 0;
    end->stage = OVOID_STAGE_PROOF;
    return 1;
}
