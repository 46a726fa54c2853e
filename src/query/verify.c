// Checking an answer without a search: each bound is measured again from the proof, and must hold with room for the
// rounding of this measurement, in doubles or, where these do not confirm it, in pairs of them. What passes here holds
// in exact arithmetic.
#include "base/environment.h"
#include "base/error.h"
#include "pair/balls.h"
#include "pair/cover.h"
#include "pair/fine.h"
#include "pair/hull.h"
#include "pair/inner.h"
#include "pair/proof.h"
#include "pair/reject.h"
#include "pair/round.h"
#include "query/answer.h"

// The pair in doubles, and in pairs of doubles once these are needed.
typedef struct measure {
    const ovoid_pair *pair;
    const pair_frame *frame;
    int has_fine; ///< 0: not made yet, -1: it cannot be made
    fine_frame fine;
} measure;

static int make_fine(measure *m) {
    if (!m->has_fine) m->has_fine = fine_make(m->pair, &m->fine) ? 1 : -1;
    return m->has_fine > 0;
}

static ovoid_code refuse(ovoid_error *error, const char *what, double claimed, double found) {
    return error_set(error, OVOID_ERROR_PROOF, -1, "%s: claimed %.17g, the proof shows %.17g", what, claimed, found);
}

// A bound that doubles do not confirm is measured again in pairs of doubles.
static double measure_lower_again(const measure *m, const ovoid_proof *p) {
    dd3 n = dd3_make(p->normal, p->normal_low);
    if (!(fabs(vec3_norm(dd3_high(n)) - 1) <= 1e-6)) return -INFINITY;
    return fine_compute_lower(&m->fine, fine_find_support(&m->fine, n).gap, m->fine.check);
}

// The lower bound by the supports of true bodies.
static double measure_round(const pair_frame *f, vec3 n) {
    double radii = round_compute_radii(f, n, AXIS_CHECK) + f->check + ROUND_CHECK * f->size;
    return round_measure_gap(f, n) - radii;
}

static ovoid_code verify_lower(measure *m, double lower, const ovoid_proof *p, ovoid_error *error) {
    const pair_frame *f = m->frame;
    if (lower == -INFINITY) return OVOID_OK;
    vec3 n = vec3_unit(frame_direction_from_world(f, vec3_add(p->normal, p->normal_low)));
    if (!(vec3_norm_squared(n) > 0)) return refuse(error, "lower bound without a normal", lower, 0);
    double gain = frame_compute_gain(f, n, mat3_mul_transposed_vec3(f->rotation, n), AXIS_CHECK);
    double found = frame_take_gain(frame_measure_gap(f, n) - f->lower_radii - f->check, gain);
    if (frame_has_round(f)) found = max2(found, measure_round(f, n));
    if (found < lower && make_fine(m)) found = frame_take_gain(measure_lower_again(m, p), gain);
    return found >= lower ? OVOID_OK : refuse(error, "lower bound", lower, found);
}

ovoid_code lower_verify_internal(const ovoid_pair *pair, double lower, const ovoid_proof *p, ovoid_error *error) {
    pair_frame f;
    if (frame_make(pair, &f) != OVOID_LIMIT_NONE || !vec3_is_finite(p->normal) || !vec3_is_finite(p->normal_low))
        return refuse(error, "lower bound of poses or by a normal that are not numbers", lower, 0);
    measure m = {.pair = pair, .frame = &f};
    return verify_lower(&m, lower, p, error);
}

static double measure_points(const pair_frame *f, const ovoid_proof *p) {
    witness_points w = proof_compute_points(f, p);
    return vec3_norm(vec3_sub(w.b, w.a)) - f->upper_radii + f->check;
}

static double measure_hull(const pair_frame *f, const ovoid_proof *p) {
    vec3 w[OVOID_PROOF_PAIRS];
    for (uint32_t i = 0; i < p->count; i++) w[i] = proof_difference(f, p, i).w;
    double depth = hull_compute_depth(w, (int)p->count, f->check);
    depth = fmax(depth, hull_compute_clearance(w, (int)p->count, f->check));
    return depth > 0 ? -depth - f->upper_radii : INFINITY;
}

static double measure_upper_again(const measure *m, const ovoid_proof *p) {
    if (p->kind == OVOID_PROOF_POINTS && p->count)
        return fine_compute_upper(&m->fine, fine_measure_points(&m->fine, p), m->fine.check);
    if (p->kind != OVOID_PROOF_HULL) return INFINITY;
    dd3 w[OVOID_PROOF_PAIRS];
    for (uint32_t i = 0; i < p->count; i++) w[i] = fine_difference(&m->fine, p->a[i], p->b[i]);
    return fine_measure_hull(&m->fine, w, (int)p->count, m->fine.check);
}

