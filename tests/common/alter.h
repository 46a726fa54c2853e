// Altering the fields of a record, one at a time. A test lists the fields by their place and type; each kind of
// alteration changes one field: by one unit in the last place, by a tolerance, by much more, to the other sign, zero,
// infinite, not a number, or to the value in another record.
#ifndef OVOID_TESTS_ALTER_H
#define OVOID_TESTS_ALTER_H

#include "check.h"

/// The type of a field. An enumeration is an int.
typedef enum alter_type { ALTER_REAL, ALTER_INT, ALTER_U32, ALTER_SIZE } alter_type;

/// A field of a record. tolerance: the tolerance of the field, a length or a time; 0 if it has none.
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

/// Alters one field of a record in place; 0 if this kind changes nothing. other: a record of the same type, or NULL.
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

/// The results of the alterations of one field.
typedef struct alter_count {
    long told, refused, still_true;
} alter_count;

/// The present alteration: which field, and how.
static const char *alter_name = "", *alter_way = "";

/// Counts an alteration and checks that it is refused or may be true; 0 if neither.
static inline int alter_take(alter_count *n, int is_false, int is_refused) {
    n->told++;
    n->refused += is_refused;
    n->still_true += !is_refused && !is_false;
    int is_noticed = CHECK(is_refused || !is_false);
    if (!is_noticed && check_failed <= 20) printf("  accepted: %s, %s\n", alter_name, alter_way);
    return is_noticed;
}

static inline void alter_print(const char *name, const alter_count *n) {
    printf("%-24s %7ld lies, %7ld refused, %7ld accepted as not shown to be false\n", name, n->told, n->refused,
           n->still_true);
}

/// The fields of a kind of record, and a count for each.
typedef struct alter_table {
    const alter_field *fields;
    int count;
    alter_count *counts;
} alter_table;
#define ALTER_TABLE(fields, counts)                                                                                    \
    { fields, sizeof(fields) / sizeof *(fields), counts }

static inline void alter_print_table(const alter_table *table) {
    for (int i = 0; i < table->count; i++) alter_print(table->fields[i].name, &table->counts[i]);
}

/// A loop over all alterations of a record, of at most 4096 bytes, each in the record itself.
typedef struct alter_walk {
    const alter_table *table;
    void *record;
    const void *other; ///< another record of the type
    size_t size;
    double scale; ///< of the tolerances
    int step;
    unsigned char right[4096];
} alter_walk;

static inline alter_walk alter_walk_make(const alter_table *table, void *record, size_t size, const void *other) {
    alter_walk w = {.table = table, .record = record, .other = other, .size = size, .scale = 1};
    if (size > sizeof w.right) exit(2);
    memcpy(w.right, record, size);
    return w;
}

/// Alters the record in the next way and returns the count of its field. NULL at the end: the record is then unaltered.
static inline alter_count *alter_next(alter_walk *w) {
    for (; w->step < w->table->count * ALTER_KINDS; w->step++) {
        alter_field field = w->table->fields[w->step / ALTER_KINDS];
        memcpy(w->record, w->right, w->size);
        field.tolerance *= w->scale;
        if (!alter_apply(w->record, w->other, &field, w->step % ALTER_KINDS)) continue;
        alter_name = field.name;
        alter_way = alter_names[w->step % ALTER_KINDS];
        return &w->table->counts[w->step++ / ALTER_KINDS];
    }
    memcpy(w->record, w->right, w->size);
    return NULL;
}

#endif
