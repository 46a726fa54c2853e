// bench --setup: what it costs to make a shape, and to read its file, beside the hulls of Qhull and of peers.
#ifndef OVOID_BENCH_SETUP_H
#define OVOID_BENCH_SETUP_H

#include <stdint.h>

/// What is measured.
typedef struct setup_plan {
    const uint32_t *sizes; ///< numbers of points
    uint32_t size_count;
    const char *const *modules; ///< of peers
    uint32_t module_count;
    int alone; ///< without the peers built beside it
    int smoke; ///< the first two sizes, few bodies
} setup_plan;

/// Prints the table; writes it where csv and svg are not NULL. 0: a module could not be loaded, a shape was refused, or
/// memory ran out.
int setup_run(const setup_plan *plan, const char *csv, const char *svg);

#endif
