// Files of path proofs: a line for the source, then for each path a line with its answer and a line for each step.
// Cost: linear in the text; memory: of a source and a path.
#include "ovoid/robot_proof.h"

#include "io/json.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Longest line: a path of many states.
enum { LINE_MOST = 1 << 28, MASK_BITS = 8 };

enum { JSON_FLAGS = JSON_REJECT_DUPLICATES | JSON_DECODE_INT_AS_REAL };

struct ovoid_robot_proofs_reader {
    line_source lines;
    json_t *source_json, *path_json;          ///< texts point into them
    fields_reader source_fields, path_fields; ///< their lists
    ovoid_robot_proof_source source;
    const char *const *attached; ///< of the source
    size_t attached_count;
    size_t source_count, path_count; ///< paths of the source that were read
    ovoid_robot_proof_side *sides;
    ovoid_robot_step *steps;
    size_t step_capacity;
    double *states, *times;
    ovoid_error *error;
};

// ---- tables

/// Keys that are there together, or not at all.
enum {
    SIDE_LINK = 1,
    SIDE_NAME = 2,
    SIDE_OBSTACLE = 4,
    PATH_REFUSED = 1,
    PATH_FREE = 2,
    PATH_FREE_TIME = 4,
    PATH_HIT = 8,
    PATH_HIT_TIME = 16,
    PATH_PAIR = 32,
    PATH_TIMES = 64,
    STEP_NORMAL = 1,
    SOURCE_ATTACHED = 1
};

#define TEXT "must be a text"
#define TEXTS "must be a list of texts"
#define FLAG "must be true or false"
#define STATUS "does not go with the status"

#define SIDE(member) FIELD_AT(ovoid_robot_proof_side, member)
#define SIDES "of a pair must be a link and an element, or an obstacle and a part"
static const field side_fields[] = {
    {"link", FIELD_TEXT, SIDE(link), .bit = SIDE_LINK, .wrong = TEXT, .apart = SIDES},
    {"element", FIELD_WHOLE, SIDE(number), .bit = SIDE_LINK, .wrong = WRONG_WHOLE, .apart = SIDES},
    {"name", FIELD_TEXT, SIDE(name), .bit = SIDE_NAME, .wrong = TEXT, .apart = SIDES},
    {"obstacle", FIELD_TEXT, SIDE(obstacle), .bit = SIDE_OBSTACLE, .wrong = TEXT, .apart = SIDES},
    {"part", FIELD_WHOLE, SIDE(number), .bit = SIDE_OBSTACLE, .wrong = WRONG_WHOLE, .apart = SIDES},
};
static const field_table side_table = FIELD_TABLE_READ(ovoid_robot_proof_side, side_fields, SIDES, SIDES);

static int read_side(const json_t *value, ovoid_robot_proof_side *side) {
    fields_reader reader = {.key = ""};
    *side = (ovoid_robot_proof_side){.link = NULL};
    if (fields_read(&reader, (json_t *)value, &side_table, side)) return 0;
    uint64_t wanted = side->link ? SIDE_LINK | (reader.bits & SIDE_NAME) : SIDE_OBSTACLE;
    return !fields_compare(&reader, value, &side_table, wanted) && (side->link || side->obstacle);
}

/// The first line.
typedef struct source_line {
    ovoid_robot_proof_source source;
    const char *const *attached;
    size_t attached_count;
    uint64_t version;
    ovoid_robot_proofs_reader *file;
} source_line;

// Sixteen digits.
static const char *read_digest(const json_t *value, void *line) {
    const char *text = json_string_value(value), *digits = "0123456789abcdef";
    if (!text || strlen(text) != 16 || strspn(text, digits) != 16) return "has not 16 digits";
    ((source_line *)line)->source.digest = strtoull(text, NULL, 16);
    return NULL;
}

