// Results: golden lines of the writers, every record back from its line bit for bit, and a strict reader. Truth: the
// texts below were written by hand from the format's description; the round trip compares bits.
#define _POSIX_C_SOURCE 200809L
#include "files.h"
#include "proofs/covers.h"

#include <locale.h>

static ovoid_record make_record(void) {
    ovoid_record r = {.a = "link \"1\"", .b = "b\xc3\xa4r,\n\xff", .cover = NULL};
    r.answer.status = OVOID_SEPARATED;
    r.answer.stage = OVOID_STAGE_GJK;
    r.answer.iterations = 4;
    r.answer.lower = 0.1;
    r.answer.upper = 0.10000000000000002;
    r.answer.point_a = (ovoid_vec3){1, -0.0, 1e300};
    r.answer.point_b = (ovoid_vec3){1.1, 0, 5e-324};
    r.answer.normal = (ovoid_vec3){0, 0, -1};
    r.answer.proof.normal = (ovoid_vec3){0, 0.5, -1};
    r.answer.proof.kind = OVOID_PROOF_POINTS;
    r.answer.proof.count = 2;
    r.answer.proof.a[0] = 7;
    r.answer.proof.a[1] = 4294967295u;
    r.answer.proof.b[1] = 3;
    r.answer.proof.weight_a[0] = 0.25;
    r.answer.proof.weight_a[1] = 0.75;
    r.answer.proof.weight_b[0] = 1;
    return r;
}

static char *write_with(ovoid_code (*write)(FILE *, const ovoid_record *), const ovoid_record *record) {
    const char *path = file_path("record.txt");
    FILE *file = fopen(path, "wb");
    CHECK(file && write(file, record) == OVOID_OK);
    fclose(file);
    size_t size;
    return file_read(path, &size);
}

static void check_text(const char *found, const char *truth) {
    if (!CHECK(strcmp(found, truth) == 0)) printf("  found: %s\n  truth: %s\n", found, truth);
}

static const char golden_json[] =
    "{\"a\":\"link "
    "\\\"1\\\"\",\"b\":\"b\xc3\xa4r,\\u000a\\ufffd\",\"status\":\"separated\",\"limit\":\"none\",\"lower\":0."
    "10000000000000001,"
    "\"upper\":0.10000000000000002,\"point_a\":[1,-0,1.0000000000000001e+300],"
    "\"point_b\":[1.1000000000000001,0,4.9406564584124654e-324],\"normal\":[0,0,-1],\"stage\":\"gjk\",\"iterations\":4,"
    "\"kind_a\":\"hull\",\"kind_b\":\"hull\",\"proof\":{\"normal\":[0,0.5,-1],\"kind\":\"points\",\"a\":[7,4294967295],"
    "\"b\":[0,3],\"weight_a\":[0.25,0.75],"
    "\"weight_b\":[1,0]}}\n";

static const char golden_csv[] =
    "\"link \"\"1\"\"\",,\"b\xc3\xa4r,\\x0a\\xff\",,separated,none,,,0.10000000000000001,0.10000000000000002,1,-0,"
    "1.0000000000000001e+300,1.1000000000000001,0,4.9406564584124654e-324,0,0,-1,gjk,4,hull,,hull,,"
    "\"{\"\"normal\"\":[0,0.5,-1],\"\"kind\"\":\"\"points\"\",\"\"a\"\":[7,4294967295],\"\"b\"\":[0,3],"
    "\"\"weight_a\"\":[0.25,0.75],\"\"weight_b\"\":[1,0]}\"\n";

static char *write_header(unsigned fields) {
    const char *path = file_path("record.txt");
    FILE *file = fopen(path, "wb");
    CHECK(file && ovoid_record_write_csv_header(file, fields) == OVOID_OK);
    fclose(file);
    size_t size;
    return file_read(path, &size);
}

// What stands before and between the names of a frame, of compounds, of an impact.
static void check_golden_fields(ovoid_record record) {
    record.a = "x";
    record.b = "y";
    record.time = 0.5;
    record.part_a = 7;
    record.part_b = OVOID_RECORD_NO_PART;
    record.frame = 0.25;
    record.margin = 0.75;
    record.free_for = 0.125;
    record.hit_after = 0.25;
    static const struct {
        unsigned fields;
        const char *json, *header, *csv;
    } truth[] = {
        {0, "{\"a\":\"x\",\"b\":\"y\",\"status\":\"separated\",\"limit\":\"none\",\"lower\"",
         "a,part_a,b,part_b,status,limit,margin,within,lower,", "x,,y,,separated,none,,,0.1"},
        {OVOID_RECORD_TIME, "{\"time\":0.5,\"a\":\"x\",\"b\":\"y\",\"status\"", "time,a,part_a,b,part_b,status,",
         "0.5,x,,y,,separated,"},
        {OVOID_RECORD_PARTS, "{\"a\":\"x\",\"part_a\":7,\"b\":\"y\",\"status\"", "a,part_a,b,part_b,status,",
         "x,7,y,,separated,"},
        {OVOID_RECORD_MARGIN,
         "{\"a\":\"x\",\"b\":\"y\",\"status\":\"separated\",\"limit\":\"none\",\"margin\":0.75,\"within\":\"yes\","
         "\"lower\"",
         "a,part_a,b,part_b,status,limit,margin,within,lower,", "x,,y,,separated,none,0.75,yes,0.1"},
        {7,
         "{\"time\":0.5,\"frame\":0.25,\"free_for\":0.125,\"hit_after\":0.25,\"a\":\"x\",\"part_a\":7,\"b\":"
         "\"y\",\"status\":\"separated\",\"limit\":\"none\",\"margin\":0.75,\"within\":\"yes\",",
         "time,frame,free_for,hit_after,a,part_a,b,part_b,status,",
         "0.5,0.25,0.125,0.25,x,7,y,,separated,none,0.75,yes,"}};
    for (size_t i = 0; i < sizeof truth / sizeof *truth; i++) {
        record.fields = truth[i].fields;
        char *texts[] = {write_with(ovoid_record_write_json, &record), write_header(record.fields),
                         write_with(ovoid_record_write_csv, &record)};
        const char *truths[] = {truth[i].json, truth[i].header, truth[i].csv};
        for (int k = 0; k < 3; k++) {
            if (!CHECK(strncmp(texts[k], truths[k], strlen(truths[k])) == 0)) printf("  found: %s\n", texts[k]);
            free(texts[k]);
        }
    }
    // The line of a frame among impacts: no key, an empty column.
    record.fields = OVOID_RECORD_TIME | OVOID_RECORD_IMPACT;
    record.frame = NAN;
    char *json = write_with(ovoid_record_write_json, &record), *csv = write_with(ovoid_record_write_csv, &record);
    CHECK(!strstr(json, "free_for") && strncmp(csv, "0.5,,,,x,,y,,", 13) == 0);
    free(json);
    free(csv);
}

