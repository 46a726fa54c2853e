// Many bodies: time of a whole frame, broad phase and all pairs, and of a robot's state among its surroundings.
#ifndef OVOID_BENCH_MANY_MANY_H
#define OVOID_BENCH_MANY_MANY_H

#include "common/rows.h"
#include "peers/many_peer.h"

enum { CONTESTANTS_MOST = 12, COUNTS_MOST = 8 };

/// What to run: the numbers of bodies of swarms, their frames, the states and cycles of each robot.
typedef struct many_plan {
    uint32_t counts[COUNTS_MOST], count_of_counts;
    double seconds; ///< for the frames of each number of bodies, truth included
    uint32_t frames_least, frames_most;
    uint32_t states, cycles;
    const char *only; ///< "swarm", "threads", "planner", "monitor"; NULL: all
    const char *data; ///< the folder of test data
} many_plan;

/// ovoid and the peers that could be loaded.
typedef struct many_field {
    const swarm_peer *swarms[CONTESTANTS_MOST];
    const cell_peer *cells[CONTESTANTS_MOST];
    uint32_t swarm_count, cell_count;
} many_field;

/// The defaults, and those of a quick trial.
many_plan many_plan_make(void);
many_plan many_plan_make_smoke(void);

/// Frames of swarms of growing numbers, and ovoid's over threads. 0: it failed.
int many_run_swarms(rows *all, const many_field *field, const many_plan *plan);
/// Planner and monitor. 0: it failed.
int many_run_cells(rows *all, const many_field *field, const many_plan *plan);

/// Runs everything; tables on stdout, CSV and SVG if paths are given. alone: without peers. 0: it failed.
int many_run(const many_plan *plan, const char *csv, const char *svg, int alone);

#endif
