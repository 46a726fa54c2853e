// Checks of impacts and approaches, without a search: each step's gap is measured at its two ends, the theorem of
// motion_gap.h bounds it in between, and the answers at single times are checked by their own proofs.
#include "base/environment.h"
#include "base/error.h"
#include "motion/impact.h"
#include "motion/impact_sweep.h"
#include "pair/frame.h"

// A direction is unit, and turns with a body that turns.
static int step_is_sound(const motion_pair *pieces, const ovoid_step *step) {
    int turns = step->frame == OVOID_STEP_WORLD || (step->frame == OVOID_STEP_A && pieces->a.piece.turn > 0) ||
                (step->frame == OVOID_STEP_B && pieces->b.piece.turn > 0);
    return turns && fabs(vec3_norm_squared(step->normal) - 1) <= 16 * ROUNDING;
}

ovoid_code impact_verify_steps(moving_shapes shapes, const step_claim *claim, ovoid_error *error) {
    double time = claim->begin, level = claim->level, least;
    motion_pair pieces;
    int is_moment = claim->begin == claim->end;
    for (size_t i = 0; i < claim->count; i++) {
        const ovoid_step *step = &claim->steps[i];
        (void)motion_pair_make(shapes.a, shapes.b, time, &pieces);
        int goes_on = step->until > time || (is_moment && step->until == time);
        if (!goes_on || !(step->until <= pieces.end) || !step_is_sound(&pieces, step))
            return error_set(error, OVOID_ERROR_PROOF, (int64_t)i,
                             "step %zu does not go on from %.17g within one piece, or its normal is not unit, or turns "
                             "with a body that does not",
                             i, time);
        if (!motion_pair_is_above(&pieces, step, time, level, &least))
            return error_set(error, OVOID_ERROR_PROOF, (int64_t)i,
                             "step %zu, from %.17g to %.17g: claimed above %.17g, its normal shows %.17g", i, time,
                             step->until, level, least);
        time = step->until;
    }
    if (time >= claim->end) return OVOID_OK;
    return error_set(error, OVOID_ERROR_PROOF, (int64_t)claim->count, "the steps end at %.17g, the claim at %.17g",
                     time, claim->end);
}

ovoid_code impact_verify_answer(moving_shapes shapes, const answer_claim *claim, ovoid_error *error) {
    motion_pair pieces;
    ovoid_pair pair;
    (void)motion_pair_make(shapes.a, shapes.b, claim->time, &pieces);
    double shift = motion_pair_find_pair(&pieces, claim->time, &pair);
    // The bounds alone are claimed, whatever the tolerance that the queries at single times had.
    static const ovoid_options any = {.absolute_tolerance = INFINITY};
    ovoid_code code = ovoid_answer_verify(&pair, claim->answer, &(ovoid_answer_basis){.options = &any}, error);
    if (code != OVOID_OK) return code;
    double lower = claim->answer->lower - shift, upper = claim->answer->upper + shift;
    if (lower > claim->above && upper <= claim->most) return OVOID_OK;
    return error_set(error, OVOID_ERROR_PROOF, -1,
                     "the answer at %.17g proves [%.17g, %.17g], with the motion's rounding; not in (%.17g, %.17g]",
                     claim->time, lower, upper, claim->above, claim->most);
}

ovoid_code impact_verify_times(moving_shapes shapes, double begin, double end, ovoid_error *error) {
    sweep s;
    ovoid_motion_options options = {.begin = begin, .end = end};
    ovoid_limit limit = sweep_make(&s, shapes, &options, 0);
    if (limit == OVOID_LIMIT_NONE && s.begin == begin && s.end == end) return OVOID_OK;
    if (!shapes.a->shape || !shapes.b->shape)
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "a body without a shape");
    return error_set(error, OVOID_ERROR_PROOF, -1, "the motions have no times from %.17g to %.17g", begin, end);
}

