// Couples of a batch, a lane group at a time through the first stages (simd/pair8.h); couples that these leave open go
// on alone from there. A couple's bits do not depend on the others.
#ifndef OVOID_QUERY_BATCH_SIMD_H
#define OVOID_QUERY_BATCH_SIMD_H

#include "query/answer.h"

#include <stddef.h>

/// Shapes lie in memory as the kernels read them, as rows of doubles; so do poses, which have nothing but numbers.
_Static_assert(sizeof(ovoid_pose) == 7 * sizeof(double) && offsetof(ovoid_shape, extent) == 8 &&
                   offsetof(ovoid_shape, center) == 16 && offsetof(ovoid_shape, reach) == 40 &&
                   offsetof(ovoid_shape, first) == 64 &&
                   offsetof(ovoid_shape, inner) == offsetof(ovoid_shape, outer) + 9 * sizeof(double) &&
                   sizeof(shape_inner) == 8 * sizeof(double),
               "the rows of src/simd/pair8.h");

/// Writes what the batch wants of the answer of couple i.
void batch_write(const ovoid_batch *batch, size_t i, const ovoid_answer *answer);

/// The query of couple i alone.
void batch_query_single(const ovoid_batch *batch, size_t i, const query_goal *goal);

/// All couples. The goal is no depth, and the options are valid; it is given their iterations.
void batch_run(const ovoid_batch *batch, query_goal *goal, const ovoid_options *options);

#endif
