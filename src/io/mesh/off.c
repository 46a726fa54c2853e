// OFF (Geomview's object file format), as text: a word, three counts, points, polygons. COFF, NOFF, STOFF and their
// mixtures have more numbers after a point, which are skipped; after a face colours may follow. One point or face a
// line; comments begin with '#'. Counts that exceed the file's size are refused before points are read.
#include "io/mesh/readers.h"

#include "io/mesh/cursor.h"

#include <string.h>

/// The file as it is read.
typedef struct off_text {
    mesh_reader *reader;
    cursor c;
    mesh_part *part;
    int has_more; ///< 1: points have more numbers than three
} off_text;

static where here(const off_text *s) { return (where){s->reader->path, s->c.line, -1}; }

// Reads the word at the top: OFF, with C, N or ST before it.
static ovoid_code read_word(off_text *s) {
    const char *word = "";
    size_t length = skip_to_text(&s->c, '#') ? cursor_read_word(&s->c, &word) : 0;
    const char *left = word, *end = word + length;
    if (end - left > 3 && left[0] == 'S' && left[1] == 'T') left += 2;
    if (end - left > 3 && left[0] == 'C') left++;
    if (end - left > 3 && left[0] == 'N') left++;
    s->has_more = left != word;
    if (end - left != 3 || memcmp(left, "OFF", 3) != 0)
        return io_fail(s->reader->error, OVOID_ERROR_FORMAT, here(s),
                       "the file begins with \"%.*s\", not with OFF (4OFF and nOFF are not read)",
                       (int)(length < 40 ? length : 40), word);
    skip_blanks(&s->c);
    if (!is_line_end(&s->c) && (*s->c.at | 0x20) == 'b')
        return io_fail(s->reader->error, OVOID_ERROR_FORMAT, here(s), "binary OFF is not read");
    return OVOID_OK;
}

// Reads the counts of points, faces and edges, and compares them with the size of the rest of the file.
static ovoid_code read_counts(off_text *s, int64_t counts[3]) {
    if (!skip_to_text(&s->c, '#'))
        return io_fail(s->reader->error, OVOID_ERROR_FORMAT, here(s), "truncated: the counts are missing");
    for (int k = 0; k < 3; k++) {
        // Some writers omit the count of edges.
        if (k == 2 && (skip_blanks(&s->c), is_line_end(&s->c))) break;
        if (!cursor_read_integer(&s->c, &counts[k]) || counts[k] < 0)
            return io_fail(s->reader->error, OVOID_ERROR_FORMAT, here(s),
                           "the counts of vertices, faces and edges must be three numbers >= 0");
    }
    // A point takes at least the bytes "0 0 0\n", a face "0\n"; the last line end may be missing.
    int64_t left = s->c.end - s->c.at + 1;
    if (counts[0] > left / 6 || counts[1] > (left - 6 * counts[0]) / 2)
        return io_fail(s->reader->error, OVOID_ERROR_FORMAT, here(s),
                       "truncated: %lld vertices and %lld faces do not fit into the %lld bytes that follow",
                       (long long)counts[0], (long long)counts[1], (long long)(left - 1));
    skip_line(&s->c);
    return OVOID_OK;
}

static ovoid_code read_point(off_text *s, int64_t i, int64_t count) {
    if (!skip_to_text(&s->c, '#'))
        return io_fail(s->reader->error, OVOID_ERROR_FORMAT, here(s), "truncated: %lld of %lld vertices", (long long)i,
                       (long long)count);
    double xyz[3];
    ovoid_code code = cursor_read_xyz(&s->c, s->reader->path, xyz, s->reader->error);
    if (!code) code = mesh_add_point(s->reader, s->part, xyz, here(s));
    if (code) return code;
    skip_blanks(&s->c);
    if (!s->has_more && !is_line_end(&s->c) && *s->c.at != '#')
        return io_fail(s->reader->error, OVOID_ERROR_FORMAT, here(s), "a vertex has more than three numbers");
    skip_line(&s->c);
    return OVOID_OK;
}

static ovoid_code read_face(off_text *s, int64_t i, int64_t count) {
    if (!skip_to_text(&s->c, '#'))
        return io_fail(s->reader->error, OVOID_ERROR_FORMAT, here(s), "truncated: %lld of %lld faces", (long long)i,
                       (long long)count);
    int64_t size;
    if (!cursor_read_integer(&s->c, &size) || size < 0 || size > s->c.end - s->c.at)
        return io_fail(s->reader->error, OVOID_ERROR_FORMAT, here(s), "a face must begin with its number of vertices");
    int64_t points = (int64_t)s->part->point_count;
    for (int64_t k = 0; k < size; k++) {
        int64_t v;
        if (!cursor_read_integer(&s->c, &v))
            return io_fail(s->reader->error, OVOID_ERROR_FORMAT, here(s), "a face of %lld vertices has %lld of them",
                           (long long)size, (long long)k);
        if (v < 0 || v >= points)
            return io_fail(s->reader->error, OVOID_ERROR_INDEX, here(s), "there is no vertex %lld; the file has %lld",
                           (long long)v, (long long)points);
        ovoid_code code = mesh_add_index(s->reader, s->part, (uint32_t)v);
        if (code) return code;
    }
    skip_line(&s->c);
    return mesh_end_face(s->reader, s->part, (uint32_t)size);
}

ovoid_code mesh_read_off(mesh_reader *reader) {
    const char *data = reader->file.data;
    off_text s = {.reader = reader, .c = {data, data + reader->file.size, 1}};
    s.part = mesh_add_part(reader, "", 0);
    if (!s.part) return OVOID_ERROR_MEMORY;
    int64_t counts[3] = {0, 0, 0};
    ovoid_code code = read_word(&s);
    if (!code) code = read_counts(&s, counts);
    for (int64_t i = 0; i < counts[0] && !code; i++) code = read_point(&s, i, counts[0]);
    for (int64_t i = 0; i < counts[1] && !code; i++) code = read_face(&s, i, counts[1]);
    // Some files have more faces than their count says; these use the same points.
    while (!code && skip_to_text(&s.c, '#')) code = read_face(&s, 0, 0);
    return code;
}
