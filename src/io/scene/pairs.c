// PAIRS.csv, read line by line: two shapes and their poses. Linear in the file, constant memory. A part of the file is
// found by its bytes, without reading what is before it; the number of a bad line is counted when it is needed.
#define _FILE_OFFSET_BITS 64
#define _POSIX_C_SOURCE 200809L // fseeko
#include "io/csv.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static const char *const header = "a,b,ax,ay,az,aqw,aqx,aqy,aqz,bx,by,bz,bqw,bqx,bqy,bqz";

enum { COLUMNS = 16 };
static const char *const columns[COLUMNS] = {"a",   "b",  "ax", "ay", "az",  "aqw", "aqx", "aqy",
                                             "aqz", "bx", "by", "bz", "bqw", "bqx", "bqy", "bqz"};

struct ovoid_pairs_reader {
    line_source source;
    size_t shape_count;
    uint64_t begin, end; ///< of a part: bytes of the file; lines that begin in them are read. end 0: all
    int is_counted;      ///< the line's number is that of the file
};

static where here(const ovoid_pairs_reader *reader) { return (where){reader->source.path, reader->source.line, -1}; }

ovoid_pairs_reader *ovoid_pairs_reader_open(const char *path, size_t shape_count, ovoid_error *error) {
    ovoid_pairs_reader *reader = calloc(1, sizeof *reader);
    if (!reader) {
        io_fail_memory(error, path);
        return NULL;
    }
    reader->shape_count = shape_count;
    ovoid_code code = line_source_open(&reader->source, path, error);
    if (!code && csv_read_header(&reader->source, &header, 1, error) == 0) return reader;
    ovoid_pairs_reader_close(reader);
    return NULL;
}

void ovoid_pairs_reader_close(ovoid_pairs_reader *reader) {
    if (!reader) return;
    line_source_close(&reader->source);
    free(reader);
}

static ovoid_code validate_index(const csv_line *line, double value, char column, size_t shape_count) {
    if (value >= 0 && value < (double)shape_count && value == floor(value)) return OVOID_OK;
    return io_fail(line->error, OVOID_ERROR_INDEX, line->place, "column %c: there is no shape %.17g; the list has %zu",
                   column, value, shape_count);
}

static ovoid_code read_pose(const csv_line *line, const double v[7], char body, ovoid_pose *pose) {
    *pose = (ovoid_pose){{v[0], v[1], v[2]}, {v[3], v[4], v[5], v[6]}};
    ovoid_code code = ovoid_pose_validate(pose);
    if (!code) return code;
    return io_fail(line->error, code, line->place, "the pose of %c has %s", body,
                   code == OVOID_ERROR_ROTATION ? "a quaternion of four zeros" : "a number out of range");
}

/* ---- parts */

/// The first byte of a part of the bytes from `first` on.
static uint64_t get_part_begin(uint64_t first, uint64_t size, size_t part, size_t parts) {
    uint64_t all = size - first;
    return first + all / parts * part + all % parts * part / parts;
}

/// Seeks the first line that begins at or after a byte behind the header.
static ovoid_code seek_line(ovoid_pairs_reader *reader, uint64_t byte, ovoid_error *error) {
    line_source *source = &reader->source;
    const char *line;
    size_t length;
    // The byte before tells whether a line begins there: the rest of its line is left out.
    source->begin = source->end = 0;
    source->taken = byte - 1;
    if (fseeko(source->file, (off_t)(byte - 1), SEEK_SET) != 0)
        return io_fail(error, OVOID_ERROR_FILE, (where){source->path, 0, -1}, "cannot be read: %s", strerror(errno));
    int got = line_source_next(source, &line, &length, error);
    reader->begin = source->taken;
    reader->is_counted = 0;
    return got < 0 ? OVOID_ERROR_FILE : OVOID_OK;
}

