// Contacts in results: golden lines, every member back from its line bit for bit, a table for people, and a strict
// reader. Truth: the texts were written by hand from the format's description; the round trip compares bits; the
// contact of two cubes has its corners by hand.
#define _POSIX_C_SOURCE 200809L
#include "files.h"
#include "proofs/covers.h"

#include <math.h>

static const ovoid_manifold_point corners[2] = {
    {{0.25, -0.0, 0.1}, {0.25, 0, 0.35}, 0.25, 3},
    {{1, 2, 5e-324}, {1, 2, -0.5}, -0.5, OVOID_MANIFOLD_ID_CROSSING | 5u << 15 | 7},
};

static ovoid_record_contact make_contact(void) {
    ovoid_record_contact c = {.part_a = 2, .part_b = 7, .points = corners, .point_count = 2};
    c.manifold = (ovoid_manifold){.status = OVOID_OVERLAPPING,
                                  .limit = OVOID_LIMIT_NONE,
                                  .lower = -0.5,
                                  .upper = -0.1,
                                  .normal = {0, 0, -1},
                                  .id = {corners[0].id, corners[1].id},
                                  .feature_a = OVOID_MANIFOLD_FACET | 1,
                                  .feature_b = 4,
                                  .facet_a = OVOID_MANIFOLD_FACET | 1,
                                  .facet_b = OVOID_MANIFOLD_EDGE | 6,
                                  .axis = OVOID_MANIFOLD_FACE_A,
                                  .count = 2,
                                  .proof = OVOID_MANIFOLD_PROOF_FACETS,
                                  .corners = 2,
                                  .share = 0.1f};
    c.manifold.memory.flags = 2;
    c.grown = 1e-13;
    c.inner = 0.1;
    c.outer = 0.25;
    return c;
}

static ovoid_record make_record(const ovoid_record_contact *contacts, size_t count) {
    ovoid_record r = {.a = "x",
                      .b = "y",
                      .fields = OVOID_RECORD_CONTACTS,
                      .frame = NAN,
                      .contact_margin = 0.5,
                      .contact_angle = 1.25,
                      .contacts = contacts,
                      .contact_count = count};
    r.answer.status = OVOID_OVERLAPPING;
    r.answer.lower = -0.5;
    r.answer.upper = -0.25;
    return r;
}

#define HEAD                                                                                                           \
    "{\"a\":\"x\",\"b\":\"y\",\"status\":\"overlapping\",\"limit\":\"none\",\"lower\":-0.5,\"upper\":-0.25,"           \
    "\"point_a\":[0,0,0],\"point_b\":[0,0,0],\"normal\":[0,0,0],\"stage\":\"none\",\"iterations\":0,"                  \
    "\"kind_a\":\"hull\",\"kind_b\":\"hull\""
#define ASKED ",\"contact_margin\":0.5,\"contact_angle\":1.25"
#define TAIL ",\"proof\":{\"normal\":[0,0,0],\"kind\":\"none\"}}\n"
#define POINT_0                                                                                                        \
    "{\"id\":3,\"point_a\":[0.25,-0,0.10000000000000001],\"point_b\":[0.25,0,0.34999999999999998],\"separation\":0."   \
    "25}"
#define POINT_1                                                                                                        \
    "{\"id\":2147647495,\"point_a\":[1,2,4.9406564584124654e-324],\"point_b\":[1,2,-0.5],\"separation\":-0.5}"
#define NUMBERS                                                                                                        \
    "\"part_a\":2,\"part_b\":7,\"status\":\"overlapping\",\"limit\":\"none\",\"lower\":-0.5,"                          \
    "\"upper\":-0.10000000000000001,\"normal\":[0,0,-1],\"axis\":\"face a\",\"feature_a\":2147483649,"                 \
    "\"feature_b\":4,\"facet_a\":2147483649,\"facet_b\":1073741830,\"flags\":2,\"corners\":2,"
