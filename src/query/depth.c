// The signed distance: how far apart, or how deep.
#include "query/answer.h"

ovoid_answer ovoid_depth(const ovoid_pair *pair, const ovoid_options *options, const ovoid_proof *earlier,
                         ovoid_cover *cover) {
    const query_goal goal = query_goal_make_depth(options);
    return answer_find(pair, &(query_request){options, &goal, earlier, cover});
}
