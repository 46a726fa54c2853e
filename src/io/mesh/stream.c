// Records: a letter, then numbers in this machine's format, since both ends are the same program.
//   'P' length bytes          a part
//   'M'                       a mesh: its points follow
//   'V' x y z                 a point
//   'F' count indices         a face over the mesh's points
//   'Z' code length bytes     the end
// Equal points of a part are merged as they are read.
#include "io/mesh/stream.h"

#include <stdlib.h>
#include <string.h>

// ---- writing

static void flush(record_sink *sink) {
    if (sink->used && !sink->failed) sink->failed = !sink->write(sink->context, sink->buffer, sink->used);
    sink->used = 0;
}

static void put(record_sink *sink, const void *data, size_t size) {
    const char *at = data;
    while (size) {
        if (sink->used == sizeof sink->buffer) flush(sink);
        size_t room = sizeof sink->buffer - sink->used, n = size < room ? size : room;
        memcpy(sink->buffer + sink->used, at, n);
        sink->used += n;
        at += n;
        size -= n;
    }
}

static void put_u32(record_sink *sink, uint32_t value) { put(sink, &value, sizeof value); }

static void put_text(record_sink *sink, const char *text, size_t length) {
    if (length > RECORD_TEXT_MAX) length = RECORD_TEXT_MAX;
    put_u32(sink, (uint32_t)length);
    put(sink, text, length);
}

void record_write_part(record_sink *sink, const char *name, size_t length) {
    put(sink, "P", 1);
    put_text(sink, name, length);
}

void record_write_mesh(record_sink *sink) { put(sink, "M", 1); }

void record_write_point(record_sink *sink, const double xyz[3]) {
    put(sink, "V", 1);
    put(sink, xyz, 3 * sizeof *xyz);
}

void record_write_face(record_sink *sink, const unsigned *corners, uint32_t count) {
    put(sink, "F", 1);
    put_u32(sink, count);
    for (uint32_t i = 0; i < count; i++) put_u32(sink, corners[i]);
}

void record_write_end(record_sink *sink, ovoid_code code, const char *text) {
    put(sink, "Z", 1);
    put_u32(sink, (uint32_t)code);
    put_text(sink, text, strlen(text));
    flush(sink);
}

// ---- reading

/// The state of reading, and the mesh that is filled.
typedef struct record_reader {
    mesh_reader *reader;
    const record_source *source;
    mesh_part *part;
    point_table table;
    uint32_t *map; ///< of the present mesh: the index in the part of each of its points
    size_t map_count, map_capacity;
    size_t at, end;
    unsigned char buffer[1 << 16];
} record_reader;

/// The internal code for a source that ended early.
#define RECORD_CUT ((ovoid_code)-1)

static ovoid_code get(record_reader *r, void *data, size_t size) {
    char *to = data;
    while (size) {
        if (r->at == r->end) {
            ptrdiff_t n = r->source->read(r->source->context, r->buffer, sizeof r->buffer);
            if (n <= 0) return RECORD_CUT;
            r->at = 0;
            r->end = (size_t)n;
        }
        size_t n = r->end - r->at < size ? r->end - r->at : size;
        memcpy(to, r->buffer + r->at, n);
        r->at += n;
        to += n;
        size -= n;
    }
    return OVOID_OK;
}

static ovoid_code fail_records(record_reader *r) {
    return io_fail(r->reader->error, OVOID_ERROR_FORMAT, (where){r->reader->path, 0, -1},
                   "its importer gave records that make no sense: the file is damaged or hostile");
}

static ovoid_code get_text(record_reader *r, char text[RECORD_TEXT_MAX + 1], uint32_t *length) {
    ovoid_code code = get(r, length, sizeof *length);
    if (!code && *length > RECORD_TEXT_MAX) code = fail_records(r);
    if (!code) code = get(r, text, *length);
    if (!code) text[*length] = 0;
    return code;
}

