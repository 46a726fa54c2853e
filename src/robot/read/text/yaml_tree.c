// YAML through libyaml (https://pyyaml.org/wiki/LibYAML), by its events: nothing is composed that is not kept here, and
// aliases, by which a small file can mean a large one, are refused. Cost: linear in the file.
#include "robot/read/text/yaml_tree.h"

#include <stdlib.h>
#include <string.h>
#include <yaml.h>

enum { TAGS_MAX = 16 };

/// The state of reading.
typedef struct yaml_reader {
    const char *path;
    pool *memory;
    ovoid_error *error;
    yaml_value *root, *open; ///< open: the innermost list or map that has not ended
    const char *key;         ///< of the map's next member; NULL: it is yet to come
    size_t depth, documents;
} yaml_reader;

static ovoid_code fail(const yaml_reader *r, const yaml_event_t *event, ovoid_code code, const char *sentence) {
    return io_fail(r->error, code, (where){r->path, (int64_t)event->start_mark.line + 1, -1}, "%s", sentence);
}

static ovoid_code fail_parser(const yaml_reader *r, const yaml_parser_t *parser) {
    if (parser->error == YAML_MEMORY_ERROR) return io_fail_memory(r->error, r->path);
    where at = {r->path, (int64_t)parser->problem_mark.line + 1, -1};
    return io_fail(r->error, OVOID_ERROR_FORMAT, at, "YAML: %s", parser->problem ? parser->problem : "cannot be read");
}

void yaml_append(yaml_value *parent, yaml_value *value) {
    value->parent = parent;
    parent->count++;
    if (parent->last)
        parent->last = parent->last->next = value;
    else
        parent->first = parent->last = value;
}

// A value at the place that is open.
static ovoid_code add_value(yaml_reader *r, const yaml_event_t *event, yaml_kind kind, yaml_value **out) {
    yaml_value *value = pool_get(r->memory, 1, sizeof *value);
    if (!value) return io_fail_memory(r->error, r->path);
    *value = (yaml_value){.kind = kind, .line = (int64_t)event->start_mark.line + 1, .key = r->key, .text = ""};
    if (!r->open)
        r->root = value;
    else
        yaml_append(r->open, value);
    r->key = NULL;
    *out = value;
    return OVOID_OK;
}

static int wants_key(const yaml_reader *r) { return r->open && r->open->kind == YAML_MAP && !r->key; }

// One document is read. "rostopic echo" and "ros2 topic echo" end each message by "---": a last document may be empty.
static ovoid_code refuse_second(const yaml_reader *r, const yaml_event_t *event) {
    if (r->documents < 2) return OVOID_OK;
    return fail(r, event, OVOID_ERROR_FORMAT, "there is a second document; one is read");
}

static int is_empty(const yaml_event_t *event) {
    return event->data.scalar.length == 0 && event->data.scalar.style == YAML_PLAIN_SCALAR_STYLE;
}

static ovoid_code take_text(yaml_reader *r, const yaml_event_t *event) {
    if (r->documents > 1) return is_empty(event) ? OVOID_OK : refuse_second(r, event);
    const char *text = (const char *)event->data.scalar.value;
    size_t length = event->data.scalar.length;
    if (memchr(text, 0, length)) return fail(r, event, OVOID_ERROR_FORMAT, "a text holds a zero byte");
    text = pool_copy(r->memory, text, length);
    if (!text) return io_fail_memory(r->error, r->path);
    if (wants_key(r)) {
        r->key = text;
        return OVOID_OK;
    }
    yaml_value *value;
    ovoid_code code = add_value(r, event, YAML_TEXT, &value);
    if (!code) value->text = text;
    return code;
}

static ovoid_code begin(yaml_reader *r, const yaml_event_t *event, yaml_kind kind) {
    ovoid_code code = refuse_second(r, event);
    if (code) return code;
    if (wants_key(r)) return fail(r, event, OVOID_ERROR_FORMAT, "a key must be a text");
    if (++r->depth > YAML_DEPTH_MAX) return fail(r, event, OVOID_ERROR_LIMIT, "values are nested more than 64 deep");
    yaml_value *value;
    code = add_value(r, event, kind, &value);
    if (!code) r->open = value;
    return code;
}

static ovoid_code take_event(yaml_reader *r, const yaml_event_t *event) {
    switch (event->type) {
    case YAML_DOCUMENT_START_EVENT: r->documents++; return OVOID_OK;
    case YAML_ALIAS_EVENT: return fail(r, event, OVOID_ERROR_FORMAT, "aliases are not read; write the value itself");
    case YAML_SCALAR_EVENT: return take_text(r, event);
    case YAML_SEQUENCE_START_EVENT: return begin(r, event, YAML_LIST);
    case YAML_MAPPING_START_EVENT: return begin(r, event, YAML_MAP);
    case YAML_SEQUENCE_END_EVENT:
    case YAML_MAPPING_END_EVENT:
        r->depth--;
        if (r->open) r->open = r->open->parent;
        return OVOID_OK;
    default: return OVOID_OK;
    }
}

static ovoid_code parse(yaml_reader *r, yaml_parser_t *parser) {
    for (;;) {
        yaml_event_t event;
        if (!yaml_parser_parse(parser, &event)) return fail_parser(r, parser);
        int is_end = event.type == YAML_STREAM_END_EVENT || event.type == YAML_NO_EVENT;
        ovoid_code code = take_event(r, &event);
        yaml_event_delete(&event);
        if (code || is_end) return code;
    }
}

// libyaml looks at all tags of a document for each new one: a file of them alone would take it hours.
static ovoid_code validate_tags(const char *path, bytes file, ovoid_error *error) {
    size_t count = 0;
    for (const char *at = file.data, *end = file.data + file.size; (at = memchr(at, '%', (size_t)(end - at))); at++)
        count += end - at >= 4 && memcmp(at, "%TAG", 4) == 0;
    if (count <= TAGS_MAX) return OVOID_OK;
    return io_fail(error, OVOID_ERROR_LIMIT, (where){path, 0, -1},
                   "YAML: there are %zu %%TAG directives; at most %d are read", count, TAGS_MAX);
}

static ovoid_code read_file(yaml_reader *r, bytes file) {
    yaml_parser_t parser;
    ovoid_code code = validate_tags(r->path, file, r->error);
    if (code) return code;
    if (!yaml_parser_initialize(&parser)) return io_fail_memory(r->error, r->path);
    yaml_parser_set_encoding(&parser, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(&parser, (const unsigned char *)file.data, file.size);
    code = parse(r, &parser);
    yaml_parser_delete(&parser);
    return code;
}

ovoid_code yaml_read(const char *path, pool *memory, yaml_value **root, ovoid_error *error) {
    bytes file;
    yaml_reader r = {.path = path, .memory = memory, .error = error};
    ovoid_code code = bytes_read_input(path, YAML_SIZE_MAX, &file, error);
    if (code) return code;
    code = read_file(&r, bytes_skip_mark(file));
    free(file.data);
    if (!code && !r.root && !(r.root = pool_get(memory, 1, sizeof *r.root))) code = io_fail_memory(error, path);
    if (!code && !r.documents) *r.root = (yaml_value){.kind = YAML_MAP, .line = 1, .text = ""};
    *root = code ? NULL : r.root;
    return code;
}
