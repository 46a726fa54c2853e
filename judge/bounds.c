// The bounds, each by its theorem (docs/proofs.md), without their radii. Lower: a direction and the supports along it.
// Upper: points of both bodies; a closed surface of differences around the origin, small (hull) or large (cover).
#include "parts.h"
#include "shell.h"

#include <math.h>
#include <stdlib.h>

nvec proof_direction(pool *p, const ovoid_proof *proof) {
    return nvec_add(p, nvec_from(p, proof->normal), nvec_from(p, proof->normal_low));
}

// sqrt(a / b) as a double, for messages: a and b alone may exceed doubles.
static double compute_ratio(pool *p, num a, num b) {
    return num_to_double(num_root_below(p, num_quotient_below(p, a, b, 120), 60));
}

ovoid_code judge_verify_lower(const claim *c) {
    const posed *s = c->s;
    pool *p = s->p;
    if (!is_finite(c->proof->normal) || !is_finite(c->proof->normal_low))
        return judge_reject(c->error, OVOID_ERROR_NOT_FINITE, "the proof's normal is not finite");
    nvec normal = proof_direction(p, c->proof);
    if (nvec_is_zero(normal)) return judge_reject(c->error, OVOID_ERROR_PROOF, "a lower bound without a normal");

    // k gap |n|, compared with the claim: core |n| k <= n_a min_B - n_b max_A.
    num gap = num_sub(p, num_mul(p, body_support(p, &s->b, normal, -1), s->a.n),
                      num_mul(p, body_support(p, &s->a, normal, 1), s->b.n));
    num one = number_from_integer(p, 1);
    if (num_compare_roots(p, num_mul(p, c->core, s->k), nvec_norm_squared(p, normal), gap, one) > 0)
        return judge_reject(c->error, OVOID_ERROR_PROOF, "lower is above the gap along the normal, %.17g, radii aside",
                            num_sign(gap) *
                                compute_ratio(p, num_mul(p, gap, gap),
                                              num_mul(p, num_mul(p, s->k, s->k), nvec_norm_squared(p, normal))));
    return OVOID_OK;
}

weighted body_weighted_point(pool *p, const body *b, const uint32_t *v, const double *w, uint32_t count) {
    weighted sum = {nvec_zero(p), number_from_integer(p, 0)};
    for (uint32_t i = 0; i < count; i++) {
        num weight = number_from(p, w[i]);
        sum.point = nvec_add(p, sum.point, nvec_scale(p, body_vertex(p, b, v[i]), weight));
        sum.weight = num_add(p, sum.weight, weight);
    }
    return sum;
}

// |difference| / denominator <= core, in exact arithmetic.
static ovoid_code verify_distance(const claim *c, nvec difference, num denominator) {
    pool *p = c->s->p;
    num square = nvec_norm_squared(p, difference), one = number_from_integer(p, 1);
    if (num_compare_roots(p, one, square, num_mul(p, c->core, denominator), one) > 0)
        return judge_reject(c->error, OVOID_ERROR_PROOF,
                            "upper is below the distance of the two points, %.17g, radii aside",
                            compute_ratio(p, square, num_mul(p, denominator, denominator)));
    return OVOID_OK;
}

// A sum by such weights is a point of the body.
static ovoid_code verify_weights(const claim *c) {
    const ovoid_proof *proof = c->proof;
    for (uint32_t i = 0; i < proof->count; i++)
        if (!(proof->weight_a[i] >= 0 && proof->weight_b[i] >= 0 && isfinite(proof->weight_a[i]) &&
              isfinite(proof->weight_b[i])))
            return judge_reject(c->error, OVOID_ERROR_PROOF, "weight %u is not a finite number of at least zero", i);
    return OVOID_OK;
}

static ovoid_code verify_points(const claim *c) {
    const posed *s = c->s;
    const ovoid_proof *proof = c->proof;
    ovoid_code code = verify_weights(c);
    if (code != OVOID_OK) return code;
    weighted a = body_weighted_point(s->p, &s->a, proof->a, proof->weight_a, proof->count);
    weighted b = body_weighted_point(s->p, &s->b, proof->b, proof->weight_b, proof->count);
    if (num_sign(a.weight) == 0 || num_sign(b.weight) == 0)
        return judge_reject(c->error, OVOID_ERROR_PROOF, "the weights are all zero");
    // k wa wb (B - A)
    nvec difference = posed_difference(s, nvec_scale(s->p, a.point, b.weight), nvec_scale(s->p, b.point, a.weight));
    return verify_distance(c, difference, num_mul(s->p, s->k, num_mul(s->p, a.weight, b.weight)));
}

