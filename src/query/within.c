// Are the bodies within a margin of each other?
#include "base/environment.h"
#include "query/answer.h"

ovoid_answer ovoid_within(const ovoid_pair *pair, double margin, const ovoid_options *options,
                          const ovoid_proof *earlier) {
    const query_goal goal = query_goal_make_within(margin);
    return answer_find(pair, options, &goal, earlier, NULL);
}

static int is_within(const ovoid_answer *answer, double margin) {
    return answer->upper <= margin ? 1 : answer->lower > margin ? 0 : -1;
}

int ovoid_answer_is_within(const ovoid_answer *answer, double margin) {
    ENVIRONMENT_RETURN(int, margin, is_within(answer, margin));
}
