// Results: JSON lines and CSV for programs. One record is one line; with the shapes and poses it is enough to check the
// answer again. Numbers have 17 digits, so that they are read as the same doubles.
#include "io/json.h"
#include "io/results/record.h"

#include <math.h>
#include <string.h>

int record_is_impact(const ovoid_record *record) {
    return record->fields & OVOID_RECORD_IMPACT && !isnan(record->frame);
}

int record_has_margin(const ovoid_record *record) {
    return record->fields & OVOID_RECORD_MARGIN || record_is_impact(record);
}

const char *record_find_within(const ovoid_record *record) {
    if (!record_has_margin(record)) return "";
    int within = ovoid_answer_is_within(&record->answer, record->margin);
    if (within >= 0) return within ? "yes" : "no";
    return record->answer.limit == OVOID_LIMIT_NONE ? "at" : "unproven";
}

static ovoid_code stream_code(FILE *file) { return ferror(file) ? OVOID_ERROR_FILE : OVOID_OK; }

// ---- the proof, in JSON; q is the quote: "\"", or doubled inside a field of CSV

static void write_key(FILE *file, const char *q, const char *comma, const char *key) {
    fprintf(file, "%s%s%s%s:", comma, q, key, q);
}

static void write_vector(FILE *file, ovoid_vec3 v) {
    const double xyz[3] = {v.x, v.y, v.z};
    for (int k = 0; k < 3; k++) {
        fputc(k ? ',' : '[', file);
        json_write_number(file, xyz[k]);
    }
    fputc(']', file);
}

static void write_indices(FILE *file, const uint32_t *indices, uint32_t count) {
    for (uint32_t i = 0; i < count; i++) fprintf(file, "%c%lu", i ? ',' : '[', (unsigned long)indices[i]);
    fputs(count ? "]" : "[]", file);
}

static void write_weights(FILE *file, const double *weights, uint32_t count) {
    for (uint32_t i = 0; i < count; i++) {
        fputc(i ? ',' : '[', file);
        json_write_number(file, weights[i]);
    }
    fputs(count ? "]" : "[]", file);
}

static void write_cover(FILE *file, const char *q, const ovoid_cover *cover) {
    write_key(file, q, ",", "cover");
    write_key(file, q, "{", "pairs");
    for (uint32_t i = 0; i < cover->point_count; i++)
        fprintf(file, "%s[%lu,%lu]", i ? "," : "[", (unsigned long)cover->a[i], (unsigned long)cover->b[i]);
    write_key(file, q, "],", "triangles");
    for (uint32_t i = 0; i < cover->triangle_count; i++) {
        const uint16_t *t = cover->triangles[i];
        fprintf(file, "%s[%u,%u,%u]", i ? "," : "[", (unsigned)t[0], (unsigned)t[1], (unsigned)t[2]);
    }
    fputs(cover->triangle_count ? "]}" : "[]}", file);
}

static void write_range(FILE *file, const char *q, const char *comma, const char *key, uint32_t first, uint32_t end) {
    write_key(file, q, comma, key);
    fprintf(file, "[%lu,%lu]", (unsigned long)first, (unsigned long)end);
}

static int is_zero(ovoid_vec3 v) { return v.x == 0 && v.y == 0 && v.z == 0; }

static void write_exclusions(FILE *file, const char *q, const ovoid_record *record) {
    write_key(file, q, ",", "exclusions");
    for (size_t i = 0; i < record->exclusion_count; i++) {
        const ovoid_exclusion *x = &record->exclusions[i];
        fputc(i ? ',' : '[', file);
        write_range(file, q, "{", "a", x->first_a, x->end_a);
        write_range(file, q, ",", "b", x->first_b, x->end_b);
        write_key(file, q, ",", "normal");
        write_vector(file, x->normal);
        if (!is_zero(x->normal_low)) {
            write_key(file, q, ",", "normal_low");
            write_vector(file, x->normal_low);
        }
        write_key(file, q, ",", "lower");
        json_write_number(file, x->lower);
        fputc('}', file);
    }
    fputc(']', file);
}

static void write_steps(FILE *file, const char *q, const ovoid_record *record) {
    write_key(file, q, ",", "steps");
    for (size_t i = 0; i < record->step_count; i++) {
        fputc(i ? ',' : '[', file);
        write_key(file, q, "{", "until");
        json_write_number(file, record->steps[i].until);
        write_key(file, q, ",", "normal");
        write_vector(file, record->steps[i].normal);
        if (record->steps[i].frame != OVOID_STEP_WORLD) {
            write_key(file, q, ",", "frame");
            fprintf(file, "%s%s%s", q, record->steps[i].frame == OVOID_STEP_A ? "a" : "b", q);
        }
        fputc('}', file);
    }
    fputc(']', file);
}