// The word about a margin: of the bracket 0.1 .. 0.1000...2, and what a limit makes of one that holds the margin.
static void check_within(void) {
    static const struct {
        double margin;
        ovoid_limit limit;
        const char *word;
    } truth[] = {{0.05, OVOID_LIMIT_NONE, ",no,"},
                 {0.2, OVOID_LIMIT_CAPACITY, ",capacity,0.20000000000000001,yes,"},
                 {0.1, OVOID_LIMIT_NONE, ",at,"},
                 {0.1, OVOID_LIMIT_ANSWERED, ",unproven,"}};
    for (size_t i = 0; i < sizeof truth / sizeof *truth; i++) {
        ovoid_record record = make_record();
        record.fields = OVOID_RECORD_MARGIN;
        record.margin = truth[i].margin;
        record.answer.limit = truth[i].limit;
        char *text = write_with(ovoid_record_write_csv, &record);
        CHECK(strstr(text, truth[i].word) != NULL);
        free(text);
    }
}

static void check_golden(void) {
    ovoid_record record = make_record();
    char *text = write_with(ovoid_record_write_json, &record);
    check_text(text, golden_json);
    free(text);
    // CSV has the proof where it is asked for, as its last column.
    record.fields = OVOID_RECORD_PROOF;
    text = write_with(ovoid_record_write_csv, &record);
    check_text(text, golden_csv);
    free(text);
    text = write_header(record.fields);
    CHECK(strstr(text, ",iterations,kind_a,allowance_a,kind_b,allowance_b,proof\n") != NULL);
    free(text);
    record.fields = 0;
    text = write_with(ovoid_record_write_csv, &record);
    CHECK(strstr(text, ",gjk,4,hull,,hull,\n") != NULL);
    free(text);
    text = write_header(0);
    CHECK(strstr(text, ",iterations,kind_a,allowance_a,kind_b,allowance_b\n") != NULL);
    free(text);
    check_within();
    check_golden_fields(record);
    // A refused pair of a batch: no bounds, no points.
    ovoid_record refused = {.index_a = 12, .index_b = 0};
    refused.answer.limit = OVOID_LIMIT_POSE_A;
    refused.answer.lower = -INFINITY;
    refused.answer.upper = INFINITY;
    refused.answer.point_a.x = NAN;
    text = write_with(ovoid_record_write_json, &refused);
    char truth[600];
    snprintf(truth, sizeof truth,
             "{\"a\":12,\"b\":0,\"status\":\"undecided\",\"limit\":\"%s\",\"lower\":null,\"upper\":null,\"point_a\":["
             "null,0,0],"
             "\"point_b\":[0,0,0],\"normal\":[0,0,0],\"stage\":\"%s\",\"iterations\":0,"
             "\"kind_a\":\"hull\",\"kind_b\":\"hull\",\"proof\":{\"normal\":[0,0,0],\"kind\":\"none\"}}\n",
             ovoid_limit_get_name(OVOID_LIMIT_POSE_A), ovoid_stage_get_name(OVOID_STAGE_NONE));
    check_text(text, truth);
    free(text);
    text = write_with(ovoid_record_write_csv, &refused);
    CHECK(strstr(text, ",-inf,inf,nan,0,0,") != NULL);
    free(text);
}

static void check_table(void) {
    ovoid_record records[3] = {make_record(), {.a = "\xc3\xa4", .b = "c"}, {.a = "x", .b = "y"}};
    records[0].a = "link";
    records[0].b = "bar";
    records[1].answer.status = OVOID_OVERLAPPING;
    records[1].answer.stage = OVOID_STAGE_EPA;
    records[1].answer.iterations = 17;
    records[1].answer.lower = -2.5;
    records[1].answer.upper = -2.4999999999;
    records[2].answer.lower = -INFINITY;
    records[2].answer.upper = 1.0 / 3;
    records[2].answer.limit = OVOID_LIMIT_ITERATIONS;
    records[1].answer.limit = OVOID_LIMIT_CAPACITY;
    for (int i = 0; i < 3; i++) records[i].fields = OVOID_RECORD_MARGIN, records[i].margin = 0.2;
    const char *path = file_path("table.txt");
    FILE *file = fopen(path, "wb");
    CHECK(file && ovoid_records_write_table(file, records, 3, NULL) == OVOID_OK);
    fclose(file);
    size_t size;
    char *text = file_read(path, &size);
    check_text(text,
               "a     b    status               distance    width  stage  steps\n"
               "link  bar  separated                 0.1  1.4e-17  gjk        4  within\n"
               "\xc3\xa4     c    overlapping              -2.5    1e-10  epa       17  within, ended by capacity\n"
               "x     y    undecided    -inf .. 0.333333      inf  none       0  not proven, ended by iterations\n");
    free(text);
}

