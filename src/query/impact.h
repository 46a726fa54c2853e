// The time of impact, for those who ask for it inside the library.
#ifndef OVOID_QUERY_IMPACT_H
#define OVOID_QUERY_IMPACT_H

#include "ovoid/motion.h"

/// ovoid_impact_find inside a public function. tolerance: that of the time where the options name none.
void impact_find(const ovoid_moving *a, const ovoid_moving *b, double margin, const ovoid_motion_options *options,
                 double tolerance, ovoid_impact *out);

/// Of ovoid_impact_check: that the steps go on from begin in pieces of both motions to `end` at least, all of them
/// above the level; and that the answer's own proof holds for the computed poses at a time, and leaves the exact
/// motion's distance above `least` and at most `most`.
ovoid_code impact_check_steps(const ovoid_moving *a, const ovoid_moving *b, double begin, double end, double level,
                              const ovoid_step *steps, size_t count, ovoid_error *error);
ovoid_code impact_check_answer(const ovoid_moving *a, const ovoid_moving *b, double time, const ovoid_answer *answer,
                               double least, double most, ovoid_error *error);
/// That motions and times are what a query would have taken.
ovoid_code impact_check_times(const ovoid_moving *a, const ovoid_moving *b, double begin, double end,
                              ovoid_error *error);
/// Whether the status and the times say the same.
int impact_is_sound(const ovoid_impact *x, double margin);

#endif
