// Arguments by name: an unknown one is refused with the one that was probably meant.
#include "src/module.h"

#include <string.h>

enum { NAME_MOST = 64 };

static int min_of(int a, int b, int c) { return a < b ? (a < c ? a : c) : (b < c ? b : c); }

// How many letters have to be changed, added or left out (V. I. Levenshtein, 1966); NAME_MOST for long words.
static int compute_edits(const char *a, const char *b) {
    int row[NAME_MOST + 1], length = (int)strlen(b);
    if (strlen(a) >= NAME_MOST || length >= NAME_MOST) return NAME_MOST;
    for (int k = 0; k <= length; k++) row[k] = k;
    for (int i = 1; a[i - 1]; i++)
        for (int k = 1, before = row[0]++; k <= length; k++) {
            int same = before + (a[i - 1] != b[k - 1]);
            before = row[k];
            row[k] = min_of(same, row[k] + 1, row[k - 1] + 1);
        }
    return row[length];
}

void *argument_refuse(const char *function, PyObject *name, const char *const *names) {
    const char *given = PyUnicode_AsUTF8AndSize(name, NULL), *nearest = NULL;
    if (!given) return NULL;
    int least = 1 + (int)strlen(given) / 3;
    for (; *names; names++) {
        int edits = compute_edits(given, *names);
        if (edits <= least) least = edits - 1, nearest = *names;
    }
    return PyErr_Format(PyExc_TypeError,
                        nearest ? "%s() has no argument '%U': did you mean '%s'?" : "%s() has no argument '%U'",
                        function, name, nearest);
}

int arguments_read(PyObject *arguments, PyObject *keywords, const char *format, char **names, ...) {
    const char *colon = strchr(format, ':'), *function = colon ? colon + 1 : "call";
    PyObject *key, *value;
    Py_ssize_t at = 0;
    while (keywords && PyDict_Next(keywords, &at, &key, &value)) {
        char **known = names;
        while (*known && PyUnicode_CompareWithASCIIString(key, *known)) known++;
        if (!*known) return argument_refuse(function, key, (const char *const *)names), 0;
    }
    va_list targets;
    va_start(targets, names);
    int is_read = PyArg_VaParseTupleAndKeywords(arguments, keywords, format, names, targets);
    va_end(targets);
    return is_read;
}