static ovoid_code verify_inner_points(const claim *c) {
    const posed *s = c->s;
    return verify_distance(c, posed_difference(s, inner_point_a(c), inner_point_b(c)), s->k);
}

// d <= |b - a| - room_a - room_b, with the rooms of round bodies. The centre in another body is a point of the proof's
// weights, without room.
static ovoid_code verify_balls(const claim *c) {
    const posed *s = c->s;
    pool *p = s->p;
    const ovoid_proof *proof = c->proof;
    const body *body_of[2] = {&s->a, &s->b};
    if (!is_finite(proof->inner_a) || !is_finite(proof->inner_b))
        return judge_reject(c->error, OVOID_ERROR_NOT_FINITE, "the centre of a ball is not finite");
    if (s->a.round == OVOID_ROUND_NONE && s->b.round == OVOID_ROUND_NONE)
        return judge_reject(c->error, OVOID_ERROR_PROOF, "balls of bodies that are not round");
    if (proof->count == 0 && (s->a.round == OVOID_ROUND_NONE || s->b.round == OVOID_ROUND_NONE))
        return judge_reject(c->error, OVOID_ERROR_PROOF, "a ball in a body that is not round");
    ovoid_code code = verify_weights(c);
    if (code != OVOID_OK) return code;
    weighted center[2] = {{inner_point_a(c), number_from_integer(p, 1)}, {inner_point_b(c), number_from_integer(p, 1)}};
    // An allowance inside is that of the polyhedron, not of the true body.
    num core = c->core;
    for (int k = 0; k < 2; k++) {
        const uint32_t *v = k ? proof->b : proof->a;
        const double *w = k ? proof->weight_b : proof->weight_a;
        if (body_of[k]->round == OVOID_ROUND_NONE) {
            center[k] = body_weighted_point(p, body_of[k], v, w, proof->count);
            if (num_sign(center[k].weight) == 0)
                return judge_reject(c->error, OVOID_ERROR_PROOF, "the weights are all zero");
            continue;
        }
        num room = num_quotient_below(p, body_find_room(p, body_of[k], center[k].point), body_of[k]->n, 240);
        core = num_add(p, num_add(p, core, room), body_of[k]->inside);
    }
    nvec difference = posed_difference(s, nvec_scale(p, center[0].point, center[1].weight),
                                       nvec_scale(p, center[1].point, center[0].weight));
    num denominator = num_mul(p, s->k, num_mul(p, center[0].weight, center[1].weight));
    num distance = num_root_above(p, nvec_norm_squared(p, difference), 240);
    num missing = num_neg(p, num_quotient_below(p, num_neg(p, distance), denominator, 240));
    missing = num_sub(p, missing, core);
    if (num_sign(missing) <= 0) return OVOID_OK;
    return judge_reject(c->error, OVOID_ERROR_PROOF, "upper is below what the balls show, by %.3g",
                        num_to_double(missing));
}

// Room for a surface of so many points, and of twice as many triangles.
static void take_room(judge *j, uint32_t points) {
    if (points <= j->point_room) return;
    judge_forget_surface(j);
    j->point_room = points < OVOID_COVER_POINTS ? OVOID_COVER_POINTS : points;
    j->points = judge_allocate(j->point_room, sizeof *j->points);
    j->triangles = judge_allocate(2 * (size_t)j->point_room, 3 * sizeof *j->triangles);
}

// The closed surface of four to six differences: a tetrahedron, or a double pyramid with tips 0 and 1.
static shell make_hull(const claim *c) {
    judge *j = c->context;
    uint32_t count = c->proof->count, triangles = 0;
    take_room(j, count);
    for (uint32_t i = 0; i < count; i++) j->points[i] = posed_vertex_difference(c->s, c->proof->a[i], c->proof->b[i]);
    static const uint32_t tetrahedron[12] = {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2};
    if (count == 4) return (shell){j->points, tetrahedron, 4, 4};
    for (uint32_t r = 2; r < count; r++) {
        uint32_t next = r + 1 < count ? r + 1 : 2, *t = j->triangles + 3 * triangles;
        t[0] = 0, t[1] = r, t[2] = next;
        t[3] = 1, t[4] = next, t[5] = r;
        triangles += 2;
    }
    return (shell){j->points, j->triangles, count, triangles};
}