ovoid_code impact_verify_query(moving_shapes shapes, const query_claim *claim, ovoid_error *error) {
    sweep s;
    const ovoid_motion_options own = {.begin = claim->begin, .end = claim->end}, *asked = claim->options;
    ovoid_limit limit = sweep_make(&s, shapes, asked ? asked : &own, 0);
    if (limit == OVOID_LIMIT_NONE && !(claim->margin >= 0 && claim->margin < INFINITY)) limit = OVOID_LIMIT_OPTIONS;
    // Options that are not known may be those that were refused.
    if (!asked && limit == OVOID_LIMIT_NONE && claim->limit == OVOID_LIMIT_OPTIONS) limit = claim->limit;
    int is_right = limit_is_refusal(limit) ? claim->limit == limit : s.begin == claim->begin && s.end == claim->end;
    if (limit_is_refusal(claim->limit) && is_right && !claim->is_empty)
        return error_set(error, OVOID_ERROR_PROOF, -1, "a query that is refused has an answer");
    if (limit_is_refusal(claim->limit) == limit_is_refusal(limit) && is_right) return OVOID_OK;
    if (!limit_is_refusal(claim->limit) && (!shapes.a->shape || !shapes.b->shape))
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "a body without a shape");
    return error_set(error, OVOID_ERROR_PROOF, -1, "from %.17g to %.17g, limit %s: the query's limit is %s",
                     claim->begin, claim->end, ovoid_limit_get_name(claim->limit), ovoid_limit_get_name(limit));
}

int impact_is_refusal(const ovoid_impact *impact) { return limit_is_refusal(impact->limit); }

int impact_is_empty(const ovoid_impact *impact) {
    return impact->status == OVOID_IMPACT_UNDECIDED && impact->free_until == 0 && impact->hit_at == INFINITY &&
           impact->step_count == 0;
}

int impact_is_sound(const ovoid_impact *impact, double margin) {
    int is_hit = impact->status == OVOID_IMPACT_HIT, is_free = impact->status == OVOID_IMPACT_FREE;
    int is_known = (unsigned)impact->status <= OVOID_IMPACT_HIT && (unsigned)impact->limit <= OVOID_LIMIT_ALLOWANCE;
    int times = impact->free_until >= impact->begin && impact->free_until <= impact->end &&
                impact->hit_at >= impact->free_until;
    int hit = is_hit ? impact->hit_at <= impact->end : impact->hit_at == INFINITY;
    return is_known && times && hit && !(is_free && impact->free_until != impact->end) && margin >= 0;
}

static ovoid_code verify_impact(const ovoid_moving_pair *pair, const ovoid_impact *impact,
                                const ovoid_motion_basis *proof, ovoid_error *error) {
    const moving_shapes shapes = {&pair->a, &pair->b};
    double margin = pair->margin;
    OVOID_ASSERT(impact && (proof->steps || !impact->step_count));
    const query_claim query = {margin,      proof->options, impact->begin,
                               impact->end, impact->limit,  impact_is_empty(impact)};
    ovoid_code code = impact_verify_query(shapes, &query, error);
    if (code != OVOID_OK || impact_is_refusal(impact)) return code;
    int is_hit = impact->status == OVOID_IMPACT_HIT, is_free = impact->status == OVOID_IMPACT_FREE;
    if (!impact_is_sound(impact, margin))
        return error_set(error, OVOID_ERROR_PROOF, -1, "status %s does not follow from free until %.17g, hit at %.17g",
                         ovoid_impact_status_get_name(impact->status), impact->free_until, impact->hit_at);
    const step_claim free = {impact->begin, impact->free_until, margin, proof->steps, impact->step_count};
    const answer_claim at_end = {impact->free_until, &impact->free, is_free && !impact->step_count ? margin : -INFINITY,
                                 INFINITY};
    const answer_claim at_hit = {impact->hit_at, &impact->hit, -INFINITY, margin};
    code = impact_verify_steps(shapes, &free, error);
    if (code == OVOID_OK) code = impact_verify_answer(shapes, &at_end, error);
    if (code == OVOID_OK && is_hit) code = impact_verify_answer(shapes, &at_hit, error);
    return code;
}

