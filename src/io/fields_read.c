// Objects of JSON read into structs by their tables, strictly: every key that need be there, no other, each value of
// its kind.
#include "io/fields.h"
#include "io/json.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Memory of a list.
typedef struct fields_block {
    struct fields_block *next;
    double items[]; ///< of any kind
} fields_block;

void fields_reader_clear(fields_reader *r) {
    while (r->blocks) {
        fields_block *next = r->blocks->next;
        free(r->blocks);
        r->blocks = next;
    }
}

static void *get_memory(fields_reader *r, size_t count, size_t size) {
    fields_block *block = calloc(1, sizeof *block + count * size);
    if (!block) return r->is_memory_out = 1, NULL;
    block->next = r->blocks;
    r->blocks = block;
    return block->items;
}

// ---- numbers

int json_read_whole(const json_t *value, double top, double *whole) {
    if (!json_is_number(value)) return 0;
    *whole = json_number_value(value);
    return *whole >= 0 && *whole <= top && *whole == floor(*whole);
}

int json_read_wholes(const json_t *value, size_t count, double top, double *whole) {
    if (!json_is_array(value) || json_array_size(value) != count) return 0;
    for (size_t i = 0; i < count; i++)
        if (!json_read_whole(json_array_get(value, i), top, &whole[i])) return 0;
    return 1;
}

static int read_number(const json_t *value, double if_null, double *number) {
    *number = json_is_null(value) ? if_null : json_number_value(value);
    return json_is_number(value) || json_is_null(value);
}

static int read_bounded(const json_t *value, const field *f, double *number) {
    if (f->kind == FIELD_FINITE && !json_is_number(value)) return 0;
    return read_number(value, f->if_null, number) && (f->least == 0 || *number > f->least);
}

static int read_numbers(const json_t *value, size_t count, double *numbers) {
    if (!json_is_array(value) || json_array_size(value) != count) return 0;
    for (size_t i = 0; i < count; i++)
        if (!read_number(json_array_get(value, i), NAN, &numbers[i])) return 0;
    return 1;
}

/// Numbers are doubles: of 64 bits the whole ones up to 2^53.
static int read_whole(const json_t *value, size_t size, void *at) {
    double whole;
    if (!json_read_whole(value, size > 4 ? 0x1p53 : size == 4 ? UINT32_MAX : UINT16_MAX, &whole)) return 0;
    if (size > 4) return memcpy(at, &(uint64_t){(uint64_t)whole}, size), 1;
    if (size == 4) return memcpy(at, &(uint32_t){(uint32_t)whole}, size), 1;
    return memcpy(at, &(uint16_t){(uint16_t)whole}, size), 1;
}

static int read_range(const json_t *value, uint32_t *at) {
    double v[2];
    if (!json_read_wholes(value, 2, UINT32_MAX, v)) return 0;
    at[0] = (uint32_t)v[0];
    at[1] = (uint32_t)v[1];
    return 1;
}

// ---- names, texts

static int read_name(const json_t *value, const field_names *names, void *at) {
    const char *text = json_string_value(value);
    for (int i = names->first; text && i <= names->last; i++)
        if (strcmp(names->get(i), text) == 0) return memcpy(at, &i, sizeof i), 1;
    return 0;
}

static int read_text(const json_t *value, void *at) {
    const char *text = json_string_value(value);
    if (!text && !json_is_null(value)) return 0;
    return memcpy(at, &text, sizeof text), 1;
}

static int read_flag(const json_t *value, void *at) {
    int flag = json_is_true(value);
    if (!json_is_boolean(value)) return 0;
    return memcpy(at, &flag, sizeof flag), 1;
}

// ---- arrays, lists

static const char *read_object(fields_reader *r, json_t *object, const field_table *table, void *item);

/// Arrays of one count: the first of them says what it is.
static const char *read_array(fields_reader *r, const json_t *value, const field *f, void *item) {
    char *at = (char *)item + f->offset;
    uint32_t *count = (uint32_t *)(void *)((char *)item + f->count);
    size_t width = f->kind == FIELD_WHOLES ? sizeof(uint32_t) : sizeof(double), size = json_array_size(value);
    snprintf(r->text, sizeof r->text, "must be a list of 1 to %u items", (unsigned)(f->size / width));
    if (!size || size > f->size / width) return r->text;
    if (*count && *count != size) return "must have as many items as the lists before it";
    *count = (uint32_t)size;
    if (f->kind == FIELD_NUMBERS) return read_numbers(value, size, (double *)(void *)at) ? NULL : f->wrong;
    for (size_t i = 0; i < size; i++)
        if (!read_whole(json_array_get(value, i), width, at + i * width)) return f->wrong;
    return NULL;
}