// The surface of the cover, its points times k.
static ovoid_code read_cover(const claim *c, const ovoid_cover *cover, shell *out) {
    judge *j = c->context;
    const posed *s = c->s;
    if (!cover) return judge_reject(c->error, OVOID_ERROR_PROOF, "the upper bound rests on a cover, and none is given");
    if (cover->point_count > OVOID_COVER_POINTS_MAX || cover->triangle_count > 2 * OVOID_COVER_POINTS_MAX)
        return judge_reject(c->error, OVOID_ERROR_INDEX, "the cover has more points or triangles than a surface");
    uint32_t half = (cover->triangle_count + 1) / 2;
    take_room(j, cover->point_count > half ? cover->point_count : half);
    for (uint32_t i = 0; i < cover->point_count; i++) {
        if (!body_has_vertex(&s->a, cover->a[i]) || !body_has_vertex(&s->b, cover->b[i]))
            return judge_reject(c->error, OVOID_ERROR_INDEX, "point %u of the cover has no such vertex", i);
        j->points[i] = posed_vertex_difference(s, cover->a[i], cover->b[i]);
    }
    for (uint32_t t = 0; t < cover->triangle_count; t++)
        for (int e = 0; e < 3; e++) j->triangles[3 * t + (uint32_t)e] = cover->triangles[t][e];
    *out = (shell){j->points, j->triangles, cover->point_count, cover->triangle_count};
    return OVOID_OK;
}

// Checks that the surface winds around the origin, and that all of it is at least the claimed depth away from the
// origin.
static ovoid_code verify_shell(const claim *c, const shell *s) {
    pool *p = c->s->p;
    if (!shell_is_closed(s)) return judge_reject(c->error, OVOID_ERROR_PROOF, "the surface is not closed");
    if (!shell_is_winding(p, s))
        return judge_reject(c->error, OVOID_ERROR_PROOF, "the surface does not wind around the origin");
    if (num_sign(c->core) >= 0) return OVOID_OK;
    num depth = num_mul(p, c->core, c->s->k), square = num_mul(p, depth, depth);
    for (uint32_t t = 0; t < s->triangle_count; t++) {
        const uint32_t *v = s->triangles + 3 * (size_t)t;
        if (!triangle_is_farther(p, s->points[v[0]], s->points[v[1]], s->points[v[2]], square))
            return judge_reject(c->error, OVOID_ERROR_PROOF, "triangle %u of the surface is nearer than the depth", t);
    }
    return OVOID_OK;
}

static ovoid_code verify_hull(const claim *c) {
    if (c->proof->count < 4)
        return judge_reject(c->error, OVOID_ERROR_PROOF, "%u differences hold nothing", c->proof->count);
    shell s = make_hull(c);
    return verify_shell(c, &s);
}

static ovoid_code verify_cover(const claim *c, const ovoid_cover *cover) {
    shell s;
    ovoid_code code = read_cover(c, cover, &s);
    return code == OVOID_OK ? verify_shell(c, &s) : code;
}

ovoid_code judge_verify_upper(const claim *c, const ovoid_cover *cover) {
    switch (c->proof->kind) {
    case OVOID_PROOF_POINTS: return verify_points(c);
    case OVOID_PROOF_HULL: return verify_hull(c);
    case OVOID_PROOF_INNER: return judge_verify_inner(c);
    case OVOID_PROOF_INNER_POINTS: {
        ovoid_code code = judge_verify_inner(c);
        return code == OVOID_OK ? verify_inner_points(c) : code;
    }
    case OVOID_PROOF_COVER: return verify_cover(c, cover);
    case OVOID_PROOF_BALLS: return verify_balls(c);
    case OVOID_PROOF_NONE: break;
    }
    return judge_reject(c->error, OVOID_ERROR_PROOF, "an upper bound without a proof");
}
