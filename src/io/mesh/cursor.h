// A position in a text file that is read line by line, and the words and numbers that readers take from there.
#ifndef OVOID_IO_MESH_CURSOR_H
#define OVOID_IO_MESH_CURSOR_H

#include "io/text.h"

/// A position in a text.
typedef struct cursor {
    const char *at, *end; ///< of the whole text
    int64_t line;         ///< 1-based line of `at`
} cursor;

static inline int is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }
static inline int is_line_end(const cursor *c) { return c->at == c->end || *c->at == '\n'; }

/// Skips blanks within the line.
static inline void skip_blanks(cursor *c) {
    while (c->at < c->end && is_blank(*c->at)) c->at++;
}
/// Skips to the first byte of the next line.
void skip_line(cursor *c);
/// Skips blanks, empty lines and, where mark is not 0, comments that begin with it. 0 at the end of the text.
int skip_to_text(cursor *c, char mark);
/// A number that ends at a blank or at the line's end. 0 where there is none; nothing is skipped then.
int cursor_read_number(cursor *c, double *value);
/// An integer that ends at a blank or at the line's end. 0 where there is none; nothing is skipped then.
int cursor_read_integer(cursor *c, int64_t *value);
/// Reads the bytes up to the next blank or line end; returns their number.
size_t cursor_read_word(cursor *c, const char **word);
/// Reads three numbers; the error says which is missing and shows the text in its place.
ovoid_code cursor_read_xyz(cursor *c, const char *path, double xyz[3], ovoid_error *error);
/// 1 if the word equals name, in any case; name is in lower case.
int word_is(const char *word, size_t length, const char *name);

#endif