// The digits that a bracket proves: the decimal of fewest digits inside, and both ends of what is wide or undecided.
static void check_distances(void) {
    static const struct {
        double lower, upper;
        ovoid_status status;
        const char *text;
    } truth[] = {{0.24999999999984737, 0.2500000000001526, OVOID_SEPARATED, "0.25"},
                 {1.4524174696259122, 1.4524174696260925, OVOID_SEPARATED, "1.452417469626"},
                 {9.9999999999, 10.0000000001, OVOID_SEPARATED, "10"},
                 {-1e-28, 3e-28, OVOID_TOUCHING, "0"},
                 {-1e-28, 3e-28, OVOID_UNDECIDED, "-1e-28 .. 3e-28"},
                 {-0.324, 0.476, OVOID_UNDECIDED, "-0.324 .. 0.476"},
                 {1.2, 3.2, OVOID_SEPARATED, "1.2 .. 3.2"},
                 {4.593, 5.138, OVOID_SEPARATED, "4.593 .. 5.138"},
                 {-3.2, -1.2, OVOID_OVERLAPPING, "-3.2 .. -1.2"},
                 {4.999998, 5.000002, OVOID_SEPARATED, "5"},
                 {5.000001, 5.000009, OVOID_SEPARATED, "5 .. 5.00001"},
                 {0.49999999999997, 0.50000000000003, OVOID_SEPARATED, "0.5"},
                 {-INFINITY, INFINITY, OVOID_UNDECIDED, "-inf .. inf"},
                 {0.1, 0.1, OVOID_SEPARATED, "0.1"},
                 {0.1, 0.10000000000000002, OVOID_SEPARATED, "0.1"},
                 {1.2345678901234567e49, 1.2345678901234567e49, OVOID_SEPARATED, "1.2345678901234567e+49"}};
    for (size_t i = 0; i < sizeof truth / sizeof *truth; i++) {
        char text[64];
        ovoid_answer answer = {.lower = truth[i].lower, .upper = truth[i].upper, .status = truth[i].status};
        CHECK_EQ(ovoid_answer_write_distance(text, &answer), strlen(truth[i].text));
        check_text(text, truth[i].text);
    }
}

// Times stand first, parts behind the names; a long name makes room for its part.
static void check_table_fields(void) {
    char name[120];
    memset(name, 'n', 119);
    name[119] = 0;
    ovoid_record records[2] = {{.a = "arm", .b = "box"}, {.a = name, .b = "box"}};
    for (int i = 0; i < 2; i++) {
        records[i].fields = 7 | OVOID_RECORD_MARGIN;
        records[i].margin = 0.25;
        records[i].time = 0.5 + i;
        records[i].frame = i ? 1.25 : NAN;
        records[i].hit_after = 0.25;
        records[i].part_a = 12;
        records[i].part_b = OVOID_RECORD_NO_PART;
        records[i].answer.status = OVOID_SEPARATED;
        records[i].answer.lower = records[i].answer.upper = 0.125;
    }
    const char *path = file_path("table.txt");
    FILE *file = fopen(path, "wb");
    CHECK(file && ovoid_records_write_table(file, records, 1, "") == OVOID_OK);
    CHECK(file && ovoid_records_write_table(file, records + 1, 1, NULL) == OVOID_OK);
    fclose(file);
    size_t size;
    char *text = file_read(path, &size);
    static const char truth[] = "time  a        b    status     distance  width  stage  steps\n"
                                " 0.5  arm[12]  box  separated     0.125      0  none       0  within\n"
                                "time  a";
    CHECK(strncmp(text, truth, strlen(truth)) == 0);
    // 95 bytes: 91 letters and the part.
    CHECK(strstr(text, "\n 1.5  nnnn") &&
          strstr(text, "nnn[12]  box  separated     0.125      0  none       0  impact\n"));
    const char *long_name = strstr(text, "nnnn");
    if (long_name) CHECK_EQ(strcspn(long_name, "["), 91);
    free(text);
}

// Names from hostile files: no escape sequence reaches the terminal, no character is cut in half.
static void check_table_names(void) {
    char name[200] = "\x1b[31m\n";
    for (int i = 0; i < 60; i++) strcat(name, "\xc3\xa4");
    ovoid_record record = {.a = name, .b = "b"};
    const char *path = file_path("table.txt");
    FILE *file = fopen(path, "wb");
    CHECK(file && ovoid_records_write_table(file, &record, 1, NULL) == OVOID_OK);
    fclose(file);
    size_t size;
    char *text = file_read(path, &size);
    const char *line = strchr(text, '\n') + 1;
    // 95 bytes hold the six of the escape and 44 letters of two bytes.
    CHECK(memcmp(line, "?[31m?", 6) == 0 && !strchr(line, 0x1b) && memcmp(line + 6 + 88, "  b  ", 5) == 0);
    free(text);
}

// ---- the way back

static int is_same_bits(const void *a, const void *b, size_t size) { return memcmp(a, b, size) == 0; }

