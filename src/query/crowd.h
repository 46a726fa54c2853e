// Couples of a batch, eight at a time through the first stages (simd/octet.h); what those leave open goes on alone,
// from where they left it. The bits are those of the single query.
#ifndef OVOID_QUERY_CROWD_H
#define OVOID_QUERY_CROWD_H

#include "query/answer.h"

/// Writes what the batch wants of couple i: of its answer x.
void crowd_write(const ovoid_batch *batch, size_t i, const ovoid_answer *x);

/// The query of couple i alone.
void crowd_ask_single(const ovoid_batch *batch, size_t i, question ask);

/// All couples. The question is no depth, the options have made sense.
void crowd_run(const ovoid_batch *batch, question ask, const ovoid_options *options);

#endif
