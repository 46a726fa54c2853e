// How far apart are the bodies? The bracket narrowed to the tolerance; an overlap is proven, not measured.
#include "query/answer.h"

ovoid_answer ovoid_distance(const ovoid_pair *pair, const ovoid_options *options, const ovoid_proof *earlier) {
    if (!options) return answer_find(pair, &(query_request){.goal = &query_goal_distance, .earlier = earlier});
    const query_goal goal = query_goal_make_distance(options);
    return answer_find(pair, &(query_request){.options = options, .goal = &goal, .earlier = earlier});
}

double ovoid_answer_get_distance(const ovoid_answer *answer) {
    return answer->limit == OVOID_LIMIT_NONE || answer->limit == OVOID_LIMIT_ALLOWANCE ? answer->lower : NAN;
}
