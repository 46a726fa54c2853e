// Options with their defaults, and the limit that ended a query.
#include "query/goal.h"

#include "base/error.h"

ovoid_code options_validate(const ovoid_options *given, ovoid_options *options, ovoid_error *error) {
    if (options_make(given, options)) return OVOID_OK;
    return error_set(error, OVOID_ERROR_ARGUMENT, -1, "options: a tolerance or the cap is NaN or negative");
}

int bracket_is_narrow(const final_bracket *b, const query_goal *goal) {
    int is_common = goal->wants_depth && b->kind == OVOID_PROOF_HULL && b->lower < -b->tolerance;
    return b->upper - b->lower <= b->tolerance && !is_common;
}

int bracket_is_left_open(const final_bracket *b, const query_goal *goal) {
    if (!(b->allowance > 0)) return 0;
    if (b->status == OVOID_UNDECIDED)
        return query_goal_is_hopeless(
            &(query_goal){.tolerance = b->tolerance, .allowance = b->allowance, .wants_bracket = goal->wants_bracket},
            b->lower, b->upper);
    return b->lower <= goal->near && b->upper > goal->near && b->upper - b->lower <= b->tolerance;
}

ovoid_limit bracket_find_limit(const final_bracket *b, const query_goal *goal, ovoid_limit trouble) {
    ovoid_limit wide = trouble != OVOID_LIMIT_NONE ? trouble : OVOID_LIMIT_PRECISION;
    if (b->status == OVOID_UNDECIDED) return wide;
    if (b->lower > goal->far) return goal->beyond;
    // A distance or a depth was the goal, and its bracket is wide.
    int is_wanted = goal->wants_bracket && (b->status == OVOID_SEPARATED || goal->wants_depth);
    return is_wanted && b->upper > goal->near ? wide : OVOID_LIMIT_ANSWERED;
}