#define AREAS "\"share\":0.10000000149011612,\"inner\":0.10000000000000001,\"outer\":0.25,\"grown\":1e-13,"
#define CONTACT "{" NUMBERS AREAS "\"points\":[" POINT_0 "," POINT_1 "],\"proof\":\"facets\"}"

static char *write_with(ovoid_code (*write)(FILE *, const ovoid_record *), const ovoid_record *record) {
    char *text = NULL;
    size_t size;
    FILE *file = open_memstream(&text, &size);
    CHECK(file && write(file, record) == OVOID_OK);
    fclose(file);
    return text;
}

static void check_text(const char *found, const char *truth) {
    if (!CHECK(strcmp(found, truth) == 0)) printf("  found: %s\n  truth: %s\n", found, truth);
}

static void check_golden(void) {
    const ovoid_record_contact one = make_contact();
    ovoid_record record = make_record(&one, 1), none = make_record(NULL, 0), refused = make_record(NULL, 0);
    refused.contact_limit = OVOID_LIMIT_SHAPE_B;
    char *text = write_with(ovoid_record_write_json, &record);
    check_text(text, HEAD ASKED ",\"contacts\":[" CONTACT "]" TAIL);
    free(text);
    text = write_with(ovoid_record_write_json, &none);
    check_text(text, HEAD ASKED TAIL);
    free(text);
    text = write_with(ovoid_record_write_json, &refused);
    check_text(text, HEAD ASKED ",\"contact_limit\":\"shape_b\"" TAIL);
    free(text);
    // In CSV each quote of the list is doubled.
    text = write_with(ovoid_record_write_csv, &record);
    const char *list = strstr(text, "hull,,hull,,0.5,1.25,,\"[{\"\"part_a\"\":2,\"\"part_b\"\":7,\"\"status\"\":");
    CHECK(list && strcmp(text + strlen(text) - 24, "\"\"proof\"\":\"\"facets\"\"}]\"\n") == 0);
    free(text);
}

static int read_one(const char *text, ovoid_results_reader **reader, ovoid_record *found, ovoid_error *error) {
    *reader = ovoid_results_reader_open(file_write("contacts.jsonl", text, strlen(text)), error);
    return *reader ? ovoid_results_reader_read(*reader, found, error) : -1;
}

static int is_same(const void *a, const void *b, size_t size) { return memcmp(a, b, size) == 0; }

static void check_same(const ovoid_record_contact *a, const ovoid_record_contact *b) {
    CHECK(a->part_a == b->part_a && a->part_b == b->part_b && a->point_count == b->point_count);
    CHECK(is_same(&a->manifold, &b->manifold, sizeof a->manifold));
    CHECK(is_same(&a->grown, &b->grown, 8) && is_same(&a->inner, &b->inner, 8) && is_same(&a->outer, &b->outer, 8));
    for (size_t i = 0; i < a->point_count; i++) {
        const ovoid_manifold_point *p = &a->points[i], *q = &b->points[i];
        CHECK(is_same(&p->point_a, &q->point_a, 24) && is_same(&p->point_b, &q->point_b, 24));
        CHECK(is_same(&p->separation, &q->separation, 8) && p->id == q->id);
    }
    if (!CHECK(!a->cover == !b->cover) || !a->cover) return;
    CHECK(a->cover->point_count == b->cover->point_count && a->cover->triangle_count == b->cover->triangle_count);
    CHECK(is_same(a->cover->a, b->cover->a, a->cover->point_count * 4));
    CHECK(is_same(a->cover->triangles, b->cover->triangles, a->cover->triangle_count * 6));
}