static const char *read_pairs(const json_t *value, void *item) {
    source_line *line = item;
    size_t count = json_array_size(value);
    ovoid_robot_proof_side *sides = realloc(line->file->sides, (2 * count + 1) * sizeof *sides);
    if (!sides) return line->file->source_fields.is_memory_out = 1, "";
    line->file->sides = sides;
    for (size_t i = 0; i < 2 * count; i++) {
        const json_t *pair = json_array_get(value, i / 2);
        if (json_array_size(pair) != 2 || !read_side(json_array_get(pair, i % 2), &sides[i]))
            return "must be lists of two sides: a link and an element, or an obstacle and a part";
    }
    line->source.pairs = sides;
    line->source.pair_count = count;
    return json_is_array(value) ? NULL : "must be a list";
}

static const field_own own_digest = {NULL, read_digest}, own_pairs = {NULL, read_pairs};

#define SOURCE(member) FIELD_AT(source_line, source.member)
#define LIST(items, number) SOURCE(items), .count = offsetof(source_line, source.number), .wrong = TEXTS
static const field source_fields[] = {
    {"path_proofs", FIELD_WHOLE, FIELD_AT(source_line, version), .wrong = WRONG_WHOLE},
    {"robot", FIELD_TEXT, SOURCE(robot), .wrong = TEXT},
    {"srdf", FIELD_TEXT, SOURCE(srdf), .wrong = TEXT},
    {"scene", FIELD_TEXT, SOURCE(scene), .wrong = TEXT},
    {"packages", FIELD_TEXTS, LIST(packages, package_count)},
    {"scales", FIELD_TEXTS, LIST(scales, scale_count)},
    {"paddings", FIELD_TEXTS, LIST(paddings, padding_count)},
    {"attached", FIELD_TEXTS, FIELD_AT(source_line, attached), .count = offsetof(source_line, attached_count),
     .bit = SOURCE_ATTACHED, .wrong = TEXTS},
    {"parts", FIELD_FLAG, SOURCE(parts), .wrong = FLAG},
    {"hull", FIELD_FLAG, SOURCE(hull), .wrong = FLAG},
    {"visual", FIELD_FLAG, SOURCE(visual), .wrong = FLAG},
    {"fixed_base", FIELD_FLAG, SOURCE(fixed_base), .wrong = FLAG},
    {"cylinder_tolerance", FIELD_FINITE, SOURCE(tolerance), .wrong = WRONG_NUMBER},
    {"margin", FIELD_FINITE, SOURCE(margin), .wrong = WRONG_NUMBER},
    {"limit_slack", FIELD_FINITE, SOURCE(limit_slack), .wrong = WRONG_NUMBER},
    {"paths", FIELD_WHOLE, SOURCE(path_count), .wrong = WRONG_WHOLE},
    {"digest", FIELD_OWN, .own = &own_digest},
    {"variables", FIELD_TEXTS, LIST(variables, variable_count)},
    {"pairs", FIELD_OWN, .own = &own_pairs},
};
static const field_table source_table =
    FIELD_TABLE_READ(source_line, source_fields, "is no key of their first line", "is missing");

/// The line of a path.
typedef struct path_line {
    ovoid_robot_proof proof;
    const char *code, *variable; ///< of a refused path, for people
    ovoid_robot_proofs_reader *file;
} path_line;

static const char *name_status(int i) {
    static const char *const names[] = {"undecided", "free", "hit", "refused"};
    return names[i];
}
static const field_names statuses = {name_status, OVOID_ROBOT_UNDECIDED, OVOID_ROBOT_REFUSED};

static const char *read_a(const json_t *value, void *line) {
    return read_side(value, &((path_line *)line)->proof.a) ? NULL : SIDES;
}

static const char *read_b(const json_t *value, void *line) {
    return read_side(value, &((path_line *)line)->proof.b) ? NULL : SIDES;
}

// The states are read behind all else: read_states.
static const char *read_q(const json_t *value, void *line) {
    (void)line;
    return json_is_array(value) ? NULL : "must be a list of states";
}

