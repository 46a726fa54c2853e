// Structs as JSON and as CSV, by their tables.
#include "io/fields.h"
#include "io/text.h"

#include <math.h>
#include <string.h>

void json_write_number(FILE *file, double value) {
    char digits[32];
    if (isfinite(value))
        fwrite(digits, 1, number_write(digits, value, 17), file);
    else
        fputs("null", file);
}

void json_write_numbers(FILE *file, const double *numbers, size_t count) {
    fputc('[', file);
    for (size_t i = 0; i < count; i++) {
        if (i) fputc(',', file);
        json_write_number(file, numbers[i]);
    }
    fputc(']', file);
}

void csv_write_number(FILE *file, double value) {
    char digits[32];
    fwrite(digits, 1, number_write(digits, value, 17), file);
}

static uint64_t get_whole(const void *at, size_t size) {
    uint64_t wide = 0;
    uint32_t word = 0;
    uint16_t half = 0;
    if (size == sizeof wide) return memcpy(&wide, at, size), wide;
    if (size == sizeof word) return memcpy(&word, at, size), word;
    memcpy(&half, at, sizeof half);
    return half;
}

// fprintf costs more than all the digits of a line.
static void write_whole(FILE *file, uint64_t value) {
    char digits[24], *at = digits + sizeof digits;
    do *--at = (char)('0' + value % 10);
    while (value /= 10);
    fwrite(at, 1, (size_t)(digits + sizeof digits - at), file);
}

static void write_quoted(FILE *file, const char *quote, const char *text) {
    fputs(quote, file);
    fputs(text, file);
    fputs(quote, file);
}

const char *field_get_name(const field_names *names, const void *at) {
    int value;
    memcpy(&value, at, sizeof value);
    return value < names->first || value > names->last ? "" : names->get(value);
}

static const void *get_pointer(const void *at) {
    const void *pointer;
    memcpy(&pointer, at, sizeof pointer);
    return pointer;
}

// ---- what is left out

static int is_zero(const field *f, const void *at) {
    double v[3] = {0};
    if (f->kind != FIELD_VECTOR) return get_whole(at, f->size) == 0;
    memcpy(v, at, sizeof v);
    return v[0] == 0 && v[1] == 0 && v[2] == 0;
}

/// The number of items of an array or a list; 1 of all else.
static size_t get_count(const field *f, const void *item) {
    const char *at = (const char *)item + f->count;
    if (f->kind == FIELD_LIST || f->kind == FIELD_TEXTS) return (size_t)get_whole(at, sizeof(size_t));
    return f->kind == FIELD_WHOLES || f->kind == FIELD_NUMBERS ? (size_t)get_whole(at, sizeof(uint32_t)) : 1;
}

static int is_there(const field *f, const void *item, uint64_t bits) {
    if (!get_count(f, item) && f->kind != FIELD_TEXTS) return 0;
    if (f->bit == FIELD_NOT_ZERO) return !is_zero(f, (const char *)item + f->offset);
    return f->bit == FIELD_ALWAYS || (bits & f->bit) != 0;
}

// ---- JSON

static void write_wholes(FILE *file, const uint32_t *values, size_t count) {
    fputc('[', file);
    for (size_t i = 0; i < count; i++) {
        if (i) fputc(',', file);
        write_whole(file, values[i]);
    }
    fputc(']', file);
}

static void write_list(FILE *file, const char *quote, const field *f, fields_item of) {
    const char *one = get_pointer((const char *)of.item + f->offset);
    size_t count = get_count(f, of.item);
    for (size_t i = 0; i < count; i++, one += f->table->size) {
        fputc(i ? ',' : '[', file);
        fields_write_json(file, quote, (fields_item){f->table, one, of.bits});
    }
    fputc(']', file);
}

static void write_texts(FILE *file, const char *const *texts, size_t count) {
    fputc('[', file);
    for (size_t i = 0; i < count; i++) {
        if (i) fputc(',', file);
        ovoid_text_write_json(file, texts[i]);
    }
    fputc(']', file);
}

static void write_text(FILE *file, const char *text) {
    if (text)
        ovoid_text_write_json(file, text);
    else
        fputs("null", file);
}