ovoid_code ovoid_impact_verify(const ovoid_moving_pair *pair, const ovoid_impact *impact,
                               const ovoid_motion_basis *basis, ovoid_error *error) {
    static const ovoid_motion_basis none;
    ENVIRONMENT_RETURN(ovoid_code, pair, verify_impact(pair, impact, basis ? basis : &none, error));
}

// 1 if the status says what the bracket says; of bodies that touch, within the tolerance that was asked for.
static int approach_is_sound(moving_shapes shapes, const ovoid_approach *claimed, const ovoid_motion_options *options) {
    if ((unsigned)claimed->limit > OVOID_LIMIT_ALLOWANCE ||
        !(claimed->time >= claimed->begin && claimed->time <= claimed->end))
        return 0;
    if (!(claimed->lower <= claimed->upper)) return 0;
    sweep s;
    const ovoid_motion_options own = {.begin = claimed->begin, .end = claimed->end};
    switch (claimed->status) {
    case OVOID_SEPARATED: return claimed->lower > 0;
    case OVOID_OVERLAPPING: return claimed->upper < 0;
    case OVOID_TOUCHING:
        (void)sweep_make(&s, shapes, options ? options : &own, APPROACH_TOLERANCE);
        return claimed->lower <= 0 && claimed->upper >= 0 &&
               claimed->upper - claimed->lower <= s.tolerance * sweep_find_size(&s);
    case OVOID_UNDECIDED: return claimed->lower <= 0 && claimed->upper >= 0;
    }
    return 0;
}

static ovoid_code verify_approach(moving_shapes shapes, const ovoid_approach *claimed, const ovoid_motion_basis *proof,
                                  ovoid_error *error) {
    OVOID_ASSERT(claimed && (proof->steps || !claimed->step_count));
    int is_empty = claimed->status == OVOID_UNDECIDED && claimed->lower == -INFINITY && claimed->upper == INFINITY;
    const query_claim query = {0, proof->options, claimed->begin, claimed->end, claimed->limit, is_empty};
    ovoid_code code = impact_verify_query(shapes, &query, error);
    if (code != OVOID_OK || limit_is_refusal(claimed->limit)) return code;
    if (!approach_is_sound(shapes, claimed, proof->options))
        return error_set(error, OVOID_ERROR_PROOF, -1, "status %s does not follow from the bracket [%.17g, %.17g]",
                         ovoid_status_get_name(claimed->status), claimed->lower, claimed->upper);
    // lower is proven if every step is above the number just below it.
    double level = nextafter(claimed->lower, -INFINITY);
    const step_claim above = {claimed->begin, claimed->end, level, proof->steps, claimed->step_count};
    const answer_claim alone = {claimed->begin, &claimed->answer, level, INFINITY};
    const answer_claim nearest = {claimed->time, &claimed->answer, -INFINITY, claimed->upper};
    if (claimed->lower > -INFINITY && claimed->begin < claimed->end)
        code = impact_verify_steps(shapes, &above, error);
    else if (claimed->lower > -INFINITY)
        code = impact_verify_answer(shapes, &alone, error);
    if (code == OVOID_OK) code = impact_verify_answer(shapes, &nearest, error);
    return code;
}

ovoid_code ovoid_approach_verify(const ovoid_moving_pair *pair, const ovoid_approach *approach,
                                 const ovoid_motion_basis *basis, ovoid_error *error) {
    static const ovoid_motion_basis none;
    moving_shapes shapes = {&pair->a, &pair->b};
    ENVIRONMENT_RETURN(ovoid_code, shapes, verify_approach(shapes, approach, basis ? basis : &none, error));
}