static const char *read_times(const json_t *value, void *item) {
    path_line *line = item;
    size_t count = json_array_size(value);
    double *times = realloc(line->file->times, (count + 1) * sizeof *times);
    if (!times) return line->file->path_fields.is_memory_out = 1, "";
    line->file->times = times;
    for (size_t i = 0; i < count; i++) {
        if (!json_is_number(json_array_get(value, i))) return "must be numbers";
        times[i] = json_number_value(json_array_get(value, i));
    }
    line->proof.times = times;
    return count == line->proof.count ? NULL : "must be as many as there are states";
}

static const field_own own_a = {NULL, read_a}, own_b = {NULL, read_b}, own_q = {NULL, read_q},
                       own_times = {NULL, read_times};

#define PATH(member) FIELD_AT(path_line, proof.member)
static const field path_fields[] = {
    {"path", FIELD_WHOLE, PATH(number), .wrong = WRONG_WHOLE},
    {"status", FIELD_NAME, PATH(answer.status), .names = &statuses, .wrong = "is not a status"},
    {"states", FIELD_WHOLE, PATH(count), .wrong = WRONG_WHOLE},
    {"margin", FIELD_FINITE, PATH(margin), .wrong = WRONG_NUMBER},
    {"refused", FIELD_WHOLE, PATH(answer.refused), .bit = PATH_REFUSED, .wrong = WRONG_WHOLE, .apart = STATUS},
    {"code", FIELD_TEXT, FIELD_AT(path_line, code), .bit = PATH_REFUSED, .wrong = TEXT, .apart = STATUS},
    {"variable", FIELD_TEXT, FIELD_AT(path_line, variable), .bit = PATH_REFUSED, .wrong = TEXT, .apart = STATUS},
    {"free_until", FIELD_FINITE, PATH(answer.free_until), .bit = PATH_FREE, .wrong = WRONG_NUMBER, .apart = STATUS},
    {"free_until_time", FIELD_FINITE, PATH(free_until_time), .bit = PATH_FREE_TIME, .wrong = WRONG_NUMBER,
     .apart = STATUS},
    {"hit_at", FIELD_FINITE, PATH(answer.hit_at), .bit = PATH_HIT, .wrong = WRONG_NUMBER, .apart = STATUS},
    {"hit_at_time", FIELD_FINITE, PATH(hit_at_time), .bit = PATH_HIT_TIME, .wrong = WRONG_NUMBER, .apart = STATUS},
    {"segment", FIELD_WHOLE, PATH(segment), .bit = PATH_PAIR, .wrong = WRONG_WHOLE, .apart = STATUS},
    {"pair", FIELD_WHOLE, PATH(pair), .bit = PATH_PAIR, .wrong = WRONG_WHOLE, .apart = STATUS},
    {"a", FIELD_OWN, .own = &own_a, .bit = PATH_PAIR, .apart = STATUS},
    {"b", FIELD_OWN, .own = &own_b, .bit = PATH_PAIR, .apart = STATUS},
    {"lower", FIELD_NUMBER, PATH(answer.hit.lower), .bit = PATH_PAIR, .if_null = -INFINITY, .wrong = WRONG_NUMBER,
     .apart = STATUS},
    {"upper", FIELD_NUMBER, PATH(answer.hit.upper), .bit = PATH_PAIR, .if_null = INFINITY, .wrong = WRONG_NUMBER,
     .apart = STATUS},
    {"looked_at", FIELD_WHOLE, PATH(answer.states), .wrong = WRONG_WHOLE},
    {"steps", FIELD_WHOLE, PATH(answer.step_count), .wrong = WRONG_WHOLE},
    {"q", FIELD_OWN, .own = &own_q},
    {"times", FIELD_OWN, .own = &own_times, .bit = PATH_TIMES},
};
static const field_table path_table = FIELD_TABLE_READ(path_line, path_fields, "is no key of a path", "is missing");

/// The line of a step.
typedef struct step_line {
    int kind;
    double begin, end;
    ovoid_vec3 normal;
    uint32_t pair, mask;
} step_line;

