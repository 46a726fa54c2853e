// Which stage decides how many pairs, at what cost.
#ifndef OVOID_BENCH_PAIRS_STAGES_H
#define OVOID_BENCH_PAIRS_STAGES_H

#include "pairs/plan.h"

/// Prints it for every workload of the plan; 0 if memory runs out.
int stages_run(const plan *what);

#endif
