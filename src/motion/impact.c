// When do two moving bodies first come within a margin of each other? Conservative advancement (B. Mirtich,
// Impulse-based dynamic simulation of rigid body systems, 1996) with proven steps: the normal of the nearest points is
// fixed, and the gap along it bounds the distance from below over the whole step (motion_gap.h), so no motion between
// two queries is missed. Where the steps become shorter than the time's tolerance, queries ahead find a time at which
// the bodies are proven to be within the margin: free_until <= true time <= hit_at.
#include "motion/impact.h"
#include "base/environment.h"
#include "base/error.h"
#include "motion/impact_sweep.h"
#include "query/answer.h"

enum { QUERIES_MAX = 60 };

typedef struct advance {
    sweep s;
    double margin;
    double shortest; ///< time: a shorter step is no progress
    double finest;   ///< time: the width that rounding leaves to the bracket, as far as is known
    double free_at;  ///< the time of out->free
    ovoid_impact *out;
} advance;

static vec3 get_normal(const sweep *s) { return vec3_unit(s->answer.normal); }
static int is_within(const advance *state) { return sweep_get_upper(&state->s) <= state->margin; }
static int is_beyond(const advance *state) { return sweep_get_lower(&state->s) > state->margin; }

static void take_hit(advance *state) {
    state->out->status = OVOID_IMPACT_HIT;
    state->out->hit_at = state->s.queried_at;
    state->out->hit = state->s.answer;
}

// Queries at the time until which the bodies are free.
static void query_here(advance *state) {
    if (!state->s.used || state->s.queried_at != state->s.time) sweep_query(&state->s, state->s.time);
    state->out->free = state->s.answer;
    state->free_at = state->s.time;
}

// How far ahead the bodies should be within the margin by more than rounding, if they keep their speed.
static double guess_ahead(const advance *state) {
    const sweep *s = &state->s;
    double way = max2(sweep_get_upper(s) - state->margin, 0) + 32 * s->error;
    double least = nextafter(fabs(s->time), INFINITY) - fabs(s->time);
    double most = s->end - s->time, ahead = s->fall > 0 ? 1.5 * way / s->fall : state->shortest;
    return max2(min2(ahead, most), 4 * least);
}

// Steps on from a query that found the bodies beyond the margin, along its normal or along the last one; 1 if that is
// proven free.
static int step_to_query(advance *state, vec3 before) {
    sweep *s = &state->s;
    double until = s->queried_at;
    return sweep_step_to(s, until, get_normal(s), state->margin) || sweep_step_to(s, until, before, state->margin);
}