static const char *name_kind(int i) {
    static const char *const names[] = {"", "outer", "middle", "ends", "solid"};
    return names[i];
}
static const field_names step_kinds = {name_kind, OVOID_ROBOT_STEP_OUTER, OVOID_ROBOT_STEP_SOLID};

static const char *read_mask(const json_t *value, void *item) {
    step_line *step = item;
    double pair = 0, last = -1;
    if (!json_array_size(value)) return "must be a list of at least one number";
    for (size_t i = 0; i < json_array_size(value); i++, last = pair) {
        if (!json_read_whole(json_array_get(value, i), UINT32_MAX, &pair)) return "must be whole numbers >= 0";
        if (i == 0) step->pair = (uint32_t)pair;
        if (pair <= last || pair - step->pair >= MASK_BITS)
            return "of a step are up to eight, their numbers ascending and less than eight apart";
        step->mask |= 1u << ((uint32_t)pair - step->pair);
    }
    return NULL;
}
static const field_own own_mask = {NULL, read_mask};

#define STEP(member) FIELD_AT(step_line, member)
#define NORMAL "must be three numbers of a step \"middle\" or \"ends\""
static const field step_fields[] = {
    {"step", FIELD_NAME, STEP(kind), .names = &step_kinds, .wrong = "is no kind of step"},
    {"begin", FIELD_FINITE, STEP(begin), .wrong = WRONG_NUMBER},
    {"end", FIELD_FINITE, STEP(end), .wrong = WRONG_NUMBER},
    {"normal", FIELD_VECTOR, STEP(normal), .bit = STEP_NORMAL, .wrong = NORMAL, .apart = NORMAL},
    {"pairs", FIELD_OWN, .own = &own_mask},
};
static const field_table step_table = FIELD_TABLE_READ(step_line, step_fields, "is no key of a step", "is missing");

// ---- lines

static where get_place(const ovoid_robot_proofs_reader *f) { return (where){f->lines.path, f->lines.line, -1}; }

// Fills the error: -1.
static int fail(ovoid_robot_proofs_reader *f, const fields_reader *reader, const char *wrong) {
    if (reader->is_memory_out)
        (void)io_fail_memory(f->error, f->lines.path);
    else
        io_report(f->error, OVOID_ERROR_FORMAT, get_place(f), "no line of path proofs: \"%.40s\" %s", reader->key,
                  wrong);
    return -1;
}

static int fail_json(ovoid_robot_proofs_reader *f, const json_error_t *why) {
    ovoid_code code = json_get_failure(why);
    if (code == OVOID_ERROR_MEMORY)
        (void)io_fail_memory(f->error, f->lines.path);
    else
        io_report(f->error, code, get_place(f), "no line of path proofs: JSON, column %d: %s", why->column, why->text);
    return -1;
}

// The next line, but for the items of its "q"; 0 at the end, -1: *error is filled.
static int next_line(ovoid_robot_proofs_reader *f, json_t **line, json_list *states) {
    const char *text = NULL;
    size_t length = 0;
    json_error_t why;
    *line = NULL;
    int got = line_source_next(&f->lines, &text, &length, f->error);
    if (got <= 0) return got;
    *line = json_load_around((bytes){(char *)text, length}, "q", JSON_FLAGS, states, &why);
    return *line ? 1 : fail_json(f, &why);
}

// ---- a step

static const char *make_step(const step_line *line, ovoid_robot_step *step) {
    if (isnan(line->normal.x + line->normal.y + line->normal.z)) return NORMAL;
    *step = (ovoid_robot_step){.kind = (uint16_t)line->kind,
                               .begin = line->begin,
                               .end = line->end,
                               .normal = line->normal,
                               .pair = line->pair,
                               .mask = (uint16_t)line->mask};
    return NULL;
}

