// Work in several threads: the world's own pool, or the host's task system.
#ifndef OVOID_WORLD_THREAD_POOL_H
#define OVOID_WORLD_THREAD_POOL_H

#include "ovoid/world.h"

/// Does the items [first, end) of a task; worker numbers the threads.
typedef void task_run(void *work, uint32_t first, uint32_t end, uint32_t worker);

typedef struct thread_pool thread_pool;

/// A pool of threads - 1 sleeping threads. NULL with *error filled: MEMORY, LIMIT.
thread_pool *thread_pool_create(uint32_t threads, const ovoid_allocator *allocator, ovoid_error *error);
/// Ends and joins the threads; NULL is allowed.
void thread_pool_destroy(thread_pool *p, const ovoid_allocator *allocator);

/// Tasks run in the pool, in the host's task system, or with neither in the caller's thread alone.
typedef struct task_host {
    thread_pool *own;
    ovoid_tasks tasks;
} task_host;

/// Work on the items [0, count), in parts of at least `least` (the last may be smaller).
typedef struct task {
    task_run *run;
    void *work; ///< passed to run
    uint32_t count, least;
} task;

/// Runs a task, each part in the default floating-point environment; returns when all parts are done.
void task_host_run(const task_host *host, const task *t);

#endif