static int is_same_vector(ovoid_vec3 a, ovoid_vec3 b) { return is_same_bits(&a, &b, sizeof a); }

// All that a line holds; entries of the proof beyond its count are not written.
static void check_same(const ovoid_record *a, const ovoid_record *b) {
    const ovoid_answer *x = &a->answer, *y = &b->answer;
    CHECK(!a->a == !b->a && (!a->a || (strcmp(a->a, b->a) == 0 && strcmp(a->b, b->b) == 0)));
    if (!a->a) CHECK(a->index_a == b->index_a && a->index_b == b->index_b);
    CHECK_EQ(a->fields, b->fields);
    if (a->fields & OVOID_RECORD_TIME) CHECK(is_same_bits(&a->time, &b->time, 8));
    if (a->fields & OVOID_RECORD_IMPACT)
        CHECK(is_same_bits(&a->frame, &b->frame, 8) && is_same_bits(&a->free_for, &b->free_for, 8) &&
              is_same_bits(&a->hit_after, &b->hit_after, 8));
    if (a->fields & OVOID_RECORD_MARGIN) CHECK(is_same_bits(&a->margin, &b->margin, 8));
    if (CHECK(a->group_count == b->group_count))
        for (size_t i = 0; i < a->group_count; i++) {
            const ovoid_step_group *p = &a->groups[i], *q = &b->groups[i];
            CHECK(p->first_a == q->first_a && p->end_a == q->end_a && p->first_b == q->first_b && p->end_b == q->end_b);
            CHECK_EQ(p->count, q->count);
        }
    if (CHECK(a->exclusion_count == b->exclusion_count && a->step_count == b->step_count)) {
        for (size_t i = 0; i < a->exclusion_count; i++) {
            const ovoid_exclusion *p = &a->exclusions[i], *q = &b->exclusions[i];
            CHECK(p->first_a == q->first_a && p->end_a == q->end_a && p->first_b == q->first_b && p->end_b == q->end_b);
            CHECK(is_same_vector(p->normal, q->normal) && is_same_vector(p->normal_low, q->normal_low));
            CHECK(is_same_bits(&p->lower, &q->lower, 8));
        }
        for (size_t i = 0; i < a->step_count; i++)
            CHECK(is_same_bits(&a->steps[i].until, &b->steps[i].until, 8) &&
                  is_same_vector(a->steps[i].normal, b->steps[i].normal) && a->steps[i].frame == b->steps[i].frame);
    }
    if (a->fields & OVOID_RECORD_PARTS) CHECK(a->part_a == b->part_a && a->part_b == b->part_b);
    CHECK_EQ(x->status, y->status);
    CHECK_EQ(x->stage, y->stage);
    CHECK_EQ(x->iterations, y->iterations);
    CHECK_EQ(x->limit, y->limit);
    CHECK(is_same_bits(&x->lower, &y->lower, 8) && is_same_bits(&x->upper, &y->upper, 8));
    CHECK(is_same_vector(x->point_a, y->point_a) && is_same_vector(x->point_b, y->point_b));
    CHECK(is_same_vector(x->normal, y->normal) && is_same_vector(x->proof.normal, y->proof.normal));
    CHECK(is_same_vector(x->proof.normal_low, y->proof.normal_low));
    CHECK_EQ(x->proof.kind, y->proof.kind);
    if (!CHECK(x->proof.count == y->proof.count)) return;
    size_t n = x->proof.count;
    CHECK(is_same_bits(x->proof.a, y->proof.a, 4 * n) && is_same_bits(x->proof.b, y->proof.b, 4 * n));
    CHECK(is_same_bits(x->proof.weight_a, y->proof.weight_a, 8 * n));
    CHECK(is_same_bits(x->proof.weight_b, y->proof.weight_b, 8 * n));
    int kind = x->proof.kind;
    if (kind == OVOID_PROOF_INNER || kind == OVOID_PROOF_INNER_POINTS || kind == OVOID_PROOF_BALLS)
        CHECK(is_same_vector(x->proof.inner_a, y->proof.inner_a));
    if (kind == OVOID_PROOF_INNER_POINTS || kind == OVOID_PROOF_BALLS)
        CHECK(is_same_vector(x->proof.inner_b, y->proof.inner_b));
    if (!CHECK(!a->cover == !b->cover) || !a->cover) return;
    CHECK_EQ(a->cover->point_count, b->cover->point_count);
    CHECK_EQ(a->cover->triangle_count, b->cover->triangle_count);
    CHECK(is_same_bits(a->cover->a, b->cover->a, 4 * a->cover->point_count));
    CHECK(is_same_bits(a->cover->b, b->cover->b, 4 * a->cover->point_count));
    CHECK(is_same_bits(a->cover->triangles, b->cover->triangles, 6 * a->cover->triangle_count));
}

static double random_double(uint64_t *s) {
    return random_normal(s) * pow(10, random_uniform(s, -300, 80)) * (random_next(s) % 4 != 0);
}
static ovoid_vec3 random_vector(uint64_t *s) {
    return (ovoid_vec3){random_double(s), random_double(s), random_double(s)};
}

