// How far apart are the bodies? The bracket narrowed to the tolerance; an overlap is proven, not measured.
#include "query/answer.h"

ovoid_answer ovoid_distance(const ovoid_pair *pair, const ovoid_options *options, const ovoid_proof *earlier) {
    question ask = {
        .far = options && options->cap != 0 ? options->cap : INFINITY, .near = -INFINITY, .wants_bracket = 1};
    return answer_find(pair, options, ask, earlier, NULL);
}
