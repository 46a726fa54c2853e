// Docstrings: what the tables write once is what help() shows, what inspect reads and what the stub is made of.
//
// A table writes a signature with its types, "f(a: PoseLike = None, *, b: float = 0) -> Answer", before "\n--\n\n" and
// the words. inspect takes none with types, so it gets "f(a=None, *, b=0)", and the types end the words.
#include "src/module.h"

#include <stdlib.h>
#include <string.h>

static const char END[] = "\n--\n\n", TYPES[] = "\n\nTypes: ";

// The signature of [from, end) without its types to *to; returns its end.
static char *write_plain(const char *from, const char *end, char *to) {
    int depth = 0, is_type = 0;
    char quote = 0;
    for (; from < end; from++) {
        if (quote ? *from == quote : (*from == '\'' || *from == '"')) quote = quote ? 0 : *from;
        if (!quote && strchr("([{", *from)) depth++;
        if (!quote && strchr(")]}", *from)) depth--;
        int is_outer = !quote && depth <= 1;
        if (is_type && is_outer && (strchr("=,", *from) || depth == 0)) is_type = 0;
        if (is_outer && *from == ':') is_type = 1;
        if (!is_type) *to++ = *from;
        if (!is_type && is_outer && *from == '=' && from[1] == ' ') from++;
        if (depth == 0 && *from == ')') break;
    }
    return to;
}

const char *doc_make(const char *doc) {
    const char *end = doc ? strstr(doc, END) : NULL, *open = end ? memchr(doc, '(', (size_t)(end - doc)) : NULL;
    const char *returns = open ? strstr(open, " -> ") : NULL;
    if (!returns || returns > end) return doc;
    size_t length = strlen(doc);
    char *made = malloc(2 * length + sizeof TYPES);
    if (!made) return (const char *)PyErr_NoMemory();
    char *to = write_plain(doc, end, made);
    size_t words = length - (size_t)(end - doc);
    memcpy(to, end, words);
    to += words;
    memcpy(to, TYPES, sizeof TYPES - 1);
    to += sizeof TYPES - 1;
    memcpy(to, open, (size_t)(end - open));
    to[end - open] = 0;
    return made;
}

int docs_make(PyMethodDef *methods) {
    for (PyMethodDef *m = methods; m->ml_name; m++)
        if (m->ml_doc && !(m->ml_doc = doc_make(m->ml_doc))) return -1;
    return 0;
}

int functions_add(PyObject *module, PyMethodDef *functions) {
    return docs_make(functions) ? -1 : PyModule_AddFunctions(module, functions);
}
