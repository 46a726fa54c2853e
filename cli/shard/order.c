// Lines are those that the tool wrote: CSV without line ends in its fields, and JSON whose first members are texts,
// numbers and lists of these.
#include "shard/order.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

shard_order shard_get_order(const char *command) {
    static const char *const commands[] = {"batch", "robot check", "check", "run"};
    int i = SHARD_BY_TIME;
    while (i > 0 && strcmp(commands[i], command) != 0) i--;
    return (shard_order)i;
}

int shard_key_compare(const shard_key *a, const shard_key *b) {
    for (int i = 0; i < 3; i++)
        if (a->words[i] != b->words[i]) return a->words[i] < b->words[i] ? -1 : 1;
    return 0;
}

/// A number as a word of a key: words compare as numbers do; both zeros are one.
static uint64_t make_word(double number) {
    uint64_t bits;
    number += 0.0; // minus zero becomes zero
    memcpy(&bits, &number, sizeof bits);
    return bits >> 63 ? ~bits : bits | (uint64_t)1 << 63;
}

/* ---- fields of a line */

/// A piece of a line.
typedef struct text {
    const char *at;
    size_t size;
} text;

/// The end of a text in quotes, behind them; a backslash of JSON hides a quote.
static const char *skip_quoted(const char *at, int is_json) {
    for (at++; *at && *at != '"'; at++) at += is_json && *at == '\\' && at[1];
    return *at ? at + 1 : at;
}

/// The end of a value: the comma behind it, or the end of the line.
static const char *skip_value(const char *at, int is_json) {
    for (int depth = 0; *at && *at != '\n' && (depth || (*at != ',' && !(is_json && *at == '}'))); at++) {
        if (*at == '"') at = skip_quoted(at, is_json) - 1;
        depth += is_json && (*at == '[' || *at == '{');
        depth -= is_json && (*at == ']' || *at == '}');
    }
    return at;
}

/// Goes through a line field by field.
typedef struct cursor {
    const char *line, *columns; ///< what is left of them; columns NULL: JSON
    text name, value;           ///< of the field
} cursor;

/// What is up to the end of a value, which is skipped with the comma behind it.
static text take(const char **at, int is_json) {
    const char *end = skip_value(*at, is_json);
    const text taken = {*at, (size_t)(end - *at)};
    *at = end + (*end == ',');
    return taken;
}

/// The next field. 0 where there is none.
static int next_field(cursor *c) {
    if (!*c->line || *c->line == '\n' || *c->line == '}') return 0;
    if (c->columns) {
        c->name = take(&c->columns, 0);
        c->value = take(&c->line, 0);
        return 1;
    }
    const char *name = c->line + (*c->line == '{'), *end = skip_quoted(name, 1);
    if (*name != '"' || *end != ':') return 0;
    c->name = (text){name + 1, (size_t)(end - name - 2)};
    c->line = end + 1;
    c->value = take(&c->line, 1);
    return 1;
}

/// What keys are made of, in the order of the lines.
enum { STATE, TIME, FRAME, FREE_FOR, HIT_AFTER, BODY_A, BODY_B, LOWER, UPPER, WANTED };

static int find_wanted(const text *name) {
    static const char *const wanted[WANTED] = {"state", "time", "frame", "free_for", "hit_after",
                                               "a",     "b",    "lower", "upper"};
    int i = 0;
    while (i < WANTED &&
           (*wanted[i] != *name->at || strncmp(wanted[i], name->at, name->size) != 0 || wanted[i][name->size]))
        i++;
    return i;
}

/// Finds the fields of a line up to the last that its key needs; what is not there is empty.
static void find_fields(const shard_lines *lines, const char *line, text fields[WANTED]) {
    static const int last[] = {STATE, STATE, UPPER, BODY_B};
    cursor c = {.line = line, .columns = lines->columns};
    memset(fields, 0, WANTED * sizeof *fields);
    for (int found = WANTED; found != last[lines->order] && next_field(&c);) {
        found = find_wanted(&c.name);
        if (found < WANTED) fields[found] = c.value;
    }
}

/// The number of a field; what is empty or null is `none`.
static double get_number(const text *field, double none) {
    return field->size && *field->at != 'n' ? strtod(field->at, NULL) : none;
}

/* ---- bodies */

int shard_object_compare(const void *a, const void *b) {
    return strcmp(((const shard_object *)a)->text, ((const shard_object *)b)->text);
}

static int compare_body(const void *key, const void *object) {
    const text *wanted = key;
    const char *name = ((const shard_object *)object)->text;
    int order = strncmp(wanted->at, name, wanted->size);
    return order ? order : name[wanted->size] ? -1 : 0;
}

/// The place of a body in the scene. 0 where the scene has none of that name.
static int find_body(const shard_lines *lines, const text *field, uint64_t *index) {
    const shard_object *found = NULL;
    if (field->size && lines->body_count)
        found = bsearch(field, lines->bodies, lines->body_count, sizeof *lines->bodies, compare_body);
    if (found) *index = found->index;
    return found != NULL;
}

/* ---- keys */

/// The lines of a frame come behind those of the impacts before it, these by the time since the frame before.
static void set_time(const text fields[WANTED], shard_key *key) {
    double frame = get_number(&fields[FRAME], NAN);
    double after = get_number(&fields[HIT_AFTER], INFINITY);
    key->words[0] = make_word(isnan(frame) ? get_number(&fields[TIME], NAN) : frame);
    key->words[1] = isnan(frame) ? 0 : make_word(isfinite(after) ? after : get_number(&fields[FREE_FOR], NAN));
}

int shard_key_find(shard_key *key, const shard_lines *lines, const char *line) {
    text fields[WANTED];
    uint64_t a, b;
    *key = (shard_key){{0}};
    if (lines->order == SHARD_IN_TURN) return 1;
    find_fields(lines, line, fields);
    if (lines->order == SHARD_BY_STATE) {
        if (fields[STATE].size) key->words[0] = strtoull(fields[STATE].at, NULL, 10);
        return fields[STATE].size > 0;
    }
    if (!find_body(lines, &fields[BODY_A], &a) || !find_body(lines, &fields[BODY_B], &b)) return 0;
    key->words[2] = a << 32 | b;
    if (lines->order == SHARD_BY_TIME) return set_time(fields, key), 1;
    key->words[0] = make_word(get_number(&fields[LOWER], -INFINITY));
    key->words[1] = make_word(get_number(&fields[UPPER], INFINITY));
    return 1;
}
