// The couples of a batch whose bodies are small: searched by GJK in lanes (simd/gjk8.h), whose places are filled again
// as couples end.
#ifndef OVOID_QUERY_BATCH_SMALL_H
#define OVOID_QUERY_BATCH_SMALL_H

#include "query/answer.h"
#include "simd/gjk8.h"

enum { SMALL_POOL_GROUPS = 2, SMALL_POOL_PLACES = SMALL_POOL_GROUPS * PAIR8 };

/// A couple on its way.
typedef struct small_couple {
    size_t index;
    double size, tolerance;
    pair_frame frame; ///< as frame_place makes it, where evidence is wanted
} small_couple;

/// What is done with a couple that ends. query, end: its answer; end NULL: it is unusual, and has to be queried alone.
typedef struct small_owner {
    void (*finish)(void *self, size_t index, const placed_query *query, const small_end *end);
    void *self;
    int wants_evidence; ///< else `finish` reads of an end only what a verdict says and the proof's kind, and no frame
} small_owner;

/// The searches of a batch: all couples have its goal, but for the tolerance.
typedef struct small_pool {
    gjk8 groups[SMALL_POOL_GROUPS];
    small_gjk_bodies bodies[SMALL_POOL_PLACES];
    small_couple couples[SMALL_POOL_PLACES];
    pair_frame frame; ///< the next couple's, where no evidence is wanted: one that stays in the cache
    const gjk8_kernels *kernels;
    const query_goal *goal;
    small_owner owner;
    int has_lanes;  ///< else each couple is searched by itself, which for a few costs less and gives the same bits
    unsigned place; ///< of the next couple
} small_pool;

/// count: of the couples that will be added, at most.
void small_pool_make(small_pool *pool, const query_goal *goal, small_owner owner, size_t count);

/// Where the frame of the next couple is to be made; other couples may end meanwhile.
pair_frame *small_pool_get_frame(small_pool *pool);

/// The first direction of a search, unit, world, and its supports where they are known, else NULL.
typedef struct small_start {
    vec3 direction;
    const small_gjk_first *first;
} small_start;

/// Begins the search of a couple for which small_fits is 1 and whose inner ellipsoids have no common point. The query's
/// frame is that of small_pool_get_frame.
void small_pool_add(small_pool *pool, size_t index, const placed_query *query, const small_start *start);

/// Goes on until all have ended.
void small_pool_finish(small_pool *pool);

#endif