static ovoid_record random_record(uint64_t *s, own_cover *own) {
    ovoid_record r = {.index_a = random_next(s) % 1000000, .index_b = random_next(s) % 10, .cover = NULL};
    if (random_next(s) % 2) r.a = "one", r.b = "two";
    // An impact has a time and a margin; of the parts one may be none.
    r.fields = (unsigned)random_next(s) % 16;
    if (r.fields & OVOID_RECORD_IMPACT) r.fields |= OVOID_RECORD_TIME | OVOID_RECORD_MARGIN;
    r.time = random_double(s);
    r.frame = random_double(s);
    r.margin = random_double(s);
    r.free_for = random_double(s);
    r.hit_after = random_next(s) % 4 ? random_double(s) : INFINITY;
    static ovoid_exclusion exclusions[3];
    static ovoid_step steps[3];
    for (int i = 0; i < 3; i++) {
        uint32_t first = (uint32_t)random_next(s) % 1000;
        exclusions[i] = (ovoid_exclusion){first,     first + 1,       (uint32_t)random_next(s), 0, random_vector(s),
                                          {0, 0, 0}, random_double(s)};
        if (random_next(s) % 2) exclusions[i].normal_low = (ovoid_vec3){random_double(s), 1, 0};
        steps[i] = (ovoid_step){random_double(s), random_vector(s), (ovoid_step_frame)(random_next(s) % 3)};
    }
    r.exclusions = exclusions;
    r.exclusion_count = random_next(s) % 4;
    r.steps = steps;
    r.step_count = random_next(s) % 4;
    static ovoid_step_group groups[2];
    for (int i = 0; i < 2; i++)
        groups[i] = (ovoid_step_group){(uint32_t)random_next(s), 7, 0, (uint32_t)random_next(s), random_next(s) % 1000};
    r.groups = groups;
    r.group_count = random_next(s) % 3;
    r.part_a = (uint32_t)random_next(s) % OVOID_RECORD_NO_PART;
    r.part_b = random_next(s) % 2 ? 0 : OVOID_RECORD_NO_PART;
    ovoid_answer *x = &r.answer;
    x->status = (ovoid_status)(random_next(s) % 4);
    x->stage = (ovoid_stage)(random_next(s) % (OVOID_STAGE_REFINE + 1));
    x->limit = (ovoid_limit)(random_next(s) % (OVOID_LIMIT_SHAPE_B + 1));
    x->iterations = (uint32_t)random_next(s);
    x->lower = random_next(s) % 8 ? random_double(s) : -INFINITY;
    x->upper = random_next(s) % 8 ? random_double(s) : INFINITY;
    x->point_a = random_vector(s);
    x->point_b = random_vector(s);
    x->normal = random_vector(s);
    x->proof.normal = random_vector(s);
    if (random_next(s) % 2) x->proof.normal_low = (ovoid_vec3){1, random_double(s), random_double(s)};
    x->proof.kind = (ovoid_proof_kind)(random_next(s) % (OVOID_PROOF_COVER + 1));
    x->proof.count = (uint32_t)(random_next(s) % (OVOID_PROOF_PAIRS + 1));
    for (int i = 0; i < OVOID_PROOF_PAIRS; i++) {
        x->proof.a[i] = (uint32_t)random_next(s);
        x->proof.b[i] = (uint32_t)random_next(s) % 100;
        x->proof.weight_a[i] = random_uniform(s, 0, 1);
        x->proof.weight_b[i] = fabs(random_double(s));
    }
    x->proof.inner_a = random_vector(s);
    x->proof.inner_b = random_vector(s);
    if (random_next(s) % 4 == 0) {
        const ovoid_cover *cover = r.cover = &own->cover;
        uint32_t points = 1 + (uint32_t)(random_next(s) % OVOID_COVER_POINTS);
        own_cover_set(own, points, (uint32_t)(random_next(s) % (2 * OVOID_COVER_POINTS + 1)));
        for (uint32_t i = 0; i < cover->point_count; i++) {
            own->a[i] = (uint32_t)random_next(s);
            own->b[i] = (uint32_t)random_next(s);
        }
        for (uint32_t i = 0; i < cover->triangle_count; i++)
            for (int k = 0; k < 3; k++) own->triangles[i][k] = (uint16_t)(random_next(s) % cover->point_count);
    }
    return r;
}

static void check_round_trip(void) {
    enum { COUNT = 500 };
    const char *path = file_path("results.jsonl");
    static own_cover own;
    uint64_t s = 3;
    FILE *file = fopen(path, "wb");
    for (int i = 0; i < COUNT; i++) {
        ovoid_record record = random_record(&s, &own);
        CHECK(ovoid_record_write_json(file, &record) == OVOID_OK);
    }
    fclose(file);
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_results_reader *reader = ovoid_results_reader_open(path, &error);
    if (!CHECK(reader != NULL)) return;
    s = 3;
    ovoid_record found;
    for (int i = 0; i < COUNT; i++) {
        check_seed = s;
        ovoid_record record = random_record(&s, &own);
        if (!CHECK(ovoid_results_reader_read(reader, &found, &error) == 1)) {
            printf("  %s\n", error.message);
            break;
        }
        CHECK_EQ(ovoid_results_reader_get_line(reader), i + 1);
        check_same(&record, &found);
    }
    check_seed = 0;
    CHECK(ovoid_results_reader_read(reader, &found, &error) == 0);
    ovoid_results_reader_close(reader);
}

// A locale whose decimal sign is a comma changes nothing, neither written nor read.
static void check_locale(void) {
    setenv("LOCPATH", OVOID_BUILD_DIR "/locales", 1);
    if (!setlocale(LC_NUMERIC, "de_DE.UTF-8") && !setlocale(LC_NUMERIC, "fr_FR.UTF-8") &&
        !setlocale(LC_NUMERIC, "de_DE")) {
        check_skip("no locale with a decimal comma is installed");
        return;
    }
    check_golden();
    check_round_trip();
    setlocale(LC_NUMERIC, "C");
}

// ---- bad lines

