// The checks of the tests. A failing check prints place, expression, both values (%.17g) and the seed; the program
// continues, and exits 1 at the end. The last line is "N passed, N failed[, N skipped]".
#ifndef OVOID_TESTS_CHECK_H
#define OVOID_TESTS_CHECK_H

#include "tools/random.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static uint64_t check_seed; // the seed of the present case, 0 if there is none
static long check_passed, check_failed, check_skipped;

/// A number of any type, stored exactly: a whole number with its sign, or a double.
typedef struct check_value {
    int is_real, is_negative;
    uint64_t size; ///< of a whole number
    double real;
} check_value;

static inline check_value check_value_real(double x) {
    check_value v = {1, x < 0, 0, x};
    return v;
}
static inline check_value check_value_unsigned(uint64_t x) {
    check_value v = {0, 0, x, 0};
    return v;
}
static inline check_value check_value_signed(int64_t x) {
    check_value v = {0, x < 0, x < 0 ? 0 - (uint64_t)x : (uint64_t)x, 0};
    return v;
}
// Narrower types become int64_t; an enumeration becomes its integer type.
#ifdef __cplusplus
static inline check_value CHECK_VALUE(double x) { return check_value_real(x); }
static inline check_value CHECK_VALUE(unsigned long x) { return check_value_unsigned(x); }
static inline check_value CHECK_VALUE(unsigned long long x) { return check_value_unsigned(x); }
static inline check_value CHECK_VALUE(long long x) { return check_value_signed(x); }
static inline check_value CHECK_VALUE(long x) { return check_value_signed(x); }
static inline check_value CHECK_VALUE(unsigned x) { return check_value_unsigned(x); }
static inline check_value CHECK_VALUE(int x) { return check_value_signed(x); }
#else
#define CHECK_VALUE(x)                                                                                                 \
    _Generic((x), double                                                                                               \
             : check_value_real, float                                                                                 \
             : check_value_real, unsigned long                                                                         \
             : check_value_unsigned, unsigned long long                                                                \
             : check_value_unsigned, default                                                                           \
             : check_value_signed)(x)
#endif

static inline int check_value_compare_whole(check_value a, check_value b) {
    if (a.is_negative != b.is_negative) return a.is_negative ? -1 : 1;
    int order = a.size < b.size ? -1 : a.size > b.size;
    return a.is_negative ? -order : order;
}

/// -1, 0 or 1 as the first is less than, equal to or greater than the second, exactly; 2 where one is NaN.
static inline int check_value_compare(check_value a, check_value b) {
    if (a.is_real && b.is_real) return a.real < b.real ? -1 : a.real > b.real ? 1 : a.real == b.real ? 0 : 2;
    if (!a.is_real && !b.is_real) return check_value_compare_whole(a, b);
    if (b.is_real) {
        int order = check_value_compare(b, a);
        return order == 2 ? 2 : -order;
    }
    // A double and a whole number are compared by the floor and the fraction of the double.
    if (isnan(a.real)) return 2;
    double below = floor(a.real);
    if (below >= 0x1p64) return 1;
    if (below < -0x1p63) return -1;
    int order = check_value_compare_whole(
        below < 0 ? check_value_signed((int64_t)below) : check_value_unsigned((uint64_t)below), b);
    return order ? order : a.real > below;
}

static inline void check_value_print(const char *before, check_value x) {
    if (x.is_real)
        printf("%s%.17g", before, x.real);
    else
        printf("%s%s%llu", before, x.is_negative ? "-" : "", (unsigned long long)x.size);
}

/// The place of a check.
typedef struct check_place_at {
    const char *file;
    int line;
    const char *expression;
} check_place_at;

static inline check_place_at check_place_make(const char *file, int line, const char *expression) {
    check_place_at at = {file, line, expression};
    return at;
}

static inline int check_report(int ok, check_place_at at, check_value a, check_value b) {
    if (ok) {
        check_passed++;
        return 1;
    }
    if (check_failed++ >= 20) return 0;
    printf("%s:%d: FAILED %s", at.file, at.line, at.expression);
    check_value_print(": ", a);
    check_value_print(", ", b);
    printf(" (seed %llu)\n", (unsigned long long)check_seed);
    return 0;
}
static inline int check_is_equal(check_value a, check_value b, check_place_at at) {
    return check_report(check_value_compare(a, b) == 0, at, a, b);
}
static inline int check_is_at_most(check_value a, check_value b, check_place_at at) {
    return check_report(check_value_compare(a, b) <= 0, at, a, b);
}
static inline int check_is_near(double a, double b, double tolerance, check_place_at at) {
    return check_report(fabs(a - b) <= tolerance, at, check_value_real(a), check_value_real(b));
}

// Each argument is evaluated once. Whole numbers are compared exactly, also with doubles.
#define CHECK_PLACE(expression) check_place_make(__FILE__, __LINE__, expression)
#define CHECK(condition)                                                                                               \
    check_report((condition) != 0, CHECK_PLACE(#condition), check_value_signed((int64_t)0),                            \
                 check_value_signed((int64_t)0))
#define CHECK_LE(a, b) check_is_at_most(CHECK_VALUE(a), CHECK_VALUE(b), CHECK_PLACE(#a " <= " #b))
#define CHECK_EQ(a, b) check_is_equal(CHECK_VALUE(a), CHECK_VALUE(b), CHECK_PLACE(#a " == " #b))
#define CHECK_NEAR(a, b, tolerance)                                                                                    \
    check_is_near((double)(a), (double)(b), (double)(tolerance), CHECK_PLACE(#a " ~ " #b))

static inline void check_skip(const char *why) {
    check_skipped++;
    printf("skipped: %s\n", why);
}

static inline int check_end(void) {
    printf("%ld passed, %ld failed, %ld skipped\n", check_passed, check_failed, check_skipped);
    return check_failed ? 1 : 0;
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
