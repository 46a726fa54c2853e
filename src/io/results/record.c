// The fields of a record of results: each stands here once.
//
// "status", "limit", "lower" and "upper" are those of the bodies. Of solids the proof's "surfaces" are those of the two
// surfaces, and its "parting" the direction along which the bodies' boxes show `lower`, where that is 0 or below.
#include "io/results/record.h"
#include "io/json.h"
#include "io/text.h"

#include <math.h>
#include <string.h>

// ---- names

static const char *name_status(int i) { return ovoid_status_get_name((ovoid_status)i); }
static const char *name_limit(int i) { return ovoid_limit_get_name((ovoid_limit)i); }
static const char *name_stage(int i) { return ovoid_stage_get_name((ovoid_stage)i); }
static const char *name_proof(int i) { return ovoid_proof_kind_get_name((ovoid_proof_kind)i); }
static const char *name_kind(int i) { return ovoid_mesh_kind_get_name((ovoid_mesh_kind)i); }
static const char *name_frame(int i) { return i == OVOID_STEP_A ? "a" : "b"; }
static const char *name_inside(int i) {
    static const char *const names[] = {"", "a in b", "b in a", "common point"};
    return names[i];
}

static const field_names statuses = {name_status, OVOID_UNDECIDED, OVOID_OVERLAPPING},
                         limits = {name_limit, OVOID_LIMIT_NONE, OVOID_LIMIT_ALLOWANCE},
                         stages = {name_stage, OVOID_STAGE_NONE, OVOID_STAGE_REFINE},
                         proofs = {name_proof, OVOID_PROOF_NONE, OVOID_PROOF_BALLS},
                         kinds = {name_kind, OVOID_MESH_HULL, OVOID_MESH_SURFACE},
                         frames = {name_frame, OVOID_STEP_A, OVOID_STEP_B},
                         insides = {name_inside, OVOID_BODY_A_INSIDE, OVOID_BODY_COMMON_POINT};

const char *ovoid_mesh_kind_get_name(ovoid_mesh_kind kind) {
    static const char *const names[] = {"hull", "parts", "solid", "surface"};
    return (unsigned)kind < sizeof names / sizeof *names ? names[kind] : "unknown";
}

// ---- bodies: names or indices

static void write_body(FILE *file, const char *quote, const char *name, size_t index) {
    if (!name)
        fprintf(file, "%zu", index);
    else if (quote)
        ovoid_text_write_json(file, name);
    else
        ovoid_text_write_csv(file, name);
}

static void write_a(FILE *file, const char *quote, const void *line) {
    const ovoid_record *r = line;
    write_body(file, quote, r->a, r->index_a);
}

static void write_b(FILE *file, const char *quote, const void *line) {
    const ovoid_record *r = line;
    write_body(file, quote, r->b, r->index_b);
}

static const char *read_body(const json_t *value, const char **name, size_t *index) {
    double whole = 0;
    *name = json_string_value(value);
    if (!*name && !json_read_whole(value, 0x1p53, &whole)) return "must be a name or an index";
    *index = (size_t)whole;
    return NULL;
}

static const char *read_a(const json_t *value, void *line) {
    ovoid_record *r = line;
    return read_body(value, &r->a, &r->index_a);
}

static const char *read_b(const json_t *value, void *line) {
    ovoid_record *r = line;
    const char *wrong = read_body(value, &r->b, &r->index_b);
    return wrong || !r->a == !r->b ? wrong : "must be a name or an index like \"a\"";
}

// ---- what the bracket says of the margin

static void write_within(FILE *file, const char *quote, const void *line) {
    const char *q = quote ? quote : "";
    fprintf(file, "%s%s%s", q, record_find_within(line), q);
}

// The bracket is not read yet: results_read.c compares the word with it.
static const char *read_within(const json_t *value, void *line) {
    (void)line;
    return json_is_string(value) ? NULL : "is not what the bracket and the limit say of the margin";
}

// ---- covers

static void write_cover(FILE *file, const char *q, const void *line) {
    record_cover_write(file, q, ((const ovoid_record *)line)->cover);
}

static const char *read_cover(const json_t *value, void *line) {
    return record_cover_read(value, &((ovoid_record *)line)->cover);
}

