// From the state of a search to the answer, and the pipeline that all queries share.
#ifndef OVOID_QUERY_ANSWER_H
#define OVOID_QUERY_ANSWER_H

#include "base/compiler.h"
#include "exact/small.h"
#include "linear/nearest.h"
#include "query/goal.h"

/// Writes the answer of a search that has ended.
void answer_write(search *s, ovoid_answer *out);
/// The answer of a search that has ended, without points and proof.
ovoid_verdict answer_make_verdict(search *s);

/// The witness points of a pair of small bodies, world.
typedef struct small_points {
    vec3 a, b;
} small_points;

/// Moves the points of the cores to the rounded bodies, as in witness_compute_points.
static inline void small_points_add_radii(small_points *p, const pair_frame *f, vec3 normal) {
    double radii = f->a->radius + f->b->radius;
    if (!(radii > 0)) return;
    vec3 d = vec3_sub(p->b, p->a), n = nearest_takes_difference(vec3_norm(d), radii) ? vec3_unit(d) : normal;
    p->a = vec3_add_scaled(p->a, n, f->a->radius);
    p->b = vec3_add_scaled(p->b, n, -f->b->radius);
}

/// The initialisers of a proof and of an answer. Within one expression gcc 12 builds it in the place of what it is for;
/// it would copy a variable, or what a function returns. All members are named: else it would clear the whole first.
#define SMALL_PROOF(x)                                                                                                 \
    {                                                                                                                  \
        .normal = (x)->normal, .normal_low = {0, 0, 0}, .kind = (x)->kind, .count = (uint32_t)(x)->points.count,       \
        .a = {(x)->points.p[0].a, (x)->points.p[1].a, (x)->points.p[2].a, (x)->points.p[3].a, 0, 0},                   \
        .b = {(x)->points.p[0].b, (x)->points.p[1].b, (x)->points.p[2].b, (x)->points.p[3].b, 0, 0},                   \
        .weight_a =                                                                                                    \
            {(x)->points.weight[0], (x)->points.weight[1], (x)->points.weight[2], (x)->points.weight[3], 0, 0},        \
        .weight_b =                                                                                                    \
            {(x)->points.weight[0], (x)->points.weight[1], (x)->points.weight[2], (x)->points.weight[3], 0, 0},        \
        .inner_a = (x)->inner, .inner_b = {0, 0, 0},                                                                   \
    }

#define SMALL_ANSWER(x, verdict, points)                                                                               \
    {                                                                                                                  \
        .status = (verdict).status, .stage = (verdict).stage, .limit = (verdict).limit,                                \
        .iterations = (verdict).iterations, .lower = (verdict).lower, .upper = (verdict).upper, .point_a = (points).a, \
        .point_b = (points).b, .normal = (x)->normal, .proof = SMALL_PROOF(x),                                         \
    }

/// The answer of a search of small bodies, with points and proof or without. Its frame needs only frame_place.
ovoid_answer answer_make_small(const small_end *end, const pair_frame *frame, const query_goal *goal);
void answer_write_small_witness(const small_end *end, const pair_frame *frame, ovoid_witness *to);
void answer_write_small_proof(const small_end *end, ovoid_proof *to);
static inline ovoid_verdict answer_make_small_verdict(const small_end *end, const query_goal *goal) {
    ovoid_status status = bracket_find_status(end->lower, end->upper, goal->tolerance - goal->allowance);
    final_bracket b = {end->lower, end->upper, goal->tolerance, 0, status, end->kind};
    ovoid_limit limit = bracket_is_narrow(&b, goal) ? OVOID_LIMIT_NONE : bracket_find_limit(&b, goal, OVOID_LIMIT_NONE);
    return (ovoid_verdict){status, end->stage, limit, end->iterations, end->lower, end->upper};
}

/// The exact methods, from the bounds and the simplex that the stages before them left, until the query is answered or
/// no method makes progress.
void answer_search(search *s, const ovoid_pair *pair, simplex *start);

/// The beginning of an answer.
static inline ovoid_verdict answer_get_verdict(const ovoid_answer *answer) {
    return (ovoid_verdict){answer->status,     answer->stage, answer->limit,
                           answer->iterations, answer->lower, answer->upper};
}

/// The answer of a query that was refused: no bracket.
ovoid_answer answer_make_refused(ovoid_limit limit);

