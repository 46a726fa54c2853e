// Timing: all contestants in turn, repeatedly, so that a disturbance of the machine affects them alike.
#ifndef OVOID_BENCH_COMMON_MEASURE_H
#define OVOID_BENCH_COMMON_MEASURE_H

#include "common/judge.h"

/// Statistics of the repetitions, nanoseconds per query. median 0: not measured.
typedef struct timing {
    double median, low, high, least, mean; ///< low, high: the quartiles
} timing;

/// A contestant in a cell.
typedef struct entrant {
    const peer *who;
    int warm;
    void *self; ///< NULL: does not take part
    timing time;
    faults wrong;
} entrant;

enum { ENTRANTS_MOST = 32, REPETITIONS_MOST = 101 };

/// Wall time, and the processor time of this thread: on a shared machine only the latter can be compared.
double get_seconds(void);
double get_own_seconds(void);

/// The median and quartiles of the samples, which are sorted.
timing timing_make(double *samples, uint32_t count);

/// How long to repeat: each entrant at least `least` times, then as long as its share of the seconds lasts, at most
/// REPETITIONS_MOST times.
typedef struct effort {
    double seconds;
    uint32_t least;
} effort;

/// Times every entrant that answers the question, and counts its faults. answers: room for a pair's answer each.
void measure(entrant *entrants, uint32_t count, const workload *work, question what, const truth *truths,
             found *answers, effort much);

#endif