// Two contacts, one of them with the cover of a search; and no contact after them, in the same reader.
static void check_round_trip(void) {
    static own_cover own = {.a = {9, 4294967295u, 1}, .triangles = {{0}, {0, 0, 2}}};
    own_cover_set(&own, 3, 2);
    ovoid_record_contact two[2] = {make_contact(), make_contact()};
    two[1].part_b = 9;
    two[1].manifold.proof = OVOID_MANIFOLD_PROOF_SEARCH;
    two[1].cover = &own.cover;
    const ovoid_record record = make_record(two, 2), none = make_record(NULL, 0);
    char *first = write_with(ovoid_record_write_json, &record), *second = write_with(ovoid_record_write_json, &none);
    char text[8192];
    snprintf(text, sizeof text, "%s%s", first, second);
    ovoid_results_reader *reader;
    ovoid_record found;
    ovoid_error error = {OVOID_OK, -1, ""};
    if (!CHECK_EQ(read_one(text, &reader, &found, &error), 1)) printf("  %s\n", error.message);
    CHECK_EQ(found.fields, OVOID_RECORD_CONTACTS);
    CHECK(found.contact_margin == 0.5 && found.contact_angle == 1.25 && found.contact_limit == OVOID_LIMIT_NONE);
    if (CHECK_EQ(found.contact_count, 2))
        for (int i = 0; i < 2; i++) check_same(&two[i], &found.contacts[i]);
    CHECK_EQ(ovoid_results_reader_read(reader, &found, &error), 1);
    CHECK(found.contact_count == 0 && found.contacts == NULL && found.fields == OVOID_RECORD_CONTACTS);
    CHECK_EQ(ovoid_results_reader_read(reader, &found, &error), 0);
    ovoid_results_reader_close(reader);
    free(first);
    free(second);
}

// As many items as a line may have; more are refused before anything is written.
static void check_many(void) {
    static own_cover own;
    own_cover_set(&own, OVOID_COVER_POINTS, 2 * OVOID_COVER_POINTS);
    size_t most = OVOID_RECORD_ITEMS_MAX / 68, size;
    ovoid_record_contact *contacts = malloc((most + 1) * sizeof *contacts);
    for (size_t i = 0; i <= most; i++) contacts[i] = make_contact(), contacts[i].cover = &own.cover;
    for (int k = 0; k < OVOID_COVER_POINTS; k++) own.a[k] = own.b[k] = 99999;
    for (int k = 0; k < 2 * OVOID_COVER_POINTS; k++)
        own.triangles[k][0] = own.triangles[k][1] = own.triangles[k][2] = 511;
    ovoid_record record = make_record(contacts, most);
    char *text = write_with(ovoid_record_write_json, &record);
    CHECK_LE(strlen(text), OVOID_RECORD_SIZE_MAX);
    free(text);
    record.contact_count = most + 1;
    FILE *file = open_memstream(&text, &size);
    CHECK_EQ(ovoid_record_write_json(file, &record), OVOID_ERROR_LIMIT);
    fclose(file);
    CHECK_EQ(size, 0);
    free(text);
    free(contacts);
}

static void check_table(void) {
    ovoid_record_contact one = make_contact();
    one.manifold.upper = -0.5;
    one.manifold.corners = 3;
    ovoid_record record = make_record(&one, 1);
    record.part_a = record.part_b = OVOID_RECORD_NO_PART;
    record.answer.upper = -0.5;
    char *text = NULL;
    size_t size;
    FILE *file = open_memstream(&text, &size);
    ovoid_records_write_table(file, &record, 1, "m");
    fclose(file);
    const char *lines = strchr(strchr(text, '\n') + 1, '\n') + 1;
    check_text(lines, "  contact by face a, distance -0.5, normal 0 0 -1, area 0.1 .. 0.25\n"
                      "    at 0.25 0 0.1, separation 0.25, vertex 3 of a\n"
                      "    at 1 2 0, separation -0.5, edges 5 and 7\n");
    free(text);
}

