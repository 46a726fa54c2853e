// Results: JSON lines and CSV for programs. One record is one line; with the shapes and poses it is enough to check the
// answer again. Numbers have 17 digits, so that they are read as the same doubles.
#include "io/results/record.h"

/// Columns of CSV that come last.
#define LATE ((unsigned)OVOID_RECORD_SOLIDS | OVOID_RECORD_CONTACTS | OVOID_RECORD_PROOF)

void ovoid_record_set_solid(ovoid_record *record, const ovoid_body_answer *answer) {
    record->solid = answer;
    record->answer = answer->deciding;
    record->answer.status = answer->status;
    record->answer.limit = answer->limit;
    record->answer.lower = answer->lower;
    record->answer.upper = answer->upper;
}

static record_line make_line(const ovoid_record *record) {
    record_line line = {.record = *record};
    if (record->solid) line.solid = *record->solid;
    return line;
}

static ovoid_code get_code(FILE *file) { return ferror(file) ? OVOID_ERROR_FILE : OVOID_OK; }

ovoid_code ovoid_record_write_json(FILE *file, const ovoid_record *record) {
    size_t items = record->exclusion_count + record->step_count + record->group_count;
    if (items + record_contacts_count_items(record) > OVOID_RECORD_ITEMS_MAX) return OVOID_ERROR_LIMIT;
    const record_line line = make_line(record);
    fields_write_json(file, "\"", (fields_item){&record_table, &line, record_find_bits(&line)});
    fputc('\n', file);
    return get_code(file);
}

// CSV is that of RFC 4180, with "\n" line ends.

ovoid_code ovoid_record_write_csv_header(FILE *file, unsigned fields) {
    const char *before = fields_write_csv_header(file, "", &record_table, (fields & ~LATE) | FIELD_COLUMN);
    before = fields_write_csv_header(file, before, &record_table, fields & OVOID_RECORD_SOLIDS);
    before = fields_write_csv_header(file, before, &record_table, fields & OVOID_RECORD_CONTACTS);
    fields_write_csv_header(file, before, &record_table, fields & OVOID_RECORD_PROOF);
    fputc('\n', file);
    return get_code(file);
}

ovoid_code ovoid_record_write_csv(FILE *file, const ovoid_record *record) {
    const record_line line = make_line(record);
    const fields_item item = {&record_table, &line, record_find_bits(&line)};
    const unsigned fields = record->fields;
    const char *before = fields_write_csv(file, "", item, (fields & ~LATE) | FIELD_COLUMN);
    before = fields_write_csv(file, before, item, fields & OVOID_RECORD_SOLIDS);
    before = fields_write_csv(file, before, item, fields & OVOID_RECORD_CONTACTS);
    fields_write_csv(file, before, item, fields & OVOID_RECORD_PROOF);
    fputc('\n', file);
    return get_code(file);
}
