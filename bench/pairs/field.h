// The contestants: ovoid and the peers that could be loaded.
#ifndef OVOID_BENCH_PAIRS_FIELD_H
#define OVOID_BENCH_PAIRS_FIELD_H

#include "common/measure.h"

typedef struct field {
    const peer *members[ENTRANTS_MOST]; ///< ovoid first
    uint32_t count;
} field;

/// ovoid alone.
field field_make(void);
/// Adds the peers of a module; 0, with a line on stderr, if it cannot be loaded.
int field_load(field *all, const char *path);
/// Adds the modules that were built beside the program; prints a line for each that was not built, since its package is
/// absent.
void field_load_built(field *all);

enum { FIELD_OWN = 5 }; ///< ovoid's entrants: cold, warm, in batches

/// The entrants, ovoid's first; warm ones take part if there are frames. `self` is filled. Returns their number.
uint32_t field_enter(const field *all, const workload *work, entrant *entrants);
void field_leave(entrant *entrants, uint32_t count);

#endif
