// Results files, read strictly, as a file to be checked must be. Each line is a JSON object with the keys that
// ovoid_record_write_json writes, each once and no other; every number in the range of its field.
#include "io/json.h"
#include "io/results/record.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct ovoid_results_reader {
    line_source source;
    json_t *line;      ///< of the last record, whose names point into it
    ovoid_cover cover; ///< of the last record, as are the next two
    ovoid_exclusion *exclusions;
    ovoid_step *steps;
    ovoid_step_group *groups;
    ovoid_solid_answer solid;
    ovoid_error *error;
};

static ovoid_code fail(ovoid_results_reader *r, const char *key, const char *what) {
    where at = {r->source.path, r->source.line, -1};
    return io_fail(r->error, OVOID_ERROR_FORMAT, at, "\"%.40s\" %s", key, what);
}

// ---- values

// 1 if the object has all of the first `needed` of these keys, and no others than these; else *bad is the offending
// key.
static int has_keys(json_t *object, const char *const *keys, size_t count, size_t needed, const char **bad) {
    const char *key;
    json_t *value;
    json_object_foreach(object, key, value) {
        size_t i = 0;
        while (i < count && strcmp(keys[i], key) != 0) i++;
        *bad = key;
        if (i == count) return 0;
    }
    for (size_t i = 0; i < needed; i++) {
        *bad = keys[i];
        if (!json_object_get(object, keys[i])) return 0;
    }
    return 1;
}

int record_read_whole(const json_t *value, double top, double *whole) {
    if (!json_is_number(value)) return 0;
    *whole = json_number_value(value);
    return *whole >= 0 && *whole <= top && *whole == floor(*whole);
}

int record_read_number(const json_t *value, double if_null, double *number) {
    *number = json_is_null(value) ? if_null : json_number_value(value);
    return json_is_number(value) || json_is_null(value);
}

int record_read_vector(const json_t *value, ovoid_vec3 *v) {
    double xyz[3];
    int good = json_is_array(value) && json_array_size(value) == 3;
    for (size_t k = 0; k < 3 && good; k++) good = record_read_number(json_array_get(value, k), NAN, &xyz[k]);
    if (good) *v = (ovoid_vec3){xyz[0], xyz[1], xyz[2]};
    return good;
}

static ovoid_code read_vector(ovoid_results_reader *r, const json_t *object, const char *key, ovoid_vec3 *v) {
    return record_read_vector(json_object_get(object, key), v) ? OVOID_OK : fail(r, key, "must be three numbers");
}

// ---- names of enums, as the core's naming functions give them

int record_find_status(const char *text) {
    for (int i = OVOID_UNDECIDED; i <= OVOID_OVERLAPPING; i++)
        if (strcmp(ovoid_status_get_name((ovoid_status)i), text) == 0) return i;
    return -1;
}

int record_find_limit(const char *text) {
    for (int i = OVOID_LIMIT_NONE; i <= OVOID_LIMIT_ALLOWANCE; i++)
        if (strcmp(ovoid_limit_get_name((ovoid_limit)i), text) == 0) return i;
    return -1;
}

static int find_stage(const char *text) {
    for (int i = OVOID_STAGE_NONE; i <= OVOID_STAGE_REFINE; i++)
        if (strcmp(ovoid_stage_get_name((ovoid_stage)i), text) == 0) return i;
    return -1;
}

static int find_kind(const char *text) {
    for (int i = OVOID_PROOF_NONE; i <= OVOID_PROOF_COVER; i++)
        if (strcmp(ovoid_proof_kind_get_name((ovoid_proof_kind)i), text) == 0) return i;
    return -1;
}

