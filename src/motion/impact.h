// The time of impact, for callers inside the library.
#ifndef OVOID_MOTION_IMPACT_H
#define OVOID_MOTION_IMPACT_H

#include "motion/motion.h"

/// ovoid_impact_find for callers inside a public function. tolerance: of the time, where the options have none.
void impact_find(moving_shapes shapes, double margin, const ovoid_motion_options *options, double tolerance,
                 ovoid_impact *out);

/// What steps claim: from `begin` to `end` the gap is above the level.
typedef struct step_claim {
    double begin, end, level;
    const ovoid_step *steps;
    size_t count;
} step_claim;
/// OVOID_OK if the steps show it: each within one piece of both motions, the last reaching `end`.
ovoid_code impact_verify_steps(moving_shapes shapes, const step_claim *claim, ovoid_error *error);

/// What the answer for the computed poses at a time claims of the exact motion: its distance is in (above, most].
typedef struct answer_claim {
    double time;
    const ovoid_answer *answer;
    double above, most;
} answer_claim;
/// OVOID_OK if the answer's own proof shows it.
ovoid_code impact_verify_answer(moving_shapes shapes, const answer_claim *claim, ovoid_error *error);

/// OVOID_OK if a query would have taken these motions and times.
ovoid_code impact_verify_times(moving_shapes shapes, double begin, double end, ovoid_error *error);

/// What a record says of its query: the times, or why it is refused.
typedef struct query_claim {
    double margin;
    const ovoid_motion_options *options; ///< as asked; NULL: not known, then the record's own times and the defaults
    double begin, end;
    ovoid_limit limit;
    int is_empty; ///< 1: nothing is claimed of the bodies
} query_claim;
/// OVOID_OK if the query has these times, or is refused for this reason and nothing is claimed.
ovoid_code impact_verify_query(moving_shapes shapes, const query_claim *claim, ovoid_error *error);

/// 1 if an impact says that its query is refused; 1 if it claims nothing of the bodies.
int impact_is_refusal(const ovoid_impact *impact);
int impact_is_empty(const ovoid_impact *impact);
/// 1 if status, limit and times of an impact agree.
int impact_is_sound(const ovoid_impact *impact, double margin);

#endif
