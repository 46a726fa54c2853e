// Work in several threads: the world's own pool, or the host's task system.
#ifndef OVOID_SCENE_POOL_H
#define OVOID_SCENE_POOL_H

#include "ovoid/world.h"

/// Does items [first, end); worker tells threads apart.
typedef void pool_run(void *work, uint32_t first, uint32_t end, uint32_t worker);

typedef struct pool pool;

/// threads - 1 sleeping threads. NULL with *error filled: MEMORY, LIMIT.
pool *pool_create(uint32_t threads, const ovoid_allocator *allocator, ovoid_error *error);
/// Ends and joins its threads; NULL is allowed.
void pool_destroy(pool *p, const ovoid_allocator *allocator);

/// Who does the work: with neither pool nor tasks the caller alone.
typedef struct pool_host {
    pool *own;
    ovoid_tasks tasks;
} pool_host;

/// run over [0, count) in parts of at least `least` items (the last may be smaller), each in the default floating-point
/// environment; returns when all is done.
void pool_do(const pool_host *host, pool_run *run, void *work, uint32_t count, uint32_t least);

#endif
