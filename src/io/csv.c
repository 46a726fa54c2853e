// CSV as RFC 4180 defines it, read strictly: anything else is refused with its line and column.
#include "io/csv.h"

#include <math.h>
#include <string.h>

static const char *skip(const char *at, const char *end) {
    while (at < end && (*at == ' ' || *at == '\t')) at++;
    return at;
}

// Skips the separator after a column: a comma, or after the last column the line's end. at: behind the column's blanks.
static ovoid_code end_column(csv_line *line, const char *at) {
    int is_last = ++line->column == line->count;
    if ((at == line->end) != is_last)
        return io_fail(line->error, OVOID_ERROR_FORMAT, line->place, "the line has %s than %d columns",
                       at == line->end ? "fewer" : "more", line->count);
    line->at = is_last ? at : at + 1;
    return OVOID_OK;
}

ovoid_code csv_read_number(csv_line *line, double *value) {
    const char *begin = skip(line->at, line->end), *name = line->columns[line->column];
    const char *after = number_read(begin, line->end, value);
    if (after) after = skip(after, line->end);
    if (!after || (after < line->end && *after != ',')) {
        const char *comma = memchr(begin, ',', (size_t)(line->end - begin));
        int shown = (int)((comma ? comma : line->end) - begin);
        return io_fail(line->error, OVOID_ERROR_FORMAT, line->place, "column %s: \"%.*s\" is not a number", name,
                       shown < 40 ? shown : 40, begin);
    }
    if (!isfinite(*value))
        return io_fail(line->error, OVOID_ERROR_NOT_FINITE, line->place, "column %s is not finite", name);
    return end_column(line, after);
}

static ovoid_code fail_text(const csv_line *line, const char *what) {
    return io_fail(line->error, OVOID_ERROR_FORMAT, line->place, "column %s: %s", line->columns[line->column], what);
}

static const char zero[] = "there is a zero byte in the text";

// The text between quotes; *at is behind the closing one.
static ovoid_code read_quoted(const csv_line *line, const char **at, char *text, size_t room) {
    size_t length = 0;
    const char *c = *at + 1;
    for (;; c++) {
        if (c == line->end) return fail_text(line, "the closing quote is missing");
        if (*c == '"' && (c + 1 == line->end || c[1] != '"')) break;
        if (*c == '"') c++;
        if (!*c) return fail_text(line, zero);
        if (length + 1 >= room) return fail_text(line, "the text is too long");
        text[length++] = *c;
    }
    text[length] = 0;
    *at = c + 1;
    return OVOID_OK;
}

ovoid_code csv_read_text(csv_line *line, char *text, size_t room) {
    const char *at = skip(line->at, line->end);
    if (at < line->end && *at == '"') {
        ovoid_code code = read_quoted(line, &at, text, room);
        if (code) return code;
        at = skip(at, line->end);
        if (at < line->end && *at != ',') return fail_text(line, "something follows the closing quote");
    } else {
        size_t length = 0, until = 0;
        for (; at + until < line->end && at[until] != ','; until++) {
            if (at[until] == '"') return fail_text(line, "a quote within a text without quotes");
            if (!at[until]) return fail_text(line, zero);
            if (at[until] != ' ' && at[until] != '\t') length = until + 1;
        }
        if (length >= room) return fail_text(line, "the text is too long");
        memcpy(text, at, length);
        text[length] = 0;
        at += until;
    }
    if (!text[0]) return fail_text(line, "is empty");
    return end_column(line, at);
}

int csv_read_header(line_source *source, const char *const *headers, int count, ovoid_error *error) {
    const char *line, *second = count > 1 ? headers[1] : "", *between = count > 1 ? ", or " : "";
    size_t length;
    int got = line_source_next(source, &line, &length, error);
    if (got < 0) return -1;
    where at = {source->path, 1, -1};
    if (got == 0) {
        io_report(error, OVOID_ERROR_EMPTY, at, "the file is empty; its first line must be %s%s%s", headers[0], between,
                  second);
        return -1;
    }
    for (int i = 0; i < count; i++)
        if (length == strlen(headers[i]) && memcmp(line, headers[i], length) == 0) return i;
    io_report(error, OVOID_ERROR_FORMAT, at, "the first line must be %s%s%s", headers[0], between, second);
    return -1;
}

int csv_next_line(line_source *source, const char **line, size_t *length, ovoid_error *error) {
    do {
        int got = line_source_next(source, line, length, error);
        if (got <= 0) return got;
    } while (skip(*line, *line + *length) == *line + *length);
    return 1;
}
