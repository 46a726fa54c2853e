// Whether the witness points lie on their bodies, to rounding. A body here is its hull in its pose, enlarged by its
// radius. A witness is first compared with the point that the proof names, which is in the hull by construction.
// Otherwise it is compared with every triangle: it must be near one, or the surface must wind around it. (For a flat
// body, a segment or a point it must be near.)
#include "parts.h"
#include "shell.h"

#include <math.h>
#include <stdlib.h>

// Rounding of a witness point: 256 half ulps of all lengths that enter its computation, coordinates, positions and
// radii of both bodies, since points of B may have been computed in A's frame.
#define WITNESS_ROUNDING (256 * 0x1p-53)

static double compute_tolerance(const posed *s) {
    return WITNESS_ROUNDING * (s->a.reach + s->b.reach + num_to_double(s->radii)) + OVOID_LENGTH_MIN;
}

// A point that carries a factor: the point is point / factor. is_known is 0 if the proof names none.
typedef struct named {
    nvec point;
    num factor;
    int is_known;
} named;

// 1 if the point x is no farther than `reach` from the named one.
static int is_near(pool *p, nvec x, const named *n, num reach) {
    nvec d = nvec_sub(p, nvec_scale(p, x, n->factor), n->point);
    num limit = num_mul(p, reach, n->factor);
    return num_compare(p, nvec_norm_squared(p, d), num_mul(p, limit, limit)) <= 0;
}

// --- a point against every triangle of a body

// Near a triangle, an edge or a vertex of the polytope, seen from the point: corners carry the factor n.
static int is_near_boundary(pool *p, const ovoid_polytope *polytope, const nvec *corners, num square) {
    // A point at exactly the tolerance counts as farther, which does not matter.
    for (uint32_t t = 0; t < polytope->triangle_count; t++) {
        const uint32_t *v = polytope->triangles + 3 * (size_t)t;
        if (!triangle_is_farther(p, corners[v[0]], corners[v[1]], corners[v[2]], square)) return 1;
    }
    if (polytope->triangle_count) return 0;
    // No triangles: every segment between vertices, or the one point.
    for (uint32_t i = 0; i < polytope->vertex_count; i++)
        for (uint32_t k = i; k < polytope->vertex_count; k++)
            if (!segment_is_farther(p, corners[i], corners[k], square)) return 1;
    return 0;
}

int body_holds(pool *p, const body *b, nvec point, num reach) {
    const ovoid_polytope *polytope = &b->polytope;
    nvec *corners = judge_allocate(polytope->vertex_count, sizeof *corners), at = nvec_scale(p, point, b->n);
    for (uint32_t i = 0; i < polytope->vertex_count; i++) {
        nvec_slot kept = nvec_slot_make(p);
        size_t mark = pool_get_mark(p);
        corners[i] = nvec_slot_set(kept, nvec_sub(p, body_vertex(p, b, i), at));
        pool_release(p, mark);
    }
    num limit = num_mul(p, reach, b->n);
    shell s = {corners, polytope->triangles, polytope->vertex_count, polytope->triangle_count};
    int inside = is_near_boundary(p, polytope, corners, num_mul(p, limit, limit)) ||
                 (polytope->rank == 3 && shell_is_closed(&s) && shell_is_winding(p, &s));
    free(corners);
    return inside;
}

// --- the points that a proof names

static int are_weights(const double *w, uint32_t count) {
    double sum = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (!(w[i] >= 0 && isfinite(w[i]))) return 0;
        sum = fmax(sum, w[i]);
    }
    return sum > 0;
}

static named find_named(const claim *c, int of_b) {
    const posed *s = c->s;
    const body *b = of_b ? &s->b : &s->a;
    const ovoid_proof *proof = c->proof;
    if (proof->kind == OVOID_PROOF_INNER) return (named){inner_point_a(c), s->a.n, 1};
    if (proof->kind == OVOID_PROOF_INNER_POINTS) return (named){of_b ? inner_point_b(c) : inner_point_a(c), b->n, 1};
    if (proof->kind == OVOID_PROOF_BALLS && b->round != OVOID_ROUND_NONE)
        return (named){of_b ? inner_point_b(c) : inner_point_a(c), b->n, 1};
    const double *weights = of_b ? proof->weight_b : proof->weight_a;
    if (!are_weights(weights, proof->count)) return (named){nvec_zero(s->p), b->n, 0};
    weighted w = body_weighted_point(s->p, b, of_b ? proof->b : proof->a, weights, proof->count);
    return (named){w.point, num_mul(s->p, w.weight, b->n), 1};
}

