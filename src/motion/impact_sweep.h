// The state of a query about two moving bodies: the time until which they are proven to stay farther apart than a
// level, and the steps that prove it. docs/motion.md has the method.
#ifndef OVOID_MOTION_IMPACT_SWEEP_H
#define OVOID_MOTION_IMPACT_SWEEP_H

#include "motion/motion_gap.h"

typedef struct sweep {
    moving_shapes shapes;
    const ovoid_options *query;
    motion_pair pieces; ///< at `time`
    double begin, end, time;
    double least; ///< the least proven gap of all steps so far
    double tolerance;
    double allowance; ///< the width that the shapes' allowances give every bracket
    // The last query.
    double queried_at;   ///< its time
    ovoid_answer answer; ///< for computed poses
    double shift;        ///< by how much the exact motion may differ from these poses, length
    double fall;         ///< how fast the gap along the answer's normal falls, per unit of time; a guess
    double error;        ///< of a gap at that time, length
    uint32_t used, most; ///< queries made; most queries
    // The proof, in the caller's memory.
    ovoid_step *steps;
    size_t capacity, count;
} sweep;

/// The sweep of a query; OVOID_LIMIT_NONE, or why the query is refused. options may be NULL. tolerance: the default of
/// options->tolerance.
ovoid_limit sweep_make(sweep *s, moving_shapes shapes, const ovoid_motion_options *options, double tolerance);

/// The pair's size at the first time, by which the tolerance of an approach is measured.
double sweep_find_size(const sweep *s);

/// The tolerance of approaches where the options have none.
#define APPROACH_TOLERANCE 1e-6

/// The distance at a time not before the begin of the present pieces, warm from the last proof.
void sweep_query(sweep *s, double time);

/// The bounds of the last answer, widened to hold for the exact motion.
static inline double sweep_get_lower(const sweep *s) { return s->answer.lower - s->shift; }
static inline double sweep_get_upper(const sweep *s) { return s->answer.upper + s->shift; }

/// Steps along n from `time` to `until` if the gap is proven to stay above the level; 1 if the step was made.
int sweep_step_to(sweep *s, double until, vec3 n, double level);

/// Makes the longest step along n that it finds within the present pieces; 0 if there is none.
int sweep_step(sweep *s, vec3 n, double level);

/// 1 if the gap along the step's normal is proven to stay above the level from `from` to the step's end, in the same
/// pieces. *least: the least gap that is proven.
int motion_pair_is_above(const motion_pair *pieces, const ovoid_step *step, double from, double level, double *least);

#endif
