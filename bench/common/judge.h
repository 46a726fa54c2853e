// The truth about each pair, and the faults of a contestant.
#ifndef OVOID_BENCH_COMMON_JUDGE_H
#define OVOID_BENCH_COMMON_JUDGE_H

#include "common/work.h"

/// Proven bounds of the signed distance.
typedef struct truth {
    double lower, upper;
} truth;

/// Proven by ovoid_depth, each proof checked. *open: how many brackets are wider than 1e-7 of the size because a limit
/// ended the search; with those only signs are judged. NULL if memory runs out.
truth *truths_create(const workload *work, uint32_t *open);

/// Wrong answers. Touching pairs (0 or the margin inside the bracket) are not judged.
typedef struct faults {
    uint32_t asked;
    uint32_t none;     ///< no answer
    uint32_t sign;     ///< yes for no, or no for yes
    uint32_t off;      ///< distance off by more than 1e-4 of itself, depth by more than 1e-3 of itself
    uint32_t off_fine; ///< off by more than 1e-6 of itself
    uint32_t points; ///< distance: a point off its body, or not that distance apart, by 1e-4 of the size; depth: moving
                     ///< along the normal by the true depth, and 1e-3 more, leaves more than that of overlap
} faults;

faults faults_count(const workload *work, const truth *truths, question what, const found *answers);

/// The number of wrong answers: none, sign, off.
static inline uint32_t faults_get_wrong(const faults *f) { return f->none + f->sign + f->off; }

#endif
