// The stages before the exact search.
#include "pair/stages.h"

#include "pair/inner.h"
#include "pair/proof.h"

// Adds a difference that is new, while there is room.
static void take_start(simplex *start, difference d) {
    for (int k = 0; k < start->count; k++)
        if (start->p[k].a == d.a && start->p[k].b == d.b) return;
    if (start->count < 4) start->p[start->count++] = d;
}

// A point that seems common to the inner ellipsoids, in A's body frame: 1 if it proves an overlap.
static int take_common(search *s, vec3 x) {
    double upper = inner_compute_upper(s->frame, x);
    if (!(upper < 0)) return 0;
    s->upper = upper;
    s->kind = OVOID_PROOF_INNER;
    s->inner_a = x;
    return 1;
}

// The common point or the hull around the origin of an earlier proof of an overlap.
static void take_overlap(search *s, const ovoid_proof *earlier) {
    const pair_frame *f = s->frame;
    if (earlier->kind == OVOID_PROOF_INNER && !s->goal.wants_depth) {
        (void)take_common(s, earlier->inner_a);
    } else if (earlier->kind == OVOID_PROOF_HULL) {
        evidence known = {.count = (int)earlier->count};
        for (uint32_t i = 0; i < earlier->count; i++) known.p[i] = proof_difference(f, earlier, i);
        (void)search_take_hull(s, &known);
    }
}

void stage_proof(search *s, const ovoid_proof *earlier, simplex *start) {
    const pair_frame *f = s->frame;
    start->count = 0;
    if (!earlier || !proof_is_sound(f, earlier)) return;
    take_overlap(s, earlier);
    // The proof's direction: for a depth, and for a proof without differences, the first rejections have not measured
    // it. In other cases the direction of the differences is newer.
    vec3 n = vec3_unit(frame_direction_from_world(f, earlier->normal));
    int has_differences = earlier->count > 0 && earlier->kind != OVOID_PROOF_BALLS;
    if ((s->goal.wants_depth || !has_differences) && !search_is_done(s) && vec3_norm_squared(n) > 0)
        (void)search_probe(s, n);
    if (s->lower > -INFINITY || s->upper < INFINITY) s->stage = OVOID_STAGE_PROOF;
    if (search_is_done(s) || !has_differences) return;
    for (uint32_t i = 0; i < earlier->count; i++) take_start(start, proof_difference(f, earlier, i));
}

double ellipsoid_compute_spread(sym3 q, vec3 n) {
    return max2(sym3_quadratic(q, n), 0) + 256 * 0x1p-53 * sym3_trace(q);
}

// Lengths whose 14th power neither over- nor underflows.
static int is_moderate(double trace_a, double trace_b, double square) {
    double most = max2(max2(trace_a, trace_b), square);
    return most > 1e-30 && most < 1e30;
}

// The matrix is scaled by sA sB, and its adjugate replaces its inverse: neither changes the direction, and no division
// is needed. If one body has no extent (s = 0), the other decides the direction.
static vec3 find_direction(sym3 qa, sym3 qb, vec3 d, double *gap) {
    vec3 n = vec3_unit(d);
    for (int round = 0;; round++) {
        double sa = sqrt(ellipsoid_compute_spread(qa, n)), sb = sqrt(ellipsoid_compute_spread(qb, n));
        double apart = vec3_dot(n, d) - sa - sb;
        *gap = apart;
        if (round == 2 || !(sa + sb > 0)) return n;
        double ta = sa > 0 ? sa : sb, tb = sb > 0 ? sb : sa;
        sym3 m = sym3_add(sym3_scale(qa, tb), sym3_scale(qb, ta));
        // The nearest points' distance is on the diagonal: x_b - x_a = d - m n = distance n. Flat bodies of one plane:
        // a little thickness keeps the matrix regular, the direction is only a proposal.
        double thickness = max2(apart * (ta * tb), 1e-9 * sym3_trace(m));
        m.xx += thickness;
        m.yy += thickness;
        m.zz += thickness;
        vec3 next = vec3_unit(sym3_mul_vec3(sym3_adjugate(m), d));
        // Rounding may have spoiled a thin matrix, so that its inverse no longer leads from A to B.
        if (!(vec3_dot(next, d) > 0)) return n;
        n = next;
    }
}

vec3 ellipsoids_find_direction(sym3 qa, sym3 qb, vec3 d, double *gap) {
    double square = vec3_norm_squared(d);
    // Concentric ellipsoids: nothing separates them, so any direction is as good.
    if (!(square > 0)) {
        *gap = -INFINITY;
        return (vec3){1, 0, 0};
    }
    if (is_moderate(sym3_trace(qa), sym3_trace(qb), square)) return find_direction(qa, qb, d, gap);
    // In units of a power of two near the pair's size, which changes no digit.
    int e = find_unit_exponent(sqrt(max2(max2(sym3_trace(qa), sym3_trace(qb)), square)));
    double down = ldexp(1, -e);
    vec3 n = find_direction(sym3_scale(sym3_scale(qa, down), down), sym3_scale(sym3_scale(qb, down), down),
                            vec3_scale(d, down), gap);
    *gap = *gap * ldexp(1, e);
    return n;
}

void stage_outer(search *s, vec3 *n) {
    const pair_frame *f = s->frame;
    const ovoid_ellipsoid *a = &f->a->outer, *b = &f->b->outer;
    vec3 d = vec3_sub(frame_b(f, b->center), a->center);
    double gap;
    *n = ellipsoids_find_direction(a->q, sym3_rotate(b->q, f->rotation), d, &gap);
    double lower = gap - (f->lower_radii + f->beyond) - f->claim;
    if (!(lower > s->goal.far)) return;
    s->lower = lower;
    s->normal = *n;
    s->stage = OVOID_STAGE_OUTER;
}

void stage_support(search *s, vec3 n, simplex *start) {
    frame_support p = search_probe(s, n);
    start->p[0] = (difference){p.w, p.a, p.b};
    start->weight[0] = 1;
    start->count = 1;
    search_take_points(s, start);
    s->stage = OVOID_STAGE_SUPPORT;
    if (!(s->frame->lower_radii > 0) || !s->goal.wants_bracket || !search_is_done(s)) return;
    // Where radii overlap the points are on the bodies along the normal: the bracket is taken along the difference's
    // own direction, as gjk.c does, so that points, normal and depth agree.
    s->lower = -INFINITY;
    (void)search_probe(s, vec3_unit(p.w));
}

void stage_inner(search *s) {
    vec3 x;
    if (inner_find_common(s->frame, &x) && take_common(s, x)) s->stage = OVOID_STAGE_INNER;
}
