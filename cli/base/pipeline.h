// Ordered work on several threads with bounded memory: slots are filled one after another, processed concurrently, and
// drained in the order in which they were filled. So the output has the same bytes for any number of threads.
#ifndef OVOID_CLI_BASE_PIPELINE_H
#define OVOID_CLI_BASE_PIPELINE_H

#include <stddef.h>

/// The row of an options table of the commands whose results are written by a pipeline.
#define THREADS_OPTION(settings)                                                                                       \
    {                                                                                                                  \
        "threads", 0, OPTION_COUNT, offsetof(settings, threads), "N", NULL,                                            \
            "work on N threads, 1024 at most, and no more than there is work for; the output is the same bytes for "   \
            "any N "                                                                                                   \
            "(default: one for each processor)"                                                                        \
    }

/// The steps of a pipeline; context is the caller's.
typedef struct cli_pipeline {
    void *context;
    size_t slot_size; ///< bytes of a slot; zeroed once, then reused without clearing
    /// In order, one at a time. 1: filled; 0: there is no more (the slot is not used).
    int (*fill)(void *context, void *slot);
    /// Concurrent with others; uses its slot and constants of the context.
    void (*work)(void *context, void *slot);
    /// In order, one at a time, on the thread that called pipeline_run. 0: go on; else pipeline_run stops with it.
    int (*drain)(void *context, void *slot);
    /// Frees what a slot owns.
    void (*clear)(void *slot);
} cli_pipeline;

/// Runs a pipeline on that many threads (1: none are started), or on as many as there are slots to fill if these are
/// fewer. Returns 0, the code with which drain stopped it, or -1: no memory or no threads.
int pipeline_run(const cli_pipeline *pipeline, unsigned threads);

/// The next chunk of a list of `total` items for a slot: from *first on, at most `most`. Returns their number; 0: there
/// are no more.
size_t pipeline_take(size_t *next, size_t total, size_t most, size_t *first);

/// The largest number of threads of a pipeline.
#define PIPELINE_THREADS_MAX 1024u

/// The number of threads to use: as many as asked for, 0: one for each processor; at most PIPELINE_THREADS_MAX.
unsigned pipeline_get_threads(unsigned asked);

#endif