static const field_own own_a = {write_a, read_a}, own_b = {write_b, read_b}, own_within = {write_within, read_within},
                       own_cover = {write_cover, read_cover};

// ---- tables

#define TIMES "must be a number, as all of an impact"
#define RANGES "must have ranges of two whole numbers"
#define TRIANGLE "goes with a solid or a surface, and with a proof that has \"surfaces\""
#define POINTS "must come with \"a\", \"b\", \"weight_a\" and \"weight_b\", all four of them"
#define INSIDE "must be \"a in b\" or \"b in a\", with a component, or \"common point\", with \"common\""
#define KINDS "is missing: both bodies have a kind, and allowances and volumes come with kinds"

#define EXCLUSION(member) FIELD_AT(ovoid_exclusion, member)
static const field exclusion_fields[] = {
    {"a", FIELD_RANGE, EXCLUSION(first_a), .wrong = RANGES},
    {"b", FIELD_RANGE, EXCLUSION(first_b), .wrong = RANGES},
    {"normal", FIELD_VECTOR, EXCLUSION(normal), .wrong = WRONG_VECTOR},
    {"normal_low", FIELD_VECTOR, EXCLUSION(normal_low), .bit = FIELD_NOT_ZERO, .wrong = WRONG_VECTOR},
    {"lower", FIELD_NUMBER, EXCLUSION(lower), .if_null = -INFINITY, .wrong = WRONG_NUMBER},
};
static const field_table exclusions =
    FIELD_TABLE_READ(ovoid_exclusion, exclusion_fields, "is not that of an exclusion", "is not that of an exclusion");

#define STEP(member) FIELD_AT(ovoid_step, member)
static const field step_fields[] = {
    {"until", FIELD_NUMBER, STEP(until), .if_null = NAN, .wrong = WRONG_NUMBER},
    {"normal", FIELD_VECTOR, STEP(normal), .wrong = WRONG_VECTOR},
    {"frame", FIELD_NAME, STEP(frame), .bit = FIELD_NOT_ZERO, .names = &frames,
     .wrong = "of a step must be \"a\" or \"b\""},
};
static const field_table steps =
    FIELD_TABLE_READ(ovoid_step, step_fields, "is not that of a step", "is not that of a step");

#define GROUP(member) FIELD_AT(ovoid_step_group, member)
static const field group_fields[] = {
    {"a", FIELD_RANGE, GROUP(first_a), .wrong = RANGES},
    {"b", FIELD_RANGE, GROUP(first_b), .wrong = RANGES},
    {"count", FIELD_WHOLE, GROUP(count), .wrong = WRONG_WHOLE},
};
static const field_table groups =
    FIELD_TABLE_READ(ovoid_step_group, group_fields, "is not that of a group", "is not that of a group");

#define SURFACE(member) FIELD_AT(ovoid_answer, member)
#define SURFACES "must be of \"surfaces\" with a status, a limit, lower and upper"
static const field surface_fields[] = {
    {"status", FIELD_NAME, SURFACE(status), .names = &statuses, .wrong = SURFACES},
    {"limit", FIELD_NAME, SURFACE(limit), .names = &limits, .wrong = SURFACES},
    {"lower", FIELD_NUMBER, SURFACE(lower), .if_null = -INFINITY, .wrong = SURFACES},
    {"upper", FIELD_NUMBER, SURFACE(upper), .if_null = INFINITY, .wrong = SURFACES},
};
static const field_table surfaces = FIELD_TABLE_READ(ovoid_answer, surface_fields, SURFACES, SURFACES);