static void write_groups(FILE *file, const char *q, const ovoid_record *record) {
    write_key(file, q, ",", "groups");
    for (size_t i = 0; i < record->group_count; i++) {
        const ovoid_step_group *g = &record->groups[i];
        fputc(i ? ',' : '[', file);
        write_range(file, q, "{", "a", g->first_a, g->end_a);
        write_range(file, q, ",", "b", g->first_b, g->end_b);
        write_key(file, q, ",", "count");
        fprintf(file, "%zu}", g->count);
    }
    fputc(']', file);
}

static void write_proof(FILE *file, const char *q, const ovoid_record *record) {
    const ovoid_proof *proof = &record->answer.proof;
    write_key(file, q, "{", "normal");
    write_vector(file, proof->normal);
    if (!is_zero(proof->normal_low)) {
        write_key(file, q, ",", "normal_low");
        write_vector(file, proof->normal_low);
    }
    write_key(file, q, ",", "kind");
    fprintf(file, "%s%s%s", q, ovoid_proof_kind_get_name(proof->kind), q);
    if (proof->count) {
        write_key(file, q, ",", "a");
        write_indices(file, proof->a, proof->count);
        write_key(file, q, ",", "b");
        write_indices(file, proof->b, proof->count);
        write_key(file, q, ",", "weight_a");
        write_weights(file, proof->weight_a, proof->count);
        write_key(file, q, ",", "weight_b");
        write_weights(file, proof->weight_b, proof->count);
    }
    if (proof->kind == OVOID_PROOF_INNER || proof->kind == OVOID_PROOF_INNER_POINTS) {
        write_key(file, q, ",", "inner_a");
        write_vector(file, proof->inner_a);
    }
    if (proof->kind == OVOID_PROOF_INNER_POINTS) {
        write_key(file, q, ",", "inner_b");
        write_vector(file, proof->inner_b);
    }
    if (record->cover && record->cover->point_count) write_cover(file, q, record->cover);
    if (record->exclusion_count) write_exclusions(file, q, record);
    if (record->step_count) write_steps(file, q, record);
    if (record->group_count) write_groups(file, q, record);
    record_write_surfaces(file, q, record);
    fputc('}', file);
}

// ---- JSON lines

static void write_body(FILE *file, const char *name, size_t index) {
    if (name)
        ovoid_text_write_json(file, name);
    else
        fprintf(file, "%zu", index);
}

static void write_part(FILE *file, const char *key, const ovoid_record *record, uint32_t part) {
    if (!(record->fields & OVOID_RECORD_PARTS) || part == OVOID_RECORD_NO_PART) return;
    write_key(file, "\"", ",", key);
    fprintf(file, "%lu", (unsigned long)part);
}

// Writes the keys of a motion; returns the separator before the next key.
static const char *write_times(FILE *file, const ovoid_record *record) {
    static const char *const keys[] = {"time", "frame", "free_for", "hit_after"};
    const double values[] = {record->time, record->frame, record->free_for, record->hit_after};
    int count = record_is_impact(record) ? 4 : record->fields & OVOID_RECORD_TIME ? 1 : 0;
    for (int i = 0; i < count; i++) {
        write_key(file, "\"", i ? "," : "{", keys[i]);
        json_write_number(file, values[i]);
    }
    return count ? "," : "{";
}

static void write_word(FILE *file, const char *key, const char *word) {
    write_key(file, "\"", ",", key);
    fprintf(file, "\"%s\"", word);
}

static void write_margin(FILE *file, const ovoid_record *record) {
    if (!record_has_margin(record)) return;
    write_key(file, "\"", ",", "margin");
    json_write_number(file, record->margin);
    write_word(file, "within", record_find_within(record));
}

