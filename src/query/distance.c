// How far apart are the bodies? The bracket narrowed to the tolerance; an overlap is proven, not measured.
#include "query/answer.h"

ovoid_answer ovoid_distance(const ovoid_pair *pair, const ovoid_options *options, const ovoid_proof *earlier) {
    const question ask = question_make_distance(options);
    return answer_find(pair, options, &ask, earlier, NULL);
}