static void write_value(FILE *file, const char *quote, const field *f, fields_item of) {
    const void *item = of.item;
    const void *at = (const char *)item + f->offset;
    switch (f->kind) {
    case FIELD_FINITE:
    case FIELD_NUMBER:
    case FIELD_MEASURE: json_write_number(file, *(const double *)at); break;
    case FIELD_SECONDS: fprintf(file, "%.9f", *(const double *)at); break;
    case FIELD_WHOLE: write_whole(file, get_whole(at, f->size)); break;
    case FIELD_RANGE: write_wholes(file, at, 2); break;
    case FIELD_VECTOR: json_write_numbers(file, at, 3); break;
    case FIELD_NAME: write_quoted(file, quote, field_get_name(f->names, at)); break;
    case FIELD_TEXT: write_text(file, get_pointer(at)); break;
    case FIELD_FLAG: fputs(*(const int *)at ? "true" : "false", file); break;
    case FIELD_WHOLES: write_wholes(file, at, get_count(f, item)); break;
    case FIELD_NUMBERS: json_write_numbers(file, at, get_count(f, item)); break;
    case FIELD_TEXTS: write_texts(file, get_pointer(at), get_count(f, item)); break;
    case FIELD_OBJECT: fields_write_json(file, quote, (fields_item){f->table, at, of.bits}); break;
    case FIELD_LIST: write_list(file, quote, f, of); break;
    case FIELD_OWN: f->own->write(file, quote, item); break;
    }
}

const char *fields_write_members(FILE *file, const char *quote, const char *before, fields_item of) {
    const field_table *table = of.table;
    for (const field *f = table->fields; f < table->fields + table->count; f++) {
        if (!is_there(f, of.item, of.bits)) continue;
        fputs(before, file);
        write_quoted(file, quote, f->key);
        fputc(':', file);
        write_value(file, quote, f, of);
        before = ",";
    }
    return before;
}

void fields_write_json(FILE *file, const char *quote, fields_item item) {
    const char *before = fields_write_members(file, quote, "{", item);
    fputs(*before == '{' ? "{}" : "}", file);
}

// ---- CSV

const char *fields_write_csv_header(FILE *file, const char *before, const field_table *table, unsigned columns) {
    for (const field *f = table->fields; f < table->fields + table->count; f++) {
        if (!(f->column & columns)) continue;
        if (f->kind == FIELD_VECTOR)
            fprintf(file, "%s%s_x,%s_y,%s_z", before, f->key, f->key, f->key);
        else
            fprintf(file, "%s%s", before, f->key);
        before = ",";
    }
    return before;
}

static void write_vector(FILE *file, const double *v, int is_written) {
    for (int k = 0; k < 3; k++) {
        if (k) fputc(',', file);
        if (is_written) csv_write_number(file, v[k]);
    }
}

/// Kinds that are alike in JSON and CSV but for their quotes.
static void write_column(FILE *file, const field *f, fields_item of) {
    const void *item = of.item;
    const void *at = (const char *)item + f->offset;
    switch (f->kind) {
    case FIELD_FINITE:
    case FIELD_NUMBER: csv_write_number(file, *(const double *)at); break;
    case FIELD_MEASURE:
    case FIELD_SECONDS:
        if (isfinite(*(const double *)at)) csv_write_number(file, *(const double *)at);
        break;
    case FIELD_NAME: fputs(field_get_name(f->names, at), file); break;
    case FIELD_TEXT:
        if (get_pointer(at)) ovoid_text_write_csv(file, get_pointer(at));
        break;
    case FIELD_OBJECT:
        fputc('"', file);
        fields_write_json(file, "\"\"", (fields_item){f->table, at, of.bits});
        fputc('"', file);
        break;
    case FIELD_LIST:
        fputc('"', file);
        write_list(file, "\"\"", f, of);
        fputc('"', file);
        break;
    case FIELD_OWN: f->own->write(file, NULL, item); break;
    default: write_value(file, "", f, of); break;
    }
}

const char *fields_write_csv(FILE *file, const char *before, fields_item of, unsigned columns) {
    const field_table *table = of.table;
    for (const field *f = table->fields; f < table->fields + table->count; f++) {
        if (!(f->column & columns)) continue;
        fputs(before, file);
        before = ",";
        if (f->kind == FIELD_VECTOR)
            write_vector(file, (const double *)(const void *)((const char *)of.item + f->offset),
                         is_there(f, of.item, of.bits));
        else if (is_there(f, of.item, of.bits))
            write_column(file, f, of);
    }
    return before;
}
