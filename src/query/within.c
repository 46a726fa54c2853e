// Are the bodies within a margin of each other?
#include "query/answer.h"

#include "ovoid/prepared.h"

#include <string.h>

ovoid_answer ovoid_within(const ovoid_pair *pair, double margin, const ovoid_options *options,
                          const ovoid_proof *earlier) {
    const query_goal goal = query_goal_make_within(margin);
    return answer_find(pair, &(query_request){.options = options, .goal = &goal, .earlier = earlier});
}

// The order of doubles as that of integers, both zeros alike. It needs no floating-point environment, in which the
// caller may have subnormals compared as zero.
static int64_t get_order(double x) {
    int64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits >= 0 ? bits : INT64_MIN - bits;
}

static int is_within(double lower_bound, double upper_bound, double margin) {
    int64_t least = get_order(-INFINITY), most = get_order(INFINITY);
    int64_t at = get_order(margin), lower = get_order(lower_bound), upper = get_order(upper_bound);
    if (at < least || at > most || lower < least || lower > most || upper < least || upper > most) return -1;
    return upper <= at ? 1 : lower > at ? 0 : -1;
}

int ovoid_answer_is_within(const ovoid_answer *answer, double margin) {
    return is_within(answer->lower, answer->upper, margin);
}

int ovoid_verdict_is_within(const ovoid_verdict *verdict, double margin) {
    return is_within(verdict->lower, verdict->upper, margin);
}
