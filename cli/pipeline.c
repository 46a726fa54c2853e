// The pipeline: a ring of slots. A worker claims the next slot of the ring once it is drained, fills it while it holds
// the lock for filling (that is what keeps the order), works on it without a lock, and marks it done; the caller's
// thread drains. Filling may wait for input while others work and drain.
#include "pipeline.h"

#include "finish.h"

#include <pthread.h>
#include <stdint.h>
#include <stdlib.h>
#include <unistd.h>

/// Slots for each thread: enough that none waits for a slow one, few enough to stay small.
#define SLOTS_PER_THREAD 4

typedef struct ring {
    const cli_pipeline *pipeline;
    char *slots;
    unsigned char *done; // of each slot: worked on, not yet drained
    size_t count;
    uint64_t filled, drained; // slots so far
    int ended, stopped;       // the input has ended; drain has stopped the run
    pthread_mutex_t filling;  // held by the worker that fills; taken before `lock`
    pthread_mutex_t lock;     // of all numbers above
    pthread_cond_t changed;
} ring;

static void *get_slot(const ring *r, uint64_t number) {
    return r->slots + (size_t)(number % r->count) * r->pipeline->slot_size;
}

/// Waits until the next slot is free. 0 where no more slots are to be filled.
static int wait_for_room(ring *r, uint64_t *number) {
    pthread_mutex_lock(&r->lock);
    while (!r->ended && !r->stopped && r->filled - r->drained == r->count) pthread_cond_wait(&r->changed, &r->lock);
    int go = !r->ended && !r->stopped;
    *number = r->filled;
    pthread_mutex_unlock(&r->lock);
    return go;
}

/// Claims and fills the next slot. 0 where there is none.
static int claim(ring *r, uint64_t *number) {
    pthread_mutex_lock(&r->filling);
    int go = wait_for_room(r, number) && r->pipeline->fill(r->pipeline->context, get_slot(r, *number));
    pthread_mutex_lock(&r->lock);
    if (go)
        r->filled++;
    else
        r->ended = 1;
    pthread_cond_broadcast(&r->changed);
    pthread_mutex_unlock(&r->lock);
    pthread_mutex_unlock(&r->filling);
    return go;
}

static void *run_worker(void *argument) {
    ring *r = argument;
    uint64_t number;
    while (claim(r, &number)) {
        r->pipeline->work(r->pipeline->context, get_slot(r, number));
        pthread_mutex_lock(&r->lock);
        r->done[number % r->count] = 1;
        pthread_cond_broadcast(&r->changed);
        pthread_mutex_unlock(&r->lock);
    }
    return NULL;
}

/// Drains slots in order until all filled ones are drained, or drain stops the run.
static int drain_all(ring *r) {
    int code = 0;
    pthread_mutex_lock(&r->lock);
    while (!code) {
        size_t place = (size_t)(r->drained % r->count);
        while (!r->done[place] && !(r->ended && r->drained == r->filled)) pthread_cond_wait(&r->changed, &r->lock);
        if (!r->done[place]) break;
        pthread_mutex_unlock(&r->lock);
        code = r->pipeline->drain(r->pipeline->context, get_slot(r, r->drained));
        pthread_mutex_lock(&r->lock);
        r->done[place] = 0;
        r->drained++;
        r->stopped = code != 0;
        pthread_cond_broadcast(&r->changed);
    }
    pthread_mutex_unlock(&r->lock);
    return code;
}

/// Runs in one thread: fill, work, drain, one slot after another.
static int run_alone(ring *r) {
    const cli_pipeline *p = r->pipeline;
    int code = 0;
    while (!code && p->fill(p->context, r->slots)) {
        p->work(p->context, r->slots);
        code = p->drain(p->context, r->slots);
    }
    return code;
}

/// Bytes of a worker's stack, where the system's own choice may be as little as 128 KB.
#define WORKER_STACK ((size_t)2 << 20)

static int start_worker(pthread_t *worker, ring *r) {
    pthread_attr_t attributes;
    if (pthread_attr_init(&attributes) != 0) return 0;
    // Signals that the program holds back for a moment must not come by way of a worker.
    finish_hold_signals();
    int ok = pthread_attr_setstacksize(&attributes, WORKER_STACK) == 0 &&
             pthread_create(worker, &attributes, run_worker, r) == 0;
    finish_release_signals();
    pthread_attr_destroy(&attributes);
    return ok;
}

static int run_threads(ring *r, unsigned threads) {
    pthread_t *workers = malloc(threads * sizeof *workers);
    unsigned started = 0;
    int code = -1;
    if (!workers) return -1;
    while (started < threads && start_worker(&workers[started], r)) started++;
    if (started) code = drain_all(r);
    for (unsigned i = 0; i < started; i++) pthread_join(workers[i], NULL);
    free(workers);
    return code;
}

int pipeline_run(const cli_pipeline *pipeline, unsigned threads) {
    ring r = {.pipeline = pipeline, .count = threads > 1 ? (size_t)threads * SLOTS_PER_THREAD : 1};
    int code = -1;
    r.slots = calloc(r.count, pipeline->slot_size);
    r.done = calloc(r.count, 1);
    pthread_mutex_init(&r.filling, NULL);
    pthread_mutex_init(&r.lock, NULL);
    pthread_cond_init(&r.changed, NULL);
    if (r.slots && r.done) code = threads > 1 ? run_threads(&r, threads) : run_alone(&r);
    for (size_t i = 0; r.slots && i < r.count; i++) pipeline->clear(r.slots + i * pipeline->slot_size);
    pthread_cond_destroy(&r.changed);
    pthread_mutex_destroy(&r.lock);
    pthread_mutex_destroy(&r.filling);
    free(r.done);
    free(r.slots);
    return code;
}

size_t pipeline_take(size_t *next, size_t total, size_t most, size_t *first) {
    size_t left = total - *next, count = left < most ? left : most;
    *first = *next;
    *next += count;
    return count;
}

unsigned pipeline_get_processors(void) {
    long count = sysconf(_SC_NPROCESSORS_ONLN);
    return count > 1 ? (unsigned)count : 1;
}
