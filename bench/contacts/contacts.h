// bench --contacts: contact points of pairs at rest and in random poses, of ovoid and its peers.
#ifndef OVOID_BENCH_CONTACTS_H
#define OVOID_BENCH_CONTACTS_H

#include "peers/contact_peer.h"

/// What is measured.
typedef struct contacts_plan {
    const char *only;           ///< a part of the workloads' names, or NULL
    const char *const *modules; ///< of peers
    uint32_t module_count;
    uint32_t pairs, rounds;
    int alone; ///< without the peers built beside it
} contacts_plan;

/// Prints the table. 0: a module could not be loaded, or memory ran out.
int contacts_run(const contacts_plan *plan);

/// Ovoid as a contestant: its tolerance is that of the work.
extern const contact_peer contacts_ours;
/// Of the last run in warm frames: how many contacts were kept without a search.
double contacts_get_kept(const void *state);

#endif
