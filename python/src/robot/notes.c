// Notes of the readers of files, gathered without the interpreter's lock and told as warnings.
#ifdef OVOID_PYTHON_ROBOT_READ
#include "src/robot/notes.h"

#include <stdlib.h>
#include <string.h>

void notes_gather(void *notes, const ovoid_robot_note *note) {
    read_notes *n = notes;
    if (n->count == n->capacity) {
        size_t capacity = 2 * n->capacity + 8;
        char **grown = realloc(n->texts, capacity * sizeof *grown);
        if (!grown) return;
        n->texts = grown;
        n->capacity = capacity;
    }
    size_t size = strlen(note->path) + strlen(note->text) + 32;
    char *text = malloc(size);
    if (!text) return;
    if (note->line)
        PyOS_snprintf(text, size, "%s:%lld: %s", note->path, (long long)note->line, note->text);
    else
        PyOS_snprintf(text, size, "%s: %s", note->path, note->text);
    n->texts[n->count++] = text;
}

int notes_tell(read_notes *n) {
    int failed = 0;
    for (size_t i = 0; i < n->count; i++) {
        PyObject *text = PyUnicode_DecodeUTF8(n->texts[i], (Py_ssize_t)strlen(n->texts[i]), "replace");
        PyObject *plain = text ? PyUnicode_AsUTF8String(text) : NULL;
        if (!failed) failed = !plain || PyErr_WarnEx(PyExc_UserWarning, PyBytes_AsString(plain), 1);
        Py_XDECREF(plain);
        Py_XDECREF(text);
        free(n->texts[i]);
    }
    free(n->texts);
    return failed ? -1 : 0;
}
#else
typedef int nothing_to_note; // ISO C wants a declaration
#endif
