// Options of tests: --NAME VALUE, --NAME for a switch. --help lists them and runs nothing; unknown options are refused.
#ifndef OVOID_TESTS_OPTIONS_H
#define OVOID_TESTS_OPTIONS_H

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// One option: the pointer that is not NULL receives its value.
typedef struct test_option {
    const char *name, *help; ///< without the dashes; a name of NULL ends a table
    uint64_t *whole;
    double *real;
    const char **text;
    int *flag;
} test_option;

/// Reads a value; 0 if it is not valid.
static inline int option_take(const test_option *o, const char *value) {
    char *end = NULL;
    if (o->text) return *o->text = value, 1;
    // A whole number may be written as 1e9.
    double number = strtod(value, &end);
    int is_number = end != value && !*end;
    if (o->real) return *o->real = number, is_number;
    if (!is_number || !(number >= 0)) return 0;
    *o->whole = strspn(value, "0123456789") == strlen(value) ? strtoull(value, NULL, 10) : (uint64_t)number;
    return 1;
}

/// Reads the command line. -1: continue; else the exit code, after --help (0) or a sentence about a mistake (2).
static inline int options_read(const test_option *options, int count, char **arguments) {
    for (int i = 1; i < count; i++) {
        const test_option *o = options;
        if (strcmp(arguments[i], "--help") == 0 || strcmp(arguments[i], "-h") == 0) {
            printf("%s: a test, or a longer run of it\n", arguments[0]);
            for (; o->name; o++) printf("  --%s%s: %s\n", o->name, o->flag ? "" : " N", o->help);
            return 0;
        }
        while (o->name && (strncmp(arguments[i], "--", 2) != 0 || strcmp(arguments[i] + 2, o->name) != 0)) o++;
        if (o->name && o->flag) {
            *o->flag = 1;
        } else if (!o->name || i + 1 == count || !option_take(o, arguments[i + 1])) {
            fprintf(stderr, "%s: not understood: %s %s; --help lists the options\n", arguments[0], arguments[i],
                    i + 1 < count ? arguments[i + 1] : "");
            return 2;
        } else {
            i++;
        }
    }
    return -1;
}

#endif
