// Before anything else of two bodies is looked at: are the balls around them farther apart than was asked?
#ifndef OVOID_COMPOUND_FIRST_LOOK_H
#define OVOID_COMPOUND_FIRST_LOOK_H

#include "body/body_view.h"

/// The whole answer, and the exclusion of all pairs of parts, where they are: 1. The options are made.
int first_look(const body_view *a, const body_view *b, const ovoid_options *options, const query_goal *goal,
               ovoid_exclusions *exclusions, ovoid_body_answer *out);

#endif