static ovoid_code read_status(ovoid_results_reader *r, const json_t *line, ovoid_answer *answer) {
    const char *status_name = json_string_value(json_object_get(line, "status"));
    const char *limit_name = json_string_value(json_object_get(line, "limit"));
    int status = status_name ? record_find_status(status_name) : -1,
        limit = limit_name ? record_find_limit(limit_name) : -1;
    if (status < 0) return fail(r, "status", "is not a status");
    if (limit < 0) return fail(r, "limit", "is not a limit");
    answer->status = (ovoid_status)status;
    answer->limit = (ovoid_limit)limit;
    return OVOID_OK;
}

// ---- the proof

static ovoid_code read_indices(ovoid_results_reader *r, const json_t *proof, const char *key, uint32_t count,
                               uint32_t *indices) {
    const json_t *value = json_object_get(proof, key);
    if (json_array_size(value) != count) return fail(r, key, "must have as many items as \"a\"");
    for (uint32_t i = 0; i < count; i++) {
        double whole;
        if (!record_read_whole(json_array_get(value, i), UINT32_MAX, &whole))
            return fail(r, key, "must be vertex indices");
        indices[i] = (uint32_t)whole;
    }
    return OVOID_OK;
}

static ovoid_code read_weights(ovoid_results_reader *r, const json_t *proof, const char *key, uint32_t count,
                               double *weights) {
    const json_t *value = json_object_get(proof, key);
    if (json_array_size(value) != count) return fail(r, key, "must have as many items as \"a\"");
    for (uint32_t i = 0; i < count; i++)
        if (!record_read_number(json_array_get(value, i), NAN, &weights[i])) return fail(r, key, "must be weights");
    return OVOID_OK;
}

static ovoid_code read_points(ovoid_results_reader *r, const json_t *json, ovoid_proof *proof) {
    static const char *const keys[] = {"a", "b", "weight_a", "weight_b"};
    int present = 0;
    for (int i = 0; i < 4; i++) present += json_object_get(json, keys[i]) != NULL;
    if (!present) return OVOID_OK;
    size_t count = json_array_size(json_object_get(json, "a"));
    if (present < 4 || count < 1 || count > OVOID_PROOF_PAIRS)
        return fail(r, "proof", "needs a, b, weight_a, weight_b of 1 to 6 items");
    proof->count = (uint32_t)count;
    ovoid_code code = read_indices(r, json, "a", proof->count, proof->a);
    if (!code) code = read_indices(r, json, "b", proof->count, proof->b);
    if (!code) code = read_weights(r, json, "weight_a", proof->count, proof->weight_a);
    return code ? code : read_weights(r, json, "weight_b", proof->count, proof->weight_b);
}

// Reads the points of the inner ellipsoids, which must be there exactly where the kind has them.
static ovoid_code read_inner(ovoid_results_reader *r, const json_t *json, ovoid_proof *proof) {
    int has_a = proof->kind == OVOID_PROOF_INNER || proof->kind == OVOID_PROOF_INNER_POINTS;
    int has_b = proof->kind == OVOID_PROOF_INNER_POINTS;
    if ((json_object_get(json, "inner_a") != NULL) != has_a) return fail(r, "inner_a", "does not go with the kind");
    if ((json_object_get(json, "inner_b") != NULL) != has_b) return fail(r, "inner_b", "does not go with the kind");
    ovoid_code code = has_a ? read_vector(r, json, "inner_a", &proof->inner_a) : OVOID_OK;
    return code || !has_b ? code : read_vector(r, json, "inner_b", &proof->inner_b);
}

// Reads an array of `width` whole numbers from 0 to top.
static int read_item(const json_t *item, size_t width, double top, double *numbers) {
    if (!json_is_array(item) || json_array_size(item) != width) return 0;
    for (size_t k = 0; k < width; k++)
        if (!record_read_whole(json_array_get(item, k), top, &numbers[k])) return 0;
    return 1;
}

