// Sets of pairs that touch or are near: their truth, and the faults of an answer.
#ifndef OVOID_BENCH_MANY_MEETINGS_H
#define OVOID_BENCH_MANY_MEETINGS_H

#include "many/swarm.h"

/// Sorts by a, then b.
void meetings_sort(meetings *all);

/// The faults of a list, compared with the truth.
typedef struct meeting_faults {
    size_t missing, extra, off; ///< off: a distance that is wrong
} meeting_faults;

/// The truth: pairs that are proven to meet, and those left open. Both sorted.
typedef struct meeting_truth {
    meetings sure, open;
    size_t boxes;    ///< pairs whose boxes overlap, of a swarm
    size_t unproven; ///< answers whose proof was refused; they count as open
} meeting_truth;

void meeting_truth_destroy(meeting_truth *truth);

/// The truth of a frame: all pairs whose boxes overlap, by a sweep of sorted boxes that shares nothing with any
/// contestant, each decided by ovoid_collide with its proof verified by ovoid_answer_verify. 0 if memory runs out.
int swarm_compute_truth(const swarm *what, const ovoid_pose *poses, meeting_truth *truth);

/// The truth of a state: every pair within the margin (0: that touches) with its distance, by trying all pairs;
/// overlapping ones have distance 0. Each proof is verified by ovoid_answer_verify. find_one: stops at the first that
/// is certain to touch.
int cell_compute_truth(const workcell *what, const ovoid_pose *links, double margin, int find_one,
                       meeting_truth *truth);

/// list is sorted. distance_error: the share of the margin by which distances may be off; negative: they are not
/// judged.
meeting_faults meetings_judge(meetings *list, const meeting_truth *truth, double distance_error);

#endif
