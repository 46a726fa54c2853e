// Do the bodies touch? The sign of d, and nothing more.
#include "query/answer.h"

ovoid_answer ovoid_collide(const ovoid_pair *pair, const ovoid_options *options, const ovoid_proof *earlier) {
    const query_goal goal = query_goal_make_collide();
    return answer_find(pair, &(query_request){options, &goal, earlier, NULL, NULL});
}