static ovoid_code read_cover(ovoid_results_reader *r, json_t *json) {
    static const char *const keys[] = {"pairs", "triangles"};
    const char *bad = "cover";
    if (!json_is_object(json) || !has_keys(json, keys, 2, 2, &bad)) return fail(r, bad, "does not belong into a cover");
    const json_t *pairs = json_object_get(json, "pairs"), *triangles = json_object_get(json, "triangles");
    size_t points = json_array_size(pairs), count = json_array_size(triangles);
    if (!json_is_array(pairs) || !points || points > OVOID_COVER_POINTS)
        return fail(r, "pairs", "must be a list of 1 to 512 pairs");
    if (!json_is_array(triangles) || count > 2 * OVOID_COVER_POINTS)
        return fail(r, "triangles", "must be a list of at most 1024 triangles");
    double v[3];
    for (size_t i = 0; i < points; i++) {
        if (!read_item(json_array_get(pairs, i), 2, UINT32_MAX, v))
            return fail(r, "pairs", "must be pairs of vertices");
        r->cover.a[i] = (uint32_t)v[0];
        r->cover.b[i] = (uint32_t)v[1];
    }
    for (size_t i = 0; i < count; i++) {
        if (!read_item(json_array_get(triangles, i), 3, (double)(points - 1), v))
            return fail(r, "triangles", "must be triples of pairs");
        for (int k = 0; k < 3; k++) r->cover.triangles[i][k] = (uint16_t)v[k];
    }
    r->cover.point_count = (uint32_t)points;
    r->cover.triangle_count = (uint32_t)count;
    return OVOID_OK;
}

// Reads both ends of a range of parts.
static int read_range(const json_t *json, const char *key, uint32_t *first, uint32_t *end) {
    double v[2];
    if (!read_item(json_object_get(json, key), 2, UINT32_MAX, v)) return 0;
    *first = (uint32_t)v[0];
    *end = (uint32_t)v[1];
    return 1;
}

static ovoid_code read_exclusion(ovoid_results_reader *r, json_t *json, ovoid_exclusion *x) {
    static const char *const keys[] = {"a", "b", "normal", "lower", "normal_low"};
    const char *bad = "exclusions";
    *x = (ovoid_exclusion){.first_a = 0};
    if (!json_is_object(json) || !has_keys(json, keys, 5, 4, &bad)) return fail(r, bad, "is not that of an exclusion");
    if (!read_range(json, "a", &x->first_a, &x->end_a) || !read_range(json, "b", &x->first_b, &x->end_b))
        return fail(r, bad, "must have ranges of two whole numbers");
    if (!record_read_number(json_object_get(json, "lower"), -INFINITY, &x->lower))
        return fail(r, "lower", "must be a number");
    ovoid_code code = read_vector(r, json, "normal", &x->normal);
    return code || !json_object_get(json, "normal_low") ? code : read_vector(r, json, "normal_low", &x->normal_low);
}

static ovoid_code read_exclusions(ovoid_results_reader *r, const json_t *json, ovoid_record *record) {
    size_t count = json_array_size(json);
    if (!count) return fail(r, "exclusions", "must be a list, not an empty one");
    ovoid_exclusion *items = realloc(r->exclusions, count * sizeof *items);
    if (!items) return io_fail_memory(r->error, r->source.path);
    r->exclusions = items;
    record->exclusions = items;
    record->exclusion_count = count;
    ovoid_code code = OVOID_OK;
    for (size_t i = 0; i < count && !code; i++) code = read_exclusion(r, json_array_get(json, i), &items[i]);
    return code;
}

static ovoid_code read_frame(ovoid_results_reader *r, const json_t *json, ovoid_step_frame *frame) {
    const char *name = json_string_value(json);
    *frame = OVOID_STEP_WORLD;
    if (!json) return OVOID_OK;
    if (name && strcmp(name, "a") == 0) return *frame = OVOID_STEP_A, OVOID_OK;
    if (name && strcmp(name, "b") == 0) return *frame = OVOID_STEP_B, OVOID_OK;
    return fail(r, "frame", "of a step must be \"a\" or \"b\"");
}

