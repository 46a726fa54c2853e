// How near do two moving bodies come? A branch and bound over time, in one pass: the smallest distance found so far,
// less the tolerance, is a level, and the steps of impact_sweep.h prove that the distance stays above it. Where a step
// becomes short because the bodies come nearer, the least distance ahead is searched first (by tangents of both sides,
// as the distance along a motion is convex but for the curvature), so that the level lies below it.
#include "base/environment.h"
#include "base/error.h"
#include "motion/impact_sweep.h"
#include "query/answer.h"

enum { DESCENT_MAX = 40 };

typedef struct approach {
    sweep s;
    double tolerance; ///< length
    ovoid_approach *out;
} approach;

/// The distance at one time, and how fast it falls.
typedef struct sample {
    double time, distance, fall;
} sample;

// Queries the distance at a time and records the smallest. An overlap ends this search, as the smallest there is.
static sample query_at(approach *state, double time) {
    sweep *s = &state->s;
    sweep_query(s, time);
    if (sweep_get_upper(s) < state->out->upper) {
        state->out->upper = sweep_get_upper(s);
        state->out->time = time;
        state->out->answer = s->answer;
    }
    return (sample){time, s->answer.upper, s->fall};
}

static int is_over(const approach *state) { return state->out->upper < 0 || state->s.used >= state->s.most; }

// The least distance between two times, where it falls at the first and rises at the second.
static void descend_between(approach *state, sample low, sample high) {
    for (int round = 0; round < DESCENT_MAX && !is_over(state); round++) {
        // The next time is where the tangents meet, kept away from both ends.
        double wide = high.time - low.time, fall = max2(low.fall, 0), rise = max2(-high.fall, 0);
        double share = fall + rise > 0 ? (rise + (low.distance - high.distance) / wide) / (fall + rise) : 0.5;
        double floor = low.distance - fall * share * wide;
        double least = min2(low.distance, high.distance);
        if (least - floor <= 0.25 * state->tolerance && share >= 0 && share <= 1) return;
        if (round % 3 == 2 || !(share > 0 && share < 1)) share = 0.5;
        double time = low.time + min2(max2(share, 0.02), 0.98) * wide;
        if (!(time > low.time && time < high.time)) return;
        sample middle = query_at(state, time);
        if (middle.fall > 0 && middle.distance <= low.distance)
            low = middle;
        else
            high = middle;
    }
}

// Descends from a time at which the distance falls: ahead until it rises, then between the two.
static void descend(approach *state, sample from) {
    double ahead = 1e-3 * (state->s.end - state->s.begin);
    for (int round = 0; round < DESCENT_MAX && !is_over(state); round++, ahead *= 2) {
        double time = min2(from.time + ahead, state->s.end);
        if (!(time > from.time)) return;
        sample next = query_at(state, time);
        if (next.fall <= 0 || next.distance >= from.distance) {
            descend_between(state, from, next);
            return;
        }
        from = next;
    }
}

// How far the level is below the smallest distance. Once half of the queries are used it is lowered, so that the search
// ends with a wider bracket instead of none.
static double compute_slack(const approach *state) {
    double spent = 2 * ((double)state->s.used / state->s.most) - 1;
    return state->tolerance * (spent > 0 ? ldexp(1, (int)(32 * spent)) : 1);
}

// One pass over all times. A step that doubles do not prove is tried again at a lower level.
static void run(approach *state) {
    sweep *s = &state->s;
    double lowered = 1;
    (void)query_at(state, s->end);
    (void)query_at(state, s->begin + 0.5 * (s->end - s->begin));
    while (!is_over(state) && s->time < s->end) {
        sample here = query_at(state, s->time);
        double before = state->out->upper, time = s->time,
               level = before - s->allowance - lowered * compute_slack(state);
        if (is_over(state)) return;
        vec3 n = vec3_unit(s->answer.normal);
        int moved = sweep_step(s, n, level);
        if (!moved && lowered > 1e6) {
            state->out->limit = OVOID_LIMIT_PRECISION;
            return;
        }
        if (!moved) lowered *= 4;
        // A short step, and ahead the distance falls below the smallest one found.
        if (here.fall > 0 && s->time - time < 0.01 * (s->end - s->begin)) {
            sweep_query(s, s->time);
            if (sweep_get_lower(s) + s->allowance < before + state->tolerance && s->fall > 0)
                descend(state, (sample){s->time, s->answer.upper, s->fall});
        }
    }
}

static void finish(approach *state) {
    const sweep *s = &state->s;
    ovoid_approach *out = state->out;
    out->iterations = s->used;
    out->begin = s->begin;
    out->end = s->end;
    out->step_count = s->count;
    if (s->time >= s->end) out->lower = s->begin < s->end ? s->least : sweep_get_lower(s);
    if (out->lower > out->upper) out->lower = out->upper;
    if (out->upper < 0)
        out->status = OVOID_OVERLAPPING;
    else if (out->lower > 0)
        out->status = OVOID_SEPARATED;
    else if (out->upper - out->lower <= state->tolerance)
        out->status = OVOID_TOUCHING;
    if (out->status == OVOID_OVERLAPPING || out->limit != OVOID_LIMIT_NONE) return;
    if (out->upper - out->lower <= 1.001 * state->tolerance + s->allowance) {
        if (out->status == OVOID_UNDECIDED) out->limit = OVOID_LIMIT_ALLOWANCE;
        return;
    }
    out->limit = s->used >= s->most ? OVOID_LIMIT_ITERATIONS : OVOID_LIMIT_PRECISION;
}

static ovoid_approach find(const ovoid_moving_pair *pair, const ovoid_motion_options *options) {
    OVOID_ASSERT(pair);
    ovoid_approach out = {.lower = -INFINITY, .upper = INFINITY};
    approach state = {.out = &out};
    out.limit = sweep_make(&state.s, (moving_shapes){&pair->a, &pair->b}, options, APPROACH_TOLERANCE);
    if (out.limit != OVOID_LIMIT_NONE) {
        out.answer = answer_make_refused(out.limit);
        return out;
    }
    state.tolerance = state.s.tolerance * sweep_find_size(&state.s);
    if (state.s.begin < state.s.end)
        run(&state);
    else
        (void)query_at(&state, state.s.begin);
    finish(&state);
    return out;
}

ovoid_approach ovoid_approach_find(const ovoid_moving_pair *pair, const ovoid_motion_options *options) {
    ENVIRONMENT_RETURN(ovoid_approach, pair, find(pair, options));
}
