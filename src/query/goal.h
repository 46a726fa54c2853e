// The goal and the options of a query, and why the bracket that it ends with is wide.
#ifndef OVOID_QUERY_GOAL_H
#define OVOID_QUERY_GOAL_H

#include "pair/search.h"

#include <string.h>

/// 1 if the options' numbers are valid; fills in the defaults. given NULL: all defaults.
static inline int options_make(const ovoid_options *given, ovoid_options *options) {
    *options = given ? *given : (ovoid_options){0, 0, 0, 0};
    if (!(options->absolute_tolerance >= 0 && options->relative_tolerance >= 0 && options->cap >= 0)) return 0;
    if (options->relative_tolerance == 0) options->relative_tolerance = 1e-9;
    if (options->cap == 0) options->cap = INFINITY;
    if (options->iterations == 0) options->iterations = 1000;
    return 1;
}

/// The width that a bracket may keep beside the bodies' allowances: the options' tolerance for bodies of that size, and
/// what underflow and far origins hide. The options are those that options_make filled in.
static inline double options_compute_tolerance(const ovoid_options *options, double size, double hidden) {
    return max2(options->absolute_tolerance, options->relative_tolerance * size) + 8 * hidden;
}

/// What a bracket says of the sign: the one definition of the four statuses, for queries and for checks of answers.
/// tolerance: that of options_compute_tolerance. The bodies' allowances widen brackets but not what "touching" means.
static inline ovoid_status bracket_find_status(double lower, double upper, double tolerance) {
    if (lower > 0) return OVOID_SEPARATED;
    if (upper < 0) return OVOID_OVERLAPPING;
    return upper - lower <= tolerance ? OVOID_TOUCHING : OVOID_UNDECIDED;
}

/// options_make for functions that return a code: ARGUMENT with a sentence where options are invalid.
ovoid_code options_validate(const ovoid_options *given, ovoid_options *options, ovoid_error *error);

/// The goals of the four queries. A query copies its goal, and would wait for members that have just been written one
/// by one: so a goal is one of these constants, or a copy of one with far and near set.
extern const query_goal query_goal_collide, query_goal_within, query_goal_distance;
static inline query_goal query_goal_make_collide(void) { return query_goal_collide; }
static inline query_goal query_goal_make_within(double margin) {
    query_goal goal = query_goal_within;
    goal.far = goal.near = margin;
    return goal;
}
/// Made in the caller's floating-point environment, by no arithmetic: there a subnormal cap might be compared as zero.
static inline query_goal query_goal_make_distance(const ovoid_options *options) {
    query_goal goal = query_goal_distance;
    uint64_t bits = 0;
    if (options) memcpy(&bits, &options->cap, sizeof bits);
    if (bits << 1) goal.far = options->cap;
    return goal;
}
static inline query_goal query_goal_make_depth(const ovoid_options *options) {
    query_goal goal = query_goal_make_distance(options);
    goal.wants_depth = 1;
    return goal;
}

/// How a bracket stands when its query ends.
typedef struct final_bracket {
    double lower, upper;
    double tolerance, allowance; ///< as in the goal of a query
    ovoid_status status;
    ovoid_proof_kind kind; ///< what the upper bound rests on
} final_bracket;

/// 1 if the bracket is as narrow as the tolerance. A common point shows no depth, unless the depth is within the
/// tolerance.
static inline int bracket_is_narrow(const final_bracket *b, const query_goal *goal) {
    int is_common = goal->wants_depth && b->kind == OVOID_PROOF_HULL && b->lower < -b->tolerance;
    return b->upper - b->lower <= b->tolerance && !is_common;
}

/// 1 if the sign, or the margin of the goal, is left open by the bodies' allowances: no search would find it.
int bracket_is_left_open(const final_bracket *b, const query_goal *goal);

/// 1 if a search ended for want of precision, memory or iterations.
static inline int limit_is_stuck(ovoid_limit limit) {
    return limit == OVOID_LIMIT_ITERATIONS || limit == OVOID_LIMIT_PRECISION || limit == OVOID_LIMIT_CAPACITY;
}

/// 1 if a search that began elsewhere might do better: it got stuck, or found no sign within the tolerance.
static inline int answer_is_improvable(const ovoid_answer *answer) {
    return limit_is_stuck(answer->limit) || answer->status == OVOID_TOUCHING;
}

/// Why a bracket that is not narrow is wide. trouble: what kept the search from narrowing it, or NONE.
static inline ovoid_limit bracket_find_limit(const final_bracket *b, const query_goal *goal, ovoid_limit trouble) {
    ovoid_limit wide = trouble != OVOID_LIMIT_NONE ? trouble : OVOID_LIMIT_PRECISION;
    if (b->status == OVOID_UNDECIDED) return wide;
    if (b->lower > goal->far) return goal->beyond;
    // A distance or a depth was the goal, and its bracket is wide.
    int is_wanted = goal->wants_bracket && (b->status == OVOID_SEPARATED || goal->wants_depth);
    return is_wanted && b->upper > goal->near ? wide : OVOID_LIMIT_ANSWERED;
}

#endif
