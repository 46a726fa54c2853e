// The tests' own few words. A failing check prints place, expression, both values (%.17g) and the seed; the program
// goes on, and exits 1 at the end. The last line is "N passed, N failed[, N skipped]".
#ifndef OVOID_TESTS_CHECK_H
#define OVOID_TESTS_CHECK_H

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static uint64_t check_seed; // the seed of the case at hand, 0 where there is none
static long check_passed, check_failed, check_skipped;

static inline int check_report(int ok, const char *file, int line, const char *expression, double a, double b) {
    if (ok) {
        check_passed++;
        return 1;
    }
    if (check_failed++ < 20)
        printf("%s:%d: FAILED %s: %.17g, %.17g (seed %llu)\n", file, line, expression, a, b,
               (unsigned long long)check_seed);
    return 0;
}

#define CHECK(condition) check_report((condition) != 0, __FILE__, __LINE__, #condition, 0, 0)
#define CHECK_LE(a, b)                                                                                                 \
    check_report((double)(a) <= (double)(b), __FILE__, __LINE__, #a " <= " #b, (double)(a), (double)(b))
#define CHECK_EQ(a, b)                                                                                                 \
    check_report((double)(a) == (double)(b), __FILE__, __LINE__, #a " == " #b, (double)(a), (double)(b))
#define CHECK_NEAR(a, b, tolerance)                                                                                    \
    check_report(fabs((double)(a) - (double)(b)) <= (tolerance), __FILE__, __LINE__, #a " ~ " #b, (double)(a),         \
                 (double)(b))

static inline void check_skip(const char *why) {
    check_skipped++;
    printf("skipped: %s\n", why);
}

static inline int check_end(void) {
    printf("%ld passed, %ld failed, %ld skipped\n", check_passed, check_failed, check_skipped);
    return check_failed ? 1 : 0;
}

// Random numbers: SplitMix64 (G. L. Steele, D. Lea, C. H. Flood, Fast splittable pseudorandom number generators, 2014).
static inline uint64_t random_next(uint64_t *state) {
    uint64_t z = (*state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}
/// Uniform in [low, high).
static inline double random_uniform(uint64_t *state, double low, double high) {
    return low + (high - low) * ((double)(random_next(state) >> 11) * 0x1p-53);
}
/// Standard normal (Box and Muller 1958).
static inline double random_normal(uint64_t *state) {
    double u = 1 - random_uniform(state, 0, 1), v = random_uniform(state, 0, 1);
    return sqrt(-2 * log(u)) * cos(6.283185307179586 * v);
}

/// The folder of real meshes that some tests use, or NULL: the environment variable OVOID_DATA, or ../shared/data.
static inline const char *check_data_folder(void) {
    const char *folder = getenv("OVOID_DATA");
    if (folder && *folder) return folder;
    FILE *f = fopen(OVOID_SOURCE_DIR "/../shared/data/MANIFEST.tsv", "r");
    if (!f) return NULL;
    fclose(f);
    return OVOID_SOURCE_DIR "/../shared/data";
}

#endif
