// The cost in C of the queries of overhead.py. A shared library that overhead.py loads: it passes shapes as the bytes
// of .ovoid files and poses as x y z w x y z numbers, so both sides query the same bits. Times are seconds of the
// monotonic clock.
#define _POSIX_C_SOURCE 200809L // clock_gettime
#include <ovoid/ovoid.h>

#include <stdlib.h>
#include <time.h>

/// A body as overhead.py gives it.
typedef struct given_body {
    const void *bytes;
    size_t size;
    ovoid_pose pose;
} given_body;

/// A batch as overhead.py gives it: its bodies are made once, before the clock starts.
typedef struct given_batch {
    const given_body *bodies;
    size_t body_count;
    const ovoid_couple *couples;
    size_t couple_count;
    ovoid_verdict *verdicts;
} given_batch;

double time_single(int kind, const given_body *bodies, size_t count);
double time_batch(int kind, const given_batch *given, size_t count, double *times);

static double get_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static ovoid_answer query(int kind, const ovoid_pair *pair) {
    if (kind == 0) return ovoid_collide(pair, NULL, NULL);
    if (kind == 2) return ovoid_distance(pair, NULL, NULL);
    static uint64_t memory[OVOID_COVER_SIZE / sizeof(uint64_t)];
    ovoid_cover cover = {.memory = memory, .size = sizeof memory};
    return ovoid_depth(pair, NULL, NULL, &cover);
}

/// Seconds of `count` queries of the first two bodies; the sum of the bounds is returned, so that the compiler keeps
/// them.
double time_single(int kind, const given_body *bodies, size_t count) {
    ovoid_shape *a = ovoid_shape_read(bodies[0].bytes, bodies[0].size, NULL, NULL);
    ovoid_shape *b = ovoid_shape_read(bodies[1].bytes, bodies[1].size, NULL, NULL);
    ovoid_pair pair = {a, b, bodies[0].pose, bodies[1].pose};
    volatile double sum = 0;
    double begin = get_seconds();
    for (size_t i = 0; i < count; i++) sum = sum + query(kind, &pair).lower;
    double end = get_seconds();
    ovoid_shape_destroy(a);
    ovoid_shape_destroy(b);
    return end - begin;
}

/// Seconds of each of `count` runs of a batch, in times; the least is returned.
double time_batch(int kind, const given_batch *given, size_t count, double *times) {
    ovoid_posed_shape *bodies = malloc(given->body_count * sizeof *bodies);
    for (size_t i = 0; i < given->body_count; i++)
        bodies[i] = (ovoid_posed_shape){ovoid_shape_read(given->bodies[i].bytes, given->bodies[i].size, NULL, NULL),
                                        given->bodies[i].pose};
    ovoid_batch batch = {.bodies = bodies,
                         .body_count = given->body_count,
                         .couples = given->couples,
                         .couple_count = given->couple_count,
                         .verdicts = given->verdicts};
    double least = 1e9;
    for (size_t i = 0; i < count; i++) {
        double begin = get_seconds();
        if (kind == 0)
            ovoid_collide_batch(&batch, NULL);
        else if (kind == 2)
            ovoid_distance_batch(&batch, NULL);
        else
            ovoid_depth_batch(&batch, NULL);
        times[i] = get_seconds() - begin;
        if (times[i] < least) least = times[i];
    }
    for (size_t i = 0; i < given->body_count; i++) ovoid_shape_destroy((ovoid_shape *)bodies[i].shape);
    free(bodies);
    return least;
}
