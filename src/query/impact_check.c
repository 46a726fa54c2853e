// Checking what is said of two moving bodies, without a search: each step's gap is measured at its two ends, the
// theorem of motion_gap.h says what it is in between, and the answers at single times are checked by their own proofs.
#include "base/environment.h"
#include "base/error.h"
#include "query/impact.h"
#include "query/impact_sweep.h"

// The steps from begin to `end`, all of them above the level.
ovoid_code impact_check_steps(const ovoid_moving *a, const ovoid_moving *b, double begin, double end, double level,
                              const ovoid_step *steps, size_t count, ovoid_error *error) {
    double time = begin, least;
    motion_pair pieces;
    for (size_t i = 0; i < count; i++) {
        (void)motion_pair_make(a, b, time, &pieces);
        int sound = steps[i].frame <= OVOID_STEP_B && fabs(vec3_norm_squared(steps[i].normal) - 1) <= 16 * ROUNDING;
        if (!(steps[i].until > time) || !(steps[i].until <= pieces.end) || !sound)
            return error_set(error, OVOID_ERROR_PROOF, (int64_t)i,
                             "step %zu does not go on from %.17g within one piece, or has no unit normal", i, time);
        if (!motion_pair_is_above(&pieces, &steps[i], time, level, &least))
            return error_set(error, OVOID_ERROR_PROOF, (int64_t)i,
                             "step %zu, from %.17g to %.17g: claimed above %.17g, its normal shows %.17g", i, time,
                             steps[i].until, level, least);
        time = steps[i].until;
    }
    if (time >= end) return OVOID_OK;
    return error_set(error, OVOID_ERROR_PROOF, (int64_t)count, "the steps end at %.17g, the claim at %.17g", time, end);
}

// The answer at a time, by its own proof, and that the exact motion's distance is at most `most` and above `least`.
ovoid_code impact_check_answer(const ovoid_moving *a, const ovoid_moving *b, double time, const ovoid_answer *answer,
                               double least, double most, ovoid_error *error) {
    motion_pair pieces;
    ovoid_pair pair;
    (void)motion_pair_make(a, b, time, &pieces);
    double shift = motion_pair_find_pair(&pieces, time, &pair);
    ovoid_code code = ovoid_answer_check(&pair, answer, NULL, error);
    if (code != OVOID_OK) return code;
    if (answer->lower - shift > least && answer->upper + shift <= most) return OVOID_OK;
    return error_set(error, OVOID_ERROR_PROOF, -1,
                     "the answer at %.17g proves [%.17g, %.17g], with the motion's rounding; not in (%.17g, %.17g]",
                     time, answer->lower - shift, answer->upper + shift, least, most);
}

// Motions and times as the query would have taken them.
ovoid_code impact_check_times(const ovoid_moving *a, const ovoid_moving *b, double begin, double end,
                              ovoid_error *error) {
    sweep s;
    ovoid_motion_options options = {.begin = begin, .end = end};
    ovoid_limit limit = sweep_make(&s, a, b, &options, 0);
    if (limit == OVOID_LIMIT_NONE && s.begin == begin && s.end == end) return OVOID_OK;
    return error_set(error, OVOID_ERROR_PROOF, -1, "the motions have no times from %.17g to %.17g", begin, end);
}

static int is_refusal(ovoid_limit limit) {
    return limit == OVOID_LIMIT_POSE_A || limit == OVOID_LIMIT_POSE_B || limit == OVOID_LIMIT_OPTIONS;
}

int impact_is_sound(const ovoid_impact *x, double margin) {
    int is_hit = x->status == OVOID_IMPACT_HIT, is_free = x->status == OVOID_IMPACT_FREE;
    int times = x->free_until >= x->begin && x->free_until <= x->end && x->hit_at >= x->free_until;
    return times && is_hit == (x->hit_at <= x->end) && !(is_free && x->free_until != x->end) && margin >= 0;
}

static ovoid_code check_impact(const ovoid_moving *a, const ovoid_moving *b, double margin, const ovoid_impact *x,
                               const ovoid_step *steps, ovoid_error *error) {
    OVOID_ASSERT(a && b && x && (steps || !x->step_count));
    // A refusal claims nothing.
    if (is_refusal(x->limit) && x->status == OVOID_IMPACT_UNDECIDED && x->free_until == 0 && x->step_count == 0)
        return OVOID_OK;
    ovoid_code code = impact_check_times(a, b, x->begin, x->end, error);
    if (code != OVOID_OK) return code;
    int is_hit = x->status == OVOID_IMPACT_HIT, is_free = x->status == OVOID_IMPACT_FREE;
    if (!impact_is_sound(x, margin))
        return error_set(error, OVOID_ERROR_PROOF, -1, "status %s does not follow from free until %.17g, hit at %.17g",
                         ovoid_impact_status_get_name(x->status), x->free_until, x->hit_at);
    code = impact_check_steps(a, b, x->begin, x->free_until, margin, steps, x->step_count, error);
    if (code == OVOID_OK)
        code = impact_check_answer(a, b, x->free_until, &x->free, is_free && !x->step_count ? margin : -INFINITY,
                                   INFINITY, error);
    if (code == OVOID_OK && is_hit) code = impact_check_answer(a, b, x->hit_at, &x->hit, -INFINITY, margin, error);
    return code;
}

ovoid_code ovoid_impact_check(const ovoid_moving *a, const ovoid_moving *b, double margin, const ovoid_impact *impact,
                              const ovoid_step *steps, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, margin, check_impact(a, b, margin, impact, steps, error));
}

static ovoid_code check_approach(const ovoid_moving *a, const ovoid_moving *b, const ovoid_approach *x,
                                 const ovoid_step *steps, ovoid_error *error) {
    OVOID_ASSERT(a && b && x && (steps || !x->step_count));
    if (is_refusal(x->limit) && x->lower == -INFINITY && x->upper == INFINITY) return OVOID_OK;
    ovoid_code code = impact_check_times(a, b, x->begin, x->end, error);
    if (code != OVOID_OK) return code;
    int follows = x->status == OVOID_SEPARATED     ? x->lower > 0
                  : x->status == OVOID_OVERLAPPING ? x->upper < 0
                                                   : x->lower <= 0 && x->upper >= 0;
    if (!follows || !(x->time >= x->begin && x->time <= x->end) || !(x->lower <= x->upper))
        return error_set(error, OVOID_ERROR_PROOF, -1, "status %s does not follow from the bracket [%.17g, %.17g]",
                         ovoid_status_get_name(x->status), x->lower, x->upper);
    // A level is proven if every step is above what is just below it.
    double level = nextafter(x->lower, -INFINITY);
    if (x->lower > -INFINITY && x->begin < x->end)
        code = impact_check_steps(a, b, x->begin, x->end, level, steps, x->step_count, error);
    else if (x->lower > -INFINITY)
        code = impact_check_answer(a, b, x->begin, &x->answer, level, INFINITY, error);
    if (code == OVOID_OK) code = impact_check_answer(a, b, x->time, &x->answer, -INFINITY, x->upper, error);
    return code;
}

ovoid_code ovoid_approach_check(const ovoid_moving *a, const ovoid_moving *b, const ovoid_approach *approach,
                                const ovoid_step *steps, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, a, check_approach(a, b, approach, steps, error));
}
