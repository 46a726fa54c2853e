// How near do two moving bodies come? A branch and bound over time, in one pass: the smallest distance seen so far,
// less the tolerance, is a level, and the steps of impact_sweep.h prove that the distance stays above it. Where a step
// becomes short because the bodies come nearer, the least distance ahead is looked for first (tangents of both sides,
// as the distance along a motion is convex but for the curvature), so that the level lies below it.
#include "base/environment.h"
#include "base/error.h"
#include "query/answer.h"
#include "query/impact_sweep.h"

enum { MOST_DESCENT = 40 };

typedef struct approach {
    sweep s;
    double tolerance; ///< length
    ovoid_approach *out;
} approach;

/// The distance at a time, as it was seen.
typedef struct look {
    double time, distance, fall;
} look;

// Asks, and keeps the smallest. An overlap is the smallest there is, for this search.
static look ask(approach *x, double time) {
    sweep *s = &x->s;
    sweep_ask(s, time);
    if (sweep_get_upper(s) < x->out->upper) {
        x->out->upper = sweep_get_upper(s);
        x->out->time = time;
        x->out->answer = s->answer;
    }
    return (look){time, s->answer.upper, s->fall};
}

static int is_over(const approach *x) { return x->out->upper < 0 || x->s.used >= x->s.most; }

// The least distance between two times, where it falls at the first and rises at the second.
static void descend_between(approach *x, look low, look high) {
    for (int round = 0; round < MOST_DESCENT && !is_over(x); round++) {
        // Where the tangents meet, kept away from both ends.
        double wide = high.time - low.time, fall = max2(low.fall, 0), rise = max2(-high.fall, 0);
        double share = fall + rise > 0 ? (rise + (low.distance - high.distance) / wide) / (fall + rise) : 0.5;
        double floor = low.distance - fall * share * wide;
        double least = min2(low.distance, high.distance);
        if (least - floor <= 0.25 * x->tolerance && share >= 0 && share <= 1) return;
        if (round % 3 == 2 || !(share > 0 && share < 1)) share = 0.5;
        double time = low.time + min2(max2(share, 0.02), 0.98) * wide;
        if (!(time > low.time && time < high.time)) return;
        look middle = ask(x, time);
        if (middle.fall > 0 && middle.distance <= low.distance)
            low = middle;
        else
            high = middle;
    }
}

// From a time at which the distance falls: ahead until it rises, then between.
static void descend(approach *x, look from) {
    double ahead = 1e-3 * (x->s.end - x->s.begin);
    for (int round = 0; round < MOST_DESCENT && !is_over(x); round++, ahead *= 2) {
        double time = min2(from.time + ahead, x->s.end);
        if (!(time > from.time)) return;
        look next = ask(x, time);
        if (next.fall <= 0 || next.distance >= from.distance) {
            descend_between(x, from, next);
            return;
        }
        from = next;
    }
}

// How far below the smallest distance the level is. From half of the queries on it is lowered, so that the search ends
// with a wider bracket instead of none.
static double compute_slack(const approach *x) {
    double spent = 2 * ((double)x->s.used / x->s.most) - 1;
    return x->tolerance * (spent > 0 ? ldexp(1, (int)(32 * spent)) : 1);
}

// One pass over all times. A step that is not proven in doubles is tried again at a lower level.
static void run(approach *x) {
    sweep *s = &x->s;
    double lowered = 1;
    (void)ask(x, s->end);
    (void)ask(x, s->begin + 0.5 * (s->end - s->begin));
    while (!is_over(x) && s->time < s->end) {
        look here = ask(x, s->time);
        double before = x->out->upper, time = s->time, level = before - lowered * compute_slack(x);
        if (is_over(x)) return;
        vec3 n = vec3_unit(s->answer.normal);
        int moved = sweep_step(s, n, level);
        if (!moved && lowered > 1e6) {
            x->out->limit = OVOID_LIMIT_PRECISION;
            return;
        }
        if (!moved) lowered *= 4;
        // Short, and the way on leads below what was seen.
        if (here.fall > 0 && s->time - time < 0.01 * (s->end - s->begin)) {
            sweep_ask(s, s->time);
            if (sweep_get_lower(s) < before + x->tolerance && s->fall > 0)
                descend(x, (look){s->time, s->answer.upper, s->fall});
        }
    }
}

static void finish(approach *x) {
    const sweep *s = &x->s;
    ovoid_approach *out = x->out;
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
    else if (out->upper - out->lower <= x->tolerance)
        out->status = OVOID_TOUCHING;
    if (out->status == OVOID_OVERLAPPING || out->limit != OVOID_LIMIT_NONE) return;
    if (out->upper - out->lower <= 1.001 * x->tolerance) return;
    out->limit = s->used >= s->most ? OVOID_LIMIT_ITERATIONS : OVOID_LIMIT_PRECISION;
}

// The pair's size, for the tolerance: of the first look.
static double find_size(const approach *x) {
    ovoid_pair at;
    pair_frame f;
    (void)motion_pair_find_pair(&x->s.pieces, x->s.time, &at);
    return frame_place(&at, &f) == OVOID_LIMIT_NONE ? f.size : 0;
}

static ovoid_approach find(const ovoid_moving *a, const ovoid_moving *b, const ovoid_motion_options *options) {
    OVOID_ASSERT(a && b && a->shape && b->shape);
    ovoid_approach out = {.lower = -INFINITY, .upper = INFINITY};
    approach x = {.out = &out};
    out.limit = sweep_make(&x.s, a, b, options, 1e-6);
    if (out.limit != OVOID_LIMIT_NONE) {
        out.answer = answer_make_refused(out.limit);
        return out;
    }
    x.tolerance = x.s.tolerance * find_size(&x);
    if (x.s.begin < x.s.end)
        run(&x);
    else
        (void)ask(&x, x.s.begin);
    finish(&x);
    return out;
}

ovoid_approach ovoid_approach_find(const ovoid_moving *a, const ovoid_moving *b, const ovoid_motion_options *options) {
    ENVIRONMENT_RETURN(ovoid_approach, a, find(a, b, options));
}