#define RECORD(member) FIELD_AT(record_line, record.member)
#define PROOF(member) FIELD_AT(record_line, record.answer.proof.member)
#define SOLID(member) FIELD_AT(record_line, solid.member)
#define LIST(items, number) RECORD(items), .count = offsetof(record_line, record.number)
#define COUNTED(member) PROOF(member), .count = offsetof(record_line, record.answer.proof.count), .bit = RECORD_POINTS
static const field proof_fields[] = {
    {"normal", FIELD_VECTOR, PROOF(normal), .wrong = WRONG_VECTOR},
    {"normal_low", FIELD_VECTOR, PROOF(normal_low), .bit = FIELD_NOT_ZERO, .wrong = WRONG_VECTOR},
    {"kind", FIELD_NAME, PROOF(kind), .names = &proofs, .wrong = "is not a kind of proof"},
    {"a", FIELD_WHOLES, COUNTED(a), .wrong = "must be vertex indices", .apart = POINTS},
    {"b", FIELD_WHOLES, COUNTED(b), .wrong = "must be vertex indices", .apart = POINTS},
    {"weight_a", FIELD_NUMBERS, COUNTED(weight_a), .wrong = "must be weights", .apart = POINTS},
    {"weight_b", FIELD_NUMBERS, COUNTED(weight_b), .wrong = "must be weights", .apart = POINTS},
    {"inner_a", FIELD_VECTOR, PROOF(inner_a), .bit = RECORD_INNER_A, .wrong = WRONG_VECTOR,
     .apart = "does not go with the kind"},
    {"inner_b", FIELD_VECTOR, PROOF(inner_b), .bit = RECORD_INNER_B, .wrong = WRONG_VECTOR,
     .apart = "does not go with the kind"},
    {"cover", FIELD_OWN, .bit = RECORD_COVER, .own = &own_cover},
    {"exclusions", FIELD_LIST, LIST(exclusions, exclusion_count), .table = &exclusions},
    {"steps", FIELD_LIST, LIST(steps, step_count), .table = &steps},
    {"groups", FIELD_LIST, LIST(groups, group_count), .table = &groups},
    {"surfaces", FIELD_OBJECT, SOLID(deciding), .bit = RECORD_SURFACES, .table = &surfaces},
    {"parting", FIELD_VECTOR, SOLID(parting), .bit = RECORD_PARTING, .wrong = WRONG_VECTOR,
     .apart = "goes with \"surfaces\" and a lower bound of at most 0"},
};
static const field_table proof = FIELD_TABLE_READ(record_line, proof_fields, "does not belong into a proof", NULL);

#define COLUMN .column = FIELD_COLUMN
#define TIMED(name, bits, null, columns_bits)                                                                          \
    RECORD(name), .bit = (bits), .if_null = (null), .column = (columns_bits), .apart = TIMES
#define SIDE(bits) .bit = (bits), .wrong = WRONG_WHOLE, .apart = TRIANGLE, .column = OVOID_RECORD_SOLIDS
#define KIND(member)                                                                                                   \
    RECORD(member), .bit = RECORD_KINDS, .names = &kinds, COLUMN, .wrong = "is not a kind of mesh", .apart = KINDS
#define ALLOWANCE(member, bits)                                                                                        \
    RECORD(member), .bit = (bits), .if_null = NAN, .least = 0x1p-1074, COLUMN, .wrong = "must be a number above 0",    \
                    .apart = "goes with a hull"
#define VOLUME(member)                                                                                                 \
    RECORD(member), .bit = RECORD_VOLUMES, .if_null = NAN, .column = OVOID_RECORD_MESHES,                              \
                    .wrong = "must be a number or null", .apart = "is missing: volumes come together"
#define CONTACT(bits)                                                                                                  \
    .bit = (bits), .column = OVOID_RECORD_CONTACTS,                                                                    \
    .apart = "goes with \"contact_margin\" and \"contact_angle\", and a limit or contacts with one another not"
