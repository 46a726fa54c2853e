// The proof of a decomposition as one line of JSON, written, and read strictly.
#include "io/json.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// What the line holds.
typedef struct proof_line {
    uint64_t version, triangles, parts;
    ovoid_decomposition_length uncovered, excess;
} proof_line;

static const char wrong_keys[] = "lacks a key, or has another one";

#define LENGTH(member) FIELD_AT(ovoid_decomposition_length, member)
static const field length_fields[] = {
    {"lower", FIELD_FINITE, LENGTH(lower), .wrong = WRONG_NUMBER},
    {"upper", FIELD_FINITE, LENGTH(upper), .wrong = WRONG_NUMBER},
    {"point", FIELD_VECTOR, LENGTH(point), .wrong = "must be a point of three numbers"},
    {"part", FIELD_WHOLE, LENGTH(part), .wrong = "must be the number of a part"},
};
static const field_table length = FIELD_TABLE_READ(ovoid_decomposition_length, length_fields, wrong_keys, wrong_keys);

#define LINE(member) FIELD_AT(proof_line, member)
static const field line_fields[] = {
    {"decomposition", FIELD_WHOLE, LINE(version), .wrong = "must be the version, 1"},
    {"triangles", FIELD_WHOLE, LINE(triangles), .wrong = WRONG_WHOLE},
    {"parts", FIELD_WHOLE, LINE(parts), .wrong = WRONG_WHOLE},
    {"uncovered", FIELD_OBJECT, LINE(uncovered), .table = &length},
    {"excess", FIELD_OBJECT, LINE(excess), .table = &length},
};
static const field_table line_table = FIELD_TABLE_READ(proof_line, line_fields, wrong_keys, wrong_keys);

// A lower bound of 0 needs no point.
static ovoid_decomposition_length make_length(ovoid_decomposition_length l) {
    return l.lower > 0 ? l : (ovoid_decomposition_length){.lower = l.lower, .upper = l.upper};
}

ovoid_code ovoid_decomposition_write_json(FILE *file, const ovoid_decomposition *decomposition,
                                          const ovoid_decomposition_proof *proof) {
    const proof_line line = {1, ovoid_solid_get_report(decomposition->solid).triangles, decomposition->part_count,
                             make_length(proof->uncovered), make_length(proof->excess)};
    fields_write_json(file, "\"", (fields_item){&line_table, &line, 0});
    fputc('\n', file);
    return ferror(file) ? OVOID_ERROR_FILE : OVOID_OK;
}

static int has_point(const ovoid_decomposition_length *l) { return !isnan(l->point.x + l->point.y + l->point.z); }

static ovoid_code read_proof(json_t *root, where at, ovoid_decomposition_record *record, ovoid_error *error) {
    fields_reader reader = {.key = "the proof"};
    proof_line line = {0};
    const char *wrong = fields_read(&reader, root, &line_table, &line);
    if (wrong == wrong_keys) reader.key = "the proof";
    if (!wrong && line.version != 1) reader.key = "the proof", wrong = "is of another version than 1";
    if (!wrong && (!has_point(&line.uncovered) || !has_point(&line.excess)))
        reader.key = "point", wrong = "must be a point of three numbers";
    if (wrong) return io_fail(error, OVOID_ERROR_FORMAT, at, "%.40s %s", reader.key, wrong);
    record->proof.uncovered = line.uncovered;
    record->proof.excess = line.excess;
    record->triangles = line.triangles;
    record->parts = line.parts;
    return OVOID_OK;
}

ovoid_code ovoid_decomposition_read_json(const char *path, ovoid_decomposition_record *record, ovoid_error *error) {
    bytes file;
    json_error_t why;
    *record = (ovoid_decomposition_record){0};
    ovoid_code code = bytes_read_input(path, OVOID_RECORD_SIZE_MAX, &file, error);
    if (code) return code;
    json_t *root = json_load(bytes_skip_mark(file), JSON_REJECT_DUPLICATES | JSON_DECODE_INT_AS_REAL, &why);
    if (root)
        code = read_proof(root, (where){path, 1, -1}, record, error);
    else if ((code = json_get_failure(&why)) == OVOID_ERROR_MEMORY)
        code = io_fail_memory(error, path);
    else
        code = io_fail(error, code, (where){path, why.line, -1}, "JSON: %s", why.text);
    json_decref(root);
    free(file.data);
    return code;
}

int ovoid_decomposition_is_proof(const char *path) {
    static const char begin[] = "{\"decomposition\"";
    char text[sizeof begin] = "";
    FILE *file = strcmp(path, "-") == 0 ? NULL : fopen(path, "rb");
    size_t size = file ? fread(text, 1, sizeof begin - 1, file) : 0;
    if (file) (void)fclose(file); // it was read
    return size == sizeof begin - 1 && strcmp(text, begin) == 0;
}
