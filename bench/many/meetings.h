// Sets of pairs that touch or are near: their truth, and what an answer has wrong.
#ifndef OVOID_BENCH_MANY_MEETINGS_H
#define OVOID_BENCH_MANY_MEETINGS_H

#include "many/swarm.h"

/// Sorts by a, then b.
void meetings_sort(meetings *all);

/// Of a list of answers beside the truth.
typedef struct meeting_faults {
    size_t missing, extra, off; ///< off: a distance that is wrong
} meeting_faults;

/// The truth: pairs that are proven to meet, and those of which that is open. Both sorted.
typedef struct meeting_truth {
    meetings sure, open;
    size_t boxes;    ///< pairs whose boxes overlap, of a swarm
    size_t unproven; ///< answers whose proof did not pass; they are open
} meeting_truth;

void meeting_truth_destroy(meeting_truth *truth);

/// Of a frame: all pairs whose boxes overlap, by a sweep of sorted boxes that shares nothing with any contestant, each
/// decided by ovoid_collide and its proof put before ovoid_answer_verify. 0 if memory runs out.
int swarm_compute_truth(const swarm *what, const ovoid_pose *poses, meeting_truth *truth);

/// Of a state: every pair within the margin (0: that touch) with its distance, by trying all pairs; overlapping ones
/// have distance 0. Each proof is put before ovoid_answer_verify. find_one: stops at the first that is sure to touch.
int cell_compute_truth(const workcell *what, const ovoid_pose *links, double margin, int find_one,
                       meeting_truth *truth);

/// list is sorted. distance_error: distances may be off by so much of the margin; negative: they are not looked at.
meeting_faults meetings_judge(meetings *list, const meeting_truth *truth, double distance_error);

#endif
