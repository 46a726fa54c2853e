// STL: triangles without shared vertices, as text or binary. Equal points are merged, so that the faces share vertices
// as in any other format; triangles that lose an edge by it (two corners were equal) are left out: the surface stays as
// it was. Linear in the file.
#include "io/mesh/readers.h"

#include "io/mesh/cursor.h"

#include <stdlib.h>
#include <string.h>

enum { HEADER = 84, TRIANGLE = 50 };

static uint32_t read_u32(const char *at) {
    const unsigned char *b = (const unsigned char *)at;
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

// A file that begins with "solid" is text, unless it has the size a binary file must have or holds a zero byte early
// on.
static int is_text(bytes file) {
    if (file.size < 6 || !text_begins_with(file.data, file.data + file.size, "solid")) return 0;
    if (!is_blank(file.data[5]) && file.data[5] != '\n') return 0;
    if (file.size >= HEADER && file.size == HEADER + (uint64_t)TRIANGLE * read_u32(file.data + 80)) return 0;
    return memchr(file.data, 0, file.size < 512 ? file.size : 512) == NULL;
}

int mesh_is_stl(bytes file) {
    if (is_text(file)) return 1;
    return file.size > HEADER && file.size == HEADER + (uint64_t)TRIANGLE * read_u32(file.data + 80);
}

static ovoid_code add_triangle(mesh_reader *reader, mesh_part *part, const uint32_t v[3]) {
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) return OVOID_OK;
    for (int k = 0; k < 3; k++) {
        ovoid_code code = mesh_add_index(reader, part, v[k]);
        if (code) return code;
    }
    return mesh_end_face(reader, part, 3);
}

// ---- binary: 80 bytes, a count, then 50 bytes a triangle: normal, three corners, two bytes of anything

static ovoid_code read_triangle(mesh_reader *reader, mesh_part *part, point_table *table, size_t t) {
    const char *at = reader->file.data + HEADER + TRIANGLE * t + 12;
    uint32_t v[3];
    for (int k = 0; k < 3; k++) {
        double xyz[3];
        for (int j = 0; j < 3; j++, at += 4) {
            uint32_t bits = read_u32(at);
            float f;
            memcpy(&f, &bits, sizeof f);
            xyz[j] = (double)f;
        }
        where place = {reader->path, 0, (int64_t)t};
        ovoid_code code = mesh_add_merged_point(reader, part, table, xyz, place, &v[k]);
        if (code) return code;
    }
    return add_triangle(reader, part, v);
}

static ovoid_code read_binary(mesh_reader *reader) {
    where at = {reader->path, 0, -1};
    size_t size = reader->file.size;
    if (size < HEADER) return io_fail(reader->error, OVOID_ERROR_FORMAT, at, "%zu bytes are no STL file", size);
    uint32_t promised = read_u32(reader->file.data + 80);
    uint64_t needed = HEADER + (uint64_t)TRIANGLE * promised;
    if (size < needed)
        return io_fail(reader->error, OVOID_ERROR_FORMAT, at,
                       "truncated: %lu triangles take %llu bytes, the file has %zu; save or fetch it again",
                       (unsigned long)promised, (unsigned long long)needed, size);
    if (size > needed)
        return io_fail(reader->error, OVOID_ERROR_FORMAT, at,
                       "bad count: %lu triangles take %llu bytes, the file has %zu; if the last %llu are not wanted: "
                       "truncate -s %llu FILE",
                       (unsigned long)promised, (unsigned long long)needed, size, (unsigned long long)(size - needed),
                       (unsigned long long)needed);
    mesh_part *part = mesh_add_part(reader, "", 0);
    if (!part) return OVOID_ERROR_MEMORY;
    point_table table = {.slots = NULL};
    ovoid_code code = OVOID_OK;
    for (size_t t = 0; t < promised && !code; t++) code = read_triangle(reader, part, &table, t);
    free(table.slots);
    return code;
}

// ---- text

/// A text file as it is read.
typedef struct stl_text {
    mesh_reader *reader;
    cursor c;
    mesh_part *part;
    point_table table;
} stl_text;

static where here(const stl_text *s) { return (where){s->reader->path, s->c.line, -1}; }

// The next word must be `name`.
static ovoid_code expect(stl_text *s, const char *name) {
    const char *word = s->c.at;
    size_t length = skip_to_text(&s->c, 0) ? cursor_read_word(&s->c, &word) : 0;
    if (word_is(word, length, name)) return OVOID_OK;
    where at = here(s);
    if (!length)
        return io_fail(s->reader->error, OVOID_ERROR_FORMAT, at, "truncated: \"%s\" is missing at the end", name);
    return io_fail(s->reader->error, OVOID_ERROR_FORMAT, at, "\"%.*s\" stands where \"%s\" must be",
                   (int)(length < 40 ? length : 40), word, name);
}

static ovoid_code read_text_vertex(stl_text *s, uint32_t *index) {
    ovoid_code code = expect(s, "vertex");
    double xyz[3];
    if (!code) code = cursor_read_xyz(&s->c, s->reader->path, xyz, s->reader->error);
    if (code) return code;
    return mesh_add_merged_point(s->reader, s->part, &s->table, xyz, here(s), index);
}

// Reads a facet after its first word: normal (three words of any kind: it is not used), three corners, the end words.
static ovoid_code read_facet(stl_text *s) {
    ovoid_code code = expect(s, "normal");
    const char *word;
    for (int k = 0; k < 3; k++) cursor_read_word(&s->c, &word);
    uint32_t v[3] = {0, 0, 0};
    if (!code) code = expect(s, "outer");
    if (!code) code = expect(s, "loop");
    for (int k = 0; k < 3 && !code; k++) code = read_text_vertex(s, &v[k]);
    if (!code) code = expect(s, "endloop");
    if (!code) code = expect(s, "endfacet");
    return code ? code : add_triangle(s->reader, s->part, v);
}

// Reads a solid from its name to "endsolid". With parts it becomes a part of its own, else it is added to the first.
static ovoid_code read_solid(stl_text *s) {
    skip_blanks(&s->c);
    const char *name = s->c.at;
    while (!is_line_end(&s->c)) s->c.at++;
    const char *end = s->c.at;
    while (end > name && is_blank(end[-1])) end--;
    if (!s->part || s->reader->parts) {
        s->part = mesh_add_part(s->reader, name, (size_t)(end - name));
        if (!s->part) return OVOID_ERROR_MEMORY;
        free(s->table.slots);
        s->table = (point_table){.slots = NULL};
    }
    for (;;) {
        const char *word = s->c.at;
        size_t length = skip_to_text(&s->c, 0) ? cursor_read_word(&s->c, &word) : 0;
        if (word_is(word, length, "endsolid")) break;
        s->c.at -= length;
        ovoid_code code = expect(s, length ? "facet" : "endsolid");
        if (!code) code = read_facet(s);
        if (code) return code;
    }
    skip_line(&s->c);
    return OVOID_OK;
}

static ovoid_code read_text(mesh_reader *reader) {
    const char *data = reader->file.data;
    stl_text s = {.reader = reader, .c = {data, data + reader->file.size, 1}};
    ovoid_code code = OVOID_OK;
    while (!code && skip_to_text(&s.c, 0)) {
        code = expect(&s, "solid");
        if (!code) code = read_solid(&s);
    }
    free(s.table.slots);
    return code;
}

ovoid_code mesh_read_stl(mesh_reader *reader) {
    return is_text(reader->file) ? read_text(reader) : read_binary(reader);
}