static ovoid_code read_steps(ovoid_results_reader *r, const json_t *json, ovoid_record *record) {
    static const char *const keys[] = {"until", "normal", "frame"};
    size_t count = json_array_size(json);
    if (!count) return fail(r, "steps", "must be a list, not an empty one");
    ovoid_step *items = realloc(r->steps, count * sizeof *items);
    if (!items) return io_fail_memory(r->error, r->source.path);
    r->steps = items;
    record->steps = items;
    record->step_count = count;
    ovoid_code code = OVOID_OK;
    for (size_t i = 0; i < count && !code; i++) {
        json_t *step = json_array_get(json, i);
        const char *bad = "steps";
        if (!json_is_object(step) || !has_keys(step, keys, 3, 2, &bad)) return fail(r, bad, "is not that of a step");
        if (!record_read_number(json_object_get(step, "until"), NAN, &items[i].until))
            return fail(r, "until", "must be a number");
        code = read_vector(r, step, "normal", &items[i].normal);
        if (!code) code = read_frame(r, json_object_get(step, "frame"), &items[i].frame);
    }
    return code;
}

static ovoid_code read_groups(ovoid_results_reader *r, const json_t *json, ovoid_record *record) {
    static const char *const keys[] = {"a", "b", "count"};
    size_t count = json_array_size(json);
    if (!count) return fail(r, "groups", "must be a list, not an empty one");
    ovoid_step_group *items = realloc(r->groups, count * sizeof *items);
    if (!items) return io_fail_memory(r->error, r->source.path);
    r->groups = items;
    record->groups = items;
    record->group_count = count;
    for (size_t i = 0; i < count; i++) {
        json_t *group = json_array_get(json, i);
        const char *bad = "groups";
        double steps;
        if (!json_is_object(group) || !has_keys(group, keys, 3, 3, &bad)) return fail(r, bad, "is not that of a group");
        if (!read_range(group, "a", &items[i].first_a, &items[i].end_a) ||
            !read_range(group, "b", &items[i].first_b, &items[i].end_b))
            return fail(r, "groups", "must have ranges of two whole numbers");
        if (!record_read_whole(json_object_get(group, "count"), UINT32_MAX, &steps))
            return fail(r, "count", "must be a whole number >= 0");
        items[i].count = (size_t)steps;
    }
    return OVOID_OK;
}

static ovoid_code read_proof(ovoid_results_reader *r, json_t *json, ovoid_record *record) {
    static const char *const keys[] = {"normal",     "normal_low", "kind",    "a",        "b",
                                       "weight_a",   "weight_b",   "inner_a", "inner_b",  "cover",
                                       "exclusions", "steps",      "groups",  "surfaces", "parting"};
    ovoid_proof *proof = &record->answer.proof;
    const char *bad = "proof";
    if (!json_is_object(json) || !has_keys(json, keys, 15, 0, &bad))
        return fail(r, bad, "does not belong into a proof");
    const char *kind = json_string_value(json_object_get(json, "kind"));
    int found = kind ? find_kind(kind) : -1;
    if (found < 0) return fail(r, "kind", "is not a kind of proof");
    proof->kind = (ovoid_proof_kind)found;
    ovoid_code code = read_vector(r, json, "normal", &proof->normal);
    if (!code && json_object_get(json, "normal_low")) code = read_vector(r, json, "normal_low", &proof->normal_low);
    if (!code) code = read_points(r, json, proof);
    if (!code) code = read_inner(r, json, proof);
    json_t *cover = json_object_get(json, "cover"), *exclusions = json_object_get(json, "exclusions");
    json_t *steps = json_object_get(json, "steps"), *groups = json_object_get(json, "groups");
    if (!code && exclusions) code = read_exclusions(r, exclusions, record);
    if (!code && steps) code = read_steps(r, steps, record);
    if (!code && groups) code = read_groups(r, groups, record);
    if (code || !cover) return code;
    record->cover = &r->cover;
    return read_cover(r, cover);
}

// ---- the record

