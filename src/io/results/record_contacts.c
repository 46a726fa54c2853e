// The contacts of a record: of each pair of parts the manifold, its points and the areas of its polygon. A file does
// not hold the memory of a manifold, which claims nothing, but for its flags: the order in which both bodies were
// taken, and so the last bits of all numbers.
#include "io/json.h"
#include "io/results/record.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *name_status(int i) { return ovoid_status_get_name((ovoid_status)i); }
static const char *name_limit(int i) { return ovoid_limit_get_name((ovoid_limit)i); }
static const char *name_axis(int i) { return ovoid_manifold_axis_get_name((ovoid_manifold_axis)i); }

static const field_names statuses = {name_status, OVOID_UNDECIDED, OVOID_OVERLAPPING},
                         limits = {name_limit, OVOID_LIMIT_NONE, OVOID_LIMIT_ALLOWANCE},
                         axes = {name_axis, OVOID_MANIFOLD_FACE_A, OVOID_MANIFOLD_FREE};

#define MANIFOLD(item) ((ovoid_record_contact *)(item))->manifold

// ---- members that are smaller than the table's kinds

static void write_proof(FILE *file, const char *quote, const void *item) {
    const ovoid_record_contact *contact = item;
    fprintf(file, "%s%s%s", quote, ovoid_manifold_proof_get_name((ovoid_manifold_proof)contact->manifold.proof), quote);
}

static const char *read_proof(const json_t *value, void *item) {
    const char *text = json_string_value(value);
    for (int i = OVOID_MANIFOLD_PROOF_NONE; text && i <= OVOID_MANIFOLD_PROOF_NORMAL; i++)
        if (strcmp(ovoid_manifold_proof_get_name((ovoid_manifold_proof)i), text) == 0)
            return MANIFOLD(item).proof = (uint8_t)i, NULL;
    return "is not a proof of a contact";
}

static void write_share(FILE *file, const char *quote, const void *item) {
    (void)quote;
    json_write_number(file, (double)((const ovoid_record_contact *)item)->manifold.share);
}

// Each float has its double; a double that is no float was not written by a writer of results.
static const char *read_share(const json_t *value, void *item) {
    double number = json_number_value(value);
    int is_share = json_is_number(value) && number >= 0 && number <= 1 && (double)(float)number == number;
    if (is_share) MANIFOLD(item).share = (float)number;
    return is_share ? NULL : "must be a share from 0 to 1, of the precision of a float";
}

static void write_cover(FILE *file, const char *quote, const void *item) {
    record_cover_write(file, quote, ((const ovoid_record_contact *)item)->cover);
}

// The cover is the reader's, which frees it with its record.
static const char *read_cover(const json_t *value, void *item) {
    return record_cover_read(value, &((ovoid_record_contact *)item)->cover);
}

static const field_own own_proof = {write_proof, read_proof}, own_share = {write_share, read_share},
                       own_cover = {write_cover, read_cover};

// ---- tables

#define POINT(member) FIELD_AT(ovoid_manifold_point, member)
static const field point_fields[] = {
    {"id", FIELD_WHOLE, POINT(id), .wrong = WRONG_WHOLE},
    {"point_a", FIELD_VECTOR, POINT(point_a), .wrong = WRONG_VECTOR},
    {"point_b", FIELD_VECTOR, POINT(point_b), .wrong = WRONG_VECTOR},
    {"separation", FIELD_FINITE, POINT(separation), .wrong = WRONG_NUMBER},
};
static const field_table points =
    FIELD_TABLE_READ(ovoid_manifold_point, point_fields, "is not that of a point of contact", NULL);

#define CONTACT(member) FIELD_AT(ovoid_record_contact, member)
static const field contact_fields[] = {
    {"part_a", FIELD_WHOLE, CONTACT(part_a), .wrong = WRONG_WHOLE},
    {"part_b", FIELD_WHOLE, CONTACT(part_b), .wrong = WRONG_WHOLE},
    {"status", FIELD_NAME, CONTACT(manifold.status), .names = &statuses, .wrong = "is not a status"},
    {"limit", FIELD_NAME, CONTACT(manifold.limit), .names = &limits, .wrong = "is not a limit"},
    {"lower", FIELD_NUMBER, CONTACT(manifold.lower), .if_null = -INFINITY, .wrong = WRONG_NUMBER},
    {"upper", FIELD_NUMBER, CONTACT(manifold.upper), .if_null = INFINITY, .wrong = WRONG_NUMBER},
    {"normal", FIELD_VECTOR, CONTACT(manifold.normal), .wrong = WRONG_VECTOR},
    {"axis", FIELD_NAME, CONTACT(manifold.axis), .names = &axes, .wrong = "is not an axis of a contact"},
    {"feature_a", FIELD_WHOLE, CONTACT(manifold.feature_a), .wrong = WRONG_WHOLE},
    {"feature_b", FIELD_WHOLE, CONTACT(manifold.feature_b), .wrong = WRONG_WHOLE},
    {"facet_a", FIELD_WHOLE, CONTACT(manifold.facet_a), .wrong = WRONG_WHOLE},
    {"facet_b", FIELD_WHOLE, CONTACT(manifold.facet_b), .wrong = WRONG_WHOLE},
    {"flags", FIELD_WHOLE, CONTACT(manifold.memory.flags), .wrong = WRONG_WHOLE},
    {"corners", FIELD_WHOLE, CONTACT(manifold.corners), .wrong = WRONG_WHOLE},
    {"share", FIELD_OWN, .own = &own_share},
    {"inner", FIELD_FINITE, CONTACT(inner), .wrong = WRONG_NUMBER},
    {"outer", FIELD_FINITE, CONTACT(outer), .wrong = WRONG_NUMBER},
    {"grown", FIELD_FINITE, CONTACT(grown), .wrong = WRONG_NUMBER},
    {"points", FIELD_LIST, CONTACT(points), .count = offsetof(ovoid_record_contact, point_count), .table = &points},
    {"proof", FIELD_OWN, .own = &own_proof},
    {"cover", FIELD_OWN, CONTACT(cover), .bit = FIELD_NOT_ZERO, .own = &own_cover},
};
const field_table record_contact_table =
    FIELD_TABLE_READ(ovoid_record_contact, contact_fields, "is not that of a contact", "is missing of a contact");

// ---- what follows

const char *record_contacts_settle(ovoid_record *record) {
    ovoid_record_contact *contacts = (ovoid_record_contact *)record->contacts;
    for (size_t i = 0; i < record->contact_count; i++) {
        ovoid_record_contact *c = &contacts[i];
        if (!c->point_count || c->point_count > 4) return "must have one to four points each";
        c->manifold.count = (uint8_t)c->point_count;
        for (size_t k = 0; k < c->point_count; k++) c->manifold.id[k] = c->points[k].id;
    }
    return NULL;
}

void record_covers_clear(ovoid_record *record) {
    free((void *)record->cover);
    record->cover = NULL;
    for (size_t i = 0; i < record->contact_count; i++) free((void *)record->contacts[i].cover);
    record->contacts = NULL;
    record->contact_count = 0;
}

size_t record_contacts_count_items(const ovoid_record *record) {
    size_t items = 0;
    for (size_t i = 0; i < record->contact_count; i++) {
        const ovoid_cover *cover = record->contacts[i].cover;
        items += 4 + (cover ? (size_t)cover->point_count / 8 : 0);
    }
    return items;
}
