// Options with their defaults, and brackets that allowances leave open.
#include "query/goal.h"

#include "base/error.h"

const query_goal query_goal_collide = {.far = 0, .near = -INFINITY, .beyond = OVOID_LIMIT_ANSWERED};
const query_goal query_goal_within = {.wants_bracket = 1, .beyond = OVOID_LIMIT_ANSWERED};
const query_goal query_goal_distance = {
    .far = INFINITY, .near = -INFINITY, .wants_bracket = 1, .beyond = OVOID_LIMIT_CAP};

ovoid_code options_validate(const ovoid_options *given, ovoid_options *options, ovoid_error *error) {
    if (options_make(given, options)) return OVOID_OK;
    return error_set(error, OVOID_ERROR_ARGUMENT, -1, "options: a tolerance or the cap is NaN or negative");
}

int bracket_is_left_open(const final_bracket *b, const query_goal *goal) {
    if (!(b->allowance > 0)) return 0;
    if (b->status == OVOID_UNDECIDED)
        return query_goal_is_hopeless(
            &(query_goal){.tolerance = b->tolerance, .allowance = b->allowance, .wants_bracket = goal->wants_bracket},
            b->lower, b->upper);
    return b->lower <= goal->near && b->upper > goal->near && b->upper - b->lower <= b->tolerance;
}