static const field record_fields[] = {
    {"time", FIELD_FINITE, TIMED(time, RECORD_TIME, 0, OVOID_RECORD_TIME), .wrong = WRONG_NUMBER},
    {"frame", FIELD_FINITE, TIMED(frame, RECORD_IMPACT, 0, OVOID_RECORD_IMPACT), .wrong = TIMES},
    {"free_for", FIELD_FINITE, TIMED(free_for, RECORD_IMPACT, 0, OVOID_RECORD_IMPACT), .wrong = TIMES},
    {"hit_after", FIELD_NUMBER, TIMED(hit_after, RECORD_IMPACT, INFINITY, OVOID_RECORD_IMPACT), .wrong = TIMES},
    {"a", FIELD_OWN, .own = &own_a, COLUMN},
    {"part_a", FIELD_WHOLE, RECORD(part_a), .bit = RECORD_PART_A, COLUMN, .wrong = WRONG_WHOLE},
    {"triangle_a", FIELD_WHOLE, SOLID(part_a), SIDE(RECORD_TRIANGLE_A)},
    {"b", FIELD_OWN, .own = &own_b, COLUMN},
    {"part_b", FIELD_WHOLE, RECORD(part_b), .bit = RECORD_PART_B, COLUMN, .wrong = WRONG_WHOLE},
    {"triangle_b", FIELD_WHOLE, SOLID(part_b), SIDE(RECORD_TRIANGLE_B)},
    {"status", FIELD_NAME, RECORD(answer.status), .names = &statuses, COLUMN, .wrong = "is not a status"},
    {"limit", FIELD_NAME, RECORD(answer.limit), .names = &limits, COLUMN, .wrong = "is not a limit"},
    {"margin", FIELD_FINITE, RECORD(margin), .bit = RECORD_MARGIN, COLUMN,
     .wrong = "must be a number, with \"within\" and of an impact",
     .apart = "must be a number, with \"within\" and of an impact"},
    {"within", FIELD_OWN, .own = &own_within, .bit = RECORD_MARGIN, COLUMN,
     .apart = "is not what the bracket and the limit say of the margin"},
    {"inside", FIELD_NAME, SOLID(inside), .bit = RECORD_INSIDE, .names = &insides, .column = OVOID_RECORD_SOLIDS,
     .wrong = INSIDE, .apart = INSIDE},
    {"common", FIELD_VECTOR, SOLID(common), .bit = RECORD_COMMON, .wrong = WRONG_VECTOR,
     .apart = "goes with \"inside\": \"common point\""},
    {"component", FIELD_WHOLE, SOLID(component), .bit = RECORD_COMPONENT, .wrong = WRONG_WHOLE,
     .apart = "goes with \"inside\": \"a in b\" or \"b in a\""},
    {"lower", FIELD_NUMBER, RECORD(answer.lower), .if_null = -INFINITY, COLUMN, .wrong = WRONG_NUMBER},
    {"upper", FIELD_NUMBER, RECORD(answer.upper), .if_null = INFINITY, COLUMN, .wrong = WRONG_NUMBER},
    {"point_a", FIELD_VECTOR, RECORD(answer.point_a), COLUMN, .wrong = WRONG_VECTOR},
    {"point_b", FIELD_VECTOR, RECORD(answer.point_b), COLUMN, .wrong = WRONG_VECTOR},
    {"normal", FIELD_VECTOR, RECORD(answer.normal), COLUMN, .wrong = WRONG_VECTOR},
    {"stage", FIELD_NAME, RECORD(answer.stage), .names = &stages, COLUMN, .wrong = "is not a stage"},
    {"iterations", FIELD_WHOLE, RECORD(answer.iterations), COLUMN, .wrong = WRONG_WHOLE},
    {"kind_a", FIELD_NAME, KIND(kind_a)},
    {"allowance_a", FIELD_NUMBER, ALLOWANCE(mesh_a.allowance, RECORD_ALLOWANCE_A)},
    {"mesh_volume_a", FIELD_MEASURE, VOLUME(mesh_a.mesh_volume)},
    {"hull_volume_a", FIELD_MEASURE, VOLUME(mesh_a.hull_volume)},
    {"kind_b", FIELD_NAME, KIND(kind_b)},
    {"allowance_b", FIELD_NUMBER, ALLOWANCE(mesh_b.allowance, RECORD_ALLOWANCE_B)},
    {"mesh_volume_b", FIELD_MEASURE, VOLUME(mesh_b.mesh_volume)},
    {"hull_volume_b", FIELD_MEASURE, VOLUME(mesh_b.hull_volume)},
    {"contact_margin", FIELD_FINITE, RECORD(contact_margin), CONTACT(RECORD_CONTACTS), .wrong = WRONG_NUMBER},
    {"contact_angle", FIELD_FINITE, RECORD(contact_angle), CONTACT(RECORD_CONTACTS), .wrong = WRONG_NUMBER},
    {"contact_limit", FIELD_NAME, RECORD(contact_limit), .names = &limits, CONTACT(RECORD_CONTACT_LIMIT),
     .wrong = "is not a limit"},
    {"contacts", FIELD_LIST, LIST(contacts, contact_count), .table = &record_contact_table,
     CONTACT(RECORD_CONTACT_LIST)},
    {"proof", FIELD_OBJECT, .table = &proof, .column = OVOID_RECORD_PROOF},
};
const field_table record_table = FIELD_TABLE_READ(record_line, record_fields, "is not a key of results", "is missing");

