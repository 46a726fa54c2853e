// A text read line by line through a buffer of its own: lines are returned in place, without a copy. The buffer grows
// to the longest line, whose length is limited, so that no input can claim more memory.
#include "io/text.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

ovoid_code line_source_open(line_source *source, const char *path, ovoid_error *error) {
    *source = (line_source){.path = text_copy(path, strlen(path)), .capacity = 1 << 16, .most = LINE_MAX_BYTES};
    source->buffer = malloc(source->capacity);
    ovoid_code code = source->path && source->buffer ? OVOID_OK : io_fail_memory(error, path);
    if (!code) source->file = strcmp(path, "-") == 0 ? stdin : fopen(path, "rb");
    if (!code && !source->file)
        code = io_fail(error, OVOID_ERROR_FILE, (where){path, 0, -1}, "cannot be opened: %s", strerror(errno));
    if (code) line_source_close(source);
    return code;
}

void line_source_close(line_source *source) {
    if (source->file && source->file != stdin) fclose(source->file);
    free(source->path);
    free(source->buffer);
    *source = (line_source){.file = NULL};
}

// Reads more bytes at the end of the buffer. 1, 0 at the end of the file, -1: failed.
static int read_more(line_source *source, ovoid_error *error) {
    // Room is made by moving the rest to the front, then by growing.
    if (source->begin) {
        memmove(source->buffer, source->buffer + source->begin, source->end - source->begin);
        source->end -= source->begin;
        source->begin = 0;
    }
    where at = {source->path, source->line + 1, -1};
    if (source->end == source->capacity) {
        if (source->capacity >= source->most) {
            io_report(error, OVOID_ERROR_LIMIT, at, "the line has more than %zu bytes", source->capacity);
            return -1;
        }
        char *grown = realloc(source->buffer, source->capacity * 2);
        if (!grown) {
            (void)io_fail_memory(error, source->path);
            return -1;
        }
        source->buffer = grown;
        source->capacity *= 2;
    }
    size_t n = fread(source->buffer + source->end, 1, source->capacity - source->end, source->file);
    source->end += n;
    if (n) return 1;
    if (!ferror(source->file)) return 0;
    io_report(error, OVOID_ERROR_FILE, (where){source->path, 0, -1}, "cannot be read: %s", strerror(errno));
    return -1;
}

// The first line without a byte order mark. 0: the text is none that was meant.
static int take_first(const line_source *source, const char **line, size_t *length, ovoid_error *error) {
    bytes text = bytes_skip_mark((bytes){(char *)*line, *length});
    *line = text.data;
    *length = text.size;
    if (!text_is_pointer(*line, *length)) return 1;
    io_report(error, OVOID_ERROR_FORMAT, (where){source->path, 0, -1}, TEXT_POINTER_SENTENCE);
    return 0;
}

int line_source_next(line_source *source, const char **line, size_t *length, ovoid_error *error) {
    size_t searched = 0;
    char *end;
    for (;;) {
        end = memchr(source->buffer + source->begin + searched, '\n', source->end - source->begin - searched);
        if (end) break;
        searched = source->end - source->begin;
        int more = read_more(source, error);
        if (more < 0 || (more == 0 && searched == 0)) return more;
        if (more == 0) break; // the last line has no line end
    }
    *line = source->buffer + source->begin;
    *length = end ? (size_t)(end - *line) : searched;
    source->begin += *length + (end != NULL);
    source->taken += *length + (end != NULL);
    if (source->line++ == 0 && !take_first(source, line, length, error)) return -1;
    if (*length && (*line)[*length - 1] == '\r') --*length;
    return 1;
}
