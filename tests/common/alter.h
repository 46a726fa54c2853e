// A liar's tool: the fields of a record, altered one at a time. A test names the fields by their place and type; each
// kind of alteration gives a copy of the record in which one field says something else: by one unit in the last place,
// by a tolerance, by much, of the other sign, zero, infinite, not a number, or what another record says there.
#ifndef OVOID_TESTS_ALTER_H
#define OVOID_TESTS_ALTER_H

#include "check.h"

/// The type of a field. An enumeration is an int.
typedef enum alter_type { ALTER_REAL, ALTER_INT, ALTER_U32, ALTER_SIZE } alter_type;

/// A field of a record. tolerance: what the field is measured by, a length or a time; 0 where nothing is.
typedef struct alter_field {
    const char *name;
    size_t offset;
    alter_type type;
    double tolerance;
} alter_field;

#define ALTER_FIELD(record, member, type, tolerance)                                                                   \
    { #member, offsetof(record, member), type, tolerance }

enum { ALTER_KINDS = 16 };

static const char *const alter_names[ALTER_KINDS] = {"up by one ulp",
                                                     "down by one ulp",
                                                     "up by a tolerance",
                                                     "down by a tolerance",
                                                     "up by 1000 tolerances",
                                                     "down by 1000 tolerances",
                                                     "up by much",
                                                     "down by much",
                                                     "the other sign",
                                                     "zero",
                                                     "infinite",
                                                     "minus infinite",
                                                     "not a number",
                                                     "another's",
                                                     "one more",
                                                     "one less"};

static inline double alter_real(double x, double tolerance, double other, int kind) {
    switch (kind) {
    case 0: return nextafter(x, INFINITY);
    case 1: return nextafter(x, -INFINITY);
    case 2: return x + tolerance;
    case 3: return x - tolerance;
    case 4: return x + 1e3 * tolerance;
    case 5: return x - 1e3 * tolerance;
    case 6: return x + fmax(fabs(x), 1e6 * tolerance);
    case 7: return x - fmax(2 * fabs(x), 1e6 * tolerance);
    case 8: return -x;
    case 9: return 0;
    case 10: return INFINITY;
    case 11: return -INFINITY;
    case 12: return NAN;
    case 13: return other;
    case 14: return x + 1;
    default: return x - 1;
    }
}

static inline uint64_t alter_whole(uint64_t x, uint64_t other, int kind) {
    switch (kind) {
    case 0: return x + 1;
    case 1: return x - 1;
    case 2: return x + 2;
    case 3: return x - 2;
    case 4: return 2 * x;
    case 5: return x / 2;
    case 9: return 0;
    case 10: return ~UINT64_C(0);
    case 13: return other;
    default: return x;
    }
}

/// Alters one field of a record in place; 0 where this kind changes nothing. other: a record of the same type, or NULL.
static inline int alter_apply(void *record, const void *other, const alter_field *f, int kind) {
    char *at = (char *)record + f->offset;
    const char *from = other ? (const char *)other + f->offset : at;
    unsigned char before[8];
    size_t size = f->type == ALTER_REAL ? sizeof(double) : f->type == ALTER_SIZE ? sizeof(size_t) : sizeof(uint32_t);
    memcpy(before, at, size);
    if (f->type == ALTER_REAL) {
        double x, y;
        memcpy(&x, at, sizeof x);
        memcpy(&y, from, sizeof y);
        x = alter_real(x, f->tolerance, y, kind);
        memcpy(at, &x, sizeof x);
    } else if (f->type == ALTER_SIZE) {
        size_t x, y;
        memcpy(&x, at, sizeof x);
        memcpy(&y, from, sizeof y);
        x = (size_t)alter_whole(x, y, kind);
        memcpy(at, &x, sizeof x);
    } else {
        uint32_t x, y;
        memcpy(&x, at, sizeof x);
        memcpy(&y, from, sizeof y);
        x = (uint32_t)alter_whole(x, y, kind);
        memcpy(at, &x, sizeof x);
    }
    return memcmp(before, at, size) != 0;
}

/// What became of the lies in one field.
typedef struct alter_count {
    long told, refused, still_true;
} alter_count;

/// Counts a lie; 0 where it is false and was accepted.
static inline int alter_take(alter_count *n, int is_false, int is_refused) {
    n->told++;
    n->refused += is_refused;
    n->still_true += !is_refused && !is_false;
    return is_refused || !is_false;
}

static inline void alter_print(const char *name, const alter_count *n) {
    printf("%-24s %7ld lies, %7ld refused, %7ld accepted as not shown to be false\n", name, n->told, n->refused,
           n->still_true);
}

#endif