// Reads a name or an index.
static int read_body(const json_t *value, const char **name, size_t *index) {
    double whole = 0;
    *name = json_string_value(value);
    if (!*name && !record_read_whole(value, 9007199254740992.0, &whole)) return 0;
    *index = (size_t)whole;
    return 1;
}

static ovoid_code read_bodies(ovoid_results_reader *r, const json_t *line, ovoid_record *record) {
    if (!read_body(json_object_get(line, "a"), &record->a, &record->index_a))
        return fail(r, "a", "must be a name or an index");
    if (!read_body(json_object_get(line, "b"), &record->b, &record->index_b))
        return fail(r, "b", "must be a name or an index");
    if (!record->a != !record->b) return fail(r, "b", "must be a name or an index like \"a\"");
    return OVOID_OK;
}

static int read_part(const json_t *value, ovoid_record *record, uint32_t *part) {
    double whole;
    *part = OVOID_RECORD_NO_PART;
    if (!value) return 1;
    if (!record_read_whole(value, OVOID_RECORD_NO_PART - 1, &whole)) return 0;
    *part = (uint32_t)whole;
    record->fields |= OVOID_RECORD_PARTS;
    return 1;
}

static ovoid_code read_parts(ovoid_results_reader *r, const json_t *line, ovoid_record *record) {
    if (!read_part(json_object_get(line, "part_a"), record, &record->part_a))
        return fail(r, "part_a", "must be a whole number >= 0");
    if (!read_part(json_object_get(line, "part_b"), record, &record->part_b))
        return fail(r, "part_b", "must be a whole number >= 0");
    return OVOID_OK;
}

// Reads a time alone, or all four of an impact.
static ovoid_code read_times(ovoid_results_reader *r, const json_t *line, ovoid_record *record) {
    static const char *const keys[] = {"time", "frame", "free_for", "hit_after"};
    double *const values[] = {&record->time, &record->frame, &record->free_for, &record->hit_after};
    int present = 0;
    for (int i = 1; i < 4; i++) present += json_object_get(line, keys[i]) != NULL;
    int count = present ? 4 : json_object_get(line, "time") ? 1 : 0;
    record->frame = NAN;
    for (int i = 0; i < count; i++) {
        const json_t *value = json_object_get(line, keys[i]);
        int is_open = i == 3 && json_is_null(value);
        if (!json_is_number(value) && !is_open)
            return fail(r, keys[i], present ? "must be a number, as all of an impact" : "must be a number");
        *values[i] = is_open ? INFINITY : json_number_value(value);
    }
    if (count) record->fields |= OVOID_RECORD_TIME;
    if (present) record->fields |= OVOID_RECORD_IMPACT;
    return OVOID_OK;
}

// Reads the margin, which an impact has, and the word about it, which must be that of the bracket.
static ovoid_code read_margin(ovoid_results_reader *r, const json_t *line, ovoid_record *record) {
    const json_t *margin = json_object_get(line, "margin"), *within = json_object_get(line, "within");
    if (!margin && !within && !record_is_impact(record)) return OVOID_OK;
    if (!json_is_number(margin)) return fail(r, "margin", "must be a number, with \"within\" and of an impact");
    record->margin = json_number_value(margin);
    record->fields |= OVOID_RECORD_MARGIN;
    const char *word = json_string_value(within);
    if (word && strcmp(word, record_find_within(record)) == 0) return OVOID_OK;
    return fail(r, "within", "is not what the bracket and the limit say of the margin");
}