#define LINE(a, status, lower, point, stage, iterations, proof)                                                        \
    "{\"a\":" a ",\"b\":1,\"status\":" status ",\"limit\":\"none\",\"lower\":" lower ",\"upper\":1,\"point_a\":" point \
    ",\"point_b\":[0,0,0],\"normal\":[0,0,1],\"stage\":" stage ",\"iterations\":" iterations ",\"proof\":" proof "}\n"
#define LINE_LIMIT(limit)                                                                                              \
    "{\"a\":0,\"b\":1,\"status\":\"undecided\",\"limit\":" limit                                                       \
    ",\"lower\":0,\"upper\":1,\"point_a\":[0,0,0],\"point_b\":[0,0,0],\"normal\":[0,0,1],\"stage\":\"gjk\","           \
    "\"iterations\":0,"                                                                                                \
    "\"proof\":" PROOF "}\n"
#define PROOF "{\"normal\":[0,0,1],\"kind\":\"none\"}"
#define WITH_PROOF(proof) LINE("0", "\"separated\"", "0.5", "[0,0,0]", "\"gjk\"", "3", proof)
#define GOOD WITH_PROOF(PROOF)
#define GOOD_REST                                                                                                      \
    "\"a\":0,\"b\":1,\"status\":\"separated\",\"limit\":\"none\",\"lower\":0,\"upper\":1,\"point_a\":[0,0,0],\"point_" \
    "b\":[0,0,0],"                                                                                                     \
    "\"normal\":[0,0,1],\"stage\":\"gjk\",\"iterations\":0,\"kind_a\":\"hull\",\"kind_b\":\"hull\",\"proof\":" PROOF   \
    "}\n"

static const bad_input bad_lines[] = {
    {"time.jsonl", "{\"time\":null," GOOD_REST, 1, "\"time\" must be a number"},
    {"until.jsonl", "{\"free_for\":1," GOOD_REST, 1, "\"time\" must be a number, as all"},
    {"frame.jsonl", "{\"time\":1,\"frame\":1," GOOD_REST, 1, "\"free_for\" must be a number, as"},
    {"no_margin.jsonl", "{\"time\":1,\"frame\":1,\"free_for\":0,\"hit_after\":0," GOOD_REST, 1,
     "\"margin\" must be a number"},
    {"margin.jsonl", "{\"within\":\"yes\"," GOOD_REST, 1, "\"margin\" must be a number"},
    {"no_within.jsonl", "{\"margin\":2," GOOD_REST, 1, "\"within\" is not what"},
    {"within.jsonl", "{\"margin\":2,\"within\":\"no\"," GOOD_REST, 1, "\"within\" is not what"},
    {"csv.jsonl", "a,part_a,b,part_b,status\n", 1, "not as CSV"},
    {"no_exclusions.jsonl", WITH_PROOF("{\"normal\":[0,0,1],\"kind\":\"none\",\"exclusions\":[]}"), 1,
     "\"exclusions\" must be a list"},
    {"exclusion.jsonl", WITH_PROOF("{\"normal\":[0,0,1],\"kind\":\"none\",\"exclusions\":[{\"a\":[0,1]}]}"), 1,
     "\"b\" is not that of an exclusion"},
    {"group.jsonl",
     WITH_PROOF("{\"normal\":[0,0,1],\"kind\":\"none\",\"groups\":[{\"a\":[0,1],\"b\":[0,1],\"count\":-1}]}"), 1,
     "\"count\" must be a whole number"},
    {"range.jsonl",
     WITH_PROOF("{\"normal\":[0,0,1],\"kind\":\"none\",\"exclusions\":[{\"a\":[0,1],\"b\":[0,0.5],\"normal\":[0,0,1],"
                "\"lower\":0}]}"),
     1, "ranges of two whole numbers"},
    {"step.jsonl", WITH_PROOF("{\"normal\":[0,0,1],\"kind\":\"none\",\"steps\":[{\"until\":0}]}"), 1,
     "\"normal\" is not that of a step"},
    {"part.jsonl", "{\"part_b\":-1," GOOD_REST, 1, "\"part_b\" must be a whole"},
    {"allowance.jsonl", "{\"allowance_a\":0," GOOD_REST, 1, "\"allowance_a\" must be a number above"},
    {"kind.jsonl", "{\"triangle_a\":0," GOOD_REST, 1, "\"triangle_a\" goes with a solid"},
    {"syntax.jsonl", GOOD "{\"a\":0,}\n", 2, "JSON, column"},
    {"cut.jsonl", GOOD GOOD "{\"a\":0,\"b\":1", 3, "JSON, column"},
    {"empty_line.jsonl", "\n", 1, "JSON"},
    {"array.jsonl", "[1]\n", 1, "JSON object"},
    {"missing.jsonl", "{\"a\":0}\n", 1, "\"b\" is missing"},
    {"unknown.jsonl", "{\"a\":0,\"zzz\":1}\n", 1, "\"zzz\" is not a key"},
    {"twice.jsonl", "{\"a\":0,\"a\":1}\n", 1, "JSON, column"},
    {"body.jsonl", LINE("-1", "\"separated\"", "0", "[0,0,0]", "\"gjk\"", "3", PROOF), 1,
     "\"a\" must be a name or an index"},
    {"mixed.jsonl", LINE("\"x\"", "\"separated\"", "0", "[0,0,0]", "\"gjk\"", "3", PROOF), 1, "like \"a\""},
    {"status.jsonl", LINE("0", "\"apart\"", "0", "[0,0,0]", "\"gjk\"", "3", PROOF), 1, "\"status\" is not"},
    {"limit.jsonl", LINE_LIMIT("\"moon\""), 1, "\"limit\" is not a limit"},
    {"lower.jsonl", LINE("0", "\"separated\"", "\"0\"", "[0,0,0]", "\"gjk\"", "3", PROOF), 1, "\"lower\" must be"},
    {"overflow.jsonl", LINE("0", "\"separated\"", "1e999", "[0,0,0]", "\"gjk\"", "3", PROOF), 1, "JSON, column"},
    {"point.jsonl", LINE("0", "\"separated\"", "0", "[0,0]", "\"gjk\"", "3", PROOF), 1, "\"point_a\" must be three"},
    {"stage.jsonl", LINE("0", "\"separated\"", "0", "[0,0,0]", "\"magic\"", "3", PROOF), 1, "\"stage\" is not"},
    {"iterations.jsonl", LINE("0", "\"separated\"", "0", "[0,0,0]", "\"gjk\"", "3.5", PROOF), 1, "\"iterations\" must"},
    {"proof.jsonl", WITH_PROOF("3"), 1, "\"proof\" does not belong"},
    {"proof_key.jsonl", WITH_PROOF("{\"normal\":[0,0,1],\"kind\":\"none\",\"x\":1}"), 1, "\"x\" does not belong"},
    {"kind.jsonl", WITH_PROOF("{\"normal\":[0,0,1],\"kind\":\"belief\"}"), 1, "\"kind\" is not"},
    {"no_normal.jsonl", WITH_PROOF("{\"kind\":\"none\"}"), 1, "\"normal\" must be three"},
    {"normal_low.jsonl", WITH_PROOF("{\"normal\":[0,0,1],\"normal_low\":[0,0],\"kind\":\"none\"}"), 1,
     "\"normal_low\" must be three"},
    {"weights.jsonl", WITH_PROOF("{\"normal\":[0,0,1],\"kind\":\"points\",\"a\":[1],\"b\":[1],\"weight_a\":[1]}"), 1,
     "\"weight_b\" must come with"},
    {"lengths.jsonl",
     WITH_PROOF("{\"normal\":[0,0,1],\"kind\":\"points\",\"a\":[1],\"b\":[1,2],\"weight_a\":[1],\"weight_b\":[1]}"), 1,
     "\"b\" must have as many"},
    {"seven.jsonl",
     WITH_PROOF("{\"normal\":[0,0,1],\"kind\":\"points\",\"a\":[1,2,3,4,5,6,7],\"b\":[1,2,3,4,5,6,7],"
                "\"weight_a\":[1,1,1,1,1,1,1],\"weight_b\":[1,1,1,1,1,1,1]}"),
     1, "1 to 6 items"},
    {"vertex.jsonl",
     WITH_PROOF(
         "{\"normal\":[0,0,1],\"kind\":\"points\",\"a\":[4294967296],\"b\":[1],\"weight_a\":[1],\"weight_b\":[1]}"),
     1, "\"a\" must be vertex indices"},
    {"inner.jsonl", WITH_PROOF("{\"normal\":[0,0,1],\"kind\":\"inner\"}"), 1, "\"inner_a\" does not"},
    {"cover.jsonl", WITH_PROOF("{\"normal\":[0,0,1],\"kind\":\"cover\",\"cover\":{\"pairs\":[]}}"), 1,
     "\"cover\" must have \"pairs\" and"},
    {"cover_empty.jsonl",
     WITH_PROOF("{\"normal\":[0,0,1],\"kind\":\"cover\",\"cover\":{\"pairs\":[],\"triangles\":[]}}"), 1, "1 to 32767"},
    {"cover_index.jsonl",
     WITH_PROOF("{\"normal\":[0,0,1],\"kind\":\"cover\",\"cover\":{\"pairs\":[[0,0]],\"triangles\":[[0,0,1]]}}"), 1,
     "\"cover\" must have triples"},
};

