// Words and numbers of text formats, read line by line.
#include "io/mesh/cursor.h"

#include <string.h>

void skip_line(cursor *c) {
    const char *end = memchr(c->at, '\n', (size_t)(c->end - c->at));
    c->at = end ? end + 1 : c->end;
    c->line += end != NULL;
}

int skip_to_text(cursor *c, char mark) {
    for (;;) {
        skip_blanks(c);
        if (c->at == c->end) return 0;
        if (*c->at != '\n' && !(mark && *c->at == mark)) return 1;
        skip_line(c);
    }
}

// 1 where a word ends.
static int is_word_end(const char *at, const char *end) { return at == end || is_blank(*at) || *at == '\n'; }

int cursor_read_number(cursor *c, double *value) {
    skip_blanks(c);
    const char *after = number_read(c->at, c->end, value);
    if (!after || !is_word_end(after, c->end)) return 0;
    c->at = after;
    return 1;
}

int cursor_read_integer(cursor *c, int64_t *value) {
    skip_blanks(c);
    const char *after = integer_read(c->at, c->end, value);
    if (!after || !is_word_end(after, c->end)) return 0;
    c->at = after;
    return 1;
}

size_t cursor_read_word(cursor *c, const char **word) {
    skip_blanks(c);
    *word = c->at;
    while (!is_word_end(c->at, c->end)) c->at++;
    return (size_t)(c->at - *word);
}

ovoid_code cursor_read_xyz(cursor *c, const char *path, double xyz[3], ovoid_error *error) {
    for (int k = 0; k < 3; k++) {
        if (cursor_read_number(c, &xyz[k])) continue;
        const char *word;
        where at = {path, c->line, -1};
        int length = (int)cursor_read_word(c, &word);
        if (!length)
            return io_fail(error, OVOID_ERROR_FORMAT, at, "the coordinate %c of a vertex is missing", "xyz"[k]);
        return io_fail(error, OVOID_ERROR_FORMAT, at, "\"%.*s\" is not a coordinate", length < 40 ? length : 40, word);
    }
    return OVOID_OK;
}

int word_is(const char *word, size_t length, const char *name) {
    for (size_t i = 0; i < length; i++) {
        char c = word[i] >= 'A' && word[i] <= 'Z' ? (char)(word[i] | 0x20) : word[i];
        if (!name[i] || c != name[i]) return 0;
    }
    return !name[length];
}