static const char *read_texts(fields_reader *r, const json_t *value, const field *f, void *item) {
    size_t count = json_array_size(value);
    const char **texts = json_is_array(value) ? get_memory(r, count, sizeof *texts) : NULL;
    for (size_t i = 0; i < count && texts; i++)
        if (!(texts[i] = json_string_value(json_array_get(value, i)))) return f->wrong;
    if (!texts) return f->wrong;
    memcpy((char *)item + f->offset, &texts, sizeof texts);
    memcpy((char *)item + f->count, &count, sizeof count);
    return NULL;
}

static const char *read_list(fields_reader *r, const json_t *value, const field *f, void *item) {
    size_t count = json_array_size(value);
    if (!count) return "must be a list, not an empty one";
    char *items = get_memory(r, count, f->table->size);
    if (!items) return "";
    memcpy((char *)item + f->offset, &items, sizeof items);
    memcpy((char *)item + f->count, &count, sizeof count);
    const char *wrong = NULL;
    for (size_t i = 0; i < count && !wrong; i++)
        wrong = read_object(r, json_array_get(value, i), f->table, items + i * f->table->size);
    return wrong;
}

// ---- objects

static const char *read_value(fields_reader *r, json_t *value, const field *f, void *item) {
    void *at = (char *)item + f->offset;
    int good = 0;
    switch (f->kind) {
    case FIELD_FINITE:
    case FIELD_NUMBER:
    case FIELD_MEASURE:
    case FIELD_SECONDS: good = read_bounded(value, f, at); break;
    case FIELD_WHOLE: good = read_whole(value, f->size, at); break;
    case FIELD_RANGE: good = read_range(value, at); break;
    case FIELD_VECTOR: good = read_numbers(value, 3, at); break;
    case FIELD_NAME: good = read_name(value, f->names, at); break;
    case FIELD_TEXT: good = read_text(value, at); break;
    case FIELD_FLAG: good = read_flag(value, at); break;
    case FIELD_WHOLES:
    case FIELD_NUMBERS: return read_array(r, value, f, item);
    case FIELD_TEXTS: return read_texts(r, value, f, item);
    case FIELD_OBJECT: return read_object(r, value, f->table, at);
    case FIELD_LIST: return read_list(r, value, f, item);
    case FIELD_OWN: return f->own->read(value, item);
    }
    return good ? NULL : f->wrong;
}

static const field *find_field(const field_table *table, const char *key) {
    for (const field *f = table->fields; f < table->fields + table->count; f++)
        if (strcmp(f->key, key) == 0) return f;
    return NULL;
}

/// A key that is there and should not be, or is not and should be.
static const char *check_keys(fields_reader *r, json_t *object, const field_table *table) {
    const char *key;
    json_t *value;
    if (!json_is_object(object)) return table->foreign;
    json_object_foreach(object, key, value) {
        r->key = key;
        if (!find_field(table, key)) return table->foreign;
    }
    for (const field *f = table->fields; f < table->fields + table->count; f++) {
        int is_counted = f->kind == FIELD_WHOLES || f->kind == FIELD_NUMBERS || f->kind == FIELD_LIST;
        r->key = f->key;
        if (f->bit == FIELD_ALWAYS && !is_counted && !json_object_get(object, f->key))
            return table->missing ? table->missing : f->wrong;
    }
    return NULL;
}

static const char *read_object(fields_reader *r, json_t *object, const field_table *table, void *item) {
    const char *wrong = check_keys(r, object, table);
    for (const field *f = table->fields; f < table->fields + table->count && !wrong; f++) {
        json_t *value = json_object_get(object, f->key);
        if (!value) continue;
        r->key = f->key;
        r->bits |= f->bit;
        wrong = read_value(r, value, f, item);
    }
    return wrong;
}

const char *fields_read(fields_reader *r, json_t *object, const field_table *table, void *item) {
    r->bits = 0;
    return read_object(r, object, table, item);
}

const char *fields_compare(fields_reader *r, const json_t *object, const field_table *table, uint64_t bits) {
    for (const field *f = table->fields; f < table->fields + table->count; f++) {
        const json_t *value = json_object_get(object, f->key);
        int is_free = f->bit == FIELD_ALWAYS || f->bit == FIELD_NOT_ZERO;
        r->key = f->key;
        if (!is_free && !value != !(bits & f->bit)) return f->apart;
        const char *wrong = value && f->kind == FIELD_OBJECT ? fields_compare(r, value, f->table, bits) : NULL;
        if (wrong) return wrong;
    }
    return NULL;
}
