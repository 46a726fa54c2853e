// Many states or edges on several threads. A block of them is one thread's, and begins with nothing remembered, so
// answers do not depend on who takes which block.
#define _POSIX_C_SOURCE 200809L // signal sets

#include "base/environment.h"
#include "base/error.h"
#include "robot/cell/checker.h"
#include "world/thread.h"

#include <stdatomic.h>

// What all threads share.
typedef struct batch_work {
    const checkers_job *job;
    atomic_size_t next; ///< the first that nobody has taken
} batch_work;

// One thread and its checker.
typedef struct batch_worker {
    batch_work *work;
    ovoid_robot_checker *checker;
    thread thread;
    int is_started;
} batch_worker;

static void work_off(batch_work *w, ovoid_robot_checker *checker) {
    for (;;) {
        size_t first = atomic_fetch_add(&w->next, OVOID_ROBOT_BLOCK), count = w->job->count;
        if (first >= count) return;
        size_t end = count - first < OVOID_ROBOT_BLOCK ? count : first + OVOID_ROBOT_BLOCK;
        w->job->run(w->job->context, checker, first, end);
    }
}

THREAD_MAIN(run_worker, context) {
    batch_worker *worker = context;
    ENVIRONMENT_RUN(work_off(worker->work, worker->checker));
    return THREAD_END;
}

ovoid_code checkers_validate(ovoid_robot_checker *const *checkers, size_t count, ovoid_error *error) {
    if (!checkers || count == 0 || count > OVOID_WORLD_THREADS_MAX)
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "a batch needs 1 to %u checkers", OVOID_WORLD_THREADS_MAX);
    ovoid_code code = OVOID_OK;
    for (size_t i = 0; code == OVOID_OK && i < count; i++) code = checker_renew(checkers[i], error);
    return code;
}

ovoid_code checkers_run(ovoid_robot_checker *const *checkers, size_t count, const checkers_job *job,
                        ovoid_error *error) {
    ovoid_code code = OVOID_OK;
    batch_work work = {.job = job};
    atomic_init(&work.next, 0);
    batch_worker workers[OVOID_WORLD_THREADS_MAX];
    size_t blocks = job->count / OVOID_ROBOT_BLOCK + 1, wanted = count < blocks ? count : blocks;
    for (size_t i = 1; i < wanted; i++) {
        workers[i] = (batch_worker){.work = &work, .checker = checkers[i]};
        workers[i].is_started = thread_start(&workers[i].thread, run_worker, &workers[i]);
        if (!workers[i].is_started) code = OVOID_ERROR_LIMIT;
    }
    work_off(&work, checkers[0]);
    for (size_t i = 1; i < wanted; i++)
        if (workers[i].is_started) thread_join(workers[i].thread);
    if (code == OVOID_OK) return code;
    return error_set(error, code, -1, "not all threads of the batch could be started; all of it is answered");
}

static void run_states(void *context, ovoid_robot_checker *checker, size_t first, size_t end) {
    collide_block(checker, *(const ovoid_robot_batch **)context, first, end);
}

static ovoid_code run_batch(ovoid_robot_checker *const *checkers, size_t count, const ovoid_robot_batch *batch,
                            ovoid_error *error) {
    ovoid_code code = checkers_validate(checkers, count, error);
    if (code == OVOID_OK && batch->options) code = query_options_validate(batch->options, error);
    if (code != OVOID_OK) return code;
    return checkers_run(checkers, count, &(checkers_job){run_states, &batch, batch->count}, error);
}

ovoid_code ovoid_robot_collide_batch(ovoid_robot_checker *const *checkers, size_t checker_count,
                                     const ovoid_robot_batch *batch, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, checkers, run_batch(checkers, checker_count, batch, error));
}