/// What is asked of a pair.
typedef struct query_request {
    const ovoid_options *options; ///< as the caller gave them; NULL: the default
    const query_goal *goal;
    const ovoid_proof *earlier; ///< of an earlier call, or NULL
    ovoid_cover *cover;         ///< room for a cover, or NULL
    const ovoid_cover *kept;    ///< of a depth's earlier call, of any content, or NULL
} query_request;

/// The whole pipeline for one query.
ovoid_answer answer_find(const ovoid_pair *pair, const query_request *request);

/// answer_find for callers that have set the default floating-point environment. Not inlined, so that the answer is
/// made in the caller's place.
COMPILER_NOINLINE ovoid_answer answer_find_by_value(const ovoid_pair *pair, const query_request *request);

/// placed.is_bare of a query whose answer is not wanted beyond the verdict, the normal, the proof's kind, and as the
/// proof's first vertices a pair of the last simplex, UINT32_MAX where there is none. A search sets no more than these.
enum { BARE_ANSWER = 2 };

/// A query that its beginning left to the search.
typedef struct open_query {
    const ovoid_pair *pair;
    placed_query placed;
    ovoid_cover *cover;      ///< room for a cover, or NULL
    const ovoid_cover *kept; ///< of a depth's earlier call, or NULL
} open_query;

/// The rest of the pipeline. The frame is related (frame_relate).
void answer_run_search(const open_query *query, ovoid_answer *out);

/// answer_find for callers inside a public function, which has set the default floating-point environment already.
void answer_find_internal(const ovoid_pair *pair, const query_request *request, ovoid_answer *out);

/// ovoid_answer_verify for callers inside a public function.
ovoid_code answer_verify_internal(const ovoid_pair *pair, const ovoid_answer *answer, const ovoid_answer_basis *basis,
                                  ovoid_error *error);

/// What an answer was asked by: the tolerance, to which allowances add nothing; the width that these make; the cap, or
/// 0.
typedef struct answer_terms {
    double tolerance, allowance, cap;
} answer_terms;

/// OVOID_OK if the answer's status and limit follow from its bracket.
ovoid_code terms_verify_internal(const ovoid_answer *answer, const answer_terms *terms, ovoid_error *error);

/// What is claimed of a pair. slack: by how much the witness points may be off beside the pair's own rounding.
typedef struct answer_claims {
    const ovoid_pair *pair;
    const ovoid_answer *answer;
    const ovoid_cover *cover; ///< or NULL
    double slack;
} answer_claims;

/// OVOID_OK if the answer's bracket and points follow from its proof; status and limit are not looked at.
ovoid_code bounds_verify_internal(const answer_claims *claims, ovoid_error *error);

/// OVOID_OK if an answer's status follows from its bracket, or PROOF with a sentence; its other members are not looked
/// at. tolerance: as in bracket_find_status. "undecided" claims nothing but that the bracket leaves the sign open.
ovoid_code status_verify_internal(ovoid_verdict answer, double tolerance, ovoid_error *error);

/// OVOID_OK if an answer is the refusal for that reason, and claims nothing.
ovoid_code refusal_verify_internal(ovoid_verdict answer, ovoid_limit refused, ovoid_error *error);

/// The upper bound of the signed distance that a cover shows of a pair; infinity where it shows none, or is NULL.
double cover_measure_upper(const pair_frame *frame, const ovoid_cover *cover);

/// Checks the lower bound alone: that the proof's normal shows it.
ovoid_code lower_verify_internal(const ovoid_pair *pair, double lower, const ovoid_proof *proof, ovoid_error *error);

/// 1 if a query starts from the line of centres instead of the outer ellipsoids' direction. For bodies far apart it is
/// as good a direction. With few vertices a support costs less than the ellipsoids: these are worth it only where the
/// goal is the sign and the spheres overlap so far that the line may fail and another direction may separate the
/// bodies. sphere_gap: the lower bound by the enclosing spheres (reject.h).
enum { LINE_VERTICES = 40 }; // of both together
static inline int query_goal_takes_line(const query_goal *goal, const ovoid_shape *a, const ovoid_shape *b,
                                        double sphere_gap) {
    double reach = a->reach + b->reach;
    if (a->vertex_count + b->vertex_count > LINE_VERTICES) return goal->far == INFINITY && sphere_gap > reach;
    return goal->far == INFINITY || sphere_gap > -0.3 * reach || sphere_gap < -0.6 * reach;
}

#endif
