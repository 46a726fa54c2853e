// The query of two bodies without a warm start, for queries between steps.
#ifndef OVOID_WORLD_BODIES_QUERY_H
#define OVOID_WORLD_BODIES_QUERY_H

#include "body/body_find.h"

/// Two shapes are queried directly, without a compound's traversal.
static inline void bodies_query(const ovoid_body *a, const ovoid_body *b, const ovoid_options *options, query_goal goal,
                                ovoid_body_answer *out) {
    if (a->shape && b->shape) {
        ovoid_pair two = {a->shape, b->shape, a->pose, b->pose};
        ovoid_answer answer;
        answer_find_internal(&two, options, goal, NULL, NULL, &answer);
        *out = ovoid_body_answer_make(&answer, 0, 0);
        out->tested = 1;
        return;
    }
    ovoid_body_pair pair = {*a, *b};
    body_find_internal(&pair, options, goal, NULL, NULL, out);
}

#endif
