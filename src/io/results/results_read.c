// Results files, read strictly, as a file to be checked must be. Each line is a JSON object with the keys that
// ovoid_record_write_json writes, each once and no other; every number in the range of its field.
#include "io/json.h"
#include "io/results/record.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct ovoid_results_reader {
    line_source source;
    json_t *json; ///< the last record, whose names point into it
    record_line line;
    fields_reader fields;
};

static ovoid_code load_line(ovoid_results_reader *r, const char *text, size_t length, ovoid_error *error) {
    where at = {r->source.path, r->source.line, -1};
    json_error_t why;
    size_t begin = 0;
    while (begin < length && (text[begin] == ' ' || text[begin] == '\t')) begin++;
    if (begin == length || text[begin] != '{')
        return io_fail(error, OVOID_ERROR_FORMAT, at,
                       "no JSON object; results are read as JSON Lines, which have proofs, not as CSV or a table");
    json_decref(r->json);
    r->json = json_load((bytes){(char *)text, length}, JSON_REJECT_DUPLICATES | JSON_DECODE_INT_AS_REAL, &why);
    if (r->json) return OVOID_OK;
    if (json_get_failure(&why) == OVOID_ERROR_MEMORY) return io_fail_memory(error, r->source.path);
    return io_fail(error, json_get_failure(&why), at, "JSON, column %d: %s", why.column, why.text);
}

// What keys that are there say of the record: which fields it has.
static void set_fields(record_line *line, uint64_t bits) {
    ovoid_record *r = &line->record;
    if (bits & RECORD_TIME) r->fields |= OVOID_RECORD_TIME;
    if (bits & RECORD_IMPACT) r->fields |= OVOID_RECORD_TIME | OVOID_RECORD_IMPACT;
    if (bits & RECORD_IMPACT && isnan(r->frame)) r->frame = 0; // its key is missing
    if (bits & (RECORD_PART_A | RECORD_PART_B)) r->fields |= OVOID_RECORD_PARTS;
    if (bits & RECORD_MARGIN) r->fields |= OVOID_RECORD_MARGIN;
    if (bits & RECORD_VOLUMES) r->fields |= OVOID_RECORD_MESHES;
    if (bits & (RECORD_CONTACTS | RECORD_CONTACT_LIMIT | RECORD_CONTACT_LIST)) r->fields |= OVOID_RECORD_CONTACTS;
}

// The answer of solids: the deciding pair's, but for the bracket, status and limit of its surfaces.
static void set_solid(record_line *line) {
    ovoid_record *r = &line->record;
    ovoid_body_answer *found = &line->solid;
    const ovoid_answer surfaces = found->deciding;
    found->deciding = r->answer;
    found->deciding.status = surfaces.status;
    found->deciding.limit = surfaces.limit;
    found->deciding.lower = surfaces.lower;
    found->deciding.upper = surfaces.upper;
    found->status = r->answer.status;
    found->limit = r->answer.limit;
    found->lower = r->answer.lower;
    found->upper = r->answer.upper;
    // Of a compound beside a solid the deciding part.
    if (r->kind_a == OVOID_MESH_PARTS && r->part_a != OVOID_RECORD_NO_PART) found->part_a = r->part_a;
    if (r->kind_b == OVOID_MESH_PARTS && r->part_b != OVOID_RECORD_NO_PART) found->part_b = r->part_b;
    r->solid = found;
}

// The keys that are there must be those that a writer of this record writes.
static const char *check_together(ovoid_results_reader *r, uint64_t found) {
    const ovoid_record *record = &r->line.record;
    uint64_t bits;
    set_fields(&r->line, found);
    if (found & RECORD_SURFACES) set_solid(&r->line);
    bits = record_find_bits(&r->line);
    // Records without kinds are of hulls.
    if (!(found & (RECORD_KINDS | RECORD_VOLUMES | RECORD_ALLOWANCE_A | RECORD_ALLOWANCE_B)))
        bits &= ~(uint64_t)RECORD_KINDS;
    const char *wrong = fields_compare(&r->fields, r->json, &record_table, bits);
    if (wrong) return wrong;
    r->fields.key = "contacts";
    if ((wrong = record_contacts_settle(&r->line.record)) != NULL) return wrong;
    const char *word = json_string_value(json_object_get(r->json, r->fields.key = "within"));
    if (word && strcmp(word, record_find_within(record)) != 0)
        return "is not what the bracket and the limit say of the margin";
    if (!record->solid || record_has_triangles(record->kind_a) || record_has_triangles(record->kind_b)) return NULL;
    r->fields.key = "kind_a";
    return "must say what is a solid or a surface, where a proof has \"surfaces\"";
}

static ovoid_code read_record(ovoid_results_reader *r, const char *text, size_t length, ovoid_error *error) {
    record_covers_clear(&r->line.record);
    fields_reader_clear(&r->fields);
    r->line = (record_line){.record = {.frame = NAN, .part_a = OVOID_RECORD_NO_PART, .part_b = OVOID_RECORD_NO_PART}};
    ovoid_code code = load_line(r, text, length, error);
    if (code) return code;
    const char *wrong = fields_read(&r->fields, r->json, &record_table, &r->line);
    if (r->fields.is_memory_out) return io_fail_memory(error, r->source.path);
    if (wrong == record_table.missing && strcmp(r->fields.key, "proof") == 0)
        wrong = "is missing: nothing can be checked without it";
    if (!wrong) wrong = check_together(r, r->fields.bits);
    if (!wrong) return OVOID_OK;
    where at = {r->source.path, r->source.line, -1};
    return io_fail(error, OVOID_ERROR_FORMAT, at, "\"%.40s\" %s", r->fields.key, wrong);
}

ovoid_results_reader *ovoid_results_reader_open(const char *path, ovoid_error *error) {
    ovoid_results_reader *reader = calloc(1, sizeof *reader);
    if (!reader) {
        io_fail_memory(error, path);
        return NULL;
    }
    if (!line_source_open(&reader->source, path, error)) {
        reader->source.most = OVOID_RECORD_SIZE_MAX;
        return reader;
    }
    free(reader);
    return NULL;
}

int ovoid_results_reader_read(ovoid_results_reader *reader, ovoid_record *record, ovoid_error *error) {
    const char *line;
    size_t length;
    int got = line_source_next(&reader->source, &line, &length, error);
    if (got <= 0) return got;
    if (read_record(reader, line, length, error)) return -1;
    *record = reader->line.record;
    return 1;
}

int64_t ovoid_results_reader_get_line(const ovoid_results_reader *reader) { return reader->source.line; }

void ovoid_results_reader_close(ovoid_results_reader *reader) {
    if (!reader) return;
    line_source_close(&reader->source);
    json_decref(reader->json);
    record_covers_clear(&reader->line.record);
    fields_reader_clear(&reader->fields);
    free(reader);
}
