// bench [--smoke]: nanoseconds per query over random hulls, one thread, no warm start, beside libccd where it was there
// at build time. A cell is the fastest of five passes over its pairs: what the machine can do, not what it was
// disturbed in. --smoke: one pass over few pairs, to see that it runs.
#define _POSIX_C_SOURCE 200809L
#include "pairs.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#if defined(OVOID_HAVE_CCD)
#include "peer.h"
#endif

/// Runs one query; the number returned keeps the compiler from leaving it out.
typedef double (*query)(const ovoid_pair *pair);

static double run_collide(const ovoid_pair *pair) { return ovoid_collide(pair, NULL, NULL).upper; }
static double run_distance(const ovoid_pair *pair) { return ovoid_distance(pair, NULL, NULL).upper; }
static double run_depth(const ovoid_pair *pair) { return ovoid_depth(pair, NULL, NULL, NULL).upper; }
#if defined(OVOID_HAVE_CCD)
static double run_peer_gjk(const ovoid_pair *pair) { return peer_collide_gjk(pair); }
static double run_peer_mpr(const ovoid_pair *pair) { return peer_collide_mpr(pair); }
#endif

static const struct column {
    const char *name;
    query run;
    int only_overlaps;
} columns[] = {
    {"collide", run_collide, 0},  {"distance", run_distance, 0}, {"depth", run_depth, 1},
#if defined(OVOID_HAVE_CCD)
    {"ccd gjk", run_peer_gjk, 0}, {"ccd mpr", run_peer_mpr, 0},  {"ccd depth", peer_depth, 1},
#endif
};
enum { COLUMNS = sizeof columns / sizeof columns[0] };

static double get_seconds(void) {
    struct timespec now;
    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/// Nanoseconds per query of the fastest pass.
static double measure(query run, const ovoid_pair *pairs, uint32_t count, int passes) {
    static volatile double sink;
    double best = 1e300;
    for (int pass = 0; pass < passes; pass++) {
        double start = get_seconds(), sum = 0;
        for (uint32_t i = 0; i < count; i++) sum += run(&pairs[i]);
        sink = sum;
        double took = (get_seconds() - start) / count * 1e9;
        if (took < best) best = took;
    }
    (void)sink;
    return best;
}

/// How many pairs the queries left unproven, and how many the peer got wrong against a proven sign.
typedef struct faults {
    uint32_t pairs, unproven, peer_gjk, peer_mpr;
} faults;

static void count_faults(const ovoid_pair *pairs, uint32_t count, faults *sum) {
    for (uint32_t i = 0; i < count; i++) {
        ovoid_answer answer = ovoid_depth(&pairs[i], NULL, NULL, NULL);
        sum->pairs++;
        if (answer.status == OVOID_UNDECIDED || answer.limit != OVOID_LIMIT_NONE) sum->unproven++;
#if defined(OVOID_HAVE_CCD)
        int overlap = answer.status == OVOID_OVERLAPPING;
        if (answer.status != OVOID_OVERLAPPING && answer.status != OVOID_SEPARATED) continue;
        sum->peer_gjk += peer_collide_gjk(&pairs[i]) != overlap;
        sum->peer_mpr += peer_collide_mpr(&pairs[i]) != overlap;
#endif
    }
}

/// One line: all queries over pairs of one size and placement. 0 where memory is out.
static int print_line(ovoid_shape **shapes, uint32_t count, uint32_t vertices, placement place, int passes,
                      faults *sum) {
    ovoid_pair *pairs = pairs_create(shapes, count, place);
    if (!pairs) return 0;
    printf("%-5s %8u", placement_get_name(place), vertices);
    for (int i = 0; i < COLUMNS; i++) {
        if (columns[i].only_overlaps && place != PLACE_OVER)
            printf(" %10s", "");
        else
            printf(" %10.0f", measure(columns[i].run, pairs, count, passes));
    }
    printf("\n");
    (void)fflush(stdout);
    count_faults(pairs, count, sum);
    free(pairs);
    return 1;
}

int main(int argc, char **argv) {
    static const uint32_t sizes[] = {8, 16, 32, 64, 128, 512};
    int smoke = argc == 2 && strcmp(argv[1], "--smoke") == 0;
    if (argc > 1 && !smoke) {
        (void)fprintf(stderr, "usage: bench [--smoke]\n");
        return 2;
    }
    uint32_t count = smoke ? 10 : 200, size_count = smoke ? 2 : sizeof sizes / sizeof sizes[0];

    // The head: what the numbers are.
    printf("ovoid %s, nanoseconds per query, %u pairs a line\n%-5s %8s", ovoid_get_version(), count, "place",
           "vertices");
    for (int i = 0; i < COLUMNS; i++) printf(" %10s", columns[i].name);
    printf("\n");

    faults sum = {0, 0, 0, 0};
    for (uint32_t i = 0; i < size_count; i++) {
        ovoid_shape **shapes = shapes_create(sizes[i], count);
        int good = shapes != NULL;
        for (int place = 0; good && place < PLACE_COUNT; place++)
            good = print_line(shapes, count, sizes[i], (placement)place, smoke ? 1 : 5, &sum);
        shapes_destroy(shapes, count);
        if (!good) return 1;
    }
    printf("of %u pairs ovoid left %u unproven", sum.pairs, sum.unproven);
#if defined(OVOID_HAVE_CCD)
    printf("; against the proven signs libccd's GJK is wrong on %u, its MPR on %u", sum.peer_gjk, sum.peer_mpr);
#endif
    printf("\n");
    return 0;
}
