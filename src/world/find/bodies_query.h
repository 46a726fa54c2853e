// The query of two bodies without a warm start, for queries between steps.
#ifndef OVOID_WORLD_FIND_BODIES_QUERY_H
#define OVOID_WORLD_FIND_BODIES_QUERY_H

#include "body/body_find.h"

/// Two shapes are queried directly, without a compound's traversal.
static inline void bodies_query(const ovoid_body_pair *pair, const ovoid_options *options, const query_goal *goal,
                                ovoid_body_answer *out) {
    const ovoid_body *a = &pair->a, *b = &pair->b;
    if (a->shape && b->shape) {
        ovoid_pair two = {a->shape, b->shape, a->pose, b->pose};
        ovoid_answer answer;
        answer_find_internal(&two, &(query_request){.options = options, .goal = goal}, &answer);
        *out = ovoid_body_answer_make(&answer, 0, 0);
        out->tested = 1;
        return;
    }
    body_find_internal(pair, &(body_request){options, goal, NULL, NULL}, out);
}

#endif
