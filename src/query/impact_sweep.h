// The state of a query about two moving bodies: the time until which they are proven to stay farther apart than a
// level, and the steps that prove it. docs/motion.md has the method.
#ifndef OVOID_QUERY_IMPACT_SWEEP_H
#define OVOID_QUERY_IMPACT_SWEEP_H

#include "query/motion_gap.h"

typedef struct sweep {
    const ovoid_moving *a, *b;
    const ovoid_options *query;
    motion_pair pieces; ///< at `time`
    double begin, end, time;
    double least; ///< the least gap of all steps so far
    double tolerance;
    // The last query.
    double asked;        ///< its time
    ovoid_answer answer; ///< for computed poses
    double shift;        ///< what these may be off by
    double fall;         ///< by how much the gap along the answer's normal falls a unit of time; a guess
    double error;        ///< of a gap at that time
    uint32_t used, most; ///< queries
    // The proof, in the caller's memory.
    ovoid_step *steps;
    size_t capacity, count;
} sweep;

/// From the options; OVOID_LIMIT_NONE, or why the query is refused. tolerance: what options->tolerance is if 0.
ovoid_limit sweep_make(sweep *s, const ovoid_moving *a, const ovoid_moving *b, const ovoid_motion_options *options,
                       double tolerance);

/// The distance at a time not before the present pieces' begin, started from the last one's proof.
void sweep_ask(sweep *s, double time);

/// The bounds of the last answer, for the exact motion.
static inline double sweep_get_lower(const sweep *s) { return s->answer.lower - s->shift; }
static inline double sweep_get_upper(const sweep *s) { return s->answer.upper + s->shift; }

/// A step along n from `time` to `until`, if it is proven that the gap stays above the level; 1 if it was made.
int sweep_step_to(sweep *s, double until, vec3 n, double level);

/// The longest step along n that is found, in the present pieces; 0 if there is none.
int sweep_step(sweep *s, vec3 n, double level);

/// 1 if the gap along n is proven to stay above the level from one time to another of the same pieces; the least gap.
int motion_pair_is_above(const motion_pair *pieces, const ovoid_step *step, double from, double level, double *least);

#endif