static int accepts(const char *path, ovoid_error *error) {
    ovoid_results_reader *reader = ovoid_results_reader_open(path, error);
    ovoid_record record;
    int got = 1;
    while (reader && (got = ovoid_results_reader_read(reader, &record, error)) == 1) continue;
    ovoid_results_reader_close(reader);
    return got != -1;
}

static void check_bad_lines(void) {
    check_bad_inputs(bad_lines, sizeof bad_lines / sizeof *bad_lines, accepts);
    ovoid_error error;
    CHECK(!ovoid_results_reader_open(file_path("absent.jsonl"), &error) && error.code == OVOID_ERROR_FILE);
}

// A line of more than 2^25 bytes is refused, not gathered; one of 2^22 is read.
static void check_long_lines(void) {
    for (int is_long = 0; is_long < 2; is_long++) {
        size_t size = is_long ? OVOID_RECORD_SIZE_MAX + 3000 : (size_t)1 << 22, n = strlen(GOOD);
        char *text = malloc(size);
        memset(text, ' ', size);
        memcpy(text + size - n, GOOD, n);
        ovoid_error error = {OVOID_OK, -1, ""};
        ovoid_results_reader *reader = ovoid_results_reader_open(file_write("long.jsonl", text, size), &error);
        ovoid_record record;
        int got = ovoid_results_reader_read(reader, &record, &error);
        CHECK_EQ(got, is_long ? -1 : 1);
        CHECK_EQ(error.code, is_long ? OVOID_ERROR_LIMIT : OVOID_OK);
        ovoid_results_reader_close(reader);
        free(text);
    }
}