// Bisects between a free time and a time that is a hit, or that cannot be proven to be reached free. 1 at the end of
// the search, 0 if it goes on from a step.
static int bisect(advance *state, vec3 before, double high) {
    sweep *s = &state->s;
    double low = s->time;
    double enough = state->out->status == OVOID_IMPACT_HIT ? state->shortest : 0;
    for (int round = 0; round < QUERIES_MAX && s->used < s->most && high - low > enough; round++) {
        double middle = low + 0.5 * (high - low);
        if (!(middle > low && middle < high)) break;
        sweep_query(s, middle);
        if (is_within(state)) {
            take_hit(state);
            high = middle;
            enough = state->shortest;
        } else if (is_beyond(state) && s->pieces.end >= middle && step_to_query(state, before)) {
            if (state->out->status != OVOID_IMPACT_HIT) return 0;
            low = middle;
        } else if (state->out->status == OVOID_IMPACT_HIT || !is_beyond(state)) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return 1;
}

// Queries ahead from where the steps became short. 1 at the end of the search.
static int search_ahead(advance *state) {
    sweep *s = &state->s;
    query_here(state);
    if (is_within(state)) {
        take_hit(state);
        return 1;
    }
    vec3 before = get_normal(s);
    double ahead = guess_ahead(state), coarse = 0.5 * state->shortest;
    state->finest = 16 * ahead;
    // An overlap as deep as the tolerance allows is proven at once.
    if (coarse > ahead && s->time + coarse < s->end) {
        sweep_query(s, s->time + coarse);
        if (is_within(state)) {
            take_hit(state);
            return 1;
        }
        if (is_beyond(state) && step_to_query(state, before)) return 0;
    }
    for (int round = 0; round < QUERIES_MAX && s->used < s->most; round++, ahead *= 4) {
        double time = min2(s->time + ahead, s->end);
        if (!(time > s->time)) return 1;
        sweep_query(s, time);
        if (is_within(state)) {
            take_hit(state);
            return bisect(state, before, time);
        }
        if (is_beyond(state) && time <= s->pieces.end && step_to_query(state, before)) return 0;
        if (is_beyond(state) && round == 0 && !bisect(state, before, time)) return 0;
        if (state->out->status == OVOID_IMPACT_HIT || time >= s->end) return 1;
    }
    return 1;
}

static void run(advance *state) {
    sweep *s = &state->s;
    ovoid_impact *out = state->out;
    for (;;) {
        query_here(state);
        if (is_within(state)) {
            take_hit(state);
            return;
        }
        if (s->time >= s->end) {
            if (s->count || is_beyond(state)) out->status = OVOID_IMPACT_FREE;
            return;
        }
        if (s->used >= s->most) {
            out->limit = OVOID_LIMIT_ITERATIONS;
            return;
        }
        // The way left to the margin is not worth a step.
        double before = s->time;
        int is_near = sweep_get_upper(s) - state->margin < 0.25 * state->shortest * s->fall;
        if (!is_near && sweep_step(s, get_normal(s), state->margin) &&
            (s->time - before > state->shortest || s->time >= s->end))
            continue;
        if (search_ahead(state)) return;
    }
}

static void finish(advance *state) {
    sweep *s = &state->s;
    ovoid_impact *out = state->out;
    if (out->status == OVOID_IMPACT_UNDECIDED) out->hit = s->answer;
    if (state->free_at != s->time) query_here(state);
    out->iterations = s->used;
    out->begin = s->begin;
    out->end = s->end;
    out->free_until = s->time;
    out->step_count = s->count;
    if (out->status == OVOID_IMPACT_FREE || out->limit != OVOID_LIMIT_NONE) return;
    double wide = out->status == OVOID_IMPACT_HIT ? out->hit_at - s->time : INFINITY;
    if (wide <= s->tolerance * (s->end - s->begin) || wide <= state->finest) return;
    // The bracket of the distance at the end of the free times holds the margin: 1 if the allowances make it that wide.
    int is_allowed = 2 * s->allowance > out->free.upper - out->free.lower;
    out->limit = s->used >= s->most ? OVOID_LIMIT_ITERATIONS
                 : is_allowed       ? OVOID_LIMIT_ALLOWANCE
                                    : OVOID_LIMIT_PRECISION;
}

void impact_find(moving_shapes shapes, double margin, const ovoid_motion_options *options, double tolerance,
                 ovoid_impact *out) {
    OVOID_ASSERT(shapes.a && shapes.b);
    *out = (ovoid_impact){.hit_at = INFINITY};
    advance state = {.margin = margin, .out = out};
    out->limit = sweep_make(&state.s, shapes, options, tolerance);
    if (out->limit == OVOID_LIMIT_NONE && !(margin >= 0 && margin < INFINITY)) out->limit = OVOID_LIMIT_OPTIONS;
    if (out->limit != OVOID_LIMIT_NONE) {
        out->free = out->hit = answer_make_refused(out->limit);
        return;
    }
    state.shortest = 0.5 * state.s.tolerance * (state.s.end - state.s.begin);
    run(&state);
    finish(&state);
}

static ovoid_impact find(const ovoid_moving_pair *pair, const ovoid_motion_options *options) {
    ovoid_impact out;
    impact_find((moving_shapes){&pair->a, &pair->b}, pair->margin, options, 1e-9, &out);
    return out;
}

ovoid_impact ovoid_impact_find(const ovoid_moving_pair *pair, const ovoid_motion_options *options) {
    ENVIRONMENT_RETURN(ovoid_impact, pair, find(pair, options));
}

const char *ovoid_impact_status_get_name(ovoid_impact_status status) {
    switch (status) {
    case OVOID_IMPACT_UNDECIDED: return "undecided";
    case OVOID_IMPACT_FREE: return "free";
    case OVOID_IMPACT_HIT: return "hit";
    }
    return "unknown";
}