static int is_witness(const claim *c, int of_b, nvec point, double tolerance) {
    const posed *s = c->s;
    const body *b = of_b ? &s->b : &s->a;
    num reach = num_add(s->p, b->radius, number_from(s->p, tolerance));
    named n = find_named(c, of_b);
    // A proof's ball is in its body.
    if (c->proof->kind == OVOID_PROOF_BALLS && b->round != OVOID_ROUND_NONE) {
        num room = num_quotient_below(s->p, body_find_room(s->p, b, n.point), b->n, 240);
        num far = num_add(s->p, reach, room);
        if (num_sign(far) >= 0 && is_near(s->p, point, &n, far)) return 1;
    }
    if (n.is_known && is_near(s->p, point, &n, reach)) return 1;
    if (b->round != OVOID_ROUND_NONE) {
        num room = body_find_room(s->p, b, nvec_scale(s->p, point, b->n));
        if (num_sign(num_add(s->p, room, num_mul(s->p, reach, b->n))) >= 0) return 1;
    }
    return body_holds(s->p, b, point, reach);
}

// The points of an overlap that a common point or a hull around the origin shows are one point.
static ovoid_code verify_common(const claim *c, const ovoid_answer *answer, double tolerance) {
    pool *p = c->s->p;
    if (c->proof->kind != OVOID_PROOF_HULL && c->proof->kind != OVOID_PROOF_INNER) return OVOID_OK;
    nvec apart = nvec_sub(p, nvec_from(p, answer->point_b), nvec_from(p, answer->point_a));
    double found = sqrt(num_to_double(nvec_norm_squared(p, apart)));
    if (found <= tolerance) return OVOID_OK;
    return judge_reject(c->error, OVOID_ERROR_PROOF, "point_a and point_b are %.3g apart, no common point", found);
}

ovoid_code judge_verify_witness(const claim *c, const ovoid_answer *answer) {
    double tolerance = compute_tolerance(c->s);
    if (!is_witness(c, 0, nvec_from(c->s->p, answer->point_a), tolerance))
        return judge_reject(c->error, OVOID_ERROR_PROOF, "point_a is not on A, rounding (%.3g) included", tolerance);
    if (!is_witness(c, 1, nvec_from(c->s->p, answer->point_b), tolerance))
        return judge_reject(c->error, OVOID_ERROR_PROOF, "point_b is not on B, rounding (%.3g) included", tolerance);
    return verify_common(c, answer, 4 * tolerance);
}

// The default tolerance of the queries, in parts of the pair's size.
#define QUERY_TOLERANCE 1e-9

// Bounds |point_b - point_a - d n| for d in the bracket of the two hulls, which is the answer's bracket without the
// widening by allowances. If the bracket has width w, the points may differ from the nearest ones by sqrt(w (w + 2
// |d|)) across and w along the normal, and by the query's tolerance.
ovoid_code judge_verify_points_posed(const posed *s, const ovoid_answer *answer, ovoid_error *error) {
    if (!(isfinite(answer->lower) && isfinite(answer->upper)))
        return judge_reject(error, OVOID_ERROR_PROOF, "the bracket is not finite");
    if (!is_finite(answer->point_a) || !is_finite(answer->point_b) || !is_finite(answer->normal))
        return judge_reject(error, OVOID_ERROR_NOT_FINITE, "a witness point or the normal is not finite");
    pool *p = s->p;
    size_t mark = pool_get_mark(p);
    nvec normal = nvec_from(p, answer->normal);
    num lower = num_add(p, number_from(p, answer->lower), s->outside),
        upper = num_sub(p, number_from(p, answer->upper), s->inside);
    // The normal has length 1 to rounding, and each find_across carries its body's n.
    num across = num_add(p, num_mul(p, body_find_across(p, &s->a, normal), s->b.n),
                         num_mul(p, body_find_across(p, &s->b, normal), s->a.n));
    if (num_sign(across) > 0) lower = num_add(p, lower, num_quotient_below(p, across, s->k, 120));
    double width = fmax(0, num_to_double(num_sub(p, upper, lower)));
    double size = fmax(fabs(num_to_double(lower)), fabs(num_to_double(upper)));
    double slack = width + sqrt(width * (width + 2 * size)) + QUERY_TOLERANCE * s->size + 2 * compute_tolerance(s);
    nvec along = nvec_scale(p, normal, num_scaled(p, num_add(p, lower, upper), -1));
    nvec off = nvec_sub(p, nvec_sub(p, nvec_from(p, answer->point_b), nvec_from(p, answer->point_a)), along);
    double found = sqrt(num_to_double(nvec_norm_squared(p, off)));
    pool_release(p, mark);
    if (found <= slack) return OVOID_OK;
    return judge_reject(error, OVOID_ERROR_PROOF, "point_b - point_a is off d normal by %.3g, more than %.3g", found,
                        slack);
}

ovoid_code judge_verify_points(judge *context, const ovoid_pair *pair, const ovoid_answer *answer, ovoid_error *error) {
    size_t mark = pool_get_mark(context->p);
    posed s = posed_make(context->p, pair);
    ovoid_code code = judge_verify_points_posed(&s, answer, error);
    pool_release(context->p, mark);
    return code;
}