static int read_step(ovoid_robot_proofs_reader *f, json_t *json, ovoid_robot_step *step) {
    fields_reader reader = {.key = "step"};
    step_line line = {.kind = 0};
    const char *wrong = fields_read(&reader, json, &step_table, &line);
    int has_normal = line.kind == OVOID_ROBOT_STEP_MIDDLE || line.kind == OVOID_ROBOT_STEP_ENDS;
    if (!wrong) wrong = fields_compare(&reader, json, &step_table, has_normal ? STEP_NORMAL : 0);
    if (!wrong) wrong = make_step(&line, step);
    return wrong ? fail(f, &reader, wrong) : 1;
}

// The steps behind an answer. 1, or -1 with the error filled.
static int read_steps(ovoid_robot_proofs_reader *f, ovoid_robot_proof *p) {
    size_t count = p->answer.step_count;
    int got = 1;
    for (size_t i = 0; i < count && got > 0; i++) {
        json_t *line;
        json_list states;
        got = next_line(f, &line, &states);
        if (got == 0) {
            got = -1;
            io_report(f->error, OVOID_ERROR_FORMAT, get_place(f), "it ends after %zu of %zu steps: it was cut off", i,
                      count);
        }
        void *items = f->steps;
        if (got > 0 && !array_reserve(&items, &f->step_capacity, i, sizeof *f->steps))
            (void)io_fail_memory(f->error, f->lines.path), got = -1;
        f->steps = items;
        if (got > 0) got = read_step(f, line, &f->steps[i]);
        json_decref(line);
    }
    p->steps = f->steps;
    return got;
}

// ---- a path

static const char *read_state(const json_t *state, double *q, size_t count) {
    if (json_array_size(state) != count) return "must have as many numbers in a state as there are variables";
    for (size_t i = 0; i < count; i++) {
        if (!json_is_number(json_array_get(state, i))) return "must be lists of numbers";
        q[i] = json_number_value(json_array_get(state, i));
    }
    return NULL;
}

// All numbers of the states, one after another.
static int read_states(ovoid_robot_proofs_reader *f, json_list *list, ovoid_robot_proof *p) {
    size_t variables = f->source.variable_count, count = 0, capacity = 0;
    fields_reader reader = {.key = "q"};
    json_error_t why;
    json_t *state;
    const char *wrong = NULL;
    int got;
    while (!wrong && (got = json_next(list, &state, &why)) > 0) {
        if (count == capacity) {
            capacity = 2 * capacity + 16;
            double *grown = realloc(f->states, (capacity * variables + 1) * sizeof *grown);
            reader.is_memory_out = !grown;
            f->states = grown ? grown : f->states;
        }
        wrong = reader.is_memory_out ? "" : read_state(state, f->states + count++ * variables, variables);
        json_decref(state);
    }
    if (!wrong && got < 0) return fail_json(f, &why);
    if (!wrong && (count != p->count || count == 0)) wrong = "must be as many states as it says";
    p->states = f->states;
    return wrong ? fail(f, &reader, wrong) : 1;
}

// What keys a path has by its status; where a path was given up before a pair was measured, none is named.
static uint64_t find_bits(ovoid_robot_status status, uint64_t found) {
    uint64_t times = found & PATH_TIMES;
    if (status == OVOID_ROBOT_REFUSED) return times | PATH_REFUSED;
    times |= PATH_FREE | (found & PATH_FREE_TIME);
    if (status == OVOID_ROBOT_HIT) return times | PATH_HIT | (found & PATH_HIT_TIME) | PATH_PAIR;
    return status == OVOID_ROBOT_UNDECIDED ? times | (found & PATH_PAIR) : times;
}

// Takes the line over. 1, or -1 with the error filled.
static int read_path(ovoid_robot_proofs_reader *f, json_t *json, json_list *states, ovoid_robot_proof *p) {
    path_line line = {.proof = *p, .file = f};
    json_decref(f->path_json);
    f->path_json = json;
    f->path_fields.key = "path";
    const char *wrong = fields_read(&f->path_fields, json, &path_table, &line);
    ovoid_robot_status status = line.proof.answer.status;
    uint64_t bits = find_bits(status, f->path_fields.bits);
    if (!wrong) wrong = fields_compare(&f->path_fields, json, &path_table, bits);
    *p = line.proof;
    p->source = f->source_count - 1;
    p->line = f->lines.line;
    p->answer.hit.status = status;
    p->has_pair = (bits & PATH_PAIR) != 0;
    if (!wrong && (p->number != f->path_count || p->number >= f->source.path_count)) {
        f->path_fields.key = "path";
        wrong = "must be numbered 0, 1, 2, ..., and no more than were announced";
    }
    f->path_count++;
    return wrong ? fail(f, &f->path_fields, wrong) : read_states(f, states, p);
}

