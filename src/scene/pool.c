// The built-in pool: a job is an array of items, of which whoever is free takes the next part. Threads sleep on a
// condition while there is no job. What is computed must not depend on who computes it; the pool promises no order.
#include "scene/pool.h"

#include "base/allocator.h"
#include "base/environment.h"
#include "base/error.h"

#include <pthread.h>
#include <stdatomic.h>

// What is to be done, in the default floating-point environment.
typedef struct job {
    pool_run *run;
    void *work;
} job;

struct pool {
    pthread_mutex_t lock;
    pthread_cond_t begun, ended;
    uint64_t round;        // of the job at hand
    uint32_t busy, joined; // threads that have not finished this round; workers that have a number
    uint32_t count, least; // of the job
    job job;               // likewise
    int is_closing;
    atomic_uint next;      // the first item that no one has taken
    uint32_t thread_count; // without the caller
    pthread_t threads[];
};

static void run_inside(void *work, uint32_t first, uint32_t end, uint32_t worker) {
    const job *j = work;
    environment before = environment_enter();
    j->run(j->work, first, end, worker);
    environment_leave(before);
}

// Takes parts until none is left. next stops growing a little above count, at most one part for each thread.
static void take_parts(pool *p, uint32_t worker) {
    for (;;) {
        uint32_t first = atomic_fetch_add(&p->next, p->least);
        if (first >= p->count) return;
        uint32_t rest = p->count - first;
        run_inside(&p->job, first, first + (rest < p->least ? rest : p->least), worker);
    }
}

static void *work_on(void *context) {
    pool *p = context;
    uint64_t done = 0;
    (void)pthread_mutex_lock(&p->lock);
    uint32_t worker = ++p->joined;
    for (;;) {
        while (p->round == done && !p->is_closing) (void)pthread_cond_wait(&p->begun, &p->lock);
        if (p->is_closing) break;
        done = p->round;
        (void)pthread_mutex_unlock(&p->lock);
        take_parts(p, worker);
        (void)pthread_mutex_lock(&p->lock);
        if (--p->busy == 0) (void)pthread_cond_signal(&p->ended);
    }
    (void)pthread_mutex_unlock(&p->lock);
    return NULL;
}

static void join_all(pool *p) {
    (void)pthread_mutex_lock(&p->lock);
    p->is_closing = 1;
    (void)pthread_cond_broadcast(&p->begun);
    (void)pthread_mutex_unlock(&p->lock);
    for (uint32_t i = 0; i < p->thread_count; i++) (void)pthread_join(p->threads[i], NULL);
}

static void release(pool *p, const ovoid_allocator *allocator) {
    (void)pthread_cond_destroy(&p->ended);
    (void)pthread_cond_destroy(&p->begun);
    (void)pthread_mutex_destroy(&p->lock);
    allocator_release(allocator, p);
}

pool *pool_create(uint32_t threads, const ovoid_allocator *allocator, ovoid_error *error) {
    pool *p = allocator_allocate(allocator, 1, sizeof *p + threads * sizeof(pthread_t));
    if (!p) {
        error_write(error, OVOID_ERROR_MEMORY, -1, "no memory for a pool of %u threads", threads);
        return NULL;
    }
    *p = (pool){.round = 0};
    atomic_init(&p->next, 0);
    (void)pthread_mutex_init(&p->lock, NULL);
    (void)pthread_cond_init(&p->begun, NULL);
    (void)pthread_cond_init(&p->ended, NULL);
    while (p->thread_count + 1 < threads) {
        if (pthread_create(&p->threads[p->thread_count], NULL, work_on, p) != 0) {
            error_write(error, OVOID_ERROR_LIMIT, -1, "the system starts no more than %u of %u threads: ask for fewer",
                        p->thread_count + 1, threads);
            join_all(p);
            release(p, allocator);
            return NULL;
        }
        p->thread_count++;
    }
    return p;
}

void pool_destroy(pool *p, const ovoid_allocator *allocator) {
    if (!p) return;
    join_all(p);
    release(p, allocator);
}

static void run_in_pool(pool *p, const job *j, uint32_t count, uint32_t least) {
    (void)pthread_mutex_lock(&p->lock);
    p->job = *j;
    p->count = count;
    p->least = least;
    atomic_store(&p->next, 0);
    p->busy = p->thread_count;
    p->round++;
    (void)pthread_cond_broadcast(&p->begun);
    (void)pthread_mutex_unlock(&p->lock);
    take_parts(p, 0);
    (void)pthread_mutex_lock(&p->lock);
    while (p->busy) (void)pthread_cond_wait(&p->ended, &p->lock);
    (void)pthread_mutex_unlock(&p->lock);
}

void pool_do(const pool_host *host, pool_run *run, void *work, uint32_t count, uint32_t least) {
    job j = {run, work};
    if (!count) return;
    if (host->tasks.start) {
        void *handle = host->tasks.start(host->tasks.context, run_inside, &j, count, least);
        host->tasks.finish(host->tasks.context, handle);
    } else if (host->own && count > least) {
        run_in_pool(host->own, &j, count, least);
    } else {
        run(work, 0, count, 0);
    }
}
