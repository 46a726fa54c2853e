// CSV as RFC 4180 defines it, read strictly: anything else is refused with its line and column. Texts are read as
// ovoid_text_write_csv writes them.
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

// ---- texts

/// A field as it stands in the line.
typedef struct field {
    const char *begin, *end; ///< without quotes and the blanks around it
    const char *behind;      ///< the comma, or the line's end
    int is_quoted;
} field;

// Finds a field in quotes; NULL, or what is wrong.
static const char *find_quoted(const char *at, const char *end, field *f) {
    const char *c = at + 1;
    for (; c < end && (*c != '"' || (c + 1 < end && c[1] == '"')); c++) c += *c == '"';
    if (c >= end) return "the closing quote is missing";
    *f = (field){at + 1, c, skip(c + 1, end), 1};
    return f->behind < end && *f->behind != ',' ? "something follows the closing quote" : NULL;
}

static const char *find_field(const char *at, const char *end, field *f) {
    at = skip(at, end);
    if (at < end && *at == '"') return find_quoted(at, end, f);
    const char *comma = at < end ? memchr(at, ',', (size_t)(end - at)) : NULL, *last = comma ? comma : end;
    *f = (field){at, last, last, 0};
    while (f->end > at && (f->end[-1] == ' ' || f->end[-1] == '\t')) f->end--;
    return at < last && memchr(at, '"', (size_t)(last - at)) ? "a quote within a text without quotes" : NULL;
}

// The text of a field, as it was before ovoid_text_write_csv: into `room` bytes, which may be where the field stands.
static const char *decode(const field *f, char *text, size_t room) {
    size_t length = 0;
    const char *c = f->begin;
    if (c < f->end && *c == '\'' && text_is_formula(c + 1, f->end)) c++;
    while (c < f->end) {
        int byte = text_read_escape(c, f->end), is_escape = byte >= 0, is_doubled = f->is_quoted && *c == '"';
        if (!is_escape) byte = (unsigned char)*c;
        if (!byte) return "there is a zero byte in the text";
        if (length + 1 >= room) return "the text is too long";
        text[length++] = (char)byte;
        c += is_escape ? 4 : is_doubled ? 2 : 1;
    }
    text[length] = 0;
    return NULL;
}

ovoid_code csv_read_text(csv_line *line, char *text, size_t room) {
    field f;
    const char *wrong = find_field(line->at, line->end, &f);
    if (!wrong) wrong = decode(&f, text, room);
    if (!wrong && !text[0]) wrong = "is empty";
    if (!wrong) return end_column(line, f.behind);
    return io_fail(line->error, OVOID_ERROR_FORMAT, line->place, "column %s: %s", line->columns[line->column], wrong);
}

const char *ovoid_text_read_csv(const char *line, char *text, size_t room, ovoid_error *error) {
    const char *end = line + strcspn(line, "\n");
    if (end > line && *end && end[-1] == '\r') end--;
    field f;
    const char *wrong = find_field(line, end, &f);
    if (!wrong) wrong = decode(&f, text, room);
    if (!wrong) return f.behind;
    if (error) *error = (ovoid_error){.code = OVOID_ERROR_FORMAT, .place = -1};
    if (error) snprintf(error->message, sizeof error->message, "%s", wrong);
    return NULL;
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
