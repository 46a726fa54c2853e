// The line of a JSON value, found by walking the text once more: jansson keeps no places. And texts and numbers written
// as JSON.
#include "io/json.h"

#include <math.h>
#include <string.h>

// ---- the line of a value

/// A place in a text that is known to be JSON.
typedef struct walker {
    const char *at, *end;
} walker;

static void skip_space(walker *w) {
    while (w->at < w->end && (*w->at == ' ' || *w->at == '\t' || *w->at == '\r' || *w->at == '\n')) w->at++;
}

// From the opening quote to behind the closing one.
static void skip_text(walker *w) {
    for (w->at++; w->at < w->end && *w->at != '"'; w->at++)
        if (*w->at == '\\' && w->at + 1 < w->end) w->at++;
    if (w->at < w->end) w->at++;
}

// Any value, to behind its end: brackets are counted, so that no nesting is too deep.
static void skip_value(walker *w) {
    size_t depth = 0;
    skip_space(w);
    while (w->at < w->end) {
        char c = *w->at;
        if (!depth && (c == ',' || c == '}' || c == ']')) return;
        if (c == '"') {
            skip_text(w);
        } else {
            if (c == '{' || c == '[') depth++;
            if (c == '}' || c == ']') depth--;
            w->at++;
        }
    }
}

// 1 if the text in quotes at the walker is the key, written without escapes.
static int is_key(const walker *w, const char *key) {
    size_t length = strlen(key);
    return (size_t)(w->end - w->at) > length + 1 && memcmp(w->at + 1, key, length) == 0 && w->at[length + 1] == '"';
}

// Goes into the object or array at the walker; 0 and no move where the step leads nowhere.
static int enter(walker *w, json_step step) {
    walker inside = *w;
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
            *w = inside;
            return 1;
        }
        skip_value(&inside);
        if (inside.at < inside.end && *inside.at == ',') inside.at++;
    }
}

int64_t json_find_line(bytes text, const json_step *steps, size_t count) {
    walker w = {text.data, text.data + text.size};
    skip_space(&w);
    for (size_t i = 0; i < count && enter(&w, steps[i]); i++) continue;
    int64_t line = 1;
    for (const char *c = text.data; c < w.at; c++) line += *c == '\n';
    return line;
}

int json_is_memory_error(const json_error_t *why) {
    return !why->text[0] || json_error_code(why) == json_error_out_of_memory;
}

// ---- writing

// R. Pike, K. Thompson, 1992; RFC 3629: no surrogates, no overlong forms, nothing above U+10FFFF.
int utf8_get_length(const unsigned char *c) {
    if (c[0] < 0x80) return 1;
    int length = c[0] >= 0xc2 && c[0] < 0xe0   ? 2
                 : c[0] >= 0xe0 && c[0] < 0xf0 ? 3
                 : c[0] >= 0xf0 && c[0] < 0xf5 ? 4
                                               : 0;
    for (int i = 1; i < length; i++)
        if ((c[i] & 0xc0) != 0x80) return 0;
    if (c[0] == 0xe0 && c[1] < 0xa0) return 0;
    if (c[0] == 0xed && c[1] > 0x9f) return 0;
    if (c[0] == 0xf0 && c[1] < 0x90) return 0;
    if (c[0] == 0xf4 && c[1] > 0x8f) return 0;
    return length;
}

void json_write_text(FILE *file, const char *text) {
    fputc('"', file);
    for (const unsigned char *c = (const unsigned char *)text; *c;) {
        int length = utf8_get_length(c);
        if (*c == '"' || *c == '\\')
            fprintf(file, "\\%c", *c);
        else if (*c < 0x20 || *c == 0x7f)
            fprintf(file, "\\u%04x", *c);
        else if (length)
            fwrite(c, 1, (size_t)length, file);
        else
            fputs("\\ufffd", file);
        c += length ? length : 1;
    }
    fputc('"', file);
}

void json_write_number(FILE *file, double value) {
    char digits[32];
    if (!isfinite(value)) {
        fputs("null", file);
        return;
    }
    fwrite(digits, 1, number_write(digits, value, 17), file);
}
