// The summary of ovoid run, on stderr.
#ifndef OVOID_CLI_PAIRS_RUN_REPORT_H
#define OVOID_CLI_PAIRS_RUN_REPORT_H

#include "pairs/impacts.h"
#include "pairs/track.h"

/// A finished run.
typedef struct run_summary {
    const ovoid_scene *scene;
    const cli_track *track;
    size_t frames;
    const size_t *counts;       ///< 4: of the records of frames, by ovoid_status
    const cli_impacts *impacts; ///< NULL: only frames were queried
    double margin;              ///< negative: not given
    int measures;               ///< 1 if distances were queried, not a yes or no
} run_summary;

/// Writes the counts, the first contacts, the impacts and the smallest distance.
void run_report(const run_summary *summary, double seconds);

#endif
