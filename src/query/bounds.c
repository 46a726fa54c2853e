// The bracket from the ellipsoids alone: the gap of the outer ones from below, the nearest points of the inner ones
// from above. Smooth in the poses wherever the nearest points are unique; O(1), whatever the number of vertices.
#include "base/environment.h"
#include "pair/inner.h"
#include "pair/stages.h"
#include "query/answer.h"

// The gap of the outer ellipsoids along the direction that separates them best.
static void take_outer(search *s) {
    const pair_frame *f = s->frame;
    const ovoid_ellipsoid *a = &f->a->outer;
    ovoid_ellipsoid b = {frame_b(f, f->b->outer.center), sym3_rotate(f->b->outer.q, f->rotation)};
    vec3 n = ovoid_ellipsoid_compute_nearest(a, &b).normal;
    if (!(vec3_norm_squared(n) > 0)) n = (vec3){1, 0, 0};
    double sa = sqrt(ellipsoid_compute_spread(a->q, n)), sb = sqrt(ellipsoid_compute_spread(b.q, n));
    s->lower = vec3_dot(n, vec3_sub(b.center, a->center)) - sa - sb - f->lower_radii - f->claim;
    s->normal = n;
    s->stage = OVOID_STAGE_OUTER;
}

// The inner ellipsoids' nearest points, or a common one. Rounded points lie on the boundary only to rounding, so they
// are drawn toward the centres until they are proven inside.
static void take_inner(search *s) {
    const pair_frame *f = s->frame;
    const ovoid_ellipsoid *a = &f->a->inner, *b_body = &f->b->inner;
    if (f->a->rank < 3 || f->b->rank < 3) return;
    ovoid_ellipsoid b = {frame_b(f, b_body->center), sym3_rotate(b_body->q, f->rotation)};
    ovoid_nearest found = ovoid_ellipsoid_compute_nearest(a, &b);
    double upper = found.overlap ? inner_compute_upper(f, found.point_a) : 0;
    if (upper < 0) {
        s->inner_a = found.point_a;
        s->upper = upper;
        s->kind = OVOID_PROOF_INNER;
        return;
    }
    vec3 in_b = mat3_mul_transposed_vec3(f->rotation, vec3_sub(found.point_b, f->translation));
    for (double shrink = 2e-6; shrink < 1; shrink *= 8) {
        s->inner_a = vec3_add_scaled(found.point_a, vec3_sub(a->center, found.point_a), shrink);
        s->inner_b = vec3_add_scaled(in_b, vec3_sub(b_body->center, in_b), shrink);
        s->upper = inner_points_compute_upper(f, s->inner_a, s->inner_b, f->claim);
        if (s->upper < INFINITY) break;
    }
    if (s->upper < INFINITY) s->kind = OVOID_PROOF_INNER_POINTS;
}

static ovoid_answer find_bounds(const ovoid_pair *pair) {
    pair_frame frame;
    ovoid_limit refused = frame_make(pair, &frame);
    if (refused != OVOID_LIMIT_NONE) return answer_make_refused(refused);
    query_goal goal = {.allowance = frame_get_allowance(&frame)};
    goal.tolerance = 1e-9 * frame.size + goal.allowance;
    search s;
    search_make(&s, &frame, &goal);
    take_outer(&s);
    take_inner(&s);
    s.limit = OVOID_LIMIT_ANSWERED;
    ovoid_answer out;
    answer_write(&s, &out);
    return out;
}

ovoid_answer ovoid_pair_compute_bounds(const ovoid_pair *pair) {
    ENVIRONMENT_RETURN(ovoid_answer, pair, find_bounds(pair));
}
