// ovoid as a contestant.
#ifndef OVOID_BENCH_PAIRS_OURS_H
#define OVOID_BENCH_PAIRS_OURS_H

#include "common/work.h"

/// One query at a time; warm: with the proof of the last frame.
extern const peer ours;
/// Of shapes that were prepared at their poses; verdicts alone where they are all that is asked for.
extern const peer ours_prepared;
/// All still pairs, or a frame of the moving ones, in one call; warm: with the proofs of the last frame.
extern const peer ours_in_batches;

/// ovoid's answer to the pair.
ovoid_answer ours_get_answer(const ovoid_pair *pair, question what, double margin, const ovoid_proof *earlier);

/// Asks once more, untimed, and puts every answer before ovoid_answer_verify: the number that failed it or left the
/// question open.
uint32_t ours_count_unproven(const workload *work, question what);

#endif
