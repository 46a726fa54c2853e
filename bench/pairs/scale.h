// Cost as the work grows.
#ifndef OVOID_BENCH_PAIRS_SCALE_H
#define OVOID_BENCH_PAIRS_SCALE_H

#include <stdint.h>

/// Prints tables over vertices, pairs and threads, and a shape's memory; writes them where csv and svg are not NULL. 0
/// if something failed.
int scale_run(const char *csv, const char *svg, uint32_t most_pairs, int smoke);

#endif