// The longest exclusion that can be written.
static ovoid_exclusion make_long(void) {
    const double x = -0.12345678901234567e-99;
    return (ovoid_exclusion){1u << 24, 1u << 24, 1u << 24, 1u << 24, {x, x, x}, {x, x, x}, x};
}

// The largest cover is read as it was written; one point or triangle more is refused.
static void check_large_cover(void) {
    enum { POINTS = OVOID_COVER_POINTS_MAX, TRIANGLES = 2 * OVOID_COVER_POINTS_MAX };
    static own_cover own;
    uint32_t *a = malloc((POINTS + 1) * sizeof *a), *b = malloc((POINTS + 1) * sizeof *b);
    uint16_t(*triangles)[3] = malloc((TRIANGLES + 1) * sizeof *triangles);
    uint64_t s = 31;
    for (int i = 0; i <= POINTS; i++) a[i] = (uint32_t)random_next(&s), b[i] = (uint32_t)random_next(&s);
    for (int i = 0; i <= TRIANGLES; i++)
        for (int k = 0; k < 3; k++) triangles[i][k] = (uint16_t)(POINTS - 1 - i / 4);
    ovoid_record record = random_record(&s, &own);
    for (int more = 0; more < 3; more++) {
        const ovoid_cover cover = {.point_count = POINTS + (more == 1),
                                   .triangle_count = TRIANGLES + (more == 2),
                                   .a = a,
                                   .b = b,
                                   .triangles = (const uint16_t(*)[3])triangles};
        record.cover = &cover;
        char *text = write_with(ovoid_record_write_json, &record);
        CHECK_LE(strlen(text), OVOID_RECORD_SIZE_MAX / 16);
        ovoid_error error = {OVOID_OK, -1, ""};
        ovoid_record read;
        ovoid_results_reader *reader = ovoid_results_reader_open(file_write("large.jsonl", text, strlen(text)), &error);
        if (!CHECK_EQ(ovoid_results_reader_read(reader, &read, &error), more ? -1 : 1)) printf("  %s\n", error.message);
        if (!more) check_same(&record, &read);
        if (more) CHECK(strstr(error.message, more == 1 ? "1 to 32767 pairs" : "at most 65534 triangles") != NULL);
        ovoid_results_reader_close(reader);
        free(text);
    }
    free(a);
    free(b);
    free(triangles);
}

// The proof of compounds of thousands of parts, a line of megabytes, is read as it was written. As many items as a
// record may have fit into the longest line; more are refused before anything is written.
static void check_many_exclusions(void) {
    enum { COUNT = 9000 };
    static own_cover own;
    uint64_t s = 23;
    ovoid_record record = random_record(&s, &own);
    record.cover = NULL;
    ovoid_exclusion *items = malloc(COUNT * sizeof *items);
    for (int i = 0; i < COUNT; i++) items[i] = make_long();
    record.exclusions = items;
    record.exclusion_count = COUNT;
    record.step_count = record.group_count = 0;
    char *text = write_with(ovoid_record_write_json, &record);
    size_t length = strlen(text);
    CHECK_LE(2 << 20, length);
    CHECK_LE(length / COUNT * OVOID_RECORD_ITEMS_MAX, OVOID_RECORD_SIZE_MAX / 4 * 3);
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_results_reader *reader = ovoid_results_reader_open(file_write("many.jsonl", text, length), &error);
    ovoid_record read;
    if (!CHECK_EQ(ovoid_results_reader_read(reader, &read, &error), 1)) printf("  %s\n", error.message);
    CHECK(read.exclusion_count == COUNT && memcmp(read.exclusions, items, COUNT * sizeof *items) == 0);
    ovoid_results_reader_close(reader);
    free(text);
    record.step_count = OVOID_RECORD_ITEMS_MAX - COUNT + 1;
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    CHECK_EQ(ovoid_record_write_json(file, &record), OVOID_ERROR_LIMIT);
    fclose(file);
    CHECK_EQ(size, 0);
    free(text);
    free(items);
}

// Cut and changed lines: an answer or an error, never a crash.
static void check_damaged(void) {
    static own_cover own;
    uint64_t s = 17;
    ovoid_record record = random_record(&s, &own);
    own_cover_set(&own, 3, 1);
    own.triangles[0][0] = own.triangles[0][1] = own.triangles[0][2] = 2;
    record.cover = &own.cover;
    record.answer.proof.count = 3;
    char *good = write_with(ovoid_record_write_json, &record);
    size_t length = strlen(good);
    for (int i = 0; i < 1500; i++) {
        check_seed = s;
        char text[4096];
        memcpy(text, good, length);
        text[random_next(&s) % length] = "0123456789\"[]{},:.-enul \n\xff"[random_next(&s) % 26];
        size_t size = i % 3 ? length : random_next(&s) % length;
        ovoid_error error = {OVOID_OK, -1, ""};
        ovoid_results_reader *reader = ovoid_results_reader_open(file_write("damaged.jsonl", text, size), &error);
        ovoid_record found;
        int got = 1;
        while (reader && (got = ovoid_results_reader_read(reader, &found, &error)) == 1)
            CHECK_LE(found.answer.proof.count, OVOID_PROOF_PAIRS);
        CHECK(got == 0 || (error.code != OVOID_OK && error.message[0]));
        ovoid_results_reader_close(reader);
    }
    check_seed = 0;
    free(good);
}

int main(void) {
    check_golden();
    check_table();
    check_distances();
    check_table_fields();
    check_table_names();
    check_round_trip();
    check_locale();
    check_bad_lines();
    check_long_lines();
    check_many_exclusions();
    check_large_cover();
    check_damaged();
    return check_end();
}