// ---- a source

static int read_source(ovoid_robot_proofs_reader *f, json_t *json) {
    source_line line = {.file = f};
    fields_reader_clear(&f->source_fields);
    json_decref(f->source_json);
    f->source_json = json;
    f->source_count++;
    f->path_count = 0;
    const char *wrong = fields_read(&f->source_fields, json, &source_table, &line);
    if (!wrong && line.version != 2)
        f->source_fields.key = "path_proofs", wrong = "is not 2: they were written by another version";
    if (!wrong && !line.source.robot) f->source_fields.key = "robot", wrong = TEXT;
    f->source = line.source;
    f->attached = line.attached;
    f->attached_count = line.attached_count;
    return wrong ? fail(f, &f->source_fields, wrong) : 1;
}

// Checks the number of paths where a source ends: 0, or -1 with the error filled.
static int check_paths(const ovoid_robot_proofs_reader *f) {
    if (f->path_count == f->source.path_count) return 0;
    io_report(f->error, OVOID_ERROR_FORMAT, get_place(f), "there are %zu of %zu paths: it was cut off", f->path_count,
              f->source.path_count);
    return -1;
}

int ovoid_robot_proofs_reader_read(ovoid_robot_proofs_reader *f, ovoid_robot_proof *p, ovoid_error *error) {
    *p = (ovoid_robot_proof){.answer = {.hit_at = INFINITY}, .free_until_time = NAN, .hit_at_time = NAN};
    f->error = error;
    for (;;) {
        json_t *line;
        json_list states;
        int got = next_line(f, &line, &states);
        if (got == 0) return check_paths(f);
        if (got < 0) return got;
        if (!json_object_get(line, "path_proofs")) {
            if (f->source_count) return read_path(f, line, &states, p) < 0 ? -1 : read_steps(f, p);
            json_decref(line);
            io_report(error, OVOID_ERROR_FORMAT, get_place(f),
                      "no line of path proofs: the first line does not say which robot and obstacles they are of");
            return -1;
        }
        if (check_paths(f) < 0) {
            json_decref(line);
            return -1;
        }
        if (read_source(f, line) < 0) return -1;
    }
}

// ---- the file

ovoid_robot_proofs_reader *ovoid_robot_proofs_reader_open(const char *path, ovoid_error *error) {
    ovoid_robot_proofs_reader *f = calloc(1, sizeof *f);
    if (!f) return (void)io_fail_memory(error, path), NULL;
    if (line_source_open(&f->lines, path, error) != OVOID_OK) return free(f), NULL;
    f->lines.most = LINE_MOST;
    return f;
}

void ovoid_robot_proofs_reader_close(ovoid_robot_proofs_reader *f) {
    if (!f) return;
    line_source_close(&f->lines);
    json_decref(f->source_json);
    json_decref(f->path_json);
    fields_reader_clear(&f->source_fields);
    fields_reader_clear(&f->path_fields);
    free(f->sides);
    free(f->steps);
    free(f->states);
    free(f->times);
    free(f);
}

const ovoid_robot_proof_source *ovoid_robot_proofs_reader_get_source(const ovoid_robot_proofs_reader *f) {
    return f->source_count ? &f->source : NULL;
}

const char *const *ovoid_robot_proofs_reader_get_attached(const ovoid_robot_proofs_reader *f, size_t *count) {
    *count = f->attached_count;
    return f->attached;
}

int64_t ovoid_robot_proofs_reader_get_line(const ovoid_robot_proofs_reader *f) { return f->lines.line; }