#define WITH(list) HEAD ASKED ",\"contacts\":" list TAIL
static const bad_input bad_lines[] = {
    {"alone.jsonl", HEAD ",\"contact_margin\":0.5" TAIL, 1, "\"contact_angle\" goes with"},
    {"no_margin.jsonl", HEAD ",\"contacts\":[" CONTACT "]" TAIL, 1, "\"contact_margin\" goes with"},
    {"both.jsonl", HEAD ASKED ",\"contact_limit\":\"shape_a\",\"contacts\":[" CONTACT "]" TAIL, 1,
     "\"contacts\" goes with"},
    {"empty.jsonl", WITH("[]"), 1, "\"contacts\" must be a list, not an empty one"},
    {"no_points.jsonl", WITH("[{" NUMBERS AREAS "\"proof\":\"facets\"}]"), 1, "\"contacts\" must have one to four"},
    {"five.jsonl",
     WITH("[{" NUMBERS AREAS "\"points\":[" POINT_0 "," POINT_0 "," POINT_0 "," POINT_0 "," POINT_0
          "],\"proof\":\"facets\"}]"),
     1, "\"contacts\" must have one to four"},
    {"key.jsonl", WITH("[{" NUMBERS AREAS "\"points\":[" POINT_0 "],\"proof\":\"facets\",\"depth\":1}]"), 1,
     "\"depth\" is not that of a contact"},
    {"missing.jsonl", WITH("[{" NUMBERS "\"points\":[" POINT_0 "],\"proof\":\"facets\"}]"), 1,
     "\"share\" is missing of a contact"},
    {"share.jsonl",
     WITH("[{" NUMBERS "\"share\":0.1,\"inner\":0,\"outer\":0,\"grown\":0,\"points\":[" POINT_0
          "],\"proof\":\"facets\"}]"),
     1, "\"share\" must be a share"},
    {"proof.jsonl", WITH("[{" NUMBERS AREAS "\"points\":[" POINT_0 "],\"proof\":\"hull\"}]"), 1,
     "\"proof\" is not a proof of a contact"},
    {"cover.jsonl", WITH("[{" NUMBERS AREAS "\"points\":[" POINT_0 "],\"proof\":\"search\",\"cover\":{\"pairs\":[]}}]"),
     1, "\"cover\" must have \"pairs\" and"},
    {"point.jsonl", WITH("[{" NUMBERS AREAS "\"points\":[{\"id\":1}],\"proof\":\"facets\"}]"), 1,
     "\"point_a\" must be three numbers"},
    {"id.jsonl",
     WITH("[{" NUMBERS AREAS
          "\"points\":[{\"id\":-1,\"point_a\":[0,0,0],\"point_b\":[0,0,0],\"separation\":0}],\"proof\":\"facets\"}]"),
     1, "\"id\" must be a whole number"},
};

static int accepts(const char *path, ovoid_error *error) {
    ovoid_results_reader *reader = ovoid_results_reader_open(path, error);
    ovoid_record record;
    int got = 1;
    while (reader && (got = ovoid_results_reader_read(reader, &record, error)) == 1) continue;
    ovoid_results_reader_close(reader);
    return got != -1;
}

// Changed lines: a record or an error, never a crash or a leak.
static void check_damaged(void) {
    static const char good[] =
        WITH("[{" NUMBERS AREAS "\"points\":[" POINT_0
             "],\"proof\":\"search\",\"cover\":{\"pairs\":[[1,2]],\"triangles\":[[0,0,0]]}}," CONTACT "]");
    uint64_t s = 29;
    for (int i = 0; i < 1500; i++) {
        check_seed = s;
        char text[sizeof good];
        memcpy(text, good, sizeof good);
        text[random_next(&s) % (sizeof good - 1)] = "0123456789\"[]{},:.-enul \n"[random_next(&s) % 25];
        ovoid_error error = {OVOID_OK, -1, ""};
        ovoid_results_reader *reader =
            ovoid_results_reader_open(file_write("damaged.jsonl", text, sizeof good - 1), &error);
        ovoid_record found;
        int got = 1;
        while (reader && (got = ovoid_results_reader_read(reader, &found, &error)) == 1)
            for (size_t k = 0; k < found.contact_count; k++) CHECK_LE(found.contacts[k].point_count, 4);
        CHECK(got == 0 || (error.code != OVOID_OK && error.message[0]));
        ovoid_results_reader_close(reader);
    }
    check_seed = 0;
}

int main(void) {
    check_golden();
    check_round_trip();
    check_many();
    check_table();
    check_bad_inputs(bad_lines, sizeof bad_lines / sizeof *bad_lines, accepts);
    check_damaged();
    return check_end();
}