static ovoid_code read_answer(ovoid_results_reader *r, json_t *line, ovoid_record *record) {
    ovoid_answer *answer = &record->answer;
    ovoid_code code = read_status(r, line, answer);
    if (!code && !record_read_number(json_object_get(line, "lower"), -INFINITY, &answer->lower))
        code = fail(r, "lower", "must be a number");
    if (!code && !record_read_number(json_object_get(line, "upper"), INFINITY, &answer->upper))
        code = fail(r, "upper", "must be a number");
    if (!code) code = read_margin(r, line, record);
    if (!code) code = read_vector(r, line, "point_a", &answer->point_a);
    if (!code) code = read_vector(r, line, "point_b", &answer->point_b);
    if (!code) code = read_vector(r, line, "normal", &answer->normal);
    if (code) return code;
    const char *name = json_string_value(json_object_get(line, "stage"));
    int stage = name ? find_stage(name) : -1;
    if (stage < 0) return fail(r, "stage", "is not a stage");
    answer->stage = (ovoid_stage)stage;
    double iterations;
    if (!record_read_whole(json_object_get(line, "iterations"), UINT32_MAX, &iterations))
        return fail(r, "iterations", "must be a whole number >= 0");
    answer->iterations = (uint32_t)iterations;
    return read_proof(r, json_object_get(line, "proof"), record);
}

// What is wrong with a key that is there, or is not.
static const char *find_key_fault(const json_t *line, const char *key) {
    if (json_object_get(line, key)) return "is not a key of results";
    return strcmp(key, "proof") == 0 ? "is missing: nothing can be checked without it" : "is missing";
}

static ovoid_code read_record(ovoid_results_reader *r, const char *text, size_t length, ovoid_record *record) {
    static const char *const keys[] = {
        "a",          "b",           "status",      "limit",         "lower",         "upper",         "point_a",
        "point_b",    "normal",      "stage",       "iterations",    "proof",         "time",          "frame",
        "margin",     "within",      "part_a",      "part_b",        "free_for",      "hit_after",     "kind_a",
        "kind_b",     "allowance_a", "allowance_b", "mesh_volume_a", "mesh_volume_b", "hull_volume_a", "hull_volume_b",
        "triangle_a", "triangle_b",  "inside",      "component",     "common"};
    enum { ALL = sizeof keys / sizeof *keys, NEEDED = 12 };
    where at = {r->source.path, r->source.line, -1};
    json_error_t why;
    json_decref(r->line);
    r->line = NULL;
    size_t begin = 0;
    while (begin < length && (text[begin] == ' ' || text[begin] == '\t')) begin++;
    if (begin == length || text[begin] != '{')
        return io_fail(r->error, OVOID_ERROR_FORMAT, at,
                       "no JSON object; results are read as JSON Lines, which have proofs, not as CSV or a table");
    r->line = json_load((bytes){(char *)text, length}, JSON_REJECT_DUPLICATES | JSON_DECODE_INT_AS_REAL, &why);
    if (!r->line && json_get_failure(&why) == OVOID_ERROR_MEMORY) return io_fail_memory(r->error, r->source.path);
    if (!r->line) return io_fail(r->error, json_get_failure(&why), at, "JSON, column %d: %s", why.column, why.text);
    const char *bad = "line";
    if (!has_keys(r->line, keys, ALL, NEEDED, &bad)) return fail(r, bad, find_key_fault(r->line, bad));
    *record = (ovoid_record){.a = NULL};
    ovoid_code code = read_bodies(r, r->line, record);
    if (!code) code = read_parts(r, r->line, record);
    if (!code) code = read_times(r, r->line, record);
    if (!code) code = read_answer(r, r->line, record);
    const char *wrong = code ? NULL : record_read_solid(r->line, record, &r->solid, &bad);
    return wrong ? fail(r, bad, wrong) : code;
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
    reader->error = error;
    int got = line_source_next(&reader->source, &line, &length, error);
    if (got <= 0) return got;
    return read_record(reader, line, length, record) ? -1 : 1;
}

int64_t ovoid_results_reader_get_line(const ovoid_results_reader *reader) { return reader->source.line; }

void ovoid_results_reader_close(ovoid_results_reader *reader) {
    if (!reader) return;
    line_source_close(&reader->source);
    json_decref(reader->line);
    free(reader->exclusions);
    free(reader->steps);
    free(reader->groups);
    free(reader);
}
