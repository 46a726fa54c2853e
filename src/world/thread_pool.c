// The built-in pool: a task is an array of items, of which each free worker takes the next part. Threads sleep on a
// condition while there is no task. Results must not depend on which worker computes them, or in what order. In a child
// made by fork these threads do not exist: the caller's thread works alone, and the locks and conditions of the threads
// are not touched. A task ends when its parts are done, not when all threads have woken.
#define _POSIX_C_SOURCE 200809L // signal sets
#include "world/thread_pool.h"

#include "base/allocator.h"
#include "base/environment.h"
#include "base/error.h"
#include "world/thread.h"

#include <stdatomic.h>

struct thread_pool {
    thread_lock lock;
    thread_condition begun, ended;
    uint64_t round;        // number of the present task
    uint32_t busy, joined; // workers at the present task; workers that have their number
    task task;             // the present task
    int is_open;           // the present task may have parts that none has taken
    int is_closing;
    atomic_uint next;      // the first item that no worker has taken
    long process;          // the process that started the threads
    uint32_t thread_count; // without the caller's thread
    thread threads[];
};

static int has_threads(const thread_pool *p) { return p->process == process_get_number(); }

static void run_in_environment(void *work, uint32_t first, uint32_t end, uint32_t worker) {
    const task *t = work;
    environment before = environment_enter();
    t->run(t->work, first, end, worker);
    environment_leave(before);
}

// Takes parts until none is left. next ends slightly above count: by at most one part for each thread.
static void take_parts(thread_pool *p, uint32_t worker) {
    for (;;) {
        uint32_t first = atomic_fetch_add(&p->next, p->task.least);
        if (first >= p->task.count) return;
        uint32_t rest = p->task.count - first;
        run_in_environment(&p->task, first, first + (rest < p->task.least ? rest : p->task.least), worker);
    }
}

THREAD_MAIN(work_on, context) {
    thread_pool *p = context;
    uint64_t done = 0;
    lock_take(&p->lock);
    uint32_t worker = ++p->joined;
    for (;;) {
        while ((p->round == done || !p->is_open) && !p->is_closing) condition_wait(&p->begun, &p->lock);
        if (p->is_closing) break;
        done = p->round;
        p->busy++;
        lock_give(&p->lock);
        take_parts(p, worker);
        lock_take(&p->lock);
        if (--p->busy == 0) condition_wake_all(&p->ended);
    }
    lock_give(&p->lock);
    return THREAD_END;
}

static void join_all(thread_pool *p) {
    lock_take(&p->lock);
    p->is_closing = 1;
    condition_wake_all(&p->begun);
    lock_give(&p->lock);
    for (uint32_t i = 0; i < p->thread_count; i++) thread_join(p->threads[i]);
}

static void release(thread_pool *p, const ovoid_allocator *allocator) {
    condition_clear(&p->ended);
    condition_clear(&p->begun);
    lock_clear(&p->lock);
    allocator_release(allocator, p);
}

thread_pool *thread_pool_create(uint32_t threads, const ovoid_allocator *allocator, ovoid_error *error) {
    thread_pool *p = allocator_allocate(allocator, 1, sizeof *p + threads * sizeof(thread));
    if (!p) {
        error_write(error, OVOID_ERROR_MEMORY, -1, "no memory for a pool of %u threads", threads);
        return NULL;
    }
    *p = (thread_pool){.process = process_get_number()};
    atomic_init(&p->next, 0);
    lock_make(&p->lock);
    condition_make(&p->begun);
    condition_make(&p->ended);
    while (p->thread_count + 1 < threads) {
        if (!thread_start(&p->threads[p->thread_count], work_on, p)) {
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

void thread_pool_destroy(thread_pool *p, const ovoid_allocator *allocator) {
    if (!p) return;
    if (!has_threads(p)) {
        allocator_release(allocator, p);
        return;
    }
    join_all(p);
    release(p, allocator);
}

static void run_in_pool(thread_pool *p, const task *t) {
    lock_take(&p->lock);
    p->task = *t;
    atomic_store(&p->next, 0);
    p->is_open = 1;
    p->round++;
    condition_wake_all(&p->begun);
    lock_give(&p->lock);
    take_parts(p, 0);
    lock_take(&p->lock);
    // A worker that has not woken by now is not waited for.
    p->is_open = 0;
    while (p->busy) condition_wait(&p->ended, &p->lock);
    lock_give(&p->lock);
}

void task_host_run(const task_host *host, const task *t) {
    if (!t->count) return;
    if (host->tasks.start) {
        task own = *t;
        void *handle = host->tasks.start(host->tasks.context, run_in_environment, &own, t->count, t->least);
        host->tasks.finish(host->tasks.context, handle);
    } else if (host->own && t->count > t->least && has_threads(host->own)) {
        run_in_pool(host->own, t);
    } else {
        t->run(t->work, 0, t->count, 0);
    }
}
