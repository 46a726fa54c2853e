// 1 to N threads get the same bits: each thread makes the shapes anew, and asks every query of the shapes that all
// share. Truth: the hashes of one thread, pair by pair.
#include "bits.h"

#include <pthread.h>

enum { THREADS = 6, PAIRS = 60, ALL = BITS_FAMILIES * PAIRS };

typedef struct work {
    ovoid_shape *const *shared;
    uint64_t made[BITS_SHAPES], asked[ALL];
    int ok;
    unsigned start;
} work;

static void *run(void *argument) {
    work *w = argument;
    ovoid_shape *own[BITS_SHAPES];
    w->ok = bits_make_shapes(own);
    for (int i = 0; i < BITS_SHAPES && w->ok; i++) {
        w->made[i] = bits_add_shape(BITS_START, own[i]);
        ovoid_shape_destroy(own[i]);
    }
    // Each begins elsewhere, so that they meet at other pairs than their own.
    for (unsigned k = 0; k < ALL; k++) {
        unsigned i = (k + w->start) % ALL;
        ovoid_pair p = bits_make_pair(w->shared, (bits_family)(i / PAIRS), i % PAIRS);
        w->asked[i] = bits_add_pair(BITS_START, &p);
    }
    return NULL;
}

int main(void) {
    static work truth, works[THREADS];
    ovoid_shape *shapes[BITS_SHAPES];
    pthread_t threads[THREADS];
    if (!CHECK(bits_make_shapes(shapes))) return check_end();
    truth.shared = shapes;
    (void)run(&truth);
    for (int count = 2; count <= THREADS; count += 2) {
        for (int t = 0; t < count; t++) {
            works[t] = (work){.shared = shapes, .start = (unsigned)(t * 37)};
            CHECK(pthread_create(&threads[t], NULL, run, &works[t]) == 0);
        }
        for (int t = 0; t < count; t++) {
            CHECK(pthread_join(threads[t], NULL) == 0);
            CHECK(works[t].ok);
            CHECK(memcmp(works[t].made, truth.made, sizeof truth.made) == 0);
            CHECK(memcmp(works[t].asked, truth.asked, sizeof truth.asked) == 0);
        }
    }
    for (int i = 0; i < BITS_SHAPES; i++) ovoid_shape_destroy(shapes[i]);
    return check_end();
}
