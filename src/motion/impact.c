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
static int is_within(const advance *x) { return sweep_get_upper(&x->s) <= x->margin; }
static int is_beyond(const advance *x) { return sweep_get_lower(&x->s) > x->margin; }

static void take_hit(advance *x) {
    x->out->status = OVOID_IMPACT_HIT;
    x->out->hit_at = x->s.queried_at;
    x->out->hit = x->s.answer;
}

// Queries at the time until which the bodies are free.
static void query_here(advance *x) {
    if (!x->s.used || x->s.queried_at != x->s.time) sweep_query(&x->s, x->s.time);
    x->out->free = x->s.answer;
    x->free_at = x->s.time;
}

// How far ahead the bodies should be within the margin by more than rounding, if they keep their speed.
static double guess_ahead(const advance *x) {
    const sweep *s = &x->s;
    double way = max2(sweep_get_upper(s) - x->margin, 0) + 32 * s->error;
    double least = nextafter(fabs(s->time), INFINITY) - fabs(s->time);
    double most = s->end - s->time, ahead = s->fall > 0 ? 1.5 * way / s->fall : x->shortest;
    return max2(min2(ahead, most), 4 * least);
}

// After a query that found the bodies beyond the margin: steps there along its normal or along the last one; 1 if that
// is proven free.
static int step_to_query(advance *x, vec3 before) {
    sweep *s = &x->s;
    double until = s->queried_at;
    return sweep_step_to(s, until, get_normal(s), x->margin) || sweep_step_to(s, until, before, x->margin);
}

// Bisects between a free time and a time that is a hit, or that cannot be proven to be reached free. 1 at the end of
// the search, 0 if it goes on from a step.
static int bisect(advance *x, vec3 before, double high) {
    sweep *s = &x->s;
    double low = s->time;
    double enough = x->out->status == OVOID_IMPACT_HIT ? x->shortest : 0;
    for (int round = 0; round < QUERIES_MAX && s->used < s->most && high - low > enough; round++) {
        double middle = low + 0.5 * (high - low);
        if (!(middle > low && middle < high)) break;
        sweep_query(s, middle);
        if (is_within(x)) {
            take_hit(x);
            high = middle;
            enough = x->shortest;
        } else if (is_beyond(x) && s->pieces.end >= middle && step_to_query(x, before)) {
            if (x->out->status != OVOID_IMPACT_HIT) return 0;
            low = middle;
        } else if (x->out->status == OVOID_IMPACT_HIT || !is_beyond(x)) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return 1;
}

// Queries ahead from where the steps became short. 1 at the end of the search.
static int search_ahead(advance *x) {
    sweep *s = &x->s;
    query_here(x);
    if (is_within(x)) {
        take_hit(x);
        return 1;
    }
    vec3 before = get_normal(s);
    double ahead = guess_ahead(x), coarse = 0.5 * x->shortest;
    x->finest = 16 * ahead;
    // An overlap as deep as the tolerance allows is proven at once.
    if (coarse > ahead && s->time + coarse < s->end) {
        sweep_query(s, s->time + coarse);
        if (is_within(x)) {
            take_hit(x);
            return 1;
        }
        if (is_beyond(x) && step_to_query(x, before)) return 0;
    }
    for (int round = 0; round < QUERIES_MAX && s->used < s->most; round++, ahead *= 4) {
        double time = min2(s->time + ahead, s->end);
        if (!(time > s->time)) return 1;
        sweep_query(s, time);
        if (is_within(x)) {
            take_hit(x);
            return bisect(x, before, time);
        }
        if (is_beyond(x) && time <= s->pieces.end && step_to_query(x, before)) return 0;
        if (is_beyond(x) && round == 0 && !bisect(x, before, time)) return 0;
        if (x->out->status == OVOID_IMPACT_HIT || time >= s->end) return 1;
    }
    return 1;
}

static void run(advance *x) {
    sweep *s = &x->s;
    ovoid_impact *out = x->out;
    for (;;) {
        query_here(x);
        if (is_within(x)) {
            take_hit(x);
            return;
        }
        if (s->time >= s->end) {
            if (s->count || is_beyond(x)) out->status = OVOID_IMPACT_FREE;
            return;
        }
        if (s->used >= s->most) {
            out->limit = OVOID_LIMIT_ITERATIONS;
            return;
        }
        // The way left to the margin is not worth a step.
        double before = s->time;
        int is_near = sweep_get_upper(s) - x->margin < 0.25 * x->shortest * s->fall;
        if (!is_near && sweep_step(s, get_normal(s), x->margin) &&
            (s->time - before > x->shortest || s->time >= s->end))
            continue;
        if (search_ahead(x)) return;
    }
}

static void finish(advance *x) {
    sweep *s = &x->s;
    ovoid_impact *out = x->out;
    if (out->status == OVOID_IMPACT_UNDECIDED) out->hit = s->answer;
    if (x->free_at != s->time) query_here(x);
    out->iterations = s->used;
    out->begin = s->begin;
    out->end = s->end;
    out->free_until = s->time;
    out->step_count = s->count;
    if (out->status == OVOID_IMPACT_FREE || out->limit != OVOID_LIMIT_NONE) return;
    double wide = out->status == OVOID_IMPACT_HIT ? out->hit_at - s->time : INFINITY;
    if (wide <= s->tolerance * (s->end - s->begin) || wide <= x->finest) return;
    // At the end of the free times the bracket of the distance holds the margin: is it the allowances' width?
    int is_allowed = 2 * s->allowance > out->free.upper - out->free.lower;
    out->limit = s->used >= s->most ? OVOID_LIMIT_ITERATIONS
                 : is_allowed       ? OVOID_LIMIT_ALLOWANCE
                                    : OVOID_LIMIT_PRECISION;
}

void impact_find(moving_shapes shapes, double margin, const ovoid_motion_options *options, double tolerance,
                 ovoid_impact *out) {
    OVOID_ASSERT(shapes.a && shapes.b);
    *out = (ovoid_impact){.hit_at = INFINITY};
    advance x = {.margin = margin, .out = out};
    out->limit = sweep_make(&x.s, shapes, options, tolerance);
    if (out->limit == OVOID_LIMIT_NONE && !(margin >= 0 && margin < INFINITY)) out->limit = OVOID_LIMIT_OPTIONS;
    if (out->limit != OVOID_LIMIT_NONE) {
        out->free = out->hit = answer_make_refused(out->limit);
        return;
    }
    x.shortest = 0.5 * x.s.tolerance * (x.s.end - x.s.begin);
    run(&x);
    finish(&x);
}

static ovoid_impact find(const ovoid_moving_shape *a, const ovoid_moving_shape *b, double margin,
                         const ovoid_motion_options *options) {
    ovoid_impact out;
    impact_find((moving_shapes){a, b}, margin, options, 1e-9, &out);
    return out;
}

ovoid_impact ovoid_impact_find(const ovoid_moving_shape *a, const ovoid_moving_shape *b, double margin,
                               const ovoid_motion_options *options) {
    ENVIRONMENT_RETURN(ovoid_impact, margin, find(a, b, margin, options));
}

const char *ovoid_impact_status_get_name(ovoid_impact_status status) {
    switch (status) {
    case OVOID_IMPACT_UNDECIDED: return "undecided";
    case OVOID_IMPACT_FREE: return "free";
    case OVOID_IMPACT_HIT: return "hit";
    }
    return "unknown";
}
