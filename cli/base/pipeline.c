// The pipeline: a ring of slots. A worker claims the next slot of the ring once it is drained, fills it while it holds
// the lock for filling (which keeps the order), works on it without a lock, and marks it done; the caller's thread
// drains. Filling may wait for input while others work and drain.
#include "base/pipeline.h"

#include "base/finish.h"

#include <pthread.h>
#include <stdint.h>
#include <stdlib.h>
#include <unistd.h>

/// Slots for each thread: enough that no thread waits for a slow one, few enough to save memory.
#define SLOTS_PER_THREAD 4

typedef struct ring {
    const cli_pipeline *pipeline;
    char *slots;
    unsigned char *done; // for each slot: 1 after its work, until it is drained
    size_t count;
    uint64_t filled, drained; // slots so far
    int ended, stopped;       // the input has ended; drain has stopped the run
    pthread_t *workers;
    unsigned started, most;  // threads: the number that was started, the largest number
    pthread_mutex_t filling; // held by the worker that fills; taken before `lock`
    pthread_mutex_t lock;    // of all numbers above
    pthread_cond_t changed;
} ring;

static void *get_slot(const ring *r, uint64_t number) {
    return r->slots + (size_t)(number % r->count) * r->pipeline->slot_size;
}

/// Waits until the next slot is free. 0 if no more slots are needed.
static int wait_for_room(ring *r, uint64_t *number) {
    pthread_mutex_lock(&r->lock);
    while (!r->ended && !r->stopped && r->filled - r->drained == r->count) pthread_cond_wait(&r->changed, &r->lock);
    int go = !r->ended && !r->stopped;
    *number = r->filled;
    pthread_mutex_unlock(&r->lock);
    return go;
}

static void start_worker(ring *r);

/// Claims and fills the next slot, and starts another worker for the slot after it. 0 if there is no slot to fill.
static int claim(ring *r, uint64_t *number) {
    pthread_mutex_lock(&r->filling);
    int go = wait_for_room(r, number) && r->pipeline->fill(r->pipeline->context, get_slot(r, *number));
    pthread_mutex_lock(&r->lock);
    if (go) {
        r->filled++;
        start_worker(r);
    } else {
        r->ended = 1;
    }
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

/// Bytes of a worker's stack; the system's default may be as little as 128 KB.
#define WORKER_STACK ((size_t)2 << 20)

/// Starts one more worker if allowed; `lock` is held. If the system cannot start one, the running workers do the work.
static void start_worker(ring *r) {
    pthread_attr_t attributes;
    if (r->started == r->most || pthread_attr_init(&attributes) != 0) return;
    int ok = pthread_attr_setstacksize(&attributes, WORKER_STACK) == 0 &&
             pthread_create(&r->workers[r->started], &attributes, run_worker, r) == 0;
    pthread_attr_destroy(&attributes);
    if (ok)
        r->started++;
    else
        r->most = r->started;
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

static int run_threads(ring *r) {
    int code = -1;
    r->workers = malloc(r->most * sizeof *r->workers);
    if (!r->workers) return -1;
    // Signals that the program holds back must not be delivered to a worker, nor to the workers that it starts.
    finish_hold_signals();
    pthread_mutex_lock(&r->lock);
    start_worker(r);
    unsigned started = r->started;
    pthread_mutex_unlock(&r->lock);
    finish_release_signals();
    if (started) code = drain_all(r);
    // A worker that runs may still start others; a worker that has ended starts none.
    for (unsigned i = 0; i < started; i++) {
        pthread_join(r->workers[i], NULL);
        pthread_mutex_lock(&r->lock);
        started = r->started;
        pthread_mutex_unlock(&r->lock);
    }
    free(r->workers);
    return code;
}

int pipeline_run(const cli_pipeline *pipeline, unsigned threads) {
    ring r = {.pipeline = pipeline, .count = threads > 1 ? (size_t)threads * SLOTS_PER_THREAD : 1, .most = threads};
    int code = -1;
    r.slots = calloc(r.count, pipeline->slot_size);
    r.done = calloc(r.count, 1);
    pthread_mutex_init(&r.filling, NULL);
    pthread_mutex_init(&r.lock, NULL);
    pthread_cond_init(&r.changed, NULL);
    if (r.slots && r.done) code = threads > 1 ? run_threads(&r) : run_alone(&r);
    // Slots that were never filled own nothing; memory that was never touched was never allocated by the system.
    size_t used = threads > 1 && r.filled < r.count ? (size_t)r.filled + 1 : r.count;
    for (size_t i = 0; r.slots && i < r.count && i < used; i++) pipeline->clear(r.slots + i * pipeline->slot_size);
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

unsigned pipeline_get_threads(unsigned asked) {
    long processors = sysconf(_SC_NPROCESSORS_ONLN);
    unsigned threads = asked ? asked : processors > 1 ? (unsigned)processors : 1;
    return threads < PIPELINE_THREADS_MAX ? threads : PIPELINE_THREADS_MAX;
}