ovoid_code ovoid_pairs_reader_set_part(ovoid_pairs_reader *reader, size_t part, size_t parts, ovoid_error *error) {
    struct stat status;
    line_source *source = &reader->source;
    where at = {source->path, 0, -1};
    if (part >= parts || parts > UINT32_MAX)
        return io_fail(error, OVOID_ERROR_ARGUMENT, at, "there is no part %zu of %zu", part, parts);
    if (source->file == stdin || fstat(fileno(source->file), &status) != 0 || !S_ISREG(status.st_mode))
        return io_fail(error, OVOID_ERROR_ARGUMENT, at, "is no regular file, which alone has parts");
    uint64_t first = source->taken, size = (uint64_t)status.st_size;
    if (size < first) size = first;
    reader->end = get_part_begin(first, size, part + 1, parts);
    reader->is_counted = 1;
    return part ? seek_line(reader, get_part_begin(first, size, part, parts), error) : OVOID_OK;
}

/// Adds the lines before the part to the number of the last line.
static void count_lines(ovoid_pairs_reader *reader) {
    char block[1 << 12];
    FILE *file = reader->is_counted || !reader->end ? NULL : fopen(reader->source.path, "rb");
    reader->is_counted = 1;
    if (!file) return;
    int64_t lines = 0;
    for (uint64_t left = reader->begin; left;) {
        size_t size = fread(block, 1, left < sizeof block ? (size_t)left : sizeof block, file);
        if (!size) break;
        for (size_t i = 0; i < size; i++) lines += block[i] == '\n';
        left -= size;
    }
    fclose(file);
    // The header and the line that was left out were counted.
    reader->source.line += lines - 2;
}

/// The next line of the part that is not blank. 1, 0 at the end, -1: *error is filled.
static int next_line(ovoid_pairs_reader *reader, const char **line, size_t *length, ovoid_error *error) {
    if (reader->end && reader->source.taken >= reader->end) return 0;
    int got = csv_next_line(&reader->source, line, length, error);
    if (got < 0 && reader->end && !reader->is_counted) {
        // The same line again, with its number.
        count_lines(reader);
        got = csv_next_line(&reader->source, line, length, error);
    }
    // Behind blank lines the next one may be of the next part.
    const line_source *source = &reader->source;
    if (got > 0 && reader->end && source->taken - (uint64_t)(source->buffer + source->begin - *line) >= reader->end)
        return 0;
    return got;
}

ovoid_code ovoid_pairs_reader_skip(ovoid_pairs_reader *reader, uint64_t count, ovoid_error *error) {
    const char *line;
    size_t length;
    int got = 1;
    while (count-- && got > 0) got = next_line(reader, &line, &length, error);
    return got < 0 ? OVOID_ERROR_FILE : OVOID_OK;
}

/* ---- pairs */

static ovoid_code read_pair(const ovoid_pairs_reader *reader, csv_line line, ovoid_indexed_pair *pair) {
    double v[COLUMNS];
    ovoid_code code = OVOID_OK;
    for (int i = 0; i < COLUMNS && !code; i++) code = csv_read_number(&line, &v[i]);
    if (!code) code = validate_index(&line, v[0], 'a', reader->shape_count);
    if (!code) code = validate_index(&line, v[1], 'b', reader->shape_count);
    if (!code) code = read_pose(&line, v + 2, 'a', &pair->pose_a);
    if (!code) code = read_pose(&line, v + 9, 'b', &pair->pose_b);
    if (code) return code;
    pair->a = (size_t)v[0];
    pair->b = (size_t)v[1];
    return OVOID_OK;
}

int ovoid_pairs_reader_read(ovoid_pairs_reader *reader, ovoid_indexed_pair *pair, ovoid_error *error) {
    const char *line;
    size_t length;
    int got = next_line(reader, &line, &length, error);
    if (got <= 0) return got;
    csv_line whole = {line, line + length, columns, 0, COLUMNS, here(reader), error};
    if (!read_pair(reader, whole, pair)) return 1;
    if (reader->end && !reader->is_counted) {
        count_lines(reader);
        whole.place = here(reader);
        (void)read_pair(reader, whole, pair);
    }
    return -1;
}
