// One pass of an entrant covers all pairs. The first pass of each warms caches and is judged, not timed.
#define _POSIX_C_SOURCE 200809L
#include "common/measure.h"

#include <stdlib.h>
#include <time.h>

static double read_clock(clockid_t which) {
    struct timespec now;
    (void)clock_gettime(which, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double get_seconds(void) { return read_clock(CLOCK_MONOTONIC); }
double get_own_seconds(void) { return read_clock(CLOCK_THREAD_CPUTIME_ID); }

static int compare_doubles(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

timing timing_make(double *samples, uint32_t count) {
    if (count == 0) return (timing){0};
    qsort(samples, count, sizeof *samples, compare_doubles);
    double sum = 0;
    for (uint32_t i = 0; i < count; i++) sum += samples[i];
    return (timing){samples[count / 2], samples[count / 4], samples[(3 * count) / 4], samples[0], sum / count};
}

/// One timed pass; nanoseconds per query.
static double time_pass(const entrant *e, const workload *work, question what, found *answers) {
    double start = get_own_seconds();
    e->who->run(e->self, what, e->warm, answers);
    return (get_own_seconds() - start) / work->pair_count * 1e9;
}

/// A number near a third of the count and without a common divisor with it: steps of that length visit all.
static uint32_t find_step(uint32_t count) {
    for (uint32_t step = count / 3 + 1;; step++) {
        uint32_t a = count, b = step;
        while (b) {
            uint32_t rest = a % b;
            a = b;
            b = rest;
        }
        if (a == 1) return step;
    }
}

void measure(entrant *entrants, uint32_t count, const workload *work, question what, const truth *truths,
             found *answers, effort much) {
    static double samples[ENTRANTS_MOST][REPETITIONS_MOST];
    double spent[ENTRANTS_MOST] = {0};
    uint32_t taken[ENTRANTS_MOST] = {0}, present = 0;
    for (uint32_t k = 0; k < count; k++) {
        entrants[k].time = (timing){0};
        entrants[k].wrong = (faults){0};
        if (!entrants[k].self) continue;
        entrants[k].who->run(entrants[k].self, what, entrants[k].warm, answers);
        entrants[k].wrong = faults_count(work, truths, what, answers);
        present++;
    }
    // A slow entrant stops earlier, so that it does not take the time of all. Entrants of one library are neighbours in
    // the list but not in time, so each finds the caches as another library left them.
    uint32_t step = find_step(count);
    for (uint32_t round = 0; round < REPETITIONS_MOST; round++)
        for (uint32_t j = 0; j < count; j++) {
            uint32_t k = (uint32_t)((uint64_t)j * step % count);
            if (!entrants[k].self || (round >= much.least && spent[k] * present > much.seconds)) continue;
            double sample = samples[k][taken[k]++] = time_pass(&entrants[k], work, what, answers);
            spent[k] += 1e-9 * sample * work->pair_count;
        }
    for (uint32_t k = 0; k < count; k++)
        if (entrants[k].self) entrants[k].time = timing_make(samples[k], taken[k]);
}