double cover_measure_upper(const pair_frame *f, const ovoid_cover *cover) {
    vec3 w[OVOID_COVER_POINTS];
    surface all;
    if (!surface_take_cover(&all, f, cover, w)) return INFINITY;
    double depth = surface_is_closed(&all) ? surface_compute_depth(&all, f->check) : 0;
    return depth > 0 ? -depth - f->upper_radii : INFINITY;
}

static ovoid_code verify_upper(measure *m, const answer_claims *claims, ovoid_error *error) {
    const pair_frame *f = m->frame;
    const ovoid_answer *answer = claims->answer;
    const ovoid_proof *p = &answer->proof;
    double found = INFINITY;
    switch (p->kind) {
    case OVOID_PROOF_NONE: break;
    case OVOID_PROOF_POINTS: found = p->count ? measure_points(f, p) : INFINITY; break;
    case OVOID_PROOF_HULL: found = measure_hull(f, p); break;
    case OVOID_PROOF_INNER: {
        double upper = inner_compute_upper(f, p->inner_a);
        if (upper < 0) found = upper;
        break;
    }
    case OVOID_PROOF_INNER_POINTS: found = inner_points_compute_upper(f, p->inner_a, p->inner_b, f->check); break;
    case OVOID_PROOF_COVER: found = cover_measure_upper(f, claims->cover); break;
    case OVOID_PROOF_BALLS: found = balls_compute_upper(f, p, f->check + BALLS_CHECK * f->size); break;
    }
    if (p->kind == OVOID_PROOF_COVER && !claims->cover)
        return refuse(error, "a depth without its cover", answer->upper, found);
    if (!(found <= answer->upper) && make_fine(m)) found = fmin(found, measure_upper_again(m, p));
    return found <= answer->upper ? OVOID_OK : refuse(error, "upper bound", answer->upper, found);
}

// The answer's points and normal must be those of the proof, to rounding and the slack; those of a hull around the
// origin are one point.
static ovoid_code verify_witness(const pair_frame *f, const ovoid_answer *answer, double slack, ovoid_error *error) {
    vec3 turn = vec3_sub(answer->normal, answer->proof.normal);
    if (!(vec3_max_abs(turn) <= 0)) return refuse(error, "normal is not the proof's", vec3_norm(answer->normal), 1);
    if (!(fabs(vec3_norm(answer->normal) - 1) <= 1e-12))
        return refuse(error, "length of the normal", vec3_norm(answer->normal), 1);
    if (!(vec3_max_abs(answer->proof.normal_low) <= 1e-12))
        return refuse(error, "normal is not the proof's, with its low part", vec3_max_abs(answer->proof.normal_low), 0);
    if (!vec3_is_finite(answer->point_a) || !vec3_is_finite(answer->point_b))
        return error_set(error, OVOID_ERROR_PROOF, -1, "a witness point is not finite");
    witness_points w = witness_compute_points(f, &answer->proof);
    slack += f->claim + 0x1p-50 * (vec3_max_abs(answer->point_a) + vec3_max_abs(answer->point_b));
    double off = fmax(vec3_norm(vec3_sub(frame_point_to_world(f, w.a), answer->point_a)),
                      vec3_norm(vec3_sub(frame_point_to_world(f, w.b), answer->point_b)));
    if (!(off <= slack)) return refuse(error, "witness points are not the proof's, off by", off, slack);
    if (answer->proof.kind != OVOID_PROOF_HULL) return OVOID_OK;
    slack += f->claim + reject_get_claim(f);
    off = vec3_norm(vec3_sub(answer->point_b, answer->point_a));
    return off <= slack ? OVOID_OK : refuse(error, "witness points are no common point, apart by", off, slack);
}

ovoid_code status_verify_internal(ovoid_verdict answer, double tolerance, ovoid_error *error) {
    ovoid_status shown = bracket_find_status(answer.lower, answer.upper, tolerance);
    int is_open = answer.status == OVOID_UNDECIDED && shown == OVOID_TOUCHING;
    if (answer.lower <= answer.upper && (answer.status == shown || is_open)) return OVOID_OK;
    return error_set(error, OVOID_ERROR_PROOF, -1,
                     "status %s does not follow from the bracket [%.17g, %.17g] and the tolerance %.3g",
                     ovoid_status_get_name(answer.status), answer.lower, answer.upper, tolerance);
}