static ovoid_code get_part(record_reader *r) {
    char name[RECORD_TEXT_MAX + 1];
    uint32_t length;
    ovoid_code code = get_text(r, name, &length);
    if (code) return code;
    r->part = mesh_add_part(r->reader, name, length);
    r->map_count = 0;
    free(r->table.slots);
    r->table = (point_table){.slots = NULL};
    return r->part ? OVOID_OK : OVOID_ERROR_MEMORY;
}

static ovoid_code get_point(record_reader *r) {
    double xyz[3];
    uint32_t index;
    ovoid_code code = get(r, xyz, sizeof xyz);
    if (!code && !r->part) code = fail_records(r);
    where at = {r->reader->path, 0, (int64_t)r->map_count};
    if (!code) code = mesh_add_merged_point(r->reader, r->part, &r->table, xyz, at, &index);
    if (code) return code;
    if (r->reader->mesh->index_count++ >= MESH_INDICES_MAX)
        return io_fail(r->reader->error, OVOID_ERROR_LIMIT, at, "more than %d points and corners", MESH_INDICES_MAX);
    if (!array_reserve((void **)&r->map, &r->map_capacity, r->map_count, sizeof *r->map))
        return io_fail_memory(r->reader->error, r->reader->path);
    r->map[r->map_count++] = index;
    return OVOID_OK;
}

static ovoid_code get_face(record_reader *r) {
    uint32_t count, corner;
    ovoid_code code = get(r, &count, sizeof count);
    if (!code && !r->part) code = fail_records(r);
    for (uint32_t i = 0; i < count && !code; i++) {
        code = get(r, &corner, sizeof corner);
        if (!code && corner >= r->map_count)
            code = io_fail(r->reader->error, OVOID_ERROR_INDEX, (where){r->reader->path, 0, (int64_t)corner},
                           "there is no vertex %u; the mesh has %zu", corner, r->map_count);
        if (!code) code = mesh_add_index(r->reader, r->part, r->map[corner]);
    }
    return code ? code : mesh_end_face(r->reader, r->part, count);
}

// Makes the importer's message one line without control characters.
static void clean_words(char *text) {
    text[strcspn(text, "\r\n")] = 0;
    for (; *text; text++)
        if ((unsigned char)*text < 0x20 || *text == 0x7f) *text = '?';
}

static ovoid_code get_end(record_reader *r) {
    char text[RECORD_TEXT_MAX + 1];
    uint32_t code, length;
    ovoid_code got = get(r, &code, sizeof code);
    if (!got) got = get_text(r, text, &length);
    if (got || code == OVOID_OK) return got;
    if (code > OVOID_ERROR_PROOF) return fail_records(r);
    clean_words(text);
    return io_fail(r->reader->error, (ovoid_code)code, (where){r->reader->path, 0, -1}, "%s", text);
}

// Reads a record; *ended: it was the last.
static ovoid_code get_record(record_reader *r, int *ended) {
    unsigned char letter;
    ovoid_code code = get(r, &letter, 1);
    if (code) return code;
    switch (letter) {
    case 'P': return get_part(r);
    case 'M': r->map_count = 0; return OVOID_OK;
    case 'V': return get_point(r);
    case 'F': return get_face(r);
    case 'Z':
        code = get_end(r);
        *ended = code != RECORD_CUT;
        return code;
    default: return fail_records(r);
    }
}

ovoid_code record_read_mesh(mesh_reader *reader, const record_source *source, int *ended) {
    record_reader *r = malloc(sizeof *r);
    *ended = 0;
    if (!r) {
        *ended = 1;
        return io_fail_memory(reader->error, reader->path);
    }
    *r = (record_reader){.reader = reader, .source = source};
    ovoid_code code = OVOID_OK;
    while (!code && !*ended) code = get_record(r, ended);
    if (code && code != RECORD_CUT) *ended = 1;
    free(r->table.slots);
    free(r->map);
    free(r);
    return code == RECORD_CUT ? OVOID_ERROR_FORMAT : code;
}
