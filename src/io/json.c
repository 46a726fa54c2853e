// JSON of bounded depth, since jansson calls itself for each level and the stack may be small; the line of a value,
// found by scanning the text once more, since jansson keeps no positions; long lists read element by element.
#include "io/json.h"

#include <stdlib.h>
#include <string.h>

/// A position in a text that is known to be JSON.
typedef struct scanner {
    const char *at, *end;
} scanner;

static void skip_space(scanner *s) {
    while (s->at < s->end && (*s->at == ' ' || *s->at == '\t' || *s->at == '\r' || *s->at == '\n')) s->at++;
}

// Skips a text from its opening quote to behind the closing one.
static void skip_text(scanner *s) {
    for (s->at++; s->at < s->end && *s->at != '"'; s->at++)
        if (*s->at == '\\' && s->at + 1 < s->end) s->at++;
    if (s->at < s->end) s->at++;
}

// Skips any value; brackets are counted, so that no nesting is too deep.
static void skip_value(scanner *s) {
    size_t depth = 0;
    skip_space(s);
    while (s->at < s->end) {
        char c = *s->at;
        if (!depth && (c == ',' || c == '}' || c == ']')) return;
        if (c == '"') {
            skip_text(s);
        } else {
            if (c == '{' || c == '[') depth++;
            if (c == '}' || c == ']') depth--;
            s->at++;
        }
    }
}

// ---- loading

// Says that the value at the scanner is nested too deep.
static void fail_depth(bytes text, const char *at, json_error_t *why) {
    *why = (json_error_t){.line = 1, .position = (int)(at - text.data)};
    for (const char *c = text.data; c < at; c++) why->column = *c == '\n' ? why->line++, 0 : why->column + 1;
    snprintf(why->text, sizeof why->text, "values are nested more than %d deep", JSON_DEPTH_MAX);
    why->text[sizeof why->text - 1] = json_error_stack_overflow; // where jansson has its codes
}

// 0, and *why, where values are nested too deep. As far as a text is JSON its texts and brackets are seen as jansson
// sees them; behind that jansson goes no deeper.
static int validate_depth(bytes text, json_error_t *why) {
    scanner s = {text.data, text.data + text.size};
    size_t depth = 0;
    while (s.at < s.end) {
        char c = *s.at;
        if (c == '"') {
            skip_text(&s);
            continue;
        }
        if ((c == '{' || c == '[') && ++depth > JSON_DEPTH_MAX) return fail_depth(text, s.at, why), 0;
        if ((c == '}' || c == ']') && depth) depth--;
        s.at++;
    }
    return 1;
}

json_t *json_load(bytes text, int flags, json_error_t *why) {
    return validate_depth(text, why) ? json_loadb(text.data, text.size, flags, why) : NULL;
}

ovoid_code json_get_failure(const json_error_t *why) {
    if (!why->text[0] || json_error_code(why) == json_error_out_of_memory) return OVOID_ERROR_MEMORY;
    return json_error_code(why) == json_error_stack_overflow ? OVOID_ERROR_LIMIT : OVOID_ERROR_FORMAT;
}

// ---- the line of a value

// 1 if the text in quotes at the scanner is the key, written without escapes.
static int is_key(const scanner *s, const char *key) {
    size_t length = strlen(key);
    return (size_t)(s->end - s->at) > length + 1 && memcmp(s->at + 1, key, length) == 0 && s->at[length + 1] == '"';
}

// Enters the object or array at the scanner; 0, without a move, where the step leads nowhere.
static int enter(scanner *s, json_step step) {
    scanner inside = *s;
    if (inside.at == inside.end || *inside.at != (step.key ? '{' : '[')) return 0;
    inside.at++;
    for (size_t i = 0;; i++) {
        skip_space(&inside);
        if (inside.at == inside.end || *inside.at == '}' || *inside.at == ']') return 0;
        int found = step.key ? is_key(&inside, step.key) : i == step.index;
        if (step.key) {
            skip_text(&inside);
            skip_space(&inside);
            inside.at += inside.at < inside.end; // the colon
            skip_space(&inside);
        }
        if (found) {
            *s = inside;
            return 1;
        }
        skip_value(&inside);
        if (inside.at < inside.end && *inside.at == ',') inside.at++;
    }
}

int64_t json_find_line(bytes text, const json_step *steps, size_t count) {
    scanner s = {text.data, text.data + text.size};
    skip_space(&s);
    for (size_t i = 0; i < count && enter(&s, steps[i]); i++) continue;
    int64_t line = 1;
    for (const char *c = text.data; c < s.at; c++) line += *c == '\n';
    return line;
}

// ---- a list, element by element

// The list at the key, without its brackets; 0 where none is found. Of what is no JSON it may be anything within the
// text.
static int find_list(bytes text, const char *key, scanner *inside) {
    scanner s = {text.data, text.data + text.size};
    skip_space(&s);
    if (!enter(&s, (json_step){key, 0}) || s.at == s.end || *s.at != '[') return 0;
    inside->at = s.at + 1;
    skip_value(&s);
    while (s.at[-1] == ' ' || s.at[-1] == '\t' || s.at[-1] == '\r' || s.at[-1] == '\n') s.at--;
    inside->end = s.at - 1;
    return inside->end >= inside->at && *inside->end == ']';
}

json_t *json_load_around(bytes text, const char *key, int flags, json_list *list, json_error_t *why) {
    scanner s;
    *list = (json_list){.flags = flags};
    if (!validate_depth(text, why)) return NULL;
    if (!find_list(text, key, &s)) {
        json_t *root = json_loadb(text.data, text.size, flags, why);
        list->loaded = json_object_get(root, key);
        return root;
    }
    list->at = s.at;
    list->end = s.end;
    // Up to the opening bracket, and from the closing one on.
    size_t before = (size_t)(s.at - text.data), after = text.size - (size_t)(s.end - text.data);
    char *around = malloc(before + after);
    *why = (json_error_t){.text = ""};
    if (!around) return NULL;
    memcpy(around, text.data, before);
    memcpy(around + before, s.end, after);
    json_t *root = json_loadb(around, before + after, flags, why);
    free(around);
    return root;
}

// Behind an element a comma, which another must follow, or the end.
static int skip_comma(json_list *list, const char *behind) {
    scanner s = {behind, list->end};
    skip_space(&s);
    list->is_ended = s.at == s.end;
    list->at = s.at + !list->is_ended;
    return list->is_ended || *s.at == ',';
}

int json_next(json_list *list, json_t **element, json_error_t *why) {
    if (!list->at) {
        *element = json_incref(json_array_get(list->loaded, list->index++));
        return *element != NULL;
    }
    scanner s = {list->at, list->end};
    skip_space(&s);
    if (list->is_ended || (s.at == s.end && !list->index)) return 0;
    int flags = list->flags | JSON_DISABLE_EOF_CHECK | JSON_DECODE_ANY;
    *element = json_loadb(s.at, (size_t)(s.end - s.at) + 1, flags, why);
    list->index++;
    if (!*element) return -1;
    if (skip_comma(list, s.at + why->position)) return 1;
    json_decref(*element);
    snprintf(why->text, sizeof why->text, "no comma between elements");
    return -1;
}
