// The list of workloads, and visiting them.
#ifndef OVOID_BENCH_PAIRS_PLAN_H
#define OVOID_BENCH_PAIRS_PLAN_H

#include "common/work.h"

enum { SIZES_MOST = 16 };

typedef struct plan {
    uint32_t sizes[SIZES_MOST]; ///< vertices of the random hulls
    uint32_t size_count;
    uint32_t count;   ///< bodies, and so pairs, of each still workload
    const char *only; ///< workloads whose name holds this; NULL: all
    const char *data; ///< the folder with pieces/game_hulls.bin; NULL: none
    int smoke;        ///< a small number of everything
} plan;

/// A function called with each workload. 0: stop, it failed.
typedef int (*visitor)(void *context, const workload *work);

/// 0 if a visitor failed or memory is out.
int plan_visit(const plan *what, visitor call, void *context);

#endif