ovoid_code ovoid_record_write_json(FILE *file, const ovoid_record *record) {
    if (record->exclusion_count + record->step_count + record->group_count > OVOID_RECORD_ITEMS_MAX)
        return OVOID_ERROR_LIMIT;
    const ovoid_answer *answer = &record->answer;
    const char *q = "\"";
    write_key(file, q, write_times(file, record), "a");
    write_body(file, record->a, record->index_a);
    write_part(file, "part_a", record, record->part_a);
    record_write_triangle(file, record, 0);
    write_key(file, q, ",", "b");
    write_body(file, record->b, record->index_b);
    write_part(file, "part_b", record, record->part_b);
    record_write_triangle(file, record, 1);
    write_word(file, "status", ovoid_status_get_name(answer->status));
    write_word(file, "limit", ovoid_limit_get_name(answer->limit));
    write_margin(file, record);
    record_write_inside(file, record);
    write_key(file, q, ",", "lower");
    json_write_number(file, answer->lower);
    write_key(file, q, ",", "upper");
    json_write_number(file, answer->upper);
    write_key(file, q, ",", "point_a");
    write_vector(file, answer->point_a);
    write_key(file, q, ",", "point_b");
    write_vector(file, answer->point_b);
    write_key(file, q, ",", "normal");
    write_vector(file, answer->normal);
    write_word(file, "stage", ovoid_stage_get_name(answer->stage));
    write_key(file, q, ",", "iterations");
    fprintf(file, "%lu", (unsigned long)answer->iterations);
    for (int side = 0; side < 2; side++) record_write_kind(file, record, side);
    write_key(file, q, ",", "proof");
    write_proof(file, q, record);
    fputs("}\n", file);
    return stream_code(file);
}

// ---- CSV (RFC 4180, with "\n" line ends)

ovoid_code ovoid_record_write_csv_header(FILE *file, unsigned fields) {
    if (fields & OVOID_RECORD_TIME) fputs("time,", file);
    if (fields & OVOID_RECORD_IMPACT) fputs("frame,free_for,hit_after,", file);
    fputs("a,part_a,b,part_b,status,limit,margin,within,lower,upper,point_a_x,point_a_y,point_a_z,point_b_x,point_b_y,"
          "point_b_z,normal_x,normal_y,normal_z,stage,iterations",
          file);
    record_write_solid_header(file, fields);
    fputs(fields & OVOID_RECORD_PROOF ? ",proof\n" : "\n", file);
    return stream_code(file);
}

static void write_csv_body(FILE *file, const char *name, size_t index) {
    if (name)
        ovoid_text_write_csv(file, name);
    else
        fprintf(file, "%zu", index);
}

void record_write_column(FILE *file, double value) {
    char digits[32];
    fwrite(digits, 1, number_write(digits, value, 17), file);
}

static void write_csv_part(FILE *file, const ovoid_record *record, uint32_t part) {
    int has_part = record->fields & OVOID_RECORD_PARTS && part != OVOID_RECORD_NO_PART;
    fputc(',', file);
    if (has_part) fprintf(file, "%lu", (unsigned long)part);
    fputc(',', file);
}

// Writes the columns of a motion; those of an impact are empty in the line of a frame.
static void write_csv_times(FILE *file, const ovoid_record *record) {
    const double values[] = {record->time, record->frame, record->free_for, record->hit_after};
    int count = record->fields & OVOID_RECORD_IMPACT ? 4 : record->fields & OVOID_RECORD_TIME ? 1 : 0;
    for (int i = 0; i < count; i++) {
        if (!i || record_is_impact(record)) record_write_column(file, values[i]);
        fputc(',', file);
    }
}

ovoid_code ovoid_record_write_csv(FILE *file, const ovoid_record *record) {
    const ovoid_answer *answer = &record->answer;
    write_csv_times(file, record);
    write_csv_body(file, record->a, record->index_a);
    write_csv_part(file, record, record->part_a);
    write_csv_body(file, record->b, record->index_b);
    write_csv_part(file, record, record->part_b);
    fprintf(file, "%s,%s,", ovoid_status_get_name(answer->status), ovoid_limit_get_name(answer->limit));
    if (record_has_margin(record)) record_write_column(file, record->margin);
    fprintf(file, ",%s", record_find_within(record));
    const ovoid_vec3 a = answer->point_a, b = answer->point_b, n = answer->normal;
    const double numbers[] = {answer->lower, answer->upper, a.x, a.y, a.z, b.x, b.y, b.z, n.x, n.y, n.z};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        fputc(',', file);
        record_write_column(file, numbers[i]);
    }
    fprintf(file, ",%s,%lu", ovoid_stage_get_name(answer->stage), (unsigned long)answer->iterations);
    record_write_solid_columns(file, record);
    if (record->fields & OVOID_RECORD_PROOF) {
        fputs(",\"", file);
        write_proof(file, "\"\"", record);
        fputc('"', file);
    }
    fputc('\n', file);
    return stream_code(file);
}
