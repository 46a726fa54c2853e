// The query of one pair of a world, its cache, and how long a cached answer holds.
#ifndef OVOID_WORLD_PAIR_UPDATE_H
#define OVOID_WORLD_PAIR_UPDATE_H

#include "ovoid/body.h"
#include "world/state.h"

/// The query of two bodies of the world at the present poses, with the cached proof as warm start (NULL: without).
void pair_query(const ovoid_world *w, ovoid_couple pair, const pair_cache *cache, ovoid_exclusions *exclusions,
                ovoid_body_answer *out);

/// Sets how long the cached answer holds for the world's query: kind, v, c and CONTACT.
void pair_set_age(const ovoid_world *w, world_pair *p, const pair_cache *cache);

/// Answers the pair by a query, caches the answer and sets its age. cover: of a pair asked anew whose search for a
/// depth filled its own memory; else NULL, and FULL is set where it does.
void pair_update_with(ovoid_world *w, world_pair *p, ovoid_cover *cover);

/// Answers the pair from its revalidated proof or by a query (pair_update_with).
void pair_update(ovoid_world *w, world_pair *p);

/// Caches what an answer says without its proof.
static inline void pair_cache_verdict(pair_cache *cache, const ovoid_verdict *verdict) {
    cache->lower = verdict->lower;
    cache->upper = verdict->upper;
    cache->status = (uint8_t)verdict->status;
    cache->stage = (uint8_t)verdict->stage;
    cache->limit = (uint8_t)verdict->limit;
    cache->iterations = verdict->iterations;
}

/// Notes that the cached bounds are those at the present poses, and sets their age.
void pair_renew(const ovoid_world *w, world_pair *p, pair_cache *cache);

/// The most by which the signed distance can have changed since the cached answer, rounding included.
double pair_compute_age(const ovoid_world *w, const world_pair *p, const pair_cache *cache);

/// Measures the cached proof at the present poses: 1 if it still answers; the bounds of cache are then the present
/// ones.
int pair_revalidate(const ovoid_world *w, const world_pair *p, pair_cache *cache);

/// Asks pairs[items[0]], ... in single precision, where a yes or no is wanted: the items of those that still have no
/// answer are moved to the front; their number.
uint32_t pairs_ask_floats(ovoid_world *w, world_pair *pairs, uint16_t *items, uint32_t count);

/// pair_revalidate for pairs[items[0]], ...: the items of those that still have no answer are moved to the front; their
/// number. Cached proofs are measured eight at a time.
uint32_t pairs_revalidate(ovoid_world *w, world_pair *pairs, uint16_t *items, uint32_t count);

/// The contact of a pair, with bounds adjusted for the motion.
ovoid_contact pair_make_contact(const ovoid_world *w, const world_pair *p);

#endif