// 1 if what the limit says is so: NONE and ALLOWANCE are promises of a width, on which ovoid_answer_get_distance rests,
// CAP is one of a distance. The others are reasons why there is no promise.
static int is_limit_shown(const ovoid_answer *answer, const answer_terms *terms) {
    double width = answer->upper - answer->lower, most = terms->tolerance + terms->allowance;
    switch (answer->limit) {
    case OVOID_LIMIT_NONE: return width <= most;
    case OVOID_LIMIT_ALLOWANCE:
        return terms->allowance > 0 &&
               (width <= most || (answer->lower >= -terms->allowance && answer->upper <= terms->allowance));
    case OVOID_LIMIT_CAP: return answer->lower > terms->cap;
    case OVOID_LIMIT_ANSWERED:
    case OVOID_LIMIT_ITERATIONS:
    case OVOID_LIMIT_PRECISION:
    case OVOID_LIMIT_CAPACITY: return 1;
    default: return 0;
    }
}

ovoid_code terms_verify_internal(const ovoid_answer *answer, const answer_terms *terms, ovoid_error *error) {
    ovoid_code code = status_verify_internal(answer_get_verdict(answer), terms->tolerance, error);
    if (code != OVOID_OK || is_limit_shown(answer, terms)) return code;
    return error_set(error, OVOID_ERROR_PROOF, -1, "limit %s does not follow from the bracket [%.17g, %.17g]",
                     ovoid_limit_get_name(answer->limit), answer->lower, answer->upper);
}

ovoid_code refusal_verify_internal(ovoid_verdict answer, ovoid_limit refused, ovoid_error *error) {
    int claims = answer.lower != -INFINITY || answer.upper != INFINITY || answer.status != OVOID_UNDECIDED;
    // A margin or memory that is refused too is not among the options.
    int is_own = answer.limit == OVOID_LIMIT_OPTIONS || answer.limit == OVOID_LIMIT_MEMORY;
    if (!claims && (answer.limit == refused || is_own)) return OVOID_OK;
    return error_set(error, OVOID_ERROR_PROOF, -1, "a query that must be refused has an answer or another reason");
}

static ovoid_code verify_bounds(const pair_frame *f, const answer_claims *claims, ovoid_error *error) {
    const ovoid_answer *answer = claims->answer;
    if (!proof_is_sound(f, &answer->proof))
        return error_set(error, OVOID_ERROR_PROOF, -1, "the proof has an index out of range or a number not finite");
    measure m = {.pair = claims->pair, .frame = f};
    ovoid_code code = verify_lower(&m, answer->lower, &answer->proof, error);
    if (code == OVOID_OK) code = verify_upper(&m, claims, error);
    return code == OVOID_OK ? verify_witness(f, answer, claims->slack, error) : code;
}

ovoid_code answer_verify_internal(const ovoid_pair *pair, const ovoid_answer *answer, const ovoid_answer_basis *basis,
                                  ovoid_error *error) {
    OVOID_ASSERT(pair && answer);
    const ovoid_options *given = basis->options;
    pair_frame f;
    ovoid_options options;
    ovoid_limit refused = options_make(given, &options) ? frame_make(pair, &f) : OVOID_LIMIT_OPTIONS;
    if (refused != OVOID_LIMIT_NONE || answer->limit == OVOID_LIMIT_OPTIONS || answer->limit == OVOID_LIMIT_MEMORY)
        return refusal_verify_internal(answer_get_verdict(answer), refused, error);
    const answer_terms terms = {options_compute_tolerance(&options, f.size, f.hidden), frame_get_allowance(&f),
                                given ? given->cap : 0};
    ovoid_code code = terms_verify_internal(answer, &terms, error);
    const answer_claims claims = {pair, answer, basis->cover, 0};
    return code == OVOID_OK ? verify_bounds(&f, &claims, error) : code;
}

ovoid_code bounds_verify_internal(const answer_claims *claims, ovoid_error *error) {
    pair_frame f;
    ovoid_limit refused = frame_make(claims->pair, &f);
    return refused == OVOID_LIMIT_NONE ? verify_bounds(&f, claims, error)
                                       : refusal_verify_internal(answer_get_verdict(claims->answer), refused, error);
}

ovoid_code ovoid_answer_verify(const ovoid_pair *pair, const ovoid_answer *answer, const ovoid_answer_basis *basis,
                               ovoid_error *error) {
    static const ovoid_answer_basis none;
    ENVIRONMENT_RETURN(ovoid_code, pair, answer_verify_internal(pair, answer, basis ? basis : &none, error));
}
