// Do the bodies touch? The sign of d, and nothing more.
#include "query/answer.h"

ovoid_answer ovoid_collide(const ovoid_pair *pair, const ovoid_options *options, const ovoid_proof *earlier) {
    return answer_find(pair, &(query_request){.options = options, .goal = &query_goal_collide, .earlier = earlier});
}