// ---- what a record has

int record_has_triangles(ovoid_mesh_kind kind) { return kind == OVOID_MESH_SOLID || kind == OVOID_MESH_SURFACE; }

int record_is_impact(const ovoid_record *record) {
    return record->fields & OVOID_RECORD_IMPACT && !isnan(record->frame);
}

static int has_margin(const ovoid_record *record) {
    return record->fields & OVOID_RECORD_MARGIN || record_is_impact(record);
}

const char *record_find_within(const ovoid_record *record) {
    if (!has_margin(record)) return "";
    int is_within = ovoid_answer_is_within(&record->answer, record->margin);
    if (is_within >= 0) return is_within ? "yes" : "no";
    return record->answer.limit == OVOID_LIMIT_NONE ? "at" : "unproven";
}

/// 1 if the body is the hull of a mesh that is convex only nearly.
static int has_allowance(ovoid_mesh_kind kind, const ovoid_convexity *mesh) {
    return kind == OVOID_MESH_HULL && mesh->allowance > 0;
}

static uint64_t find_solid_bits(const record_line *line) {
    const ovoid_record *r = &line->record;
    ovoid_body_inside inside = line->solid.inside;
    uint64_t bits = RECORD_SURFACES;
    if (record_has_triangles(r->kind_a)) bits |= RECORD_TRIANGLE_A;
    if (record_has_triangles(r->kind_b)) bits |= RECORD_TRIANGLE_B;
    if (inside) bits |= RECORD_INSIDE | (inside == OVOID_BODY_COMMON_POINT ? RECORD_COMMON : RECORD_COMPONENT);
    return r->answer.lower <= 0 && r->answer.lower != -INFINITY ? bits | RECORD_PARTING : bits;
}

static uint64_t find_contact_bits(const ovoid_record *r) {
    uint64_t bits = RECORD_CONTACTS;
    if (r->contact_limit != OVOID_LIMIT_NONE) return bits | RECORD_CONTACT_LIMIT;
    return r->contact_count ? bits | RECORD_CONTACT_LIST : bits;
}

uint64_t record_find_bits(const record_line *line) {
    const ovoid_record *r = &line->record;
    ovoid_proof_kind kind = r->answer.proof.kind;
    uint64_t bits = RECORD_KINDS | (r->answer.proof.count ? RECORD_POINTS : 0);
    int has_parts = (r->fields & OVOID_RECORD_PARTS) != 0;
    if (r->fields & OVOID_RECORD_TIME) bits |= RECORD_TIME;
    if (record_is_impact(r)) bits |= RECORD_TIME | RECORD_IMPACT;
    if (has_parts && r->part_a != OVOID_RECORD_NO_PART) bits |= RECORD_PART_A;
    if (has_parts && r->part_b != OVOID_RECORD_NO_PART) bits |= RECORD_PART_B;
    if (has_margin(r)) bits |= RECORD_MARGIN;
    if (has_allowance(r->kind_a, &r->mesh_a)) bits |= RECORD_ALLOWANCE_A;
    if (has_allowance(r->kind_b, &r->mesh_b)) bits |= RECORD_ALLOWANCE_B;
    if (r->fields & OVOID_RECORD_MESHES) bits |= RECORD_VOLUMES;
    int has_both = kind == OVOID_PROOF_INNER_POINTS || kind == OVOID_PROOF_BALLS;
    if (kind == OVOID_PROOF_INNER || has_both) bits |= RECORD_INNER_A;
    if (has_both) bits |= RECORD_INNER_B;
    if (r->cover && r->cover->point_count) bits |= RECORD_COVER;
    if (r->fields & OVOID_RECORD_CONTACTS && !record_is_impact(r)) bits |= find_contact_bits(r);
    return r->solid ? bits | find_solid_bits(line) : bits;
}
