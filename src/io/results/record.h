// The table of the records of results, which the writers and the reader share.
#ifndef OVOID_IO_RESULTS_RECORD_H
#define OVOID_IO_RESULTS_RECORD_H

#include "io/fields.h"

/// A record with what its pointers point at, so that each field has a place.
typedef struct record_line {
    ovoid_record record;
    ovoid_body_answer solid; ///< of record.solid; zero where there is none
} record_line;

/// All keys of a line of JSON, in their order; the columns of CSV are those in the same order but for those of
/// OVOID_RECORD_SOLIDS and OVOID_RECORD_PROOF, which come last.
extern const field_table record_table;

/// Keys that are there together, or not at all.
enum {
    RECORD_TIME = 1,
    RECORD_IMPACT = 2,
    RECORD_PART_A = 4,
    RECORD_PART_B = 8,
    RECORD_TRIANGLE_A = 16,
    RECORD_TRIANGLE_B = 32,
    RECORD_MARGIN = 64,
    RECORD_INSIDE = 128,
    RECORD_COMPONENT = 256,
    RECORD_COMMON = 512,
    RECORD_KINDS = 1024,
    RECORD_ALLOWANCE_A = 2048,
    RECORD_ALLOWANCE_B = 4096,
    RECORD_VOLUMES = 8192,
    RECORD_POINTS = 1 << 14,
    RECORD_INNER_A = 1 << 15,
    RECORD_INNER_B = 1 << 16,
    RECORD_COVER = 1 << 17,
    RECORD_SURFACES = 1 << 18,
    RECORD_PARTING = 1 << 19,
    RECORD_CONTACTS = 1 << 20,
    RECORD_CONTACT_LIMIT = 1 << 21,
    RECORD_CONTACT_LIST = 1 << 22
};

/// A cover in JSON. record_cover_read: what is wrong, or NULL. *cover, which is NULL before, is the caller's to free:
/// one block, also where something is wrong.
void record_cover_write(FILE *file, const char *quote, const ovoid_cover *cover);
const char *record_cover_read(const struct json_t *value, const ovoid_cover **cover);

/// The table of ovoid_record_contact.
extern const field_table record_contact_table;
/// Sets what follows from the fields of contacts that were read; what is wrong, or NULL.
const char *record_contacts_settle(ovoid_record *record);
/// Frees the covers of a record that was read and of its contacts, and leaves it without them.
void record_covers_clear(ovoid_record *record);
/// The room that contacts take in a line, in items of OVOID_RECORD_ITEMS_MAX.
size_t record_contacts_count_items(const ovoid_record *record);

/// The bits of what the line has.
uint64_t record_find_bits(const record_line *line);

/// 1 for a record of an impact, 0 for one of a frame.
int record_is_impact(const ovoid_record *record);

/// What the bracket says of the record's margin: "yes" (within), "no" (farther), "at" (the bracket is as narrow as
/// asked and holds the margin) or "unproven"; "" without a margin.
const char *record_find_within(const ovoid_record *record);

/// 1 where a body of the kind has triangles, of which one decides.
int record_has_triangles(ovoid_mesh_kind kind);

#endif
