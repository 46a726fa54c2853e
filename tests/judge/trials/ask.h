// The trials' court: every query of a pair, each answer put before the exact judge (GMP) and before
// ovoid_answer_verify, counted by family; and compared with the truth where the pair is one of which it is known.
#ifndef OVOID_TRIALS_ASK_H
#define OVOID_TRIALS_ASK_H

#include "judge.h"
#include "ovoid/ovoid.h"

/// Counts of one family of pairs.
typedef struct tally {
    const char *name;
    int may_be_undecided; ///< documented: near the limit of doubles the sign stays open
    uint64_t pairs, answers, separated, touching, overlapping, undecided, wide, compared, wrong;
    uint64_t iterations; ///< the largest
    uint64_t opened;     ///< the seed of the first pair whose sign stayed open
    double widest;       ///< of distance and depth, in parts of the pair's size
} tally;

/// The judge of all trials; created and destroyed by the program. One thread.
extern judge *trial_judge;
/// Failures are appended to this file at once; NULL: none.
extern const char *trial_failures;

/// Which proof a warm query is given: any of several kinds, or always the one handed in.
typedef enum warm_choice { WARM_ANY, WARM_GIVEN } warm_choice;

/// What is known about a pair before its queries.
typedef struct trial_hints {
    const ovoid_proof *earlier; ///< a proof of another pose or of another pair, or NULL
    warm_choice warm;
    const judge_truth *truth; ///< NULL: not known. Every bracket must hold it, every status agree with it
} trial_hints;

/// A failure, with all that is needed to see it again; the pair in full for the first few.
void trial_fail(tally *t, const ovoid_pair *pair, const ovoid_answer *x, const char *query, const char *why);

/// All queries of a pair, cold and warm. Returns the depth's proof.
ovoid_proof trial_ask(tally *t, const ovoid_pair *pair, const trial_hints *hints, uint64_t *state);

/// A query that must decide the sign; one that was asked for the bracket to 1e-9 of the size.
void trial_count_sign(tally *t, const ovoid_pair *pair, const ovoid_answer *x, const char *query);
void trial_count_width(tally *t, const ovoid_pair *pair, const ovoid_answer *x);

/// The pair's size: both extents about the body frames, the distance of the frames and the radii.
double pair_size(const ovoid_pair *pair);
/// The least that a bracket can be asked to be narrower than: what far origins, far positions and underflow leave.
double pair_unresolved(const ovoid_pair *pair);

void tally_print_header(void);
void tally_print(const tally *t);
void tally_add(tally *sum, const tally *more);

double seconds_now(void);

#endif
