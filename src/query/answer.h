// From the state of a search to the answer, and the pipeline that all queries share.
#ifndef OVOID_QUERY_ANSWER_H
#define OVOID_QUERY_ANSWER_H

#include "query/search.h"

/// The answer.
void answer_write(search *s, ovoid_answer *out);

/// The answer of a query that was refused: no bracket.
ovoid_answer answer_make_refused(ovoid_limit limit);

/// The whole pipeline for one question; cover may be NULL.
ovoid_answer answer_find(const ovoid_pair *pair, const ovoid_options *given, question ask, const ovoid_proof *earlier,
                         ovoid_cover *cover);

#endif
