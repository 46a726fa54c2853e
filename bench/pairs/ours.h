// ovoid as a contestant.
#ifndef OVOID_BENCH_PAIRS_OURS_H
#define OVOID_BENCH_PAIRS_OURS_H

#include "common/work.h"

/// One query at a time; warm: with the proof of the last frame.
extern const peer ours;
/// Queries of shapes that were prepared at their poses; only verdicts if the query needs no more.
extern const peer ours_prepared;
/// All still pairs, or a frame of the moving ones, in one call; warm: with the proofs of the last frame.
extern const peer ours_in_batches;

/// ovoid's answer to the pair.
ovoid_answer ours_get_answer(const ovoid_pair *pair, question what, double margin, const ovoid_proof *earlier);

/// Queries once more, untimed, and verifies every answer by ovoid_answer_verify: returns the number that failed or left
/// the question open.
uint32_t ours_count_unproven(const workload *work, question what);

#endif
