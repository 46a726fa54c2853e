// A step of a world: the list of pairs is brought up to date, and each pair is answered from its cache or queried
// again. What is written of the answers differs between the calls that end a step (contacts.c, manifolds.c).
#ifndef OVOID_WORLD_STEP_H
#define OVOID_WORLD_STEP_H

#include "world/pair_update.h"

/// Pairs are decided and written in chunks of so many.
enum { CHUNK = 1024 };

static inline uint32_t step_get_chunk_size(const ovoid_world *w, uint32_t c) {
    size_t rest = w->pair_count - (size_t)c * CHUNK;
    return rest < CHUNK ? (uint32_t)rest : CHUNK;
}

/// OVOID_OK, or what is wrong with a query of all pairs.
ovoid_code step_validate(const ovoid_contact_query *query, ovoid_error *error);

/// The code MEMORY, with the sentence for a step.
ovoid_code step_refuse_memory(ovoid_error *error);

/// Makes a valid query that of the world; wants_manifolds: its pairs get manifolds too.
void step_take_query(ovoid_world *w, const ovoid_contact_query *query, int wants_manifolds);

/// Updates tree and pairs, with room for all chunks. 0: memory ran out, and nothing is lost.
int step_begin(ovoid_world *w, uint32_t *chunks, ovoid_contacts *counts);

/// The pairs that are answered without a query, as bits, of up to PAIR8 that follow each other in the list. Mostly
/// their entries there suffice; no geometry is read.
unsigned step_find_answered(ovoid_world *w, world_pair *pairs, uint32_t count);

/// Prefetches the bodies and the cached proof of a pair.
void step_prefetch_bodies(const ovoid_world *w, const world_pair *p);

/// Bodies, cached proofs and shapes of the pairs to come are prefetched; call it before the pair at items[i] of count.
void step_prefetch(const ovoid_world *w, const world_pair *pairs, const uint16_t *items, uint32_t i, uint32_t count);

/// The step is done: marks are cleared, and the counts are completed.
void step_end(ovoid_world *w, ovoid_contacts *counts);

#endif
