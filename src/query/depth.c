// The signed distance: how far apart, or how deep.
#include "query/answer.h"

ovoid_answer ovoid_depth(const ovoid_pair *pair, const ovoid_options *options, const ovoid_proof *earlier,
                         ovoid_cover *cover) {
    question ask = {.far = options && options->cap != 0 ? options->cap : INFINITY,
                    .near = -INFINITY,
                    .wants_depth = 1,
                    .wants_bracket = 1};
    return answer_find(pair, options, ask, earlier, cover);
}
